//! Recording force sensor and motion log data, and looking at recordings, through the real window.

use std::path::{Path, PathBuf};

use opcua_configurator::jobs::{StartServer, StopServer};
use opcua_configurator::model::SecurityPolicy;
use opcua_configurator::recorder::{GapCause, Quantity, RecordingPhase, Sidecar, StopReason, sidecar_path};
use opcua_configurator::ui::{ControllerRecording, RecorderForm, RecordingState, RecordingView};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::virtual_controller::cell::{CellCommand, ForceRecording};

use super::closing::{close, closes};
use crate::common::window::{choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest};

impl WindowTest {
    fn open_recorder(&mut self, names: &[&str]) {
        self.tick(names);
        choose(&mut self.window, &["Tools", "Recorder…"]);
    }

    fn recordings(&self) -> &[ControllerRecording] {
        &self.window.state().model.working::<RecorderForm>().expect("the recorder is there").recordings
    }

    fn wait_for_recordings(&mut self, holds: impl Fn(&ControllerRecording) -> bool) {
        wait_until(&mut self.window, WAIT_LIMIT, |window| {
            let form = window.state().model.working::<RecorderForm>();
            form.is_some_and(|form| !form.recordings.is_empty() && form.recordings.iter().all(&holds))
        });
    }

    /// Waits until the recording on display was read through.
    fn wait_for_opened(&mut self) -> Sidecar {
        let sidecar = |view: &RecordingView| view.opened.as_ref().and_then(|opened| opened.sidecar.clone());
        wait_until(&mut self.window, WAIT_LIMIT, |window| {
            window
                .state()
                .model
                .top::<RecordingView>()
                .is_some_and(|view| sidecar(view).is_some() && !view.is_reading())
        });
        *self.window.state().model.top::<RecordingView>().and_then(sidecar).unwrap()
    }

    /// Points of the columns that are plotted of the recording on display.
    fn plotted(&self) -> usize {
        let view = self.window.state().model.top::<RecordingView>().expect("a recording is shown");
        let values = view.opened.iter().flat_map(|opened| &opened.values);
        values
            .map(|loaded| loaded.values.read(|columns| columns.iter().map(|column| column.series.len()).sum::<usize>()))
            .sum()
    }
}

fn is_recording(recording: &ControllerRecording) -> bool {
    recording.state == RecordingState::At(RecordingPhase::Running) && recording.progress.rows > 200
}

fn has_ended(recording: &ControllerRecording) -> bool {
    matches!(recording.state, RecordingState::Ended(_))
}

/// Rows of a CSV file.
fn rows(csv: &Path) -> u64 {
    std::fs::read_to_string(csv).unwrap().lines().count() as u64 - 1
}

#[test]
fn a_motion_log_is_plotted_while_it_is_recorded_and_its_file_is_opened_again() {
    let mut app = WindowTest::with_trusting_server();
    let cell = app.fleet.controller(0).cell().clone();
    cell.command(CellCommand::MotionLogging(false)).unwrap();
    app.open_recorder(&["cell 1"]);
    type_into(&mut app.window, "DataNum", "201");
    assert!(!is_enabled(&app.window, "Start recording") && shows(&app.window, "A whole number from 0 to 200"));
    type_into(&mut app.window, "DataNum", "100");
    app.click("Start recording");
    app.wait_for("Waiting for the controller to record");
    cell.command(CellCommand::MotionLogging(true)).unwrap();
    app.wait_for_recordings(is_recording);
    // The robot's tool is plotted at first, other quantities when they are chosen.
    app.click("Encoder positions");
    let encoders = Quantity::EncoderPositions;
    app.wait_for_recordings(|recording| {
        recording.values.read(|columns| {
            columns.iter().any(|column| column.name == "ENC_1.ENC_POS" && column.series.len() > 100)
                && columns.iter().any(|column| column.name == "TCP.X" && column.series.len() > 10)
        })
    });
    assert!(shows(&app.window, "Encoder positions [pulses]") && shows(&app.window, "Position [mm]"), "{encoders:?}");
    app.click("Pause");
    assert!(shows(&app.window, "Follow"));
    app.click("Stop recording");
    app.wait_for_recordings(has_ended);
    assert!(shows(&app.window, "Ended by a request"));

    let recorded = app.recordings()[0].recorded.clone().unwrap();
    assert_eq!(rows(&recorded.file), recorded.sidecar.rows);
    assert!(recorded.file.starts_with(app.workspace.root().join("recordings")));
    app.click("Show");
    let sidecar = app.wait_for_opened();
    assert_eq!(sidecar, recorded.sidecar);
    assert!(shows(&app.window, &sidecar.rows.to_string()) && shows(&app.window, "a request"));
    let plotted = app.plotted() as u64;
    // Three coordinates and three angles, once for eight rows.
    assert_eq!(plotted, sidecar.rows / 8 * 6);
    app.click("Close");
    app.click("New recording");
    assert!(is_enabled(&app.window, "Start recording"));
    app.click("Cancel");
    assert!(app.window.state().model.dialogs.is_empty());
    opened_by_dropping(&mut app, &recorded.file);
}

/// A file that is dropped onto the window; what is wrong with it is told.
fn opened_by_dropping(app: &mut WindowTest, file: &PathBuf) {
    app.drop_files(std::slice::from_ref(file));
    let sidecar = app.wait_for_opened();
    assert_eq!(rows(file), sidecar.rows);
    app.click("Motor speeds");
    let columns = app.plotted() as u64;
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        window.state().model.top::<RecordingView>().is_some_and(|view| !view.is_reading())
    });
    assert!(app.plotted() as u64 > columns.max(sidecar.rows / 8 * 6), "the speeds are read as well");
    app.click("Close");

    let description = sidecar_path(file);
    let good = std::fs::read(&description).unwrap();
    std::fs::write(&description, &good[..good.len() / 2]).unwrap();
    app.drop_files(std::slice::from_ref(file));
    app.wait_for("The file has the wrong format");
    app.click("Close");
    std::fs::remove_file(&description).unwrap();
    app.drop_files(std::slice::from_ref(file));
    app.wait_for("The description of the recording is missing");
    app.click("Close");
    std::fs::write(&description, good).unwrap();

    // Not a recording, chosen by its path.
    let other = app.folder.path().join("other.packets");
    std::fs::write(&other, "hello").unwrap();
    choose(&mut app.window, &["Tools", "Open recording…"]);
    assert!(!is_enabled(&app.window, "Open"));
    type_into(&mut app.window, "File", &other.display().to_string());
    app.click("Open");
    app.wait_for("The file has the wrong format");
    type_into(&mut app.window, "File", &file.display().to_string());
    app.click("Open");
    app.wait_for_opened();
    assert!(!shows(&app.window, "The file has the wrong format"));
    app.click("Close");
}

#[test]
fn refused_by_two_controllers_trusted_and_completed_when_the_window_closes() {
    let mut app = WindowTest::with_servers(2, FleetFirmware::Current, &[SecurityPolicy::Basic256Sha256]);
    app.open_recorder(&["cell 1", "cell 2"]);
    app.click("Parquet");
    app.click("Keep the packets as well");
    app.click("Start recording");
    app.wait_for_recordings(|recording| recording.state.problem().is_some());
    assert!(shows(&app.window, "The OPC UA server does not trust this program"));
    app.click("Trust this configurator…");
    assert!(shows(&app.window, "is put into Trusted and stays there"));
    app.click("Trust");
    app.wait_for_recordings(is_recording);

    // The recordings go on without the dialog.
    app.click("Close");
    assert!(app.window.state().model.dialogs.is_empty() && shows(&app.window, "Recording: 2"));
    let before: Vec<u64> = app.recordings().iter().map(|recording| recording.progress.rows).collect();
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        let form = window.state().model.working::<RecorderForm>().unwrap();
        form.recordings.iter().zip(&before).all(|(recording, before)| recording.progress.rows > before + 500)
    });
    app.click("Recording: 2");
    assert!(shows(&app.window, "cell 1") && is_enabled(&app.window, "Stop recording"));
    app.click("Close");

    close(&mut app.window);
    assert!(!closes(&app.window));
    app.wait_for("Recordings are going on");
    app.click("Stay open");
    assert_eq!(app.window.state().model.active_recordings(), 2);
    close(&mut app.window);
    app.click("Stop recording, then close");
    wait_until(&mut app.window, WAIT_LIMIT, closes);
    for recording in app.recordings() {
        let recorded = recording.recorded.as_ref().unwrap();
        assert_eq!(recorded.sidecar.stopped_by, StopReason::Request);
        assert!(recorded.file.exists() && recorded.packets.as_ref().is_some_and(|packets| packets.exists()));
        assert_eq!(Sidecar::read(&recorded.sidecar_file).unwrap(), recorded.sidecar);
        assert!(recorded.sidecar.rows > 700 && recorded.sidecar.undecodable == 0);
    }
}

#[test]
fn a_force_recording_survives_a_lost_connection_and_ends_with_its_footer() {
    let mut app = WindowTest::with_trusting_server();
    let cell = app.fleet.controller(0).cell().clone();
    app.open_recorder(&["cell 1"]);
    app.click("Force sensor");
    assert!(shows(&app.window, "Start the recording before RecordStart"));
    app.click("2: forces, torques, positions");
    type_into(&mut app.window, "User name", "operator1");
    type_into(&mut app.window, "Password", "Wr0ngPassword");
    app.click("Start recording");
    app.wait_for("The OPC UA server refuses the login");
    app.click("New recording");
    type_into(&mut app.window, "Password", "Passw0rd1");
    // Without a limit: the program of the cell records now and then as well.
    type_into(&mut app.window, "Force sensor recordings", " ");
    app.click("Start recording");
    let record = CellCommand::RecordStart(ForceRecording { robot: 1, duration: 30.0, interval: 0.01 });
    app.wait_for_recordings(|recording| recording.file.is_some());
    cell.command(record).unwrap();
    app.wait_for_recordings(|recording| recording.progress.rows > 20);
    assert!(shows(&app.window, "Forces [N]") && shows(&app.window, "Torques [N·m]"));
    app.run(StopServer);
    app.wait_for("Connecting again");
    // Why.
    app.wait_for("The connection to the OPC UA server failed");
    let before = app.recordings()[0].progress.rows;
    app.run(StartServer);
    app.wait_for_recordings(|recording| recording.progress.rows > before + 20);
    app.click("Stop recording");
    app.wait_for_recordings(has_ended);
    let recorded = app.recordings()[0].recorded.clone().unwrap();
    assert!(
        recorded.sidecar.gaps.iter().any(|gap| gap.cause == GapCause::ConnectionLost),
        "{:?}",
        recorded.sidecar.gaps
    );

    app.click("New recording");
    type_into(&mut app.window, "Force sensor recordings", "1");
    app.click("Start recording");
    app.wait_for_recordings(has_ended);
    assert_eq!(app.recordings()[0].state, RecordingState::Ended(StopReason::Footer));
    assert!(shows(&app.window, "Ended by the end of the force sensor recording"));
    app.click("Close");
    assert!(app.window.state().model.dialogs.is_empty() && !shows(&app.window, "Recordings ended"));
}
