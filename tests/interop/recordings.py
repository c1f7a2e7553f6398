#!/usr/bin/env python3
"""A recording as pandas reads it, CSV or Parquet: a line a motion log block or a force sensor record, with the numbers in
the order of the manual's tables (4.1.3, 4.3.3), joined by commas. A value that is not there is a 0, as in the packets. The
types are those of the sidecar. Exit code 3: pandas or pyarrow is missing.

    recordings.py RECORDING FILE
"""

import json
import sys

try:
    import pandas as pd
    import pyarrow.parquet
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(3)

if len(sys.argv) < 3:
    sys.exit(0)

ROWS_PER_BLOCK = 8
ONCE_A_BLOCK = ("FSENS", "PLSCNT", "TCP")
# Whole numbers may be missing, so they are pandas' own. A time is text at first.
TYPES = {f"u{bits}": f"UInt{bits}" for bits in (8, 16, 32, 64)} | {f"i{bits}": f"Int{bits}" for bits in (8, 16, 32, 64)}
TYPES |= {"f32": "float32", "f64": "float64", "time": "string"}


def read(path, columns):
    names = [column["name"] for column in columns]
    if path.endswith(".parquet"):
        units = json.loads(pyarrow.parquet.read_schema(path).metadata[b"units"])
        assert units == {column["name"]: column["unit"] for column in columns if column["unit"]}
        table = pd.read_parquet(path, dtype_backend="numpy_nullable")
        assert list(table.columns) == names
        return table
    titles = [f"{column['name']} [{column['unit']}]" if column["unit"] else column["name"] for column in columns]
    types = {title: TYPES[column["type"]] for title, column in zip(titles, columns)}
    table = pd.read_csv(path, dtype=types)
    assert list(table.columns) == titles
    table.columns = names
    for column in columns:
        if column["type"] == "time":
            table[column["name"]] = pd.to_datetime(table[column["name"]], format="ISO8601")
    return table


def plain(value):
    """A number, or the numbers of a time."""
    if isinstance(value, pd.Timestamp):
        return [value.year, value.month, value.day, value.hour, value.minute, value.second, value.microsecond // 1000]
    return [value.item() if hasattr(value, "item") else value]


def values(table, column):
    missing = [0] * 7 if pd.api.types.is_datetime64_any_dtype(table[column]) else [0]
    return [missing if pd.isna(value) else plain(value) for value in table[column].tolist()]


def force(table):
    return [sum(record, []) for record in zip(*(values(table, column) for column in table.columns))]


def motion(table):
    items = {}
    for column in table.columns:
        items.setdefault(column.split(".")[0], []).append(values(table, column))
    records = []
    for block in range(0, len(table), ROWS_PER_BLOCK):
        record = []
        for item, columns in items.items():
            for row in range(block, block + (1 if item in ONCE_A_BLOCK else ROWS_PER_BLOCK)):
                record += [number for column in columns for number in column[row]]
        records.append(record)
    return records


def main(path, output):
    with open(f"{path}.json", encoding="utf-8") as file:
        sidecar = json.load(file)
    table = read(path, sidecar["columns"])
    assert len(table) == sidecar["rows"]
    records = motion(table) if sidecar["source"] == "motion" else force(table)
    with open(output, "w", encoding="utf-8") as file:
        file.writelines(",".join(map(repr, record)) + "\n" for record in records)
    print(json.dumps({"ok": True}))


main(*sys.argv[1:])
