use serde::{Deserialize, Serialize};

use crate::model::activation::{ActivationKey, LicenceKey};

/// Legacy firmware: the keys bought for this controller (manual 2.6.3).
///
/// The controller checks both against its serial number; keys that are not its own are refused with
/// [`ErrorCode::WrongKeys`](crate::model::ErrorCode::WrongKeys) and change nothing.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Activate {
    pub revision: u64,
    pub licence: LicenceKey,
    pub activation: ActivationKey,
}
