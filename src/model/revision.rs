use std::fmt;

use serde::{Deserialize, Serialize};

/// Names the configuration that a value was read from. A change carries the token of the value that it is based on, so that
/// a controller whose configuration was changed in between refuses the change
/// ([`ErrorCode::ChangedMeanwhile`](super::ErrorCode::ChangedMeanwhile)).
///
/// The number means something only to the session driver that made the token; in the management protocol it is the
/// revision. Tokens are compared for equality and have no order. Tokens of different controllers are not comparable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct RevisionToken(u64);

impl RevisionToken {
    /// A token with a number of the driver's choice.
    pub const fn new(number: u64) -> Self {
        Self(number)
    }

    /// The number that was given to [`RevisionToken::new`].
    pub const fn number(self) -> u64 {
        self.0
    }
}

impl fmt::Display for RevisionToken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// A value, and the configuration that it was read from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Revisioned<T> {
    /// The configuration that the value was read from.
    pub revision: RevisionToken,
    /// The value.
    pub value: T,
}
