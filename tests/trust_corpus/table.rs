//! Every case: what is wrong, what OPC UA says of it, and what OpenSSL says.

use chrono::Duration;
use opcua_configurator::model::CertificateStatus::{self as Status, *};
use opcua_configurator::model::SecurityPolicy as Policy;
use opcua_configurator::pki::{Role, TrustPolicy};

use super::der::{boolean, int, oid, seq, tlv};
use super::forge::{Algorithm, *};
use super::world::{APPLICATION_URI, Ask, World, authority, issue, world};

pub struct Case {
    pub name: String,
    pub world: World,
    /// `None` is Good.
    pub expected: Option<Status>,
    pub peer: Peer,
}

/// What OpenSSL says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Peer {
    /// Good is good and bad is bad.
    Agrees,
    /// The opposite, rightly.
    Differs(&'static str),
}
use Peer::{Agrees, Differs};

#[derive(Default)]
struct Table(Vec<Case>);

impl Table {
    fn add(&mut self, name: impl Into<String>, world: World, expected: Option<Status>, peer: Peer) {
        self.0.push(Case { name: name.into(), world, expected, peer });
    }

    /// The same change to the world of every length at every position it makes sense at.
    fn everywhere(
        &mut self,
        what: &str,
        lengths: std::ops::RangeInclusive<usize>,
        change: impl Fn(&mut World, usize),
        expected: impl Fn(usize) -> Option<Status>,
        peer: impl Fn(&World, usize) -> Peer,
    ) {
        for length in lengths {
            for at in 0..length {
                let mut world = world(length);
                change(&mut world, at);
                let peer = peer(&world, at);
                self.add(format!("{what}, at {at} of {length}"), world, expected(at), peer);
            }
        }
    }

    fn one(&mut self, what: &str, length: usize, expected: Option<Status>, peer: Peer, change: impl Fn(&mut World)) {
        let mut world = world(length);
        change(&mut world);
        self.add(format!("{what} (of {length})"), world, expected, peer);
    }
}

const NOT_A_ROOTS: Peer = Differs("OpenSSL does not look at the signature a trusted root makes for itself");
const NO_OPC_UA: Peer = Differs("OpenSSL does not know what OPC UA asks of an application");

pub fn cases() -> Vec<Case> {
    let mut table = Table::default();
    good(&mut table);
    dates(&mut table);
    signatures(&mut table);
    strength(&mut table);
    structure(&mut table);
    names_and_serials(&mut table);
    trust(&mut table);
    several_chains(&mut table);
    usages(&mut table);
    hosts_and_uris(&mut table);
    revocations(&mut table);
    missing_lists(&mut table);
    bad_lists(&mut table);
    table.0
}

fn by_depth(leaf: Status, issuer: Status) -> impl Fn(usize) -> Option<Status> {
    move |at| Some(if at == 0 { leaf } else { issuer })
}

fn agrees(_: &World, _: usize) -> Peer {
    Agrees
}

fn except_root(world: &World, at: usize) -> Peer {
    if at == world.root() { NOT_A_ROOTS } else { Agrees }
}

fn good(table: &mut Table) {
    for length in 1..=10 {
        table.one("nothing is wrong", length, None, Agrees, |_| {});
    }
    for role in [Role::Client, Role::Server] {
        table.one(&format!("nothing is wrong with a {role:?}"), 3, None, Agrees, |world| world.role = role);
    }
    for policy in [Policy::None, Policy::Basic256Sha256, Policy::Aes128Sha256RsaOaep, Policy::Aes256Sha256RsaPss] {
        table.one(&format!("nothing is wrong for {policy}"), 3, None, Agrees, |world| {
            world.security_policy = Some(policy);
        });
    }
    table.one("eleven certificates", 11, Some(ChainIncomplete), Differs("OpenSSL follows chains further"), |_| {});
}

fn dates(table: &mut Table) {
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

fn signatures(table: &mut Table) {
    fn last_bit(bytes: &mut Vec<u8>) {
        *bytes.last_mut().unwrap() ^= 1;
    }
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

fn strength(table: &mut Table) {
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
        world.certs[0].info = Some(seq(&[&algorithm, &super::der::bits(&public)]));
    });
}

fn structure(table: &mut Table) {
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
    for at in 1..=2 {
        let unsupported = Differs("OpenSSL supports name constraints, and these are kept");
        table.one(&format!("name constraints at {at}"), 3, Some(CertificateInvalid), unsupported, |world| {
            let subtree = seq(&[&tlv(DNS, &[b"plant.example"])]);
            let value = seq(&[&tlv(0xa0, &[&subtree])]);
            world.certs[at].set(Extension::new("2.5.29.30", true, value));
        });
        let unsupported = Differs("OpenSSL looks at policies only if it is told to");
        table.one(&format!("critical policy constraints at {at}"), 3, Some(CertificateInvalid), unsupported, |world| {
            world.certs[at].set(Extension::new("2.5.29.36", true, seq(&[&tlv(0x80, &[&[0]])])));
        });
    }
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

fn names_and_serials(table: &mut Table) {
    for (what, serial) in [
        ("a negative serial number", &[0x9a, 1, 2][..]),
        ("the serial number 0", &[0]),
        ("a serial number of 20 bytes", &[0x7f; 20]),
        ("a serial number of 30 bytes", &[0x55; 30]),
    ] {
        table.everywhere(what, 1..=3, |world, at| world.certs[at].serial = serial.to_vec(), |_| None, agrees);
        for at in 0..2 {
            let revoked = by_depth(Revoked, IssuerRevoked)(at);
            table.one(&format!("{what}, revoked, at {at}"), 3, revoked, Agrees, |world| {
                world.certs[at].serial = serial.to_vec();
                world.lists[at].entries.push(Entry::new(serial));
            });
        }
    }
    let renamed = |world: &mut World, at: usize, subject: &[u8], issuer: &[u8]| {
        world.rename(at, subject);
        world.certs[at - 1].issuer = issuer.to_vec();
    };
    let plain = [(ORGANISATION, "Plant of Robots"), (COMMON_NAME, "The CA")];
    for (what, issuer) in [
        ("another string type", name_in(PRINTABLE, &plain)),
        ("another case", name_in(UTF8, &[(ORGANISATION, "PLANT of robots"), (COMMON_NAME, "the ca")])),
        ("other spaces", name_in(UTF8, &[(ORGANISATION, "  Plant  of   Robots "), (COMMON_NAME, "The CA")])),
    ] {
        for at in 1..=2 {
            table.one(&format!("the issuer's name in {what} at {at}"), 3, None, Agrees, |world| {
                renamed(world, at, &name_in(UTF8, &plain), &issuer);
            });
        }
    }
    for (what, issuer) in [
        ("another order", name_in(UTF8, &[(COMMON_NAME, "The CA"), (ORGANISATION, "Plant of Robots")])),
        ("one part less", name_in(UTF8, &[(COMMON_NAME, "The CA")])),
        ("one part more", name_in(UTF8, &[plain[0], plain[1], (COMMON_NAME, "The CA")])),
        ("another kind of part", name_in(UTF8, &[("2.5.4.11", "Plant of Robots"), (COMMON_NAME, "The CA")])),
    ] {
        for at in 1..=2 {
            table.one(&format!("the issuer's name in {what} at {at}"), 3, Some(ChainIncomplete), Agrees, |world| {
                renamed(world, at, &name_in(UTF8, &plain), &issuer);
            });
        }
    }
    let domain = "0.9.2342.19200300.100.1.25";
    let repeated = name_in(0x16, &[(domain, "example"), (domain, "plant"), (domain, "plant")]);
    table.everywhere(
        "the same attribute several times",
        2..=3,
        |world, at| world.rename(at, &repeated),
        |_| None,
        agrees,
    );
    let latin = {
        let value = tlv(0x14, &[b"Gr\xf6\xdfe"]);
        seq(&[&super::der::set(&[&seq(&[&oid(COMMON_NAME), &value])])])
    };
    table.everywhere("a name in Latin-1", 2..=3, |world, at| world.rename(at, &latin), |_| None, agrees);
    let several = {
        let one = seq(&[&oid(COMMON_NAME), &tlv(UTF8, &[b"CA"])]);
        let other = seq(&[&oid(ORGANISATION), &tlv(UTF8, &[b"Plant"])]);
        seq(&[&super::der::set(&[&one, &other])])
    };
    table.everywhere("a name with two parts in one", 2..=3, |world, at| world.rename(at, &several), |_| None, agrees);
    for at in 1..=2 {
        table.one(
            &format!("another key identifier than the issuer's at {at}"),
            3,
            Some(ChainIncomplete),
            Agrees,
            |world| {
                world.certs[at - 1].set(authority_key_id(&[7; 20]));
            },
        );
        table.one(&format!("no key identifiers at {at}"), 3, None, Agrees, |world| {
            world.certs[at].drop(SUBJECT_KEY_ID);
            world.certs[at - 1].drop(AUTHORITY_KEY_ID);
            world.lists[at - 1].drop(AUTHORITY_KEY_ID);
        });
    }
}

fn trust(table: &mut Table) {
    for length in 1..=4 {
        table.one(
            "nothing is trusted",
            length,
            Some(if length == 1 { Untrusted } else { ChainIncomplete }),
            Agrees,
            |world| {
                world.trusted.clear();
            },
        );
        if length > 1 {
            table.one("everything is only an issuer", length, Some(Untrusted), Agrees, |world| {
                world.trusted.clear();
                world.issuers = (1..length).collect();
            });
            table.one("everything was only sent", length, Some(Untrusted), Agrees, |world| {
                (world.trusted, world.issuers) = (vec![], vec![]);
                world.sent = (1..length).collect();
            });
            table.one("the application is only an issuer", length, Some(Untrusted), Agrees, |world| {
                world.trusted.clear();
                world.issuers = (0..length).collect();
            });
            let anchor = Differs("OpenSSL takes only self-signed certificates for the end of a chain");
            table.one("the application itself is trusted", length, None, anchor, |world| {
                world.trusted = vec![0];
                world.issuers = (1..length).collect();
            });
            table.one("the root is missing", length, Some(ChainIncomplete), Agrees, |world| {
                world.trusted = (1..length - 1).collect();
                world.issuers.clear();
            });
        }
    }
    for missing in 1..3 {
        table.one(&format!("the CA at {missing} is missing"), 4, Some(ChainIncomplete), Agrees, |world| {
            world.issuers.retain(|at| *at != missing);
        });
        table.one(&format!("the CA at {missing} was sent"), 4, None, Agrees, |world| {
            world.issuers.retain(|at| *at != missing);
            world.sent = vec![missing];
        });
        table.one(&format!("the CA at {missing} is trusted, the root an issuer"), 4, None, Agrees, |world| {
            (world.trusted, world.issuers) = (vec![missing], (1..4).filter(|at| *at != missing).collect());
            world.ask = Ask::PartialChain;
        });
        table.one(&format!("the CA at {missing} is trusted, the rest was sent"), 4, None, Agrees, |world| {
            (world.trusted, world.issuers) = (vec![missing], vec![]);
            world.sent = vec![3, 2, 1, 0];
            world.ask = Ask::PartialChain;
        });
    }
    for sent in [vec![1, 2], vec![2, 1], vec![0, 1, 2, 3], vec![3, 2, 1], vec![1, 1, 2, 2]] {
        table.one(&format!("the chain was sent as {sent:?}"), 4, None, Agrees, |world| {
            world.issuers.clear();
            world.sent.clone_from(&sent);
        });
    }
    table.one("a trusted application without its issuers", 3, Some(ChainIncomplete), Agrees, |world| {
        (world.trusted, world.issuers) = (vec![0], vec![]);
    });
    table.one("a trusted application without its issuers, which is allowed", 3, None, Agrees, |world| {
        (world.trusted, world.issuers) = (vec![0], vec![]);
        world.policy.allow_incomplete_chain = true;
        world.lists.clear();
        world.ask = Ask::PartialChain;
    });
    table.0.last_mut().unwrap().world.ask = Ask::NoLists;
    table.0.last_mut().unwrap().peer = Differs("OpenSSL needs -partial_chain for it");
    table.one("an untrusted application without its issuers", 3, Some(ChainIncomplete), Agrees, |world| {
        (world.trusted, world.issuers) = (vec![], vec![]);
        world.policy.allow_incomplete_chain = true;
    });
    table.one(
        "an expired root above a trusted CA",
        3,
        Some(IssuerTimeInvalid),
        Differs("it ends at the trusted CA"),
        |world| {
            (world.trusted, world.issuers) = (vec![1], vec![2]);
            world.certs[2].not_after = now() - Duration::days(1);
            world.ask = Ask::PartialChain;
        },
    );
    table.one("a self-signed application that somebody else trusts", 1, Some(Untrusted), Agrees, |world| {
        let other = authority(&world.certs[0].subject, &keys().stranger);
        world.trusted.clear();
        world.more_trusted.push(other.der());
    });
    table.one("a self-signed application that calls itself a CA", 1, None, Agrees, |world| {
        world.certs[0].set(basic_constraints(true, None));
        world.certs[0].set(key_usage(&[0, 1, 2, 3, 5, 6]));
    });
}

fn several_chains(table: &mut Table) {
    /// A CA of the same name with another key.
    fn namesake(of: &Cert) -> Cert {
        authority(&of.subject, &keys().stranger)
    }
    table.one("another root of the same name stands first", 3, None, Agrees, |world| {
        let other = namesake(&world.certs[2]);
        world.more_trusted.push(other.der());
    });
    table.one("another CA of the same name was sent", 3, None, Agrees, |world| {
        let other = namesake(&world.certs[1]);
        world.more_sent.push(other.der());
    });
    for without_ids in [false, true] {
        let change = |world: &mut World| {
            let other = namesake(&world.certs[1]);
            world.issuers.clear();
            world.more_trusted.push(other.der());
            if without_ids {
                world.certs[0].drop(AUTHORITY_KEY_ID);
            }
        };
        let expected = if without_ids { CertificateInvalid } else { ChainIncomplete };
        table.one(&format!("only a namesake of the issuer is there, {without_ids}"), 3, Some(expected), Agrees, change);
    }
    table.one("the issuer was renewed, and the old one stands first", 3, None, Agrees, |world| {
        let mut old = world.certs[1].clone();
        old.not_after = now() - Duration::days(1);
        old.serial = vec![0x44];
        world.more_issuers.push(old.der());
    });
    table.one(
        "the issuer was renewed, and the old one was revoked",
        3,
        None,
        Differs("OpenSSL tries one chain"),
        |world| {
            let mut old = world.certs[1].clone();
            old.serial = vec![0x44];
            // The valid one of the two that is valid longer is OpenSSL's choice, and the revoked one is.
            old.not_after = now() + Duration::days(700);
            world.lists[1].entries.push(Entry::new(&[0x44]));
            world.more_issuers.push(old.der());
        },
    );
    let one_chain = Differs("OpenSSL tries one chain");
    table.one("two roots have certified the same CA, one is trusted", 3, None, one_chain, |world| {
        let other_root = authority(&name("Other Root"), &keys().stranger);
        let mut crossed = world.certs[1].clone();
        issue(&mut crossed, &other_root);
        world.more_issuers.push(crossed.der());
        world.more_lists.push(List::of(&other_root).der());
    });
    table.one("two roots have certified the same CA, the other one is trusted", 3, None, Agrees, |world| {
        let other_root = authority(&name("Other Root"), &keys().stranger);
        let mut crossed = world.certs[1].clone();
        issue(&mut crossed, &other_root);
        world.trusted.clear();
        world.more_trusted.push(other_root.der());
        world.more_issuers.push(crossed.der());
        world.more_lists.push(List::of(&other_root).der());
    });
    table.one("two CAs certify each other, and nobody them", 2, Some(ChainIncomplete), Agrees, |world| {
        let (mut one, mut other) = (world.certs[1].clone(), authority(&name("Other CA"), &keys().stranger));
        issue(&mut one, &other);
        issue(&mut other, &world.certs[1]);
        world.trusted.clear();
        world.more_trusted.push(other.der());
        world.more_issuers.push(one.der());
    });
    table.one("twenty namesakes were sent", 3, None, Agrees, |world| {
        let mut other = namesake(&world.certs[1]);
        other.drop(SUBJECT_KEY_ID);
        for number in 0..20 {
            other.serial = vec![0x20, number];
            world.more_sent.push(other.der());
        }
    });
    table.one("a root got a new key, and signed it with the old one", 3, None, Agrees, |world| {
        let old = world.certs[2].clone();
        world.rekey(2, &keys().stranger);
        let mut link = world.certs[2].clone();
        issue(&mut link, &old);
        world.trusted.clear();
        world.more_trusted.push(old.der());
        world.more_issuers.push(link.der());
        world.more_lists.push(List::of(&old).der());
        world.lists[1].drop(AUTHORITY_KEY_ID);
        world.lists[1].extensions.push(authority_key_id(&keys().stranger.id));
    });
}

fn usages(table: &mut Table) {
    for (left_out, what) in
        [(0, "digitalSignature"), (1, "nonRepudiation"), (2, "keyEncipherment"), (3, "dataEncipherment")]
    {
        for length in 1..=2 {
            let peer = if left_out == 0 { Agrees } else { NO_OPC_UA };
            table.one(&format!("no {what}"), length, Some(UseNotAllowed), peer, |world| {
                let rest: Vec<u8> = (0..4).filter(|number| *number != left_out).collect();
                world.certs[0].set(key_usage(&rest));
                world.role = Role::Client;
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
        (Role::Client, &[CLIENT_AUTH][..], None),
        (Role::Server, &[SERVER_AUTH], None),
        (Role::Client, &[ANY_USAGE], None),
        (Role::Server, &[CODE_SIGNING, SERVER_AUTH], None),
        (Role::Client, &[SERVER_AUTH], Some(UseNotAllowed)),
        (Role::Server, &[CLIENT_AUTH], Some(UseNotAllowed)),
        (Role::Client, &[CODE_SIGNING], Some(UseNotAllowed)),
        (Role::Server, &[CODE_SIGNING], Some(UseNotAllowed)),
        (Role::Either, &[CLIENT_AUTH], None),
        (Role::Either, &[SERVER_AUTH], None),
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

fn hosts_and_uris(table: &mut Table) {
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
                world.role = Role::Server;
            });
        }
    }
    table.one("reached with a dot at the end", 2, None, Differs("OpenSSL compares the dot"), |world| {
        world.host = Some("robot.plant.example.");
    });
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

fn revocations(table: &mut Table) {
    for length in 2..=4 {
        for at in 0..length - 1 {
            let expected = by_depth(Revoked, IssuerRevoked)(at);
            let revoke = move |world: &mut World, reason: Option<u8>| {
                let serial = world.certs[at].serial.clone();
                world.lists[at].entries.push(Entry { reason, ..Entry::new(&serial) });
            };
            for reason in [None, Some(0), Some(1), Some(2), Some(3), Some(4), Some(5), Some(6), Some(9), Some(10)] {
                if length == 3 || reason.is_none() {
                    table.one(&format!("revoked at {at} for {reason:?}"), length, expected, Agrees, |world| {
                        revoke(world, reason);
                    });
                }
            }
            table.one(&format!("not revoked any more at {at}"), length, None, Agrees, |world| revoke(world, Some(8)));
            table.one(&format!("revoked at {at} among many"), length, expected, Agrees, |world| {
                let many = (0..200u8).map(|number| Entry::new(&[0x60, number]));
                world.lists[at].entries.extend(many);
                revoke(world, Some(1));
            });
            table.one(&format!("others are revoked at {at}"), length, None, Agrees, |world| {
                world.lists[at].entries.extend((0..200u8).map(|number| Entry::new(&[0x60, number])));
            });
            table.one(
                &format!("revoked at {at}, though unknown revocation is allowed"),
                length,
                expected,
                Agrees,
                |world| {
                    revoke(world, None);
                    world.policy.allow_unknown_revocation = true;
                },
            );
            table.one(&format!("revoked at {at} in an expired list"), length, expected, Agrees, |world| {
                revoke(world, None);
                world.lists[at].next_update = Some(now() - Duration::hours(1));
                world.policy.allow_unknown_revocation = true;
            });
            table.one(
                &format!("revoked at {at} in a delta list beside a whole one"),
                length,
                expected,
                Agrees,
                |world| {
                    let mut delta = world.lists[at].clone();
                    delta.this_update += Duration::hours(1);
                    delta.entries.push(Entry::new(&world.certs[at].serial));
                    delta.extensions.push(Extension::new("2.5.29.27", true, int(&[1])));
                    world.more_lists.push(delta.der());
                },
            );
            for newer_revokes in [false, true] {
                let expected = if newer_revokes { expected } else { None };
                table.one(
                    &format!("a newer list beside it, revoked at {at}: {newer_revokes}"),
                    length,
                    expected,
                    Agrees,
                    |world| {
                        let mut newer = world.lists[at].clone();
                        newer.this_update += Duration::hours(1);
                        let entry = Entry { reason: Some(6), ..Entry::new(&world.certs[at].serial) };
                        let list = if newer_revokes { &mut newer } else { &mut world.lists[at] };
                        list.entries.push(entry);
                        world.more_lists.push(newer.der());
                    },
                );
            }
        }
    }
    table.one("the same serial number of another CA is revoked", 3, None, Agrees, |world| {
        let serial = world.certs[0].serial.clone();
        world.lists[1].entries.push(Entry::new(&serial));
    });
    table.one(
        "revoked twice, once taken back",
        2,
        Some(Revoked),
        Differs("OpenSSL looks at the first entry"),
        |world| {
            let serial = world.certs[0].serial.clone();
            world.lists[0].entries.push(Entry { reason: Some(8), ..Entry::new(&serial) });
            world.lists[0].entries.push(Entry { reason: Some(1), ..Entry::new(&serial) });
        },
    );
    table.one("revoked below, unknown above", 3, Some(Revoked), Agrees, |world| {
        let serial = world.certs[0].serial.clone();
        world.lists[0].entries.push(Entry::new(&serial));
        world.lists.pop();
    });
    table.one("unknown below, revoked above", 3, Some(IssuerRevoked), Agrees, |world| {
        let serial = world.certs[1].serial.clone();
        world.lists[1].entries.push(Entry::new(&serial));
        world.lists.remove(0);
    });
}

fn missing_lists(table: &mut Table) {
    for length in 2..=4 {
        for at in 0..length - 1 {
            let unknown = by_depth(RevocationUnknown, IssuerRevocationUnknown)(at);
            table.one(&format!("no list for {at}"), length, unknown, Agrees, |world| {
                world.lists.remove(at);
            });
            table.one(
                &format!("no list for {at}, which is allowed"),
                length,
                None,
                Differs("it was told to be allowed"),
                |world| {
                    world.lists.remove(at);
                    world.policy.allow_unknown_revocation = true;
                },
            );
        }
    }
    for length in 2..=3 {
        table.one("no lists at all, which is allowed", length, None, Agrees, |world| {
            world.lists.clear();
            world.policy = TrustPolicy { allow_unknown_revocation: true, ..TrustPolicy::default() };
            world.ask = Ask::NoLists;
        });
    }
}

/// Lists that must not be believed when they say nothing.
fn bad_lists(table: &mut Table) {
    fn last_bit(bytes: &mut Vec<u8>) {
        *bytes.last_mut().unwrap() ^= 1;
    }
    fn point(tag: u8, content: &[u8]) -> Extension {
        Extension::new(DISTRIBUTION_POINT, true, seq(&[&tlv(tag, &[content])]))
    }
    let partitions = Differs("OpenSSL knows partitions, and this one is about such certificates");
    for length in 2..=3 {
        for at in 0..length - 1 {
            let unknown = by_depth(RevocationUnknown, IssuerRevocationUnknown)(at);
            let mut bad = |what: &str, peer, change: &dyn Fn(&mut List)| {
                table.one(&format!("{what} for {at}"), length, unknown, peer, |world| change(&mut world.lists[at]));
            };
            bad("a list that expired a second ago", Agrees, &|list| {
                list.next_update = Some(now() - Duration::seconds(1))
            });
            bad("a list of tomorrow", Agrees, &|list| list.this_update = now() + Duration::days(1));
            let timeless = Differs("OpenSSL lets a list without an end be valid for ever");
            bad("a list without an end", timeless, &|list| list.next_update = None);
            bad("a list with a damaged signature", Agrees, &|list| list.damage = Some(last_bit));
            bad("a list signed by a stranger", Agrees, &|list| list.signer = &keys().stranger);
            let weak = Differs("OpenSSL does not ask how a list is signed");
            bad("a list signed with SHA-1", weak, &|list| list.algorithm = Algorithm::Sha1);
            bad("a list signed with MD5", Agrees, &|list| list.algorithm = Algorithm::Md5);
            bad("a list of another CA", Agrees, &|list| list.issuer = name("Another CA"));
            bad("a list of another key", Agrees, &|list| {
                list.drop(AUTHORITY_KEY_ID);
                list.extensions.push(authority_key_id(&[9; 20]));
            });
            let delta = Differs("OpenSSL takes a delta list for a whole one, unless it is told about them");
            bad("a delta list", delta, &|list| list.extensions.push(Extension::new("2.5.29.27", true, int(&[1]))));
            bad("an indirect list", Agrees, &|list| list.extensions.push(point(0x84, &[0xff])));
            // The root's list is about the root as well, which is no application but a CA.
            let of_users = if at == 0 && length > 2 { partitions } else { Agrees };
            bad("a list only about applications", of_users, &|list| list.extensions.push(point(0x81, &[0xff])));
            let of_cas = if at == 0 { Agrees } else { partitions };
            bad("a list only about CAs", of_cas, &|list| list.extensions.push(point(0x82, &[0xff])));
            bad("a list only about attribute certificates", Agrees, &|list| list.extensions.push(point(0x85, &[0xff])));
            bad("a list only about some reasons", Agrees, &|list| list.extensions.push(point(0x83, &[6, 0x40])));
            bad("a list of one distribution point", Agrees, &|list| {
                let uri = tlv(0x86, &[b"http://plant.example/1.crl"]);
                list.extensions.push(point(0xa0, &tlv(0xa0, &[&uri])));
            });
            bad("a list with a critical extension nobody knows", Agrees, &|list| {
                list.extensions.push(Extension::new(UNKNOWN, true, boolean(true)));
            });
            bad("a list with an entry with a critical extension nobody knows", Agrees, &|list| {
                let extensions = vec![Extension::new(UNKNOWN, true, boolean(true))];
                list.entries.push(Entry { extensions, ..Entry::new(&[0x33]) });
            });
            table.one(&format!("an issuer that may not sign lists, for {at}"), length, unknown, Agrees, |world| {
                world.certs[at + 1].set(key_usage(&[5]));
            });
            table.one(
                &format!("an expired list for {at}, which is allowed"),
                length,
                None,
                Differs("it was told to be allowed"),
                |world| {
                    world.lists[at].next_update = Some(now() - Duration::days(1));
                    world.policy.allow_expired_crls = true;
                },
            );
            table.one(&format!("a bad list beside a good one for {at}"), length, None, Agrees, |world| {
                let forged = List { signer: &keys().stranger, ..world.lists[at].clone() };
                world.more_lists.push(forged.der());
            });
            table.one(&format!("an expired list beside a good one for {at}"), length, None, Agrees, |world| {
                let mut old = world.lists[at].clone();
                old.this_update -= Duration::days(60);
                old.next_update = Some(now() - Duration::days(30));
                world.more_lists.push(old.der());
            });
            table.one(
                &format!("a list signed with SHA-1 for {at}, for a legacy policy"),
                length,
                None,
                Agrees,
                |world| {
                    world.lists[at].algorithm = Algorithm::Sha1;
                    world.security_policy = Some(Policy::Basic256);
                },
            );
        }
    }
}
