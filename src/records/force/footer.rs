use crate::records::layout::{Wire, packet};
use crate::records::text::Label;
use crate::records::time::ControllerTime;

packet! {
    /// The end of a recording (manual 4.1.3, footer).
    FooterView / ForceFooter [182] tag 4 {
        /// 1 before firmware 8.0.0, 2 from there on.
        1 "OPCUACommonVer" version: u8,
        /// The id of the header. The manual's table prints the name of the reserved field here.
        2 "OPCUACommonID" id: u16,
        6 "PacketVersion" packet_version: u8,
        /// Not used by the controller.
        7 "PacketType" packet_type: u8,
        /// Output channel.
        8 "Channel" channel: u8,
        /// Recording mode; not used by the controller.
        9 "Mode" mode: u8,
        /// End of the recording by the controller's clock.
        10 "End Time" end: ControllerTime,
        /// Length of the recording, in seconds.
        19 "Duration" duration: f32,
        /// Time between two samples, in seconds.
        23 "Interval" interval: f32,
        27 "RobotNo" robot_no: i16,
        29 "RobotName" robot_name: Label<32>,
        62 "SensorNo" sensor_no: u8,
        63 "SensorSerial" sensor_serial: Label<10>,
        74 "SensorLabel" sensor_label: Label<32>,
        /// Number of the force monitor object.
        107 "FMNo" monitor_no: i16,
        109 "FMLabel" monitor_label: Label<32>,
        /// Number of the force coordinate system object.
        142 "FCSNo" coordinate_no: i16,
        144 "FCSLabel" coordinate_label: Label<32>,
        /// Why the recording ended.
        177 "EndCondition" end_condition: EndCondition,
        /// The controller's error number, 0 without an error.
        178 "ErrorNo" error_no: i16,
        /// Number of the force guide sequence.
        180 "SeqNo" sequence_no: u8,
    }
}

/// Why a recording ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum EndCondition {
    /// 0: the time given to RecordStart is over.
    #[default]
    DurationElapsed,
    /// 1: the program executed RecordEnd.
    RecordEnd,
    /// 2: a stop was requested.
    StopRequested,
    /// 4: the project was built.
    Build,
    /// 7: the task ended.
    TaskEnded,
    /// -1: see the footer's error number.
    Error,
    /// A number that the manual does not name.
    Other(i8),
}

impl EndCondition {
    /// The number in the packet.
    pub const fn number(self) -> i8 {
        match self {
            Self::DurationElapsed => 0,
            Self::RecordEnd => 1,
            Self::StopRequested => 2,
            Self::Build => 4,
            Self::TaskEnded => 7,
            Self::Error => -1,
            Self::Other(number) => number,
        }
    }
}

impl From<i8> for EndCondition {
    fn from(number: i8) -> Self {
        match number {
            0 => Self::DurationElapsed,
            1 => Self::RecordEnd,
            2 => Self::StopRequested,
            4 => Self::Build,
            7 => Self::TaskEnded,
            -1 => Self::Error,
            number => Self::Other(number),
        }
    }
}

impl Wire for EndCondition {
    const SIZE: usize = 1;

    fn read(bytes: &[u8], at: usize) -> Self {
        i8::read(bytes, at).into()
    }

    fn write(self, bytes: &mut [u8], at: usize) {
        self.number().write(bytes, at);
    }
}
