//! PKCS#12: a key and its certificates under a password (RFC 7292).
//!
//! | file | contents |
//! |---|---|
//! | `archive` | every key and certificate inside, decrypted |
//! | `mac` | MacData: checks that the file is whole and the password right |
//!
//! Written with `p12-keystore`. Read here: that crate reads neither BER nor PBMAC1, no password that is missing rather
//! than empty, and none with characters beyond the BMP.

mod archive;
mod mac;

use p12_keystore::error::Error;
use p12_keystore::{EncryptionAlgorithm, KeyStore, KeyStoreEntry, MacAlgorithm, PrivateKeyChain};
use sha1::{Digest as _, Sha1};
use zeroize::Zeroizing;

use self::archive::Pkcs12Archive;
use super::parts::{FilePart, parts};
use super::{Certificate, FileContent, PkiError, PrivateKey, Wanted};

/// The largest PKCS#12 that is read.
pub const MAX_PKCS12_BYTES: usize = 256 * 1024;

/// How often the password is hashed, for the encryption and for the MAC.
///
/// What is written here crosses a connection that is already encrypted and is opened on arrival; it is not kept. So the
/// count is that of Java's `keytool`, which a controller's processor does in a moment, and not that of a password
/// store.
pub const PKCS12_ITERATIONS: u32 = 10_000;

/// Writes a key and its certificates under a password: PBES2 with AES-256 and HMAC-SHA-256, and a MAC with SHA-256.
///
/// The first certificate is the one for the key. `alias` is the key's friendly name. The format
/// writes `alias` and the password in UCS-2, so what lies beyond, such as emoji, is refused; Java's reader takes
/// ASCII passwords only. Blocks for some milliseconds.
pub fn pkcs12_write(
    alias: &str,
    key: &PrivateKey,
    certificates: &[&Certificate],
    password: &str,
) -> Result<Vec<u8>, PkiError> {
    let leaf = certificates.first().ok_or(PkiError::NoCertificate)?;
    if !key.matches(leaf) {
        return Err(PkiError::NotAPair);
    }
    // Other tools find the key's certificate by this id, and choose the thumbprint for it.
    write(alias, key, certificates, &Sha1::digest(leaf.der()), password)
}

/// Writes a key without a certificate, as long as the CA has not issued one; otherwise as [`pkcs12_write`] does.
pub fn pkcs12_write_key(alias: &str, key: &PrivateKey, password: &str) -> Result<Vec<u8>, PkiError> {
    write(alias, key, &[], &Sha1::digest(key.public_key()), password)
}

fn write(
    alias: &str,
    key: &PrivateKey,
    certificates: &[&Certificate],
    id: &[u8],
    password: &str,
) -> Result<Vec<u8>, PkiError> {
    let encoding = |_: Error| PkiError::Pkcs12Encoding;
    let pkcs8 = key.to_pkcs8_der()?;
    let private_key = p12_keystore::PrivateKey::from_der(&pkcs8).map_err(encoding)?;
    let chain: Vec<_> = certificates
        .iter()
        .map(|certificate| p12_keystore::Certificate::from_der(certificate.der()).map_err(encoding))
        .collect::<Result<_, _>>()?;
    let mut store = KeyStore::new();
    store.add_entry(alias, KeyStoreEntry::PrivateKeyChain(PrivateKeyChain::new(id.to_vec(), private_key, chain)));
    store
        .writer(password)
        .encryption_algorithm(EncryptionAlgorithm::PbeWithHmacSha256AndAes256)
        .encryption_iterations(PKCS12_ITERATIONS)
        .mac_algorithm(MacAlgorithm::HmacSha256)
        .mac_iterations(PKCS12_ITERATIONS)
        .write()
        .map_err(encoding)
}

/// Reads a key and its certificates: first the one for the key, then the others in the order of the file.
///
/// Takes the modern algorithms and the old ones of Windows and OpenSSL 1; DER and BER, in PEM and base64 too. Exactly
/// one private key is expected. An empty password also opens a file that was made without one. Blocks: at most for a
/// million hashings of the password, or a gibibyte of scrypt, for each encrypted part of the file, of which sixteen are
/// read.
pub fn pkcs12_read(bytes: &[u8], password: &str) -> Result<(PrivateKey, Vec<Certificate>), PkiError> {
    let archive = open(bytes, password)?;
    let key = single_key(&archive)?;
    let mut certificates: Vec<_> =
        archive.certificates.iter().map(|der| Certificate::from_der(der)).collect::<Result<_, _>>()?;
    if certificates.is_empty() {
        return Err(PkiError::NoCertificate);
    }
    let leaf = certificates.iter().position(|certificate| key.matches(certificate)).ok_or(PkiError::NotAPair)?;
    certificates[..=leaf].rotate_right(1);
    Ok((key, certificates))
}

/// Reads the only key of a PKCS#12 and ignores the certificates beside it; otherwise as [`pkcs12_read`] does.
pub fn pkcs12_read_key(bytes: &[u8], password: &str) -> Result<PrivateKey, PkiError> {
    single_key(&open(bytes, password)?)
}

/// Every key and every certificate of a PKCS#12, whether they belong together or not.
pub(super) struct Pkcs12Contents {
    /// Of any kind, in PKCS#8 without encryption.
    pub keys: Vec<Zeroizing<Vec<u8>>>,
    pub certificates: Vec<Certificate>,
}

/// Opens a PKCS#12 in DER.
pub(super) fn contents(der: &[u8], password: &str) -> Result<Pkcs12Contents, PkiError> {
    let Pkcs12Archive { keys, certificates } = Pkcs12Archive::open(der, password)?;
    let certificates = certificates.iter().map(|der| Certificate::from_der(der)).collect::<Result<_, _>>()?;
    Ok(Pkcs12Contents { keys, certificates })
}

fn open(bytes: &[u8], password: &str) -> Result<Pkcs12Archive, PkiError> {
    if bytes.len() > MAX_PKCS12_BYTES {
        return Err(PkiError::TooLarge { bytes: bytes.len(), max: MAX_PKCS12_BYTES });
    }
    let part = parts(bytes)?.remove(0);
    match part {
        FilePart { content: FileContent::Pkcs12, der } => Pkcs12Archive::open(&der, password),
        // It looks like one from outside, so that it is damaged.
        FilePart { content: FileContent::Unknown, .. } if is_pkcs12(bytes) => Err(PkiError::Damaged),
        FilePart { content: FileContent::Unknown, .. } => Err(PkiError::NotPkcs12),
        FilePart { content: found, .. } => Err(PkiError::OtherContent { found, wanted: Wanted::Pkcs12 }),
    }
}

fn single_key(archive: &Pkcs12Archive) -> Result<PrivateKey, PkiError> {
    match archive.keys.as_slice() {
        [] => Err(PkiError::NoKey),
        [key] => PrivateKey::from_pkcs8_der(key),
        several => Err(PkiError::SeveralKeys(several.len())),
    }
}

/// Whether a damaged file begins as a PKCS#12: a SEQUENCE with the version.
fn is_pkcs12(bytes: &[u8]) -> bool {
    let inside = match bytes {
        [0x30, 0x00..=0x80, inside @ ..]
        | [0x30, 0x81, _, inside @ ..]
        | [0x30, 0x82, _, _, inside @ ..]
        | [0x30, 0x83, _, _, _, inside @ ..] => inside,
        _ => return false,
    };
    inside.starts_with(&[0x02, 0x01, 0x03])
}

/// A key and its certificates are two; each further key is one.
const MAX_ENCRYPTED_PARTS: usize = 16;
const TOO_OFTEN: &str = "the password is to be hashed too often";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::samples;

    const PASSWORD: &str = "Größe 机器人 1";

    fn written() -> Vec<u8> {
        pkcs12_write("server", samples::key(), &[samples::certificate()], PASSWORD).unwrap()
    }

    /// Something [`pkcs12_write`] refuses to make.
    fn odd(entries: &[(&PrivateKey, &[&Certificate])]) -> Vec<u8> {
        let mut store = KeyStore::new();
        for (number, (key, certificates)) in entries.iter().enumerate() {
            let key = p12_keystore::PrivateKey::from_der(&key.to_pkcs8_der().unwrap()).unwrap();
            let chain: Vec<_> =
                certificates.iter().map(|c| p12_keystore::Certificate::from_der(c.der()).unwrap()).collect();
            let chain = PrivateKeyChain::new(vec![number as u8], key, chain);
            store.add_entry(&number.to_string(), KeyStoreEntry::PrivateKeyChain(chain));
        }
        store.writer(PASSWORD).encryption_iterations(1).mac_iterations(1).write().unwrap()
    }

    #[test]
    fn what_is_written_is_read_back() {
        for key in [samples::legacy_key(), samples::key()] {
            let certificate = samples::certificate_for(key);
            for password in [PASSWORD, "", "x"] {
                let bytes = pkcs12_write("server", key, &[&certificate], password).unwrap();
                let (read_key, certificates) = pkcs12_read(&bytes, password).unwrap();
                assert_eq!(*read_key.to_pkcs8_der().unwrap(), *key.to_pkcs8_der().unwrap());
                assert_eq!(certificates, std::slice::from_ref(&certificate));
            }
        }
    }

    #[test]
    fn what_the_format_cannot_write_is_refused() {
        let write = |alias, password| pkcs12_write(alias, samples::key(), &[samples::certificate()], password);
        assert_eq!(write("server", "robot 🤖"), Err(PkiError::Pkcs12Encoding));
        assert_eq!(write("🤖", PASSWORD), Err(PkiError::Pkcs12Encoding));
    }

    #[test]
    fn the_key_cannot_be_seen_without_the_password() {
        let key = samples::key().to_pkcs8_der().unwrap();
        let bytes = written();
        for secret in key.chunks(16) {
            assert!(!bytes.windows(secret.len()).any(|window| secret.len() == 16 && window == secret));
        }
    }

    #[test]
    fn the_certificate_of_the_key_comes_first() {
        let (a, leaf, b) = (
            samples::certificate_for(samples::other_key()),
            samples::certificate(),
            samples::certificate_for(samples::legacy_key()),
        );
        let (_, certificates) = pkcs12_read(&odd(&[(samples::key(), &[&a, leaf, &b])]), PASSWORD).unwrap();
        assert_eq!(certificates, [leaf.clone(), a, b]);
    }

    #[test]
    fn a_wrong_password_or_damage_is_said_to_be_either() {
        let bytes = written();
        assert_eq!(pkcs12_read(&bytes, "wrong").err(), Some(PkiError::WrongPasswordOrDamaged));
        assert_eq!(pkcs12_read(&bytes, "").err(), Some(PkiError::WrongPasswordOrDamaged));
        assert_eq!(pkcs12_read(&bytes[..bytes.len() - 1], PASSWORD).err(), Some(PkiError::Damaged));
        let mut damaged = bytes.clone();
        damaged[bytes.len() / 2] ^= 1;
        assert_eq!(pkcs12_read(&damaged, PASSWORD).err(), Some(PkiError::WrongPasswordOrDamaged));
    }

    #[test]
    fn what_is_no_pkcs12_is_not_blamed_on_the_password() {
        for bytes in [b"hello, robot".as_slice(), &[0x30]] {
            assert_eq!(pkcs12_read(bytes, PASSWORD).err(), Some(PkiError::NotPkcs12));
        }
        for (bytes, found) in [
            (samples::certificate().der(), FileContent::Certificate),
            (b"\xfe\xed\xfe\xed\0\0\0\x02", FileContent::JavaKeystore),
            (b"<!DOCTYPE html><html>", FileContent::WebPage),
        ] {
            let expected = PkiError::OtherContent { found, wanted: Wanted::Pkcs12 };
            assert_eq!(pkcs12_read(bytes, PASSWORD).err(), Some(expected));
        }
        assert_eq!(pkcs12_read(b"", PASSWORD).err(), Some(PkiError::Empty));
        let large = vec![0x30; MAX_PKCS12_BYTES + 1];
        assert!(matches!(pkcs12_read(&large, PASSWORD), Err(PkiError::TooLarge { .. })));
        let cut_in_ber = [0x30, 0x80, 0x02, 0x01, 0x03];
        assert_eq!(pkcs12_read(&cut_in_ber, PASSWORD).err(), Some(PkiError::Damaged));
    }

    #[test]
    fn a_file_cannot_make_its_reader_hash_without_end() {
        let keys = |count: usize| vec![(samples::legacy_key(), &[][..]); count];
        let read = |count| pkcs12_read(&odd(&keys(count)), PASSWORD).err();
        assert_eq!(read(MAX_ENCRYPTED_PARTS - 1), Some(PkiError::SeveralKeys(MAX_ENCRYPTED_PARTS - 1)));
        assert_eq!(read(MAX_ENCRYPTED_PARTS + 1), Some(PkiError::UnsupportedPkcs12(TOO_OFTEN.to_owned())));
    }

    /// Case 08, and others of its kind: OpenSSL 4.0 opens each of them.
    #[test]
    fn every_form_of_the_format_is_read() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/08-pfx");
        for (file, password) in [
            ("ber.pfx", "secret"),
            ("ber-inner.pfx", "fuzz"),
            ("emoji.pfx", "robot🤖"),
            ("emoji-3des.pfx", "robot🤖"),
            ("nullpw-dotnet.pfx", ""),
            ("pbmac1-sha256.pfx", "fuzz"),
            ("pbmac1-sha512-prf-sha1.pfx", "fuzz"),
            ("rc2-128.pfx", "fuzz"),
        ] {
            let bytes = std::fs::read(folder.join(file)).unwrap();
            let (key, certificates) = pkcs12_read(&bytes, password).unwrap_or_else(|error| panic!("{file}: {error}"));
            assert!(key.matches(&certificates[0]), "{file}");
            for wrong in ["Secret", "robot"] {
                assert_eq!(pkcs12_read(&bytes, wrong).err(), Some(PkiError::WrongPasswordOrDamaged), "{file}");
            }
            for padding in ["\n", "\r\n", "\0\0\0"] {
                assert!(pkcs12_read(&[&bytes, padding.as_bytes()].concat(), password).is_ok(), "{file}");
            }
            for at in (0..bytes.len()).step_by(61) {
                let mut damaged = bytes.clone();
                damaged[at] ^= 0x10;
                let _ = pkcs12_read(&damaged, password);
                assert!(pkcs12_read(&bytes[..at], password).is_err(), "{file}: first {at} bytes");
            }
        }
        let keystore = std::fs::read(folder.join("store.jks")).unwrap();
        let told = pkcs12_read(&keystore, "secret").unwrap_err().to_string();
        assert!(told.contains("a Java keystore") && told.contains("keytool -importkeystore"), "{told}");
    }

    #[test]
    fn a_trust_store_has_no_key() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/08-pfx");
        for (file, password) in [("truststore-keytool.p12", "secret"), ("truststore-openssl.p12", "secret")] {
            let bytes = std::fs::read(folder.join(file)).unwrap();
            assert_eq!(pkcs12_read(&bytes, password).err(), Some(PkiError::NoKey), "{file}");
            assert_eq!(contents(&bytes, password).unwrap().certificates.len(), 1, "{file}");
        }
    }

    #[test]
    fn a_key_can_travel_alone() {
        for key in [samples::legacy_key(), samples::key()] {
            let bytes = pkcs12_write_key("server", key, PASSWORD).unwrap();
            assert!(pkcs12_read_key(&bytes, PASSWORD).unwrap().matches(&samples::certificate_for(key)));
            assert_eq!(pkcs12_read_key(&bytes, "wrong").err(), Some(PkiError::WrongPasswordOrDamaged));
            assert_eq!(pkcs12_read(&bytes, PASSWORD).err(), Some(PkiError::NoCertificate));
        }
        assert!(pkcs12_read_key(&written(), PASSWORD).is_ok(), "whatever is beside it");
    }

    #[test]
    fn one_key_and_its_certificate_are_needed() {
        let (key, other, certificate) = (samples::key(), samples::other_key(), samples::certificate());
        let none = pkcs12_write("server", key, &[], PASSWORD);
        assert_eq!(none, Err(PkiError::NoCertificate));
        assert_eq!(pkcs12_write("server", other, &[certificate], PASSWORD), Err(PkiError::NotAPair));

        let read = |entries: &[(&PrivateKey, &[&Certificate])]| pkcs12_read(&odd(entries), PASSWORD).err();
        assert_eq!(read(&[]), Some(PkiError::NoKey));
        assert_eq!(read(&[(key, &[])]), Some(PkiError::NoCertificate));
        assert_eq!(read(&[(other, &[certificate])]), Some(PkiError::NotAPair));
        assert_eq!(read(&[(key, &[certificate]), (other, &[])]), Some(PkiError::SeveralKeys(2)));
    }
}
