use std::collections::BTreeMap;

use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize};

/// What the battery of a controller keeps over a power-off: the values of the backup variables, and which parts were
/// replaced.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct BackupMemory {
    /// Variables with another value than 0, False or an empty text.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variables: Vec<KeptVariable>,
    /// When the parts behind an alarm were replaced, by the number of the alarm.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub replaced: BTreeMap<u8, DateTime<Utc>>,
}

/// A backup variable with its values.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeptVariable {
    /// Its name.
    pub name: String,
    /// The keyword of its type.
    #[serde(rename = "type")]
    pub kind: String,
    /// One value, or the elements of an array with the last dimension counted fastest. As text, which loses nothing of a
    /// number.
    pub values: Vec<String>,
}
