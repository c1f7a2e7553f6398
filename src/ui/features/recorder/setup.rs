use std::path::PathBuf;
use std::time::Duration;

use crate::model::{UserCredential, UserName, UserPassword};
use crate::recorder::{Format, RecordSettings, Source, StopLimits};
use crate::texts::TextKey as T;
use crate::ui::model::SecretInput;

/// Which data of a controller is recorded.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordedData {
    /// The motion log (manual 4.3).
    Motion,
    /// The force sensor (manual 4.1).
    Force,
}

/// What is recorded, how, and when it ends; numbers as they are typed.
#[derive(Debug)]
pub struct RecorderSetup {
    /// Which data.
    pub data: RecordedData,
    /// DataType of the force sensor, 0 to 3.
    pub data_type: u16,
    /// The channel of the force sensor, 1 or 2.
    pub monitor: u8,
    /// SamplingInterval of the motion log, 0 to 4.
    pub sampling_interval: u8,
    /// DataNum; empty: 0.
    pub data_num: String,
    /// What the packets are written as.
    pub format: Format,
    /// Whether the packets are kept as they came.
    pub keep_packets: bool,
    /// The folder of the files.
    pub folder: String,
    /// Seconds after which a recording ends; empty: none.
    pub seconds: String,
    /// Megabytes of packets after which a recording ends; empty: none.
    pub megabytes: String,
    /// Recordings of the force sensor after which a recording ends; empty: none.
    pub footers: String,
    /// Empty: anonymous.
    pub user: String,
    /// Wiped when it was used.
    pub password: SecretInput,
    /// The password is shown in clear.
    pub show_password: bool,
    /// The login that was used last; its password is not shown any more.
    used: Option<UserCredential>,
}

/// As on the command line.
const MAX_SECONDS: u64 = 31_536_000;
const MAX_MEGABYTES: u64 = 1_000_000;
const MAX_FOOTERS: u64 = 1_000_000;

impl RecorderSetup {
    /// The motion log, with every setting as the controller has it at first.
    pub fn new(folder: String) -> Self {
        Self {
            data: RecordedData::Motion,
            data_type: 0,
            monitor: 1,
            sampling_interval: 0,
            data_num: String::new(),
            format: Format::Csv,
            keep_packets: false,
            folder,
            seconds: String::new(),
            megabytes: String::new(),
            footers: "1".to_owned(),
            user: String::new(),
            password: SecretInput::default(),
            show_password: false,
            used: None,
        }
    }

    /// What is recorded; what is wrong with what is typed.
    pub fn settings(&self) -> Result<RecordSettings, T> {
        let data_num = match self.data_num.trim() {
            "" => 0,
            typed => typed.parse().map_err(|_| self.data_num_rule())?,
        };
        let settings = match self.data {
            RecordedData::Motion => RecordSettings::motion(self.sampling_interval, data_num),
            RecordedData::Force => RecordSettings::force(self.data_type, self.monitor, data_num),
        };
        settings.map_err(|_| self.data_num_rule())
    }

    /// What the data is; also while what is typed is wrong.
    pub fn source(&self) -> Option<Source> {
        let settings = match self.data {
            RecordedData::Motion => RecordSettings::motion(self.sampling_interval, 0),
            RecordedData::Force => RecordSettings::force(self.data_type, self.monitor, 0),
        };
        settings.ok().map(|settings| settings.source())
    }

    /// Which numbers DataNum may have.
    pub const fn data_num_rule(&self) -> T {
        match self.data {
            RecordedData::Motion => T::RecorderBlocksRule,
            RecordedData::Force => T::RecorderRecordsRule,
        }
    }

    /// What is wrong with DataNum.
    pub fn data_num_error(&self) -> Option<T> {
        self.settings().err()
    }

    /// When a recording ends; what is wrong with what is typed.
    pub fn limits(&self) -> Result<StopLimits, T> {
        let footers = match self.data {
            RecordedData::Force => limit(&self.footers, MAX_FOOTERS)?,
            RecordedData::Motion => None,
        };
        Ok(StopLimits {
            duration: limit(&self.seconds, MAX_SECONDS)?.map(Duration::from_secs),
            bytes: limit(&self.megabytes, MAX_MEGABYTES)?.map(|megabytes| megabytes * 1_000_000),
            footers: footers.and_then(|footers| u32::try_from(footers).ok()),
        })
    }

    /// Who logs in; why nobody can with what is typed.
    pub fn login(&self) -> Result<Option<UserCredential>, T> {
        if self.user.is_empty() && self.password.0.is_empty() {
            return Ok(None);
        }
        let again = self.used.as_ref().filter(|used| used.name.as_str() == self.user && self.password.0.is_empty());
        if again.is_some() {
            return Ok(again.cloned());
        }
        let name = self.user.parse::<UserName>().map_err(|_| T::UserRule)?;
        let password = UserPassword::new(&self.password.0).map_err(|_| T::UserRule)?;
        Ok(Some(UserCredential { name, password }))
    }

    /// The folder of the files.
    pub fn typed_folder(&self) -> Result<PathBuf, T> {
        // File managers put quotes around a path they copy.
        let folder = self.folder.trim().trim_matches('"');
        if folder.is_empty() { Err(T::RecorderFolderRule) } else { Ok(folder.into()) }
    }

    /// Why no recording can be started.
    pub fn incomplete(&self) -> Option<T> {
        let settings = self.settings().err();
        settings.or(self.limits().err()).or(self.typed_folder().err()).or(self.login().err())
    }

    /// The login was taken: the password is wiped from its field.
    pub(super) fn use_login(&mut self) {
        if let Ok(login) = self.login() {
            self.used = login;
            self.password = SecretInput::default();
        }
    }
}

/// What is wrong with a limit that is typed.
pub fn limit_error(typed: &str) -> Option<T> {
    limit(typed, MAX_SECONDS).err()
}

/// A limit that is typed, from 1 on; empty: none.
fn limit(typed: &str, most: u64) -> Result<Option<u64>, T> {
    match typed.trim() {
        "" => Ok(None),
        typed => match typed.parse() {
            Ok(number) if (1..=most).contains(&number) => Ok(Some(number)),
            _ => Err(T::RecorderLimitRule),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setup() -> RecorderSetup {
        RecorderSetup::new("/recordings".into())
    }

    #[test]
    fn the_settings_as_they_are_typed() {
        let mut setup = setup();
        assert_eq!(setup.settings(), Ok(RecordSettings::motion(0, 0).unwrap()));
        (setup.sampling_interval, setup.data_num) = (4, " 200 ".into());
        assert_eq!(setup.settings(), Ok(RecordSettings::motion(4, 200).unwrap()));
        setup.data_num = "201".into();
        assert_eq!(setup.incomplete(), Some(T::RecorderBlocksRule));
        setup.data = RecordedData::Force;
        (setup.data_type, setup.monitor) = (2, 2);
        assert_eq!(setup.settings(), Ok(RecordSettings::force(2, 2, 201).unwrap()));
        setup.data_num = "65536".into();
        assert_eq!(setup.incomplete(), Some(T::RecorderRecordsRule));
    }

    #[test]
    fn the_limits_as_they_are_typed() {
        let mut setup = setup();
        assert_eq!(setup.limits(), Ok(StopLimits::default()), "the motion log has no footers");
        setup.data = RecordedData::Force;
        assert_eq!(setup.limits(), Ok(StopLimits { footers: Some(1), ..StopLimits::default() }));
        (setup.seconds, setup.megabytes, setup.footers) = ("90".into(), "2".into(), String::new());
        let limits = StopLimits { duration: Some(Duration::from_secs(90)), bytes: Some(2_000_000), footers: None };
        assert_eq!(setup.limits(), Ok(limits));
        for wrong in ["0", "-1", "1.5", "ten", "31536001"] {
            setup.seconds = wrong.into();
            assert_eq!(setup.incomplete(), Some(T::RecorderLimitRule), "{wrong}");
        }
    }

    #[test]
    fn a_password_that_was_used_is_wiped_and_used_again_for_the_same_user() {
        let mut setup = setup();
        assert!(setup.login().unwrap().is_none());
        setup.user = "operator1".into();
        assert_eq!(setup.incomplete(), Some(T::UserRule), "half a login");
        setup.password.0 = "Passw0rd1".into();
        setup.use_login();
        assert!(setup.password.0.is_empty());
        assert_eq!(setup.login().unwrap().unwrap().name.as_str(), "operator1");
        setup.user = "operator2".into();
        assert!(setup.login().is_err());
        setup.user.clear();
        assert!(setup.login().unwrap().is_none());
        setup.folder = " ".into();
        assert_eq!(setup.incomplete(), Some(T::RecorderFolderRule));
    }
}
