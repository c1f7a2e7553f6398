use std::fmt;

use chrono::{DateTime, SecondsFormat, Utc};
use secrecy::SecretString;
use serde::{Deserialize, Serialize};
use sha2::{Digest as _, Sha256};
use thiserror::Error;

use crate::model::activation::ActivationKeys;
use crate::model::{
    Base64Bytes, ControllerSeries, ErrorCode, FirmwareVersion, Problem, SerialNumber, ServerSettings, UserName, text,
    with_sources,
};
use crate::pki::{SEAL_NONCE_BYTES, SEAL_SALT_BYTES, SealError, Sealed, open, seal};

/// The settings of one controller, sealed by it: what `option.json` holds.
///
/// Format 1 is a JSON object with exactly these members. Its origin is readable without the passphrase and protected
/// against change. The content, an [`ExportContent`] as JSON, is encrypted with AES-256-GCM under a key that Argon2id
/// (19456 KiB, 2 passes, 1 lane) makes of the passphrase and `salt`. What is authenticated with it is the text of
/// [`SettingsExport::context`]. `checksum` is the SHA-256 of that text and `sealed`, so that damage can be told from a
/// wrong passphrase.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SettingsExport {
    /// Always [`EXPORT_FORMAT`].
    pub format: String,
    /// Always [`EXPORT_VERSION`].
    pub version: u32,
    /// Serial number of the controller that made the export.
    pub serial: SerialNumber,
    /// Series of that controller.
    pub series: ControllerSeries,
    /// Firmware that made the export.
    pub firmware: FirmwareVersion,
    /// By the controller's clock; whole seconds.
    pub exported: DateTime<Utc>,
    /// Salt of Argon2id, 16 bytes.
    pub salt: Base64Bytes,
    /// Nonce of AES-256-GCM, 12 bytes.
    pub nonce: Base64Bytes,
    /// The encrypted [`ExportContent`], with its authentication tag.
    pub sealed: Base64Bytes,
    /// Lower-case hexadecimal.
    pub checksum: String,
}

/// What an export holds: everything manual 2.6.1 to 2.6.3 sets. Certificates have their own backup.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExportContent {
    /// The basic settings.
    pub settings: ServerSettings,
    /// The users, with their password hashes.
    pub users: Vec<ExportedUser>,
    /// `None`: the controller was not activated by keys; an import then leaves its activation as it is.
    pub activation: Option<ActivationKeys>,
}

/// One user of an export.
#[derive(Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExportedUser {
    /// Name of the user.
    pub name: UserName,
    /// Argon2id, as a PHC string: the password itself is not stored.
    pub password_hash: String,
}

/// `format` of every export.
pub const EXPORT_FORMAT: &str = "opcua-controller-settings";
/// `version` of the exports that this program reads and writes.
pub const EXPORT_VERSION: u32 = 1;
/// A larger file is not an export: ten users take 3 KB.
pub const MAX_EXPORT_BYTES: usize = 256 * 1024;

/// Why an export cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ExportError {
    /// The file is larger than an export may be.
    #[error("the file has more than {MAX_EXPORT_BYTES} bytes")]
    TooLarge,
    /// The bytes are no export; holds why.
    #[error("the file is not a settings export: {0}")]
    NotAnExport(String),
    /// The export has a version that is not known; holds it.
    #[error("the file is of format {0}; this program knows format {EXPORT_VERSION}")]
    Version(u32),
    /// The file was changed after it was made: the checksum does not fit.
    #[error("its checksum differs")]
    Checksum,
    /// The export was made by another controller.
    #[error("it belongs to {series} {serial}")]
    AnotherController {
        /// Series of that controller.
        series: ControllerSeries,
        /// Serial number of that controller.
        serial: SerialNumber,
    },
    /// The export was made by newer firmware.
    #[error("it was exported from firmware {export}, which is newer than the controller's {controller}")]
    NewerFirmware {
        /// Firmware that made the export.
        export: FirmwareVersion,
        /// Firmware of the controller.
        controller: FirmwareVersion,
    },
    /// The passphrase is not the one that the export was sealed with.
    #[error("the passphrase does not open it")]
    WrongPassphrase,
    /// Sealing or opening failed.
    #[error(transparent)]
    Failed(SealError),
}

impl From<ExportError> for Problem {
    fn from(error: ExportError) -> Self {
        let code = match &error {
            ExportError::TooLarge | ExportError::NotAnExport(_) | ExportError::Checksum => ErrorCode::ExportDamaged,
            ExportError::Version(_) | ExportError::NewerFirmware { .. } => ErrorCode::ExportVersion,
            ExportError::AnotherController { .. } => ErrorCode::ExportOfAnother,
            ExportError::WrongPassphrase => return ErrorCode::WrongPassphrase.into(),
            ExportError::Failed(_) => ErrorCode::Internal,
        };
        Self::with_detail(code, with_sources(&error))
    }
}

impl From<SealError> for ExportError {
    fn from(error: SealError) -> Self {
        if error == SealError::NotOpened { Self::WrongPassphrase } else { Self::Failed(error) }
    }
}

impl SettingsExport {
    /// Seals what a controller holds. Takes tens of milliseconds.
    pub fn new(
        (serial, series, firmware): (SerialNumber, ControllerSeries, FirmwareVersion),
        exported: DateTime<Utc>,
        content: &ExportContent,
        passphrase: &SecretString,
    ) -> Result<Self, ExportError> {
        let mut export = Self {
            format: EXPORT_FORMAT.to_owned(),
            version: EXPORT_VERSION,
            serial,
            series,
            firmware,
            exported: DateTime::from_timestamp(exported.timestamp(), 0).unwrap_or(exported),
            salt: Base64Bytes(Vec::new()),
            nonce: Base64Bytes(Vec::new()),
            sealed: Base64Bytes(Vec::new()),
            checksum: String::new(),
        };
        let plain = serde_json::to_vec(content).map_err(|e| ExportError::NotAnExport(e.to_string()))?;
        let plain = zeroize::Zeroizing::new(plain);
        let Sealed { salt, nonce, bytes } = seal(&plain, export.context().as_bytes(), passphrase)?;
        export.salt = Base64Bytes(salt.to_vec());
        export.nonce = Base64Bytes(nonce.to_vec());
        export.sealed = Base64Bytes(bytes);
        export.checksum = export.sum();
        Ok(export)
    }

    /// Reads a file, in an encoding of [`text::decode`]. What is in it is not opened, but whole.
    pub fn from_json(bytes: &[u8]) -> Result<Self, ExportError> {
        /// What every format has.
        #[derive(Deserialize)]
        struct ExportHeader {
            format: String,
            version: u32,
        }
        // Not what serde found instead: it might quote a secret of some other file.
        let place =
            |e: serde_json::Error| ExportError::NotAnExport(format!("line {}, column {}", e.line(), e.column()));
        if bytes.len() > MAX_EXPORT_BYTES {
            return Err(ExportError::TooLarge);
        }
        let text = text::decode(bytes).map_err(|e| ExportError::NotAnExport(e.to_string()))?;
        let head: ExportHeader = serde_json::from_str(&text).map_err(place)?;
        if head.format != EXPORT_FORMAT {
            return Err(ExportError::NotAnExport("another format".to_owned()));
        }
        if head.version != EXPORT_VERSION {
            return Err(ExportError::Version(head.version));
        }
        let export: Self = serde_json::from_str(&text).map_err(place)?;
        export.check()?;
        Ok(export)
    }

    /// The file `option.json`: JSON with line ends, for people to look at.
    pub fn to_json(&self) -> Vec<u8> {
        let mut json = serde_json::to_vec_pretty(self).unwrap_or_default();
        json.push(b'\n');
        json
    }

    /// Whether this controller may have it: the same one, with firmware that is not older.
    pub fn check_for(
        &self,
        serial: &SerialNumber,
        series: ControllerSeries,
        firmware: FirmwareVersion,
    ) -> Result<(), ExportError> {
        if self.serial != *serial || self.series != series {
            return Err(ExportError::AnotherController { series: self.series, serial: self.serial.clone() });
        }
        if self.firmware > firmware {
            return Err(ExportError::NewerFirmware { export: self.firmware, controller: firmware });
        }
        Ok(())
    }

    /// What it holds. Takes tens of milliseconds.
    pub fn open(&self, passphrase: &SecretString) -> Result<ExportContent, ExportError> {
        self.check()?;
        let odd = |_| ExportError::Checksum;
        let sealed = Sealed {
            salt: <[u8; SEAL_SALT_BYTES]>::try_from(self.salt.0.as_slice()).map_err(odd)?,
            nonce: <[u8; SEAL_NONCE_BYTES]>::try_from(self.nonce.0.as_slice()).map_err(odd)?,
            bytes: self.sealed.0.clone(),
        };
        let plain = open(&sealed, self.context().as_bytes(), passphrase)?;
        // What a controller sealed is its own; an error here quotes nothing.
        // The error of the reader quotes the content, which holds secrets.
        serde_json::from_slice(&plain).map_err(|_| ExportError::NotAnExport("its content is not understood".to_owned()))
    }

    /// What is authenticated with the content: one line each for format, version, serial number, series, firmware and
    /// time (RFC 3339, seconds, `Z`).
    pub fn context(&self) -> String {
        let Self { format, version, serial, series, firmware, exported, .. } = self;
        let exported = exported.to_rfc3339_opts(SecondsFormat::Secs, true);
        format!("{format}\n{version}\n{serial}\n{series}\n{firmware}\n{exported}\n")
    }

    fn check(&self) -> Result<(), ExportError> {
        if self.format != EXPORT_FORMAT {
            return Err(ExportError::NotAnExport("another format".to_owned()));
        }
        if self.version != EXPORT_VERSION {
            return Err(ExportError::Version(self.version));
        }
        let lengths = (self.salt.0.len(), self.nonce.0.len()) == (SEAL_SALT_BYTES, SEAL_NONCE_BYTES);
        if !lengths || self.checksum != self.sum() || self.exported.timestamp_subsec_nanos() != 0 {
            return Err(ExportError::Checksum);
        }
        Ok(())
    }

    fn sum(&self) -> String {
        let mut hash = Sha256::new();
        hash.update(self.context());
        for bytes in [&self.salt, &self.nonce, &self.sealed] {
            hash.update(&bytes.0);
        }
        hex::encode(hash.finalize())
    }
}

impl fmt::Debug for ExportContent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ExportContent")
            .field("settings", &self.settings)
            .field("users", &self.users)
            .field("activation", &self.activation)
            .finish()
    }
}

impl fmt::Debug for ExportedUser {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ExportedUser").field("name", &self.name).finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn content() -> ExportContent {
        let user = ExportedUser { name: "operator1".parse().unwrap(), password_hash: "$argon2id$secret".to_owned() };
        ExportContent { settings: ServerSettings::default(), users: vec![user], activation: None }
    }

    fn export() -> SettingsExport {
        let of = ("R7A0000001".parse().unwrap(), ControllerSeries::Rc700, FirmwareVersion::new(7, 5, 54));
        SettingsExport::new(of, Utc::now(), &content(), &"correct horse".into()).unwrap()
    }

    #[test]
    fn what_is_sealed_is_opened_by_the_passphrase_alone() {
        let export = export();
        let read = SettingsExport::from_json(&export.to_json()).unwrap();
        assert_eq!(read, export);
        assert_eq!(read.open(&"correct horse".into()), Ok(content()));
        assert_eq!(read.open(&"".into()), Err(ExportError::WrongPassphrase));
        let shown = format!("{:?} {}", content(), String::from_utf8(export.to_json()).unwrap());
        assert!(!shown.contains("argon2id"), "{shown}");
    }

    #[test]
    fn it_belongs_to_one_controller_and_its_firmware_or_a_later_one() {
        let export = export();
        let check = |serial: &str, series, firmware: &str| {
            export.check_for(&serial.parse().unwrap(), series, firmware.parse().unwrap())
        };
        assert_eq!(check("R7A0000001", ControllerSeries::Rc700, "7.5.54"), Ok(()));
        assert_eq!(check("R7A0000001", ControllerSeries::Rc700, "7.5.60"), Ok(()));
        assert!(matches!(
            check("R7A0000001", ControllerSeries::Rc700, "7.5.4"),
            Err(ExportError::NewerFirmware { .. })
        ));
        for (serial, series) in [("R7A0000002", ControllerSeries::Rc700), ("R7A0000001", ControllerSeries::Rc90)] {
            assert!(matches!(check(serial, series, "7.5.54"), Err(ExportError::AnotherController { .. })));
        }
    }

    #[test]
    fn nobody_makes_it_another_controllers() {
        let mut forged = export();
        forged.serial = "R7A0000002".parse().unwrap();
        assert_eq!(forged.open(&"correct horse".into()), Err(ExportError::Checksum));
        forged.checksum = forged.sum();
        assert_eq!(forged.open(&"correct horse".into()), Err(ExportError::WrongPassphrase));
    }

    #[test]
    fn other_versions_are_told_from_damage() {
        let text = String::from_utf8(export().to_json()).unwrap();
        let read = |text: &str| SettingsExport::from_json(text.as_bytes());
        for (version, found) in [("0", 0), ("2", 2)] {
            let other = text.replace("\"version\": 1", &format!("\"version\": {version}, \"more\": true"));
            assert_eq!(read(&other), Err(ExportError::Version(found)));
        }
        assert!(matches!(read("{}"), Err(ExportError::NotAnExport(_))));
        assert!(matches!(read(&text.replace(EXPORT_FORMAT, "shopping")), Err(ExportError::NotAnExport(_))));
        assert_eq!(read(&" ".repeat(MAX_EXPORT_BYTES + 1)), Err(ExportError::TooLarge));
    }

    /// Editors and PowerShell save JSON with a byte order mark, or as UTF-16.
    #[test]
    fn an_export_that_was_saved_again_by_an_editor_is_the_same() {
        let export = export();
        let text = format!("\u{feff}{}", String::from_utf8(export.to_json()).unwrap());
        let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
        for bytes in [text.as_bytes(), &wide] {
            assert_eq!(SettingsExport::from_json(bytes).as_ref(), Ok(&export));
        }
        let latin = [b"{\"format\": \"M\xfcller\"}".as_slice(), b"\n"].concat();
        let told = SettingsExport::from_json(&latin).unwrap_err().to_string();
        assert!(told.contains("line 1 is not UTF-8 text"), "{told}");
    }

    #[test]
    fn a_truncated_or_damaged_file_is_never_taken_for_another() {
        let export = export();
        let json = export.to_json();
        for length in 0..json.len() - 2 {
            assert!(SettingsExport::from_json(&json[..length]).is_err(), "cut at {length}");
        }
        for position in 0..json.len() {
            for flip in [0x01, 0x20, 0x80, 0xff] {
                let mut damaged = json.clone();
                damaged[position] ^= flip;
                // A changed blank between members changes nothing.
                if let Ok(read) = SettingsExport::from_json(&damaged) {
                    assert_eq!(read, export, "byte {position}");
                }
            }
        }
    }
}
