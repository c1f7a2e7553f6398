//! What authorities say about names and policies below them (RFC 5280 §4.2.1.10 and §6.1).

use super::*;

const PERMITTED: u8 = 0xa0;
const EXCLUDED: u8 = 0xa1;
const EMAIL: u8 = 0x81;
const DIRECTORY: u8 = 0xa4;
const REGISTERED_ID: u8 = 0x88;

/// Tag and content of the base of a subtree.
type Base<'a> = (u8, &'a [u8]);

fn constraints(lists: &[(u8, &[Base<'_>])]) -> Extension {
    let lists: Vec<Vec<u8>> = lists
        .iter()
        .map(|(tag, bases)| {
            let subtrees: Vec<Vec<u8>> = bases.iter().map(|(tag, base)| seq(&[&tlv(*tag, &[base])])).collect();
            tlv(*tag, &subtrees.iter().map(Vec::as_slice).collect::<Vec<_>>())
        })
        .collect();
    Extension::new(NAME_CONSTRAINTS, true, seq(&lists.iter().map(Vec::as_slice).collect::<Vec<_>>()))
}

const V4_NET: &[u8] = &[192, 168, 10, 0, 255, 255, 255, 0];
const V6_NET: [u8; 32] = {
    let mut net = [0; 32];
    (net[0], net[1], net[16], net[17]) = (0xfe, 0x80, 0xff, 0xff);
    net
};

pub(super) fn names(table: &mut Table) {
    let invalid = Some(CertificateInvalid);
    let fleet = name_in(UTF8, &[(ORGANISATION, "Plant")]);
    let shouted = name_in(PRINTABLE, &[(ORGANISATION, "PLANT")]);
    let office = name_in(UTF8, &[(ORGANISATION, "Office")]);
    for (what, permitted, base, expected) in [
        ("the domain", PERMITTED, &[(DNS, b"plant.example" as &[u8])][..], None),
        ("the domain and a dot", PERMITTED, &[(DNS, b".plant.example")], None),
        ("the whole world", PERMITTED, &[(DNS, b"")], None),
        ("one of two domains", PERMITTED, &[(DNS, b"office.example"), (DNS, b"Plant.Example")], None),
        ("another domain", PERMITTED, &[(DNS, b"office.example")], invalid),
        ("a domain that ends alike", PERMITTED, &[(DNS, b"lant.example")], invalid),
        ("the host", EXCLUDED, &[(DNS, b"robot.plant.example")], invalid),
        ("another host", EXCLUDED, &[(DNS, b"hmi.plant.example")], None),
        ("both networks", PERMITTED, &[(IP, V4_NET), (IP, &V6_NET)], None),
        ("one of its networks", PERMITTED, &[(IP, V4_NET)], invalid),
        ("a network", EXCLUDED, &[(IP, V4_NET)], invalid),
        ("another network", EXCLUDED, &[(IP, &[10, 0, 0, 0, 255, 0, 0, 0])], None),
        ("URIs, and it has one without a host", PERMITTED, &[(URI, b"plant.example")], invalid),
        ("URIs, and it has one without a host", EXCLUDED, &[(URI, b"office.example")], invalid),
        ("its organisation", PERMITTED, &[(DIRECTORY, &fleet)], None),
        ("its organisation in other letters", PERMITTED, &[(DIRECTORY, &shouted)], None),
        ("another organisation", PERMITTED, &[(DIRECTORY, &office)], invalid),
        ("its organisation", EXCLUDED, &[(DIRECTORY, &fleet)], invalid),
        ("mail, of which it has none", PERMITTED, &[(EMAIL, b"plant.example")], None),
        ("identifiers, of which it has none", PERMITTED, &[(REGISTERED_ID, &[42, 3])], None),
    ] {
        let what = format!("{what} {}", if permitted == PERMITTED { "permitted" } else { "excluded" });
        for at in 1..=2 {
            table.one(&format!("{what} at {at}"), 3, expected, Agrees, |world| {
                world.certs[at].set(constraints(&[(permitted, base)]));
            });
        }
        table.one(&format!("{what}, not critical"), 3, expected, Agrees, |world| {
            world.certs[1].set(Extension { critical: false, ..constraints(&[(permitted, base)]) });
        });
    }
    for (what, name, base, expected) in [
        (
            "a URI in the domain",
            (URI, b"http://robot.plant.example/app" as &[u8]),
            (URI, b".plant.example" as &[u8]),
            None,
        ),
        ("a URI of the host", (URI, b"http://robot.plant.example"), (URI, b"robot.plant.example"), None),
        ("a URI of another host", (URI, b"http://robot.plant.example"), (URI, b"plant.example"), invalid),
        ("a mailbox of the host", (EMAIL, b"robot@plant.example"), (EMAIL, b"plant.example"), None),
        ("that mailbox", (EMAIL, b"robot@plant.example"), (EMAIL, b"robot@plant.example"), None),
        ("a mailbox of another host", (EMAIL, b"robot@hall.plant.example"), (EMAIL, b"plant.example"), invalid),
        ("an identifier", (REGISTERED_ID, &[42, 3]), (REGISTERED_ID, &[42, 3]), invalid),
    ] {
        table.one(&format!("{what} permitted"), 3, expected, Agrees, |world| {
            world.certs[0].set(alternative_names(&[name]));
            world.certs[1].set(constraints(&[(PERMITTED, &[base])]));
        });
    }
    table.one("constraints of two authorities, one of which forbids", 4, invalid, Agrees, |world| {
        world.certs[2].set(constraints(&[(PERMITTED, &[(DNS, b"office.example")])]));
        world.certs[1].set(constraints(&[(PERMITTED, &[(DNS, b"plant.example")])]));
    });
    table.one("permitted, and excluded again", 3, invalid, Agrees, |world| {
        let domain: &[(u8, &[u8])] = &[(DNS, b"plant.example")];
        world.certs[1].set(constraints(&[(PERMITTED, domain), (EXCLUDED, &[(DNS, b"robot.plant.example")])]));
    });
    table.one("an intermediate of another organisation", 4, invalid, Agrees, |world| {
        world.rename(1, &office);
        world.certs[2].set(constraints(&[(PERMITTED, &[(DIRECTORY, &fleet)])]));
    });
    table.one("constraints in the application's own certificate", 3, None, Agrees, |world| {
        world.certs[0].set(constraints(&[(PERMITTED, &[(DNS, b"office.example")])]));
    });
    for (what, value) in [
        ("a minimum of 1", seq(&[&tlv(PERMITTED, &[&seq(&[&tlv(DNS, &[b"plant.example"]), &tlv(0x80, &[&[1]])])])])),
        ("a network without a mask", seq(&[&tlv(PERMITTED, &[&seq(&[&tlv(IP, &[&[192, 168, 10, 1]])])])])),
        ("nothing behind the tag", vec![0x30, 3, PERMITTED]),
    ] {
        table.one(&format!("name constraints with {what}"), 3, invalid, Agrees, |world| {
            world.certs[1].set(Extension::new(NAME_CONSTRAINTS, true, value.clone()));
        });
    }
}

const NAME_CONSTRAINTS: &str = "2.5.29.30";
const ANY: &str = "2.5.29.32.0";
const ONE: &str = "1.3.6.1.4.1.99999.10";
const OTHER: &str = "1.3.6.1.4.1.99999.11";

fn policies(oids: &[&str]) -> Extension {
    let all: Vec<Vec<u8>> = oids.iter().map(|one| seq(&[&oid(one)])).collect();
    Extension::new("2.5.29.32", false, seq(&all.iter().map(Vec::as_slice).collect::<Vec<_>>()))
}

fn mapping(from: &str, to: &str) -> Extension {
    Extension::new("2.5.29.33", true, seq(&[&seq(&[&oid(from), &oid(to)])]))
}

fn require_policy(after: u8) -> Extension {
    Extension::new("2.5.29.36", true, seq(&[&tlv(0x80, &[&[after]])]))
}

fn require_policy_and_inhibit_mapping() -> Extension {
    Extension::new("2.5.29.36", true, seq(&[&tlv(0x80, &[&[0]]), &tlv(0x81, &[&[0]])]))
}

fn inhibit_any(after: u8) -> Extension {
    Extension::new("2.5.29.54", true, int(&[after]))
}

/// The policies, and the other extensions about them, of the application, the CA above it, and so on.
type Policies = (&'static str, &'static [&'static [&'static str]], Vec<(usize, Extension)>, Option<Status>);

pub(super) fn certificate_policies(table: &mut Table) {
    let invalid = Some(CertificateInvalid);
    let cases: Vec<Policies> = vec![
        ("no policy, and none is needed", &[&[], &[], &[]], vec![], None),
        ("policies that do not fit, and none is needed", &[&[ONE], &[OTHER], &[]], vec![], None),
        ("no policy, and one is needed", &[&[], &[], &[]], vec![(1, require_policy(0))], invalid),
        ("a policy, and one is needed", &[&[ONE], &[ONE], &[ONE]], vec![(1, require_policy(0))], None),
        ("a policy below any", &[&[ONE], &[ANY], &[ANY]], vec![(1, require_policy(0))], None),
        ("any policy below one", &[&[ANY], &[ONE], &[ONE]], vec![(1, require_policy(0))], None),
        ("a policy only in the application", &[&[ONE], &[], &[ANY]], vec![(1, require_policy(0))], invalid),
        ("another policy", &[&[OTHER], &[ONE], &[ONE]], vec![(1, require_policy(0))], invalid),
        ("one of two policies", &[&[OTHER], &[ONE, OTHER], &[ANY]], vec![(2, require_policy(0))], None),
        ("a policy needed later", &[&[], &[], &[]], vec![(2, require_policy(1))], invalid),
        ("a policy needed too late", &[&[], &[], &[]], vec![(2, require_policy(5))], None),
        ("a policy needed by the application itself", &[&[], &[], &[]], vec![(0, require_policy(0))], invalid),
        ("a policy needed by the root", &[&[], &[], &[]], vec![(3, require_policy(0))], None),
        ("a mapped policy", &[&[OTHER], &[ONE], &[ANY]], vec![(1, mapping(ONE, OTHER)), (2, require_policy(0))], None),
        (
            "a mapped policy by its old name",
            &[&[ONE], &[ONE], &[ANY]],
            vec![(1, mapping(ONE, OTHER)), (2, require_policy(0))],
            invalid,
        ),
        (
            "a policy mapped from any that is valid",
            &[&[OTHER], &[ANY], &[ANY]],
            vec![(1, mapping(ONE, OTHER)), (2, require_policy(0))],
            None,
        ),
        (
            "a mapping that is inhibited",
            &[&[OTHER], &[ONE], &[ONE]],
            vec![(1, mapping(ONE, OTHER)), (2, require_policy_and_inhibit_mapping())],
            invalid,
        ),
        ("a mapping of any policy", &[&[], &[ONE], &[ONE]], vec![(1, mapping(ANY, OTHER))], invalid),
        ("a mapping to any policy", &[&[], &[ONE], &[ONE]], vec![(2, mapping(ONE, ANY))], invalid),
        ("a critical mapping, and no policy is needed", &[&[], &[ONE], &[ONE]], vec![(1, mapping(ONE, OTHER))], None),
        (
            "any policy, which is inhibited",
            &[&[ONE], &[ANY], &[ONE]],
            vec![(2, inhibit_any(0)), (1, require_policy(0))],
            invalid,
        ),
        (
            "any policy, which is inhibited later",
            &[&[ONE], &[ANY], &[ONE]],
            vec![(2, inhibit_any(1)), (1, require_policy(0))],
            None,
        ),
        ("any policy inhibited, and none is needed", &[&[], &[ANY], &[ANY]], vec![(2, inhibit_any(0))], None),
    ];
    for (what, asserted, extensions, expected) in cases {
        table.one(what, 4, expected, Agrees, |world| {
            world.check_policies = true;
            for (at, oids) in asserted.iter().enumerate().filter(|(_, oids)| !oids.is_empty()) {
                world.certs[at].set(policies(oids));
            }
            for (at, extension) in &extensions {
                world.certs[*at].set(extension.clone());
            }
        });
    }
    table.one("a self-signed application that needs a policy", 1, None, Agrees, |world| {
        world.check_policies = true;
        world.certs[0].set(require_policy(0));
    });
}
