use std::fs;
use std::time::Duration;

use chrono::DateTime;

use super::*;
use crate::recorder::settings::RecordSettings;
use crate::recorder::stored_recording::summarise;
use crate::records::Ticks;
use crate::records::motion::MotionBlock;

fn header(format: &str, keep_packets: bool) -> RecordingHeader {
    RecordingHeader {
        controller: "焊接/1".into(),
        serial: "R7A0000001".into(),
        url: "opc.tcp://127.0.0.1:4840".into(),
        settings: RecordSettings::motion(0, 0).unwrap(),
        started_at: DateTime::from_timestamp_millis(1_800_000_000_123).unwrap(),
        format: format.into(),
        keep_packets,
    }
}

fn packet(number: u64) -> Entry {
    let mut block = MotionBlock::default();
    block.encoders[0][0].timestamp = Ticks((number + 1) * 640_000);
    block.encoders[0][0].position = number as i64;
    let mut bytes = Vec::new();
    block.encode_into(&mut bytes);
    Entry::Packet { bytes, overwritten: false }
}

fn record(folder: &Path, format: Format, keep_packets: bool, packets: u64) -> RecordingFiles {
    let header = header(format.extension(), keep_packets);
    let mut files = RecordingFiles::create(folder, &header, format).unwrap();
    for number in 0..packets {
        files.push(header.started_at + Duration::from_millis(8 * number), &packet(number)).unwrap();
    }
    files
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn a_complete_recording_is_a_file_and_its_description() {
    let folder = tempfile::tempdir().unwrap();
    let files = record(folder.path(), Format::Csv, true, 3);
    let recorded = files.finish(DateTime::UNIX_EPOCH, StopReason::Request).unwrap();
    let stem = "焊接_1-motion-20270115-080000-123";
    assert_eq!(names(folder.path()), [format!("{stem}.csv"), format!("{stem}.csv.json"), format!("{stem}.packets")]);
    for path in [&recorded.file, &recorded.sidecar_file, recorded.packets.as_ref().unwrap()] {
        assert_eq!(summarise(path).unwrap(), recorded.sidecar, "{}", path.display());
    }
    assert_eq!(recover(folder.path()).len(), 0, "it is complete");
    let again = folder.path().join("again.csv");
    assert_eq!(convert(recorded.packets.as_ref().unwrap(), &again).unwrap(), recorded.sidecar);
    assert_eq!(fs::read(&again).unwrap(), fs::read(&recorded.file).unwrap());
    let refused = convert(recorded.packets.as_ref().unwrap(), &again);
    assert!(matches!(refused, Err(RecorderError::Write { .. })), "nothing is overwritten");
    let refused = convert(recorded.packets.as_ref().unwrap(), Path::new("again.xlsx"));
    assert!(matches!(refused, Err(RecorderError::UnknownFormat(_))));
}

#[test]
fn what_a_killed_process_leaves_is_made_whole() {
    for format in Format::ALL {
        let folder = tempfile::tempdir().unwrap();
        let mut files = record(folder.path(), format, false, 5);
        files.sync().unwrap();
        assert_eq!(recover(folder.path()).len(), 0, "it is being written");
        files.push(DateTime::UNIX_EPOCH, &packet(5)).unwrap();
        // As the end of the process does: nothing more is written.
        drop(files);
        let recovered = recover(folder.path()).remove(0).unwrap();
        assert_eq!((recovered.sidecar.rows, recovered.sidecar.stopped_by), (40, StopReason::Killed));
        assert_eq!(names(folder.path()).len(), 2, "{:?}", names(folder.path()));
        assert!(recovered.file.exists() && recovered.packets.is_none());
        assert_eq!(recover(folder.path()).len(), 0);
    }
}
