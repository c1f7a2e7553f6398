use std::fmt;

use opcua::types::Variant;

use crate::virtual_controller::cell::{CellSnapshot, Setting};

/// Where the value of a variable comes from.
pub(super) enum Source {
    /// The same for as long as the server runs. Null where the manual says so.
    Fixed(Variant),
    /// A value of the cell.
    Live(Box<Live>),
    /// A value of the cell that clients may write.
    Setting(SettingNode),
    /// A node Data: each read takes what it returns out of a queue.
    Data(DataNode),
}

/// Reads one value from a snapshot of the cell.
pub(super) type Live = dyn Fn(&CellSnapshot) -> Variant + Send + Sync;

/// A node Data (manual 3.2.3.2, 3.2.3.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum DataNode {
    /// Of ForceSensorMonitor_1 or ForceSensorMonitor_2, by the monitor's number.
    Force(u8),
    MotionLog,
}

/// A node that clients may write (manual 3.2.3.2, 3.2.3.4; appendix A-3 for inputs).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SettingNode {
    ForcePort,
    ForceOption,
    ForceDataType,
    ForceDataNum,
    MotionDataType,
    MotionDataNum,
    MotionSamplingInterval,
    InputBit { port: usize, offset: u16 },
    InputByte { port: usize, offset: u16 },
    InputWord { port: usize, offset: u16 },
}

impl Source {
    /// A value of the cell.
    pub(super) fn live<V: Into<Variant>>(read: impl Fn(&CellSnapshot) -> V + Send + Sync + 'static) -> Self {
        Self::Live(Box::new(move |cell| read(cell).into()))
    }

    /// Null: the controller has no such value (manual 3.2.2.1).
    pub(super) const NULL: Self = Self::Fixed(Variant::Empty);

    pub(super) fn is_writable(&self) -> bool {
        matches!(self, Self::Setting(_))
    }

    /// In milliseconds; 0 for a value that does not change (OPC 10000-3 §5.6.2).
    pub(super) fn minimum_sampling_interval(&self) -> f64 {
        match self {
            Self::Fixed(_) => 0.0,
            Self::Live(_) | Self::Setting(_) | Self::Data(_) => super::sampler::INTERVAL.as_secs_f64() * 1000.0,
        }
    }
}

impl fmt::Debug for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fixed(value) => f.debug_tuple("Fixed").field(value).finish(),
            Self::Live(_) => f.write_str("Live"),
            Self::Setting(node) => f.debug_tuple("Setting").field(node).finish(),
            Self::Data(node) => f.debug_tuple("Data").field(node).finish(),
        }
    }
}

impl SettingNode {
    /// The value in force.
    pub(super) fn value(self, cell: &CellSnapshot) -> Variant {
        match self {
            Self::ForcePort => cell.force_sensor.port.into(),
            Self::ForceOption => (&*cell.force_sensor.option).into(),
            Self::ForceDataType => cell.force_sensor.data_type.into(),
            Self::ForceDataNum => cell.force_sensor.data_num.into(),
            Self::MotionDataType => cell.motion_log.data_type.into(),
            Self::MotionDataNum => cell.motion_log.data_num.into(),
            Self::MotionSamplingInterval => cell.motion_log.sampling_interval.into(),
            Self::InputBit { port, offset } => cell.io.bit(port, offset).into(),
            Self::InputByte { port, offset } => cell.io.byte(port, offset).into(),
            Self::InputWord { port, offset } => cell.io.word(port, offset).into(),
        }
    }

    /// What writing `value` asks of the cell; `None` if it is not of exactly the node's data type.
    pub(super) fn changes(self, value: &Variant) -> Option<Vec<Setting>> {
        let setting = match (self, value) {
            (Self::ForcePort, Variant::Boolean(on)) => Setting::ForcePort(*on),
            (Self::ForceOption, Variant::String(text)) => Setting::ForceOption(text.to_string()),
            (Self::ForceDataType, Variant::UInt16(value)) => Setting::ForceDataType(*value),
            (Self::ForceDataNum, Variant::UInt16(value)) => Setting::ForceDataNum(*value),
            (Self::MotionDataType, Variant::UInt16(value)) => Setting::MotionDataType(*value),
            (Self::MotionDataNum, Variant::UInt16(value)) => Setting::MotionDataNum(*value),
            (Self::MotionSamplingInterval, Variant::UInt16(value)) => Setting::MotionSamplingInterval(*value),
            (Self::InputBit { port, offset }, Variant::Boolean(on)) => Setting::InputBit { port, offset, on: *on },
            (Self::InputByte { port, offset }, Variant::Byte(value)) => {
                Setting::InputByte { port, offset, value: *value }
            }
            (Self::InputWord { port, offset }, Variant::UInt16(value)) => {
                let [low, high] = value.to_le_bytes();
                let offset = offset * 2;
                return Some(vec![
                    Setting::InputByte { port, offset, value: low },
                    Setting::InputByte { port, offset: offset + 1, value: high },
                ]);
            }
            _ => return None,
        };
        Some(vec![setting])
    }
}
