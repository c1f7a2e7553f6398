use serde::{Deserialize, Serialize};

use super::FirmwareGeneration;

/// The lists a controller keeps of client certificates (manual 2.7.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ClientList {
    /// Certificates and authorities whose clients are let in.
    Trusted,
    /// What knocked and was refused, kept by the controller.
    Rejected,
    /// Authorities that complete chains but are not trusted by themselves. Current firmware only.
    Issuers,
}

impl ClientList {
    /// `trusted`, `issuers` or `rejected`: the word in JSON and on the command line.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Trusted => "trusted",
            Self::Rejected => "rejected",
            Self::Issuers => "issuers",
        }
    }
}

/// How much fits into each list of one controller, as the controller itself reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListLimits {
    /// Most certificates in the trusted list.
    pub trusted: usize,
    /// 0 where the firmware has no such list.
    pub issuers: usize,
    /// Most CRLs.
    pub crls: usize,
}

impl ListLimits {
    /// The limits of current firmware: assumed for a controller that was not read yet.
    pub const LARGEST: Self = Self::of(FirmwareGeneration::Current);

    /// The limits of firmware without an issuers list.
    pub const WITHOUT_ISSUERS: Self = Self::of(FirmwareGeneration::Legacy);

    /// The smaller limit for each list.
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self {
            trusted: self.trusted.min(other.trusted),
            issuers: self.issuers.min(other.issuers),
            crls: self.crls.min(other.crls),
        }
    }

    /// The manual gives both 10 and 50; the smaller holds for legacy firmware.
    pub const fn of(generation: FirmwareGeneration) -> Self {
        match generation {
            FirmwareGeneration::Legacy => Self { trusted: 10, issuers: 0, crls: 10 },
            FirmwareGeneration::Current => Self { trusted: 50, issuers: 50, crls: 50 },
        }
    }
}
