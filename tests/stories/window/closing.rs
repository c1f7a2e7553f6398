//! Closing the window, and ending a command, while controllers are being changed.

use std::time::Duration;

use egui::{ViewportCommand, ViewportEvent, ViewportId};
use opcua_configurator::jobs::JobStep;
use opcua_configurator::ui::backend::{Backend, BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::Closing;
use opcua_configurator::ui::model::RowState;
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::{Configuration, Workspace};

#[cfg(unix)]
use crate::common::process;
use crate::common::test_fleet::{self, TestFleet};
use crate::common::window::{SIZE, agree, choose, is_enabled, shows, type_into, wait_until, window};
use crate::common::window_test::{WAIT_LIMIT, WindowTest};

type Window<B> = crate::common::window::Window<B>;

/// Presses the window's close button.
pub(super) fn close<B: Backend>(window: &mut Window<B>) {
    let root = window.input_mut().viewports.entry(ViewportId::ROOT).or_default();
    root.events.push(ViewportEvent::Close);
    window.step();
}

fn commands<B: Backend>(window: &Window<B>) -> &[ViewportCommand] {
    &window.output().viewport_output[&ViewportId::ROOT].commands
}

/// Whether the window goes on its own account.
pub(super) fn closes<B: Backend>(window: &Window<B>) -> bool {
    commands(window).contains(&ViewportCommand::Close)
}

fn stays_open<B: Backend>(window: &Window<B>) -> bool {
    commands(window).contains(&ViewportCommand::CancelClose)
}

impl WindowTest {
    /// Two legacy controllers, one after the other; a signing request is just being put into the first. Its former
    /// CA-signed certificate is invalid from then on, and its new key is only on this computer until it is saved.
    fn making_signing_requests() -> Self {
        let mut app = Self::with_controllers(2, FleetFirmware::Legacy);
        app.window.state_mut().model.options.parallelism = 1;
        app.window.state_mut().model.options.backup = true;
        app.tick(&["cell 1", "cell 2"]);
        choose(&mut app.window, &["Certificate", "Create and save", "CA signed…"]);
        app.click("Create CSR…");
        wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Create and save"));
        type_into(&mut app.window, "Organisation", "Example");
        app.click("Create and save");
        app.fleet.controller(0).faults().update(|faults| faults.latency = Duration::from_secs(1));
        agree(&mut app.window);
        wait_until(&mut app.window, WAIT_LIMIT, |window| {
            let job = window.state().model.job.as_ref();
            job.is_some_and(|job| job.rows[0].state == RowState::Step(JobStep::Apply))
        });
        close(&mut app.window);
        assert!(stays_open(&app.window), "closed in the middle of a change");
        wait_until(&mut app.window, WAIT_LIMIT, |window| shows(window, "Close the window?"));
        app
    }
}

/// Whether the request and its key were saved on this computer, and whether the controller holds the request.
fn has_request(fleet: &TestFleet, workspace: &Workspace, index: usize) -> (bool, bool) {
    let controller = fleet.controller(index);
    let (files, serial) = (workspace.certificate_files(), controller.info().serial);
    let key = files.ca_signed_folder(&serial).join("3_key.pfx");
    let saved = key.exists() && files.csr_folder(&serial).join("3_csr.der").exists();
    (saved, controller.state().csr.is_some())
}

fn have_requests(app: &WindowTest) -> [(bool, bool); 2] {
    [0, 1].map(|index| has_request(&app.fleet, &app.workspace, index))
}

#[test]
fn the_window_closes_when_the_job_has_finished() {
    let mut app = WindowTest::making_signing_requests();
    app.click("Finish, then close");
    assert!(shows(&app.window, "The window closes when all controllers are done"));
    wait_until(&mut app.window, WAIT_LIMIT, closes);
    assert_eq!(app.window.state().model.job.as_ref().unwrap().summary.unwrap().done, 2);
    assert_eq!(have_requests(&app), [(true, true); 2]);
    close(&mut app.window);
    assert!(!stays_open(&app.window));
}

#[test]
fn the_window_closes_after_the_step_in_hand_and_its_key_is_saved() {
    let mut app = WindowTest::making_signing_requests();
    app.click("Stop after this step, then close");
    wait_until(&mut app.window, WAIT_LIMIT, closes);
    assert_eq!(have_requests(&app), [(true, true), (false, false)]);
}

#[test]
fn the_window_stays_if_that_is_chosen() {
    let mut app = WindowTest::making_signing_requests();
    app.click("Stay open");
    wait_until(&mut app.window, WAIT_LIMIT, |window| shows(window, "Completed"));
    assert_eq!(app.window.state().model.closing, None);
    assert!(!closes(&app.window));
}

#[test]
fn the_window_stays_to_show_a_failure() {
    let mut app = WindowTest::making_signing_requests();
    app.fleet.controller(1).faults().update(|faults| faults.disk_full = true);
    app.click("Finish, then close");
    wait_until(&mut app.window, WAIT_LIMIT, |window| shows(window, "1 failed"));
    assert!(!closes(&app.window) && !app.window.state().model.closes_when_idle());
}

#[test]
fn a_window_that_goes_without_asking_finishes_the_step_in_hand() {
    let WindowTest { window, fleet, workspace, folder: _folder, runtime: _runtime } =
        WindowTest::making_signing_requests();
    // The display server is gone.
    drop(window);
    assert_eq!(has_request(&fleet, &workspace, 0), (true, true));
}

#[test]
fn nothing_is_asked_when_only_something_is_read() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Legacy);
    app.fleet.controller(0).faults().update(|faults| faults.latency = Duration::from_secs(1));
    app.tick(&["cell 1"]);
    app.click("Get new information");
    close(&mut app.window);
    assert!(!stays_open(&app.window));
}

#[test]
fn the_system_is_not_asked_back() {
    let backend = RecordingBackend { unfinished_work: true, ..RecordingBackend::default() };
    let mut window = window(backend, Configuration::default(), SIZE);
    window.state_mut().backend.events.push_back(BackendEvent::StopRequested);
    window.step();
    assert_eq!(window.state().model.closing, Some(Closing::Stopping));
    close(&mut window);
    assert!(stays_open(&window));
    window.state_mut().backend.unfinished_work = false;
    window.step();
    assert!(closes(&window));
}

/// A service manager, and the terminal that is closed: the step in hand ends first, and the key made for it is saved.
#[test]
#[cfg(unix)]
fn a_command_that_is_asked_to_end_finishes_the_step_in_hand() {
    for signal in [libc::SIGTERM, libc::SIGHUP, libc::SIGINT] {
        let app = WindowTest::empty(2, FleetFirmware::Legacy);
        let password = app.folder.path().join("password");
        std::fs::write(&password, test_fleet::PASSWORD).unwrap();
        let command = || {
            let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_opcua-configurator"));
            command.env_remove("DBUS_SESSION_BUS_ADDRESS").arg("--json");
            command.arg("--workspace").arg(app.folder.path().join("command"));
            command.arg("--connection-password-file").arg(&password);
            command
        };
        for (index, name) in ["quick", "slow"].into_iter().enumerate() {
            let controller = app.fleet.controller(index);
            let (address, print) = (controller.management_address(), controller.fingerprint());
            let mut add = command();
            add.args(["controllers", "add", name, &address.to_string(), "--series", controller.series().as_str()]);
            add.args(["--fingerprint", &print.to_string(), "--password-file"]).arg(&password);
            assert_eq!(process::Running::start(&mut add).unwrap().finish(WAIT_LIMIT).code, Some(0));
        }
        assert_eq!(process::Running::start(command().args(["backup", "on"])).unwrap().finish(WAIT_LIMIT).code, Some(0));

        app.fleet.controller(1).faults().update(|faults| faults.latency = Duration::from_secs(3));
        let make = "cert csr --country JP --state Nagano --locality Suwa --organisation Example --yes quick slow";
        let job = process::Running::start(command().args(make.split(' '))).unwrap();
        let until = std::time::Instant::now() + WAIT_LIMIT;
        while app.fleet.controller(0).state().csr.is_none() {
            assert!(std::time::Instant::now() < until, "no request in the quick controller");
            std::thread::sleep(Duration::from_millis(5));
        }
        job.signal(signal);
        let finished = job.finish(WAIT_LIMIT);
        assert_eq!(finished.code, Some(1), "signal {signal}: {}", finished.stderr);
        let workspace = Workspace::new(app.folder.path().join("command"));
        assert_eq!(has_request(&app.fleet, &workspace, 0), (true, true), "{}", finished.stdout);
        assert_eq!(has_request(&app.fleet, &workspace, 1), (false, false), "{}", finished.stdout);
    }
}
