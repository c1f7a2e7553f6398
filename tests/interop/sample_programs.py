#!/usr/bin/env python3
"""The two sample programs of the manual (4.1.2.3 and 4.3.2) with asyncua, in their steps and with their node ids.

Each saves what it decodes: a line a record, with the numbers in the order of the manual's tables (4.1.3, 4.3.3) without
reserved fields, joined by commas; texts as the hexadecimal digits of their bytes. Exit code 3: asyncua is missing.

    sample_programs.py force URL FILE
    sample_programs.py motion URL FILE READS     ends after so many reads, where the manual's program never does
"""

import asyncio
import json
import struct
import sys

try:
    from asyncua import Client, ua
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(3)

TIME = "hBBBBBh"
COMMON = "BBH2xBBBB"
LABELS = "hB32sBB10sB32shB32shB32s"
HEADER = struct.Struct(f"<{COMMON}{TIME}ff{LABELS}B64sBB32sB32sBQ")
DATA = struct.Struct(f"<BBH2xH2xBBBBII8f6f6f3f4f6f6BBI{TIME}BBh")
FOOTER = struct.Struct(f"<{COMMON}{TIME}ff{LABELS}bhBx")


def plain(values):
    """A text with its length becomes the digits of the bytes it has."""
    told = []
    for value in values:
        told.append(value[: told.pop()].hex() if isinstance(value, bytes) else value)
    return told


def decode_force(packet):
    if packet[0] == 2:
        return [list(record) for record in DATA.iter_unpack(packet)]
    return [plain((HEADER if packet[0] == 1 else FOOTER).unpack(packet))]


def samples(block, offset, layout, count=8):
    size = struct.calcsize(layout)
    return [value for at in range(count) for value in struct.unpack_from(layout, block, offset + at * size)]


def counts(bits, places):
    """18-bit numbers, whose bits 2 to 17 and bits 0 and 1 lie at these places, in two's complement."""
    told = []
    for high, low in places:
        number = (bits >> high & 0xFFFF) << 2 | bits >> low & 3
        told.append(number - (1 << 18) if number >> 17 else number)
    return told


def force_sensor(block):
    six = int.from_bytes(block[2432 + 12 : 2432 + 30], "little")
    sixteen = int.from_bytes(block[2432 + 32 : 2432 + 72], "little")
    told = list(struct.unpack_from("<Q", block, 2432))
    told += counts(six, zip(range(0, 96, 16), (96, 98, 100, 104, 106, 108)))
    told += struct.unpack_from("<h", block, 2432 + 12 + 14)
    for element in range(0, 288, 72):
        told += counts(sixteen, [(element + axis * 16, element + 64 + axis * 2) for axis in range(4)])
    told += struct.unpack_from("<h", block, 2432 + 32 + 36)
    return told


def decode_motion(packet):
    decoded = []
    for start in range(0, len(packet), 2608):
        block = packet[start : start + 2608]
        record = []
        for axis in range(6):
            record += samples(block, axis * 192, "<QqIb3x")
        for axis in range(6):
            record += samples(block, 1152 + axis * 160, "<Q2xhhHh2x")
        record += samples(block, 2112, "<QB3xB3x")
        record += samples(block, 2240, "<Q8xII")
        record += force_sensor(block)
        record += samples(block, 2504, "<QIIII", 1)
        record += samples(block, 2528, "<Q9d", 1)
        decoded.append(record)
    return decoded


async def force(client, file):
    # Get node object
    node_data_type = client.get_node("ns=1;i=196611")  # DataType Node
    node_data_num = client.get_node("ns=1;i=196612")  # DataNum Node
    node_port = client.get_node("ns=1;i=196609")  # Port Node
    node_data_exists_status = client.get_node("ns=1;i=196867")  # DataExistsStatus Node
    node_monitor_status = client.get_node("ns=1;i=196866")  # MonitorStatus Node
    node_data = client.get_node("ns=1;i=196865")  # Data Node

    # Setup necessary settings
    await node_data_type.write_value(0, ua.VariantType.UInt16)  # set DataType
    await node_data_num.write_value(1000, ua.VariantType.UInt16)  # set DataNum
    await node_port.write_value(True)  # set Port
    print("ready", flush=True)

    # Start data collection
    while await node_monitor_status.read_value() != "Run":  # wait to RecordStart
        await asyncio.sleep(0.1)  # wait 100ms

    while True:  # loop for collect data
        while await node_data_exists_status.read_value() != "Ready":  # wait to data Exists
            await asyncio.sleep(0.1)  # wait 100ms

        binary_data = await node_data.read_value()  # read force sensor data
        decoded_data = decode_force(binary_data)  # decode binary data to readable format
        file.writelines(",".join(map(str, record)) + "\n" for record in decoded_data)  # write data to file

        if binary_data[0] == 0x4:  # if Footer received,
            break  # then end loop


async def motion(client, file, reads):
    # Get node object
    node_data_num = client.get_node("ns=1;i=20313")  # DataNum Node
    node_sampling_interval = client.get_node("ns=1;i=20314")  # SamplingInterval Node
    node_data = client.get_node("ns=1;i=20316")  # Data Node
    node_data_exists_status = client.get_node("ns=1;i=20318")  # DataExistsStatus Node

    # Setup necessary settings
    await node_data_num.write_value(0, ua.VariantType.UInt16)  # set DataNum
    await node_sampling_interval.write_value(0, ua.VariantType.UInt16)  # set SamplingInterval
    print("ready", flush=True)

    # Start data collection
    for _ in range(reads):  # loop for collect data
        while await node_data_exists_status.read_value() != "Ready":  # wait to data Exists
            await asyncio.sleep(0.01)  # wait 10ms

        binary_data = await node_data.read_value()  # read MotionLog data
        decoded_data = decode_motion(binary_data)  # decode binary data to readable format
        file.writelines(",".join(map(str, record)) + "\n" for record in decoded_data)  # write data to file


async def main(program, url, output, *reads):
    async with Client(url, timeout=60) as client:  # Create OPC UA Client Instance, connect to OPC UA Server
        with open(output, "w", encoding="utf-8") as file:
            await (force(client, file) if program == "force" else motion(client, file, int(reads[0])))
    print(json.dumps({"ok": True}))


asyncio.run(main(*sys.argv[1:]))
