//! The values of a controller's OPC UA server, through the real window.

use opcua_configurator::jobs::{StartServer, StopServer, TrustConfigurator};
use opcua_configurator::model::SecurityPolicy;
use opcua_configurator::model::opcua::{NodeId, Value};
use opcua_configurator::ui::{LiveConnection, LiveForm, LiveSection};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::virtual_controller::cell::{CellCommand, IoDirection, IoGroup, IoPort};

use crate::common::window::{choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest};

impl WindowTest {
    /// A running server that trusts this program.
    pub(super) fn with_trusting_server() -> Self {
        let app = Self::with_servers(1, FleetFirmware::Current, &[SecurityPolicy::Basic256Sha256]);
        app.run(TrustConfigurator { identity: app.workspace.own_identity() });
        app
    }

    fn open_live_values(&mut self) {
        self.tick(&["cell 1"]);
        choose(&mut self.window, &["Tools", "Live values…"]);
    }

    fn live(&mut self) -> &LiveForm {
        self.window.state_mut().model.dialog::<LiveForm>().expect("the dialog is open")
    }

    fn wait_for_link(&mut self, is_it: impl Fn(&LiveConnection) -> bool) {
        wait_until(&mut self.window, WAIT_LIMIT, |window| {
            window.state().model.top::<LiveForm>().is_some_and(|form| is_it(&form.link))
        });
    }

    /// Moves in the tree with the keyboard to the next node of this name below, or else to the last one above: servers
    /// list the children of a node in any order.
    fn select(&mut self, name: &str) {
        let browser = &self.live().browser;
        let from = browser.selected_line().map_or(0, |line| line + 1);
        let is_it = |line: &usize| browser.line(*line).is_some_and(|node| node.name == name);
        let below = (from..browser.line_count()).find(is_it).map(|line| (egui::Key::ArrowDown, line + 1 - from));
        let above = || (0..from).rev().find(is_it).map(|line| (egui::Key::ArrowUp, from - 1 - line));
        let (key, steps) = below.or_else(above).unwrap_or_else(|| panic!("no node {name}"));
        for _ in 0..steps {
            self.window.key_press(key);
            self.window.step();
        }
        assert!(shows(&self.window, name), "{name} is in sight");
    }

    /// Selects the next node of this name and unfolds it, and waits until what is below it is there.
    fn unfold(&mut self, name: &str) {
        self.select(name);
        let lines = self.live().browser.line_count();
        self.window.key_press(egui::Key::ArrowRight);
        wait_until(&mut self.window, WAIT_LIMIT, |window| {
            window.state().model.top::<LiveForm>().is_some_and(|form| form.browser.line_count() > lines)
        });
    }
}

#[test]
fn a_server_that_does_not_trust_this_program_is_told_to_and_then_shows_its_nodes() {
    let mut app = WindowTest::with_servers(1, FleetFirmware::Current, &[SecurityPolicy::Basic256Sha256]);
    app.open_live_values();
    app.wait_for("The OPC UA server does not trust this program");
    app.click("Trust this configurator…");
    assert!(shows(&app.window, "is put into Trusted and stays there"));
    app.click("Trust");
    app.wait_for_link(|link| *link == LiveConnection::Live);

    app.click("All nodes");
    app.wait_for("Objects");
    for name in ["Objects", "Server", "ServerStatus"] {
        app.unfold(name);
    }
    app.select("CurrentTime");
    app.wait_for("UtcTime");
    assert!(!is_enabled(&app.window, "Add to plot"), "a time is no number");
    app.select("State");
    app.wait_for("ServerState");
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Add to plot"));
    assert!(shows(&app.window, "Good"));
    assert!(!is_enabled(&app.window, "Write a value…"), "it can only be read");
    app.click("Add to plot");
    assert!(is_enabled(&app.window, "Remove from plot"));
    app.click("Plot");
    assert_eq!(app.live().section, LiveSection::Plot);
    assert!(shows(&app.window, "State"));
    app.click("Remove all");
    assert!(shows(&app.window, "Nothing is plotted yet"));
    app.click("Close");
    assert!(app.window.state().model.dialogs.is_empty());
}

#[test]
fn a_lost_connection_is_told_and_opened_again() {
    let mut app = WindowTest::with_trusting_server();
    app.open_live_values();
    app.wait_for_link(|link| *link == LiveConnection::Live);
    app.run(StopServer);
    app.wait_for_link(|link| matches!(link, LiveConnection::Lost(_)));
    assert!(shows(&app.window, "The values below are the last ones"));
    app.run(StartServer);
    app.wait_for_link(|link| *link == LiveConnection::Live);
    assert!(!shows(&app.window, "The values below are the last ones"));
    app.click("Close");
}

#[test]
fn a_user_logs_in_after_the_wrong_password() {
    let mut app = WindowTest::with_trusting_server();
    app.open_live_values();
    app.wait_for_link(|link| *link == LiveConnection::Live);
    app.click("Anonymous");
    type_into(&mut app.window, "User name", "operator1");
    assert!(!is_enabled(&app.window, "Connect"), "half a login");
    type_into(&mut app.window, "Password", "Wr0ngPassword");
    app.click("Connect");
    app.wait_for("The OPC UA server refuses the login");
    type_into(&mut app.window, "Password", "Passw0rd1");
    app.click("Connect");
    app.wait_for_link(|link| *link == LiveConnection::Live);
    assert!(shows(&app.window, "User operator1"));
    app.click("Close");
}

#[test]
fn robots_safety_and_signals_are_shown_as_they_change() {
    let mut app = WindowTest::with_trusting_server();
    app.open_live_values();
    app.wait_for_link(|link| *link == LiveConnection::Live);
    let robots = app.live().layout.as_ref().map(|layout| layout.robots.clone()).unwrap();
    let axes = &robots[0].axes;
    assert!(axes.len() >= 4 && axes.iter().all(|axis| axis.position.as_ref().is_some_and(|p| p.range.is_some())));
    let position = axes[0].position.as_ref().unwrap().node.clone();
    let mut seen = std::collections::BTreeSet::new();
    // The program of the cell moves the robot two seconds after power-on.
    let end = std::time::Instant::now() + WAIT_LIMIT;
    while seen.len() < 3 {
        assert!(std::time::Instant::now() < end, "the robot stands still: {seen:?}");
        app.window.step();
        seen.extend(app.live().value(&position).map(|value| value.value.to_string()));
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert!(shows(&app.window, " °") && shows(&app.window, "Tool center point"));

    app.click("Safety and tasks");
    app.wait_for("Automatic");
    assert!(!shows(&app.window, "Active"));
    app.fleet.controller(0).cell().command(CellCommand::EmergencyStop(true)).unwrap();
    app.wait_for("Active");

    app.click("I/O");
    app.wait_for("Bit 5: off");
    let cell = app.fleet.controller(0).cell().clone();
    let is_input = |port: &IoPort| port.group == IoGroup::Standard && port.direction == IoDirection::Input;
    let port = cell.description().io.iter().position(is_input).unwrap();
    cell.command(CellCommand::SetBit { port, offset: 5, on: true }).unwrap();
    app.wait_for("Bit 5: on");
    app.click("Consumables");
    app.wait_for("Battery");
    app.click("Status");
    app.wait_for("EStop: On");
    app.click("Close");
}

#[test]
fn a_setting_is_written_on_purpose_and_the_data_of_a_queue_is_left_alone() {
    let mut app = WindowTest::with_trusting_server();
    let cell = app.fleet.controller(0).cell().clone();
    cell.keep_record(10);
    cell.command(CellCommand::MotionLogging(true)).unwrap();
    app.open_live_values();
    app.wait_for_link(|link| *link == LiveConnection::Live);
    app.click("All nodes");
    app.wait_for("Objects");
    for name in ["Objects", "DeviceSet", "MotionDeviceSystem_0", "Controllers", "Controller_0", "Components"] {
        app.unfold(name);
    }
    app.unfold("MotionLogSystem");
    app.select("DataNum");
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Write a value…"));
    app.click("Write a value…");
    type_into(&mut app.window, "New value", "many");
    assert!(!is_enabled(&app.window, "Write") && shows(&app.window, "Not a value of the type UInt16"));
    type_into(&mut app.window, "New value", "300");
    app.click("Write");
    app.wait_for("outside the permitted range");
    type_into(&mut app.window, "New value", "20");
    app.click("Write");
    let data_num = NodeId::numeric(1, 20_313);
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        let form = window.state().model.top::<LiveForm>();
        form.and_then(|form| form.value(&data_num)).is_some_and(|value| value.value == Value::UInt16(20))
    });

    app.unfold("MotionLog_1");
    app.select("Data");
    app.wait_for("each read takes it away");
    assert!(!is_enabled(&app.window, "Add to plot"));
    app.select("LoggingStatus");
    app.wait_for("Run");
    assert!(cell.record().is_some_and(|record| record.packets().len() == 0), "nothing was read");
    app.click("Close");
}
