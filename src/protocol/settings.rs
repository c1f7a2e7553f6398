//! The basic settings (manual 2.6.1), their export and import (manual 2.6.4, 2.6.5), and activation (manual 2.6.3).

use serde::{Deserialize, Serialize};

use super::request::requests;
use super::response::{MAX_TEXT, check_time};
use super::{Response, SettingsExport, WireSecret};
use crate::model::activation::{ActivationKey, LicenceKey};
use crate::model::{Changed, RevisionToken, Revisioned, ServerSettings};

requests! {
    /// Settings and activation.
    SETTINGS_REQUESTS
    GET "/v1/settings" GetSettings { none } session -> Revisioned<ServerSettings>, "";
    PUT "/v1/settings" SetSettings { json } revision -> Changed, "";
    POST "/v1/settings/export" ExportSettings { json } session -> SettingsExport, "legacy firmware";
    POST "/v1/settings/import" ImportSettings { json } revision -> Changed, "legacy firmware";
    POST "/v1/activation" Activate { json } revision -> Changed, "legacy firmware";
}

/// Reads the basic settings.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetSettings;

impl Response for ServerSettings {}

/// Changes the basic settings (manual 2.6.1).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetSettings {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// The settings as a whole.
    pub settings: ServerSettings,
    /// Deletes the server log as well. Default: false.
    #[serde(default)]
    pub delete_log: bool,
    /// Needed when the server log goes from off to on ([`ServerSettings::LOG_PASSWORD`]). Default: none.
    #[serde(default)]
    pub log_password: Option<String>,
}

/// Legacy firmware: asks for a [`SettingsExport`] (manual 2.6.4).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExportSettings {
    /// The passphrase that the export is sealed with. An empty one is refused with
    /// [`ErrorCode::BadPassphrase`](crate::model::ErrorCode::BadPassphrase).
    pub passphrase: WireSecret,
}

impl Response for SettingsExport {
    /// Changes nothing: the checksum covers the texts.
    fn check(&mut self) -> Result<(), &'static str> {
        if self.format.len() > MAX_TEXT || self.checksum.len() > MAX_TEXT {
            return Err("its export is too large");
        }
        check_time(self.exported)
    }
}

/// Legacy firmware: restores an export, whole or not at all (manual 2.6.5).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImportSettings {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// The export, as the file holds it.
    pub export: SettingsExport,
    /// The passphrase that the export was sealed with.
    pub passphrase: WireSecret,
}

/// Legacy firmware: activates the controller with the keys bought for it (manual 2.6.3).
///
/// The controller checks both keys against its serial number. Keys of another controller are refused with
/// [`ErrorCode::WrongKeys`](crate::model::ErrorCode::WrongKeys) and change nothing.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Activate {
    /// The configuration that the change is based on.
    pub revision: RevisionToken,
    /// The licence key of this controller.
    pub licence: LicenceKey,
    /// The activation key that belongs to it.
    pub activation: ActivationKey,
}
