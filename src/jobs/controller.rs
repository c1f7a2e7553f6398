use crate::model::{Address, Capabilities, ConnectionKind, ControllerInfo, ControllerName};
use crate::pki::Fingerprint;
use crate::session;
use crate::workspace::ControllerEntry;

/// A controller as a job sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct JobController {
    /// Its name in the list of controllers.
    pub name: ControllerName,
    /// Where its management protocol answers.
    pub address: Address,
    /// The protocol that is spoken with it.
    pub connection: ConnectionKind,
    /// The pinned identity; `None` if it was not confirmed yet.
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
