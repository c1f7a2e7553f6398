use chrono::{DateTime, Utc};

use super::Value;

/// A value as a server gave it (OPC 10000-4 §7.11).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DataValue {
    /// Null if the quality is bad.
    pub value: Value,
    /// How far the value can be trusted.
    pub quality: Quality,
    /// When the value was measured.
    pub source_time: Option<DateTime<Utc>>,
    /// When the server took it in.
    pub server_time: Option<DateTime<Utc>>,
}

/// The severity of a status code, with the code's name unless it is simply good (OPC 10000-4 §7.39).
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub enum Quality {
    /// The value can be used.
    #[default]
    Good,
    /// The value may be inexact or old.
    Uncertain {
        /// For example `UncertainLastUsableValue`.
        name: String,
    },
    /// There is no usable value.
    Bad {
        /// For example `BadNotReadable`.
        name: String,
    },
}

impl Quality {
    /// Whether there is no usable value.
    pub fn is_bad(&self) -> bool {
        matches!(self, Self::Bad { .. })
    }

    /// The name of the status code.
    pub fn name(&self) -> &str {
        match self {
            Self::Good => "Good",
            Self::Uncertain { name } | Self::Bad { name } => name,
        }
    }
}
