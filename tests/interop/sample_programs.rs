//! The manual's two sample programs (4.1.2.3, 4.3.2), run by asyncua, save value by value what the simulated cell recorded.

use std::fs;
use std::time::Duration;

use opcua_configurator::records::force::{AllData, ForceData, ForceFooter, ForceHeader};
use opcua_configurator::records::motion::MotionBlock;
use opcua_configurator::records::{ControllerTime, Label};
use opcua_configurator::virtual_controller::cell::{CellCommand, CellRecord, ForceRecording, RecordedPacket};
use serde_json::{Value, json};
use tokio::task::block_in_place;

use super::open_server::OpenServer;
use super::peers::Python;
use crate::common::process::Running;

const WAIT: Duration = Duration::from_secs(90);

#[tokio::test(flavor = "multi_thread")]
async fn the_force_sensor_program_saves_every_value_of_a_recording() {
    let Some(python) = Python::find() else { return };
    let server = OpenServer::start().await;
    let cell = server.cell();
    let saved = run(&server, &python, &["force"], &[], || {
        let recording = ForceRecording { robot: 1, duration: 2.0, interval: 0.002 };
        cell.command(CellCommand::RecordStart(recording)).expect("RecordStart");
    });
    let recorded = rows(&cell.record().expect("a record"));
    assert!(recorded.len() > 500, "{} records", recorded.len());
    assert_same(&saved, &recorded);
}

#[tokio::test(flavor = "multi_thread")]
async fn the_motion_log_program_saves_every_value_of_the_blocks_it_reads() {
    let Some(python) = Python::find() else { return };
    let server = OpenServer::start().await;
    let saved = run(&server, &python, &["motion"], &["40"], || {});
    let recorded = rows(&server.cell().record().expect("a record"));
    assert!(recorded.len() > 40, "{} blocks", recorded.len());
    assert_same(&saved, &recorded);
}

pub fn assert_same(saved: &[String], recorded: &[Vec<Value>]) {
    assert_eq!(saved.len(), recorded.len());
    for (at, (line, recorded)) in saved.iter().zip(recorded).enumerate() {
        let saved: Vec<&str> = line.split(',').collect();
        assert_eq!(saved.len(), recorded.len(), "record {at}");
        for (field, (saved, recorded)) in saved.into_iter().zip(recorded).enumerate() {
            let is_same = match recorded {
                Value::Number(number) if number.is_f64() => saved.parse() == Ok(number.as_f64().unwrap_or_default()),
                Value::String(text) => saved == text,
                number => *saved == *number.to_string(),
            };
            assert!(is_same, "record {at}, value {field}: saved {saved}, recorded {recorded}");
        }
    }
}

/// Runs a program to its end, `begin` once it is ready, and gives the records it saved.
fn run(server: &OpenServer, python: &Python, program: &[&str], more: &[&str], begin: impl FnOnce()) -> Vec<String> {
    let output = server.folder.path().join("saved.csv");
    let mut command = python.script("sample_programs.py");
    command.args(program).arg(server.fleet.controller(0).endpoint()).arg(&output).args(more);
    block_in_place(|| {
        let mut running = Running::start(&mut command).expect("the peer was found");
        assert_eq!(running.next_line(WAIT).trim_end(), "ready");
        begin();
        let finished = running.finish(WAIT);
        assert_eq!(finished.code, Some(0), "{}\n{}", finished.stdout, finished.stderr);
    });
    let saved = fs::read_to_string(output).expect("what the program saved");
    saved.lines().map(str::to_owned).collect()
}

/// The numbers of each record in the order of the manual's tables, as the programs save them.
fn rows(record: &CellRecord) -> Vec<Vec<Value>> {
    record
        .packets()
        .map(|packet| match packet {
            RecordedPacket::ForceHeader(1, header) => header_row(header),
            RecordedPacket::ForceData(1, data) => match &**data {
                ForceData::All(data) => data_row(data),
                other => panic!("a record of the data type {:?}", other.data_type()),
            },
            RecordedPacket::ForceFooter(1, footer) => footer_row(footer),
            RecordedPacket::MotionBlock(block) => block_row(block),
            other => panic!("a packet of another monitor: {other:?}"),
        })
        .collect()
}

/// The values of expressions, each a number or an array of numbers.
macro_rules! values {
    ($($value:expr),* $(,)?) => {{
        let mut row: Vec<Value> = Vec::new();
        $(match json!($value) {
            Value::Array(values) => row.extend(values),
            value => row.push(value),
        })*
        row
    }};
}

fn header_row(packet: &ForceHeader) -> Vec<Value> {
    let h = &packet.header;
    values![
        1,
        h.version,
        h.id,
        h.packet_version,
        h.packet_type,
        h.channel,
        h.mode,
        time(h.start),
        real(h.duration),
        real(h.interval),
        h.robot_no,
        text(&h.robot_name),
        h.sensor_no,
        text(&h.sensor_serial),
        text(&h.sensor_label),
        h.monitor_no,
        text(&h.monitor_label),
        h.coordinate_no,
        text(&h.coordinate_label),
        text(&h.file_name),
        h.sequence_no,
        text(&h.sequence_name),
        text(&h.force_name),
        h.robot_local,
        packet.record_start.expect("a header of version 2").0,
    ]
}

fn data_row(d: &AllData) -> Vec<Value> {
    values![
        2,
        d.head.version,
        d.head.id,
        d.head.data_type,
        d.head.packet_version,
        d.head.packet_type,
        d.head.channel,
        d.head.mode,
        d.head.count,
        d.head.elapsed,
        sample_row(d),
    ]
}

/// What was measured, without the number of the record.
pub fn sample_row(d: &AllData) -> Vec<Value> {
    values![
        d.forces.force.map(real),
        d.forces.torque.map(real),
        real(d.forces.force_magnitude),
        real(d.forces.torque_magnitude),
        d.position.map(real),
        d.reference.map(real),
        d.correction.map(real),
        real(d.speed.speed),
        d.speed.components.map(real),
        d.joints.map(real),
        d.overload,
        d.force_control,
        d.step_id,
        time(d.time),
        d.sequence_no,
        d.object_no,
        d.monitor_no,
    ]
}

fn footer_row(f: &ForceFooter) -> Vec<Value> {
    values![
        4,
        f.version,
        f.id,
        f.packet_version,
        f.packet_type,
        f.channel,
        f.mode,
        time(f.end),
        real(f.duration),
        real(f.interval),
        f.robot_no,
        text(&f.robot_name),
        f.sensor_no,
        text(&f.sensor_serial),
        text(&f.sensor_label),
        f.monitor_no,
        text(&f.monitor_label),
        f.coordinate_no,
        text(&f.coordinate_label),
        f.end_condition.number(),
        f.error_no,
        f.sequence_no,
    ]
}

pub fn block_row(block: &MotionBlock) -> Vec<Value> {
    let mut row = Vec::new();
    for sample in block.encoders.iter().flatten() {
        row.extend(values![sample.timestamp.0, sample.position, sample.timer, sample.temperature]);
    }
    for sample in block.drive_commands.iter().flatten() {
        let (d, q) = (sample.d_current, sample.q_current);
        row.extend(values![sample.timestamp.0, d, q, sample.electrical_angle, sample.velocity]);
    }
    for sample in &block.real_time_io {
        row.extend(values![sample.timestamp.0, sample.inputs, sample.outputs]);
    }
    for sample in &block.standard_io {
        row.extend(values![sample.timestamp.0, sample.inputs, sample.outputs]);
    }
    let (sensor, pulses) = (&block.force_sensor, &block.pulse_counters);
    row.extend(values![sensor.timestamp.0, sensor.axes.force, sensor.axes.moment, sensor.axes.temperature]);
    row.extend(values![sensor.elements.outputs.concat(), sensor.elements.temperature]);
    row.extend(values![pulses.timestamp.0, pulses.first, pulses.first_latched, pulses.second, pulses.second_latched]);
    row.extend(values![block.tcp.timestamp.0, block.tcp.components]);
    row
}

fn time(time: ControllerTime) -> [i16; 7] {
    let ControllerTime { year, month, day, hour, minute, second, millisecond } = time;
    [year, month.into(), day.into(), hour.into(), minute.into(), second.into(), millisecond]
}

/// A value of single precision as the exact number that it is.
fn real(value: f32) -> f64 {
    value.into()
}

fn text<const N: usize>(label: &Label<N>) -> String {
    hex::encode(&label.bytes[..usize::from(label.length)])
}
