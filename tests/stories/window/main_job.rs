//! The main job through the real window, against real virtual controllers over loopback.

use std::sync::Arc;
use std::time::Duration;

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use opcua_configurator::jobs::{AddUser, SelfSigned, SelfSignedFields};
use opcua_configurator::model::{Credential, KeyLength, Language, Problem, ServerStatus, UserPassword, Validity};
use opcua_configurator::pki::Fingerprint;
use opcua_configurator::ui::backend::{NewVirtual, VirtualFleetStarter};
use opcua_configurator::ui::features::add_controller::AddController;
use opcua_configurator::ui::picker::FixedPicker;
use opcua_configurator::virtual_controller::{DropPoint, FleetFirmware};
use opcua_configurator::workspace::{Configuration, ControllerEntry};

use crate::common::plant::{self, Plant};
use crate::common::window::{choose, click, is_enabled, shows, type_into, wait_until};
use crate::common::window_desk::{Desk, PATIENCE, listed};

impl Desk {
    fn statuses(&self) -> Vec<Option<ServerStatus>> {
        let rows = self.window.state().model.rows.all();
        rows.iter().map(|row| row.entry.last.as_ref().map(|last| last.info.status)).collect()
    }
}

/// Fills in the form and sends it off.
fn fill_in_controller(desk: &mut Desk, name: &str, address: &str, password: &str) {
    choose(&mut desk.window, &["Controller", "Add controller…"]);
    type_into(&mut desk.window, "Name", name);
    type_into(&mut desk.window, "IP address", address);
    type_into(&mut desk.window, "Connection password", password);
    desk.click("Apply");
}

fn fill_in_certificate(desk: &mut Desk) {
    choose(&mut desk.window, &["Certificate", "Create and save", "Self-signed…"]);
    for (field, text) in [("State", "Nagano"), ("Locality", "Suwa"), ("Organisation", "Example")] {
        type_into(&mut desk.window, field, text);
    }
}

#[test]
fn from_an_empty_window_to_three_running_servers() {
    let mut desk = Desk::empty(3, FleetFirmware::Mixed);
    assert!(shows(&desk.window, "No controllers yet"));
    for (index, name) in ["weld", "paint", "码垛"].iter().enumerate() {
        let address = desk.plant.controller(index).management_address().to_string();
        fill_in_controller(&mut desk, name, &address, plant::PASSWORD);
        desk.wait_for("Is this your controller?");
        let fingerprint: Fingerprint = desk.plant.controller(index).fingerprint();
        let shown = fingerprint.grouped().replace(':', " ");
        assert!(shows(&desk.window, &shown[..23]), "the fingerprint is there to be compared");
        desk.click("It matches, add");
        wait_until(&mut desk.window, PATIENCE, |window| window.state().model.rows.all().len() == index + 1);
    }
    desk.wait_until_saved(|configuration| configuration.controllers.len() == 3);

    // Sorted by name, then the other way round.
    desk.click("Sort by name");
    desk.click("Sort by name");
    let top = |desk: &Desk, name: &str| desk.window.get_by_label(name).rect().top();
    assert!(top(&desk, "weld") < top(&desk, "paint"));

    desk.tick(&["weld", "paint", "码垛"]);
    fill_in_certificate(&mut desk);
    desk.click("Create and save");
    assert!(shows(&desk.window, "The OPC UA server is stopped"));
    desk.confirm_and_finish("3 done");

    choose(&mut desk.window, &["Server settings", "Users…"]);
    type_into(&mut desk.window, "User name", "operator1");
    type_into(&mut desk.window, "Password", "Passw0rd1");
    desk.click("Add");
    desk.confirm_and_finish("3 done");

    desk.click("Start");
    wait_until(&mut desk.window, PATIENCE, |window| window.state().model.job.is_none());
    assert_eq!(desk.statuses(), [Some(ServerStatus::Run); 3]);
    assert_eq!(desk.window.query_all_by_label("Run").count(), 3);
    for index in 0..3 {
        assert_eq!(desk.plant.controller(index).state().users.len(), 1);
    }
}

#[test]
fn the_settings_of_one_controller_are_read_changed_and_applied() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    desk.tick(&["cell 1"]);
    choose(&mut desk.window, &["Server settings", "Basic settings…"]);
    let port = desk.plant.controller(0).state().settings.port.to_string();
    wait_until(&mut desk.window, PATIENCE, |window| window.query_all_by_value(&port).next().is_some());
    desk.click("Basic256Sha256");
    type_into(&mut desk.window, "Port", "20777");
    desk.click("Apply");
    desk.confirm_and_finish("1 done");
    let state = desk.plant.controller(0).state();
    assert_eq!(state.settings.port.get(), 20777);
    assert!(!state.settings.security_policies.iter().any(|p| p.as_str() == "Basic256Sha256"));
}

#[test]
fn enter_confirms_a_dialog_whatever_has_the_focus_but_presses_a_focused_button() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    desk.tick(&["cell 1"]);
    choose(&mut desk.window, &["Server settings", "Basic settings…"]);
    wait_until(&mut desk.window, PATIENCE, |window| is_enabled(window, "Apply"));

    desk.window.get_by_label("Basic256").focus();
    desk.window.run_ok();
    desk.window.key_press(egui::Key::Enter);
    desk.window.run_ok();
    assert!(shows(&desk.window, "The OPC UA server is stopped"), "the tick box had the focus");

    let cancel = desk.window.query_all_by_label("Cancel").next_back().unwrap();
    cancel.focus();
    desk.window.run_ok();
    desk.window.key_press(egui::Key::Enter);
    desk.window.run_ok();
    assert!(!shows(&desk.window, "The OPC UA server is stopped"), "Cancel was pressed, not Change settings");
    assert!(is_enabled(&desk.window, "Apply"), "the form is there again");
    let state = desk.plant.controller(0).state();
    assert!(
        !state.settings.security_policies.iter().any(|policy| policy.as_str() == "Basic256"),
        "nothing was changed"
    );
}

#[test]
fn a_dialog_stays_where_it_is_when_a_warning_appears_in_it() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    desk.tick(&["cell 1"]);
    choose(&mut desk.window, &["Server settings", "Basic settings…"]);
    wait_until(&mut desk.window, PATIENCE, |window| is_enabled(window, "Apply"));
    let top = |desk: &Desk| desk.window.query_all_by_label("Port").next().unwrap().rect().top();
    let before = top(&desk);
    for port in ["80", "20777"] {
        type_into(&mut desk.window, "Port", port);
        assert_eq!(shows(&desk.window, "Enter a port from 1024 to 65535"), port == "80");
        // Half a point is rounded either way.
        assert!((top(&desk) - before).abs() <= 1.0, "{} and {before} with port {port}", top(&desk));
    }
}

#[test]
fn a_batch_is_cancelled_in_the_middle() {
    let mut desk = Desk::with_controllers(8, FleetFirmware::Current);
    for index in 0..8 {
        desk.plant.controller(index).faults().update(|f| f.latency = Duration::from_millis(300));
    }
    desk.window.state_mut().model.options.parallelism = 2;
    desk.click("Tick all");
    choose(&mut desk.window, &["Server settings", "Users…"]);
    type_into(&mut desk.window, "User name", "operator1");
    type_into(&mut desk.window, "Password", "Passw0rd1");
    desk.click("Add");
    desk.click("Add user");
    wait_until(&mut desk.window, PATIENCE, |window| {
        window.state().model.job.as_ref().is_some_and(|job| job.finished >= 1)
    });
    desk.click("Cancel");
    assert!(shows(&desk.window, "Stop after the step in hand?"));
    // Two buttons say "Stop": the one of the question is on top.
    desk.click("Stop");
    desk.wait_for("Stopped");
    let changed = (0..8).filter(|i| !desk.plant.controller(*i).state().users.is_empty()).count();
    assert!((1..8).contains(&changed), "{changed} of 8 were changed");
    assert!(shows(&desk.window, &format!("{changed} done")), "what is done is said so");
    assert!(shows(&desk.window, "not started"));
}

#[test]
fn adding_a_controller_explains_what_is_wrong_and_keeps_what_was_typed() {
    let mut desk = Desk::empty(1, FleetFirmware::Current);
    let address = desk.plant.controller(0).management_address().to_string();
    fill_in_controller(&mut desk, "weld", &address, "wrong-password");
    desk.wait_for("Is this your controller?");
    desk.click("It matches, add");
    desk.wait_for("The connection password is wrong");
    assert!(desk.window.query_all_by_value("weld").next().is_some(), "the form is still there");
    type_into(&mut desk.window, "Connection password", plant::PASSWORD);
    desk.click("Apply");
    desk.wait_for("Is this your controller?");
    desk.click("It matches, add");
    wait_until(&mut desk.window, PATIENCE, |window| window.state().model.rows.all().len() == 1);

    // Mistakes are shown before anything is sent.
    choose(&mut desk.window, &["Controller", "Add controller…"]);
    type_into(&mut desk.window, "Name", "weld");
    assert!(shows(&desk.window, "Another controller already has this name"));
    type_into(&mut desk.window, "IP address", "10.0.0.999");
    assert!(shows(&desk.window, "Enter an IP address or a host name"));
    assert!(!is_enabled(&desk.window, "Apply"));
    desk.click("Cancel");

    // Nobody there, and somebody else there.
    let silent = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let nowhere = silent.local_addr().unwrap().to_string();
    drop(silent);
    fill_in_controller(&mut desk, "nowhere", &nowhere, "");
    desk.wait_for("The controller cannot be reached");
    desk.click("Cancel");
    let printer = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let at = printer.local_addr().unwrap().to_string();
    let printer = std::thread::spawn(move || {
        let (mut stream, _) = printer.accept().unwrap();
        std::io::Write::write_all(&mut stream, b"220 printer ready\r\n").unwrap();
    });
    fill_in_controller(&mut desk, "printer", &at, "");
    desk.wait_for("What answers at this address is not a controller");
    printer.join().unwrap();
    desk.click("Cancel");
    assert_eq!(desk.window.state().model.rows.all().len(), 1);
}

/// Runs a task on "cell 1" that must fail, and gives back the message that is shown for it.
fn failing_start(desk: &mut Desk, message: &str) {
    desk.tick(&["cell 1"]);
    desk.click("Start");
    desk.wait_for(message);
    assert!(shows(&desk.window, "1 failed"));
    desk.click("Close");
}

/// The number stands in the status and is explained there, until its cause is mended.
#[test]
fn an_error_number_describes_the_present() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    failing_start(&mut desk, "No server certificate is configured");
    assert!(shows(&desk.window, "Error (7931)"));
    desk.window.get_by_label("Error (7931)").hover();
    for _ in 0..60 {
        desk.window.step();
    }
    for part in ["7931: No server certificate is configured", "Create or import a server certificate"] {
        assert!(shows(&desk.window, part), "{part}");
    }
    let fields = SelfSignedFields {
        common_name: None,
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: String::new(),
        key_length: KeyLength::Rsa2048,
        validity: Validity::try_from(1).unwrap(),
    };
    desk.run(SelfSigned { fields, backup: None });
    desk.click("Get new information");
    wait_until(&mut desk.window, PATIENCE, |window| !shows(window, "7931"));
    assert_eq!(desk.statuses()[0], Some(ServerStatus::Stop));
}

#[test]
fn a_failing_controller_is_explained_with_cause_and_remedy() {
    let mut desk = Desk::with_controllers(2, FleetFirmware::Current);
    failing_start(&mut desk, "No server certificate is configured");
    assert_eq!(desk.statuses()[0], Some(ServerStatus::Error));
    desk.plant.controller(0).faults().update(|f| f.task_running = true);
    desk.click("Start");
    desk.wait_for("A task is running in the controller");
    for part in ["Cause", "Remedy", "Wait for the task to finish"] {
        assert!(shows(&desk.window, part), "{part}");
    }
    desk.click("Close");
    desk.plant.controller(0).faults().update(|f| f.task_running = false);

    // A second configurator changes the controller while its settings are on the screen.
    choose(&mut desk.window, &["Server settings", "Basic settings…"]);
    let port = desk.plant.controller(0).state().settings.port.to_string();
    wait_until(&mut desk.window, PATIENCE, |window| window.query_all_by_value(&port).next().is_some());
    let other = AddUser {
        credential: Credential {
            name: "operator9".parse().unwrap(),
            password: UserPassword::new("Passw0rd1").unwrap(),
        },
        based_on: None,
    };
    assert!(desk.runtime.block_on(desk.plant.run(other))[0].result.is_ok());
    desk.click("Apply");
    desk.click("Change settings");
    desk.wait_for("The controller was changed by somebody else");
    desk.click("Close");

    // The cable is pulled in mid-change.
    desk.plant.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::AfterApply));
    choose(&mut desk.window, &["Server settings", "Users…"]);
    desk.wait_for("operator9");
    desk.click("Add user…");
    type_into(&mut desk.window, "User name", "operator2");
    type_into(&mut desk.window, "Password", "Passw0rd1");
    desk.click("Add");
    desk.click("Add user");
    desk.wait_for("The change was applied, but its answer was lost");
    desk.wait_for("Completed");
    desk.click("Close");
    desk.wait_for("operator2");
}

#[test]
fn a_changed_fingerprint_stops_everything() {
    let mut desk = Desk::start(
        || Plant::start(1, FleetFirmware::Current),
        |plant| {
            let mut configuration = listed(plant);
            configuration.controllers[0].fingerprint = Some(plant::nobody());
            configuration
        },
        None,
        |_| FixedPicker(Ok(None)),
    );
    opcua_configurator::workspace::Passwords::set(
        desk.plant.passwords.as_ref(),
        plant::nobody(),
        plant::PASSWORD.into(),
    )
    .unwrap();
    desk.tick(&["cell 1"]);
    desk.click("Get new information");
    desk.wait_for("The controller's identity has changed");
    let shown = plant::nobody().grouped();
    assert!(shows(&desk.window, &shown) || shows(&desk.window, "expected"), "both fingerprints are there");
}

#[test]
fn a_missing_password_is_asked_for_and_the_job_goes_on() {
    let mut desk = Desk::with_controllers(2, FleetFirmware::Current);
    opcua_configurator::workspace::Passwords::forget(
        desk.plant.passwords.as_ref(),
        desk.plant.controller(1).fingerprint(),
    );
    desk.tick(&["cell 1", "cell 2"]);
    desk.click("Get new information");
    desk.wait_for("Connection password needed");
    type_into(&mut desk.window, "Connection password", plant::PASSWORD);
    desk.click("OK");
    wait_until(&mut desk.window, PATIENCE, |window| {
        window.state().model.job.is_none() && window.state().model.dialogs.is_empty()
    });
}

#[test]
fn a_port_in_use_is_refused_in_the_form() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    desk.tick(&["cell 1"]);
    choose(&mut desk.window, &["Server settings", "Basic settings…"]);
    let port = desk.plant.controller(0).state().settings.port.to_string();
    wait_until(&mut desk.window, PATIENCE, |window| window.query_all_by_value(&port).next().is_some());
    for (port, message) in [
        ("80", "Enter a port from 1024 to 65535"),
        ("70000", "Enter a port from 1024 to 65535"),
        (
            &desk.plant.controller(0).info().used_ports[0].to_string(),
            "Another function of the controller uses this port",
        ),
    ] {
        type_into(&mut desk.window, "Port", port);
        assert!(shows(&desk.window, message), "{port}");
        assert!(!is_enabled(&desk.window, "Apply"));
    }
}

#[test]
fn the_language_changes_at_once_and_is_remembered() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    choose(&mut desk.window, &["Options", "Options…"]);
    desk.click("简体中文");
    assert!(shows(&desk.window, "选项") && shows(&desk.window, "获取新信息"));
    desk.click("关闭");
    assert!(shows(&desk.window, "控制器"));
    desk.wait_until_saved(|configuration| configuration.options.language == Some(Language::Zh));
}

/// egui keeps the former texts of a field for Ctrl+Z, also those of a password, under the field's place in the dialog.
#[test]
fn undo_does_not_bring_a_password_back() {
    let mut desk = Desk::empty(0, FleetFirmware::Current);
    let password = |desk: &Desk| {
        let form = desk.window.state().model.top::<AddController>().expect("the dialog is open");
        form.password.0.clone()
    };
    choose(&mut desk.window, &["Controller", "Add controller…"]);
    type_into(&mut desk.window, "Connection password", "secret of the cell");
    // Longer than a text must stay as it is to become a step of undo.
    desk.window.run_steps(20);
    assert_eq!(password(&desk), "secret of the cell");
    desk.click("Cancel");

    choose(&mut desk.window, &["Controller", "Add controller…"]);
    type_into(&mut desk.window, "Connection password", "x");
    for _ in 0..3 {
        desk.window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
        desk.window.run_ok();
        assert!(!password(&desk).contains("secret"), "{:?}", password(&desk));
    }
}

#[test]
fn the_licences_of_everything_linked_in_are_shown_and_searched() {
    let mut desk = Desk::empty(0, FleetFirmware::Current);
    choose(&mut desk.window, &["Help", "About", "Licences…"]);
    type_into(&mut desk.window, "Filter by name or licence", "MPL-2.0");
    assert!(shows(&desk.window, "Mozilla Public License"));
    type_into(&mut desk.window, "Filter by name or licence", "noto sans");
    desk.click("Noto Sans CJK SC (subset) 2.004");
    assert!(shows(&desk.window, "SIL OPEN FONT LICENSE"));
    type_into(&mut desk.window, "Filter by name or licence", "no such thing");
    assert!(shows(&desk.window, "Nothing matches the filter"));
}

#[test]
fn a_damaged_configuration_is_told_at_the_start() {
    let mut desk = Desk::empty(0, FleetFirmware::Current);
    std::fs::write(desk.workspace.root().join("epson_opcua_config.json"), "{").unwrap();
    let notice: Problem = desk.workspace.load().unwrap().notice().unwrap();
    desk.window.state_mut().model.show_problem(notice);
    desk.window.run_ok();
    for text in ["The configuration file was damaged", "kept as", "Restore the controllers from a backup"] {
        assert!(shows(&desk.window, text), "{text}");
    }
}

/// A file where the folder should be: nobody can write there, not even root.
#[test]
fn a_workspace_that_cannot_be_written_is_said_so_and_nothing_is_lost() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    std::fs::remove_dir_all(desk.workspace.root()).unwrap();
    std::fs::write(desk.workspace.root(), "in the way").unwrap();
    desk.tick(&["cell 1"]);
    desk.click("Get new information");
    desk.wait_for("The workspace cannot be written");
    desk.click("Close");
    assert_eq!(desk.window.state().model.rows.all().len(), 1);
    assert_eq!(std::fs::read_to_string(desk.workspace.root()).unwrap(), "in the way");
}

struct OneVirtual(ControllerEntry);

#[async_trait::async_trait]
impl VirtualFleetStarter for OneVirtual {
    async fn start(&self) -> Result<Vec<NewVirtual>, Problem> {
        Ok(vec![NewVirtual { entry: self.0.clone(), password: plant::PASSWORD.into() }])
    }
}

#[test]
fn the_welcome_page_offers_virtual_controllers() {
    let outer = tokio::runtime::Runtime::new().unwrap();
    let plant = outer.block_on(Plant::start(1, FleetFirmware::Current));
    let starter: Arc<dyn VirtualFleetStarter> = Arc::new(OneVirtual(listed(&plant).controllers.remove(0)));
    let mut desk = Desk::start(
        || Plant::start(0, FleetFirmware::Current),
        |_| Configuration::default(),
        Some(starter),
        |_| FixedPicker(Ok(None)),
    );
    desk.click("Try it with virtual controllers");
    wait_until(&mut desk.window, PATIENCE, |window| window.state().model.rows.all().len() == 1);
    desk.tick(&["cell 1"]);
    desk.click("Get new information");
    wait_until(&mut desk.window, PATIENCE, |window| window.state().model.job.is_none());
    assert!(shows(&desk.window, "cell 1"));
}

#[test]
fn users_are_deleted_from_the_list() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Legacy);
    for name in ["operator1", "operator2"] {
        let operation = AddUser {
            credential: Credential { name: name.parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() },
            based_on: None,
        };
        assert!(desk.runtime.block_on(desk.plant.run(operation))[0].result.is_ok());
    }
    desk.tick(&["cell 1"]);
    choose(&mut desk.window, &["Server settings", "Users…"]);
    desk.wait_for("operator2");
    desk.click("operator1");
    desk.click("Delete");
    desk.click("Delete users");
    desk.wait_for("Completed");
    desk.click("Close");
    let left: Vec<String> = desk.plant.controller(0).state().users.iter().map(|u| u.name.to_string()).collect();
    assert_eq!(left, ["operator2"]);
}

#[test]
fn a_command_that_cannot_be_given_says_why() {
    let desk = Desk::with_controllers(1, FleetFirmware::Current);
    let mut window = desk.window;
    click(&mut window, "Tools");
    let item = window.get_by_label("Verify");
    assert!(item.accesskit_node().is_disabled());
    item.hover();
    for _ in 0..60 {
        window.step();
    }
    assert!(shows(&window, "Tick at least one controller first"));
}
