//! The work of the store of connection passwords.

use std::sync::Arc;

use parking_lot::Mutex;

use crate::model::{ErrorCode, Problem};
use crate::ui::model::{BackendEvent, VaultWork};
use crate::workspace::{PasswordStore, Passwords, StoreStatus};

impl VaultWork {
    /// Blocks for as long as it takes. The result of what a dialog waits for; `None` for the rest.
    pub(super) fn run(self, store: Option<&PasswordStore>) -> Option<Result<(), Problem>> {
        let Some(store) = store else { return Some(Err(ErrorCode::VaultMissing.into())) };
        match self {
            Self::Create { passphrase, controllers } => {
                Some(store.create_vault(&passphrase, &controllers).map(drop).map_err(Problem::from))
            }
            Self::Open { passphrase } => Some(store.open_vault(&passphrase).map(drop).map_err(Problem::from)),
            Self::ChangePassphrase { passphrase, new } => {
                Some(store.change_passphrase(&passphrase, &new).map_err(Problem::from))
            }
            Self::Use(place) => {
                store.use_place(place);
                None
            }
            Self::Decline => {
                store.decline_vault();
                None
            }
            Self::Close => {
                store.close_vault();
                None
            }
        }
    }
}

/// Reports what the store is like whenever that has changed.
pub(super) struct StoreReporter {
    pub passwords: Arc<dyn Passwords>,
    pub emit: Arc<dyn Fn(BackendEvent) + Send + Sync>,
    pub last: Mutex<Option<StoreStatus>>,
}

impl StoreReporter {
    /// May wait for a vault that is being opened: not for the window's thread.
    pub fn report(&self) {
        let Some(store) = self.passwords.store() else { return };
        // Held until it is emitted, so that the last report is the newest.
        let mut last = self.last.lock();
        let status = store.status();
        if last.replace(status) != Some(status) {
            (self.emit)(BackendEvent::PasswordStore(status));
        }
    }
}
