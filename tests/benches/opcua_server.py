"""asyncua's server with as many nodes as asked for, for opcua_server.rs: FOLDER NODES VARIABLES.

FOLDER holds own.der and own.pem. Prints one line of JSON: the address, how many nodes there are, and VARIABLES nodes to
be read. Runs until it is ended.
"""

import asyncio
import json
import logging
import sys

from asyncua import Server, ua

logging.disable(logging.CRITICAL)


async def main(folder, nodes, variables):
    server = Server()
    await server.init()
    server.set_endpoint("opc.tcp://127.0.0.1:0/")
    server.set_security_policy(
        [ua.SecurityPolicyType.NoSecurity, ua.SecurityPolicyType.Basic256Sha256_SignAndEncrypt]
    )
    await server.set_application_uri("urn:server")
    await server.load_certificate(f"{folder}/own.der")
    await server.load_private_key(f"{folder}/own.pem")
    space = await server.register_namespace("urn:bench")
    held = server.iserver.aspace.keys
    number, group = 0, None
    while len(held()) < nodes or number < variables:
        if number % 100 == 0:
            name = f"Group{number}"
            group = await server.nodes.objects.add_object(ua.NodeId(name, space), f"{space}:{name}")
        name = f"Value{number}"
        await group.add_variable(ua.NodeId(name, space), f"{space}:{name}", number * 0.5)
        number += 1
    async with server:
        told = {
            "url": f"opc.tcp://127.0.0.1:{server.bserver.port}/",
            "nodes": len(held()),
            "variables": [f"ns={space};s=Value{number}" for number in range(variables)],
        }
        print(json.dumps(told), flush=True)
        await asyncio.Event().wait()


asyncio.run(main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3])))
