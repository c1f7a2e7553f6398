use super::super::kinematics::{Joints, forward};
use super::super::robot::MAX_SEGMENTS;
use super::*;
use crate::records::Ticks;
use crate::records::force::{EndCondition, ForceData, ForceDataType, ForceRead};
use crate::records::motion::{BLOCK_BYTES, BlockView, MotionRead, SAMPLES};

/// A client of the program's recordings.
fn recording_cell(data_type: u16) -> Cell {
    let mut cell = cell(&[RobotModel::C4A601S]);
    for setting in [Setting::ForceDataType(data_type), Setting::ForceDataNum(100), Setting::ForcePort(true)] {
        cell.write(setting).unwrap();
    }
    cell.keep_record(1_000_000);
    cell
}

fn force_status(cell: &mut Cell, monitor: usize) -> ChannelValues {
    cell.snapshot().force_sensor.monitors[monitor]
}

/// Decodes a read as a client does, into what the cell's own record should hold.
fn decoded(monitor: u8, bytes: &[u8]) -> Vec<RecordedPacket> {
    let read = ForceRead::decode(bytes).unwrap();
    if let Some(header) = read.to_header() {
        return vec![RecordedPacket::ForceHeader(monitor, Box::new(header))];
    }
    if let Some(footer) = read.to_footer() {
        return vec![RecordedPacket::ForceFooter(monitor, Box::new(footer))];
    }
    let ForceRead::Data(records) = read else { panic!("{read:?}") };
    let packet = |at| RecordedPacket::ForceData(monitor, Box::new(records.get(at).unwrap()));
    (0..records.len()).map(packet).collect()
}

/// The manual's procedure (4.1.2.3): wait for Run, then read whenever data is there, until the footer.
fn follow(cell: &mut Cell, pace: u64) -> Vec<RecordedPacket> {
    until(cell, |s| s.force_sensor.monitors[0].recording == RecordingStatus::Run);
    let mut packets = Vec::new();
    loop {
        if force_status(cell, 0).data == DataStatus::Ready {
            let bytes = cell.read_force_data(1, 1 << 20).unwrap();
            packets.extend(decoded(1, &bytes));
            if bytes[0] == 4 {
                return packets;
            }
        } else {
            pass(cell, pace);
        }
    }
}

#[test]
fn the_procedure_of_the_manual_saves_what_the_cell_has_recorded() {
    for data_type in 0..=3 {
        let mut cell = recording_cell(data_type);
        for id in 1..=3 {
            let packets = follow(&mut cell, 100);
            let RecordedPacket::ForceHeader(1, header) = &packets[0] else { panic!("{:?}", packets[0]) };
            assert_eq!((header.header.id, header.header.version), (id, 2));
            assert_eq!(header.header.robot_name.to_string(), "Robot1");
            let Some(RecordedPacket::ForceFooter(1, footer)) = packets.last() else { panic!("{:?}", packets.last()) };
            assert_eq!((footer.id, footer.end_condition, footer.error_no), (id, EndCondition::RecordEnd, 0));
            let data: Vec<ForceData> = packets
                .iter()
                .filter_map(|packet| if let RecordedPacket::ForceData(1, data) = packet { Some(**data) } else { None })
                .collect();
            assert_eq!(data.len(), packets.len() - 2);
            assert_eq!(data.len(), (footer.duration / 0.004).ceil() as usize);
            for (number, record) in data.iter().enumerate() {
                assert_eq!(record.data_type(), ForceDataType::from_number(data_type).unwrap());
                let head = record.head();
                assert_eq!((head.id, head.count, head.elapsed), (id, number as u32, number as u32 * 4));
            }
            assert_eq!(force_status(&mut cell, 0), ChannelValues::default());
        }
        let recorded: Vec<_> = cell.record().unwrap().packets().cloned().collect();
        assert!(recorded.len() > 1000);
        let mut again = recording_cell(data_type);
        let all: Vec<_> = (0..3).flat_map(|_| follow(&mut again, 37)).collect();
        assert!(all == recorded, "read at another pace, the same values");
    }
}

#[test]
fn the_force_rises_while_the_part_is_pressed_in() {
    let mut cell = recording_cell(0);
    let packets = follow(&mut cell, 50);
    let data = packets.iter().filter_map(|packet| match packet {
        RecordedPacket::ForceData(_, data) => match **data {
            ForceData::All(all) => Some(all),
            _ => None,
        },
        _ => None,
    });
    let data: Vec<_> = data.collect();
    let mut pressed = 0;
    for record in &data {
        let joints: Joints = record.joints.map(f64::from);
        let pose = forward(RobotModel::C4A601S, &joints);
        assert!((pose.z as f32 - record.position[2]).abs() < 0.01 && (pose.x as f32 - record.position[0]).abs() < 0.01);
        let sum = record.forces.force.iter().map(|force| force * force).sum::<f32>().sqrt();
        assert!((sum - record.forces.force_magnitude).abs() < 1e-3);
        assert!((record.position[2] - record.reference[2] - record.correction[2]).abs() < 1e-3);
        pressed += usize::from(record.force_control == 1);
    }
    assert!(pressed > 50 && pressed < data.len() - 50, "{pressed} of {}", data.len());
    let weakest = data.iter().map(|record| record.forces.force[2]).fold(f32::MAX, f32::min);
    assert!(weakest < -10.0, "pressed against the sensor's axis: {weakest}");
    assert_eq!(data.iter().map(|record| record.step_id).max(), Some(2));
}

#[test]
fn without_port_the_monitors_show_nothing() {
    let mut cell = cell(&[RobotModel::C4A601S]);
    for _ in 0..600 {
        assert_eq!(pass(&mut cell, 100).force_sensor.monitors, [ChannelValues::default(); 2]);
    }
    assert_eq!(cell.read_force_data(1, 1000), None);
    assert_eq!(cell.read_force_data(3, 1000), None);
}

#[test]
fn a_second_recording_at_once_goes_to_the_second_monitor() {
    let mut cell = cell(&BOTH);
    cell.command(CellCommand::EmergencyStop(true)).unwrap();
    cell.write(Setting::ForcePort(true)).unwrap();
    let start = |robot| CellCommand::RecordStart(ForceRecording { robot, duration: 1.0, interval: 0.01 });
    cell.command(start(2)).unwrap();
    pass(&mut cell, 100);
    cell.command(start(1)).unwrap();
    assert_eq!(cell.command(start(1)), Err(CommandRefusal::NoMonitor));
    assert_eq!(cell.command(start(3)), Err(CommandRefusal::UnknownRobot));
    let wrong = ForceRecording { robot: 1, duration: 1.0, interval: 0.001 };
    assert_eq!(cell.command(CellCommand::RecordStart(wrong)), Err(CommandRefusal::OutOfRange));
    cell.command(CellCommand::RecordEnd(2)).unwrap();
    assert_eq!(cell.command(CellCommand::RecordEnd(3)), Err(CommandRefusal::NoMonitor));
    pass(&mut cell, 2_000);
    for (monitor, id, robot, end) in [(1, 1, 2, EndCondition::DurationElapsed), (2, 2, 1, EndCondition::RecordEnd)] {
        let mut packets = Vec::new();
        while let Some(bytes) = cell.read_force_data(monitor, 5000) {
            packets.extend(decoded(monitor, &bytes));
        }
        let RecordedPacket::ForceHeader(_, header) = &packets[0] else { panic!() };
        assert_eq!((header.header.id, header.header.robot_no, header.header.channel), (id, robot, monitor));
        let Some(RecordedPacket::ForceFooter(_, footer)) = packets.last() else { panic!() };
        assert_eq!((footer.id, footer.end_condition), (id, end));
        assert_eq!(packets.len(), if monitor == 1 { 102 } else { 2 });
    }
}

#[test]
fn an_error_of_the_controller_and_a_broken_cable_are_errors_of_the_recording() {
    let mut cell = recording_cell(3);
    until(&mut cell, |s| s.force_sensor.monitors[0].recording == RecordingStatus::Run);
    pass(&mut cell, 500);
    cell.command(CellCommand::RaiseError(5040)).unwrap();
    let failed = ChannelValues { recording: RecordingStatus::Stop, data: DataStatus::Ready, error: QueueStatus::Error };
    assert_eq!(force_status(&mut cell, 0), failed);
    let packets = std::iter::from_fn(|| cell.read_force_data(1, 1 << 20)).collect::<Vec<_>>();
    let RecordedPacket::ForceFooter(_, footer) = &decoded(1, packets.last().unwrap())[0] else { panic!() };
    assert_eq!((footer.end_condition, footer.error_no), (EndCondition::Error, 5040));
    cell.command(CellCommand::Reset).unwrap();
    cell.command(CellCommand::RecordStart(ForceRecording { robot: 1, duration: 5.0, interval: 0.1 })).unwrap();
    assert_eq!(force_status(&mut cell, 0).error, QueueStatus::None);
    cell.command(CellCommand::BreakForceRecording(1)).unwrap();
    let broken = ChannelValues { error: QueueStatus::Error, ..ChannelValues::default() };
    assert_eq!(force_status(&mut cell, 0), broken);
}

fn blocks(bytes: &[u8]) -> Vec<BlockView<'_>> {
    MotionRead::decode(bytes).unwrap().blocks().collect()
}

#[test]
fn the_motion_log_agrees_with_the_nodes() {
    let mut cell = cell(&[RobotModel::Gx4A251S]);
    cell.write(Setting::MotionDataNum(0)).unwrap();
    let mut seen = std::collections::BTreeMap::new();
    let mut compared = 0;
    for _ in 0..12_000 {
        let now = pass(&mut cell, 1);
        seen.insert(Ticks(now.time.ticks()), now);
        while let Some(bytes) = cell.read_motion_log(usize::MAX) {
            for block in blocks(&bytes) {
                for sample in 0..SAMPLES {
                    let Some(shown) = seen.get(&block.encoder(0, sample).timestamp()) else { continue };
                    compared += 1;
                    for (joint, axis) in shown.robots[0].axes.iter().enumerate() {
                        let pulses = block.encoder(joint, sample).position() - axis.home_offset;
                        let limits = RobotModel::Gx4A251S.axes()[joint];
                        assert!((pulses as f64 / limits.pulses_per_unit - axis.position).abs() < 1e-9);
                        let current = f64::from(block.drive_command(joint, sample).q_current()) / 100.0;
                        assert!((current - axis.torque).abs() < 0.01, "{current} and {}", axis.torque);
                    }
                    assert!(!block.encoder(4, sample).timestamp().is_some(), "a SCARA has no fifth axis");
                    let word = |port| u32::from(shown.io.word(port, 0)) | u32::from(shown.io.byte(port, 2)) << 16;
                    assert_eq!(block.standard_io(sample).inputs(), word(0));
                    assert_eq!(block.standard_io(sample).outputs(), word(1));
                }
                if let Some(shown) = seen.get(&block.tcp().timestamp()) {
                    let [x, y, z, u, v, w, ..] = block.tcp().components();
                    assert_eq!([x, y, z, u, v, w], shown.robots[0].actual.to_array());
                }
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

#[test]
fn motion_log_settings_take_effect_and_keep_the_blocks_contiguous() {
    let mut cell = cell(&[RobotModel::C4A601S]);
    pass(&mut cell, 10_000);
    for interval in 0..=4_u16 {
        cell.write(Setting::MotionSamplingInterval(interval)).unwrap();
        cell.write(Setting::MotionDataNum(3)).unwrap();
        assert_eq!(cell.snapshot().motion_log.channel.data, DataStatus::Empty);
        let mut last: Option<Ticks> = None;
        let mut count = 0;
        for _ in 0..200 {
            let status = pass(&mut cell, 10).motion_log;
            assert_eq!((status.sampling_interval, status.channel.error), (interval, QueueStatus::None));
            while let Some(bytes) = cell.read_motion_log(usize::MAX) {
                assert!(bytes.len() <= 3 * BLOCK_BYTES);
                for block in blocks(&bytes) {
                    for sample in 0..SAMPLES {
                        let ticks = block.encoder(0, sample).timestamp();
                        assert!(last.is_none_or(|last| ticks.0 - last.0 == 40_000 << interval));
                        last = Some(ticks);
                        count += 1;
                    }
                }
            }
        }
        assert!(count >= 4000 >> interval & !7, "{count}");
    }
}

#[test]
fn motion_logging_is_switched_off_and_on_and_broken_off() {
    let mut cell = cell(&[RobotModel::C4A601S]);
    pass(&mut cell, 1000);
    cell.command(CellCommand::MotionLogging(false)).unwrap();
    let channel = |cell: &mut Cell| cell.snapshot().motion_log.channel;
    assert_eq!(channel(&mut cell).recording, RecordingStatus::Stop);
    while cell.read_motion_log(usize::MAX).is_some() {}
    pass(&mut cell, 1000);
    assert_eq!(channel(&mut cell), ChannelValues::default());
    cell.command(CellCommand::MotionLogging(true)).unwrap();
    assert_eq!(pass(&mut cell, 4).motion_log.channel.data, DataStatus::Ready);
    cell.command(CellCommand::BreakMotionLogging).unwrap();
    let broken = ChannelValues { error: QueueStatus::Error, ..ChannelValues::default() };
    assert_eq!(channel(&mut cell), broken);
    cell.command(CellCommand::MotionLogging(true)).unwrap();
    assert_eq!(channel(&mut cell).error, QueueStatus::None);
}

/// What the cell holds of the past.
fn held(cell: &Cell) -> usize {
    cell.robots.iter().map(|unit| unit.robot.held()).sum()
}

/// A day of production: a reader keeps up for a while in every hour, in every fourth at the full rate, is late by a single
/// block in every second hour, and is away in between.
#[test]
fn a_day_passes_in_bounded_memory_without_a_loss_for_a_reader_that_keeps_up() {
    let mut cell = cell(&BOTH);
    cell.write(Setting::ForcePort(true)).unwrap();
    let mut most = 0;
    let (mut read, mut warnings) = (0_usize, 0);
    for hour in 0..24_u64 {
        let interval = if hour % 4 == 1 { 0 } else { 4 };
        let block_millis = 4_u64 << interval;
        cell.write(Setting::MotionSamplingInterval(interval)).unwrap();
        let mut last: Option<Ticks> = None;
        let mut look = |cell: &mut Cell, gap: bool| {
            let mut first = true;
            while let Some(bytes) = cell.read_motion_log(1 << 20) {
                for block in blocks(&bytes) {
                    let ticks = block.encoder(0, 0).timestamp();
                    let step = last.map(|last| (ticks.0 - last.0) / ((40_000 * 8) << interval));
                    assert_eq!(step.is_some_and(|step| step > 1), gap && first, "{step:?}");
                    (first, last) = (false, Some(ticks));
                    read += 1;
                }
            }
        };
        for _ in 0..40 {
            let now = pass(&mut cell, 500).motion_log.channel;
            assert_eq!(now.error, QueueStatus::None);
            look(&mut cell, false);
            most = most.max(held(&cell));
        }
        if hour % 2 == 1 {
            // 500 blocks are kept.
            let full = pass(&mut cell, 500 * block_millis).motion_log.channel;
            assert_eq!((full.error, full.data), (QueueStatus::None, DataStatus::Ready));
            let late = pass(&mut cell, block_millis).motion_log.channel;
            assert_eq!((late.error, late.data), (QueueStatus::Warning, DataStatus::Ready));
            warnings += 1;
            look(&mut cell, true);
            assert_eq!(pass(&mut cell, 500).motion_log.channel.error, QueueStatus::None);
            look(&mut cell, false);
        }
        let next = CellTime::from_secs((hour + 1) * 3600);
        while cell.now() < next {
            let step = cell.now().plus_nanos(60_000_000_000).min(next);
            cell.advance_to(step);
            most = most.max(held(&cell));
        }
    }
    assert_eq!(warnings, 12);
    assert!(read > 18 * 300 + 6 * 5000, "{read}");
    assert!(most < MAX_SEGMENTS, "{most} segments");
    let SpelValue::UInt32(made) = cell.snapshot().variables[0] else { panic!() };
    assert!(made > 10_000, "{made}");
    let robot = &cell.snapshot().robots[0];
    assert!(robot.axes[0].overload_rate < 1.5, "{}", robot.axes[0].overload_rate);
}

/// Recordings that nobody reads while the program goes on must not hold the past for ever.
#[test]
fn a_recording_that_nobody_reads_is_bounded_and_its_reader_is_warned() {
    let mut cell = cell(&[RobotModel::Gx4A251S]);
    cell.write(Setting::ForcePort(true)).unwrap();
    cell.command(CellCommand::RecordStart(ForceRecording { robot: 1, duration: 600.0, interval: 600.0 })).unwrap();
    // The program's own recordings go elsewhere.
    cell.write(Setting::ForcePort(false)).unwrap();
    for _ in 0..120 {
        pass(&mut cell, 60_000);
        assert!(held(&cell) <= MAX_SEGMENTS);
    }
    assert_eq!(force_status(&mut cell, 0).error, QueueStatus::Warning);
    assert_eq!(cell.read_force_data(1, 1000).map(|bytes| bytes[0]), Some(1));
    assert_eq!(cell.read_force_data(1, 1000).map(|bytes| bytes[0]), Some(4), "its only record was overwritten");
}
