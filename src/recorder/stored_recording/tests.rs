use std::fs;
use std::path::PathBuf;

use proptest::prelude::*;

use super::*;
use crate::model::{ErrorCode, Problem};
use crate::recorder::format::sidecar_path;
use crate::recorder::journal::{JournalWriter, RecordingHeader};
use crate::recorder::live::LiveColumn;
use crate::recorder::settings::{RecordSettings, Source};
use crate::recorder::sidecar::GapCause;
use crate::recorder::table_fault::{CellFault, TableFault};
use crate::records::Ticks;
use crate::records::force::{AllData, AllView, DataHead, ForceDataType, ForceFooter, ForceHeader, Header};
use crate::records::motion::{BLOCK_BYTES, BlockView, SAMPLES};

fn header(settings: RecordSettings) -> RecordingHeader {
    RecordingHeader {
        controller: "Weld 1".into(),
        serial: "R7A0000001".into(),
        url: "opc.tcp://127.0.0.1:4840".into(),
        settings,
        started_at: DateTime::from_timestamp_millis(1_800_000_000_123).unwrap(),
        format: "csv".into(),
        keep_packets: true,
    }
}

/// A journal with these packets, complete.
fn journal(folder: &Path, settings: RecordSettings, packets: &[Entry]) -> PathBuf {
    let path = folder.join("a.packets");
    let header = header(settings);
    let mut journal = JournalWriter::create(&path, &header).unwrap();
    for entry in packets.iter().chain([&Entry::End(StopReason::Request)]) {
        journal.append(header.started_at, entry);
    }
    journal.sync().unwrap();
    path
}

fn packet(bytes: Vec<u8>) -> Entry {
    Entry::Packet { bytes, overwritten: false }
}

/// Numbers that look random (xorshift).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0
    }

    fn bytes<const N: usize>(&mut self) -> [u8; N] {
        std::array::from_fn(|_| self.next() as u8)
    }
}

/// A motion log block with any values. Time stamps are near `number` ms, or missing.
fn block(numbers: &mut Numbers, number: u64) -> Vec<u8> {
    let mut block = numbers.bytes::<BLOCK_BYTES>();
    for item in BlockView::FIELDS {
        let samples = if ["FSENS", "PLSCNT", "TCP"].contains(&item.name) { 1 } else { SAMPLES };
        for sample in 0..samples {
            let ticks = (number * SAMPLES as u64 + sample as u64 + 1) * 80_000 + numbers.next() % 1000;
            let ticks = if numbers.next().is_multiple_of(4) { 0 } else { ticks };
            let at = item.offset + sample * (item.size / samples);
            block[at..at + 8].copy_from_slice(&ticks.to_le_bytes());
        }
    }
    block.to_vec()
}

/// A force sensor record with any values, numbers that are none included.
fn record(numbers: &mut Numbers, data_type: ForceDataType, count: u32) -> Vec<u8> {
    let mut all = AllView::new(&numbers.bytes::<178>()).to_packet();
    all.head = DataHead { version: 2, id: 7, count, elapsed: 2 * count, ..DataHead::default() };
    if count.is_multiple_of(2) {
        all.time.month = 1 + all.time.month % 12;
        all.time.day = 1 + all.time.day % 28;
        (all.time.hour, all.time.minute, all.time.second) = (23, 59, all.time.second % 60);
        all.time.millisecond = all.time.millisecond.rem_euclid(1000);
    }
    let mut bytes = Vec::new();
    all.reduced(data_type).encode_into(&mut bytes);
    bytes
}

fn packets(settings: RecordSettings, seed: u64, reads: u64) -> Vec<Entry> {
    let mut numbers = Numbers(seed | 1);
    match settings.source() {
        Source::Motion { .. } => (0..reads).map(|number| packet(block(&mut numbers, number))).collect(),
        Source::Force { data_type, .. } => {
            let header = Header { id: 7, interval: 0.002, ..Header::default() };
            let mut entries = vec![packet(ForceHeader { header, record_start: Some(Ticks(80_000_000)) }.encode())];
            entries.extend((0..reads as u32).map(|count| packet(record(&mut numbers, data_type, count))));
            entries.push(packet(ForceFooter { version: 2, id: 7, ..ForceFooter::default() }.encode().to_vec()));
            entries
        }
    }
}

fn loaded(path: &Path, names: &[String]) -> Vec<LiveColumn> {
    let values = LiveValues::new(names.to_vec());
    load(path, &values, &CancellationToken::new()).unwrap();
    values.read(<[LiveColumn]>::to_vec)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn values_are_the_same_whatever_way_they_took(kind in 0..5_u16, seed in any::<u64>(), reads in 0..40_u64) {
        let folder = tempfile::tempdir().unwrap();
        let settings = match kind {
            4 => RecordSettings::motion(0, 0).unwrap(),
            data_type => RecordSettings::force(data_type, 1, 0).unwrap(),
        };
        let packets = journal(folder.path(), settings, &packets(settings, seed, reads));
        let file = |name: &str| folder.path().join(name);
        let sidecar = summarise(&packets).unwrap();
        let ways = [("a.packets", "1.csv"), ("1.csv", "2.parquet"), ("2.parquet", "3.csv"), ("2.parquet", "4.parquet"),
            ("4.parquet", "5.csv"), ("5.csv", "6.csv"), ("a.packets", "7.parquet"), ("7.parquet", "8.csv")];
        for (from, to) in ways {
            prop_assert_eq!(&convert(&file(from), &file(to)).unwrap(), &sidecar, "{} to {}", from, to);
            prop_assert_eq!(&summarise(&file(to)).unwrap(), &sidecar);
        }
        let csv = fs::read(file("1.csv")).unwrap();
        for other in ["3.csv", "5.csv", "6.csv", "8.csv"] {
            prop_assert!(csv == fs::read(file(other)).unwrap(), "{} differs", other);
        }
        let names: Vec<String> = sidecar.columns.iter().map(|column| column.name.clone()).collect();
        let all = loaded(&packets, &names);
        prop_assert_eq!(all.len(), names.len());
        for other in ["1.csv", "2.parquet", "7.parquet", "1.csv.json"] {
            prop_assert!(all == loaded(&file(other), &names), "{} differs", other);
        }
        let two = [names[4].clone(), names[names.len() - 1].clone()];
        let few: Vec<_> = all.into_iter().filter(|column| two.contains(&column.name)).collect();
        for one in ["a.packets", "1.csv", "2.parquet"] {
            prop_assert!(few == loaded(&file(one), &two), "{} differs", one);
        }
    }
}

#[test]
fn a_recording_of_several_parts_is_read_part_by_part() {
    let folder = tempfile::tempdir().unwrap();
    let settings = RecordSettings::force(3, 1, 0).unwrap();
    let mut data = Vec::new();
    let rows = 150_000;
    for start in (0..rows).step_by(1000) {
        let mut bytes = Vec::new();
        for count in start..start + 1000 {
            let head = DataHead { version: 2, id: 7, count, elapsed: 2 * count, ..DataHead::default() };
            let position = [count as f32 + 0.25; 6];
            AllData { head, position, ..AllData::default() }.reduced(ForceDataType::Position).encode_into(&mut bytes);
        }
        data.push(packet(bytes));
    }
    let packets = journal(folder.path(), settings, &data);
    let (csv, parquet) = (folder.path().join("a.csv"), folder.path().join("a.parquet"));
    let sidecar = convert(&packets, &csv).unwrap();
    assert_eq!(sidecar.rows, u64::from(rows));
    convert(&csv, &parquet).unwrap();
    let again = folder.path().join("b.csv");
    convert(&parquet, &again).unwrap();
    assert!(fs::read(&csv).unwrap() == fs::read(&again).unwrap());
    let names = ["CurPos(X)".to_owned()];
    for file in [&packets, &csv, &parquet] {
        let columns = loaded(file, &names);
        assert_eq!(columns[0].series.len(), rows as usize);
        assert_eq!(columns[0].series.span(), Some(0.0..299.998));
    }
    // A plot that is closed ends the reading at the next part.
    let stop = CancellationToken::new();
    stop.cancel();
    for file in [&packets, &csv] {
        let values = LiveValues::new(names.to_vec());
        load(file, &values, &stop).unwrap();
        assert!(values.read(|columns| columns.iter().all(|column| column.series.len() < 100_000)));
    }
}

#[test]
fn gaps_and_a_restart_are_at_the_same_place_in_every_kind() {
    let folder = tempfile::tempdir().unwrap();
    let settings = RecordSettings::motion(0, 0).unwrap();
    let mut data = packets(settings, 1, 10);
    // Blocks 3 and 4 are lost; the controller restarts after block 7.
    data.drain(3..5);
    data.extend(packets(settings, 1, 2));
    let from = journal(folder.path(), settings, &data);
    let csv = folder.path().join("a.csv");
    let sidecar = convert(&from, &csv).unwrap();
    let causes: Vec<_> = sidecar.gaps.iter().map(|gap| (gap.cause, gap.missing, gap.at_row)).collect();
    let (lost, restarted) = (GapCause::Unexplained, GapCause::ControllerRestarted);
    assert_eq!(causes, [(lost, Some(2), 24), (restarted, None, 64)]);
    let names: Vec<String> = (1..=6).map(|axis| format!("ENC_{axis}.ENC_POS")).collect();
    for column in loaded(&csv, &names) {
        let bars = column.series.query(0.0..1.0, 1000);
        let gaps: Vec<f64> = bars.iter().filter(|bar| bar.after_gap).map(|bar| bar.x).collect();
        assert_eq!(gaps.len(), 2, "{gaps:?}");
        // Block 5 begins 40 ms after block 0, and the time goes on where block 9 ended, after 79 ms.
        assert!((0.0395..0.048).contains(&gaps[0]) && (0.0785..0.088).contains(&gaps[1]), "{gaps:?}");
        assert!(bars.last().is_some_and(|last| last.x < 0.1), "{:?}", bars.last());
    }
    assert_eq!(loaded(&csv, &names), loaded(&from, &names));
}

/// What a conversion of a file with this content is refused with; nothing is left of it.
fn refused(folder: &Path, file: &str, content: &[u8]) -> TableFault {
    let before = fs::read_dir(folder).unwrap().count();
    let file = folder.join(file);
    fs::write(&file, content).unwrap();
    let error = convert(&file, &folder.join("other.parquet")).unwrap_err();
    assert_eq!(fs::read_dir(folder).unwrap().count(), before, "nothing is written");
    match error {
        RecorderError::DamagedTable { path, source } => {
            assert_eq!(path, file);
            source
        }
        other => panic!("{other}"),
    }
}

#[test]
fn a_damaged_csv_file_is_refused_with_row_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let settings = RecordSettings::force(3, 1, 0).unwrap();
    convert(&journal(folder, settings, &packets(settings, 3, 4)), &folder.join("a.csv")).unwrap();
    let csv = fs::read_to_string(folder.join("a.csv")).unwrap();
    let with = |from: &str, to: &str| {
        assert!(csv.contains(from), "{csv}");
        refused(folder, "a.csv", csv.replacen(from, to, 1).as_bytes())
    };
    let cell = |fault: TableFault| match fault {
        TableFault::Cell { row, column, fault } => (row, column, fault),
        other => panic!("{other}"),
    };
    assert_eq!(cell(with("\r\n7,1,2,", "\r\n7,1,,")), (2, "ElapsedTime".to_owned(), CellFault::Missing));
    assert_eq!(cell(with("\r\n7,1,2,", "\r\n70000,1,2,")), (2, "OPCUACommonID".to_owned(), CellFault::OutOfRange));
    assert_eq!(cell(with("\r\n7,2,4,", "\r\n7,2.0,4,")), (3, "Count".to_owned(), CellFault::OutOfRange));
    assert!(matches!(with("\r\n7,1,2,", "\r\n7,1,2,0,"), TableFault::Row { row: 2 }));
    assert!(matches!(with("\r\n7,1,2,", "\r\n"), TableFault::Row { row: 2 }));
    assert!(matches!(with("[ms]", "[s]"), TableFault::OtherColumns));
    let fewer = csv[..csv.len() - 1].rsplit_once("\r\n").unwrap().0;
    assert!(matches!(refused(folder, "a.csv", fewer.as_bytes()), TableFault::Rows { found: 3, described: 4 }));
    let more = format!("{csv}{}", &csv[csv.find("\r\n7,1,").unwrap() + 2..]);
    assert!(matches!(refused(folder, "a.csv", more.as_bytes()), TableFault::Rows { described: 4, .. }));
    let endless = [csv.as_bytes(), &[b'7'; 100_000]].concat();
    assert!(matches!(refused(folder, "a.csv", &endless), TableFault::Row { row: 5 }));
    assert!(matches!(refused(folder, "a.csv", &[csv.as_bytes(), &[0xFF]].concat()), TableFault::Row { row: 5 }));
    assert!(matches!(refused(folder, "a.csv", b""), TableFault::OtherColumns));
    // As another program may have saved it.
    let resaved = format!("\u{feff}{}", csv.replace("\r\n", "\n").trim_end());
    fs::write(folder.join("a.csv"), resaved).unwrap();
    convert(&folder.join("a.csv"), &folder.join("b.csv")).unwrap();
    assert_eq!(fs::read_to_string(folder.join("b.csv")).unwrap(), csv);
}

#[test]
fn a_value_without_its_time_stamp_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let settings = RecordSettings::motion(0, 0).unwrap();
    let mut block = vec![0; BLOCK_BYTES];
    block[..8].copy_from_slice(&80_000_u64.to_le_bytes());
    convert(&journal(folder, settings, &[packet(block)]), &folder.join("a.csv")).unwrap();
    let csv = fs::read_to_string(folder.join("a.csv")).unwrap();
    let fault = |from: &str, to: &str| match refused(folder, "a.csv", csv.replacen(from, to, 1).as_bytes()) {
        TableFault::Cell { row, column, fault } => (row, column, fault),
        other => panic!("{other}"),
    };
    assert_eq!(fault("80000,0,0,0,,", "80000,0,,0,,"), (1, "ENC_1.ENC_TMR".to_owned(), CellFault::Missing));
    assert_eq!(fault("80000,0,0,0,,", "80000,0,0,0,,5"), (1, "ENC_2.ENC_POS".to_owned(), CellFault::Unexpected));
    // The tool centre point is there once in a block.
    let in_block = csv.trim_end().to_owned() + "1";
    let fault = refused(folder, "a.csv", in_block.as_bytes());
    assert!(matches!(fault, TableFault::Cell { row: 8, fault: CellFault::Unexpected, .. }), "{fault}");
}

#[test]
fn a_damaged_parquet_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let settings = RecordSettings::force(3, 1, 0).unwrap();
    convert(&journal(folder, settings, &packets(settings, 3, 4)), &folder.join("a.parquet")).unwrap();
    let parquet = fs::read(folder.join("a.parquet")).unwrap();
    for length in [0, 4, 20, parquet.len() / 2, parquet.len() - 1] {
        let fault = refused(folder, "a.parquet", &parquet[..length]);
        assert!(matches!(fault, TableFault::Parquet(_)), "{fault}");
    }
    let text = refused(folder, "a.parquet", b"OPCUACommonID,Count\r\n1,2\r\n");
    assert!(matches!(text, TableFault::Parquet(_)), "{text}");
    // A file of another recording under this name.
    fs::remove_file(folder.join("a.packets")).unwrap();
    let settings = RecordSettings::force(2, 1, 0).unwrap();
    convert(&journal(folder, settings, &packets(settings, 3, 4)), &folder.join("b.parquet")).unwrap();
    let other = refused(folder, "a.parquet", &fs::read(folder.join("b.parquet")).unwrap());
    assert!(matches!(other, TableFault::OtherColumns), "{other}");
    let sidecar = sidecar_path(&folder.join("a.parquet"));
    let described = fs::read_to_string(&sidecar).unwrap().replace("\"rows\": 4", "\"rows\": 5");
    fs::write(sidecar, described).unwrap();
    let short = refused(folder, "a.parquet", &parquet);
    assert!(matches!(short, TableFault::Rows { found: 4, described: 5 }), "{short}");
}

#[test]
fn a_file_without_its_description_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.csv");
    let missing = |path: &Path| match convert(path, &folder.path().join("b.csv")) {
        Err(RecorderError::Read { path, .. }) => path,
        other => panic!("{other:?}"),
    };
    assert_eq!(missing(&file), file);
    fs::write(&file, "").unwrap();
    let other = convert(&file, &folder.path().join("b.csv"));
    assert!(matches!(&other, Err(RecorderError::NoDescription(path)) if *path == sidecar_path(&file)), "{other:?}");
    assert_eq!(Problem::from(other.unwrap_err()).code, ErrorCode::NoRecordingDescription);
}
