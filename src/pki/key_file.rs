//! Private keys as other tools write them.

use rsa::pkcs1::RsaPrivateKey as Pkcs1;
use rsa::pkcs8::der::Encode as _;
use rsa::pkcs8::{AlgorithmIdentifierRef, PrivateKeyInfo};
use zeroize::Zeroizing;

use super::certificate::check_size;
use super::pem::{self, Block};
use super::{Certificate, PkiError, PrivateKey, pkcs12, tlv};

/// The largest file a private key is looked for in. Certificates may stand around its PEM.
pub const MAX_KEY_FILE_BYTES: usize = 256 * 1024;

/// Reads the only RSA private key of a file: PKCS#8, plain or under a password, or PKCS#1; in PEM or DER, whatever the
/// name of the file says.
///
/// Under a password: PBES2 with AES or 3DES, and the 3DES and RC2-40 of PKCS#12. The password is looked at only if it is
/// needed. Not read, but told how to convert: the encryption of traditional PEM, OpenSSH's own format, Microsoft's PVK.
/// Blocks while it hashes the password, a million times at most.
pub fn read_key_file(bytes: &[u8], password: Option<&str>) -> Result<PrivateKey, PkiError> {
    check_size(bytes, MAX_KEY_FILE_BYTES)?;
    if bytes.starts_with(PVK) {
        return Err(PkiError::UnsupportedKeyFile(
            "Microsoft's PVK format",
            "openssl rsa -inform PVK -in old.pvk -out new.key",
        ));
    }
    if !pem::is_pem(bytes) {
        return from_der(bytes, password);
    }
    let blocks = pem::private_keys(bytes)?;
    let Block { label, encrypted, der } = match blocks.as_slice() {
        [] => return Err(PkiError::NoKey),
        [block] => block,
        several => return Err(PkiError::SeveralKeys(several.len())),
    };
    match label.as_str() {
        _ if *encrypted => Err(PkiError::TraditionalEncryption),
        "PRIVATE KEY" => PrivateKey::from_pkcs8_der(der),
        "RSA PRIVATE KEY" => from_pkcs1(der),
        "ENCRYPTED PRIVATE KEY" => decrypt(der, password),
        "OPENSSH PRIVATE KEY" => {
            Err(PkiError::UnsupportedKeyFile("OpenSSH's own format", "ssh-keygen -p -m PKCS8 -f copy-of-the-key"))
        }
        _ => Err(PkiError::NotAPrivateKey),
    }
}

/// Reads a certificate and its private key from two files; the certificate in DER or PEM, the key as
/// [`read_key_file`] does.
pub fn read_pair(
    certificate: &[u8],
    key: &[u8],
    password: Option<&str>,
) -> Result<(PrivateKey, Certificate), PkiError> {
    let certificate = Certificate::from_any(certificate)?;
    let key = read_key_file(key, password)?;
    if key.matches(&certificate) { Ok((key, certificate)) } else { Err(PkiError::NotAPair) }
}

fn from_der(der: &[u8], password: Option<&str>) -> Result<PrivateKey, PkiError> {
    if PrivateKeyInfo::try_from(der).is_ok() {
        PrivateKey::from_pkcs8_der(der)
    } else if Pkcs1::try_from(der).is_ok() {
        from_pkcs1(der)
    } else if is_encrypted(der) {
        decrypt(der, password)
    } else if Certificate::from_der(der).is_ok() {
        Err(PkiError::NoKey)
    } else {
        Err(PkiError::NotAPrivateKey)
    }
}

fn from_pkcs1(der: &[u8]) -> Result<PrivateKey, PkiError> {
    Pkcs1::try_from(der).map_err(|_| PkiError::NotAPrivateKey)?;
    let algorithm = AlgorithmIdentifierRef { oid: rsa::pkcs1::ALGORITHM_OID, parameters: Some(tlv::null()) };
    let pkcs8 = PrivateKeyInfo::new(algorithm, der).to_der().map_err(|_| PkiError::NotAPrivateKey)?;
    PrivateKey::from_pkcs8_der(&Zeroizing::new(pkcs8))
}

/// An EncryptedPrivateKeyInfo: a sequence of an algorithm and an octet string, and nothing else.
pub(super) fn is_encrypted(der: &[u8]) -> bool {
    let parts = match tlv::all(der).as_deref() {
        Some([whole]) if whole.tag == tlv::SEQUENCE => tlv::all(whole.content),
        _ => None,
    };
    matches!(parts.as_deref(), Some([algorithm, data])
        if algorithm.tag == tlv::SEQUENCE && data.tag == tlv::OCTET_STRING)
}

fn decrypt(der: &[u8], password: Option<&str>) -> Result<PrivateKey, PkiError> {
    if !is_encrypted(der) {
        return Err(PkiError::NotAPrivateKey);
    }
    let password = password.ok_or(PkiError::PasswordNeeded)?;
    // A PKCS#12 holds keys in this very form, and its reader knows every encryption.
    pkcs12::pkcs12_read_key(&pkcs12::around(der), password).map_err(|error| match error {
        PkiError::UnsupportedPkcs12(_) => PkiError::UnsupportedKeyEncryption,
        error => error,
    })
}

pub(super) const PVK: &[u8] = &[0x1e, 0xf1, 0xb5, 0xb0];

#[cfg(test)]
mod tests {
    use super::*;
    use base64::Engine as _;
    use p12_keystore::EncryptionAlgorithm;
    use rsa::pkcs8::DecodePrivateKey as _;

    use crate::pki::samples;

    const PASSWORD: &str = "Größe 1";

    fn armoured(label: &str, headers: &str, der: &[u8]) -> Vec<u8> {
        let body = base64::engine::general_purpose::STANDARD.encode(der);
        let lines: Vec<&str> = (0..body.len()).step_by(64).map(|at| &body[at..body.len().min(at + 64)]).collect();
        format!("-----BEGIN {label}-----\n{headers}{}\n-----END {label}-----\n", lines.join("\n")).into_bytes()
    }

    fn pkcs1(key: &PrivateKey) -> Vec<u8> {
        use rsa::pkcs1::EncodeRsaPrivateKey as _;
        let key = rsa::RsaPrivateKey::from_pkcs8_der(&key.to_pkcs8_der().unwrap()).unwrap();
        key.to_pkcs1_der().unwrap().as_bytes().to_vec()
    }

    /// An EncryptedPrivateKeyInfo, cut out of a PKCS#12.
    fn encrypted(key: &PrivateKey, algorithm: EncryptionAlgorithm) -> Vec<u8> {
        let plain = p12_keystore::PrivateKey::from_der(&key.to_pkcs8_der().unwrap()).unwrap();
        let chain = p12_keystore::PrivateKeyChain::new(vec![1], plain, []);
        let mut store = p12_keystore::KeyStore::new();
        store.add_entry("x", p12_keystore::KeyStoreEntry::PrivateKeyChain(chain));
        let writer = store.writer(PASSWORD).encryption_algorithm(algorithm).encryption_iterations(10);
        let whole = writer.mac_iterations(10).write().unwrap();
        let at = whole.windows(11).position(|w| w == [0x06, 11, 0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 12, 10]);
        let at = at.unwrap_or_else(|| panic!("a shrouded key bag")) + 13;
        let (explicit, _) = tlv::first(&whole[at..]).unwrap();
        assert_eq!(explicit.tag, tlv::CONTEXT_0);
        explicit.content.to_vec()
    }

    fn is_key(read: Result<PrivateKey, PkiError>, key: &PrivateKey) {
        assert_eq!(read.unwrap().public_key(), key.public_key());
    }

    #[test]
    fn every_plain_form_is_read_in_pem_and_der() {
        for key in [samples::legacy_key(), samples::key()] {
            let pkcs8 = key.to_pkcs8_der().unwrap();
            let pkcs1 = pkcs1(key);
            for bytes in [
                pkcs8.to_vec(),
                pkcs1.clone(),
                armoured("PRIVATE KEY", "", &pkcs8),
                armoured("RSA PRIVATE KEY", "", &pkcs1),
                [b"\xef\xbb\xbf".to_vec(), armoured("PRIVATE KEY", "", &pkcs8)].concat(),
                [samples::certificate().to_pem().into_bytes(), armoured("PRIVATE KEY", "", &pkcs8)].concat(),
                String::from_utf8(armoured("PRIVATE KEY", "", &pkcs8)).unwrap().replace('\n', "\r\n").into(),
            ] {
                is_key(read_key_file(&bytes, None), key);
                is_key(read_key_file(&bytes, Some("not needed")), key);
            }
        }
    }

    #[test]
    fn an_encrypted_key_needs_its_password() {
        for algorithm in
            [EncryptionAlgorithm::PbeWithHmacSha256AndAes256, EncryptionAlgorithm::PbeWithShaAnd3KeyTripleDesCbc]
        {
            let der = encrypted(samples::key(), algorithm);
            for bytes in [der.clone(), armoured("ENCRYPTED PRIVATE KEY", "", &der)] {
                is_key(read_key_file(&bytes, Some(PASSWORD)), samples::key());
                assert_eq!(read_key_file(&bytes, None).err(), Some(PkiError::PasswordNeeded));
                for wrong in ["", "Größe 2"] {
                    let read = read_key_file(&bytes, Some(wrong)).err();
                    assert_eq!(read, Some(PkiError::WrongPasswordOrDamaged), "{wrong}");
                }
            }
        }
    }

    #[test]
    fn what_cannot_be_read_says_what_it_is() {
        let key = samples::key().to_pkcs8_der().unwrap();
        let elliptic = crate::pki::tls_identity("robot", samples::now()).unwrap().private_key_pkcs8;
        let headers = "Proc-Type: 4,ENCRYPTED\nDEK-Info: AES-256-CBC,00112233445566778899AABBCCDDEEFF\n\n";
        let twice = armoured("PRIVATE KEY", "", &key).repeat(2);
        let unclosed = armoured("PRIVATE KEY", "", &key);
        for (bytes, expected) in [
            (vec![], PkiError::Empty),
            (b"hello, robot".to_vec(), PkiError::NotAPrivateKey),
            (samples::certificate().der().to_vec(), PkiError::NoKey),
            (samples::certificate().to_pem().into_bytes(), PkiError::NoKey),
            (elliptic.to_vec(), PkiError::NotAPrivateKey),
            (armoured("EC PRIVATE KEY", "", &elliptic), PkiError::NotAPrivateKey),
            (armoured("RSA PRIVATE KEY", headers, &key), PkiError::TraditionalEncryption),
            (armoured("ENCRYPTED PRIVATE KEY", "", &key), PkiError::NotAPrivateKey),
            (twice, PkiError::SeveralKeys(2)),
            (unclosed[..unclosed.len() - 5].to_vec(), PkiError::BadPem),
            (armoured("PRIVATE KEY", "!", &key), PkiError::BadPem),
            (
                vec![b' '; MAX_KEY_FILE_BYTES + 1],
                PkiError::TooLarge { bytes: MAX_KEY_FILE_BYTES + 1, max: MAX_KEY_FILE_BYTES },
            ),
        ] {
            assert_eq!(read_key_file(&bytes, Some(PASSWORD)).err(), Some(expected));
        }
        for converted in [armoured("OPENSSH PRIVATE KEY", "", b"x"), b"\x1e\xf1\xb5\xb0....".to_vec()] {
            assert!(matches!(read_key_file(&converted, None), Err(PkiError::UnsupportedKeyFile(..))));
        }
    }

    #[test]
    fn a_pair_belongs_together() {
        let key = samples::key().to_pkcs8_der().unwrap();
        let other = samples::other_key().to_pkcs8_der().unwrap();
        let (der, pem) = (samples::certificate().der(), samples::certificate().to_pem());
        assert_eq!(read_pair(der, &key, None).unwrap().1, *samples::certificate());
        assert_eq!(read_pair(pem.as_bytes(), &key, None).unwrap().1, *samples::certificate());
        assert_eq!(read_pair(der, &other, None).err(), Some(PkiError::NotAPair));
        assert_eq!(read_pair(&key, der, None).err(), Some(PkiError::PrivateKeyInside), "the wrong way round");
    }

    /// Whatever is in a file, reading it ends, and ends with a key that fits or an error.
    #[test]
    fn damaged_files_are_errors_and_no_crashes() {
        let key = samples::legacy_key();
        let aes = encrypted(key, EncryptionAlgorithm::PbeWithHmacSha256AndAes256);
        let des = encrypted(key, EncryptionAlgorithm::PbeWithShaAnd3KeyTripleDesCbc);
        let pfx = pkcs12::pkcs12_write_key("x", key, PASSWORD).unwrap();
        for whole in [pkcs1(key), aes.clone(), des, armoured("ENCRYPTED PRIVATE KEY", "", &aes)] {
            for at in (0..whole.len()).step_by(3) {
                let mut damaged = whole.clone();
                damaged[at] ^= 1 << (at % 8);
                if let Ok(read) = read_key_file(&damaged, Some(PASSWORD)) {
                    assert!(read.bits() == 1024 && read.to_pkcs8_der().is_ok(), "byte {at}");
                }
                assert!(read_key_file(&whole[..at], Some(PASSWORD)).is_err(), "first {at} bytes");
            }
        }
        for at in (0..pfx.len()).step_by(7) {
            let mut damaged = pfx.clone();
            damaged[at] ^= 1 << (at % 8);
            let _ = pkcs12::pkcs12_read_key(&damaged, PASSWORD);
            assert!(pkcs12::pkcs12_read_key(&pfx[..at], PASSWORD).is_err(), "first {at} bytes");
        }
    }
}
