//! The records of force sensor and motion log at one moment, as typed packets.

use super::dynamics::JointState;
use super::force::{Wrench, tool_motion, wrench};
use super::force_channel::Recording;
use super::io_history::IoHistory;
use super::kinematics::forward;
use super::motion_channel::MotionChannel;
use super::robot::Robot;
use super::time::CellTime;
use crate::records::force::{AllData, DataHead, Forces, TcpSpeed};
use crate::records::motion::{
    DriveCommand, Elements, Encoder, ForceSensor, MotionBlock, PulseCounters, RealTimeIo, SAMPLES, SixAxes, StandardIo,
    TcpPosition,
};
use crate::records::{ControllerTime, Ticks};

/// The data record with this number, with every group of values.
pub(super) fn force_data(
    robot: &Robot,
    recording: &Recording,
    number: u64,
    clock: impl Fn(CellTime) -> ControllerTime,
    seed: u64,
) -> AllData {
    let time = recording.moment(number);
    let header = &recording.header.header;
    let JointState { position: joints, .. } = robot.command(time);
    let (tool, velocity) = tool_motion(robot, time);
    let felt = wrench(robot, time, seed);
    let Wrench { force, torque, correction } = felt;
    let pose = tool.pose().to_array();
    let mut reference = pose;
    for (reference, correction) in reference.iter_mut().zip(correction) {
        *reference -= correction;
    }
    let length = |[x, y, z]: [f64; 3]| (x * x + y * y + z * z).sqrt() as f32;
    let overload = robot.settled(time).overload_rates();
    AllData {
        head: DataHead {
            version: header.version,
            id: header.id,
            data_type: recording.data_type.number(),
            packet_version: header.packet_version,
            packet_type: header.packet_type,
            channel: header.channel,
            mode: header.mode,
            // Recordings of ten minutes at 2 ms have 300,000 records.
            count: number as u32,
            elapsed: (time.nanos_since(recording.start) / 1_000_000) as u32,
        },
        forces: Forces {
            force: single(force),
            torque: single(torque),
            force_magnitude: length(force),
            torque_magnitude: length(torque),
        },
        position: single(pose),
        reference: single(reference),
        correction: single(correction),
        speed: TcpSpeed { speed: length(velocity), components: single(velocity) },
        joints: single(joints),
        overload: overload.map(|rate| (rate * 100.0).round() as u8),
        force_control: felt.controls().into(),
        step_id: robot.state_at(time).step_id,
        time: clock(time),
        sequence_no: 0,
        object_no: 0,
        monitor_no: header.monitor_no,
    }
}

fn single<const N: usize>(values: [f64; N]) -> [f32; N] {
    values.map(|value| value as f32)
}

/// Units of IQREF: hundredths of a per cent of the rated current.
const CURRENT_UNITS_A_PERCENT: f64 = 100.0;
/// Pulses of one turn of a motor, and its pole pairs.
const PULSES_A_TURN: i64 = 131_072;
const POLE_PAIRS: i64 = 4;
/// Pulses a second of the conveyor's encoder, at pulse counter 1.
const CONVEYOR_PULSES: u64 = 2000;
/// The force sensor counts grams of force, and gram-centimetres of torque.
const GRAMS_A_NEWTON: f64 = 1000.0 / 9.80665;
const GRAM_CENTIMETRES_A_NEWTON_METRE: f64 = 100_000.0 / 9.80665;
/// The standard R-I/O in the low bits of RT-I/O: inputs and outputs from these bits of the standard I/O on.
const REAL_TIME_INPUTS: u32 = 8;
const REAL_TIME_OUTPUTS: u32 = 9;

/// The block with this number, of robot 1.
pub(super) fn motion_block(
    robot: &Robot,
    home_offsets: &[i64; 6],
    channel: &MotionChannel,
    number: u64,
    io: &IoHistory,
    seed: u64,
) -> MotionBlock {
    let mut block = MotionBlock::default();
    let axes = robot.model().axes();
    let temperatures = robot.settled(channel.moment(number, 0)).temperature;
    for sample in 0..SAMPLES {
        let time = channel.moment(number, sample as u64);
        let timestamp = Ticks(time.ticks());
        let actual = robot.actual(time);
        let torques = robot.torques(time);
        for (joint, axis) in axes.iter().enumerate() {
            let pulses = (actual.position[joint] * axis.pulses_per_unit).round() as i64;
            block.encoders[joint][sample] = Encoder {
                timestamp,
                position: pulses + home_offsets[joint],
                // A counter that starts again at 2³².
                timer: time.ticks() as u32,
                temperature: temperatures[joint].round() as i8,
            };
            let turns_a_minute = actual.speed[joint] * axis.pulses_per_unit / PULSES_A_TURN as f64 * 60.0;
            block.drive_commands[joint][sample] = DriveCommand {
                timestamp,
                d_current: 0,
                q_current: (torques[joint] * CURRENT_UNITS_A_PERCENT).round() as i16,
                electrical_angle: ((pulses * POLE_PAIRS).rem_euclid(PULSES_A_TURN) * 65_536 / PULSES_A_TURN) as u16,
                velocity: turns_a_minute.round() as i16,
            };
        }
        let signals = io.at(time);
        block.real_time_io[sample] = RealTimeIo {
            timestamp,
            inputs: (signals.inputs >> REAL_TIME_INPUTS & 0xF) as u8,
            outputs: (signals.outputs >> REAL_TIME_OUTPUTS & 0xF) as u8,
        };
        block.standard_io[sample] = StandardIo { timestamp, inputs: signals.inputs, outputs: signals.outputs };
    }
    let time = channel.moment(number, SAMPLES as u64 - 1);
    let timestamp = Ticks(time.ticks());
    let pulses = |time: CellTime| (u128::from(time.nanos()) * u128::from(CONVEYOR_PULSES) / 1_000_000_000) as u32;
    block.force_sensor = force_sensor(&wrench(robot, time, seed), timestamp, temperatures[0]);
    block.pulse_counters = PulseCounters {
        timestamp,
        first: pulses(time),
        first_latched: pulses(io.at(time).from),
        second: 0,
        second_latched: 0,
    };
    let mut components = [0.0; 9];
    components[..6].copy_from_slice(&forward(robot.model(), &robot.actual(time).position).to_array());
    block.tcp = TcpPosition { timestamp, components };
    block
}

fn force_sensor(felt: &Wrench, timestamp: Ticks, temperature: f64) -> ForceSensor {
    let count = |value: f64| (value.round() as i32).clamp(-131_072, 131_071);
    let force = felt.force.map(|newton| count(newton * GRAMS_A_NEWTON));
    let moment = felt.torque.map(|torque| count(torque * GRAM_CENTIMETRES_A_NEWTON_METRE));
    let temperature = temperature.round() as i16;
    // Each element carries a quarter of the force; a moment about Z loads opposite elements with opposite sign.
    let element = |sign: i32| [force[0] / 4 + sign * moment[2] / 4, force[1] / 4 - sign * moment[2] / 4, 0, 0];
    ForceSensor {
        timestamp,
        axes: SixAxes { force, moment, temperature },
        elements: Elements { outputs: [element(1), element(-1), element(1), element(-1)], temperature },
    }
}
