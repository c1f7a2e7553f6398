//! The main job through the real window, against real virtual controllers over loopback.

use std::sync::Arc;
use std::time::Duration;

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use opcua_configurator::jobs::{AddUser, SelfSigned, SelfSignedFields};
use opcua_configurator::model::{KeyLength, Language, Problem, ServerStatus, UserCredential, UserPassword, Validity};
use opcua_configurator::pki::Fingerprint;
use opcua_configurator::ui::AddControllerForm;
use opcua_configurator::ui::backend::{NewVirtualController, VirtualFleetStarter};
use opcua_configurator::ui::picker::FixedPicker;
use opcua_configurator::virtual_controller::{DropPoint, FleetFirmware};
use opcua_configurator::workspace::{Configuration, ControllerEntry};

use crate::common::test_fleet::{self, TestFleet};
use crate::common::window::{choose, click, is_enabled, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest, listed};

impl WindowTest {
    fn statuses(&self) -> Vec<Option<ServerStatus>> {
        let rows = self.window.state().model.rows.all();
        rows.iter().map(|row| row.entry.last.as_ref().map(|last| last.info.status)).collect()
    }
}

/// Fills in the form and sends it off.
fn fill_in_controller(app: &mut WindowTest, name: &str, address: &str, password: &str) {
    choose(&mut app.window, &["Controller", "Add controller…"]);
    type_into(&mut app.window, "Name", name);
    type_into(&mut app.window, "IP address", address);
    type_into(&mut app.window, "Connection password", password);
    app.click("Apply");
}

fn fill_in_certificate(app: &mut WindowTest) {
    choose(&mut app.window, &["Certificate", "Create and save", "Self-signed…"]);
    for (field, text) in [("State", "Nagano"), ("Locality", "Suwa"), ("Organisation", "Example")] {
        type_into(&mut app.window, field, text);
    }
}

#[test]
fn from_an_empty_window_to_three_running_servers() {
    let mut app = WindowTest::empty(3, FleetFirmware::Mixed);
    assert!(shows(&app.window, "No controllers yet"));
    for (index, name) in ["weld", "paint", "码垛"].iter().enumerate() {
        let address = app.fleet.controller(index).management_address().to_string();
        fill_in_controller(&mut app, name, &address, test_fleet::PASSWORD);
        app.wait_for("Is this your controller?");
        let fingerprint: Fingerprint = app.fleet.controller(index).fingerprint();
        let shown = fingerprint.grouped().replace(':', " ");
        assert!(shows(&app.window, &shown[..23]), "the fingerprint is there to be compared");
        app.click("It matches, add");
        wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.rows.all().len() == index + 1);
    }
    app.wait_until_saved(|configuration| configuration.controllers.len() == 3);

    // Sorted by name, then the other way round.
    app.click("Sort by name");
    app.click("Sort by name");
    let top = |app: &WindowTest, name: &str| app.window.get_by_label(name).rect().top();
    assert!(top(&app, "weld") < top(&app, "paint"));

    app.tick(&["weld", "paint", "码垛"]);
    fill_in_certificate(&mut app);
    app.click("Create and save");
    assert!(shows(&app.window, "The OPC UA server is stopped"));
    app.confirm_and_finish("3 done");

    choose(&mut app.window, &["Server settings", "Users…"]);
    type_into(&mut app.window, "User name", "operator1");
    type_into(&mut app.window, "Password", "Passw0rd1");
    app.click("Add");
    app.confirm_and_finish("3 done");

    app.click("Start");
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.job.is_none());
    assert_eq!(app.statuses(), [Some(ServerStatus::Run); 3]);
    assert_eq!(app.window.query_all_by_label("Run").count(), 3);
    for index in 0..3 {
        assert_eq!(app.fleet.controller(index).state().users.len(), 1);
    }
}

#[test]
fn the_settings_of_one_controller_are_read_changed_and_applied() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    app.tick(&["cell 1"]);
    choose(&mut app.window, &["Server settings", "Basic settings…"]);
    let port = app.fleet.controller(0).state().settings.port.to_string();
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.query_all_by_value(&port).next().is_some());
    app.click("Basic256Sha256");
    type_into(&mut app.window, "Port", "20777");
    app.click("Apply");
    app.confirm_and_finish("1 done");
    let state = app.fleet.controller(0).state();
    assert_eq!(state.settings.port.get(), 20777);
    assert!(!state.settings.security_policies.iter().any(|p| p.as_str() == "Basic256Sha256"));
}

#[test]
fn enter_confirms_a_dialog_whatever_has_the_focus_but_presses_a_focused_button() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    app.tick(&["cell 1"]);
    choose(&mut app.window, &["Server settings", "Basic settings…"]);
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Apply"));

    app.window.get_by_label("Basic256").focus();
    app.window.run_ok();
    app.window.key_press(egui::Key::Enter);
    app.window.run_ok();
    assert!(shows(&app.window, "The OPC UA server is stopped"), "the tick box had the focus");

    let cancel = app.window.query_all_by_label("Cancel").next_back().unwrap();
    cancel.focus();
    app.window.run_ok();
    app.window.key_press(egui::Key::Enter);
    app.window.run_ok();
    assert!(!shows(&app.window, "The OPC UA server is stopped"), "Cancel was pressed, not Change settings");
    assert!(is_enabled(&app.window, "Apply"), "the form is there again");
    let state = app.fleet.controller(0).state();
    assert!(
        !state.settings.security_policies.iter().any(|policy| policy.as_str() == "Basic256"),
        "nothing was changed"
    );
}

#[test]
fn a_dialog_stays_where_it_is_when_a_warning_appears_in_it() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    app.tick(&["cell 1"]);
    choose(&mut app.window, &["Server settings", "Basic settings…"]);
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Apply"));
    let top = |app: &WindowTest| app.window.query_all_by_label("Port").next().unwrap().rect().top();
    let before = top(&app);
    for port in ["80", "20777"] {
        type_into(&mut app.window, "Port", port);
        assert_eq!(shows(&app.window, "Enter a port from 1024 to 65535"), port == "80");
        // Half a point is rounded either way.
        assert!((top(&app) - before).abs() <= 1.0, "{} and {before} with port {port}", top(&app));
    }
}

#[test]
fn a_batch_is_cancelled_in_the_middle() {
    let mut app = WindowTest::with_controllers(8, FleetFirmware::Current);
    for index in 0..8 {
        app.fleet.controller(index).faults().update(|f| f.latency = Duration::from_millis(300));
    }
    app.window.state_mut().model.options.parallelism = 2;
    app.click("Tick all");
    choose(&mut app.window, &["Server settings", "Users…"]);
    type_into(&mut app.window, "User name", "operator1");
    type_into(&mut app.window, "Password", "Passw0rd1");
    app.click("Add");
    app.click("Add user");
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        window.state().model.job.as_ref().is_some_and(|job| job.finished >= 1)
    });
    app.click("Cancel");
    assert!(shows(&app.window, "Stop after the step in hand?"));
    // Two buttons say "Stop": the one of the question is on top.
    app.click("Stop");
    app.wait_for("Stopped");
    let changed = (0..8).filter(|i| !app.fleet.controller(*i).state().users.is_empty()).count();
    assert!((1..8).contains(&changed), "{changed} of 8 were changed");
    assert!(shows(&app.window, &format!("{changed} done")), "what is done is said so");
    assert!(shows(&app.window, "not started"));
}

#[test]
fn adding_a_controller_explains_what_is_wrong_and_keeps_what_was_typed() {
    let mut app = WindowTest::empty(1, FleetFirmware::Current);
    let address = app.fleet.controller(0).management_address().to_string();
    fill_in_controller(&mut app, "weld", &address, "wrong-password");
    app.wait_for("Is this your controller?");
    app.click("It matches, add");
    app.wait_for("The connection password is wrong");
    assert!(app.window.query_all_by_value("weld").next().is_some(), "the form is still there");
    type_into(&mut app.window, "Connection password", test_fleet::PASSWORD);
    app.click("Apply");
    app.wait_for("Is this your controller?");
    app.click("It matches, add");
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.rows.all().len() == 1);

    // Mistakes are shown before anything is sent.
    choose(&mut app.window, &["Controller", "Add controller…"]);
    type_into(&mut app.window, "Name", "weld");
    assert!(shows(&app.window, "Another controller already has this name"));
    type_into(&mut app.window, "IP address", "10.0.0.999");
    assert!(shows(&app.window, "Enter an IP address or a host name"));
    assert!(!is_enabled(&app.window, "Apply"));
    app.click("Cancel");

    // No controller there, and another program there.
    let silent = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let nowhere = silent.local_addr().unwrap().to_string();
    drop(silent);
    fill_in_controller(&mut app, "nowhere", &nowhere, "");
    app.wait_for("The controller cannot be reached");
    app.click("Cancel");
    let printer = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    let at = printer.local_addr().unwrap().to_string();
    let printer = std::thread::spawn(move || {
        let (mut stream, _) = printer.accept().unwrap();
        std::io::Write::write_all(&mut stream, b"220 printer ready\r\n").unwrap();
    });
    fill_in_controller(&mut app, "printer", &at, "");
    app.wait_for("What answers at this address is not a controller");
    printer.join().unwrap();
    app.click("Cancel");
    assert_eq!(app.window.state().model.rows.all().len(), 1);
}

/// Runs a task on "cell 1" that must fail, and gives back the message that is shown for it.
fn failing_start(app: &mut WindowTest, message: &str) {
    app.tick(&["cell 1"]);
    app.click("Start");
    app.wait_for(message);
    assert!(shows(&app.window, "1 failed"));
    app.click("Close");
}

/// The number stands in the status and is explained there, until its cause is mended.
#[test]
fn an_error_number_describes_the_present() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    failing_start(&mut app, "No server certificate is configured");
    assert!(shows(&app.window, "Error (7931)"));
    app.window.get_by_label("Error (7931)").hover();
    for _ in 0..60 {
        app.window.step();
    }
    for part in ["7931: No server certificate is configured", "Create or import a server certificate"] {
        assert!(shows(&app.window, part), "{part}");
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
    app.run(SelfSigned { fields, backup: None });
    app.click("Get new information");
    wait_until(&mut app.window, WAIT_LIMIT, |window| !shows(window, "7931"));
    assert_eq!(app.statuses()[0], Some(ServerStatus::Stop));
}

#[test]
fn a_failing_controller_is_explained_with_cause_and_remedy() {
    let mut app = WindowTest::with_controllers(2, FleetFirmware::Current);
    failing_start(&mut app, "No server certificate is configured");
    assert_eq!(app.statuses()[0], Some(ServerStatus::Error));
    app.fleet.controller(0).faults().update(|f| f.task_running = true);
    app.click("Start");
    app.wait_for("A task is running in the controller");
    for part in ["Cause", "Remedy", "Wait for the task to finish"] {
        assert!(shows(&app.window, part), "{part}");
    }
    app.click("Close");
    app.fleet.controller(0).faults().update(|f| f.task_running = false);

    // A second configurator changes the controller while its settings are on the screen.
    choose(&mut app.window, &["Server settings", "Basic settings…"]);
    let port = app.fleet.controller(0).state().settings.port.to_string();
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.query_all_by_value(&port).next().is_some());
    let other = AddUser {
        credential: UserCredential {
            name: "operator9".parse().unwrap(),
            password: UserPassword::new("Passw0rd1").unwrap(),
        },
        based_on: None,
    };
    assert!(app.runtime.block_on(app.fleet.run(other))[0].result.is_ok());
    app.click("Apply");
    app.click("Change settings");
    app.wait_for("The controller was changed by somebody else");
    app.click("Close");

    // The cable is pulled in mid-change.
    app.fleet.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::AfterApply));
    choose(&mut app.window, &["Server settings", "Users…"]);
    app.wait_for("operator9");
    app.click("Add user…");
    type_into(&mut app.window, "User name", "operator2");
    type_into(&mut app.window, "Password", "Passw0rd1");
    app.click("Add");
    app.click("Add user");
    app.wait_for("The change was applied, but its answer was lost");
    app.wait_for("Completed");
    app.click("Close");
    app.wait_for("operator2");
}

#[test]
fn a_changed_fingerprint_stops_everything() {
    let mut app = WindowTest::start(
        || TestFleet::start(1, FleetFirmware::Current),
        |fleet| {
            let mut configuration = listed(fleet);
            configuration.controllers[0].fingerprint = Some(test_fleet::nobody());
            configuration
        },
        None,
        |_| FixedPicker(Ok(None)),
    );
    opcua_configurator::workspace::Passwords::set(
        app.fleet.passwords.as_ref(),
        test_fleet::nobody(),
        test_fleet::PASSWORD.into(),
    )
    .unwrap();
    app.tick(&["cell 1"]);
    app.click("Get new information");
    app.wait_for("The controller's identity has changed");
    let shown = test_fleet::nobody().grouped();
    assert!(shows(&app.window, &shown) || shows(&app.window, "expected"), "both fingerprints are there");
}

#[test]
fn a_missing_password_is_asked_for_and_the_job_goes_on() {
    let mut app = WindowTest::with_controllers(2, FleetFirmware::Current);
    opcua_configurator::workspace::Passwords::forget(
        app.fleet.passwords.as_ref(),
        app.fleet.controller(1).fingerprint(),
    );
    app.tick(&["cell 1", "cell 2"]);
    app.click("Get new information");
    app.wait_for("Connection password needed");
    type_into(&mut app.window, "Connection password", test_fleet::PASSWORD);
    app.click("OK");
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        window.state().model.job.is_none() && window.state().model.dialogs.is_empty()
    });
}

#[test]
fn a_port_in_use_is_refused_in_the_form() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    app.tick(&["cell 1"]);
    choose(&mut app.window, &["Server settings", "Basic settings…"]);
    let port = app.fleet.controller(0).state().settings.port.to_string();
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.query_all_by_value(&port).next().is_some());
    for (port, message) in [
        ("80", "Enter a port from 1024 to 65535"),
        ("70000", "Enter a port from 1024 to 65535"),
        (
            &app.fleet.controller(0).info().used_ports[0].to_string(),
            "Another function of the controller uses this port",
        ),
    ] {
        type_into(&mut app.window, "Port", port);
        assert!(shows(&app.window, message), "{port}");
        assert!(!is_enabled(&app.window, "Apply"));
    }
}

#[test]
fn the_language_changes_at_once_and_is_remembered() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    choose(&mut app.window, &["Options", "Options…"]);
    app.click("简体中文");
    assert!(shows(&app.window, "选项") && shows(&app.window, "获取新信息"));
    app.click("关闭");
    assert!(shows(&app.window, "控制器"));
    app.wait_until_saved(|configuration| configuration.options.language == Some(Language::Zh));
}

/// egui keeps the former texts of a field for Ctrl+Z, also those of a password, under the field's place in the dialog.
#[test]
fn undo_does_not_bring_a_password_back() {
    let mut app = WindowTest::empty(0, FleetFirmware::Current);
    let password = |app: &WindowTest| {
        let form = app.window.state().model.top::<AddControllerForm>().expect("the dialog is open");
        form.password.0.clone()
    };
    choose(&mut app.window, &["Controller", "Add controller…"]);
    type_into(&mut app.window, "Connection password", "secret of the cell");
    // Longer than a text must stay as it is to become a step of undo.
    app.window.run_steps(20);
    assert_eq!(password(&app), "secret of the cell");
    app.click("Cancel");

    choose(&mut app.window, &["Controller", "Add controller…"]);
    type_into(&mut app.window, "Connection password", "x");
    for _ in 0..3 {
        app.window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
        app.window.run_ok();
        assert!(!password(&app).contains("secret"), "{:?}", password(&app));
    }
}

#[test]
fn the_licences_of_everything_linked_in_are_shown_and_searched() {
    let mut app = WindowTest::empty(0, FleetFirmware::Current);
    choose(&mut app.window, &["Help", "About", "Licences…"]);
    type_into(&mut app.window, "Filter by name or licence", "MPL-2.0");
    assert!(shows(&app.window, "Mozilla Public License"));
    type_into(&mut app.window, "Filter by name or licence", "noto sans");
    app.click("Noto Sans CJK SC (subset) 2.004");
    assert!(shows(&app.window, "SIL OPEN FONT LICENSE"));
    type_into(&mut app.window, "Filter by name or licence", "no such thing");
    assert!(shows(&app.window, "Nothing matches the filter"));
}

#[test]
fn a_damaged_configuration_is_told_at_the_start() {
    let mut app = WindowTest::empty(0, FleetFirmware::Current);
    std::fs::write(app.workspace.root().join("epson_opcua_config.json"), "{").unwrap();
    let notice: Problem = app.workspace.load().unwrap().notice().unwrap();
    app.window.state_mut().model.show_problem(notice);
    app.window.run_ok();
    for text in ["The configuration file was damaged", "kept as", "Restore the controllers from a backup"] {
        assert!(shows(&app.window, text), "{text}");
    }
}

/// A file where the folder should be: not even root can write there.
#[test]
fn a_workspace_that_cannot_be_written_is_said_so_and_nothing_is_lost() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    std::fs::remove_dir_all(app.workspace.root()).unwrap();
    std::fs::write(app.workspace.root(), "in the way").unwrap();
    app.tick(&["cell 1"]);
    app.click("Get new information");
    app.wait_for("The workspace cannot be written");
    app.click("Close");
    assert_eq!(app.window.state().model.rows.all().len(), 1);
    assert_eq!(std::fs::read_to_string(app.workspace.root()).unwrap(), "in the way");
}

struct OneVirtual(ControllerEntry);

#[async_trait::async_trait]
impl VirtualFleetStarter for OneVirtual {
    async fn start(&self) -> Result<Vec<NewVirtualController>, Problem> {
        Ok(vec![NewVirtualController { entry: self.0.clone(), password: test_fleet::PASSWORD.into() }])
    }
}

#[test]
fn the_welcome_page_offers_virtual_controllers() {
    let outer = tokio::runtime::Runtime::new().unwrap();
    let fleet = outer.block_on(TestFleet::start(1, FleetFirmware::Current));
    let starter: Arc<dyn VirtualFleetStarter> = Arc::new(OneVirtual(listed(&fleet).controllers.remove(0)));
    let mut app = WindowTest::start(
        || TestFleet::start(0, FleetFirmware::Current),
        |_| Configuration::default(),
        Some(starter),
        |_| FixedPicker(Ok(None)),
    );
    app.click("Try it with virtual controllers");
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.rows.all().len() == 1);
    app.tick(&["cell 1"]);
    app.click("Get new information");
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.job.is_none());
    assert!(shows(&app.window, "cell 1"));
}

#[test]
fn users_are_deleted_from_the_list() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Legacy);
    for name in ["operator1", "operator2"] {
        let operation = AddUser {
            credential: UserCredential {
                name: name.parse().unwrap(),
                password: UserPassword::new("Passw0rd1").unwrap(),
            },
            based_on: None,
        };
        assert!(app.runtime.block_on(app.fleet.run(operation))[0].result.is_ok());
    }
    app.tick(&["cell 1"]);
    choose(&mut app.window, &["Server settings", "Users…"]);
    app.wait_for("operator2");
    app.click("operator1");
    app.click("Delete");
    app.click("Delete users");
    app.wait_for("Completed");
    app.click("Close");
    let left: Vec<String> = app.fleet.controller(0).state().users.iter().map(|u| u.name.to_string()).collect();
    assert_eq!(left, ["operator2"]);
}

#[test]
fn a_command_that_cannot_be_given_says_why() {
    let app = WindowTest::with_controllers(1, FleetFirmware::Current);
    let mut window = app.window;
    click(&mut window, "Tools");
    let item = window.get_by_label("Verify");
    assert!(item.accesskit_node().is_disabled());
    item.hover();
    for _ in 0..60 {
        window.step();
    }
    assert!(shows(&window, "Tick at least one controller first"));
}
