#!/usr/bin/env python3
"""asyncua against certificates of every kind: as a client that is judged, as one that judges, and as a server.

Takes orders from standard input, one line of JSON each, until its end: {"order": "attempt", "name": …}. Prints one line
of JSON for each thing that happens, with the name of the order. Exit code 3: a module this peer needs is missing.
"""

import asyncio
import json
import sys
from pathlib import Path

from peer import TIMEOUT_SECS, LastErrorMessage, outcome

from asyncua import Client, Server, ua
from asyncua.crypto import security_policies
from asyncua.crypto.truststore import TrustStore
from asyncua.crypto.validator import CertificateValidator, CertificateValidatorOptions


def tell(name, **what):
    print(json.dumps({"name": name, **what}), flush=True)


async def client_of(order):
    """A client with the certificate, key, issuers and application URI of an order, if it has them."""
    client = Client(order["url"], timeout=TIMEOUT_SECS)
    client.application_uri = order["uri"]
    if order["policy"] != "None":
        await client.set_security(
            getattr(security_policies, f"SecurityPolicy{order['policy']}"),
            order["certificate"],
            order["key"],
            mode=ua.MessageSecurityMode[order["mode"]],
            certificate_chain=order["chain"],
        )
    elif order["certificate"]:
        # Told in CreateSession all the same, as many clients do.
        await client.load_client_certificate(order["certificate"])
    if "judge" in order:
        store = TrustStore([Path(order["judge"]["trusted"])], [Path(order["judge"]["crls"])])
        await store.load()
        options = CertificateValidatorOptions.TRUSTED_VALIDATION | CertificateValidatorOptions.PEER_SERVER
        client.certificate_validator = CertificateValidator(options, store)
    return client


async def session(order):
    client = await client_of(order)
    async with client:
        status = await client.get_node(ua.ObjectIds.Server_ServerStatus).read_value()
        return {"ok": True, "state": status.State.name}


async def attempt(order):
    """A session that is closed again."""
    last_error.name_of_status = None
    tell(order["name"], **await outcome(session(order), last_error))


async def hold(order):
    """A session that stays open until the server ends it, without asking it for anything."""
    client = await client_of(order)
    await client.connect()
    protocol = client.uaclient.protocol
    pass_on = protocol.on_connection_lost

    def lost(exception):
        tell(order["name"], lost=True)
        if pass_on:
            pass_on(exception)

    protocol.on_connection_lost = lost
    kept.append(client)
    tell(order["name"], connected=True)


async def serve(order):
    """A server that takes any client."""
    server = Server()
    await server.init()
    server.set_endpoint("opc.tcp://127.0.0.1:0")
    await server.set_application_uri(order["uri"])
    server.set_security_policy([ua.SecurityPolicyType[policy] for policy in order["policies"]])
    await server.load_certificate(order["certificate"])
    await server.load_private_key(order["key"])
    await server.start()
    kept.append(server)
    tell(order["name"], port=server.bserver.port)


async def main():
    loop = asyncio.get_running_loop()
    while line := await loop.run_in_executor(None, sys.stdin.readline):
        order = json.loads(line)
        await {"attempt": attempt, "hold": hold, "serve": serve}[order["order"]](order)


last_error = LastErrorMessage.listen()
# Clients and servers that go on until the end.
kept = []
asyncio.run(main())
