//! Private keys as other tools write them.

use rsa::pkcs1::RsaPrivateKey as Pkcs1;
use rsa::pkcs8::der::Encode as _;
use rsa::pkcs8::{AlgorithmIdentifierRef, PrivateKeyInfo};
use zeroize::Zeroizing;

use super::parts::{FilePart, parts};
use super::password_encryption::{self, DecryptError, EncodedPassword};
use super::size::check_size;
use super::{Certificate, FileContent, PkiError, PrivateKey, Wanted, read_bundle, tlv};
use crate::model::{Cause, with_cause};

/// The largest file a private key is looked for in. Certificates may stand around its PEM.
pub const MAX_KEY_FILE_BYTES: usize = 256 * 1024;

/// Reads the only RSA private key of a file: PKCS#8, plain or under a password, or PKCS#1; in PEM, DER or base64,
/// by content, not by the name of the file. Certificates beside it are passed over.
///
/// Under a password: PBES2 with AES or 3DES, and the 3DES and RC2 of PKCS#12. The password is looked at only if it is
/// needed. Not read, but told how to convert: the encryption of traditional PEM, OpenSSH's own format, Microsoft's PVK,
/// PuTTY's PPK. Blocks while it hashes the password, a million times at most.
pub fn read_key_file(bytes: &[u8], password: Option<&str>) -> Result<PrivateKey, PkiError> {
    check_size(bytes, MAX_KEY_FILE_BYTES)?;
    let parts = parts(bytes)?;
    let keys: Vec<&FilePart> = parts.iter().filter(|part| part.is_private_key()).collect();
    match keys.as_slice() {
        [key] => read_key(key, password),
        [] => Err(match &parts[0].content {
            FileContent::Unknown => unreadable(),
            FileContent::Certificate => PkiError::NoKey,
            found => PkiError::OtherContent { found: found.clone(), wanted: Wanted::PrivateKey },
        }),
        several => Err(PkiError::SeveralKeys(several.len())),
    }
}

/// Reads one key of a file.
pub(super) fn read_key(key: &FilePart, password: Option<&str>) -> Result<PrivateKey, PkiError> {
    match &key.content {
        FileContent::PrivateKey if PrivateKeyInfo::try_from(key.der.as_slice()).is_ok() => {
            PrivateKey::from_pkcs8_der(&key.der)
        }
        FileContent::PrivateKey => from_pkcs1(&key.der),
        FileContent::EncryptedKey => decrypt(&key.der, password),
        found => Err(PkiError::OtherContent { found: found.clone(), wanted: Wanted::PrivateKey }),
    }
}

/// Reads a certificate and its private key from two files; the certificate as [`read_bundle`] does, with the chain or
/// other certificates beside it, of which the one for the key is taken; the key as [`read_key_file`] does.
pub fn read_pair(
    certificate: &[u8],
    key: &[u8],
    password: Option<&str>,
) -> Result<(PrivateKey, Certificate), PkiError> {
    let certificates = read_bundle(certificate)?.certificates;
    let key = read_key_file(key, password)?;
    let certificate = key.certificate_among(certificates)?;
    Ok((key, certificate))
}

fn from_pkcs1(der: &[u8]) -> Result<PrivateKey, PkiError> {
    Pkcs1::try_from(der).map_err(with_cause(PkiError::NotAPrivateKey))?;
    let algorithm = AlgorithmIdentifierRef { oid: rsa::pkcs1::ALGORITHM_OID, parameters: Some(tlv::null()) };
    let pkcs8 = PrivateKeyInfo::new(algorithm, der).to_der().map_err(with_cause(PkiError::NotAPrivateKey))?;
    PrivateKey::from_pkcs8_der(&Zeroizing::new(pkcs8))
}

fn unreadable() -> PkiError {
    PkiError::NotAPrivateKey(Cause::finding("it cannot be read"))
}

/// Decrypts an EncryptedPrivateKeyInfo (RFC 5958 §3).
fn decrypt(der: &[u8], password: Option<&str>) -> Result<PrivateKey, PkiError> {
    let parts = tlv::sole(der).and_then(|whole| tlv::elements(whole.content));
    let Some([algorithm, data]) = parts.as_deref() else { return Err(unreadable()) };
    let data = tlv::sole(data).ok_or_else(unreadable)?.content;
    let password = password.ok_or(PkiError::PasswordNeeded)?;
    for form in EncodedPassword::forms(password) {
        match password_encryption::decrypt(algorithm, data, &form) {
            Ok(key) if PrivateKeyInfo::try_from(key.as_slice()).is_ok() => return PrivateKey::from_pkcs8_der(&key),
            Ok(_) | Err(DecryptError::Failed) => {}
            Err(DecryptError::Unsupported(name)) => return Err(PkiError::UnsupportedKeyEncryption(name)),
            Err(DecryptError::TooExpensive) => {
                return Err(PkiError::UnsupportedKeyEncryption("which hashes the password too often".to_owned()));
            }
        }
    }
    Err(PkiError::WrongPasswordOrDamaged)
}

#[cfg(test)]
mod tests {
    use super::*;
    use base64::Engine as _;
    use p12_keystore::EncryptionAlgorithm;
    use rsa::pkcs8::DecodePrivateKey as _;

    use crate::pki::{pkcs12, samples};

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
            (b"hello, robot".to_vec(), PkiError::NotAPrivateKey(Cause::any())),
            (samples::certificate().der().to_vec(), PkiError::NoKey),
            (samples::certificate().to_pem().into_bytes(), PkiError::NoKey),
            (elliptic.to_vec(), PkiError::NotAPrivateKey(Cause::any())),
            (armoured("EC PRIVATE KEY", "", &elliptic), PkiError::NotAPrivateKey(Cause::any())),
            (
                armoured("RSA PRIVATE KEY", headers, &key),
                PkiError::OtherContent { found: FileContent::TraditionalKey, wanted: Wanted::PrivateKey },
            ),
            (armoured("ENCRYPTED PRIVATE KEY", "", b"x"), PkiError::NotAPrivateKey(Cause::any())),
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
            let told = read_key_file(&converted, None).unwrap_err().to_string();
            assert!(told.contains("; convert"), "{told}");
        }
    }

    /// The algorithm is the reason, and not the password.
    #[test]
    fn an_encryption_that_is_not_read_is_named() {
        let key = include_bytes!("../../tests/cases/08-pfx/rc2.key");
        for password in ["secret", "wrong"] {
            let read = read_key_file(key, Some(password)).err();
            assert_eq!(read, Some(PkiError::UnsupportedKeyEncryption("RC2 in PBES2".to_owned())));
        }
        let told = PkiError::UnsupportedKeyEncryption("RC2 in PBES2".to_owned()).to_string();
        assert!(told.contains("RC2 in PBES2") && told.contains("openssl pkcs8 -topk8"), "{told}");
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

    /// Reading any bytes ends, with a key that fits or an error.
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
