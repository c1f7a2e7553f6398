use std::collections::BTreeMap;
use std::io;

use chrono::{DateTime, Utc};
use serde::{Deserialize, Serialize, Serializer};
use thiserror::Error;

use super::PasswordPlace;
use crate::model::{Address, ConnectionKind, ControllerInfo, ControllerName, ControllerSeries, Language, text};
use crate::pki::Fingerprint;

const VERSION: u32 = 1;

/// The most controllers a job may be set to work on at once.
pub const MAX_PARALLELISM: usize = 64;

/// `epson_opcua_config.json`: the list of controllers and the options.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Configuration {
    version: u32,
    /// The connection targets, in the order in which they were added.
    #[serde(default)]
    pub controllers: Vec<ControllerEntry>,
    /// The options of the program.
    #[serde(default)]
    pub options: Options,
}

/// A connection target. Its password is not here: see [`super::Passwords`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ControllerEntry {
    /// Its name, unique in the list.
    pub name: ControllerName,
    /// Where its management protocol answers.
    pub address: Address,
    /// Its series: assumed until the controller was reached.
    pub series: ControllerSeries,
    /// How the controller is configured. [`ConnectionKind::Management`] in files that do not say it.
    #[serde(default)]
    pub connection: ConnectionKind,
    /// The management identity that was compared and accepted; without it nothing is sent to the controller.
    #[serde(default)]
    pub fingerprint: Option<Fingerprint>,
    /// What was read last, so that the table is not empty after a restart.
    #[serde(default)]
    pub last: Option<RetrievedInfo>,
}

impl ControllerEntry {
    /// A controller that was not reached yet. Nothing is sent to it until its fingerprint was compared and accepted; its
    /// series is what a person says until then.
    pub const fn unconfirmed(name: ControllerName, address: Address, series: ControllerSeries) -> Self {
        Self { name, address, series, connection: ConnectionKind::Management, fingerprint: None, last: None }
    }
}

/// Information with the time of this PC at which it was read.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RetrievedInfo {
    /// When it was read, by the clock of this PC.
    pub at: DateTime<Utc>,
    /// What was read.
    pub info: ControllerInfo,
}

/// The colours of the window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ThemeChoice {
    /// As the operating system; the default.
    #[default]
    System,
    /// Dark text on a light ground.
    Light,
    /// Light text on a dark ground.
    Dark,
}

/// What the window remembers of itself.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct WindowState {
    /// Inner size in points.
    #[serde(serialize_with = "real_size")]
    pub size: Option<(f32, f32)>,
    /// Column widths in points, by the column's key.
    #[serde(serialize_with = "real_widths")]
    pub columns: BTreeMap<String, f32>,
    /// The columns' keys from left to right. Default: the built-in order.
    pub column_order: Vec<String>,
    /// Whether the details pane is open. Default: closed.
    pub details: bool,
    /// The width of the details pane in points, once it was changed.
    #[serde(serialize_with = "real_length")]
    pub details_width: Option<f32>,
    /// The column sorted by, and whether ascending.
    pub sort: Option<(String, bool)>,
}

impl WindowState {
    /// No screen is that large, in points: what goes beyond it, or is no number, was not measured on one.
    const MAX_POINTS: f32 = 32_768.0;

    /// More columns than the table has, so that none of a later version is lost.
    const MAX_COLUMNS: usize = 64;

    fn is_length(points: f32) -> bool {
        (0.0..=Self::MAX_POINTS).contains(&points)
    }

    /// Drops stored sizes that are not finite, negative, or larger than any screen.
    fn drop_invalid(&mut self) {
        self.size = self.size.filter(|(width, height)| Self::is_length(*width) && Self::is_length(*height));
        self.columns.retain(|_, width| Self::is_length(*width));
        self.details_width = self.details_width.filter(|width| Self::is_length(*width));
        self.column_order.truncate(Self::MAX_COLUMNS);
    }
}

/// JSON has no word for what is not a number: it would be written as `null`, and the whole file taken for damaged.
fn real_size<S: Serializer>(size: &Option<(f32, f32)>, serializer: S) -> Result<S::Ok, S::Error> {
    let is_length = WindowState::is_length;
    size.filter(|(width, height)| is_length(*width) && is_length(*height)).serialize(serializer)
}

fn real_length<S: Serializer>(length: &Option<f32>, serializer: S) -> Result<S::Ok, S::Error> {
    length.filter(|points| WindowState::is_length(*points)).serialize(serializer)
}

fn real_widths<S: Serializer>(values: &BTreeMap<String, f32>, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(values.iter().filter(|(_, width)| WindowState::is_length(**width)))
}

/// What can be chosen in the dialogs "Options" and "Backup", and what the window remembers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Keep copies of certificates made here, and of their keys where they exist on the PC (manual 2.8.1). Default off.
    pub backup: bool,
    /// How many controllers a job works on at once: 1 to [`MAX_PARALLELISM`]. Default 16.
    pub parallelism: usize,
    /// Connect to a server as a client does after each change that starts it again. Default off: it takes seconds, and a
    /// server that does not know this program notes it among those it refused.
    pub verify_after_changes: bool,
    /// Where connection passwords are kept. Default: the keyring.
    pub passwords: PasswordPlace,
    /// `None` follows the operating system.
    pub language: Option<Language>,
    /// The colours of the window. Default: as the operating system.
    pub theme: ThemeChoice,
    /// Sizes and columns of the window.
    pub window: WindowState,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            backup: false,
            parallelism: 16,
            verify_after_changes: false,
            passwords: PasswordPlace::Keyring,
            language: None,
            theme: ThemeChoice::System,
            window: WindowState::default(),
        }
    }
}

impl Default for Configuration {
    fn default() -> Self {
        Self { version: VERSION, controllers: Vec::new(), options: Options::default() }
    }
}

/// Why a controller cannot be registered beside the others.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum DuplicateController {
    /// Another controller has the name.
    #[error("another controller is called {0}")]
    Name(ControllerName),
    /// The controller of this name has the address and port.
    #[error("{0} has the address")]
    Address(ControllerName),
}

impl Configuration {
    /// The reason in words when the bytes are not a configuration.
    pub(super) fn from_json(bytes: &[u8]) -> Result<Self, String> {
        let text = text::decode(bytes).map_err(|e| e.to_string())?;
        let mut configuration: Self = serde_json::from_str(&text).map_err(|e| e.to_string())?;
        if configuration.version != VERSION {
            return Err(format!("version {} is not one this program knows", configuration.version));
        }
        configuration.options.parallelism = configuration.options.parallelism.clamp(1, MAX_PARALLELISM);
        configuration.options.window.drop_invalid();
        Ok(configuration)
    }

    pub(super) fn to_json(&self) -> io::Result<Vec<u8>> {
        Ok(serde_json::to_vec_pretty(self)?)
    }

    /// The entry with this name; upper and lower case are the same.
    pub fn find(&self, name: &str) -> Option<&ControllerEntry> {
        self.controllers.iter().find(|c| c.name.as_str() == name)
    }

    /// Names, and addresses with their ports, are unique (manual 2.5.1).
    pub fn check_new(&self, name: &ControllerName, address: &Address) -> Result<(), DuplicateController> {
        if self.controllers.iter().any(|c| c.name == *name) {
            return Err(DuplicateController::Name(name.clone()));
        }
        match self.controllers.iter().find(|c| c.address == *address) {
            Some(taken) => Err(DuplicateController::Address(taken.name.clone())),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ErrorCode, Problem};

    fn with_one() -> Configuration {
        Configuration {
            controllers: vec![ControllerEntry {
                name: "Weld 1".parse().unwrap(),
                address: "192.168.0.1".parse().unwrap(),
                series: ControllerSeries::Rc700,
                connection: ConnectionKind::Management,
                fingerprint: None,
                last: None,
            }],
            ..Configuration::default()
        }
    }

    #[test]
    fn names_and_addresses_are_unique() {
        let configuration = with_one();
        let check = |name: &str, address: &str| {
            configuration
                .check_new(&name.parse().unwrap(), &address.parse().unwrap())
                .map_err(|error| Problem::from(error).code)
        };
        assert_eq!(check("Weld 1", "192.168.0.2"), Err(ErrorCode::NameTaken));
        assert_eq!(check("Weld 2", "192.168.0.1:7943"), Err(ErrorCode::AddressTaken));
        assert_eq!(check("Weld 2", "192.168.0.1:8000"), Ok(()));
    }

    #[test]
    fn a_width_that_is_no_number_does_not_damage_the_file() {
        let mut configuration = with_one();
        let window = &mut configuration.options.window;
        window.size = Some((f32::NAN, 600.0));
        window.columns = BTreeMap::from([("name".to_owned(), 80.0), ("status".to_owned(), f32::INFINITY)]);
        window.details_width = Some(f32::NAN);
        let read = Configuration::from_json(&configuration.to_json().unwrap()).unwrap();
        assert_eq!((read.options.window.size, read.options.window.details_width), (None, None));
        assert_eq!(read.options.window.columns, BTreeMap::from([("name".to_owned(), 80.0)]));
        assert_eq!(read.controllers, configuration.controllers);
    }

    #[test]
    fn a_length_no_screen_has_is_forgotten() {
        for nonsense in ["1e39", "-1e39", "-1.0", "40000"] {
            let window = format!(r#"{{"size":[{nonsense},600.0],"columns":{{"name":{nonsense},"status":80.0}}}}"#);
            let json = format!(r#"{{"version":1,"options":{{"window":{window}}}}}"#);
            let read = Configuration::from_json(json.as_bytes()).unwrap().options.window;
            assert_eq!((read.size, read.columns), (None, BTreeMap::from([("status".to_owned(), 80.0)])), "{nonsense}");
        }
    }

    #[test]
    fn a_controller_stored_without_a_kind_of_connection_uses_the_management_protocol() {
        let old = br#"{"version":1,"controllers":[{"name":"Weld 1","address":"192.168.0.1","series":"RC700"}]}"#;
        assert_eq!(Configuration::from_json(old), Ok(with_one()));
        let json = String::from_utf8(with_one().to_json().unwrap()).unwrap();
        assert!(json.contains(r#""connection": "management""#), "{json}");
        let unknown = json.replace("\"management\"", "\"carrier-pigeon\"");
        assert!(
            Configuration::from_json(unknown.as_bytes()).is_err(),
            "nothing is sent over another connection instead"
        );
    }

    #[test]
    fn a_file_with_less_in_it_gets_the_defaults() {
        let configuration = Configuration::from_json(br#"{"version":1}"#).unwrap();
        assert_eq!(configuration, Configuration::default());
        // As an editor may save it again.
        assert_eq!(Configuration::from_json(b"\xef\xbb\xbf{\"version\":1}").as_ref(), Ok(&configuration));
        let silly = Configuration::from_json(br#"{"version":1,"options":{"parallelism":0}}"#).unwrap();
        assert_eq!(silly.options.parallelism, 1);
    }
}
