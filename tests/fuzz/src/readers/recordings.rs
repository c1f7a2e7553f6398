use std::fs;
use std::path::{Path, PathBuf};

use chrono::DateTime;
use opcua_configurator::recorder::{
    self, LiveValues, RecordSettings, RecorderError, RecordingHeader, Sidecar, StopReason, sidecar_path,
};
use tempfile::TempDir;
use tokio_util::sync::CancellationToken;

use super::assert_printable;

thread_local! {
    static FOLDER: TempDir = TempDir::new().expect("a temporary folder");
}

/// A file with packets, as a recorder leaves it: what is taken becomes the same CSV file whatever way it takes; a file that
/// is refused leaves nothing.
pub fn recording_packets(bytes: &[u8]) {
    in_folder(|folder| {
        let packets = folder.join("a.packets");
        fs::write(&packets, bytes).expect("a file of our own");
        match recorder::summarise(&packets) {
            Ok(sidecar) => assert_ways(folder, &packets, &sidecar),
            Err(error) => {
                assert_refused(&error);
                assert!(recorder::convert(&packets, &folder.join("1.csv")).is_err());
            }
        }
    });
}

/// A CSV file beside the sidecar of each kind of recording.
pub fn recording_csv(bytes: &[u8]) {
    let rows = bytes.iter().filter(|byte| **byte == b'\n').count().saturating_sub(1) as u64;
    table("a.csv", bytes, rows);
}

/// The description beside a file: what is taken can be written and is then read the same.
pub fn recording_sidecar(bytes: &[u8]) {
    in_folder(|folder| {
        let (first, second) = (folder.join("a.csv.json"), folder.join("b.csv.json"));
        fs::write(&first, bytes).expect("a file of our own");
        match Sidecar::read(&first) {
            Ok(sidecar) => {
                sidecar.write(&second).expect("what was read can be written");
                let again = Sidecar::read(&second).expect("what was written is a sidecar");
                assert_eq!(without_seconds(again), without_seconds(sidecar));
            }
            Err(error) => assert_refused(&error),
        }
    });
}

fn table(name: &str, bytes: &[u8], rows: u64) {
    let force = (0..=3).map(|data_type| RecordSettings::force(data_type, 1, 0));
    for settings in force.chain([RecordSettings::motion(0, 0)]) {
        let settings = settings.expect("settings in range");
        let sidecar = sidecar(settings, rows);
        in_folder(|folder| {
            let file = folder.join(name);
            fs::write(&file, bytes).expect("a file of our own");
            sidecar.write(&sidecar_path(&file)).expect("a file of our own");
            let csv = folder.join("1.csv");
            match recorder::convert(&file, &csv) {
                Ok(converted) => {
                    assert_eq!(converted, sidecar);
                    clean(folder, &file);
                    assert_ways(folder, &file, &sidecar);
                }
                Err(error) => {
                    assert_refused(&error);
                    assert_eq!(files(folder).len(), 2, "nothing is left of it: {:?}", files(folder));
                }
            }
        });
    }
}

/// Converted directly and over the other format, a recording is the same; a plot can show every column.
fn assert_ways(folder: &Path, from: &Path, sidecar: &Sidecar) {
    let [csv, parquet, again] = ["1.csv", "2.parquet", "3.csv"].map(|name| folder.join(name));
    for (from, to) in [(from, &csv), (&csv, &parquet), (&parquet, &again)] {
        let converted = recorder::convert(from, to).expect("what was taken once is taken again");
        assert_eq!(without_seconds(converted), without_seconds(sidecar.clone()));
    }
    assert!(fs::read(&csv).expect("a CSV file") == fs::read(&again).expect("a CSV file"));
    let names: Vec<String> = sidecar.columns.iter().map(|column| column.name.clone()).collect();
    for file in [from, &parquet] {
        recorder::load(file, &LiveValues::new(names.clone()), &CancellationToken::new()).expect("a recording");
    }
}

fn assert_refused(error: &RecorderError) {
    assert_printable(&error.to_string());
    assert!(!matches!(error, RecorderError::Write { .. } | RecorderError::Parquet { .. }), "{error}");
}

/// Seconds beyond 285 years lose their microseconds in JSON.
fn without_seconds(sidecar: Sidecar) -> Sidecar {
    Sidecar { seconds: 0.0, ..sidecar }
}

fn sidecar(settings: RecordSettings, rows: u64) -> Sidecar {
    let started_at = DateTime::from_timestamp(1_900_000_000, 0).expect("a time");
    Sidecar {
        version: 1,
        header: RecordingHeader {
            controller: "Weld 1".into(),
            serial: "R7A0000001".into(),
            url: "opc.tcp://127.0.0.1:4840".into(),
            settings,
            started_at,
            format: "csv".into(),
            keep_packets: true,
        },
        ended_at: started_at,
        stopped_by: StopReason::Request,
        time_base: None,
        rows,
        packets: 1,
        bytes: 1,
        seconds: 0.0,
        undecodable: 0,
        gaps: Vec::new(),
        recordings: Vec::new(),
        columns: Vec::new(),
    }
}

/// In an empty folder.
fn in_folder(act: impl FnOnce(&Path)) {
    FOLDER.with(|folder| {
        clean(folder.path(), Path::new(""));
        act(folder.path());
    });
}

fn files(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).expect("a folder of our own").flatten().map(|entry| entry.path()).collect()
}

/// Removes every file but one and its sidecar.
fn clean(folder: &Path, but: &Path) {
    for file in files(folder) {
        if file != but && file != sidecar_path(but) {
            fs::remove_file(file).expect("a file of our own");
        }
    }
}
