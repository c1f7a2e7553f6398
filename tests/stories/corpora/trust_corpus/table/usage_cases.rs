//! What a certificate is for: usages, hosts and application URIs.

use super::*;

pub(super) fn usages(table: &mut Table) {
    for (left_out, what) in
        [(0, "digitalSignature"), (1, "nonRepudiation"), (2, "keyEncipherment"), (3, "dataEncipherment")]
    {
        for length in 1..=2 {
            let peer = if left_out == 0 { Agrees } else { NO_OPC_UA };
            table.one(&format!("no {what}"), length, Some(UseNotAllowed), peer, |world| {
                let rest: Vec<u8> = (0..4).filter(|number| *number != left_out).collect();
                world.certs[0].set(key_usage(&rest));
                world.role = PeerRole::Client;
            });
            table.one(&format!("no {what}, which is allowed"), length, None, Agrees, |world| {
                let rest: Vec<u8> = (0..4).filter(|number| *number != left_out).collect();
                world.certs[0].set(key_usage(&rest));
                world.policy.allow_any_usage = true;
            });
        }
    }
    for length in 1..=3 {
        table.one("no key usage", length, Some(UseNotAllowed), NO_OPC_UA, |world| world.certs[0].drop(KEY_USAGE));
        table.one("no extended key usage", length, None, Agrees, |world| world.certs[0].drop(EXTENDED_KEY_USAGE));
    }
    for (role, purposes, expected) in [
        (PeerRole::Client, &[CLIENT_AUTH][..], None),
        (PeerRole::Server, &[SERVER_AUTH], None),
        (PeerRole::Client, &[ANY_USAGE], None),
        (PeerRole::Server, &[CODE_SIGNING, SERVER_AUTH], None),
        (PeerRole::Client, &[SERVER_AUTH], Some(UseNotAllowed)),
        (PeerRole::Server, &[CLIENT_AUTH], Some(UseNotAllowed)),
        (PeerRole::Client, &[CODE_SIGNING], Some(UseNotAllowed)),
        (PeerRole::Server, &[CODE_SIGNING], Some(UseNotAllowed)),
        (PeerRole::Either, &[CLIENT_AUTH], None),
        (PeerRole::Either, &[SERVER_AUTH], None),
    ] {
        for length in 1..=2 {
            let is_any = purposes == [ANY_USAGE];
            let peer = if is_any { Differs("OpenSSL's purposes do not count anyExtendedKeyUsage") } else { Agrees };
            table.one(&format!("a {role:?} for {purposes:?}"), length, expected, peer, |world| {
                world.certs[0].set(extended_key_usage(purposes));
                world.role = role;
            });
        }
        if purposes != [ANY_USAGE] {
            let expected = expected.map(|_| IssuerUseNotAllowed);
            for at in 1..=2 {
                table.one(&format!("a CA at {at} for {purposes:?}, a {role:?}"), 3, expected, Agrees, |world| {
                    world.certs[at].set(extended_key_usage(purposes));
                    world.role = role;
                });
            }
        }
    }
    for length in 2..=3 {
        table.one("a CA as an application", length, Some(UseNotAllowed), NO_OPC_UA, |world| {
            world.certs[0].set(basic_constraints(true, None));
            world.certs[0].set(key_usage(&[0, 1, 2, 3, 5, 6]));
        });
    }
    for length in 2..=4 {
        for at in 1..length {
            let is_root = at == length - 1;
            let mut issuer = |what: &str, peer, change: &dyn Fn(&mut Cert)| {
                table.one(&format!("{what} at {at}"), length, Some(IssuerUseNotAllowed), peer, |world| {
                    change(&mut world.certs[at]);
                });
            };
            issuer("an issuer that is no CA", Agrees, &|cert| cert.set(basic_constraints(false, None)));
            let guess = if is_root { Differs("OpenSSL takes a root with keyCertSign for a CA") } else { Agrees };
            issuer("an issuer without basic constraints", guess, &|cert| cert.drop(BASIC_CONSTRAINTS));
            issuer("an issuer without keyCertSign", Agrees, &|cert| cert.set(key_usage(&[0, 6])));
            let old = if is_root { Differs("OpenSSL takes roots of version 1") } else { Agrees };
            issuer("an issuer of version 1", old, &|cert| {
                cert.version = 0;
                cert.extensions.clear();
            });
            if at > 1 {
                issuer("an issuer with too many CAs below it", Agrees, &|cert| {
                    cert.set(basic_constraints(true, Some(at as u8 - 2)));
                });
            }
            table.one(
                &format!("an issuer with as many CAs below it as it allows at {at}"),
                length,
                None,
                Agrees,
                |world| {
                    world.certs[at].set(basic_constraints(true, Some(at as u8 - 1)));
                },
            );
            table.one(&format!("a CA without key usages at {at}"), length, None, Agrees, |world| {
                world.certs[at].drop(KEY_USAGE);
            });
        }
    }
    table.one("an application issued by an application", 3, Some(IssuerUseNotAllowed), Agrees, |world| {
        world.certs[1].set(basic_constraints(false, None));
        world.certs[1].set(key_usage(&[0, 1, 2, 3]));
    });
}

pub(super) fn hosts_and_uris(table: &mut Table) {
    for (host, expected) in [
        ("robot.plant.example", None),
        ("ROBOT.Plant.Example", None),
        ("192.168.10.1", None),
        ("fe80::1", None),
        ("fe80:0:0:0:0:0:0:1", None),
        ("robot", Some(HostNameInvalid)),
        ("other.plant.example", Some(HostNameInvalid)),
        ("plant.example", Some(HostNameInvalid)),
        ("192.168.10.2", Some(HostNameInvalid)),
        ("fe80::2", Some(HostNameInvalid)),
    ] {
        for length in 1..=2 {
            table.one(&format!("reached as {host}"), length, expected, Agrees, |world| {
                world.host = Some(host);
                world.role = PeerRole::Server;
            });
        }
    }
    table.one("reached with a dot at the end", 2, None, Differs("OpenSSL compares the dot"), |world| {
        world.host = Some("robot.plant.example.");
    });
    for host in ["192.168.10.1", "::1"] {
        table.one(&format!("reached as {host}, a DNS name there"), 2, Some(HostNameInvalid), Agrees, |world| {
            world.certs[0].set(alternative_names(&[(DNS, host.as_bytes())]));
            world.host = Some(host);
            world.role = PeerRole::Server;
        });
    }
    table.one("for every host", 2, Some(HostNameInvalid), Differs("there are no wildcards in OPC UA"), |world| {
        world.certs[0].set(alternative_names(&[(DNS, b"*.plant.example")]));
        world.host = Some("robot.plant.example");
    });
    table.one("for no host", 2, Some(HostNameInvalid), Agrees, |world| {
        world.certs[0].drop(ALTERNATIVE_NAME);
        world.host = Some("robot.plant.example");
    });
    for (what, names, expected) in [
        ("the right URI", &[(URI, APPLICATION_URI.as_bytes())][..], None),
        ("another URI", &[(URI, b"urn:plant:other" as &[u8])], Some(UriInvalid)),
        ("the right URI in another case", &[(URI, b"URN:plant:application")], Some(UriInvalid)),
        ("a longer URI", &[(URI, b"urn:plant:application2")], Some(UriInvalid)),
        ("the right URI as a DNS name", &[(DNS, APPLICATION_URI.as_bytes())], Some(UriInvalid)),
        ("no URI", &[(DNS, b"robot")], Some(UriInvalid)),
        ("the right URI first", &[(URI, APPLICATION_URI.as_bytes()), (URI, b"urn:x")], None),
        ("the right URI second", &[(URI, b"urn:x"), (URI, APPLICATION_URI.as_bytes())], Some(UriInvalid)),
    ] {
        for length in 1..=2 {
            let peer = if expected.is_none() { Agrees } else { NO_OPC_UA };
            table.one(what, length, expected, peer, |world| {
                world.certs[0].set(alternative_names(names));
                world.uri = Some(APPLICATION_URI);
            });
        }
    }
}
