#!/usr/bin/env python3
"""An OPC UA client that nobody of this project wrote: FreeOpcUa's asyncua.

Each command prints one line of JSON on standard output. What a server refuses is an answer, {"ok": false, "error": …},
with exit code 0. Exit code 3: a module this peer needs is missing.
"""

import argparse
import asyncio
import datetime
import hashlib
import json
import logging
import sys
from pathlib import Path

try:
    from asyncua import Client, ua
    from asyncua.crypto import security_policies
    from cryptography import x509
    from cryptography.hazmat.primitives import hashes, serialization
    from cryptography.hazmat.primitives.asymmetric import rsa
    from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID
except ImportError as missing:
    print(missing, file=sys.stderr)
    sys.exit(3)

TIMEOUT_SECS = 10


class LastErrorMessage(logging.Handler):
    """The status of the ERR message a server sent last: asyncua writes it into its log and nowhere else."""

    name_of_status = None

    @classmethod
    def listen(cls):
        logger = logging.getLogger("asyncua")
        logger.addHandler(handler := cls())
        logger.setLevel(logging.ERROR)
        logger.propagate = False
        return handler

    def emit(self, record):
        for argument in record.args or ():
            if isinstance(argument, ua.ErrorMessage):
                self.name_of_status = argument.Error.name


def make_certificate(args):
    """A client's own key and self-signed certificate, as OPC 10000-6 §6.2.2 wants them."""
    key = rsa.generate_private_key(public_exponent=65537, key_size=args.bits)
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, args.name)])
    now = datetime.datetime.now(datetime.timezone.utc)
    key_id = x509.SubjectKeyIdentifier.from_public_key(key.public_key())
    usage = dict.fromkeys(
        ("digital_signature", "content_commitment", "key_encipherment", "data_encipherment", "key_cert_sign"), True
    ) | dict.fromkeys(("key_agreement", "crl_sign", "encipher_only", "decipher_only"), False)
    certificate = (
        x509.CertificateBuilder()
        .subject_name(name)
        .issuer_name(name)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(now - datetime.timedelta(hours=1))
        .not_valid_after(now + datetime.timedelta(days=30))
        .add_extension(
            x509.SubjectAlternativeName([x509.UniformResourceIdentifier(args.uri), x509.DNSName("localhost")]), False
        )
        .add_extension(x509.BasicConstraints(ca=False, path_length=None), True)
        .add_extension(x509.KeyUsage(**usage), True)
        .add_extension(x509.ExtendedKeyUsage([ExtendedKeyUsageOID.CLIENT_AUTH]), False)
        .add_extension(key_id, False)
        .add_extension(x509.AuthorityKeyIdentifier.from_issuer_subject_key_identifier(key_id), False)
        .sign(key, hashes.SHA256())
    )
    args.certificate.write_bytes(certificate.public_bytes(serialization.Encoding.DER))
    args.key.write_bytes(
        key.private_bytes(
            serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
        )
    )
    return {"ok": True, "sha1": certificate.fingerprint(hashes.SHA1()).hex().upper()}


async def endpoints(args):
    """What GetEndpoints offers, and the server's certificate as it comes over the wire."""
    found = await Client(args.url, timeout=TIMEOUT_SECS).connect_and_get_server_endpoints()
    certificate = next((e.ServerCertificate for e in found if e.ServerCertificate), None)
    if args.save_certificate and certificate:
        args.save_certificate.write_bytes(certificate)
    return {
        "ok": True,
        "application_uri": found[0].Server.ApplicationUri,
        "application_name": found[0].Server.ApplicationName.Text,
        "endpoints": [
            {
                "url": e.EndpointUrl,
                "policy": e.SecurityPolicyUri.rsplit("#", 1)[-1].replace("_", ""),
                "mode": e.SecurityMode.name.rstrip("_"),
                "tokens": sorted({t.TokenType.name for t in e.UserIdentityTokens}),
            }
            for e in found
        ],
        "certificate_sha256": hashlib.sha256(certificate).hexdigest() if certificate else None,
    }


async def session(args):
    """Opens a session, reads and browses what every server has, and closes it."""
    client = Client(args.url, timeout=TIMEOUT_SECS)
    if args.user:
        client.set_user(args.user)
        client.set_password(args.password_file.read_text(encoding="utf-8").rstrip("\r\n"))
    if args.policy != "None":
        certificate = x509.load_der_x509_certificate(args.certificate.read_bytes())
        names = certificate.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
        client.application_uri = names.get_values_for_type(x509.UniformResourceIdentifier)[0]
        await client.set_security(
            getattr(security_policies, f"SecurityPolicy{args.policy}"),
            str(args.certificate),
            str(args.key),
            mode=ua.MessageSecurityMode[args.mode],
        )
    await client.connect()
    try:
        status = await client.get_node(ua.ObjectIds.Server_ServerStatus).read_value()
        children = {(await node.read_browse_name()).Name: node for node in await client.nodes.objects.get_children()}
        device_set = children.get("DeviceSet")
        return {
            "ok": True,
            "state": status.State.name,
            "clock": status.CurrentTime.isoformat(),
            "namespaces": await client.get_namespace_array(),
            "servers": await client.get_node(ua.ObjectIds.Server_ServerArray).read_value(),
            "objects": sorted(children),
            "devices": [(await n.read_browse_name()).Name for n in await device_set.get_children()] if device_set else [],
        }
    finally:
        await client.disconnect()


async def outcome(work, last_error):
    """What came of talking to a server, within a minute; a refusal by name."""
    try:
        return await asyncio.wait_for(work, 60)
    except ua.UaStatusCodeError as refused:
        return {"ok": False, "error": type(refused).__name__, "detail": str(refused)}
    except ConnectionRefusedError as refused:
        return {"ok": False, "error": "ConnectionRefused", "detail": str(refused)}
    except (ua.UaError, OSError, asyncio.TimeoutError) as failed:
        return {"ok": False, "error": last_error.name_of_status or type(failed).__name__, "detail": str(failed)}


def answer(args):
    last_error = LastErrorMessage.listen()
    if args.command == "certificate":
        return make_certificate(args)
    return asyncio.run(outcome({"endpoints": endpoints, "session": session}[args.command](args), last_error))


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)

    certificate = commands.add_parser("certificate", help=make_certificate.__doc__)
    certificate.add_argument("--uri", required=True)
    certificate.add_argument("--name", required=True)
    certificate.add_argument("--bits", type=int, default=2048)
    certificate.add_argument("--certificate", type=Path, required=True)
    certificate.add_argument("--key", type=Path, required=True)

    offered = commands.add_parser("endpoints", help=endpoints.__doc__)
    offered.add_argument("--url", required=True)
    offered.add_argument("--save-certificate", type=Path)

    opened = commands.add_parser("session", help=session.__doc__)
    opened.add_argument("--url", required=True)
    opened.add_argument("--policy", default="None")
    opened.add_argument("--mode", default="SignAndEncrypt", choices=["Sign", "SignAndEncrypt"])
    opened.add_argument("--certificate", type=Path)
    opened.add_argument("--key", type=Path)
    opened.add_argument("--user")
    opened.add_argument("--password-file", type=Path)
    return parser.parse_args()


if __name__ == "__main__":
    print(json.dumps(answer(arguments())))
