//! The program as it is started: time to the first frame, frames while nothing happens, memory of the idle window.
//!
//! Needs a display; `xvfb-run cargo bench --bench window` brings one.

use std::io::{BufRead as _, BufReader};
use std::process::{Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

const ROUNDS: usize = 7;
const TARGET: Duration = Duration::from_millis(150);
const IDLE: Duration = Duration::from_secs(3);

fn main() {
    if std::env::var_os("DISPLAY").is_none() && std::env::var_os("WAYLAND_DISPLAY").is_none() {
        println!("SKIPPED: no display; run it with `xvfb-run cargo bench --bench window`");
        return;
    }
    let mut first: Vec<Duration> = Vec::new();
    for _ in 0..ROUNDS {
        match round() {
            Some(round) => {
                println!(
                    "first frame {:?}, {} frames in {IDLE:?} of idleness, {} MB resident",
                    round.first, round.idle_frames, round.resident_mb
                );
                first.push(round.first);
            }
            None => println!("no frame was drawn: does the display offer OpenGL?"),
        }
    }
    first.sort();
    if let (Some(least), Some(most)) = (first.first(), first.last()) {
        let median = first[first.len() / 2];
        let ratio = median.as_secs_f64() / TARGET.as_secs_f64();
        println!(
            "time to first frame: {least:?} / {median:?} / {most:?} (min / median / max), {ratio:.2} of {TARGET:?}"
        );
    }
}

struct Round {
    first: Duration,
    idle_frames: usize,
    resident_mb: u64,
}

fn round() -> Option<Round> {
    let workspace = tempfile::tempdir().ok()?;
    let started = Instant::now();
    let mut window = Command::new(env!("CARGO_BIN_EXE_opcua-configurator"))
        .arg("--workspace")
        .arg(workspace.path())
        .env("RUST_LOG", "opcua_configurator::ui=trace")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .ok()?;
    let frames = lines(window.stderr.take()?);
    let first = frames.recv_timeout(Duration::from_secs(20)).ok().map(|at| at - started);
    // Opening, theme and fonts take a few frames more.
    std::thread::sleep(Duration::from_secs(2));
    while frames.try_recv().is_ok() {}
    std::thread::sleep(IDLE);
    let idle_frames = frames.try_iter().count();
    let resident_mb = resident(window.id()) / 1024;
    let _ended = window.kill().and_then(|()| window.wait());
    Some(Round { first: first?, idle_frames, resident_mb })
}

/// When each line came that tells of a frame.
fn lines(stderr: std::process::ChildStderr) -> Receiver<Instant> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        for line in BufReader::new(stderr).lines().map_while(Result::ok) {
            if line.contains("drawn") && sender.send(Instant::now()).is_err() {
                break;
            }
        }
    });
    receiver
}

/// Kilobytes, where the system tells.
fn resident(process: u32) -> u64 {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmRSS"));
    line.and_then(|line| line.split_whitespace().nth(1)).and_then(|kb| kb.parse().ok()).unwrap_or_default()
}
