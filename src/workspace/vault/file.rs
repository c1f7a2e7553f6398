use secrecy::SecretString;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};
use zeroize::Zeroizing;

use crate::model::Base64Bytes;
use crate::pki::{SealCost, SealError, Sealed, SealingKey};

/// `passwords.vault`, a JSON object with exactly these members.
///
/// `sealed` is encrypted with AES-256-GCM under a key that Argon2id ([`SealCost::PC`]) makes of the passphrase and
/// `salt`; format and version are authenticated with it. `checksum` is the SHA-256 of everything else, so that damage is
/// told from a wrong passphrase.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct VaultFile {
    format: String,
    version: u32,
    salt: Base64Bytes,
    nonce: Base64Bytes,
    sealed: Base64Bytes,
    /// Lower-case hexadecimal.
    checksum: String,
}

/// Why bytes are not a vault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum VaultFormatError {
    Damaged(String),
    Version(u32),
}

pub(super) const VERSION: u32 = 1;
const FORMAT: &str = "opcua-configurator-vault";

/// A larger file is not a vault: the most passwords of the greatest length take 28 MB in base64.
pub(super) const MAX_VAULT_BYTES: u64 = 32 * 1024 * 1024;

/// What the key must be, and what was sealed.
pub(super) fn parse(bytes: &[u8]) -> Result<Sealed, VaultFormatError> {
    /// What every version has.
    #[derive(Deserialize)]
    struct VaultHeader {
        format: String,
        version: u32,
    }
    let damaged = |reason: &str| VaultFormatError::Damaged(reason.to_owned());
    let place = |e: serde_json::Error| VaultFormatError::Damaged(format!("line {}, column {}", e.line(), e.column()));
    if bytes.len() as u64 > MAX_VAULT_BYTES {
        return Err(VaultFormatError::Damaged(format!("it has more than {MAX_VAULT_BYTES} bytes")));
    }
    let head: VaultHeader = serde_json::from_slice(bytes).map_err(place)?;
    if head.format != FORMAT {
        return Err(damaged("another format"));
    }
    if head.version != VERSION {
        return Err(VaultFormatError::Version(head.version));
    }
    let file: VaultFile = serde_json::from_slice(bytes).map_err(place)?;
    let sealed = Sealed {
        salt: file.salt.0.as_slice().try_into().map_err(|_| damaged("the salt has another length"))?,
        nonce: file.nonce.0.as_slice().try_into().map_err(|_| damaged("the nonce has another length"))?,
        bytes: file.sealed.0,
    };
    if file.checksum != checksum(&sealed) {
        return Err(damaged("its checksum differs"));
    }
    Ok(sealed)
}

/// The file that holds `plain`.
pub(super) fn write(plain: &[u8], key: &SealingKey) -> Result<Vec<u8>, SealError> {
    let sealed = key.seal(plain, context().as_bytes())?;
    let file = VaultFile {
        format: FORMAT.to_owned(),
        version: VERSION,
        checksum: checksum(&sealed),
        salt: Base64Bytes(sealed.salt.to_vec()),
        nonce: Base64Bytes(sealed.nonce.to_vec()),
        sealed: Base64Bytes(sealed.bytes),
    };
    let mut json = serde_json::to_vec_pretty(&file).unwrap_or_default();
    json.push(b'\n');
    Ok(json)
}

/// Blocks for some hundred milliseconds.
pub(super) fn key(sealed: &Sealed, passphrase: &SecretString) -> Result<SealingKey, SealError> {
    SealingKey::with_salt(passphrase, sealed.salt, SealCost::PC)
}

pub(super) fn open(sealed: &Sealed, key: &SealingKey) -> Result<Zeroizing<Vec<u8>>, SealError> {
    key.open(sealed, context().as_bytes())
}

fn context() -> String {
    format!("{FORMAT} {VERSION}")
}

fn checksum(sealed: &Sealed) -> String {
    let mut hash = Sha256::new();
    hash.update(context());
    hash.update(sealed.salt);
    hash.update(sealed.nonce);
    hash.update(&sealed.bytes);
    hex::encode(hash.finalize())
}
