use std::collections::BTreeMap;

use async_trait::async_trait;

use super::TrustSnapshot;
use super::change::apply;
use crate::jobs::{Confirmation, JobController, Operation, Outcome, Run, Step};
use crate::model::{ClientList, ControllerName, ErrorCode, Problem};
use crate::protocol::{Base64Bytes, TrustStep};

/// What puts the lists and CRLs of one controller back to what they were before a change.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TrustUndo(Vec<TrustStep>);

/// Takes changes back, each in the controller it was made in.
///
/// All or nothing in each controller, whatever else was changed meanwhile; refused where that makes it impossible. Its
/// own [`TrustUndo`] does the change once more.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UndoTrust(pub BTreeMap<ControllerName, TrustUndo>);

#[async_trait]
impl Operation for UndoTrust {
    fn confirmation(&self) -> Option<Confirmation> {
        Some(Confirmation { disconnects_clients: true, ..Confirmation::default() })
    }

    fn check(&self, controller: &JobController) -> Result<(), Problem> {
        if self.0.contains_key(&controller.name) {
            return Ok(());
        }
        Err(Problem::with_detail(ErrorCode::Refused, "nothing was changed here that could be taken back"))
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Outcome, Problem> {
        run.begin(Step::Read)?;
        let before = TrustSnapshot::read(run.session).await?;
        let steps = self.0.get(&run.controller.name).map(|undo| undo.0.clone()).unwrap_or_default();
        apply(run, before, steps, None).await
    }
}

/// What makes `before` of `after` again; `None` if they are the same, or nothing can.
pub(super) fn undo(before: &TrustSnapshot, after: &TrustSnapshot) -> Option<TrustUndo> {
    let mut steps = Vec::new();
    let gone_crls = difference(ids(after), ids(before));
    if !gone_crls.is_empty() {
        steps.push(TrustStep::RemoveCrls { ids: gone_crls });
    }
    // What was put into a list goes back where it came from, before anything is put there: a full list has room then.
    for list in LISTS {
        for from in [ClientList::Rejected, other(list)] {
            let came = difference(after.thumbprints(list), before.thumbprints(list));
            let back: Vec<String> = came.into_iter().filter(|t| left(before, after, from, t)).collect();
            if !back.is_empty() {
                steps.push(TrustStep::Move { from: list, to: from, thumbprints: back });
            }
        }
        let new: Vec<String> = difference(after.thumbprints(list), before.thumbprints(list))
            .into_iter()
            .filter(|t| !left(before, after, ClientList::Rejected, t) && !left(before, after, other(list), t))
            .collect();
        if !new.is_empty() {
            steps.push(TrustStep::Remove { list, thumbprints: new });
        }
    }
    for list in LISTS {
        let lost: Vec<(String, Base64Bytes)> = before
            .listed(list)
            .iter()
            .filter(|was| {
                let thumbprint = &was.summary.thumbprint;
                !after.holds(list, thumbprint) && !arrived(before, after, other(list), thumbprint)
            })
            .map(|was| (was.file_name.clone(), was.certificate.clone()))
            .collect();
        if !lost.is_empty() {
            steps.push(TrustStep::Add { list, certificates: lost });
        }
    }
    let lost: Vec<(String, Base64Bytes)> = before
        .crls
        .iter()
        .filter(|was| !after.holds_crl(&was.summary.id))
        .filter_map(|was| Some((was.file_name.clone(), was.crl.clone()?)))
        .collect();
    if !lost.is_empty() {
        steps.push(TrustStep::AddCrls { crls: lost });
    }
    (!steps.is_empty()).then_some(TrustUndo(steps))
}

const LISTS: [ClientList; 2] = [ClientList::Trusted, ClientList::Issuers];

const fn other(list: ClientList) -> ClientList {
    match list {
        ClientList::Issuers => ClientList::Trusted,
        ClientList::Trusted | ClientList::Rejected => ClientList::Issuers,
    }
}

fn left(before: &TrustSnapshot, after: &TrustSnapshot, list: ClientList, thumbprint: &str) -> bool {
    before.holds(list, thumbprint) && !after.holds(list, thumbprint)
}

fn arrived(before: &TrustSnapshot, after: &TrustSnapshot, list: ClientList, thumbprint: &str) -> bool {
    left(after, before, list, thumbprint)
}

fn ids(lists: &TrustSnapshot) -> impl Iterator<Item = &str> {
    lists.crls.iter().map(|crl| crl.summary.id.as_str())
}

/// What is in `these` but not in `those`.
fn difference<'a>(these: impl Iterator<Item = &'a str>, those: impl Iterator<Item = &'a str>) -> Vec<String> {
    let those: Vec<&str> = those.collect();
    these.filter(|this| !those.contains(this)).map(ToOwned::to_owned).collect()
}
