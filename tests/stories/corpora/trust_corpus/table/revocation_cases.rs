//! Revocation lists: what they say, that they are missing, and that they must not be believed.

use super::*;

pub(super) fn revocations(table: &mut Table) {
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
                Changed { merged: NO_DELTA_AS_A_WHOLE, before: &Agrees, after: &NEW_DELTAS },
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

pub(super) fn missing_lists(table: &mut Table) {
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
pub(super) fn bad_lists(table: &mut Table) {
    let last_bit: fn(&mut Vec<u8>) = |bytes| *bytes.last_mut().unwrap() ^= 1;
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
            let delta = Changed { merged: NO_DELTA_AS_A_WHOLE, before: &OLD_DELTAS, after: &Agrees };
            bad("a delta list", delta, &|list| list.extensions.push(Extension::new("2.5.29.27", true, int(&[1]))));
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
