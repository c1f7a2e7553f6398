use crate::model::{Capabilities, Feature, FirmwareGeneration, FirmwareVersion, MissingReason};

/// What firmware offers over the management protocol; `None`: every feature of every firmware.
pub fn capabilities(firmware: Option<FirmwareVersion>) -> Capabilities {
    match firmware.map(FirmwareVersion::generation) {
        None => Capabilities::all(),
        Some(FirmwareGeneration::Legacy) => Capabilities::all()
            .without(&[Feature::KeysMadeInController, Feature::IssuersList], MissingReason::FirmwareTooOld),
        Some(FirmwareGeneration::Current) => Capabilities::all().without(
            &[
                Feature::ActivationKeys,
                Feature::SettingsTransfer,
                Feature::KeyImport,
                Feature::UserSpecifiedCertificate,
            ],
            MissingReason::FirmwareTooNew,
        ),
    }
}
