use super::*;
use crate::pki::samples::{TestCa, now};

fn serial(number: u32) -> Vec<u8> {
    [&[0x40], &number.to_be_bytes()[..]].concat()
}

#[test]
fn a_list_says_what_its_authority_wrote() {
    let ca = TestCa::new("Plant CA");
    let crl = Crl::from_der(&ca.crl(4097, [serial(1), vec![0x80, 1], serial(2)])).unwrap();
    let summary = crl.summary();
    assert_eq!((summary.issuer.as_str(), summary.number.as_deref(), summary.entries), ("Plant CA", Some("4097"), 3));
    assert_eq!(summary.this_update, now() - chrono::Duration::days(1));
    assert_eq!(summary.next_update, Some(now() + chrono::Duration::days(30)));
    assert_eq!(summary.id, hex::encode_upper(Sha1::digest(crl.der())));
    assert_eq!(crl.authority_key_id(), ca.certificate.subject_key_id());
    assert_eq!(crl.unusable(), None);
    assert!(crl.verify_signed_by(&ca.certificate));
    let revoked = crl.revoked(&ca.application(&serial(2))).unwrap();
    assert_eq!(revoked.reason, RevocationReason::KeyCompromise);
    assert_eq!(revoked.date, now() - chrono::Duration::days(2));
    assert!(crl.revoked(&ca.application(&[0, 0x80, 1])).is_some(), "with the zero that keeps it positive");
    assert_eq!(crl.revoked(&ca.application(&serial(3))), None);

    let other = TestCa::new("Other CA");
    assert_eq!(crl.revoked(&other.application(&serial(2))), None, "the same number of another authority");
    assert!(!crl.verify_signed_by(&other.certificate));
}

#[test]
fn a_later_list_of_the_same_date_is_newer_by_number() {
    let (ca, other) = (TestCa::new("CA"), TestCa::new("CA"));
    let crl = |ca: &TestCa, number, revoked: Vec<Vec<u8>>| Crl::from_der(&ca.crl(number, revoked)).unwrap();
    let (one, two, long) = (crl(&ca, 255, vec![]), crl(&ca, 256, vec![]), crl(&ca, 255, vec![serial(1)]));
    assert!(two.is_newer_than(&one) && !one.is_newer_than(&two));
    assert!(!one.is_newer_than(&one) && !long.is_newer_than(&one), "the same number and date");
    assert!(one.has_same_scope_as(&two));
    assert!(!one.has_same_scope_as(&crl(&other, 1, vec![])), "the same name, but another key");
}

/// An authority that was set up anew, with the same key.
#[test]
fn a_list_whose_number_starts_again_is_newer_by_date() {
    let read = |der: &[u8]| Crl::from_der(der).unwrap();
    let before = read(include_bytes!("../../../tests/cases/12-crl-number-reset/crls/0.crl"));
    let after = read(include_bytes!("../../../tests/cases/12-crl-number-reset/crls/1.crl"));
    assert!(after.is_newer_than(&before) && !before.is_newer_than(&after) && after.has_same_scope_as(&before));
    assert_eq!(after.number_starts_again_after(&before), Some(("1".to_owned(), "500".to_owned())));
    assert_eq!(before.number_starts_again_after(&after), None);
    assert_eq!(before.number_and_date(), "number 500 of 2026-10-18T15:16:44Z");
}

#[test]
fn lists_of_10_000_and_100_000_entries_are_read_and_searched() {
    let ca = TestCa::new("Plant CA");
    for entries in [10_000, 100_000] {
        // Not in order, as in the file of a CA that never sorts.
        let der = ca.crl(1, (0..entries).map(|number: u32| serial(number.wrapping_mul(7919) % entries)));
        let crl = Crl::from_der(&der).unwrap();
        assert_eq!(crl.summary().entries, entries as usize);
        assert_eq!(crl.entries().count(), entries as usize);
        for number in [0, 1, entries / 2, entries - 1] {
            assert!(crl.revoked(&ca.application(&serial(number))).is_some(), "{number} of {entries}");
        }
        assert_eq!(crl.revoked(&ca.application(&serial(entries))), None);
        assert!(crl.verify_signed_by(&ca.certificate));
    }
}

#[test]
fn every_missing_end_and_every_damaged_byte_is_noticed() {
    let ca = TestCa::new("CA");
    let whole = ca.crl(1, [serial(1), serial(2)]);
    assert_eq!(Crl::from_der(b""), Err(PkiError::Empty));
    assert_eq!(Crl::from_der(&[whole.as_slice(), b"\0"].concat()), Err(PkiError::TrailingBytes(1)));
    for at in 0..whole.len() {
        assert!(Crl::from_der(&whole[..at]).is_err(), "first {at} bytes");
        for bit in 0..8 {
            let mut damaged = whole.clone();
            damaged[at] ^= 1 << bit;
            if let Ok(read) = Crl::from_der(&damaged) {
                assert!(!read.verify_signed_by(&ca.certificate), "byte {at} bit {bit}");
            }
        }
    }
}

#[test]
fn a_table_of_entries_that_cannot_be_read_is_not_an_empty_one() {
    let whole = TestCa::new("CA").crl(1, [serial(1), serial(2)]);
    let number = whole.windows(7).position(|window| window == [&[0x02, 5][..], &serial(1)].concat()).unwrap();
    for (at, tag) in [(number, 0x04), (number - 2, 0x31), (number - 4, 0x31)] {
        let mut damaged = whole.clone();
        damaged[at] = tag;
        assert!(matches!(Crl::from_der(&damaged), Err(PkiError::NotACrl(_))), "byte {at}");
    }
}

#[test]
fn too_large_is_refused_before_it_is_parsed() {
    let too_large = PkiError::TooLarge { bytes: MAX_CRL_BYTES + 1, max: MAX_CRL_BYTES };
    assert_eq!(Crl::from_der(&vec![0x30; MAX_CRL_BYTES + 1]), Err(too_large));
}
