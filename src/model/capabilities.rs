use super::{ErrorCode, Problem};

/// Something that a program can do to a controller, and that not every controller offers over every kind of connection.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Feature {
    /// The OPC UA server is started and stopped.
    ServerControl,
    /// The basic settings are read and changed (manual 2.6.1).
    Settings,
    /// The users of the OPC UA server are read, added and removed (manual 2.6.2).
    Users,
    /// The controller is activated with keys (manual 2.6.3).
    ActivationKeys,
    /// Settings, users and activation keys are exported and imported (manual 2.6.4, 2.6.5).
    SettingsTransfer,
    /// Server certificates are read and selected (manual 2.7.2).
    ServerCertificates,
    /// The controller makes the keys of its server certificates itself; they never leave it.
    KeysMadeInController,
    /// The controller accepts a private key that was made elsewhere.
    KeyImport,
    /// The controller has a place for a server certificate made with another tool (manual 2.7.1.4).
    UserSpecifiedCertificate,
    /// Client certificate lists and CRLs are read and changed (manual 2.7.3).
    ClientLists,
    /// There is a list of issuers that complete chains but are not trusted by themselves (manual 2.7.3).
    IssuersList,
    /// The server log is read (manual 6.3).
    ServerLog,
}

impl Feature {
    const COUNT: usize = Self::ServerLog as usize + 1;
}

/// Why a controller does not offer a feature.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MissingReason {
    /// Its firmware is too old.
    FirmwareTooOld,
    /// Its firmware is too new: the feature was replaced by another one.
    FirmwareTooNew,
    /// The feature does not exist over this kind of connection.
    NotOverThisConnection,
}

impl From<MissingReason> for Problem {
    fn from(reason: MissingReason) -> Self {
        match reason {
            MissingReason::FirmwareTooOld => ErrorCode::FirmwareTooOld.into(),
            MissingReason::FirmwareTooNew => ErrorCode::FirmwareTooNew.into(),
            MissingReason::NotOverThisConnection => {
                Self::with_detail(ErrorCode::Refused, "this way of reaching the controller does not offer it")
            }
        }
    }
}

/// What a controller offers over its connection. A feature that is not named as missing is offered.
///
/// Without memory of its own: the window asks it for every ticked controller in each frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Capabilities {
    /// By the number of the feature.
    missing: [Option<MissingReason>; Feature::COUNT],
}

impl Capabilities {
    /// Every feature.
    pub const fn all() -> Self {
        Self { missing: [None; Feature::COUNT] }
    }

    /// The same, but for these features.
    #[must_use]
    pub fn without(mut self, features: &[Feature], reason: MissingReason) -> Self {
        for feature in features {
            self.missing[*feature as usize] = Some(reason);
        }
        self
    }

    /// Whether the controller offers this feature.
    pub fn offers(&self, feature: Feature) -> bool {
        self.missing(feature).is_none()
    }

    /// The reason why a feature is missing; `None` if it is offered.
    pub fn missing(&self, feature: Feature) -> Option<MissingReason> {
        self.missing[feature as usize]
    }

    /// An error if the feature is missing: [`ErrorCode::FirmwareTooOld`], [`ErrorCode::FirmwareTooNew`], or
    /// [`ErrorCode::Refused`] where the connection does not offer it.
    pub fn require(&self, feature: Feature) -> Result<(), Problem> {
        self.missing(feature).map_or(Ok(()), |reason| Err(reason.into()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_feature_is_refused_with_its_reason() {
        let capabilities = Capabilities::all()
            .without(&[Feature::IssuersList], MissingReason::FirmwareTooOld)
            .without(&[Feature::Users, Feature::ServerLog], MissingReason::NotOverThisConnection);
        assert_eq!(capabilities.require(Feature::Settings), Ok(()));
        assert_eq!(capabilities.require(Feature::IssuersList), Err(ErrorCode::FirmwareTooOld.into()));
        assert_eq!(capabilities.require(Feature::Users).map_err(|problem| problem.code), Err(ErrorCode::Refused));
        assert!(!capabilities.offers(Feature::ServerLog) && capabilities.offers(Feature::ClientLists));
    }
}
