//! Sentences about where connection passwords are kept.

use crate::workspace::StoreStatus;

in_every_language! {
    vault:
    /// What the keyring and the vault are like.
    fn vault_state(store: &StoreStatus) -> String;
}
