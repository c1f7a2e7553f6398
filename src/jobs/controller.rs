use crate::model::{Address, ControllerInfo, ControllerName};
use crate::pki::Fingerprint;
use crate::workspace::ControllerEntry;

/// A controller as a job sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct JobController {
    pub name: ControllerName,
    pub address: Address,
    pub fingerprint: Option<Fingerprint>,
    /// What was read last; lets an operation refuse before anything is sent.
    pub known: Option<ControllerInfo>,
}

impl From<&ControllerEntry> for JobController {
    fn from(entry: &ControllerEntry) -> Self {
        Self {
            name: entry.name.clone(),
            address: entry.address.clone(),
            fingerprint: entry.fingerprint,
            known: entry.last.as_ref().map(|last| last.info.clone()),
        }
    }
}
