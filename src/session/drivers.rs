use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use super::{Connector, ManagementConnector, management};
use crate::model::{Capabilities, ConnectionKind, ControllerInfo, MissingReason, Problem};

/// The driver of each kind of connection.
#[derive(Clone)]
pub struct Connectors(BTreeMap<ConnectionKind, Arc<dyn Connector>>);

impl Connectors {
    /// Every driver of this program, with its default timeouts.
    pub fn standard() -> Self {
        Self::from(Arc::new(ManagementConnector::default()))
    }

    /// The driver of a kind of connection. An error if there is none ([`MissingReason::NotOverThisConnection`]).
    pub fn get(&self, kind: ConnectionKind) -> Result<&Arc<dyn Connector>, Problem> {
        self.0.get(&kind).ok_or_else(|| MissingReason::NotOverThisConnection.into())
    }
}

/// One driver, for [`ConnectionKind::Management`].
impl<C: Connector + 'static> From<Arc<C>> for Connectors {
    fn from(connector: Arc<C>) -> Self {
        Self(BTreeMap::from([(ConnectionKind::Management, connector as Arc<dyn Connector>)]))
    }
}

impl fmt::Debug for Connectors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_set().entries(self.0.keys()).finish()
    }
}

/// What a controller offers that is not connected, as far as its kind of connection and its latest information tell.
/// Without information, all that the kind of connection offers.
pub fn capabilities(kind: ConnectionKind, last: Option<&ControllerInfo>) -> Capabilities {
    match kind {
        ConnectionKind::Management => management::capabilities(last.map(|info| info.firmware)),
    }
}
