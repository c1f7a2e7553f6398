//! What a file with keys or certificates is, seen from outside.

use super::tlv::{self, CONTEXT_0, OCTET_STRING, SEQUENCE, Tlv};
use super::{key_file, pem};

/// What a file is by its content. Whether it is whole and good shows when it is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PkiKind {
    /// One certificate, DER or PEM.
    Certificate,
    /// PEM with several certificates: usually one and its issuers.
    Chain,
    /// Public things of several kinds: PKCS#7 (`.p7b`), or PEM with certificates and revocation lists.
    Bundle,
    /// A certificate revocation list.
    Crl,
    /// A certificate signing request.
    Csr,
    /// A private key, encrypted or not, of whatever algorithm.
    Key,
    /// PEM with a private key and certificates beside it.
    KeyAndCertificate,
    /// A PKCS#12 (`.pfx`, `.p12`).
    Pkcs12,
}

/// What the bytes are, if they are anything of the kind. The name of the file is not asked for.
///
/// Looks at the outside only, so a damaged certificate is still a certificate: whoever opens it says what is wrong.
pub fn recognise(bytes: &[u8]) -> Option<PkiKind> {
    if pem::is_pem(bytes) {
        return in_pem(bytes);
    }
    if bytes.starts_with(key_file::PVK) {
        return Some(PkiKind::Key);
    }
    // Some tools write these two in BER, without lengths.
    match bytes {
        [SEQUENCE, 0x80, rest @ ..] if rest.starts_with(VERSION_3) => return Some(PkiKind::Pkcs12),
        [SEQUENCE, 0x80, rest @ ..] if rest.starts_with(SIGNED_DATA) => return Some(PkiKind::Bundle),
        _ => {}
    }
    let (whole, rest) = tlv::first(bytes)?;
    if whole.tag != SEQUENCE || !rest.is_empty() {
        return None;
    }
    in_der(whole.content, &tlv::all(whole.content)?)
}

fn in_der(content: &[u8], parts: &[Tlv<'_>]) -> Option<PkiKind> {
    let tags: Vec<u8> = parts.iter().map(|part| part.tag).collect();
    match tags[..] {
        [INTEGER, SEQUENCE, ..] if content.starts_with(VERSION_3) => Some(PkiKind::Pkcs12),
        [OBJECT_IDENTIFIER, CONTEXT_0] if content.starts_with(SIGNED_DATA) => Some(PkiKind::Bundle),
        [SEQUENCE, SEQUENCE, BIT_STRING] => signed(&tlv::all(parts[0].content)?),
        // PKCS#8, plain and encrypted; PKCS#1; SEC 1.
        [INTEGER, SEQUENCE, OCTET_STRING, ..] | [SEQUENCE, OCTET_STRING] | [INTEGER, OCTET_STRING, ..] => {
            Some(PkiKind::Key)
        }
        [INTEGER, INTEGER, ..] if tags.len() >= 9 => Some(PkiKind::Key),
        _ => None,
    }
}

/// What was signed: the fields of a certificate, a request or a revocation list (RFC 5280 §4.1, §5.1; RFC 2986 §4.1).
fn signed(parts: &[Tlv<'_>]) -> Option<PkiKind> {
    let tags: Vec<u8> = parts.iter().map(|part| part.tag).collect();
    match tags[..] {
        [CONTEXT_0, INTEGER, SEQUENCE, SEQUENCE, SEQUENCE, SEQUENCE, SEQUENCE, ..]
        | [INTEGER, SEQUENCE, SEQUENCE, SEQUENCE, SEQUENCE, SEQUENCE, ..] => Some(PkiKind::Certificate),
        [INTEGER, SEQUENCE, SEQUENCE, UTC_TIME | GENERALIZED_TIME, ..]
        | [SEQUENCE, SEQUENCE, UTC_TIME | GENERALIZED_TIME, ..] => Some(PkiKind::Crl),
        [INTEGER, SEQUENCE, SEQUENCE, CONTEXT_0] | [INTEGER, SEQUENCE, SEQUENCE] => Some(PkiKind::Csr),
        _ => None,
    }
}

fn in_pem(text: &[u8]) -> Option<PkiKind> {
    let (mut certificates, mut bundles, mut crls, mut csrs, mut keys) = (0, 0, 0, 0, 0);
    for label in pem::labels(text) {
        match label {
            b"CERTIFICATE" | b"X509 CERTIFICATE" | b"TRUSTED CERTIFICATE" => certificates += 1,
            b"PKCS7" | b"CMS" => bundles += 1,
            b"X509 CRL" => crls += 1,
            b"CERTIFICATE REQUEST" | b"NEW CERTIFICATE REQUEST" => csrs += 1,
            label if label.ends_with(pem::PRIVATE_KEY) => keys += 1,
            // Such as the parameters OpenSSL puts before a key.
            _ => {}
        }
    }
    match (certificates, bundles, crls, csrs, keys) {
        (0, 0, 0, 0, 0) => None,
        (0, 0, 0, 0, _) => Some(PkiKind::Key),
        (_, _, _, _, 1..) => Some(PkiKind::KeyAndCertificate),
        (1, 0, 0, 0, 0) => Some(PkiKind::Certificate),
        (_, 0, 0, 0, 0) => Some(PkiKind::Chain),
        (0, 0, 1, 0, 0) => Some(PkiKind::Crl),
        (0, 0, 0, _, 0) => Some(PkiKind::Csr),
        _ => Some(PkiKind::Bundle),
    }
}

const INTEGER: u8 = 0x02;
const BIT_STRING: u8 = 0x03;
const OBJECT_IDENTIFIER: u8 = 0x06;
const UTC_TIME: u8 = 0x17;
const GENERALIZED_TIME: u8 = 0x18;
/// A PKCS#12 starts with its version (RFC 7292 §4).
const VERSION_3: &[u8] = &[INTEGER, 1, 3];
/// 1.2.840.113549.1.7.2.
const SIGNED_DATA: &[u8] = &[OBJECT_IDENTIFIER, 9, 0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 0x01, 0x07, 0x02];

#[cfg(test)]
mod tests {
    use rcgen::{CertificateParams, CertificateRevocationListParams, Issuer, KeyIdMethod, KeyPair, SerialNumber};
    use time::OffsetDateTime;

    use super::*;
    use crate::pki::{pkcs12_write, samples};

    fn crl() -> rcgen::CertificateRevocationList {
        let issuer = Issuer::new(CertificateParams::default(), KeyPair::generate().unwrap());
        let now = OffsetDateTime::UNIX_EPOCH;
        CertificateRevocationListParams {
            this_update: now,
            next_update: now + time::Duration::days(1),
            crl_number: SerialNumber::from(1),
            issuing_distribution_point: None,
            revoked_certs: vec![],
            key_identifier_method: KeyIdMethod::Sha256,
        }
        .signed_by(&issuer)
        .unwrap()
    }

    fn ec_pem() -> String {
        KeyPair::generate().unwrap().serialize_pem()
    }

    fn csr() -> rcgen::CertificateSigningRequest {
        CertificateParams::default().serialize_request(&KeyPair::generate().unwrap()).unwrap()
    }

    /// A PKCS#7 with nothing in it but certificates, as OpenSSL's `crl2pkcs7` makes it.
    fn p7b(certificates: &[&[u8]]) -> Vec<u8> {
        let data = tlv::write(SEQUENCE, &[&[OBJECT_IDENTIFIER, 9, 0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7, 1]]);
        let set = tlv::write(0x31, &[]);
        let held = tlv::write(CONTEXT_0, certificates);
        let signed = tlv::write(SEQUENCE, &[&[INTEGER, 1, 1], &set, &data, &held, &set]);
        tlv::write(SEQUENCE, &[SIGNED_DATA, &tlv::write(CONTEXT_0, &[&signed])])
    }

    #[test]
    fn every_kind_is_recognised_by_its_content() {
        let (key, certificate) = (samples::key(), samples::certificate());
        let (pem, key_pem) = (certificate.to_pem(), ec_pem());
        let pfx = pkcs12_write("robot", key, &[certificate], "secret").unwrap();
        let ec = KeyPair::generate().unwrap();
        for (bytes, kind) in [
            (certificate.der().to_vec(), PkiKind::Certificate),
            (format!("Certificate:\n    Data:\n{pem}").into_bytes(), PkiKind::Certificate),
            (format!("{pem}{pem}").into_bytes(), PkiKind::Chain),
            (format!("{pem}{}", crl().pem().unwrap()).into_bytes(), PkiKind::Bundle),
            (p7b(&[certificate.der(), certificate.der()]), PkiKind::Bundle),
            (b"-----BEGIN PKCS7-----\nMA==\n-----END PKCS7-----\n".to_vec(), PkiKind::Bundle),
            (crl().der().to_vec(), PkiKind::Crl),
            (crl().pem().unwrap().into_bytes(), PkiKind::Crl),
            (csr().der().to_vec(), PkiKind::Csr),
            (csr().pem().unwrap().into_bytes(), PkiKind::Csr),
            (key.to_pkcs8_der().unwrap().to_vec(), PkiKind::Key),
            (ec.serialize_der(), PkiKind::Key),
            (key_pem.clone().into_bytes(), PkiKind::Key),
            (format!("{key_pem}{pem}").into_bytes(), PkiKind::KeyAndCertificate),
            (pfx, PkiKind::Pkcs12),
        ] {
            assert_eq!(recognise(&bytes), Some(kind), "{:?}…", &bytes[..bytes.len().min(30)]);
        }
    }

    #[test]
    fn a_damaged_certificate_is_still_one() {
        let mut der = samples::certificate().der().to_vec();
        let last = der.len() - 1;
        der[last] ^= 1;
        der[40] ^= 0xff;
        assert_eq!(recognise(&der), Some(PkiKind::Certificate));
    }

    #[test]
    fn anything_else_is_not_recognised() {
        let der = samples::certificate().der();
        for bytes in [
            &b""[..],
            b"Name,Type,Address\n",
            &der[..der.len() - 1],
            &[der, b"x"].concat(),
            &[SEQUENCE, 0],
            b"\x89PNG\r\n\x1a\n",
            b"-----BEGIN PGP MESSAGE-----\nAAAA\n-----END PGP MESSAGE-----\n",
            b"ssh-rsa AAAA",
        ] {
            assert_eq!(recognise(bytes), None, "{bytes:?}");
        }
        // Whatever the bytes, nothing panics.
        for cut in 0..der.len() {
            recognise(&der[cut..]);
        }
    }
}
