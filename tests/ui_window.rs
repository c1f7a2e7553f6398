//! An afternoon at the window: the real window, the real backend, virtual controllers over loopback.

mod common;
#[allow(dead_code, reason = "a story uses a part of it")]
#[path = "common/plant.rs"]
mod plant;

use std::sync::Arc;
use std::time::Duration;

use common::window::{SIZE, Window, choose, click, is_enabled, shows, type_into, wait_until, window_in};
use opcua_configurator::model::ServerStatus;
use opcua_configurator::ui::backend::{BackendOptions, TokioBackend};
use opcua_configurator::ui::model::{Dialog, Row};
use opcua_configurator::virtual_controller::{FleetFirmware, VirtualController};
use opcua_configurator::workspace::{Configuration, MemoryPasswords, Workspace};
use plant::{PASSWORD, Plant};

type W = Window<TokioBackend>;

const SOON: Duration = Duration::from_secs(60);

/// Somebody who has just installed the program.
struct Desk {
    window: W,
    workspace: Workspace,
    plant: Plant,
    runtime: tokio::runtime::Runtime,
    _folder: tempfile::TempDir,
}

impl Desk {
    fn start(controllers: usize, firmware: FleetFirmware) -> Self {
        let runtime = tokio::runtime::Runtime::new().unwrap();
        let plant = runtime.block_on(Plant::start(controllers, firmware));
        let folder = tempfile::tempdir().unwrap();
        let workspace = Workspace::new(folder.path());
        let options = BackendOptions {
            lock: workspace.lock().unwrap(),
            workspace: workspace.clone(),
            // Not the plant's: nothing is known here yet.
            passwords: Arc::new(MemoryPasswords::default()),
            connector: Arc::new(plant.connector),
            starter: None,
        };
        let backend = TokioBackend::new(options, || {}).unwrap();
        let window = window_in(workspace.clone(), backend, Configuration::default(), SIZE);
        Self { window, workspace, plant, runtime, _folder: folder }
    }

    fn controller(&self, index: usize) -> &VirtualController {
        self.plant.controller(index)
    }

    /// Fills the form and waits for the fingerprint.
    fn introduce(&mut self, index: usize, name: &str, password: &str) {
        let address = self.controller(index).management_address().to_string();
        choose(&mut self.window, &["Controller", "Add controller…"]);
        type_into(&mut self.window, "Name", name);
        type_into(&mut self.window, "IP address", &address);
        type_into(&mut self.window, "Connection password", password);
        click(&mut self.window, "Apply");
        wait_until(&mut self.window, SOON, |window| shows(window, "Is this your controller?"));
    }

    fn add(&mut self, index: usize, name: &str) {
        self.introduce(index, name, PASSWORD);
        click(&mut self.window, "It matches, add");
        wait_until(&mut self.window, SOON, |window| window.state().model.dialogs.is_empty());
    }

    fn row(&self, name: &str) -> &Row {
        let rows = self.window.state().model.rows.all();
        rows.iter().find(|row| row.entry.name.as_str() == name).expect("a row of this name")
    }

    /// Waits for the summary, which must be all good, and closes it.
    fn finish(&mut self, summary: &str) {
        wait_until(&mut self.window, SOON, |window| {
            window.state().model.job.as_ref().is_some_and(|job| job.summary.is_some())
        });
        assert!(shows(&self.window, summary), "{:?}", self.window.state().model.job);
        click(&mut self.window, "Close");
    }

    fn server_status(&self, name: &str) -> ServerStatus {
        self.row(name).info().expect("information").status
    }

    /// Closes the window; what was remembered.
    fn close(self) -> Configuration {
        let Self { window, workspace, plant, runtime, _folder } = self;
        drop(window);
        let configuration = workspace.load().unwrap().configuration;
        drop(plant);
        drop(runtime);
        configuration
    }
}

#[test]
fn from_an_empty_list_to_a_secured_server() {
    let mut desk = Desk::start(2, FleetFirmware::Mixed);
    desk.add(0, "Weld 1");
    desk.add(1, "Weld 2");
    assert_eq!(desk.row("Weld 1").info().unwrap().serial, desk.controller(0).serial());

    // the same certificate fields for both
    click(&mut desk.window, "Tick all");
    choose(&mut desk.window, &["Certificate", "Create and save", "Self-signed…"]);
    type_into(&mut desk.window, "Organisation", "Example");
    click(&mut desk.window, "Apply");
    click(&mut desk.window, "OK");
    desk.finish("2 done");
    assert!(desk.row("Weld 1").not_after().is_some() && desk.row("Weld 2").not_after().is_some());

    // the same user for both, then one controller's list
    choose(&mut desk.window, &["Server settings", "Users…"]);
    type_into(&mut desk.window, "User name", "operator1");
    type_into(&mut desk.window, "Password", "Passw0rd1");
    click(&mut desk.window, "Add");
    click(&mut desk.window, "OK");
    desk.finish("2 done");
    click(&mut desk.window, "Tick Weld 2");
    choose(&mut desk.window, &["Server settings", "Users…"]);
    wait_until(&mut desk.window, SOON, |window| shows(window, "operator1"));
    click(&mut desk.window, "Close");

    // settings of the one, read first
    choose(&mut desk.window, &["Server settings", "Basic settings…"]);
    wait_until(&mut desk.window, SOON, |window| shows(window, "Basic256Sha256"));
    click(&mut desk.window, "AUTO");
    click(&mut desk.window, "Apply");
    click(&mut desk.window, "OK");
    desk.finish("1 done");

    // run it; nothing to click when all is well
    if desk.server_status("Weld 1") == ServerStatus::Run {
        click(&mut desk.window, "Stop");
        click(&mut desk.window, "OK");
        desk.finish("1 done");
        assert_eq!(desk.server_status("Weld 1"), ServerStatus::Stop);
    }
    click(&mut desk.window, "Start");
    wait_until(&mut desk.window, SOON, |window| window.state().model.job.is_none());
    assert!(desk.window.state().model.dialogs.is_empty());

    let remembered = desk.close();
    assert_eq!(remembered.controllers.len(), 2);
    assert!(remembered.find("Weld 1").unwrap().last.is_some());
}

#[test]
fn a_wrong_password_leads_back_to_the_form() {
    let mut desk = Desk::start(1, FleetFirmware::Current);
    desk.introduce(0, "Weld 1", "not this one");
    click(&mut desk.window, "It matches, add");
    wait_until(&mut desk.window, SOON, |window| shows(window, "The connection password is wrong"));
    type_into(&mut desk.window, "Connection password", PASSWORD);
    click(&mut desk.window, "Apply");
    wait_until(&mut desk.window, SOON, |window| shows(window, "It matches, add"));
    click(&mut desk.window, "It matches, add");
    wait_until(&mut desk.window, SOON, |window| window.state().model.dialogs.is_empty());
    assert_eq!(desk.close().controllers.len(), 1);
}

#[test]
fn a_controller_that_is_switched_off_is_explained() {
    let mut desk = Desk::start(2, FleetFirmware::Current);
    desk.add(0, "Weld 1");
    desk.add(1, "Weld 2");
    desk.runtime.block_on(desk.plant.controller(0).shutdown());
    click(&mut desk.window, "Tick all");
    click(&mut desk.window, "Get new information");
    wait_until(&mut desk.window, SOON, |window| shows(window, "1 done, 1 failed"));
    assert!(shows(&desk.window, "Switch the controller on, check the cable"));
    click(&mut desk.window, "Close");
    assert!(is_enabled(&desk.window, "Get new information"));
    assert!(!matches!(desk.window.state().model.dialogs.last(), Some(Dialog::Processing(_))));
}
