//! `record` from the command line, against virtual controllers whose robots move.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde_json::Value;

use crate::common::command_line_test::{CommandLineTest, DONE, assert_error, walk};
use crate::common::process::Running;

struct Line {
    cli: CommandLineTest,
    data: tempfile::TempDir,
    output: PathBuf,
}

impl Line {
    /// A running server that takes anonymous clients and trusts this program.
    fn start() -> Self {
        let data = tempfile::tempdir().unwrap();
        let cli = CommandLineTest::with(
            1,
            &["--seed", "3", "--firmware", "current", "--data", &data.path().display().to_string()],
        );
        assert_eq!(cli.add(0, "cell1").0, Some(0));
        let subject = ["--country", "JP", "--state", "Nagano", "--locality", "Suwa", "--organisation", "Example"];
        assert_eq!(cli.json(&[&["cert", "self-signed"][..], &subject, &["--yes", "--all"]].concat()).0, Some(0));
        let settings = ["--policies", "Basic256Sha256", "--tokens", "anonymous", "--yes", "--all"];
        assert_eq!(cli.json(&[&["settings", "set"][..], &settings].concat()).0, Some(0));
        let output = cli.folder.path().join("recordings");
        Self { cli, data, output }
    }

    fn start_server(&self) {
        assert_eq!(self.cli.json(&["start", "--all"]).0, Some(0));
    }

    fn arguments<'a>(&'a self, more: &[&'a str]) -> Vec<&'a str> {
        [&["record"][..], more, &["--yes", "--output", self.output.to_str().unwrap(), "cell1"]].concat()
    }

    fn record(&self, more: &[&str]) -> (Option<i32>, Vec<Value>) {
        self.cli.json(&self.arguments(more))
    }

    fn record_in_background(&self, more: &[&str]) -> Running {
        Running::start(self.cli.command().arg("--json").args(self.arguments(more))).unwrap()
    }

    fn act(&self, command: &str) {
        let data = self.data.path().display().to_string();
        let done = self.cli.run(&["virtual", "cell", "--data", &data, "--do", command, "--all"]);
        assert_eq!(done.code, Some(0), "{}{}", done.stdout, done.stderr);
    }

    /// Waits until a file with this extension has more than so many bytes.
    fn wait_for_file(&self, extension: &str, bytes: u64) -> PathBuf {
        let until = Instant::now() + DONE;
        loop {
            let files = if self.output.is_dir() { walk(&self.output) } else { Vec::new() };
            let found = files.into_iter().find(|file| {
                file.extension().is_some_and(|found| found == extension)
                    && file.metadata().is_ok_and(|metadata| metadata.len() > bytes)
            });
            if let Some(file) = found {
                return file;
            }
            assert!(Instant::now() < until, "no .{extension} file with {bytes} bytes");
            std::thread::sleep(Duration::from_millis(50));
        }
    }
}

fn rows(csv: &Path) -> usize {
    std::fs::read_to_string(csv).unwrap().lines().count() - 1
}

#[test]
fn a_motion_log_is_recorded_shown_converted_and_survives_a_kill() {
    let line = Line::start();
    let (code, lines) = line.record(&["motion", "--duration", "2"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "server-not-running");
    line.start_server();
    let (code, lines) = line.record(&["motion", "--duration", "2"]);
    assert_eq!(code, Some(1));
    assert_error(&lines, "configurator-not-trusted");

    let (code, lines) = line.record(&["motion", "--trust-me", "--duration", "2", "--keep-packets"]);
    assert_eq!(code, Some(0), "{lines:?}");
    let result = &lines[0]["result"];
    let file = Path::new(result["file"].as_str().unwrap());
    let recording = &result["recording"];
    assert_eq!(recording["stopped_by"], "duration", "{recording}");
    assert_eq!(rows(file) as u64, recording["rows"].as_u64().unwrap());
    assert!(recording["rows"].as_u64().unwrap() > 8 && recording["undecodable"] == 0, "{recording}");
    let (code, shown) = line.cli.json(&["record", "show", file.to_str().unwrap()]);
    assert_eq!((code, &shown[0]["result"]), (Some(0), recording));
    let told = line.cli.run(&["--lang", "zh", "record", "show", file.to_str().unwrap()]);
    assert!(told.stdout.contains("机器人控制信息") && told.stdout.contains("到达指定时间"), "{}", told.stdout);

    let packets = result["packets"].as_str().unwrap();
    let again = line.cli.file("again.csv");
    let (code, converted) = line.cli.json(&["record", "convert", packets, &again]);
    assert_eq!((code, &converted[0]["result"]["recording"]), (Some(0), recording));
    assert_eq!(std::fs::read(&again).unwrap(), std::fs::read(file).unwrap());
    let (parquet, third) = (line.cli.file("other.parquet"), line.cli.file("third.csv"));
    for (from, to) in [(&again, &parquet), (&parquet, &third)] {
        let (code, converted) = line.cli.json(&["record", "convert", from, to]);
        assert_eq!((code, &converted[0]["result"]["recording"]), (Some(0), recording));
    }
    assert_eq!(std::fs::read(&third).unwrap(), std::fs::read(file).unwrap());
    std::fs::write(&third, "Time,Value\r\n1,2\r\n").unwrap();
    let (code, refused) = line.cli.json(&["record", "convert", &third, &line.cli.file("fourth.csv")]);
    assert_eq!(code, Some(2));
    assert_error(&refused, "file-format");

    std::fs::remove_dir_all(&line.output).unwrap();
    let recorder = line.record_in_background(&["motion", "--format", "parquet"]);
    let left = line.wait_for_file("packets", 60_000);
    // Killed: nothing is finished.
    drop(recorder);
    assert!(left.exists() && !left.with_extension("parquet").exists());
    let told = line.cli.run(&line.arguments(&["motion", "--duration", "1"]));
    assert!(told.code == Some(0) && told.stderr.contains("was broken off is complete now"), "{}", told.stderr);
    assert!(!left.exists() && left.with_extension("parquet").exists());
    let (_, shown) = line.cli.json(&["record", "show", left.with_extension("parquet").to_str().unwrap()]);
    assert_eq!(shown[0]["result"]["stopped_by"], "killed", "{shown:?}");
}

#[test]
fn a_force_recording_runs_from_record_start_to_its_footer() {
    let line = Line::start();
    line.start_server();
    let recorder = line.record_in_background(&["force", "--trust-me", "--data-type", "2"]);
    line.wait_for_file("csv", 0);
    line.act("record-start 1 0.5 0.01");
    let finished = recorder.finish(DONE);
    assert_eq!(finished.code, Some(0), "{}{}", finished.stdout, finished.stderr);
    let result: Value = serde_json::from_str(&finished.stdout).unwrap();
    let recording = &result["result"]["recording"];
    assert_eq!(
        (&recording["stopped_by"], &recording["gaps"]),
        (&"footer".into(), &serde_json::json!([])),
        "{recording}"
    );
    assert_eq!(recording["recordings"].as_array().unwrap().len(), 1, "{recording}");
    assert_eq!(recording["recordings"][0]["end_condition"], 0, "{recording}");
    let records = recording["rows"].as_u64().unwrap();
    assert!((50..=51).contains(&records), "0.5 s at 10 ms: {records}");
    let file = Path::new(result["result"]["file"].as_str().unwrap());
    let csv = std::fs::read_to_string(file).unwrap();
    assert!(csv.starts_with("OPCUACommonID,Count,ElapsedTime [ms],Fx [N],"), "{}", csv.lines().next().unwrap());
}
