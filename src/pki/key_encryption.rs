use pkcs5::der::Encode as _;
use pkcs5::pbes2;
use secrecy::{ExposeSecret as _, SecretString};
use zeroize::Zeroizing;

use super::{PkiError, PrivateKey, pem, tlv};
use crate::model::{with_cause, with_told_cause};

/// How often the passphrase is hashed: what OWASP recommends for PBKDF2 with HMAC-SHA-256. Each try takes
/// about half a second, with the right passphrase as with a wrong one.
const ITERATIONS: u32 = 600_000;

/// Writes a key under a passphrase, as PEM: encrypted PKCS#8 with PBES2, PBKDF2 with HMAC-SHA-256, and AES-256.
///
/// [`read_key_file`](super::read_key_file) reads it back, and so do OpenSSL from 1.0 on, Java, Windows and XCA. Blocks
/// while the passphrase is hashed.
pub fn encrypt_key(key: &PrivateKey, passphrase: &SecretString) -> Result<Zeroizing<String>, PkiError> {
    let (mut salt, mut iv) = ([0; 16], [0; 16]);
    for bytes in [&mut salt, &mut iv] {
        getrandom::fill(bytes).map_err(with_told_cause(PkiError::Random))?;
    }
    let parameters = pbes2::Parameters::generate_pbkdf2_sha256_aes256cbc(ITERATIONS, &salt, iv)
        .map_err(with_cause(PkiError::KeyEncoding))?;
    let pkcs8 = key.to_pkcs8_der()?;
    let encrypted =
        parameters.encrypt(passphrase.expose_secret().as_bytes(), &pkcs8).map_err(with_cause(PkiError::KeyEncoding))?;
    let algorithm = pkcs5::EncryptionScheme::from(parameters).to_der().map_err(with_cause(PkiError::KeyEncoding))?;
    let octets = tlv::write(tlv::OCTET_STRING, &[&encrypted]);
    Ok(pem::encrypted_key(&tlv::write(tlv::SEQUENCE, &[&algorithm, &octets])).into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pki::{read_key_file, samples};

    #[test]
    fn only_the_passphrase_gives_the_key_back() {
        for passphrase in ["correct horse", "Größe 密码 🔑", &"x".repeat(200)] {
            let pem = encrypt_key(samples::key(), &SecretString::from(passphrase)).unwrap();
            assert!(pem.starts_with("-----BEGIN ENCRYPTED PRIVATE KEY-----\n"));
            let read = read_key_file(pem.as_bytes(), Some(passphrase)).unwrap();
            assert_eq!(read.public_key(), samples::key().public_key(), "{passphrase}");
            let wrong = read_key_file(pem.as_bytes(), Some("correct house")).err();
            assert_eq!(wrong, Some(PkiError::WrongPasswordOrDamaged));
            assert_ne!(*pem, *encrypt_key(samples::key(), &SecretString::from(passphrase)).unwrap(), "salted");
        }
    }
}
