use p12_keystore::error::Error;
use p12_keystore::{EncryptionAlgorithm, KeyStore, KeyStoreEntry, MacAlgorithm, Pkcs12Archive, PrivateKeyChain};
use sha1::{Digest as _, Sha1};
use zeroize::Zeroizing;

use super::{Certificate, PkiError, PrivateKey, tlv};

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
/// Takes the modern algorithms and the old ones of Windows and OpenSSL 1. Exactly one private key is expected. Blocks;
/// how long is up to whoever wrote
/// the file, within a million hashings of the password for each of its parts.
pub fn pkcs12_read(bytes: &[u8], password: &str) -> Result<(PrivateKey, Vec<Certificate>), PkiError> {
    let archive = open(bytes, password)?;
    let key = single_key(&archive)?;
    let mut certificates: Vec<_> =
        archive.certs.iter().map(|bag| Certificate::from_der(bag.cert.as_der())).collect::<Result<_, _>>()?;
    if certificates.is_empty() {
        return Err(PkiError::NoCertificate);
    }
    let leaf = certificates.iter().position(|certificate| key.matches(certificate)).ok_or(PkiError::NotAPair)?;
    certificates[..=leaf].rotate_right(1);
    Ok((key, certificates))
}

/// Reads the only key of a PKCS#12, whatever certificates are beside it; otherwise as [`pkcs12_read`] does.
pub fn pkcs12_read_key(bytes: &[u8], password: &str) -> Result<PrivateKey, PkiError> {
    single_key(&open(bytes, password)?)
}

/// Whether it looks like one from outside.
pub(super) fn is_pkcs12(bytes: &[u8]) -> bool {
    inside(bytes).is_some_and(|inside| inside.starts_with(VERSION_3))
}

/// What stands behind the head of the outermost sequence.
fn inside(bytes: &[u8]) -> Option<&[u8]> {
    match bytes {
        [SEQUENCE, 0x00..=0x80, inside @ ..]
        | [SEQUENCE, 0x81, _, inside @ ..]
        | [SEQUENCE, 0x82, _, _, inside @ ..]
        | [SEQUENCE, 0x83, _, _, _, inside @ ..] => Some(inside),
        _ => None,
    }
}

/// Every key and every certificate of a PKCS#12, whether they belong together or not.
pub(super) struct Contents {
    /// Of whatever kind, in PKCS#8 without encryption.
    pub keys: Vec<Zeroizing<Vec<u8>>>,
    pub certificates: Vec<Certificate>,
}

pub(super) fn contents(bytes: &[u8], password: &str) -> Result<Contents, PkiError> {
    let archive = open(bytes, password)?;
    let keys = archive.keys.iter().map(|bag| Zeroizing::new(bag.key.as_der().to_vec())).collect();
    let certificates: Result<_, _> = archive.certs.iter().map(|bag| Certificate::from_der(bag.cert.as_der())).collect();
    Ok(Contents { keys, certificates: certificates? })
}

fn open(bytes: &[u8], password: &str) -> Result<Pkcs12Archive, PkiError> {
    let has_mac = check_outside(bytes)?;
    Pkcs12Archive::from_pkcs12(bytes, password).map_err(|error| reading(&error, has_mac))
}

/// A PKCS#12 without a MAC around one encrypted private key (EncryptedPrivateKeyInfo).
pub(super) fn around(encrypted_key: &[u8]) -> Vec<u8> {
    let content = |inside: &[u8]| {
        let octets = tlv::write(tlv::OCTET_STRING, &[inside]);
        tlv::write(tlv::SEQUENCE, &[DATA, &tlv::write(tlv::CONTEXT_0, &[&octets])])
    };
    let bag = tlv::write(tlv::SEQUENCE, &[SHROUDED_KEY_BAG, &tlv::write(tlv::CONTEXT_0, &[encrypted_key])]);
    let bags = tlv::write(tlv::SEQUENCE, &[&bag]);
    let safes = tlv::write(tlv::SEQUENCE, &[&content(&bags)]);
    tlv::write(tlv::SEQUENCE, &[VERSION_3, &content(&safes)])
}

fn single_key(archive: &Pkcs12Archive) -> Result<PrivateKey, PkiError> {
    match archive.keys.as_slice() {
        [] => Err(PkiError::NoKey),
        [bag] => PrivateKey::from_pkcs8_der(bag.key.as_der()),
        several => Err(PkiError::SeveralKeys(several.len())),
    }
}

/// Whether this is a PKCS#12 at all, seen from outside, so that everything found wrong later is damage or a password;
/// and whether it has a MAC, which tells the two apart but for damage within what the MAC is about.
fn check_outside(bytes: &[u8]) -> Result<bool, PkiError> {
    if bytes.is_empty() {
        return Err(PkiError::Empty);
    }
    if bytes.len() > MAX_PKCS12_BYTES {
        return Err(PkiError::TooLarge { bytes: bytes.len(), max: MAX_PKCS12_BYTES });
    }
    if bytes.starts_with(&[SEQUENCE, 0x80]) {
        return Err(PkiError::UnsupportedPkcs12("it is in BER, not in DER"));
    }
    if !is_pkcs12(bytes) {
        return Err(PkiError::NotPkcs12);
    }
    let parts = match tlv::all(bytes).as_deref() {
        Some([whole]) => tlv::all(whole.content),
        _ => None,
    };
    Ok(parts.ok_or(PkiError::Damaged)?.len() == 3)
}

fn reading(error: &Error, has_mac: bool) -> PkiError {
    match error {
        Error::UnsupportedEncryptionScheme | Error::UnsupportedMacAlgorithm => {
            PkiError::UnsupportedPkcs12("unknown encryption")
        }
        Error::UnsupportedContentType => PkiError::UnsupportedPkcs12("it is not protected by a password"),
        Error::UnsupportedCertificateType => PkiError::UnsupportedPkcs12("it holds a certificate that is not X.509"),
        Error::InvalidParameters => PkiError::UnsupportedPkcs12("the password is to be hashed too often"),
        Error::MacError(_) => PkiError::WrongPasswordOrDamaged,
        // The MAC was right, or not even reached.
        _ if has_mac => PkiError::Damaged,
        _ => PkiError::WrongPasswordOrDamaged,
    }
}

const SEQUENCE: u8 = tlv::SEQUENCE;
const VERSION_3: &[u8] = &[0x02, 0x01, 0x03];
/// 1.2.840.113549.1.7.1
const DATA: &[u8] = &[0x06, 9, 0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 7, 1];
/// 1.2.840.113549.1.12.10.1.2
const SHROUDED_KEY_BAG: &[u8] = &[0x06, 11, 0x2a, 0x86, 0x48, 0x86, 0xf7, 0x0d, 1, 12, 10, 1, 2];

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
        for bytes in [b"hello, robot".as_slice(), &[0x30], samples::certificate().der()] {
            assert_eq!(pkcs12_read(bytes, PASSWORD).err(), Some(PkiError::NotPkcs12));
        }
        assert_eq!(pkcs12_read(b"", PASSWORD).err(), Some(PkiError::Empty));
        let large = vec![0x30; MAX_PKCS12_BYTES + 1];
        assert!(matches!(pkcs12_read(&large, PASSWORD), Err(PkiError::TooLarge { .. })));
        let ber = [0x30, 0x80, 0x02, 0x01, 0x03];
        assert!(matches!(pkcs12_read(&ber, PASSWORD), Err(PkiError::UnsupportedPkcs12(_))));
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
