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
    Recorder: "Recorder…";
    RecorderTip: "Records force sensor or motion log data of controllers into files, and plots it meanwhile";
    RecorderTitle: "Recorder";
    RecorderMotionTip: "Encoders, currents, speeds, I/O, force sensor and tool center point of firmware 8.0.0 and later";
    RecorderForceTip: "What the program records between RecordStart and RecordEnd";
    RecorderInterval: "SamplingInterval";
    RecorderIntervalTip: "The sampling period is the shortest one times this factor. At the shortest period, a slow network can lose data.";
    RecorderMonitor: "Monitor";
    RecorderMonitorTip: "2 is that of a second RecordStart that runs at the same time";
    RecorderDataType: "DataType";
    ForceDataAll: "forces, torques, positions, references, speeds, joints, overload rates";
    ForceDataMotion: "positions, speeds, joints, overload rates";
    ForceDataForce: "forces, torques, positions";
    ForceDataPosition: "positions only";
    RecorderDataNum: "DataNum";
    RecorderDataNumHint: "0: the controller decides";
    RecorderDataNumText: "Blocks or records that one read brings at most. A low number can lose data.";
    RecorderBlocksRule: "A whole number from 0 to 200";
    RecorderRecordsRule: "A whole number from 0 to 65535";
    RecorderPortText: "Port is set for the recording: the controller sends force sensor data to OPC UA and not to RC+ until the recording ends. Start the recording before RecordStart.";
    RecorderFiles: "Files";
    RecorderFolder: "Folder";
    RecorderFolderTitle: "Folder for recordings";
    RecorderFolderRule: "Type the path of a folder";
    RecorderFormat: "Format";
    RecorderCsvTip: "Text with a line a row; readable while it is written";
    RecorderParquetTip: "Columns for pandas and other tools; small, and readable once the recording has ended";
    RecorderKeepPackets: "Keep the packets as well";
    RecorderKeepPacketsTip: "A .packets file with everything as it came; it can be opened and converted later";
    RecorderEnds: "Each recording ends by itself after";
    RecorderSeconds: "Time (s)";
    RecorderMegabytes: "Size of the packets (MB)";
    RecorderFooters: "Force sensor recordings";
    RecorderNoLimit: "no limit";
    RecorderLimitRule: "A whole number from 1 on, or nothing";
    RecorderLogin: "Login to the OPC UA server, with the certificate of this configurator";
    RecorderAnonymous: "Empty: anonymous";
    RecorderStart: "Start recording";
    RecorderStop: "Stop recording";
    RecorderStopOne: "Stop";
    RecorderStopTip: "Ends this recording and completes its files";
    RecorderShow: "Show";
    RecorderAgain: "New recording";
    RecorderRetryTip: "Starts every recording again that failed";
    RecorderChooseTip: "The values of the chosen controller are plotted below";
    RecorderState: "State";
    RecorderStateTip: "What the recording is doing";
    RecorderRowsTip: "Rows of the file: force sensor records, or eight of each motion log block";
    RecorderMissingTip: "Blocks or records that did not come, as far as it is known";
    RecorderWarnings: "Warnings";
    RecorderWarningsTip: "How often the controller has overwritten data that was not read in time, and packets that cannot be read";
    RecorderSize: "File size";
    RecorderSizeTip: "Bytes of the CSV or Parquet file that are written; the packets are safe each second";
    RecorderFinding: "Looking for the server";
    RecorderWaiting: "Waiting for the controller to record";
    RecorderRunning: "Recording";
    RecorderReconnecting: "Connecting again";
    RecorderFinishing: "Completing the files";
    RecorderGoesOn: "Recordings go on while this dialog is closed. The status bar leads back to it.";
    RecorderBackTip: "Opens the recorder with these recordings";
    RecorderNoValues: "No values have come yet";
    RecorderNoValuesEnded: "There are no values of these quantities";
    RecorderPlotsFull: "Four plots are shown at most. Take one away first.";
    RecorderWhole: "Everything";
    RecorderWholeTip: "Shows the whole time (Home, or a double click)";
    RecorderPauseTip: "Keeps the time that is shown (P); the recording goes on";
    RecorderFollowTip: "Follows the newest values again (P)";
    RecorderZoomIn: "Zoom in";
    RecorderZoomOut: "Zoom out";
    RecorderPlotKeys: "Drag or arrow keys: move. Mouse wheel, plus and minus: zoom. Home or double click: everything. P: pause.";
    RecorderColumnTip: "Leaves the line out, or draws it again";
    OpenRecording: "Open recording…";
    OpenRecordingTip: "Shows what a recording holds, and plots its values";
    OpenRecordingTitle: "Recording";
    OpenRecordingText: "A CSV or Parquet file of the recorder with the .json file beside it, or a .packets file. A file can also be dropped onto the window.";
    OpenRecordingNow: "Open";
    RecordingFile: "File";
    KindRecording: "Recording of the force sensor or the motion log";
    CloseRecordings: "Recordings are going on. They end now, and each file is completed before the window closes.";
    CloseStopRecordings: "Stop recording, then close";
    CloseCompleting: "The window closes when the files of the recordings are complete.";
    QuantityForces: "Forces";
    QuantityTorques: "Torques";
    QuantityPosition: "Position";
    QuantityOrientation: "Orientation";
    QuantityReferencePosition: "Reference position";
    QuantityReferenceOrientation: "Reference orientation";
    QuantityCorrection: "Correction";
    QuantitySpeed: "Tool speed";
    QuantityJoints: "Joints";
    QuantityOverload: "Overload rates";
    QuantityProgram: "Step and sequence";
    QuantityEncoderPositions: "Encoder positions";
    QuantityEncoderTemperatures: "Encoder temperatures";
    QuantityDirectCurrents: "Currents (d axis)";
    QuantityQuadratureCurrents: "Currents (q axis)";
    QuantityMotorSpeeds: "Motor speeds";
    QuantityElectricalAngles: "Electrical angles";
    QuantityInputsOutputs: "I/O";
    QuantitySensorCounts: "Force sensor";
    QuantityPulseCounters: "Pulse counters";
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

pub fn recording_end(reason: &str) -> String {
    format!("Ended by {reason}")
}

pub fn recording_missing(missing: u64, gaps: u64) -> String {
    match (missing, gaps) {
        (_, 0) => "0".to_owned(),
        (0, 1) => "? in 1 gap".to_owned(),
        (0, gaps) => format!("? in {gaps} gaps"),
        (missing, 1) => format!("{missing} in 1 gap"),
        (missing, gaps) => format!("{missing} in {gaps} gaps"),
    }
}

pub fn recording_gaps(gaps: usize) -> String {
    if gaps == 1 { "1 gap".to_owned() } else { format!("{gaps} gaps") }
}

pub fn recording_gap(row: u64, missing: Option<u64>, cause: &str) -> String {
    match missing {
        Some(missing) => format!("Row {row}: {missing} missing, {cause}"),
        None => format!("Row {row}: an unknown number missing, {cause}"),
    }
}

pub fn recording_range(from: f64, to: f64) -> String {
    format!("{from:.3} s to {to:.3} s")
}

pub fn recordings_running(count: usize) -> String {
    format!("Recording: {count}")
}

pub fn recordings_ended(failed: usize) -> String {
    match failed {
        0 => "Recordings ended".to_owned(),
        failed => format!("Recordings ended, {failed} failed"),
    }
}
