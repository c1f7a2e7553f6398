#!/usr/bin/env python3
"""fins-driver reads and writes a PLC over UDP; prints one line of JSON about it.

    fins_driver.py check HOST PORT      writes and reads words, bits, several areas; fill, transfer, multiple read, an error
    fins_driver.py bench HOST PORT N    N reads of one word, then of 500; seconds of each
"""

import json
import sys
import time

from fins import FinsClient


def connect(host, port):
    client = FinsClient(host=host, port=int(port), timeout=5, mode="udp")
    client.sa1 = 1
    client.connect()
    return client


def check(host, port):
    client = connect(host, port)
    found = {}

    def ok(name, response):
        found[name] = response.code.hex()
        return response.data

    ok("write", client.memory_area_write("D300", b"\x01\x41\xff\xff", 2))
    found["words"] = ok("read", client.memory_area_read("D300", 2)).hex()
    ok("write bits", client.memory_area_write("CIO0.14", b"\x01\x00", 2))
    found["bits"] = ok("read bits", client.memory_area_read("CIO0.14", 2)).hex()
    ok("fill", client.memory_area_fill("W10", b"\xab\xcd", 3))
    ok("transfer", client.memory_area_transfer("W10", "H20", 3))
    found["transferred"] = ok("read transferred", client.memory_area_read("H20", 3)).hex()
    several = ok("read several", client.multiple_memory_area_read("D300", "CIO0.14", "H20"))
    found["several"] = [bytes(value).hex() for value in several]
    ok("read-only", client.memory_area_write("A0", b"\x00\x01", 1))
    ok("beyond", client.memory_area_read("W512", 1))
    ok("stop", client.stop())
    ok("run", client.run("run"))
    client.close()
    return found


def bench(host, port, reads):
    client = connect(host, port)
    seconds = []
    for words in (1, 500):
        start = time.perf_counter()
        for _ in range(int(reads)):
            response = client.memory_area_read("D0", words)
            assert response.ok and len(response.data) == 2 * words
        seconds.append(time.perf_counter() - start)
    client.close()
    return {"reads": int(reads), "one": seconds[0], "many": seconds[1]}


if __name__ == "__main__":
    if sys.argv[1:] == ["--help"]:
        print(__doc__)
    else:
        command, *arguments = sys.argv[1:]
        print(json.dumps({"check": check, "bench": bench}[command](*arguments)))
