use super::*;
use crate::records::force::{EndCondition, ForceAssembly, ForceColumns, ForceEvent};

/// A header of version 2, byte by byte as manual 4.1.3 lays it out.
fn header() -> Vec<u8> {
    let mut bytes = vec![0; 318];
    bytes[0] = 1; // OPCUACommonTag
    bytes[1] = 2; // OPCUACommonVer
    bytes[2..4].copy_from_slice(&[0x39, 0x05]); // OPCUACommonID 1337
    bytes[10..12].copy_from_slice(&[0xea, 0x07]); // 2026
    bytes[12..17].copy_from_slice(&[6, 1, 8, 30, 15]); // June 1, 08:30:15
    bytes[17..19].copy_from_slice(&[0xfa, 0x00]); // 250 ms
    bytes[19..23].copy_from_slice(&[0, 0, 0x20, 0x41]); // 10.0 s
    bytes[23..27].copy_from_slice(&[0, 0, 0x00, 0x3c]); // 2⁻⁷ s
    bytes[27] = 1; // RobotNo
    bytes[29] = 6;
    bytes[30..36].copy_from_slice(b"robot1");
    bytes[177] = 8;
    bytes[178..186].copy_from_slice(b"data.frd");
    bytes[309] = 3; // RobotLocal
    bytes[310..318].copy_from_slice(&[0, 0xb4, 0xc4, 0x04, 0, 0, 0, 0]); // 80 000 000 ticks
    bytes
}

/// A data record of DataType 3.
fn position(count: u8) -> Vec<u8> {
    let mut bytes = vec![0; 54];
    bytes[..2].copy_from_slice(&[2, 2]);
    bytes[2..4].copy_from_slice(&[0x39, 0x05]);
    bytes[6] = 3; // OPCUADataType
    bytes[14] = count;
    bytes[18..20].copy_from_slice(&[0xe8, 0x03]); // 1000 ms
    bytes[22..26].copy_from_slice(&[0, 0, 0xc8, 0x42]); // X 100 mm
    bytes[42..46].copy_from_slice(&[0, 0, 0xb4, 0xc2]); // W -90°
    bytes[46] = 5; // StepID
    bytes[52] = 2; // FMNo
    bytes
}

fn footer() -> Vec<u8> {
    let mut bytes = vec![0; 182];
    bytes[..4].copy_from_slice(&[4, 2, 0x39, 0x05]);
    bytes[177] = 0xff; // EndCondition -1
    bytes[178..180].copy_from_slice(&[0x44, 0x02]); // error 580
    bytes[180] = 9; // SeqNo
    bytes
}

fn error(bytes: &[u8]) -> (PacketKind, usize, &'static str, usize, Mistake) {
    let error = ForceRead::decode(bytes).unwrap_err();
    (error.packet, error.record, error.field, error.offset, error.mistake)
}

#[test]
fn a_header_by_the_table() {
    let bytes = header();
    let ForceRead::Header { header, record_start } = ForceRead::decode(&bytes).unwrap() else { panic!("a header") };
    assert_eq!((header.version(), header.id(), record_start), (2, 1337, Some(Ticks(Ticks::PER_SECOND))));
    assert_eq!(header.start().to_string(), "2026-06-01 08:30:15.250");
    assert_eq!((header.duration(), header.interval(), header.robot_no()), (10.0, 0.0078125, 1));
    assert_eq!((header.robot_name().to_string().as_str(), header.robot_local()), ("robot1", 3));
    assert_eq!(header.file_name().to_string(), "data.frd");
    assert!(header.sensor_label().is_empty());
}

#[test]
fn data_by_the_table() {
    let bytes = [position(0), position(1)].concat();
    let ForceRead::Data(records) = ForceRead::decode(&bytes).unwrap() else { panic!("data") };
    assert_eq!((records.len(), records.data_type()), (2, ForceDataType::Position));
    let Some(ForceData::Position(record)) = records.get(1) else { panic!("a position") };
    assert_eq!((record.head.count, record.head.elapsed, record.step_id, record.monitor_no), (1, 1000, 5, 2));
    assert_eq!(record.position, [100.0, 0.0, 0.0, 0.0, 0.0, -90.0]);
}

#[test]
fn a_footer_by_the_table() {
    let bytes = footer();
    let footer = ForceRead::decode(&bytes).unwrap().to_footer().unwrap();
    assert_eq!((footer.id, footer.end_condition, footer.error_no), (1337, EndCondition::Error, 580));
    assert_eq!((footer.sequence_no, footer.end.to_string().as_str()), (9, "–"));
}

#[test]
fn an_error_names_the_field_and_its_offset() {
    use PacketKind::{Force, ForceData, ForceFooter, ForceHeader};
    let changed = |mut bytes: Vec<u8>, at: usize, value: u8| {
        bytes[at] = value;
        bytes
    };
    let value = |found, expected| Mistake::Value { found, expected };
    let two = [position(0), position(1)].concat();
    let other = "the first record of the same read has another value";
    for (bytes, expected) in [
        (vec![], (Force, 0, "OPCUACommonTag", 0, Mistake::Truncated { missing: 1 })),
        (vec![3], (Force, 0, "OPCUACommonTag", 0, value(3, "expected 1, 2 or 4"))),
        (header()[..40].to_vec(), (ForceHeader, 0, "RobotName", 29, Mistake::Truncated { missing: 270 })),
        (header()[..312].to_vec(), (ForceHeader, 0, "RecordStartTime", 310, Mistake::Truncated { missing: 6 })),
        (changed(header(), 1, 1), (ForceHeader, 0, "end", 310, Mistake::Oversized { excess: 8 })),
        (changed(header(), 1, 7), (ForceHeader, 0, "OPCUACommonVer", 1, value(7, "expected 1 or 2"))),
        (changed(header(), 12, 13), (ForceHeader, 0, "Month", 12, value(13, "expected 1 to 12"))),
        (
            changed(header(), 63, 11),
            (ForceHeader, 0, "SensorSerialLength", 63, value(11, "more than the bytes of the text")),
        ),
        (
            changed(header(), 317, 0x80),
            (ForceHeader, 0, "RecordStartTime", 310, value(0x8000_0000_04c4_b400, "more than a hundred years")),
        ),
        (position(0)[..21].to_vec(), (ForceData, 0, "ElapsedTime", 18, Mistake::Truncated { missing: 1 })),
        (changed(position(0), 6, 4), (ForceData, 0, "OPCUADataType", 6, value(4, "expected 0 to 3"))),
        (two[..54 + 47].to_vec(), (ForceData, 1, "StepID", 54 + 46, Mistake::Truncated { missing: 7 })),
        (changed(two.clone(), 54, 4), (ForceData, 1, "OPCUACommonTag", 54, value(4, other))),
        (changed(two.clone(), 56, 0x3a), (ForceData, 1, "OPCUACommonID", 56, value(0x53a, other))),
        (changed(two, 60, 2), (ForceData, 1, "OPCUADataType", 60, value(2, other))),
        ([footer(), vec![0]].concat(), (ForceFooter, 0, "end", 182, Mistake::Oversized { excess: 1 })),
        (
            changed(footer(), 29, 33),
            (ForceFooter, 0, "RobotNameLength", 29, value(33, "more than the bytes of the text")),
        ),
    ] {
        assert_eq!(error(&bytes), expected);
    }
}

#[test]
fn a_recording_is_put_together_by_its_id() {
    let mut assembly = ForceAssembly::default();
    let mut columns = ForceColumns::default();
    let mut push = |bytes: &[u8]| {
        let events = assembly.push(ForceRead::decode(bytes).unwrap(), &mut columns);
        events
            .iter()
            .map(|event| match event {
                ForceEvent::Started(header) => format!("started {}", header.header.id),
                ForceEvent::Ended(footer) => format!("ended {}", footer.id),
                other => format!("{other:?}"),
            })
            .collect::<Vec<_>>()
            .join(", ")
    };
    assert_eq!(push(&header()), "started 1337");
    assert_eq!(push(&[position(0), position(1)].concat()), "Records { count: 2 }");
    assert_eq!(push(&position(9)), "Lost { after: 1, missing: 7 }, Records { count: 1 }");
    assert_eq!(push(&footer()), "ended 1337");
    assert_eq!(push(&position(0)), "HeaderMissing { id: 1337 }, Records { count: 1 }");
    assert_eq!(push(&header()), "FooterMissing { id: 1337 }, started 1337");
    assert_eq!(columns.count, [0, 1, 9, 0]);
}
