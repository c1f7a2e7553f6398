use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::file_names::is_reserved;

/// The controller series a configurator can talk to (manual 1.3.1.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum ControllerSeries {
    /// The RC90 series.
    #[serde(rename = "RC90")]
    Rc90,
    /// The RC700 series.
    #[serde(rename = "RC700")]
    Rc700,
    /// The T and VT series, whose controller is built into the manipulator.
    #[serde(rename = "T/VT")]
    TVt,
    /// The RC800 series.
    #[serde(rename = "RC800")]
    Rc800,
}

impl ControllerSeries {
    /// All series, in the order of the manual.
    pub const ALL: [Self; 4] = [Self::Rc90, Self::Rc700, Self::TVt, Self::Rc800];

    /// The series assumed for a controller that was not reached yet and whose connection list does not name one: the
    /// only series on sale with current firmware.
    pub const ASSUMED: Self = Self::Rc800;

    /// The name as the manual prints it.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Rc90 => "RC90",
            Self::Rc700 => "RC700",
            Self::TVt => "T/VT",
            Self::Rc800 => "RC800",
        }
    }

    /// The oldest firmware that carries an OPC UA server at all (manual 1.3.1.1).
    pub const fn oldest_firmware(self) -> FirmwareVersion {
        match self {
            Self::Rc90 | Self::Rc700 => FirmwareVersion::new(7, 5, 4),
            Self::TVt => FirmwareVersion::new(7, 5, 54),
            Self::Rc800 => FirmwareVersion::new(8, 0, 0),
        }
    }

    /// Refuses firmware without OPC UA with the message of manual 6.2.
    pub fn check_firmware(self, firmware: FirmwareVersion) -> Result<(), UnsupportedFirmware> {
        let oldest = self.oldest_firmware();
        if firmware < oldest { Err(UnsupportedFirmware { series: self, firmware, oldest }) } else { Ok(()) }
    }
}

/// The firmware of a controller is older than the first with OPC UA for its series.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[error("{} {firmware} < {oldest}", series.as_str())]
pub struct UnsupportedFirmware {
    /// The series of the controller.
    pub series: ControllerSeries,
    /// The firmware it has.
    pub firmware: FirmwareVersion,
    /// The first firmware with OPC UA for the series.
    pub oldest: FirmwareVersion,
}

impl fmt::Display for ControllerSeries {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl FromStr for ControllerSeries {
    type Err = NameError;

    /// Case and the slash of `T/VT` do not matter: `tvt` is a series too.
    fn from_str(text: &str) -> Result<Self, NameError> {
        let plain = |s: &str| s.to_ascii_uppercase().replace(['/', '-', ' '], "");
        Self::ALL
            .into_iter()
            .find(|series| plain(series.as_str()) == plain(text))
            .ok_or_else(|| NameError::UnknownSeries(text.to_owned()))
    }
}

/// A firmware version, `major.minor.patch`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct FirmwareVersion {
    major: u16,
    minor: u16,
    patch: u16,
}

/// Which of the two sets of rules a controller follows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum FirmwareGeneration {
    /// Below 8.0.0: activated by keys, server keys made on the PC.
    Legacy,
    /// 8.0.0 and later: activated as a controller option, server keys made in the controller.
    Current,
}

impl FirmwareVersion {
    /// The version `major.minor.patch`.
    pub const fn new(major: u16, minor: u16, patch: u16) -> Self {
        Self { major, minor, patch }
    }

    /// The set of rules that this version follows (manual 1.3.1.1).
    pub const fn generation(self) -> FirmwareGeneration {
        if self.major < 8 { FirmwareGeneration::Legacy } else { FirmwareGeneration::Current }
    }
}

impl fmt::Display for FirmwareVersion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}.{}.{}", self.major, self.minor, self.patch)
    }
}

/// The text is no `major.minor.patch`; holds the text.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("\"{0}\" is not a firmware version such as 7.5.4")]
pub struct VersionError(String);

impl FromStr for FirmwareVersion {
    type Err = VersionError;

    fn from_str(text: &str) -> Result<Self, VersionError> {
        let parts: Vec<u16> = text
            .split('.')
            .map(|p| p.parse::<u16>().map_err(|_| VersionError(text.to_owned())))
            .collect::<Result<_, _>>()?;
        match parts[..] {
            [major, minor, patch] => Ok(Self { major, minor, patch }),
            _ => Err(VersionError(text.to_owned())),
        }
    }
}

text_in_messages!(FirmwareVersion, VersionError);

/// Why a name, a serial number or a series was not understood.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum NameError {
    /// There is no text.
    #[error("the name is empty")]
    Empty,
    /// The name is too long; holds its length in characters.
    #[error("the name has {0} characters; at most {max} are allowed", max = ControllerName::MAX_CHARS)]
    TooLong(usize),
    /// The name holds a control character.
    #[error("the name contains a control character")]
    ControlCharacter,
    /// The text is no serial number; holds the text.
    #[error("\"{0}\" is not a serial number: 1 to 32 letters, digits, \"-\" or \"_\"")]
    Serial(String),
    /// Windows reserves this serial number as a device name, so it cannot name a folder; holds the text.
    #[error("\"{0}\" cannot be a serial number: its folder would have a name that is kept for something else")]
    ReservedSerial(String),
    /// No series has this name; holds the text.
    #[error("\"{0}\" is not a controller series; known are RC90, RC700, T/VT and RC800")]
    UnknownSeries(String),
}

/// The name an engineer gives a connection target: 1–32 characters, any script, no control characters (2.5.1).
///
/// Two names are the same when they differ in nothing but surrounding blanks, which are dropped.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct ControllerName(String);

impl ControllerName {
    /// Longest name, in Unicode characters.
    pub const MAX_CHARS: usize = 32;

    /// The name as it was entered.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl FromStr for ControllerName {
    type Err = NameError;

    fn from_str(text: &str) -> Result<Self, NameError> {
        let text = text.trim();
        let chars = text.chars().count();
        if chars == 0 {
            Err(NameError::Empty)
        } else if chars > Self::MAX_CHARS {
            Err(NameError::TooLong(chars))
        } else if text.chars().any(char::is_control) {
            Err(NameError::ControlCharacter)
        } else {
            Ok(Self(text.to_owned()))
        }
    }
}

text_in_messages!(ControllerName, NameError);

impl fmt::Display for ControllerName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// A controller's serial number: 1–32 ASCII letters, digits, `-` or `_`. It also names the controller's folder on the
/// PC, and comes from the controller, which cannot choose where its files land: a name that Windows keeps for itself
/// and the folders of the workspace that are no controller's ([`SerialNumber::WORKSPACE_FOLDERS`]) are refused.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct SerialNumber(String);

impl SerialNumber {
    /// What the workspace keeps beside the folders of controllers; in any case of letters.
    pub const WORKSPACE_FOLDERS: [&str; 3] = ["CA", "Configurator", "virtual"];

    /// The serial number as the controller reports it.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// The name of the controller's folder: in capitals, as serial numbers are printed, so that two that differ in case
    /// only have the same folder on every system, not only where the file system does not tell them apart.
    pub fn folder_name(&self) -> String {
        self.0.to_ascii_uppercase()
    }
}

impl FromStr for SerialNumber {
    type Err = NameError;

    fn from_str(text: &str) -> Result<Self, NameError> {
        let fits =
            (1..=32).contains(&text.len()) && text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'-' || b == b'_');
        if !fits {
            return Err(NameError::Serial(text.to_owned()));
        }
        if is_reserved(text) || Self::WORKSPACE_FOLDERS.iter().any(|folder| folder.eq_ignore_ascii_case(text)) {
            return Err(NameError::ReservedSerial(text.to_owned()));
        }
        Ok(Self(text.to_owned()))
    }
}

text_in_messages!(SerialNumber, NameError);

impl fmt::Display for SerialNumber {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn firmware_is_ordered_by_number_not_by_text() {
        let version = |s: &str| s.parse::<FirmwareVersion>().expect("a version");
        assert!(version("7.5.54") > version("7.5.6"));
        assert_eq!(version("7.5.54").generation(), FirmwareGeneration::Legacy);
        assert_eq!(version("8.0.0").generation(), FirmwareGeneration::Current);
        assert!("8.0".parse::<FirmwareVersion>().is_err());
        assert!("8.0.x".parse::<FirmwareVersion>().is_err());
    }

    #[test]
    fn firmware_without_opc_ua_is_refused() {
        let old = ControllerSeries::TVt.check_firmware(FirmwareVersion::new(7, 5, 53)).expect_err("too old");
        assert_eq!(old.to_string(), "T/VT 7.5.53 < 7.5.54");
        assert!(ControllerSeries::TVt.check_firmware(FirmwareVersion::new(7, 5, 54)).is_ok());
        assert!(ControllerSeries::Rc90.check_firmware(FirmwareVersion::new(7, 5, 4)).is_ok());
        assert!(ControllerSeries::Rc800.check_firmware(FirmwareVersion::new(7, 9, 0)).is_err());
    }

    #[test]
    fn a_name_is_1_to_32_characters_of_any_script() {
        assert_eq!("  Weld 1 ".parse::<ControllerName>().expect("a name").as_str(), "Weld 1");
        assert_eq!("".parse::<ControllerName>(), Err(NameError::Empty));
        assert!("焊".repeat(32).parse::<ControllerName>().is_ok());
        assert_eq!("焊".repeat(33).parse::<ControllerName>(), Err(NameError::TooLong(33)));
        assert_eq!("a\nb".parse::<ControllerName>(), Err(NameError::ControlCharacter));
    }

    #[test]
    fn a_serial_number_cannot_leave_its_folder() {
        for bad in ["", "..", "a/b", "a\\b", "C:", "a b", "号"] {
            assert!(bad.parse::<SerialNumber>().is_err(), "{bad}");
        }
        assert!("R7A0000001".parse::<SerialNumber>().is_ok());
        for reserved in ["CON", "nul", "Com1", "CA", "ca", "configurator", "VIRTUAL"] {
            assert_eq!(reserved.parse::<SerialNumber>(), Err(NameError::ReservedSerial(reserved.to_owned())));
        }
        let folder = |serial: &str| serial.parse::<SerialNumber>().expect(serial).folder_name();
        assert_eq!(folder("r7a-1"), folder("R7A-1"));
    }

    #[test]
    fn a_series_is_known_by_its_name_however_written() {
        assert_eq!("tvt".parse(), Ok(ControllerSeries::TVt));
        assert_eq!("T/VT".parse(), Ok(ControllerSeries::TVt));
        assert_eq!("rc800".parse(), Ok(ControllerSeries::Rc800));
        assert!("RC1".parse::<ControllerSeries>().is_err());
    }
}
