use async_trait::async_trait;

use super::TrustSnapshot;
use super::change::{TrustChange, apply};
use crate::jobs::{Confirmation, JobStep, Operation, OperationRun};
use crate::model::{ClientList, ErrorCode, Language, Problem, RevisionToken, TrustStep};

/// Moves certificates from one client list into another, such as a refused client into the trusted list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MoveClients {
    /// The list that holds the certificates.
    pub from: ClientList,
    /// The list they go into.
    pub to: ClientList,
    /// SHA-1, upper-case hexadecimal.
    pub thumbprints: Vec<String>,
    /// A person agreed to what [`TrustSnapshot::notes_of_move`] says; without that, certificates with a note are not
    /// moved: [`ErrorCode::NotConfirmed`].
    pub accept_notes: bool,
    /// The configuration that a dialog showed; `None` bases the change on the present one.
    pub based_on: Option<RevisionToken>,
}

#[async_trait]
impl Operation for MoveClients {
    type Output = TrustChange;

    fn confirmation(&self) -> Option<Confirmation> {
        let disconnects_clients = self.from != ClientList::Rejected;
        Some(Confirmation { disconnects_clients, ..Confirmation::default() })
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<TrustChange, Problem> {
        run.begin(JobStep::Read)?;
        let before = TrustSnapshot::read(run.session).await?;
        if let Some(missing) = self.thumbprints.iter().find(|t| !before.holds(self.from, t)) {
            return Err(Problem::with_detail(ErrorCode::NotInList, missing));
        }
        if let Some(held) = self.thumbprints.iter().find(|t| before.holds(self.to, t)) {
            return Err(Problem::with_detail(ErrorCode::DuplicateCertificate, held));
        }
        let (have, limit) = match self.to {
            ClientList::Trusted => (before.trusted.len(), before.limits.trusted),
            ClientList::Issuers => (before.issuers.len(), before.limits.issuers),
            // Bounded by the controller, which makes room by itself.
            ClientList::Rejected => (0, usize::MAX),
        };
        if have + self.thumbprints.len() > limit {
            let detail = format!("{} > {limit}", have + self.thumbprints.len());
            return Err(Problem::with_detail(ErrorCode::ListFull, detail));
        }
        let (before, notes) = self.notes(run, before).await?;
        if !self.accept_notes && !notes.is_empty() {
            return Err(Problem::with_detail(ErrorCode::NotConfirmed, notes.join("; ")));
        }
        let step = TrustStep::Move { from: self.from, to: self.to, thumbprints: self.thumbprints.clone() };
        apply(run, before, vec![step], self.based_on).await
    }
}

impl MoveClients {
    /// In English, with the name of each certificate. Checks signatures: off the async threads.
    async fn notes(
        &self,
        run: &OperationRun<'_>,
        before: TrustSnapshot,
    ) -> Result<(TrustSnapshot, Vec<String>), Problem> {
        let (to, thumbprints) = (self.to, self.thumbprints.clone());
        run.off_thread(move || {
            let notes = before.notes_of_move(to, &thumbprints);
            let said = notes.iter().flat_map(|(thumbprint, notes)| {
                notes.iter().map(move |note| format!("{thumbprint}: {}", note.text(Language::En)))
            });
            let said = said.collect();
            Ok((before, said))
        })
        .await
    }
}
