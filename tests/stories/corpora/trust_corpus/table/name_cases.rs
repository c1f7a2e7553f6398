//! Names and serial numbers as real software writes them.

use super::*;

pub(super) fn names_and_serials(table: &mut Table) {
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
        seq(&[&super::super::der::set(&[&seq(&[&oid(COMMON_NAME), &value])])])
    };
    table.everywhere("a name in Latin-1", 2..=3, |world, at| world.rename(at, &latin), |_| None, agrees);
    let several = {
        let one = seq(&[&oid(COMMON_NAME), &tlv(UTF8, &[b"CA"])]);
        let other = seq(&[&oid(ORGANISATION), &tlv(UTF8, &[b"Plant"])]);
        seq(&[&super::super::der::set(&[&one, &other])])
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
