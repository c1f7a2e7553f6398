use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::records::force::ForceDataType;
use crate::records::motion::MAX_BLOCKS_PER_READ;

/// What is recorded, and how the controller delivers it. A value of this type is in range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Fields", into = "Fields")]
pub struct RecordSettings {
    source: Source,
    data_num: u16,
}

/// Which data a controller offers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Source {
    /// Force sensor data of a channel (manual 3.2.3.2).
    Force {
        /// Which groups of values; written to the DataType node.
        data_type: ForceDataType,
        /// 1 or 2: a second RecordStart that runs at the same time is on channel 2.
        monitor: u8,
    },
    /// The motion log (manual 3.2.3.4).
    Motion {
        /// 0 to 4: the sampling period is 2ⁿ times the shortest one.
        sampling_interval: u8,
    },
}

/// A setting out of its range.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum SettingsError {
    /// Not 0 to 3.
    #[error("DataType is {0}; it has to be 0 to 3")]
    DataType(u16),
    /// Not 1 or 2.
    #[error("there is no channel {0}; it has to be 1 or 2")]
    Monitor(u8),
    /// Not 0 to 4.
    #[error("SamplingInterval is {0}; it has to be 0 to 4")]
    SamplingInterval(u8),
    /// Not 0 to 200.
    #[error("DataNum is {0}; it has to be 0 to 200")]
    DataNum(u16),
}

impl RecordSettings {
    /// Force sensor data. `data_type`: 0 to 3. `monitor`: 1 or 2. `data_num`: records a read brings at most; 0 leaves it
    /// to the server.
    pub fn force(data_type: u16, monitor: u8, data_num: u16) -> Result<Self, SettingsError> {
        let data_type = ForceDataType::from_number(data_type).ok_or(SettingsError::DataType(data_type))?;
        if !(1..=2).contains(&monitor) {
            return Err(SettingsError::Monitor(monitor));
        }
        Ok(Self { source: Source::Force { data_type, monitor }, data_num })
    }

    /// The motion log. `sampling_interval`: 0 to 4. `data_num`: blocks a read brings at most, up to 200; 0 leaves it to
    /// the server.
    pub fn motion(sampling_interval: u8, data_num: u16) -> Result<Self, SettingsError> {
        if sampling_interval > 4 {
            return Err(SettingsError::SamplingInterval(sampling_interval));
        }
        if usize::from(data_num) > MAX_BLOCKS_PER_READ {
            return Err(SettingsError::DataNum(data_num));
        }
        Ok(Self { source: Source::Motion { sampling_interval }, data_num })
    }

    /// Which data.
    pub const fn source(&self) -> Source {
        self.source
    }

    /// The value of the DataNum node.
    pub const fn data_num(&self) -> u16 {
        self.data_num
    }

    /// `force` or `motion`: a part of file names.
    pub const fn name(&self) -> &'static str {
        match self.source {
            Source::Force { .. } => "force",
            Source::Motion { .. } => "motion",
        }
    }
}

/// The settings as they stand in files.
#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(tag = "source", rename_all = "snake_case")]
enum Fields {
    Force { data_type: u16, monitor: u8, data_num: u16 },
    Motion { sampling_interval: u8, data_num: u16 },
}

impl TryFrom<Fields> for RecordSettings {
    type Error = SettingsError;

    fn try_from(fields: Fields) -> Result<Self, SettingsError> {
        match fields {
            Fields::Force { data_type, monitor, data_num } => Self::force(data_type, monitor, data_num),
            Fields::Motion { sampling_interval, data_num } => Self::motion(sampling_interval, data_num),
        }
    }
}

impl From<RecordSettings> for Fields {
    fn from(settings: RecordSettings) -> Self {
        let data_num = settings.data_num;
        match settings.source {
            Source::Force { data_type, monitor } => Self::Force { data_type: data_type.number(), monitor, data_num },
            Source::Motion { sampling_interval } => Self::Motion { sampling_interval, data_num },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_settings_in_range_are_read() {
        let force = RecordSettings::force(2, 1, 1000).unwrap();
        let json = serde_json::to_string(&force).unwrap();
        assert_eq!(json, r#"{"source":"force","data_type":2,"monitor":1,"data_num":1000}"#);
        assert_eq!(serde_json::from_str::<RecordSettings>(&json).unwrap(), force);
        assert!(serde_json::from_str::<RecordSettings>(&json.replace("\"data_type\":2", "\"data_type\":4")).is_err());
        assert_eq!(RecordSettings::force(0, 3, 0), Err(SettingsError::Monitor(3)));
        assert_eq!(RecordSettings::motion(5, 0), Err(SettingsError::SamplingInterval(5)));
        assert_eq!(RecordSettings::motion(4, 201), Err(SettingsError::DataNum(201)));
    }
}
