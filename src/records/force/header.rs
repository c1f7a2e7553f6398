use crate::records::layout::packet;
use crate::records::text::Label;
use crate::records::time::{ControllerTime, Ticks};

packet! {
    /// The start of a recording (manual 4.1.3, header). In version 2, [`ForceHeader::record_start`] follows.
    HeaderView / Header [310] tag 1 {
        /// 1 before firmware 8.0.0, 2 from there on.
        1 "OPCUACommonVer" version: u8,
        /// Goes up by one with each RecordStart; the same in header, data and footer.
        2 "OPCUACommonID" id: u16,
        6 "PacketVersion" packet_version: u8,
        /// Not used by the controller.
        7 "PacketType" packet_type: u8,
        /// Output channel.
        8 "Channel" channel: u8,
        /// Recording mode; not used by the controller.
        9 "Mode" mode: u8,
        /// Start of the recording by the controller's clock.
        10 "Start Time" start: ControllerTime,
        /// Length of the recording that was asked for, in seconds.
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
        /// File name given to RecordStart.
        177 "FileName" file_name: Label<64>,
        /// Number of the force guide sequence.
        242 "SeqNo" sequence_no: u8,
        243 "SeqName" sequence_name: Label<32>,
        /// Name of the force file.
        276 "ForceName" force_name: Label<32>,
        /// `RobotLocal` of the force monitor object.
        309 "RobotLocal" robot_local: u8,
    }
}

/// Bytes of a header of version 1, and of the part that both versions share.
pub const HEADER_V1_BYTES: usize = HeaderView::SIZE;
/// Bytes of a header of version 2.
pub const HEADER_V2_BYTES: usize = HeaderView::SIZE + 8;

/// A header of either version.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ForceHeader {
    /// The part that both versions share.
    pub header: Header,
    /// RecordStartTime: the tick of RecordStart, on the same scale as the motion log's. Version 2 only.
    pub record_start: Option<Ticks>,
}

impl ForceHeader {
    /// 310 bytes of version 1, or 318 of version 2 where `record_start` is set. The version of `header` is not used.
    pub fn encode(&self) -> Vec<u8> {
        let version = if self.record_start.is_some() { 2 } else { 1 };
        let mut bytes = Header { version, ..self.header }.encode().to_vec();
        if let Some(start) = self.record_start {
            bytes.extend_from_slice(&start.0.to_le_bytes());
        }
        bytes
    }
}
