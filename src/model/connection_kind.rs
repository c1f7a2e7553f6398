use serde::{Deserialize, Serialize};

/// How a controller is configured: the protocol that the program speaks with it. Stored with each controller.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ConnectionKind {
    /// The management protocol over HTTPS. The default, also for a controller stored without a kind.
    #[default]
    Management,
}
