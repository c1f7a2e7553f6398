use std::collections::BTreeMap;

use secrecy::{ExposeSecret as _, SecretString};
use zeroize::Zeroizing;

use super::error::VaultError;
use super::limits::{MAX_VAULT_PASSWORD_BYTES, MAX_VAULT_PASSWORDS};
use crate::pki::Fingerprint;

/// The connection passwords in a vault, by the identity of their controller. An empty password is a password: the
/// controller has none.
#[derive(Default, Clone)]
pub(super) struct VaultEntries(BTreeMap<Fingerprint, SecretString>);

impl VaultEntries {
    pub fn get(&self, controller: Fingerprint) -> Option<&SecretString> {
        self.0.get(&controller)
    }

    pub fn len(&self) -> usize {
        self.0.len()
    }

    pub fn controllers(&self) -> impl Iterator<Item = Fingerprint> + '_ {
        self.0.keys().copied()
    }

    /// Whether that changes anything.
    pub fn set(&mut self, controller: Fingerprint, password: &SecretString) -> Result<bool, VaultError> {
        if password.expose_secret().len() > MAX_VAULT_PASSWORD_BYTES {
            return Err(VaultError::PasswordTooLong);
        }
        if self.get(controller).is_some_and(|known| known.expose_secret() == password.expose_secret()) {
            return Ok(false);
        }
        if self.len() >= MAX_VAULT_PASSWORDS && self.get(controller).is_none() {
            return Err(VaultError::TooMany);
        }
        self.0.insert(controller, password.clone());
        Ok(true)
    }

    /// Whether it was there.
    pub fn remove(&mut self, controller: Fingerprint) -> bool {
        self.0.remove(&controller).is_some()
    }

    /// The number of entries (4 bytes, big-endian); of each the fingerprint (32), the length of the password (2) and
    /// the password; zeros up to a multiple of [`BLOCK`], so that the size of the file does not tell how long a
    /// password is.
    pub fn encode(&self) -> Zeroizing<Vec<u8>> {
        let passwords = self.0.values().map(|password| password.expose_secret().len());
        let length = COUNT_BYTES + passwords.map(|password| ENTRY_BYTES + password).sum::<usize>();
        // Never grows: a vector that grows leaves secrets behind.
        let mut bytes = Zeroizing::new(Vec::with_capacity(length.next_multiple_of(BLOCK)));
        bytes.extend_from_slice(&(self.len() as u32).to_be_bytes());
        for (controller, password) in &self.0 {
            let password = password.expose_secret().as_bytes();
            bytes.extend_from_slice(controller.as_bytes());
            bytes.extend_from_slice(&(password.len() as u16).to_be_bytes());
            bytes.extend_from_slice(password);
        }
        bytes.resize(length.next_multiple_of(BLOCK), 0);
        bytes
    }

    /// `None`: not what [`VaultEntries::encode`] writes.
    pub fn decode(bytes: &[u8]) -> Option<Self> {
        if !bytes.len().is_multiple_of(BLOCK) {
            return None;
        }
        let (count, mut rest) = bytes.split_first_chunk::<COUNT_BYTES>()?;
        let count = u32::from_be_bytes(*count) as usize;
        let mut entries = BTreeMap::new();
        for _ in 0..count.min(MAX_VAULT_PASSWORDS) {
            let (controller, after) = rest.split_first_chunk::<32>()?;
            let (length, after) = after.split_first_chunk::<2>()?;
            let (password, after) = after.split_at_checked(u16::from_be_bytes(*length).into())?;
            let password = SecretString::from(std::str::from_utf8(password).ok()?);
            entries.insert(Fingerprint::from_bytes(*controller), password);
            rest = after;
        }
        let whole = entries.len() == count && rest.len() < BLOCK && rest.iter().all(|byte| *byte == 0);
        whole.then_some(Self(entries))
    }
}

const COUNT_BYTES: usize = 4;
const ENTRY_BYTES: usize = 32 + 2;
const BLOCK: usize = 1024;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ErrorCode, Problem};

    fn of(passwords: &[(&str, &str)]) -> VaultEntries {
        let mut entries = VaultEntries::default();
        for (controller, password) in passwords {
            assert!(entries.set(Fingerprint::of(controller.as_bytes()), &(*password).into()).unwrap());
        }
        entries
    }

    fn password<'a>(entries: &'a VaultEntries, controller: &str) -> Option<&'a str> {
        entries.get(Fingerprint::of(controller.as_bytes())).map(|password| password.expose_secret())
    }

    #[test]
    fn what_is_encoded_is_decoded_and_its_size_tells_nothing() {
        let entries = of(&[("weld", "plant-password"), ("paint", ""), ("码垛", "密码 \u{1f916}")]);
        let bytes = entries.encode();
        assert_eq!(bytes.len(), of(&[("weld", "x")]).encode().len());
        let read = VaultEntries::decode(&bytes).unwrap();
        assert_eq!(password(&read, "weld"), Some("plant-password"));
        assert_eq!(password(&read, "paint"), Some(""), "no password is an answer");
        assert_eq!(password(&read, "码垛"), Some("密码 \u{1f916}"));
        assert_eq!(password(&read, "nobody"), None);
        assert_eq!(VaultEntries::decode(&VaultEntries::default().encode()).unwrap().len(), 0);
    }

    #[test]
    fn what_was_not_encoded_is_not_decoded() {
        let bytes = of(&[("weld", "plant-password")]).encode();
        for length in 0..bytes.len() {
            assert!(VaultEntries::decode(&bytes[..length]).is_none(), "{length}");
        }
        for (at, to) in [(0, 0xff), (36, 0xff), (38, 0xff), (bytes.len() - 1, 1)] {
            let mut changed = bytes.to_vec();
            changed[at] = to;
            assert!(VaultEntries::decode(&changed).is_none(), "{at}");
        }
        assert!(VaultEntries::decode(&[&bytes[..], &[0; 1024]].concat()).is_none());
    }

    #[test]
    fn a_vault_has_bounds() {
        let mut entries = of(&[("weld", "a")]);
        let controller = Fingerprint::of(b"weld");
        assert!(!entries.set(controller, &"a".into()).unwrap(), "nothing to write");
        assert!(entries.set(controller, &"x".repeat(MAX_VAULT_PASSWORD_BYTES).into()).unwrap());
        let long = entries.set(controller, &"x".repeat(MAX_VAULT_PASSWORD_BYTES + 1).into());
        assert!(matches!(long, Err(VaultError::PasswordTooLong)));
        assert_eq!(Problem::from(long.unwrap_err()).code, ErrorCode::VaultFull);
        for number in 1..MAX_VAULT_PASSWORDS {
            entries.set(Fingerprint::of(&number.to_be_bytes()), &"".into()).unwrap();
        }
        assert!(matches!(entries.set(Fingerprint::of(b"one more"), &"".into()), Err(VaultError::TooMany)));
        assert!(entries.set(controller, &"b".into()).unwrap(), "one that is there may change");
        assert_eq!(VaultEntries::decode(&entries.encode()).unwrap().len(), MAX_VAULT_PASSWORDS);
    }
}
