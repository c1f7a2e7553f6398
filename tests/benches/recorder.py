"""The motion logs of several controllers, read by asyncua and taken apart by NumPy, for recorder.rs.

    recorder.py FOLDER SECONDS URL…

FOLDER holds own.der and own.pem of a client that the controllers trust. Reads what the recorder reads, in the way of the
manual's sample program (4.3.2) with the pace of the recorder, and forgets the columns. Prints one line of JSON.
"""

import asyncio
import json
import logging
import sys
import time

import numpy as np
from asyncua import Client, ua

import records

logging.disable(logging.CRITICAL)
TICKS_PER_SECOND = 80_000_000
TICKS_PER_BLOCK = 8 * TICKS_PER_SECOND // 2000


async def record(folder, url, seconds):
    client = Client(url, timeout=60)
    client.application_uri = "urn:client"
    await client.set_security_string(f"Basic256Sha256,SignAndEncrypt,{folder}/own.der,{folder}/own.pem")
    blocks, missing, first, last = 0, 0, None, None
    async with client:
        data_num = client.get_node("ns=1;i=20313")
        sampling_interval = client.get_node("ns=1;i=20314")
        data = client.get_node("ns=1;i=20316")
        monitor_status = client.get_node("ns=1;i=20317")
        data_exists = client.get_node("ns=1;i=20318")
        error_status = client.get_node("ns=1;i=20319")
        await sampling_interval.write_value(0, ua.VariantType.UInt16)
        await data_num.write_value(0, ua.VariantType.UInt16)
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            _, exists, _ = await client.read_values([monitor_status, data_exists, error_status])
            while exists == "Ready" and time.monotonic() < end:
                _, packet, exists = await client.read_values([error_status, data, data_exists])
                if not packet:
                    break
                columns = records.motion(np.frombuffer(packet, records.block))
                stamps = columns[0][::8].astype(np.int64)
                steps = np.diff(stamps if last is None else np.concatenate([[last], stamps]))
                missing += int((steps // TICKS_PER_BLOCK - 1).sum())
                first = stamps[0] if first is None else first
                last = stamps[-1]
                blocks += len(stamps)
            await asyncio.sleep(0.01)
    return blocks, missing, (int(last) - int(first)) / TICKS_PER_SECOND


async def main(folder, seconds, *urls):
    told = await asyncio.gather(*(record(folder, url, float(seconds)) for url in urls))
    blocks, missing, spans = zip(*told)
    print(json.dumps({"blocks": blocks, "missing": missing, "seconds": spans}))


asyncio.run(main(*sys.argv[1:]))
