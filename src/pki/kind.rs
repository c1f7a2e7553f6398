//! What a file with keys or certificates is, seen from outside.

use super::parts::parts;
use super::{FileContent, PkiError, pem};

/// What a file is by its content. Whether it is whole and good shows when it is used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PkiKind {
    /// One certificate, DER or PEM.
    Certificate,
    /// Several certificates: usually one and its issuers.
    Chain,
    /// Public things of several kinds: PKCS#7 (`.p7b`), or PEM with certificates and revocation lists.
    Bundle,
    /// A certificate revocation list.
    Crl,
    /// A certificate signing request.
    Csr,
    /// A private key of any algorithm, encrypted or not.
    Key,
    /// PEM with a private key and certificates beside it.
    KeyAndCertificate,
    /// A PKCS#12 (`.pfx`, `.p12`).
    Pkcs12,
}

/// What the bytes are, if they are anything of the kind. The name of the file is not asked for, nor are the labels of a
/// PEM text that can be decoded.
///
/// Looks at the outside only, so a damaged certificate is still a certificate: its reader says what is wrong.
pub fn recognise(bytes: &[u8]) -> Option<PkiKind> {
    let contents: Vec<FileContent> = match parts(bytes) {
        Ok(parts) => parts.into_iter().map(|part| part.content).collect(),
        Err(PkiError::BadPem) => pem::labels(bytes).map(|label| FileContent::labelled(&label)).collect(),
        Err(_) => return None,
    };
    let count = |wanted: FileContent| contents.iter().filter(|content| **content == wanted).count();
    let keys = contents.iter().filter(|content| content.is_private_key()).count();
    let (certificates, bundles, crls, csrs) =
        (count(FileContent::Certificate), count(FileContent::Pkcs7), count(FileContent::Crl), count(FileContent::Csr));
    match (certificates, bundles, crls, csrs, keys) {
        (0, 0, 0, 0, 0) => (count(FileContent::Pkcs12) > 0).then_some(PkiKind::Pkcs12),
        (0, 0, 0, 0, _) => Some(PkiKind::Key),
        (_, _, _, _, 1..) => Some(PkiKind::KeyAndCertificate),
        (1, 0, 0, 0, 0) => Some(PkiKind::Certificate),
        (_, 0, 0, 0, 0) => Some(PkiKind::Chain),
        (0, 0, 1, 0, 0) => Some(PkiKind::Crl),
        (0, 0, 0, _, 0) => Some(PkiKind::Csr),
        _ => Some(PkiKind::Bundle),
    }
}

#[cfg(test)]
mod tests {
    use rcgen::{CertificateParams, CertificateRevocationListParams, Issuer, KeyIdMethod, KeyPair, SerialNumber};
    use time::OffsetDateTime;

    use super::*;
    use crate::pki::tlv::{self, CONTEXT_0, SEQUENCE};
    use crate::pki::{pkcs12_write, samples};

    const INTEGER: u8 = 0x02;
    const OBJECT_IDENTIFIER: u8 = 0x06;
    /// 1.2.840.113549.1.7.2.
    const SIGNED_DATA: &[u8] = &[OBJECT_IDENTIFIER, 9, 0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 0x01, 0x07, 0x02];

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
        // No bytes make it panic.
        for cut in 0..der.len() {
            recognise(&der[cut..]);
        }
    }
}
