//! Dates, signatures, keys, and what a certificate is made of.

use super::*;

pub(super) fn good(table: &mut Table) {
    for length in 1..=10 {
        table.one("nothing is wrong", length, None, Agrees, |_| {});
    }
    for role in [PeerRole::Client, PeerRole::Server] {
        table.one(&format!("nothing is wrong with a {role:?}"), 3, None, Agrees, |world| world.role = role);
    }
    for policy in [Policy::None, Policy::Basic256Sha256, Policy::Aes128Sha256RsaOaep, Policy::Aes256Sha256RsaPss] {
        table.one(&format!("nothing is wrong for {policy}"), 3, None, Agrees, |world| {
            world.security_policy = Some(policy);
        });
    }
    table.one("eleven certificates", 11, Some(ChainIncomplete), Differs("OpenSSL follows chains further"), |_| {});
}

pub(super) fn dates(table: &mut Table) {
    let expired = |world: &mut World, at: usize| world.certs[at].not_after = now() - Duration::seconds(1);
    let future = |world: &mut World, at: usize| world.certs[at].not_before = now() + Duration::seconds(1);
    let time = || by_depth(TimeInvalid, IssuerTimeInvalid);
    table.everywhere("expired a second ago", 1..=4, expired, time(), agrees);
    table.everywhere("valid in a second", 1..=4, future, time(), agrees);
    table.everywhere(
        "ends this second",
        1..=3,
        |world, at| world.certs[at].not_after = now(),
        |_| None,
        |_, _| Differs("OpenSSL does not count the last second, RFC 5280 does"),
    );
    table.everywhere("begins this second", 1..=3, |world, at| world.certs[at].not_before = now(), |_| None, agrees);
    table.everywhere(
        "valid to the end of the century",
        1..=3,
        |world, at| world.certs[at].not_after = now() + Duration::days(20_000),
        |_| None,
        agrees,
    );
    table.everywhere("dates with four digits", 1..=3, |world, at| world.certs[at].generalized = true, |_| None, agrees);
    table.everywhere(
        "expired, which is allowed",
        1..=3,
        move |world, at| {
            expired(world, at);
            world.policy.allow_expired_certificates = true;
        },
        |_| None,
        |_, _| Differs("it was told to be allowed"),
    );
    table.everywhere(
        "ends before it begins",
        1..=3,
        |world, at| world.certs[at].not_after = now() - Duration::days(400),
        |_| Some(CertificateInvalid),
        agrees,
    );
}

pub(super) fn signatures(table: &mut Table) {
    let last_bit: fn(&mut Vec<u8>) = |bytes| *bytes.last_mut().unwrap() ^= 1;
    fn shorter(bytes: &mut Vec<u8>) {
        bytes.pop();
    }
    let invalid = |_| Some(CertificateInvalid);
    table.everywhere(
        "a damaged signature",
        1..=4,
        |world, at| world.certs[at].damage = Some(last_bit),
        invalid,
        except_root,
    );
    table.everywhere(
        "a shortened signature",
        1..=3,
        |world, at| world.certs[at].damage = Some(shorter),
        invalid,
        except_root,
    );
    table.everywhere(
        "signed by a stranger",
        1..=4,
        |world, at| world.certs[at].signer = &keys().stranger,
        invalid,
        except_root,
    );
    for algorithm in [Algorithm::Sha384, Algorithm::Sha512, Algorithm::Pss] {
        table.everywhere(
            &format!("signed with {algorithm:?}"),
            1..=3,
            move |world, at| world.certs[at].algorithm = algorithm,
            |_| None,
            agrees,
        );
    }
    for (curve, key) in [("P-256", &keys().p256), ("P-384", &keys().p384)] {
        for at in 1..=2 {
            table.one(&format!("a CA with a {curve} key at {at}"), 3, None, Agrees, |world| world.rekey(at, key));
        }
        table.one(&format!("a damaged ECDSA signature, {curve}"), 3, Some(CertificateInvalid), Agrees, |world| {
            world.rekey(1, key);
            world.certs[0].damage = Some(last_bit);
        });
    }
    table.everywhere(
        "another algorithm outside than inside",
        1..=1,
        |world, at| world.certs[at].other_algorithm = Some(Algorithm::Sha384),
        invalid,
        except_root,
    );
    table.one("another algorithm outside than inside", 3, Some(CertificateInvalid), Agrees, |world| {
        world.certs[0].other_algorithm = Some(Algorithm::Sha384);
    });
}

pub(super) fn strength(table: &mut Table) {
    let weak = |_| Some(PolicyCheckFailed);
    let legacy = [Policy::Basic128Rsa15, Policy::Basic256];
    let sha1 = |world: &mut World, at: usize| world.certs[at].algorithm = Algorithm::Sha1;
    table.everywhere("signed with SHA-1", 1..=4, sha1, weak, except_root);
    for policy in legacy {
        table.everywhere(
            &format!("signed with SHA-1 for {policy}"),
            1..=3,
            move |world, at| {
                sha1(world, at);
                world.security_policy = Some(policy);
            },
            |_| None,
            agrees,
        );
    }
    table.everywhere(
        "signed with SHA-1, which is allowed",
        1..=3,
        move |world, at| {
            sha1(world, at);
            world.policy.allow_sha1 = true;
        },
        |_| None,
        agrees,
    );
    table.everywhere(
        "signed with MD5 for a legacy policy",
        1..=3,
        |world, at| {
            world.certs[at].algorithm = Algorithm::Md5;
            world.security_policy = Some(Policy::Basic256);
            world.policy.allow_sha1 = true;
        },
        weak,
        except_root,
    );
    let short = |at: usize| if at == 0 { &keys().leaf_1024 } else { &keys().rsa_1024 };
    table.everywhere("a 1024-bit key", 1..=4, |world, at| world.rekey(at, short(at)), weak, agrees);
    for policy in legacy {
        table.everywhere(
            &format!("a 1024-bit key for {policy}"),
            1..=3,
            move |world, at| {
                world.rekey(at, short(at));
                world.security_policy = Some(policy);
            },
            |_| None,
            agrees,
        );
        table.one(
            &format!("a 4096-bit key for {policy}"),
            2,
            Some(PolicyCheckFailed),
            Differs("OpenSSL knows no longest key"),
            |world| {
                world.rekey(0, &keys().leaf_4096);
                world.security_policy = Some(policy);
            },
        );
        table.one(&format!("a CA with a 4096-bit key for {policy}"), 3, None, Agrees, |world| {
            world.rekey(1, &keys().leaf_4096);
            world.security_policy = Some(policy);
        });
    }
    table.one("a 1024-bit key signing with SHA-384", 3, None, Agrees, |world| {
        world.rekey(1, &keys().rsa_1024);
        world.certs[0].algorithm = Algorithm::Sha384;
        world.security_policy = Some(Policy::Basic256);
    });
    table.one("a 4096-bit key", 2, None, Agrees, |world| world.rekey(0, &keys().leaf_4096));
    for length in 1..=3 {
        table.one("an application with an elliptic key", length, Some(PolicyCheckFailed), NO_OPC_UA, |world| {
            world.rekey(0, &keys().leaf_ec);
        });
    }
    table.one("an RSA key with the exponent 1", 2, Some(PolicyCheckFailed), NO_OPC_UA, |world| {
        let modulus = [&[0][..], &[0xd5; 256]].concat();
        let public = seq(&[&int(&modulus), &int(&[1])]);
        let algorithm = seq(&[&oid("1.2.840.113549.1.1.1"), &[5, 0]]);
        world.certs[0].info = Some(seq(&[&algorithm, &super::super::der::bits(&public)]));
    });
}

pub(super) fn structure(table: &mut Table) {
    let invalid = |_| Some(CertificateInvalid);
    let unknown = |critical| Extension::new(UNKNOWN, critical, vec![5, 0]);
    table.everywhere(
        "a critical extension nobody knows",
        1..=4,
        move |world, at| world.certs[at].set(unknown(true)),
        invalid,
        agrees,
    );
    table.everywhere(
        "an extension nobody knows",
        1..=3,
        move |world, at| world.certs[at].set(unknown(false)),
        |_| None,
        agrees,
    );
    table.everywhere(
        "damaged basic constraints",
        1..=3,
        |world, at| world.certs[at].set(Extension::new(BASIC_CONSTRAINTS, true, vec![0x30, 5, 1])),
        invalid,
        agrees,
    );
    table.everywhere(
        "a damaged key usage",
        1..=3,
        |world, at| world.certs[at].set(Extension::new(KEY_USAGE, true, vec![0x04, 1, 0xff])),
        invalid,
        agrees,
    );
    table.everywhere(
        "critical certificate policies",
        1..=3,
        |world, at| {
            let any = seq(&[&seq(&[&oid("2.5.29.32.0")])]);
            world.certs[at].set(Extension::new("2.5.29.32", true, any));
        },
        |_| None,
        agrees,
    );
    for length in 1..=3 {
        table.one("the same extension twice", length, Some(CertificateInvalid), Agrees, |world| {
            let again = world.certs[0].extensions[1].clone();
            world.certs[0].extensions.push(again);
        });
        table.one("a truncated certificate", length, Some(CertificateInvalid), Agrees, |world| {
            world.damage_leaf = Some(|der| der.truncate(der.len() / 2));
        });
        table.one("no bytes at all", length, Some(CertificateInvalid), Agrees, |world| {
            world.damage_leaf = Some(Vec::clear);
        });
        table.one("a damaged alternative name", length, Some(CertificateInvalid), NO_OPC_UA, |world| {
            world.certs[0].set(alternative_names(&[(URI, b"urn:\xff\xfe")]));
        });
    }
}
