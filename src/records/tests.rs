//! Encoded packets decode to the same values, and no bytes make a reader panic.

use proptest::array::{uniform3, uniform4, uniform6, uniform8};
use proptest::collection::vec;
use proptest::prelude::*;

use super::force::*;
use super::layout::tests::assert_table;
use super::motion::*;
use super::{ControllerTime, Label, PacketKind, Ticks};

#[test]
fn the_tables_have_the_sizes_of_the_manual() {
    for (fields, size, bytes) in [
        (HeaderView::FIELDS, HeaderView::SIZE, 310),
        (AllView::FIELDS, AllView::SIZE, 178),
        (MotionView::FIELDS, MotionView::SIZE, 109),
        (ForceView::FIELDS, ForceView::SIZE, 86),
        (PositionView::FIELDS, PositionView::SIZE, 54),
        (FooterView::FIELDS, FooterView::SIZE, 182),
        (ForcesView::FIELDS, ForcesView::SIZE, 32),
        (SpeedView::FIELDS, SpeedView::SIZE, 16),
        (EncoderView::FIELDS, EncoderView::SIZE, 24),
        (DriveCommandView::FIELDS, DriveCommandView::SIZE, 20),
        (RealTimeIoView::FIELDS, RealTimeIoView::SIZE, 16),
        (StandardIoView::FIELDS, StandardIoView::SIZE, 24),
        (ForceSensorView::FIELDS, ForceSensorView::SIZE, 72),
        (PulseCountersView::FIELDS, PulseCountersView::SIZE, 24),
        (TcpPositionView::FIELDS, TcpPositionView::SIZE, 80),
        (BlockView::FIELDS, BLOCK_BYTES, 2608),
    ] {
        assert_eq!(size, bytes);
        assert_table(fields, size);
    }
    let end = BlockView::FIELDS.iter().fold(0, |end, item| {
        assert_eq!(item.offset, end, "{}", item.name);
        end + item.size
    });
    assert_eq!(end, BLOCK_BYTES, "the items fill the block");
    assert_eq!(HEADER_V2_BYTES, 318);
}

prop_compose! {
    fn time()(year in 1970..9999_i16, month in 1..=12_u8, day in 1..=28_u8, of_day in 0..86_400_000_u32) -> ControllerTime {
        let (hour, minute, second) = (of_day / 3_600_000, of_day / 60_000 % 60, of_day / 1000 % 60);
        ControllerTime {
            year, month, day,
            hour: hour as u8, minute: minute as u8, second: second as u8, millisecond: (of_day % 1000) as i16,
        }
    }
}

fn label<const N: usize>() -> impl Strategy<Value = Label<N>> {
    vec(any::<u8>(), 0..=N).prop_map(|bytes| Label::from_bytes(&bytes))
}

/// Any float but those that differ from themselves.
fn float() -> impl Strategy<Value = f32> {
    any::<f32>().prop_filter("not a number", |value| !value.is_nan())
}

prop_compose! {
    fn header()(
        (id, start, duration, interval) in (any::<u16>(), time(), float(), float()),
        (robot_no, robot_name, sensor_serial) in (any::<i16>(), label(), label()),
        (sensor_label, monitor_label, coordinate_label) in (label(), label(), label()),
        (file_name, sequence_name, force_name) in (label(), label(), label()),
        numbers in uniform4(any::<u8>()),
        record_start in proptest::option::of(0..Ticks::LIMIT.0),
    ) -> ForceHeader {
        let [sensor_no, sequence_no, robot_local, channel] = numbers;
        let version = if record_start.is_some() { 2 } else { 1 };
        let header = Header {
            version, id, packet_version: 3, packet_type: 4, channel, mode: 5, start, duration, interval, robot_no,
            robot_name, sensor_no, sensor_serial, sensor_label, monitor_no: -2, monitor_label, coordinate_no: 9,
            coordinate_label, file_name, sequence_no, sequence_name, force_name, robot_local,
        };
        ForceHeader { header, record_start: record_start.map(Ticks) }
    }
}

prop_compose! {
    fn sample(id: u16)(
        (count, elapsed, step_id) in (any::<u32>(), any::<u32>(), any::<u32>()),
        (force, torque, magnitudes) in (uniform3(float()), uniform3(float()), uniform3(float())),
        (position, reference, correction) in (uniform6(float()), uniform6(float()), uniform3(float())),
        (speed, joints, overload) in (uniform4(float()), uniform6(float()), uniform6(any::<u8>())),
        (time, monitor_no, numbers) in (time(), any::<i16>(), uniform4(any::<u8>())),
        version in 1..=2_u8,
    ) -> AllData {
        let head = DataHead { version, id, packet_version: numbers[3], count, elapsed, ..DataHead::default() };
        let [force_magnitude, torque_magnitude, _] = magnitudes;
        AllData {
            head,
            forces: Forces { force, torque, force_magnitude, torque_magnitude },
            position, reference, correction,
            speed: TcpSpeed { speed: speed[0], components: [speed[1], speed[2], speed[3]] },
            joints, overload, force_control: numbers[0], step_id, time,
            sequence_no: numbers[1], object_no: numbers[2], monitor_no,
        }
    }
}

fn data_type() -> impl Strategy<Value = ForceDataType> {
    proptest::sample::select(ForceDataType::ALL.to_vec())
}

/// 18 bits with a sign.
fn eighteen() -> impl Strategy<Value = i32> {
    -131_072..=131_071
}

fn ticks() -> impl Strategy<Value = Ticks> {
    (0..Ticks::LIMIT.0).prop_map(Ticks)
}

prop_compose! {
    fn force_sensor()(
        (timestamp, force, moment, temperature) in (ticks(), uniform3(eighteen()), uniform3(eighteen()), any::<i16>()),
        outputs in uniform4(uniform4(eighteen())),
    ) -> ForceSensor {
        let axes = SixAxes { force, moment, temperature };
        ForceSensor { timestamp, axes, elements: Elements { outputs, temperature: !temperature } }
    }
}

prop_compose! {
    fn block()(
        encoders in uniform6(uniform8((ticks(), any::<i64>(), any::<u32>(), any::<i8>()))),
        drives in uniform6(uniform8((ticks(), uniform3(any::<i16>()), any::<u16>()))),
        io in uniform8((ticks(), any::<u8>(), any::<u32>(), any::<u32>())),
        force_sensor in force_sensor(),
        pulses in uniform4(any::<u32>()),
        (timestamp, coordinates) in (ticks(), uniform3(uniform3(-1e6..1e6_f64))),
    ) -> MotionBlock {
        let [first, first_latched, second, second_latched] = pulses;
        let components = std::array::from_fn(|index| coordinates[index / 3][index % 3]);
        MotionBlock {
            encoders: encoders.map(|axis| axis.map(|(timestamp, position, timer, temperature)| {
                Encoder { timestamp, position, timer, temperature }
            })),
            drive_commands: drives.map(|axis| axis.map(|(timestamp, [d_current, q_current, velocity], electrical_angle)| {
                DriveCommand { timestamp, d_current, q_current, electrical_angle, velocity }
            })),
            real_time_io: io.map(|(timestamp, inputs, ..)| RealTimeIo { timestamp, inputs, outputs: !inputs }),
            standard_io: io.map(|(timestamp, _, inputs, outputs)| StandardIo { timestamp, inputs, outputs }),
            force_sensor,
            pulse_counters: PulseCounters { timestamp, first, first_latched, second, second_latched },
            tcp: TcpPosition { timestamp, components },
        }
    }
}

/// What `to_packet` of an encoded record gives.
fn with_data_type(mut record: ForceData) -> ForceData {
    let number = record.data_type().number();
    match &mut record {
        ForceData::All(record) => record.head.data_type = number,
        ForceData::Motion(record) => record.head.data_type = number,
        ForceData::Force(record) => record.head.data_type = number,
        ForceData::Position(record) => record.head.data_type = number,
    }
    record
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn a_header_survives(header in header()) {
        let bytes = header.encode();
        prop_assert_eq!(ForceRead::decode(&bytes).unwrap().to_header(), Some(header));
    }

    #[test]
    fn a_footer_survives(header in header(), condition in any::<i8>(), error_no in any::<i16>(), sequence_no in any::<u8>()) {
        let start = header.header;
        let footer = ForceFooter {
            version: start.version, id: start.id, channel: start.channel, end: start.start, duration: start.duration,
            robot_no: start.robot_no, robot_name: start.robot_name, sensor_serial: start.sensor_serial,
            end_condition: condition.into(), error_no, sequence_no, ..ForceFooter::default()
        };
        prop_assert_eq!(ForceRead::decode(&footer.encode()).unwrap().to_footer(), Some(footer));
    }

    #[test]
    fn data_records_survive_and_columns_hold_them(data_type in data_type(), samples in vec(sample(7), 1..20)) {
        let version = samples[0].head.version;
        let records: Vec<ForceData> = samples.iter().map(|sample| {
            with_data_type(AllData { head: DataHead { version, ..sample.head }, ..*sample }.reduced(data_type))
        }).collect();
        let mut bytes = Vec::new();
        records.iter().for_each(|record| record.encode_into(&mut bytes));
        prop_assert_eq!(bytes.len(), samples.len() * data_type.record_bytes());
        let ForceRead::Data(read) = ForceRead::decode(&bytes).unwrap() else { panic!("data") };
        prop_assert_eq!((0..read.len()).map(|index| read.get(index).unwrap()).collect::<Vec<_>>(), records);
        let mut columns = ForceColumns::default();
        columns.extend(read);
        prop_assert_eq!(columns.rows(), samples.len());
        for (row, sample) in samples.iter().enumerate() {
            let value = |name: &str| {
                columns.columns(data_type).into_iter().find(|column| column.name == name).map(|column| column.values.number(row))
            };
            prop_assert_eq!(value("Count"), Some(Some(sample.head.count.into())));
            prop_assert_eq!(value("CurPos(W)"), Some(Some(sample.position[5].into())));
            prop_assert_eq!(value("FMNo"), Some(Some(sample.monitor_no.into())));
            let when = |types: &[ForceDataType], number: f64| types.contains(&data_type).then_some(Some(number));
            use ForceDataType::{All, Force, Motion};
            prop_assert_eq!(value("Tz"), when(&[All, Force], sample.forces.torque[2].into()));
            prop_assert_eq!(value("Tmag"), when(&[All, Force], sample.forces.torque_magnitude.into()));
            prop_assert_eq!(value("Diff(Y)"), when(&[All], sample.correction[1].into()));
            prop_assert_eq!(value("TCPSpeed(Z)"), when(&[All, Motion], sample.speed.components[2].into()));
            prop_assert_eq!(value("OLRate(J6)"), when(&[All, Motion], sample.overload[5].into()));
            let milliseconds = sample.time.to_date_time().unwrap().and_utc().timestamp_millis();
            prop_assert_eq!(value("Time"), when(&[All, Motion], milliseconds as f64));
        }
        for column in columns.columns(data_type) {
            prop_assert_eq!(column.values.len(), samples.len(), "{}", column.name);
        }
    }

    #[test]
    fn blocks_survive_and_columns_hold_them(blocks in vec(block(), 1..4)) {
        let mut bytes = Vec::new();
        blocks.iter().for_each(|block| block.encode_into(&mut bytes));
        let read = MotionRead::decode(&bytes).unwrap();
        prop_assert_eq!(&read.blocks().map(BlockView::to_packet).collect::<Vec<_>>(), &blocks);
        let mut columns = MotionColumns::default();
        columns.extend(read);
        prop_assert_eq!(columns.rows(), 8 * blocks.len());
        for column in columns.columns() {
            prop_assert_eq!(column.values.len() * column.rows_per_value, columns.rows(), "{}", column.name);
        }
        for (index, block) in blocks.iter().enumerate() {
            for sample in 0..SAMPLES {
                let row = index * SAMPLES + sample;
                for axis in 0..AXES {
                    let (encoder, columns) = (block.encoders[axis][sample], &columns.encoders[axis]);
                    prop_assert_eq!(columns.timestamp[row], encoder.timestamp.0);
                    prop_assert_eq!(columns.position[row], encoder.position);
                    prop_assert_eq!((columns.timer[row], columns.temperature[row]), (encoder.timer, encoder.temperature));
                }
                let (drive, drives) = (block.drive_commands[5][sample], &columns.drive_commands[5]);
                prop_assert_eq!((drives.timestamp[row], drives.velocity[row]), (drive.timestamp.0, drive.velocity));
                prop_assert_eq!((drives.d_current[row], drives.q_current[row]), (drive.d_current, drive.q_current));
                prop_assert_eq!(drives.electrical_angle[row], drive.electrical_angle);
                prop_assert_eq!(columns.standard_io.outputs[row], block.standard_io[sample].outputs);
                prop_assert_eq!(columns.real_time_io.inputs[row], block.real_time_io[sample].inputs);
            }
            prop_assert_eq!(columns.force_sensor.axes[4][index], block.force_sensor.axes.moment[1]);
            prop_assert_eq!(columns.force_sensor.elements[3][0][index], block.force_sensor.elements.outputs[3][0]);
            prop_assert_eq!(columns.pulse_counters.counters[3][index], block.pulse_counters.second_latched);
            prop_assert_eq!(columns.tcp.components[8][index], block.tcp.components[8]);
        }
    }

    #[test]
    fn any_bytes_are_a_packet_or_an_error_inside_them(bytes in vec(any::<u8>(), 0..700), tag in 0..5_u8, version in 0..3_u8) {
        let mut bytes = bytes;
        if let [first, second, ..] = &mut bytes[..] {
            (*first, *second) = (tag, version);
        }
        if let Err(error) = ForceRead::decode(&bytes) {
            prop_assert!(error.offset <= bytes.len(), "{error}");
        }
        let error = MotionRead::decode(&bytes).unwrap_err();
        prop_assert_eq!(error.packet, PacketKind::MotionBlock);
    }
}
