use serde::{Deserialize, Serialize};

/// Names the configuration that a value was read from. A change carries the token of the value that it is based on, so that
/// a controller whose configuration was changed in between refuses it
/// ([`ErrorCode::ChangedMeanwhile`](super::ErrorCode::ChangedMeanwhile)).
///
/// The number means something only to the session driver that made the token: a revision in the management protocol. Tokens
/// are compared for equality and are in no order. Tokens of different controllers have nothing to do with each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct VersionToken(u64);

impl VersionToken {
    /// A token with a number of the driver's choice.
    pub const fn new(number: u64) -> Self {
        Self(number)
    }

    /// The number that the driver gave to [`VersionToken::new`].
    pub const fn number(self) -> u64 {
        self.0
    }
}

/// A value, and the configuration that it was read from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Versioned<T> {
    pub version: VersionToken,
    pub value: T,
}
