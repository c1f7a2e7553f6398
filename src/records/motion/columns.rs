use super::block::{
    AXES, BLOCK_BYTES, BlockView, DriveCommandView, EncoderView, MotionRead, RealTimeIoView, SAMPLES, StandardIoView,
    at,
};
use crate::records::columns::{Column, Values};

/// A motion log as columns. Items with eight samples a block have a value a row; force sensor, pulse counters and tool
/// centre point have one value for eight rows. A time stamp of 0 means that there is no value.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MotionColumns {
    /// Of each axis.
    pub encoders: [EncoderColumns; AXES],
    /// Of each axis.
    pub drive_commands: [DriveColumns; AXES],
    /// Columns of the real-time inputs and outputs.
    pub real_time_io: IoColumns<u8>,
    /// Columns of the standard inputs and outputs.
    pub standard_io: IoColumns<u32>,
    /// Columns of the force sensor.
    pub force_sensor: ForceSensorColumns,
    /// Columns of the pulse counters.
    pub pulse_counters: PulseColumns,
    /// Columns of the position of the tool centre point.
    pub tcp: TcpColumns,
}

/// Columns of one axis' encoder.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct EncoderColumns {
    /// Ticks.
    pub timestamp: Vec<u64>,
    /// Pulses.
    pub position: Vec<i64>,
    /// Clock cycles inside the encoder.
    pub timer: Vec<u32>,
    /// °C.
    pub temperature: Vec<i8>,
}

/// Columns of one axis' current commands.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DriveColumns {
    /// Ticks.
    pub timestamp: Vec<u64>,
    /// Commanded d-axis current, in the unit of the drive.
    pub d_current: Vec<i16>,
    /// Commanded q-axis current, in the unit of the drive.
    pub q_current: Vec<i16>,
    /// 65536 are 360°.
    pub electrical_angle: Vec<u16>,
    /// Velocity, in the unit of the drive.
    pub velocity: Vec<i16>,
}

/// Columns of inputs and outputs as bits.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct IoColumns<T> {
    /// Ticks.
    pub timestamp: Vec<u64>,
    /// Inputs; bit 0 is the first.
    pub inputs: Vec<T>,
    /// Outputs; bit 0 is the first.
    pub outputs: Vec<T>,
}

/// Columns of the force sensor: one value a block.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ForceSensorColumns {
    /// Ticks.
    pub timestamp: Vec<u64>,
    /// Fx, Fy, Fz, Mx, My, Mz, in counts of the sensor.
    pub axes: [Vec<i32>; 6],
    /// °C.
    pub axes_temperature: Vec<i16>,
    /// Of the elements a, b, c, d: X, Y, Z, T, in counts.
    pub elements: [[Vec<i32>; 4]; 4],
    /// °C.
    pub elements_temperature: Vec<i16>,
}

/// Columns of the pulse counters: one value a block.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PulseColumns {
    /// Ticks.
    pub timestamp: Vec<u64>,
    /// PLSCNT1_NOW, PLSCNT1_LATCH, PLSCNT2_NOW, PLSCNT2_LATCH.
    pub counters: [Vec<u32>; 4],
}

/// Columns of the tool centre point: one value a block.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TcpColumns {
    /// Ticks.
    pub timestamp: Vec<u64>,
    /// X, Y, Z, U, V, W, R, S, T; mm and degrees.
    pub components: [Vec<f64>; 9],
}

/// Blocks that are taken apart together: few enough that they stay in the fastest cache while every item is read.
const TOGETHER: usize = 8;

impl MotionColumns {
    /// Appends the blocks of one read.
    pub fn extend(&mut self, read: MotionRead<'_>) {
        self.reserve(read.len());
        for blocks in read.raw().chunks(TOGETHER) {
            for (axis, columns) in self.encoders.iter_mut().enumerate() {
                columns.extend(blocks, at::ENCODER + axis * at::ENCODER_AXIS);
            }
            for (axis, columns) in self.drive_commands.iter_mut().enumerate() {
                columns.extend(blocks, at::DRIVE + axis * at::DRIVE_AXIS);
            }
            self.real_time_io.extend(blocks);
            self.standard_io.extend(blocks);
            self.force_sensor.extend(blocks);
            self.pulse_counters.extend(blocks);
            self.tcp.extend(blocks);
        }
    }

    /// Makes room for more blocks.
    pub fn reserve(&mut self, blocks: usize) {
        self.for_each_vec(&mut Reserve(blocks));
    }

    /// Removes every value and keeps the memory.
    pub fn clear(&mut self) {
        self.for_each_vec(&mut Clear);
    }

    fn for_each_vec(&mut self, act: &mut impl EachVec) {
        for axis in &mut self.encoders {
            act.each(&mut axis.timestamp, SAMPLES);
            act.each(&mut axis.position, SAMPLES);
            act.each(&mut axis.timer, SAMPLES);
            act.each(&mut axis.temperature, SAMPLES);
        }
        for axis in &mut self.drive_commands {
            act.each(&mut axis.timestamp, SAMPLES);
            act.each(&mut axis.d_current, SAMPLES);
            act.each(&mut axis.q_current, SAMPLES);
            act.each(&mut axis.electrical_angle, SAMPLES);
            act.each(&mut axis.velocity, SAMPLES);
        }
        act.each(&mut self.real_time_io.timestamp, SAMPLES);
        act.each(&mut self.real_time_io.inputs, SAMPLES);
        act.each(&mut self.real_time_io.outputs, SAMPLES);
        act.each(&mut self.standard_io.timestamp, SAMPLES);
        act.each(&mut self.standard_io.inputs, SAMPLES);
        act.each(&mut self.standard_io.outputs, SAMPLES);
        act.each(&mut self.force_sensor.timestamp, 1);
        self.force_sensor.axes.iter_mut().for_each(|values| act.each(values, 1));
        act.each(&mut self.force_sensor.axes_temperature, 1);
        self.force_sensor.elements.as_flattened_mut().iter_mut().for_each(|values| act.each(values, 1));
        act.each(&mut self.force_sensor.elements_temperature, 1);
        act.each(&mut self.pulse_counters.timestamp, 1);
        self.pulse_counters.counters.iter_mut().for_each(|values| act.each(values, 1));
        act.each(&mut self.tcp.timestamp, 1);
        self.tcp.components.iter_mut().for_each(|values| act.each(values, 1));
    }

    /// How many blocks the columns hold.
    pub const fn blocks(&self) -> usize {
        self.tcp.timestamp.len()
    }

    /// How many rows the columns hold: eight of each block.
    pub const fn rows(&self) -> usize {
        self.blocks() * SAMPLES
    }

    /// Every column, in the order of the manual's table. The names and their order are always the same.
    pub fn columns(&self) -> Vec<Column<'_>> {
        let mut columns = Listed(Vec::with_capacity(104));
        for (axis, encoder) in (1..).zip(&self.encoders) {
            let mut item = columns.item(format!("ENC_{axis}"), &encoder.timestamp, 1);
            item.add("ENC_POS", "pulses", Values::I64(&encoder.position));
            item.add("ENC_TMR", "", Values::U32(&encoder.timer));
            item.add("ENC_TEMP", "°C", Values::I8(&encoder.temperature));
        }
        for (axis, drive) in (1..).zip(&self.drive_commands) {
            let mut item = columns.item(format!("DRVCMD_{axis}"), &drive.timestamp, 1);
            item.add("IDREF", "", Values::I16(&drive.d_current));
            item.add("IQREF", "", Values::I16(&drive.q_current));
            item.add("EANGLE", "360°/65536", Values::U16(&drive.electrical_angle));
            item.add("VEL", "", Values::I16(&drive.velocity));
        }
        let mut item = columns.item("RT-I/O".into(), &self.real_time_io.timestamp, 1);
        item.add("RTIO_IN", "bits", Values::U8(&self.real_time_io.inputs));
        item.add("RTIO_OUT", "bits", Values::U8(&self.real_time_io.outputs));
        let mut item = columns.item("STD-I/O".into(), &self.standard_io.timestamp, 1);
        item.add("STDIO_IN", "bits", Values::U32(&self.standard_io.inputs));
        item.add("STDIO_OUT", "bits", Values::U32(&self.standard_io.outputs));
        let sensor = &self.force_sensor;
        let mut item = columns.item("FSENS".into(), &sensor.timestamp, SAMPLES);
        for (name, values) in ["Fx", "Fy", "Fz", "Mx", "My", "Mz"].into_iter().zip(&sensor.axes) {
            item.add(name, "counts", Values::I32(values));
        }
        item.add("6D_Temperature", "°C", Values::I16(&sensor.axes_temperature));
        for (element, outputs) in ["a", "b", "c", "d"].into_iter().zip(&sensor.elements) {
            for (name, values) in ["X", "Y", "Z", "T"].into_iter().zip(outputs) {
                item.add(&format!("{name}{element}"), "counts", Values::I32(values));
            }
        }
        item.add("16D_Temperature", "°C", Values::I16(&sensor.elements_temperature));
        let mut item = columns.item("PLSCNT".into(), &self.pulse_counters.timestamp, SAMPLES);
        let names = ["PLSCNT1_NOW", "PLSCNT1_LATCH", "PLSCNT2_NOW", "PLSCNT2_LATCH"];
        for (name, values) in names.into_iter().zip(&self.pulse_counters.counters) {
            item.add(name, "pulses", Values::U32(values));
        }
        let mut item = columns.item("TCP".into(), &self.tcp.timestamp, SAMPLES);
        let names = ["X", "Y", "Z", "U", "V", "W", "R", "S", "T"];
        let units = ["mm", "mm", "mm", "deg", "deg", "deg", "", "", ""];
        for ((name, unit), values) in names.into_iter().zip(units).zip(&self.tcp.components) {
            item.add(name, unit, Values::F64(values));
        }
        columns.0
    }
}

impl EncoderColumns {
    fn extend(&mut self, blocks: &[[u8; BLOCK_BYTES]], at: usize) {
        extend_samples(&mut self.timestamp, blocks, at, |sample| EncoderView::new(sample).timestamp().0);
        extend_samples(&mut self.position, blocks, at, |sample| EncoderView::new(sample).position());
        extend_samples(&mut self.timer, blocks, at, |sample| EncoderView::new(sample).timer());
        extend_samples(&mut self.temperature, blocks, at, |sample| EncoderView::new(sample).temperature());
    }
}

impl DriveColumns {
    fn extend(&mut self, blocks: &[[u8; BLOCK_BYTES]], at: usize) {
        extend_samples(&mut self.timestamp, blocks, at, |sample| DriveCommandView::new(sample).timestamp().0);
        extend_samples(&mut self.d_current, blocks, at, |sample| DriveCommandView::new(sample).d_current());
        extend_samples(&mut self.q_current, blocks, at, |sample| DriveCommandView::new(sample).q_current());
        extend_samples(&mut self.electrical_angle, blocks, at, |sample| {
            DriveCommandView::new(sample).electrical_angle()
        });
        extend_samples(&mut self.velocity, blocks, at, |sample| DriveCommandView::new(sample).velocity());
    }
}

/// Appends one field of the samples that begin at `at` in each block; a sample has `N` bytes. The samples are written
/// where they stay: built beside the column and copied, they take twice as long.
#[inline(always)]
fn extend_samples<T: Copy + Default, const N: usize>(
    column: &mut Vec<T>,
    blocks: &[[u8; BLOCK_BYTES]],
    at: usize,
    field: impl Fn(&[u8; N]) -> T,
) {
    let start = column.len();
    column.resize(start + blocks.len() * SAMPLES, T::default());
    let (values, _) = column[start..].as_chunks_mut::<SAMPLES>();
    for (values, block) in values.iter_mut().zip(blocks) {
        let (samples, _) = block[at..at + SAMPLES * N].as_chunks::<N>();
        for (value, sample) in values.iter_mut().zip(samples) {
            *value = field(sample);
        }
    }
}

impl IoColumns<u8> {
    fn extend(&mut self, blocks: &[[u8; BLOCK_BYTES]]) {
        extend_samples(&mut self.timestamp, blocks, at::REAL_TIME_IO, |sample| {
            RealTimeIoView::new(sample).timestamp().0
        });
        extend_samples(&mut self.inputs, blocks, at::REAL_TIME_IO, |sample| RealTimeIoView::new(sample).inputs());
        extend_samples(&mut self.outputs, blocks, at::REAL_TIME_IO, |sample| RealTimeIoView::new(sample).outputs());
    }
}

impl IoColumns<u32> {
    fn extend(&mut self, blocks: &[[u8; BLOCK_BYTES]]) {
        extend_samples(&mut self.timestamp, blocks, at::STANDARD_IO, |sample| {
            StandardIoView::new(sample).timestamp().0
        });
        extend_samples(&mut self.inputs, blocks, at::STANDARD_IO, |sample| StandardIoView::new(sample).inputs());
        extend_samples(&mut self.outputs, blocks, at::STANDARD_IO, |sample| StandardIoView::new(sample).outputs());
    }
}

impl ForceSensorColumns {
    fn extend(&mut self, blocks: &[[u8; BLOCK_BYTES]]) {
        extend_once(&mut self.timestamp, blocks, |block| block.force_sensor().timestamp().0);
        for block in blocks {
            let sensor = BlockView::new(block).force_sensor();
            let (axes, elements) = (sensor.axes(), sensor.elements());
            push(&mut self.axes, axes.force.into_iter().chain(axes.moment));
            self.axes_temperature.push(axes.temperature);
            for (columns, outputs) in self.elements.iter_mut().zip(elements.outputs) {
                push(columns, outputs);
            }
            self.elements_temperature.push(elements.temperature);
        }
    }
}

impl PulseColumns {
    fn extend(&mut self, blocks: &[[u8; BLOCK_BYTES]]) {
        extend_once(&mut self.timestamp, blocks, |block| block.pulse_counters().timestamp().0);
        let [first, first_latched, second, second_latched] = &mut self.counters;
        extend_once(first, blocks, |block| block.pulse_counters().first());
        extend_once(first_latched, blocks, |block| block.pulse_counters().first_latched());
        extend_once(second, blocks, |block| block.pulse_counters().second());
        extend_once(second_latched, blocks, |block| block.pulse_counters().second_latched());
    }
}

impl TcpColumns {
    fn extend(&mut self, blocks: &[[u8; BLOCK_BYTES]]) {
        extend_once(&mut self.timestamp, blocks, |block| block.tcp().timestamp().0);
        for block in blocks {
            push(&mut self.components, BlockView::new(block).tcp().components());
        }
    }
}

/// Appends one value to each column.
fn push<T>(columns: &mut [Vec<T>], values: impl IntoIterator<Item = T>) {
    for (column, value) in columns.iter_mut().zip(values) {
        column.push(value);
    }
}

/// Appends one field of an item that a block holds once.
#[inline(always)]
fn extend_once<T>(column: &mut Vec<T>, blocks: &[[u8; BLOCK_BYTES]], field: impl Fn(BlockView<'_>) -> T) {
    column.extend(blocks.iter().map(|block| field(BlockView::new(block))));
}

trait EachVec {
    /// `values`: how many values a block has in the vector.
    fn each<T>(&mut self, vec: &mut Vec<T>, values: usize);
}

struct Reserve(usize);

impl EachVec for Reserve {
    fn each<T>(&mut self, vec: &mut Vec<T>, values: usize) {
        vec.reserve(self.0 * values);
    }
}

struct Clear;

impl EachVec for Clear {
    fn each<T>(&mut self, vec: &mut Vec<T>, _: usize) {
        vec.clear();
    }
}

struct Listed<'a>(Vec<Column<'a>>);

struct Item<'a, 'l> {
    columns: &'l mut Vec<Column<'a>>,
    name: String,
    timestamps: &'a [u64],
    rows_per_value: usize,
}

impl<'a> Listed<'a> {
    fn item(&mut self, name: String, timestamps: &'a [u64], rows_per_value: usize) -> Item<'a, '_> {
        let mut item = Item { columns: &mut self.0, name, timestamps, rows_per_value };
        item.add("TIMESTAMP", "ticks", Values::U64(timestamps));
        item
    }
}

impl<'a> Item<'a, '_> {
    fn add(&mut self, name: &str, unit: &'static str, values: Values<'a>) {
        self.columns.push(Column {
            name: format!("{}.{name}", self.name),
            unit,
            values,
            timestamps: Some(self.timestamps),
            rows_per_value: self.rows_per_value,
        });
    }
}
