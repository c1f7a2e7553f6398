use std::fmt;

use super::force_sensor::{ForceSensor, ForceSensorView};
use crate::records::MAX_READ_BYTES;
use crate::records::error::{Mistake, PacketKind, RecordError};
use crate::records::layout::{Field, Wire, field_at, packet};
use crate::records::time::Ticks;

/// Axes with encoders and current commands in a block.
pub const AXES: usize = 6;
/// Samples of an item in a block, in the order of time.
pub const SAMPLES: usize = 8;
/// Bytes of a block.
pub const BLOCK_BYTES: usize = 2608;
/// The largest value of the DataNum node: blocks in one read.
pub const MAX_BLOCKS_PER_READ: usize = 200;

packet! {
    /// One sample of an axis' encoder (ENC). 3 bytes at its end are unused.
    EncoderView / Encoder [24] {
        0 "TIMESTAMP" timestamp: Ticks,
        /// Pulses.
        8 "ENC_POS" position: i64,
        /// Clock cycles inside the encoder.
        16 "ENC_TMR" timer: u32,
        /// °C.
        20 "ENC_TEMP" temperature: i8,
    }
}

packet! {
    /// One sample of an axis' current command (DRVCMD). Currents and velocity are in the drive's own units.
    DriveCommandView / DriveCommand [20] {
        0 "TIMESTAMP" timestamp: Ticks,
        /// Commanded current of the D axis.
        10 "IDREF" d_current: i16,
        /// Commanded current of the Q axis.
        12 "IQREF" q_current: i16,
        /// Electrical angle; 65536 are 360°.
        14 "EANGLE" electrical_angle: u16,
        16 "VEL" velocity: i16,
    }
}

packet! {
    /// One sample of the real-time I/O (RT-I/O). The lower four bits are the standard R-I/O.
    RealTimeIoView / RealTimeIo [16] {
        0 "TIMESTAMP" timestamp: Ticks,
        8 "RTIO_IN" inputs: u8,
        12 "RTIO_OUT" outputs: u8,
    }
}

packet! {
    /// One sample of the standard I/O (STD-I/O).
    StandardIoView / StandardIo [24] {
        0 "TIMESTAMP" timestamp: Ticks,
        /// 24 inputs in the lower three bytes.
        16 "STDIO_IN" inputs: u32,
        /// 16 outputs in the lower two bytes.
        20 "STDIO_OUT" outputs: u32,
    }
}

packet! {
    /// The pulse counters (PLSCNT).
    PulseCountersView / PulseCounters [24] {
        0 "TIMESTAMP" timestamp: Ticks,
        8 "PLSCNT1_NOW" first: u32,
        /// The value kept when the latch signal came.
        12 "PLSCNT1_LATCH" first_latched: u32,
        16 "PLSCNT2_NOW" second: u32,
        /// The value kept when the latch signal came.
        20 "PLSCNT2_LATCH" second_latched: u32,
    }
}

packet! {
    /// Position of the tool centre point (TCP).
    TcpPositionView / TcpPosition [80] {
        0 "TIMESTAMP" timestamp: Ticks,
        /// X, Y, Z in mm; U, V, W in degrees; then R, S, T of additional axes.
        8 "X" components: [f64; 9],
    }
}

/// One block. Accessors of eight samples take the sample's number, 0 to 7.
#[derive(Debug, Clone, Copy)]
pub struct BlockView<'a>(&'a [u8; BLOCK_BYTES]);

/// Offsets of the items of a block.
pub(super) mod at {
    pub const ENCODER: usize = 0;
    pub const ENCODER_AXIS: usize = 192;
    pub const DRIVE: usize = 1152;
    pub const DRIVE_AXIS: usize = 160;
    pub const REAL_TIME_IO: usize = 2112;
    pub const STANDARD_IO: usize = 2240;
    pub const FORCE_SENSOR: usize = 2432;
    pub const PULSE_COUNTERS: usize = 2504;
    pub const TCP: usize = 2528;
}

const ENCODERS: [&str; AXES] = ["ENC_1", "ENC_2", "ENC_3", "ENC_4", "ENC_5", "ENC_6"];
const DRIVES: [&str; AXES] = ["DRVCMD_1", "DRVCMD_2", "DRVCMD_3", "DRVCMD_4", "DRVCMD_5", "DRVCMD_6"];

/// The items of a block, in their order (manual 4.3.3).
const ITEMS: [Field; 17] = {
    let mut items = [Field { name: "", offset: 0, size: 0 }; 17];
    let mut axis = 0;
    while axis < AXES {
        items[axis] =
            Field { name: ENCODERS[axis], offset: at::ENCODER + axis * at::ENCODER_AXIS, size: at::ENCODER_AXIS };
        items[AXES + axis] =
            Field { name: DRIVES[axis], offset: at::DRIVE + axis * at::DRIVE_AXIS, size: at::DRIVE_AXIS };
        axis += 1;
    }
    items[12] = Field { name: "RT-I/O", offset: at::REAL_TIME_IO, size: SAMPLES * RealTimeIoView::SIZE };
    items[13] = Field { name: "STD-I/O", offset: at::STANDARD_IO, size: SAMPLES * StandardIoView::SIZE };
    items[14] = Field { name: "FSENS", offset: at::FORCE_SENSOR, size: ForceSensorView::SIZE };
    items[15] = Field { name: "PLSCNT", offset: at::PULSE_COUNTERS, size: PulseCountersView::SIZE };
    items[16] = Field { name: "TCP", offset: at::TCP, size: TcpPositionView::SIZE };
    items
};

impl<'a> BlockView<'a> {
    /// The items of the manual's table.
    pub const FIELDS: &'static [Field] = &ITEMS;

    /// Looks at the bytes of a block. Checks nothing.
    pub const fn new(bytes: &'a [u8; BLOCK_BYTES]) -> Self {
        Self(bytes)
    }

    /// The bytes of the block.
    pub const fn bytes(self) -> &'a [u8; BLOCK_BYTES] {
        self.0
    }

    #[inline(always)]
    fn item<const N: usize>(self, at: usize) -> &'a [u8; N] {
        let Some(item) = self.0.get(at..).and_then(<[u8]>::first_chunk) else {
            panic!("the block has no item at {at}");
        };
        item
    }

    /// Encoder of an axis, 0 to 5.
    ///
    /// # Panics
    /// If there is no such axis or sample. So do the others with a number.
    #[inline(always)]
    pub fn encoder(self, axis: usize, sample: usize) -> EncoderView<'a> {
        assert!(axis < AXES && sample < SAMPLES, "axis {axis}, sample {sample}");
        EncoderView::new(self.item(at::ENCODER + axis * at::ENCODER_AXIS + sample * EncoderView::SIZE))
    }

    /// Current command of an axis, 0 to 5.
    #[inline(always)]
    pub fn drive_command(self, axis: usize, sample: usize) -> DriveCommandView<'a> {
        assert!(axis < AXES && sample < SAMPLES, "axis {axis}, sample {sample}");
        DriveCommandView::new(self.item(at::DRIVE + axis * at::DRIVE_AXIS + sample * DriveCommandView::SIZE))
    }

    /// One of the samples of the real-time inputs and outputs.
    #[inline(always)]
    pub fn real_time_io(self, sample: usize) -> RealTimeIoView<'a> {
        assert!(sample < SAMPLES, "sample {sample}");
        RealTimeIoView::new(self.item(at::REAL_TIME_IO + sample * RealTimeIoView::SIZE))
    }

    /// One of the samples of the standard inputs and outputs.
    #[inline(always)]
    pub fn standard_io(self, sample: usize) -> StandardIoView<'a> {
        assert!(sample < SAMPLES, "sample {sample}");
        StandardIoView::new(self.item(at::STANDARD_IO + sample * StandardIoView::SIZE))
    }

    /// The sample of the force sensor.
    #[inline(always)]
    pub fn force_sensor(self) -> ForceSensorView<'a> {
        ForceSensorView::new(self.item(at::FORCE_SENSOR))
    }

    /// The pulse counters.
    #[inline(always)]
    pub fn pulse_counters(self) -> PulseCountersView<'a> {
        PulseCountersView::new(self.item(at::PULSE_COUNTERS))
    }

    /// The position of the tool centre point.
    #[inline(always)]
    pub fn tcp(self) -> TcpPositionView<'a> {
        TcpPositionView::new(self.item(at::TCP))
    }

    /// Reads every field.
    pub fn to_packet(self) -> MotionBlock {
        use std::array::from_fn;
        MotionBlock {
            encoders: from_fn(|axis| from_fn(|sample| self.encoder(axis, sample).to_packet())),
            drive_commands: from_fn(|axis| from_fn(|sample| self.drive_command(axis, sample).to_packet())),
            real_time_io: from_fn(|sample| self.real_time_io(sample).to_packet()),
            standard_io: from_fn(|sample| self.standard_io(sample).to_packet()),
            force_sensor: self.force_sensor().to_packet(),
            pulse_counters: self.pulse_counters().to_packet(),
            tcp: self.tcp().to_packet(),
        }
    }

    /// The earliest time stamp of the block that holds data.
    pub fn first_timestamp(self) -> Option<Ticks> {
        self.timestamps().map(|(_, ticks)| ticks).filter(|ticks| ticks.is_some()).min()
    }

    /// The latest time stamp of the block.
    pub fn last_timestamp(self) -> Option<Ticks> {
        self.timestamps().map(|(_, ticks)| ticks).filter(|ticks| ticks.is_some()).max()
    }

    /// Every bit that any time stamp has.
    fn timestamps_united(self) -> u64 {
        let mut united =
            self.force_sensor().timestamp().0 | self.pulse_counters().timestamp().0 | self.tcp().timestamp().0;
        for sample in 0..SAMPLES {
            for axis in 0..AXES {
                united |= self.encoder(axis, sample).timestamp().0 | self.drive_command(axis, sample).timestamp().0;
            }
            united |= self.real_time_io(sample).timestamp().0 | self.standard_io(sample).timestamp().0;
        }
        united
    }

    /// Every time stamp with its offset in the block.
    fn timestamps(self) -> impl Iterator<Item = (usize, Ticks)> {
        let strides = [24, 24, 24, 24, 24, 24, 20, 20, 20, 20, 20, 20, 16, 24, 72, 24, 80];
        ITEMS
            .iter()
            .zip(strides)
            .flat_map(|(item, stride)| (item.offset..item.offset + item.size).step_by(stride))
            .map(move |offset| (offset, Ticks::read(self.0, offset)))
    }
}

/// The fields of a block.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionBlock {
    /// Of each axis, eight samples in the order of time.
    pub encoders: [[Encoder; SAMPLES]; AXES],
    /// The current commands of each axis.
    pub drive_commands: [[DriveCommand; SAMPLES]; AXES],
    /// The real-time inputs and outputs.
    pub real_time_io: [RealTimeIo; SAMPLES],
    /// The standard inputs and outputs.
    pub standard_io: [StandardIo; SAMPLES],
    /// The force sensor.
    pub force_sensor: ForceSensor,
    /// The pulse counters.
    pub pulse_counters: PulseCounters,
    /// The position of the tool centre point.
    pub tcp: TcpPosition,
}

impl MotionBlock {
    /// Appends the 2608 bytes of the block. Reserved bytes are 0.
    pub fn encode_into(&self, bytes: &mut Vec<u8>) {
        let start = bytes.len();
        bytes.resize(start + BLOCK_BYTES, 0);
        let block = &mut bytes[start..];
        self.encoders.write(block, at::ENCODER);
        self.drive_commands.write(block, at::DRIVE);
        self.real_time_io.write(block, at::REAL_TIME_IO);
        self.standard_io.write(block, at::STANDARD_IO);
        self.force_sensor.write(block, at::FORCE_SENSOR);
        self.pulse_counters.write(block, at::PULSE_COUNTERS);
        self.tcp.write(block, at::TCP);
    }
}

/// What one read of the motion log's `Data` node brought: whole blocks.
#[derive(Clone, Copy)]
pub struct MotionRead<'a>(&'a [[u8; BLOCK_BYTES]]);

impl<'a> MotionRead<'a> {
    /// Looks at the bytes of one read and checks that they are whole blocks, at least one, and that no time stamp is
    /// beyond [`Ticks::LIMIT`]. Every other value is possible in a block.
    ///
    /// # Errors
    /// Other bytes.
    pub fn decode(bytes: &'a [u8]) -> Result<Self, RecordError> {
        let (blocks, rest) = bytes.as_chunks::<BLOCK_BYTES>();
        let wrong = |record, field, offset, mistake| {
            let offset = record * BLOCK_BYTES + offset;
            RecordError { packet: PacketKind::MotionBlock, record, field, offset, mistake }
        };
        if bytes.len() > MAX_READ_BYTES {
            return Err(wrong(0, "ENC_1", 0, Mistake::TooLarge { length: bytes.len(), max: MAX_READ_BYTES }));
        }
        if !rest.is_empty() || blocks.is_empty() {
            let field = field_at(BlockView::FIELDS, rest.len());
            let missing = Mistake::Truncated { missing: BLOCK_BYTES - rest.len() };
            return Err(wrong(blocks.len(), field.name, field.offset, missing));
        }
        for (record, block) in blocks.iter().enumerate() {
            let block = BlockView::new(block);
            if block.timestamps_united() < Ticks::LIMIT.0 {
                continue;
            }
            if let Some((offset, ticks)) = block.timestamps().find(|(_, ticks)| *ticks >= Ticks::LIMIT) {
                let expected = "more than a hundred years after the controller was switched on";
                let field = field_at(BlockView::FIELDS, offset).name;
                return Err(wrong(record, field, offset, Mistake::Value { found: ticks.0, expected }));
            }
        }
        Ok(Self(blocks))
    }

    /// The blocks, in the order of time.
    pub fn blocks(self) -> impl ExactSizeIterator<Item = BlockView<'a>> + Clone {
        self.0.iter().map(BlockView::new)
    }

    /// How many blocks there are.
    pub const fn len(self) -> usize {
        self.0.len()
    }

    /// Whether there are none. [`MotionRead::decode`] gives at least one.
    pub const fn is_empty(self) -> bool {
        self.0.is_empty()
    }

    /// The bytes of the blocks.
    pub(super) const fn raw(self) -> &'a [[u8; BLOCK_BYTES]] {
        self.0
    }
}

impl fmt::Debug for MotionRead<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "MotionRead({} blocks)", self.len())
    }
}

#[cfg(test)]
mod tests;
