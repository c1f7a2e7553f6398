use super::*;
use crate::pki::pem;
use crate::pki::samples::{self, TestCa};

/// 1.2.840.113549.1.7
const PKCS7: &[u8] = &[0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7];

struct Sample {
    ca: TestCa,
    application: Certificate,
    crl: Vec<u8>,
}

fn sample() -> Sample {
    let ca = TestCa::new("Plant CA");
    Sample { application: ca.application(&[0x11, 1]), crl: ca.crl(1, [vec![0x11, 2]]), ca }
}

/// The signed data around nothing, as `openssl crl2pkcs7` writes it.
fn pkcs7(certificates: &[&[u8]], crls: &[&[u8]]) -> Vec<u8> {
    let oid = |last: u8| tlv::write(OBJECT_IDENTIFIER, &[PKCS7, &[last]]);
    let signed = tlv::write(
        tlv::SEQUENCE,
        &[
            &tlv::write(0x02, &[&[1]]),
            &tlv::write(SET, &[]),
            &tlv::write(tlv::SEQUENCE, &[&oid(1)]),
            &tlv::write(tlv::CONTEXT_0, certificates),
            &tlv::write(CONTEXT_1, crls),
            &tlv::write(SET, &[]),
        ],
    );
    tlv::write(tlv::SEQUENCE, &[&oid(2), &tlv::write(tlv::CONTEXT_0, &[&signed])])
}

#[test]
fn every_form_holds_the_same() {
    let Sample { ca, application, crl } = sample();
    let p7b = pkcs7(&[application.der(), ca.certificate.der()], &[&crl]);
    let pem_crl = pem::armour("X509 CRL", &crl);
    let expected = Bundle {
        certificates: vec![application.clone(), ca.certificate.clone()],
        crls: vec![Crl::from_der(&crl).unwrap()],
    };
    for bytes in [
        [application.der(), ca.certificate.der(), &crl].concat(),
        [&crl, application.der(), ca.certificate.der()].concat(),
        (application.to_pem() + &ca.certificate.to_pem() + &pem_crl).into_bytes(),
        (String::from("Certificate:\n    Version: 3\n")
            + &application.to_pem()
            + "CA\n"
            + &pem_crl
            + &ca.certificate.to_pem())
            .replace('\n', "\r\n")
            .into_bytes(),
        (application.to_pem() + &application.to_pem() + &ca.certificate.to_pem() + &pem_crl).into_bytes(),
        p7b.clone(),
        [&[0x30, 0x80], &p7b[4..], &[0, 0]].concat(),
        pem::armour("CERTIFICATE", &p7b).into_bytes(),
        pem::armour("PKCS7", &p7b).into_bytes(),
        ["\u{feff}".as_bytes(), pem::armour("CMS", &p7b).as_bytes()].concat(),
    ] {
        assert_eq!(read_bundle(&bytes).as_ref(), Ok(&expected));
    }
}

#[test]
fn what_does_not_belong_there_is_refused_by_its_name() {
    let Sample { application, crl, .. } = sample();
    let key = samples::key().to_pkcs8_der().unwrap();
    let with = |label: &str, der: &[u8]| (application.to_pem() + &pem::armour(label, der)).into_bytes();
    let p7b = pkcs7(&[application.der()], &[]);
    let other = |found| PkiError::OtherContent { found, wanted: Wanted::TrustMaterial };
    for (bytes, expected) in [
        (vec![], PkiError::Empty),
        (b"hello, robot".to_vec(), PkiError::NotTrustMaterial),
        (key.to_vec(), PkiError::PrivateKeyInside),
        (with("PRIVATE KEY", &key), PkiError::PrivateKeyInside),
        (with("ENCRYPTED PRIVATE KEY", b"x"), PkiError::PrivateKeyInside),
        (with("CERTIFICATE REQUEST", b"x"), other(FileContent::Csr)),
        (with("DOSSIER", b"x"), other(FileContent::Block("DOSSIER".to_owned()))),
        (with("CERTIFICATE", b"x"), PkiError::NotACertificate(Cause::any())),
        (with("X509 CRL", b"x"), PkiError::NotACrl(Cause::any())),
        (with("PKCS7", b"x"), PkiError::NotPkcs7(Cause::any())),
        ([application.der(), b"x"].concat(), PkiError::TrailingBytes(1)),
        ([&crl[..], &[0x30, 0]].concat(), PkiError::NotTrustMaterial),
        (application.to_pem().replace("-----END", "-----TO").into_bytes(), PkiError::BadPem),
        ([&[0x30, 0x80], &p7b[4..]].concat(), PkiError::NotTrustMaterial),
        (pkcs7(&[], &[]), PkiError::NoCertificate),
    ] {
        assert_eq!(read_bundle(&bytes), Err(expected));
    }
    let too_many = vec![b' '; MAX_BUNDLE_BYTES + 1];
    assert!(matches!(read_bundle(&too_many), Err(PkiError::TooLarge { .. })));
}

#[test]
fn a_damaged_file_is_an_error_and_nothing_is_left_out() {
    let Sample { ca, application, crl } = sample();
    let p7b = pkcs7(&[application.der(), ca.certificate.der()], &[&crl]);
    let whole = read_bundle(&p7b).unwrap();
    for at in 0..p7b.len() {
        assert!(read_bundle(&p7b[..at]).is_err(), "first {at} bytes");
        let mut damaged = p7b.clone();
        damaged[at] ^= 1 << (at % 8);
        if let Ok(read) = read_bundle(&damaged) {
            let count = read.certificates.len() + read.crls.len();
            assert!(count == 3 || read != whole, "byte {at}");
        }
    }
}

#[test]
fn deep_nesting_ends_in_an_error() {
    let nested = (0..5000).fold(vec![5, 0], |inner, _| tlv::write(tlv::SEQUENCE, &[&inner]));
    assert!(read_bundle(&nested).is_err());
    assert!(read_bundle(&[0x30, 0x80].repeat(100_000)).is_err());
    let crl = tlv::write(tlv::SEQUENCE, &[&tlv::write(tlv::SEQUENCE, &[&[0x22, 0x80].repeat(100_000)])]);
    assert!(read_bundle(&crl).is_err());
}
