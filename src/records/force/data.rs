//! The data records of the four DataTypes (manual 4.1.3, data part). Lengths in mm, angles in degrees, forces in N,
//! torques in N·m, speeds in mm/s.

use crate::records::layout::packet;
use crate::records::time::ControllerTime;

/// Which groups of values a data record holds: the value of the DataType node and of OPCUADataType.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum ForceDataType {
    /// 0: every group, 178 bytes.
    #[default]
    All = 0,
    /// 1: position, speed, joints, overload rates, time, 109 bytes.
    Motion = 1,
    /// 2: force and position, 86 bytes.
    Force = 2,
    /// 3: position, 54 bytes.
    Position = 3,
}

impl ForceDataType {
    /// All of them, in the order of their numbers.
    pub const ALL: [Self; 4] = [Self::All, Self::Motion, Self::Force, Self::Position];

    /// The DataType with this number, 0 to 3.
    pub const fn from_number(number: u16) -> Option<Self> {
        match number {
            0 => Some(Self::All),
            1 => Some(Self::Motion),
            2 => Some(Self::Force),
            3 => Some(Self::Position),
            _ => None,
        }
    }

    /// The number in the packet and in the DataType node.
    pub const fn number(self) -> u16 {
        self as u16
    }

    /// Bytes of one record.
    pub const fn record_bytes(self) -> usize {
        match self {
            Self::All => AllView::SIZE,
            Self::Motion => MotionView::SIZE,
            Self::Force => ForceView::SIZE,
            Self::Position => PositionView::SIZE,
        }
    }
}

packet! {
    /// What a data record of any DataType begins with.
    HeadView / DataHead [22] {
        /// 1 before firmware 8.0.0, 2 from there on.
        1 "OPCUACommonVer" version: u8,
        /// The id of the header.
        2 "OPCUACommonID" id: u16,
        /// Written by `encode` of the record.
        6 "OPCUADataType" data_type: u16,
        10 "PacketVersion" packet_version: u8,
        /// Not used by the controller.
        11 "PacketType" packet_type: u8,
        /// Output channel.
        12 "Channel" channel: u8,
        /// Recording mode; not used by the controller.
        13 "Mode" mode: u8,
        /// Number of the record in its recording.
        14 "Count" count: u32,
        /// Since the start of the recording, in milliseconds.
        18 "ElapsedTime" elapsed: u32,
    }
}

packet! {
    /// Fx, Fy, Fz, Tx, Ty, Tz in the force coordinate system, and the magnitudes of force and torque.
    ForcesView / Forces [32] {
        0 "Force" force: [f32; 3],
        12 "Torque" torque: [f32; 3],
        24 "Fmag" force_magnitude: f32,
        28 "Tmag" torque_magnitude: f32,
    }
}

packet! {
    /// Speed of the tool centre point in the base coordinate system.
    SpeedView / TcpSpeed [16] {
        0 "TCPSpeed" speed: f32,
        /// The components in X, Y, Z.
        4 "TCPSpeed(X)" components: [f32; 3],
    }
}

packet! {
    /// A data record of DataType 0.
    AllView / AllData [178] tag 2 {
        0 "head" head: DataHead,
        22 "Force" forces: Forces,
        /// Commanded position of position control and force control together: X, Y, Z, U, V, W.
        54 "CurPos" position: [f32; 6],
        /// Commanded position of position control alone.
        78 "RefPos" reference: [f32; 6],
        /// Correction by force control: X, Y, Z.
        102 "Diff" correction: [f32; 3],
        114 "TCPSpeed" speed: TcpSpeed,
        /// J1 to J6; degrees, or mm for a linear joint.
        130 "Joint" joints: [f32; 6],
        /// J1 to J6; 0 to 200, in percent.
        154 "OLRate" overload: [u8; 6],
        /// Whether force control runs, 0 or 1.
        160 "FCOn" force_control: u8,
        /// Set by the program with StepID.
        161 "StepID" step_id: u32,
        165 "Time" time: ControllerTime,
        /// Number of the force guide sequence; 0 while none runs.
        174 "SeqNo" sequence_no: u8,
        175 "ObjectNo" object_no: u8,
        /// Number of the force monitor object.
        176 "FMNo" monitor_no: i16,
    }
}

packet! {
    /// A data record of DataType 1.
    MotionView / MotionData [109] tag 2 {
        0 "head" head: DataHead,
        /// Commanded position: X, Y, Z, U, V, W.
        22 "CurPos" position: [f32; 6],
        46 "TCPSpeed" speed: TcpSpeed,
        /// J1 to J6; degrees, or mm for a linear joint.
        62 "Joint" joints: [f32; 6],
        /// J1 to J6; 0 to 200, in percent.
        86 "OLRate" overload: [u8; 6],
        /// Set by the program with StepID.
        92 "StepID" step_id: u32,
        96 "Time" time: ControllerTime,
        /// Number of the force guide sequence; 0 while none runs.
        105 "SeqNo" sequence_no: u8,
        106 "ObjectNo" object_no: u8,
        /// Number of the force monitor object.
        107 "FMNo" monitor_no: i16,
    }
}

packet! {
    /// A data record of DataType 2.
    ForceView / ForceAndPosition [86] tag 2 {
        0 "head" head: DataHead,
        22 "Force" forces: Forces,
        /// Commanded position: X, Y, Z, U, V, W.
        54 "CurPos" position: [f32; 6],
        /// Set by the program with StepID.
        78 "StepID" step_id: u32,
        /// Number of the force guide sequence; 0 while none runs.
        82 "SeqNo" sequence_no: u8,
        83 "ObjectNo" object_no: u8,
        /// Number of the force monitor object.
        84 "FMNo" monitor_no: i16,
    }
}

packet! {
    /// A data record of DataType 3.
    PositionView / PositionData [54] tag 2 {
        0 "head" head: DataHead,
        /// Commanded position: X, Y, Z, U, V, W.
        22 "CurPos" position: [f32; 6],
        /// Set by the program with StepID.
        46 "StepID" step_id: u32,
        /// Number of the force guide sequence; 0 while none runs.
        50 "SeqNo" sequence_no: u8,
        51 "ObjectNo" object_no: u8,
        /// Number of the force monitor object.
        52 "FMNo" monitor_no: i16,
    }
}

/// A data record of any DataType.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ForceData {
    /// DataType 0: every field.
    All(AllData),
    /// DataType 1: position, speed and joints.
    Motion(MotionData),
    /// DataType 2: forces and position.
    Force(ForceAndPosition),
    /// DataType 3: position.
    Position(PositionData),
}

impl AllData {
    /// The record that a controller sends of this sample while its DataType node holds `data_type`.
    pub fn reduced(self, data_type: ForceDataType) -> ForceData {
        let Self { head, forces, position, speed, joints, overload, step_id, time, sequence_no, .. } = self;
        let (object_no, monitor_no) = (self.object_no, self.monitor_no);
        match data_type {
            ForceDataType::All => ForceData::All(self),
            ForceDataType::Motion => ForceData::Motion(MotionData {
                head,
                position,
                speed,
                joints,
                overload,
                step_id,
                time,
                sequence_no,
                object_no,
                monitor_no,
            }),
            ForceDataType::Force => ForceData::Force(ForceAndPosition {
                head,
                forces,
                position,
                step_id,
                sequence_no,
                object_no,
                monitor_no,
            }),
            ForceDataType::Position => {
                ForceData::Position(PositionData { head, position, step_id, sequence_no, object_no, monitor_no })
            }
        }
    }
}

impl ForceData {
    /// Which groups the record holds.
    pub const fn data_type(&self) -> ForceDataType {
        match self {
            Self::All(_) => ForceDataType::All,
            Self::Motion(_) => ForceDataType::Motion,
            Self::Force(_) => ForceDataType::Force,
            Self::Position(_) => ForceDataType::Position,
        }
    }

    /// What the record begins with.
    pub const fn head(&self) -> &DataHead {
        match self {
            Self::All(record) => &record.head,
            Self::Motion(record) => &record.head,
            Self::Force(record) => &record.head,
            Self::Position(record) => &record.head,
        }
    }

    /// Appends the bytes of the record. Tag and OPCUADataType are those of the variant.
    pub fn encode_into(&self, bytes: &mut Vec<u8>) {
        let start = bytes.len();
        match self {
            Self::All(record) => bytes.extend_from_slice(&record.encode()),
            Self::Motion(record) => bytes.extend_from_slice(&record.encode()),
            Self::Force(record) => bytes.extend_from_slice(&record.encode()),
            Self::Position(record) => bytes.extend_from_slice(&record.encode()),
        }
        // The head is a table of its own, without the tag.
        bytes[start] = super::TAG_DATA;
        bytes[start + 6..start + 8].copy_from_slice(&self.data_type().number().to_le_bytes());
    }
}
