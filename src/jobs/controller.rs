use crate::model::{Address, Capabilities, ConnectionKind, ControllerInfo, ControllerName};
use crate::pki::Fingerprint;
use crate::session;
use crate::workspace::ControllerEntry;

/// A controller as a job sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct JobController {
    pub name: ControllerName,
    pub address: Address,
    pub connection: ConnectionKind,
    pub fingerprint: Option<Fingerprint>,
    /// What was read last; lets an operation refuse before anything is sent.
    pub known: Option<ControllerInfo>,
}

impl From<&ControllerEntry> for JobController {
    fn from(entry: &ControllerEntry) -> Self {
        Self {
            name: entry.name.clone(),
            address: entry.address.clone(),
            connection: entry.connection,
            fingerprint: entry.fingerprint,
            known: entry.last.as_ref().map(|last| last.info.clone()),
        }
    }
}

impl JobController {
    /// What the controller offers, as far as its kind of connection and its latest information tell.
    pub fn capabilities(&self) -> Capabilities {
        session::capabilities(self.connection, self.known.as_ref())
    }
}
