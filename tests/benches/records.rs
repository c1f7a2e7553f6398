//! How fast packets of the motion log and the force sensor become columns, against NumPy doing the same with structured
//! dtypes, and how fast the zero-copy views walk over every field, against a copy of the same bytes; and how long a plot
//! of ten million points takes.
//!
//! `cargo bench --bench records -- [BLOCKS]`; 8,000 without an argument. NumPy is taken from the Python of `RECORDS_PYTHON`
//! or from `python3`; without it, its lines are missing.

#[allow(dead_code, reason = "other benches need more of it")]
mod report;

use std::hint::black_box;
use std::io::Write as _;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use opcua_configurator::recorder::Series;
use opcua_configurator::records::force::{
    AllData, AllView, DataHead, DataRecords, ForceColumns, ForceDataType, ForceRead,
};
use opcua_configurator::records::motion::{
    AXES, BLOCK_BYTES, BlockView, MotionBlock, MotionColumns, MotionRead, SAMPLES,
};
use opcua_configurator::records::{ControllerTime, MAX_READ_BYTES, Ticks};
use report::{Spread, line};

const ROUNDS: usize = 15;
/// Blocks or records in one read, as a client gets them that polls.
const BLOCKS_PER_READ: usize = 8;
const RECORDS_PER_READ: usize = 100;
/// Columns of a plot over the whole width of a large screen.
const PIXELS: usize = 3840;

fn main() {
    let benching = report::is_benching();
    let blocks = report::number(0).unwrap_or(if benching { 8_000 } else { 16 });
    let rounds = report::rounds_when(benching, ROUNDS);
    let (motion, force) = (motion_log(blocks), force_records(blocks * 10));
    println!("{} MB of motion log, {} MB of force records", motion.len() / 1_000_000, force.len() / 1_000_000);
    let numpy = Numpy::find();
    if numpy.is_none() {
        println!("NumPy was not found");
    }
    let motion_read = BLOCKS_PER_READ * BLOCK_BYTES;
    for (what, read) in [("motion log, whole", motion.len()), ("motion log, read by read", motion_read)] {
        let mut columns = MotionColumns::default();
        let ours = rate(&motion, rounds, |bytes| motion_columns(&mut columns, bytes, read));
        compare(what, &ours, numpy.as_ref().and_then(|numpy| numpy.rate("motion", &motion, read, rounds)));
    }
    let force_read = RECORDS_PER_READ * ForceDataType::All.record_bytes();
    for (what, read) in [("force, whole", force.len()), ("force, read by read", force_read)] {
        let mut columns = ForceColumns::default();
        let ours = rate(&force, rounds, |bytes| force_columns(&mut columns, bytes, read));
        compare(what, &ours, numpy.as_ref().and_then(|numpy| numpy.rate("force", &force, read, rounds)));
    }
    let mut copy = vec![0_u8; motion.len()];
    let copied = rate(&motion, rounds, |bytes| {
        copy.copy_from_slice(bytes);
        black_box(&copy).len()
    });
    line("memcpy (GB/s)", &copied);
    for (what, bytes, walk) in
        [("motion log", &motion, walk_motion as fn(&[u8]) -> usize), ("force", &force, walk_force)]
    {
        let walked = rate(bytes, rounds, walk);
        let ratio = walked.median() / copied.median();
        line(&format!("{what}, walked (GB/s)"), format!("{walked}; {ratio:.2} × memcpy, target 0.5 ×"));
    }
    plot(if benching { 10_000_000 } else { 10_000 }, rounds);
}

/// A sine with noise, plotted whole, and in a part that moves.
fn plot(points: usize, rounds: usize) {
    let mut series = Series::default();
    let start = Instant::now();
    for index in 0..points {
        let noise = (index.wrapping_mul(2_654_435_761) % 1000) as f64 / 1000.0;
        series.push(index as f64 * 0.001, (index as f64 * 1e-4).sin() + noise);
    }
    let appended = start.elapsed().as_nanos() as f64 / points as f64;
    line("plot, append a point (ns)", format!("{appended:.1}"));
    let end = points as f64 * 0.001;
    for (what, from, to) in [("whole", 0.0, end), ("a third", end / 3.0, end * 2.0 / 3.0)] {
        let times = (0..rounds * 4).map(|round| {
            let start = Instant::now();
            black_box(series.query(from + round as f64 * 0.01..to, PIXELS));
            start.elapsed().as_secs_f64() * 1e3
        });
        line(&format!("plot, {what} (ms)"), format!("{}; {points} points, target 4 ms", Spread::of(times)));
    }
}

fn compare(what: &str, ours: &Spread, numpy: Option<Spread>) {
    line(&format!("{what} (GB/s)"), ours);
    if let Some(numpy) = numpy {
        let ratio = ours.median() / numpy.median();
        line("  NumPy (GB/s)", format!("{numpy}; {ratio:.1} × as fast, target 10 ×"));
    }
}

fn rate(bytes: &[u8], rounds: usize, mut run: impl FnMut(&[u8]) -> usize) -> Spread {
    run(bytes);
    Spread::of((0..rounds).map(|_| {
        let start = Instant::now();
        black_box(run(black_box(bytes)));
        gigabytes(bytes.len(), start.elapsed())
    }))
}

fn gigabytes(bytes: usize, time: Duration) -> f64 {
    bytes as f64 / time.as_secs_f64() / 1e9
}

/// Into columns whose memory is used again, as the recorder does it.
fn motion_columns(columns: &mut MotionColumns, bytes: &[u8], read: usize) -> usize {
    columns.clear();
    for read in bytes.chunks(read.min(MAX_READ_BYTES / BLOCK_BYTES * BLOCK_BYTES)) {
        columns.extend(MotionRead::decode(read).expect("blocks"));
    }
    columns.rows()
}

fn force_columns(columns: &mut ForceColumns, bytes: &[u8], read: usize) -> usize {
    columns.clear();
    let record = ForceDataType::All.record_bytes();
    for read in bytes.chunks(read.min(MAX_READ_BYTES / record * record)) {
        columns.extend(data(read));
    }
    columns.rows()
}

fn data(bytes: &[u8]) -> DataRecords<'_> {
    match ForceRead::decode(bytes).expect("records") {
        ForceRead::Data(records) => records,
        ForceRead::Header { .. } | ForceRead::Footer(_) => unreachable!("only data was made"),
    }
}

/// Every field of every block, added up.
fn walk_motion(bytes: &[u8]) -> usize {
    let mut sum = 0_u64;
    for block in bytes.as_chunks().0.iter().map(BlockView::new) {
        for axis in 0..AXES {
            for sample in 0..SAMPLES {
                let encoder = block.encoder(axis, sample);
                let position = encoder.position().cast_unsigned();
                let small = u64::from(encoder.timer()) ^ encoder.temperature().cast_unsigned() as u64;
                let drive = block.drive_command(axis, sample);
                let currents = drive.d_current() as u64 ^ drive.q_current() as u64;
                let rest = u64::from(drive.electrical_angle()) ^ drive.velocity() as u64;
                sum ^= encoder.timestamp().0 ^ position ^ small ^ drive.timestamp().0 ^ currents ^ rest;
            }
        }
        for sample in 0..SAMPLES {
            let (fast, standard) = (block.real_time_io(sample), block.standard_io(sample));
            sum ^= fast.timestamp().0 ^ u64::from(fast.inputs()) ^ u64::from(fast.outputs());
            sum ^= standard.timestamp().0 ^ u64::from(standard.inputs()) ^ u64::from(standard.outputs());
        }
        let (sensor, pulses, tcp) = (block.force_sensor(), block.pulse_counters(), block.tcp());
        let (axes, elements) = (sensor.axes(), sensor.elements());
        sum ^= sensor.timestamp().0 ^ pulses.timestamp().0 ^ tcp.timestamp().0;
        for value in axes.force.iter().chain(&axes.moment).chain(elements.outputs.as_flattened()) {
            sum ^= *value as u64;
        }
        sum ^= axes.temperature as u64 ^ elements.temperature as u64;
        sum ^= u64::from(pulses.first() ^ pulses.first_latched() ^ pulses.second() ^ pulses.second_latched());
        sum ^= tcp.components().iter().fold(0, |sum, value| sum ^ value.to_bits());
    }
    sum as usize
}

/// Every field of every record, added up.
fn walk_force(bytes: &[u8]) -> usize {
    let DataRecords::All(records) = data(bytes) else { unreachable!("DataType 0 was made") };
    let mut sum = 0_u64;
    let bits = |values: &[f32]| values.iter().fold(0, |sum, value| sum ^ u64::from(value.to_bits()));
    for record in records.iter().map(AllView::new) {
        let (head, forces, speed, time) = (record.head(), record.forces(), record.speed(), record.time());
        sum ^= u64::from(head.count) ^ u64::from(head.elapsed) ^ u64::from(head.id) ^ u64::from(head.channel);
        sum ^= bits(&forces.force) ^ bits(&forces.torque) ^ bits(&[forces.force_magnitude, forces.torque_magnitude]);
        sum ^= bits(&record.position()) ^ bits(&record.reference()) ^ bits(&record.correction());
        sum ^= bits(&[speed.speed]) ^ bits(&speed.components) ^ bits(&record.joints());
        sum ^= record.overload().iter().fold(0, |sum, value| sum ^ u64::from(*value));
        sum ^= u64::from(record.step_id()) ^ u64::from(record.force_control()) ^ record.monitor_no() as u64;
        sum ^= time.year as u64 ^ u64::from(time.month ^ time.day ^ time.hour ^ time.minute ^ time.second);
        sum ^= time.millisecond as u64 ^ u64::from(record.sequence_no() ^ record.object_no());
    }
    sum as usize
}

fn motion_log(blocks: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut block = MotionBlock::default();
    for number in 0..blocks {
        for sample in 0..SAMPLES {
            let timestamp = Ticks(((number * SAMPLES + sample + 1) * 80_000) as u64);
            for axis in 0..AXES {
                let encoder = &mut block.encoders[axis][sample];
                encoder.timestamp = timestamp;
                encoder.position = (number * 131 + axis * 17 + sample) as i64;
                encoder.timer = number as u32;
                encoder.temperature = 35;
                let drive = &mut block.drive_commands[axis][sample];
                drive.timestamp = timestamp;
                drive.q_current = (number % 1000) as i16;
                drive.velocity = sample as i16;
            }
            block.real_time_io[sample].timestamp = timestamp;
            block.standard_io[sample].timestamp = timestamp;
            block.standard_io[sample].inputs = number as u32;
        }
        block.force_sensor.axes.force = [number as i32 % 1000, -7, 9];
        block.tcp.components[0] = number as f64 * 0.25;
        block.encode_into(&mut bytes);
    }
    bytes
}

fn force_records(records: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    for number in 0..records {
        let head =
            DataHead { version: 2, id: 7, count: number as u32, elapsed: 2 * number as u32, ..DataHead::default() };
        let time = ControllerTime { year: 2026, month: 6, day: 1, hour: 8, minute: 30, second: 0, millisecond: 250 };
        let position = [number as f32; 6];
        let record = AllData { head, position, reference: position, time, ..AllData::default() };
        record.reduced(ForceDataType::All).encode_into(&mut bytes);
    }
    bytes
}

/// A Python with NumPy.
struct Numpy(String);

impl Numpy {
    fn find() -> Option<Self> {
        let python = std::env::var("RECORDS_PYTHON").unwrap_or_else(|_| "python3".into());
        let found = Command::new(&python).args(["-c", "import numpy"]).stderr(Stdio::null()).status().ok()?;
        found.success().then_some(Self(python))
    }

    /// The rate of each round. `read`: bytes of one read.
    fn rate(&self, kind: &str, bytes: &[u8], read: usize, rounds: usize) -> Option<Spread> {
        let mut command = Command::new(&self.0);
        command.args(["-c", include_str!("records.py"), kind, &read.to_string(), &rounds.to_string()]);
        let mut python = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().ok()?;
        python.stdin.take()?.write_all(bytes).ok()?;
        let output = python.wait_with_output().ok()?;
        let seconds = String::from_utf8(output.stdout).ok()?;
        let seconds: Vec<f64> = seconds.split_whitespace().filter_map(|time| time.parse().ok()).collect();
        Some(Spread::of(seconds.into_iter().map(|time| bytes.len() as f64 / time / 1e9)))
    }
}
