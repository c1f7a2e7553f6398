//! What the command line records, read by pandas from CSV and Parquet, is value by value what the simulated cell recorded.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use opcua_configurator::records::force::{AllData, ForceData};
use opcua_configurator::virtual_controller::cell::{CellCommand, CellRecord, ForceRecording, RecordedPacket};
use serde_json::{Value, json};
use tokio::task::block_in_place;

use super::open_server::OpenServer;
use super::peers::{Python, answer};
use super::sample_programs::{assert_same, block_row, sample_row};
use crate::common::command_line_test::program;
use crate::common::process::Running;
use crate::common::test_fleet::PASSWORD;

const WAIT: Duration = Duration::from_secs(90);
const FORMATS: [&str; 2] = ["csv", "parquet"];

#[tokio::test(flavor = "multi_thread")]
async fn pandas_reads_every_value_of_a_motion_log() {
    let Some(python) = Python::find_with("recordings.py", "pandas pyarrow") else { return };
    let server = OpenServer::start().await;
    let recorder = Recorder::new(&server);
    for format in FORMATS {
        server.keep_record();
        let recorded = block_in_place(|| {
            let arguments = ["motion", "--sampling-interval", "0", "--duration", "2", "--format", format];
            recorder.finish(recorder.start(&arguments))
        });
        let record = server.cell().record().expect("a record");
        let blocks: Vec<Vec<Value>> = record
            .packets()
            .filter_map(|packet| match packet {
                RecordedPacket::MotionBlock(block) => Some(block_row(block)),
                _ => None,
            })
            .collect();
        assert!(blocks.len() > 40, "{} blocks", blocks.len());
        recorder.compare(&python, &recorded, &blocks);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn pandas_reads_every_value_of_a_force_recording() {
    let Some(python) = Python::find_with("recordings.py", "pandas pyarrow") else { return };
    let server = OpenServer::start().await;
    let recorder = Recorder::new(&server);
    for format in FORMATS {
        server.keep_record();
        let recorded = block_in_place(|| {
            let running = recorder.start(&["force", "--data-type", "0", "--format", format]);
            recorder.wait_until_it_records();
            let recording = ForceRecording { robot: 1, duration: 1.0, interval: 0.002 };
            server.cell().command(CellCommand::RecordStart(recording)).expect("RecordStart");
            recorder.finish(running)
        });
        let record = server.cell().record().expect("a record");
        let rows = force_rows(&record);
        // The program of the cell may have begun a shorter recording before.
        assert!(rows.len() > 50, "{} records", rows.len());
        recorder.compare(&python, &recorded, &rows);
        assert_headers(&recorded["recording"]["recordings"], &record);
    }
}

fn force_rows(record: &CellRecord) -> Vec<Vec<Value>> {
    let row = |data: &AllData| {
        let mut row = vec![json!(data.head.id), json!(data.head.count), json!(data.head.elapsed)];
        row.extend(sample_row(data));
        row
    };
    let data = record.packets().filter_map(|packet| match packet {
        RecordedPacket::ForceData(1, data) => Some(data),
        _ => None,
    });
    let rows = data.map(|data| match &**data {
        ForceData::All(data) => row(data),
        other => panic!("a record of the data type {:?}", other.data_type()),
    });
    rows.collect()
}

/// The sidecar has what header and footer said.
fn assert_headers(told: &Value, record: &CellRecord) {
    let mut told = told.as_array().expect("recordings").iter();
    let mut last = None;
    for packet in record.packets() {
        match packet {
            RecordedPacket::ForceHeader(1, packet) => {
                let (h, told) = (packet.header, told.next().expect("a recording for each header"));
                last = Some(told);
                assert_eq!(told["id"], h.id);
                assert_eq!(told["interval"].as_f64().map(|interval| interval as f32), Some(h.interval));
                assert_eq!(told["record_start_ticks"].as_u64(), packet.record_start.map(|ticks| ticks.0));
                assert_eq!((&told["robot_no"], &told["sensor_no"]), (&json!(h.robot_no), &json!(h.sensor_no)));
                for (name, label) in [
                    ("robot_name", h.robot_name.to_string()),
                    ("sensor_serial", h.sensor_serial.to_string()),
                    ("sensor_label", h.sensor_label.to_string()),
                    ("file_name", h.file_name.to_string()),
                ] {
                    assert_eq!(told[name], label);
                }
            }
            RecordedPacket::ForceFooter(1, footer) => {
                let told = last.expect("a header before the footer");
                assert_eq!(told["end_condition"], footer.end_condition.number());
                assert_eq!(told["error_no"], footer.error_no);
            }
            _ => {}
        }
    }
    assert_eq!(told.count(), 0, "more recordings than headers");
}

/// The command line with a workspace that knows the controller.
struct Recorder {
    folder: tempfile::TempDir,
}

impl Recorder {
    fn new(server: &OpenServer) -> Self {
        let recorder = Self { folder: tempfile::tempdir().expect("a temporary folder") };
        fs::write(recorder.folder.path().join("password"), PASSWORD).expect("the password's file");
        let ready = server.fleet.controller(0).ready_line();
        let (series, fingerprint) = (ready.series.to_string(), ready.fingerprint.to_string());
        let mut add = recorder.command();
        add.args(["controllers", "add", "cell", &ready.management, "--series", &series, "--fingerprint", &fingerprint]);
        block_in_place(|| {
            let finished = Running::start(&mut add).expect("the program itself").finish(WAIT);
            assert_eq!(finished.code, Some(0), "{}{}", finished.stdout, finished.stderr);
        });
        recorder
    }

    fn command(&self) -> Command {
        let mut command = program();
        command.arg("--json").arg("--workspace").arg(self.folder.path().join("workspace"));
        command.arg("--connection-password-file").arg(self.folder.path().join("password"));
        command
    }

    fn output(&self) -> PathBuf {
        self.folder.path().join("recordings")
    }

    fn start(&self, arguments: &[&str]) -> Running {
        let _ = fs::remove_dir_all(self.output());
        let mut command = self.command();
        command.arg("record").args(arguments).args(["--trust-me", "--yes", "--output"]).arg(self.output()).arg("cell");
        Running::start(&mut command).expect("the program itself")
    }

    /// The journal is made once the recorder is connected and has written its settings.
    fn wait_until_it_records(&self) {
        let until = Instant::now() + WAIT;
        let has_begun = || {
            let files = fs::read_dir(self.output()).into_iter().flatten().flatten();
            files.into_iter().any(|file| file.path().extension().is_some_and(|extension| extension == "packets"))
        };
        while !has_begun() {
            assert!(Instant::now() < until, "the recorder does not begin");
            std::thread::sleep(Duration::from_millis(20));
        }
    }

    /// What the recorder told at its end.
    fn finish(&self, running: Running) -> Value {
        let finished = running.finish(WAIT);
        assert_eq!(finished.code, Some(0), "{}{}", finished.stdout, finished.stderr);
        let told: Value = serde_json::from_str(finished.stdout.trim()).expect("a line of JSON");
        assert_eq!(told["ok"], true, "{told}");
        assert_eq!(told["result"]["recording"]["gaps"], json!([]), "{told}");
        told["result"].clone()
    }

    fn compare(&self, python: &Python, recorded: &Value, expected: &[Vec<Value>]) {
        let file = Path::new(recorded["file"].as_str().expect("a path"));
        let output = self.folder.path().join("as pandas reads it");
        let read = block_in_place(|| answer(python.script("recordings.py").arg(file).arg(&output)));
        assert_eq!(read["ok"], true, "{read}");
        let lines: Vec<String> =
            fs::read_to_string(output).expect("what was read").lines().map(str::to_owned).collect();
        assert_same(&lines, expected);
    }
}
