//! Who is trusted, who was sent, and what to do if there are several chains.

use super::*;

pub(super) fn trust(table: &mut Table) {
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

pub(super) fn several_chains(table: &mut Table) {
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
