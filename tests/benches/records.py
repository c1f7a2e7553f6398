"""The columns of records.rs, made with NumPy's structured dtypes: KIND, bytes of one read, rounds; packets on stdin."""

import sys
import time

import numpy as np

stamp = [("t", "<u8")]
enc = np.dtype(stamp + [("pos", "<i8"), ("tmr", "<u4"), ("temp", "i1"), ("_", "V3")])
drv = np.dtype(stamp + [("_", "V2"), ("id", "<i2"), ("iq", "<i2"), ("angle", "<u2"), ("vel", "<i2"), ("_2", "V2")])
rt = np.dtype(stamp + [("in", "u1"), ("_", "V3"), ("out", "u1"), ("_2", "V3")])
std = np.dtype(stamp + [("_", "V8"), ("in", "<u4"), ("out", "<u4")])
six = np.dtype([("high", "<u2", 6), ("low", "u1", 2), ("temp", "<i2"), ("_", "V2")])
element = np.dtype([("high", "<u2", 4), ("low", "u1")])
sixteen = np.dtype([("elements", element, 4), ("temp", "<i2"), ("_", "V2")])
fsens = np.dtype(stamp + [("_", "V4"), ("six", six), ("_2", "V2"), ("sixteen", sixteen)])
plscnt = np.dtype(stamp + [("counters", "<u4", 4)])
tcp = np.dtype(stamp + [("components", "<f8", 9)])
axes = range(1, 7)
block = np.dtype(
    [(f"enc{axis}", enc, 8) for axis in axes]
    + [(f"drv{axis}", drv, 8) for axis in axes]
    + [("rt", rt, 8), ("std", std, 8), ("fsens", fsens), ("plscnt", plscnt), ("tcp", tcp)]
)
assert block.itemsize == 2608

moment = [("year", "<i2"), ("month", "u1"), ("day", "u1"), ("hour", "u1"), ("minute", "u1"), ("second", "u1"), ("ms", "<i2")]
record = np.dtype(
    [("tag", "u1"), ("ver", "u1"), ("id", "<u2"), ("_", "V2"), ("type", "<u2"), ("_2", "V2"), ("common", "u1", 4)]
    + [("count", "<u4"), ("elapsed", "<u4"), ("force", "<f4", 8), ("cur", "<f4", 6), ("ref", "<f4", 6)]
    + [("diff", "<f4", 3), ("speed", "<f4", 4), ("joint", "<f4", 6), ("ol", "u1", 6), ("fc", "u1"), ("step", "<u4")]
    + moment
    + [("seq", "u1"), ("object", "u1"), ("fm", "<i2")]
)
assert record.itemsize == 178


def column(values):
    return np.ascontiguousarray(values).reshape(-1)


def join(high, low, bit):
    return (high.astype(np.int16).astype(np.int32) << 2) | ((low >> bit) & 3)


def motion(blocks):
    columns = []
    for axis in axes:
        item = blocks[f"enc{axis}"]
        columns += [column(item[name]) for name in ("t", "pos", "tmr", "temp")]
        item = blocks[f"drv{axis}"]
        columns += [column(item[name]) for name in ("t", "id", "iq", "angle", "vel")]
    for item in (blocks["rt"], blocks["std"]):
        columns += [column(item[name]) for name in ("t", "in", "out")]
    item = blocks["fsens"]
    columns.append(column(item["t"]))
    high, low = item["six"]["high"], item["six"]["low"]
    columns += [join(high[:, value], low[:, value // 3], 2 * (value % 3)) for value in range(6)]
    columns.append(column(item["six"]["temp"]))
    elements = item["sixteen"]["elements"]
    high, low = elements["high"], elements["low"]
    columns += [join(high[:, e, value], low[:, e], 2 * value) for e in range(4) for value in range(4)]
    columns.append(column(item["sixteen"]["temp"]))
    for item, name, count in ((blocks["plscnt"], "counters", 4), (blocks["tcp"], "components", 9)):
        columns.append(column(item["t"]))
        columns += [column(item[name][:, value]) for value in range(count)]
    return columns


def force(records):
    assert (records["tag"] == 2).all() and (records["type"] == 0).all()
    columns = [column(records[name]) for name in ("id", "count", "elapsed", "fc", "step", "seq", "object", "fm")]
    for name, count in (("force", 8), ("cur", 6), ("ref", 6), ("diff", 3), ("speed", 4), ("joint", 6), ("ol", 6)):
        columns += [column(records[name][:, value]) for value in range(count)]
    days = (records["year"] - 1970).astype("M8[Y]").astype("M8[M]") + (records["month"] - 1).astype("m8[M]")
    days = days.astype("M8[D]") + (records["day"] - 1).astype("m8[D]")
    ms = records["hour"] * np.int64(3_600_000) + records["minute"] * np.int64(60_000)
    ms += records["second"] * np.int64(1000) + records["ms"]
    columns.append(days.astype("M8[ms]").astype(np.int64) + ms)
    return columns


def run(data, read, decode, dtype):
    if read >= len(data):
        return decode(np.frombuffer(data, dtype))
    view = memoryview(data)
    parts = [decode(np.frombuffer(view[at : at + read], dtype)) for at in range(0, len(data), read)]
    return [np.concatenate(column) for column in zip(*parts)]


def main(kind, read, rounds):
    data = sys.stdin.buffer.read()
    decode, dtype = {"motion": (motion, block), "force": (force, record)}[kind]
    run(data, read, decode, dtype)
    for _ in range(rounds):
        start = time.perf_counter()
        run(data, read, decode, dtype)
        print(time.perf_counter() - start)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
