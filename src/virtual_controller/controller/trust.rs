use std::sync::Arc;

use tokio::task::spawn_blocking;

use super::change::{AppliedChange, finished};
use super::{ChangeFailure, Controller, ControllerError, Effect};
use crate::model::{ClientList, RevisionToken, TrustStep};
use crate::protocol::{EditTrust, TrustChanged};
use crate::virtual_controller::change_error::TrustError;
use crate::virtual_controller::rejected::{RejectedClients, RejectedEntry};
use crate::virtual_controller::state::{ControllerState, OperatingContext};
use crate::virtual_controller::store::StoreError;
use crate::virtual_controller::trust_changes::{self, RejectedListChanges};

impl Controller {
    /// Changes client lists and CRLs, whole or not at all, even if the one who asked has gone.
    ///
    /// The rejected list is another file than the state. What comes into it is written before the state, what leaves it
    /// after: a process killed in between comes back with a certificate in two lists, and takes it out of this one.
    pub(in super::super) async fn edit_trust(
        self: &Arc<Self>,
        change: EditTrust,
    ) -> Result<TrustChanged, ChangeFailure> {
        let this = Arc::clone(self);
        finished(tokio::spawn(async move { this.edit_trust_now(change).await }).await)
    }

    async fn edit_trust_now(
        self: Arc<Self>,
        EditTrust { revision, steps }: EditTrust,
    ) -> Result<TrustChanged, ChangeFailure> {
        let mut slot = self.server.lock().await;
        let done = if let Some(thumbprints) = only_forgets(&steps) {
            slot.admit()?;
            self.forget(revision, thumbprints).await?
        } else {
            let rejected = Arc::clone(&self.rejected);
            let edit = move |state: &mut ControllerState, context: &OperatingContext| {
                let RejectedListChanges { arrived, left } =
                    trust_changes::edit_trust(state, context, steps, rejected.certificates())?;
                Ok::<_, ControllerError>(RejectedListTransaction::new(rejected, arrived, left)?)
            };
            let AppliedChange { changed, value, cut } = self.apply(&mut slot, revision, Effect::Trust, edit).await?;
            value.settle().await;
            TrustChanged { changed, cut }
        };
        drop(slot);
        self.answer()?;
        Ok(done)
    }

    /// Takes certificates out of the rejected list, which is no part of the configuration.
    async fn forget(&self, revision: RevisionToken, thumbprints: Vec<String>) -> Result<TrustChanged, ControllerError> {
        self.faults.admit_change()?;
        self.check_revision(revision)?;
        let rejected = Arc::clone(&self.rejected);
        let removed = spawn_blocking(move || {
            let held = rejected.certificates();
            if let Some(missing) = thumbprints.iter().find(|thumbprint| !held.contains_key(*thumbprint)) {
                return Err(TrustError::NotInList(missing.clone()).into());
            }
            Ok::<_, ControllerError>(rejected.remove(&thumbprints)?)
        });
        removed.await.map_err(ControllerError::Worker)??;
        Ok(TrustChanged { changed: self.changed(), cut: Vec::new() })
    }
}

/// The rejected list's part of a change; dropped, unless the change comes into force.
struct RejectedListTransaction {
    rejected: Arc<RejectedClients>,
    arrived: Vec<String>,
    /// Entries that had to go for those.
    displaced: Vec<RejectedEntry>,
    left: Vec<String>,
}

impl RejectedListTransaction {
    /// Blocks for the disk.
    fn new(rejected: Arc<RejectedClients>, arrived: Vec<RejectedEntry>, left: Vec<String>) -> Result<Self, StoreError> {
        let thumbprints = arrived.iter().map(|entry| entry.thumbprint.clone()).collect();
        let mut transaction = Self { rejected, arrived: thumbprints, displaced: Vec::new(), left };
        if !arrived.is_empty() {
            transaction.displaced = transaction.rejected.insert(arrived);
            transaction.rejected.write()?;
        }
        Ok(transaction)
    }

    /// The change is in force. That the disk does not hear of it at once does no harm: see [`RejectedClients::open`].
    async fn settle(mut self) {
        self.arrived.clear();
        self.displaced.clear();
        self.rejected.forget(&self.left);
        self.rejected.write_soon().await;
    }
}

impl Drop for RejectedListTransaction {
    fn drop(&mut self) {
        self.rejected.take_back(&self.arrived, std::mem::take(&mut self.displaced));
    }
}

/// The thumbprints, if the steps do nothing but take certificates out of the rejected list.
fn only_forgets(steps: &[TrustStep]) -> Option<Vec<String>> {
    match steps {
        [TrustStep::Remove { list: ClientList::Rejected, thumbprints }] if !thumbprints.is_empty() => {
            Some(thumbprints.clone())
        }
        _ => None,
    }
}
