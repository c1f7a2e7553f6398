//! What is said of recordings, in English.

use std::path::Path;

english_texts! { recorder:
    RecordingController: "Controller";
    RecordingData: "Data";
    RecordingStarted: "Started";
    RecordingEnded: "Ended";
    RecordingStoppedBy: "Ended by";
    RecordingSeconds: "Length";
    RecordingRows: "Rows";
    RecordingPackets: "Packets";
    RecordingMissing: "Missing";
    RecordingGaps: "Gaps";
    RecordingForce: "Force sensor";
    RecordingMotion: "Motion log";
    StopRequest: "a request";
    StopDuration: "the given time";
    StopSize: "the given size";
    StopFooter: "the end of the force sensor recording";
    StopError: "an error";
    StopKilled: "the end of the program";
    GapOverwritten: "overwritten in the controller";
    GapBrokenOff: "broken off by the controller";
    GapConnectionLost: "connection lost";
    GapUnexplained: "not explained by the controller";
    GapRestarted: "controller restarted";
    GapUndecodable: "packet that cannot be read";
}

pub fn recording_started(name: &str, file: &Path) -> String {
    format!("{name}: recording into {}; Ctrl-C ends it", file.display())
}

pub fn recording_recovered(file: &Path, rows: u64) -> String {
    format!("A recording that was broken off is complete now: {}, {rows} rows", file.display())
}

pub fn recording_ended(file: &Path, rows: u64, missing: u64, gaps: usize) -> String {
    match gaps {
        0 => format!("{}: {rows} rows, nothing missing", file.display()),
        1 => format!("{}: {rows} rows, {missing} blocks or records missing in 1 gap", file.display()),
        gaps => format!("{}: {rows} rows, {missing} blocks or records missing in {gaps} gaps", file.display()),
    }
}
