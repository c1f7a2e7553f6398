use serde::{Deserialize, Serialize};

/// What the owner of a certificate is to us.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PeerRole {
    /// It connects to us: extended key usages, if any, must allow client authentication.
    Client,
    /// We connect to it: extended key usages, if any, must allow server authentication.
    Server,
    /// Not known yet: either of both is enough.
    Either,
}
