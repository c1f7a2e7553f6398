use std::sync::Arc;

use super::command::{Setting, SettingRefusal};

/// The configuration nodes of both data acquisitions, as clients have set them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct AcquisitionSettings {
    pub force_port: bool,
    pub force_option: Arc<str>,
    pub force_data_type: u16,
    pub force_data_num: u16,
    pub motion_data_type: u16,
    pub motion_data_num: u16,
    pub motion_interval: u16,
}

impl Default for AcquisitionSettings {
    fn default() -> Self {
        Self {
            force_port: false,
            force_option: "".into(),
            force_data_type: 0,
            force_data_num: 0,
            motion_data_type: 0,
            motion_data_num: 0,
            motion_interval: 0,
        }
    }
}

impl AcquisitionSettings {
    /// Takes a new value, or leaves everything as it is. Inputs are no settings.
    pub fn set(&mut self, setting: Setting) -> Result<(), SettingRefusal> {
        let within = |value: u16, max: u16| if value <= max { Ok(value) } else { Err(SettingRefusal::OutOfRange) };
        match setting {
            Setting::ForcePort(on) => self.force_port = on,
            Setting::ForceOption(text) if text.len() > MAX_OPTION_BYTES => return Err(SettingRefusal::OutOfRange),
            Setting::ForceOption(text) => self.force_option = text.into(),
            Setting::ForceDataType(value) => self.force_data_type = within(value, 3)?,
            Setting::ForceDataNum(value) => self.force_data_num = value,
            Setting::MotionDataType(value) => self.motion_data_type = within(value, 0)?,
            Setting::MotionDataNum(value) => self.motion_data_num = within(value, 200)?,
            Setting::MotionSamplingInterval(value) => self.motion_interval = within(value, 4)?,
            Setting::InputBit { .. } | Setting::InputByte { .. } => return Err(SettingRefusal::NotWritable),
        }
        Ok(())
    }
}

/// The manual gives Option no meaning and no length; this bounds what a client can store.
const MAX_OPTION_BYTES: usize = 255;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_out_of_range_change_nothing() {
        let mut settings = AcquisitionSettings::default();
        for good in [
            Setting::ForcePort(true),
            Setting::ForceOption("x".repeat(255)),
            Setting::ForceDataType(3),
            Setting::ForceDataNum(u16::MAX),
            Setting::MotionDataType(0),
            Setting::MotionDataNum(200),
            Setting::MotionSamplingInterval(4),
        ] {
            settings.set(good).unwrap();
        }
        let before = settings.clone();
        for bad in [
            Setting::ForceOption("x".repeat(256)),
            Setting::ForceDataType(4),
            Setting::MotionDataType(1),
            Setting::MotionDataNum(201),
            Setting::MotionSamplingInterval(5),
        ] {
            assert_eq!(settings.set(bad), Err(SettingRefusal::OutOfRange));
        }
        let input = Setting::InputBit { port: 0, offset: 0, on: true };
        assert_eq!(settings.set(input), Err(SettingRefusal::NotWritable));
        assert_eq!(settings, before);
    }
}
