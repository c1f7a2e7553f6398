//! Activation and connection lists through the real window, against real virtual controllers over loopback.

use std::fs;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use egui_kittest::kittest::Queryable as _;
use opcua_configurator::model::ErrorCode;
use opcua_configurator::ui::backend::{BackendOptions, TokioBackend};
use opcua_configurator::ui::model::RowState;
use opcua_configurator::ui::picker::FixedPicker;
use opcua_configurator::virtual_controller::{FleetFirmware, demo_keys};
use opcua_configurator::workspace::{Configuration, Workspace};

use crate::common::test_fleet::{self, TestFleet};
use crate::common::window::{self, SIZE, choose, is_enabled, shows, type_into, wait_until, window_in};
use crate::common::window_test::{WAIT_LIMIT, WindowTest, list, listed};

const PICKED: &str = "picked.csv";

impl WindowTest {
    /// A window over controllers that are not activated; the desktop's dialog always chooses `WindowTest::file`.
    fn not_activated(count: usize) -> Self {
        Self::choosing_a_file(|| TestFleet::not_activated(count), listed)
    }

    fn choosing_a_file<F: Future<Output = TestFleet>>(
        fleet: impl FnOnce() -> F,
        list: impl FnOnce(&TestFleet) -> Configuration,
    ) -> Self {
        Self::start(fleet, list, None, |folder| FixedPicker(Ok(Some(folder.join(PICKED)))))
    }

    fn chosen_file(&self) -> PathBuf {
        self.folder.path().join(PICKED)
    }

    fn activated(&self, index: usize) -> bool {
        self.fleet.controller(index).info().activated
    }
}

#[test]
fn one_controller_is_activated_by_the_keys_that_were_pasted() {
    let mut app = WindowTest::not_activated(1);
    app.click("Tick cell 1");
    choose(&mut app.window, &["Server settings", "Activation…"]);
    assert!(!is_enabled(&app.window, "Apply"), "both keys are still empty");

    let keys = demo_keys(&app.fleet.controller(0).serial());
    let pasted = format!("  {} ", keys.licence.to_string().to_uppercase().replace('-', " "));
    type_into(&mut app.window, "Licence key", &pasted);
    let normalised = keys.licence.to_string();
    assert!(app.window.query_all_by_value(&normalised).next().is_some(), "shown as the certificate writes it");
    assert!(!is_enabled(&app.window, "Apply"), "the activation key is still empty");
    type_into(&mut app.window, "Activation key", "ＡBCD");
    assert!(shows(&app.window, "is neither a half-width letter nor a digit"));
    let typed = keys.activation.to_string().to_lowercase();
    type_into(&mut app.window, "Activation key", &typed[..typed.len() - 1]);
    assert!(shows(&app.window, "23 of 24 letters and digits") && !is_enabled(&app.window, "Apply"));
    type_into(&mut app.window, "Activation key", &typed);

    app.click("Apply");
    assert!(shows(&app.window, "The OPC UA server is stopped"));
    assert!(!app.activated(0), "nothing is sent before the confirmation");
    app.click("Activate");
    app.wait_for("Completed");
    assert!(shows(&app.window, "1 done"));
    app.click("Close");
    assert!(app.activated(0));
    assert!(app.window.query_all_by_label("Yes").next().is_some(), "the row knows it");
    assert!(app.window.state().model.dialogs.is_empty());
}

#[test]
fn many_are_activated_from_a_file_with_mistakes_that_are_shown_before_anything_is_sent() {
    let mut app = WindowTest::not_activated(3);
    // The second line is damaged, the third controller's is missing.
    let file =
        app.activation_line(0) + &app.activation_line(1).replacen('-', "", 4).replacen(',', "!,", 2) + "OTHER1,x\n";
    let stranger = "R7A9999999,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n";
    fs::write(app.chosen_file(), format!("OPCUA.Activation.Ver.1.0\r\n{file}{stranger}")).unwrap();

    app.click("Tick all");
    choose(&mut app.window, &["Server settings", "Activation…"]);
    assert!(!is_enabled(&app.window, "Read file"), "no file is named yet");

    // A file that is not there, and one that is something else.
    type_into(&mut app.window, "File", "nowhere.csv");
    app.click("Read file");
    app.wait_for("The file cannot be read");
    let wrong = app.chosen_file().with_file_name("wrong.csv");
    fs::write(&wrong, "Name,Type,Address\n").unwrap();
    type_into(&mut app.window, "File", &wrong.display().to_string());
    app.click("Read file");
    app.wait_for("the first line is not");

    app.click("Choose…");
    app.wait_for("Keys found for 1 of 3 controllers");
    for part in ["Line 2", "Line 3: ", "Not in the file", "Line 4: it has 2 fields", "R7A9999999"] {
        assert!(shows(&app.window, part), "no {part:?} in the preview");
    }
    app.click("Apply");
    app.click("Activate");
    app.wait_for("Completed");
    assert!(shows(&app.window, "1 done, 2 failed"));
    app.click("Close");
    assert_eq!([0, 1, 2].map(|index| app.activated(index)), [true, false, false]);
}

#[test]
fn current_firmware_is_not_activated_by_keys() {
    let mut app =
        WindowTest::choosing_a_file(|| TestFleet::start(2, FleetFirmware::Current), |fleet| list(fleet, true));
    app.click("Server settings");
    assert!(!is_enabled(&app.window, "Activation…"), "nothing is ticked");
    app.window.key_press(egui::Key::Escape);
    window::settle(&mut app.window);
    app.click("Tick cell 1");
    app.click("Server settings");
    assert!(!is_enabled(&app.window, "Activation…"));
}

#[test]
fn controllers_of_a_connection_list_are_imported_and_confirmed() {
    let mut app =
        WindowTest::choosing_a_file(|| TestFleet::start(3, FleetFirmware::Mixed), |_| Configuration::default());
    // There is no list in the workspace yet: no failure, and a file can be chosen.
    choose(&mut app.window, &["Controller", "Get connection list…"]);
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Read file"));
    assert!(!shows(&app.window, "The file cannot be read"));
    app.click("Cancel");

    let at = |index: usize| app.fleet.controller(index).management_address().to_string();
    let list = format!(
        "Name,Type,Address\nweld,Ethernet,{}\n码垛,Ethernet,{}\nspare,Ethernet,10.0.0.9\nweld,Ethernet,10.0.0.8\n\
         Service,USB,\nSimulator,Virtual,127.0.0.1\npress,Ethernet,10.0.0.999\n",
        at(0),
        at(1)
    );
    fs::write(app.workspace.connection_list_path(), list).unwrap();
    choose(&mut app.window, &["Controller", "Get connection list…"]);
    app.wait_for("Import 3 of 3 controllers");
    for part in ["Line 5", "the name also stands in line 2", "USB", "simulation", "10.0.0.999"] {
        assert!(shows(&app.window, part), "no {part:?} in the preview");
    }
    app.click("spare");
    app.click("Import");
    assert_eq!(app.window.state().model.rows.all().len(), 2);
    assert!(shows(&app.window, "2 controllers added"));
    assert_eq!(app.window.query_all_by_label("Not confirmed").count(), 2);

    // Nothing is sent to them until their fingerprints were compared.
    // What was imported is ticked already.
    app.click("Get new information");
    for index in [0, 1] {
        let shown = app.fleet.controller(index).fingerprint().grouped().replace(':', " ");
        app.wait_for(&shown[..23]);
        assert!(shows(&app.window, &format!("{} of 2", index + 1)));
        if index == 0 {
            // The field has the keyboard as soon as it is there.
            app.window.event(egui::Event::Text("wrong-password".into()));
            window::settle(&mut app.window);
            app.click("It matches, go on");
            app.wait_for("The connection password is wrong");
            app.click("Try again");
            app.wait_for(&shown[..23]);
            type_into(&mut app.window, "Connection password", test_fleet::PASSWORD);
        }
        app.click("It matches, go on");
    }
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.dialogs.is_empty());
    assert!(!shows(&app.window, "Not confirmed"));
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        window.state().model.rows.all().iter().all(|row| row.entry.last.is_some())
    });
    let saved = || app.workspace.load().unwrap().configuration.controllers;
    let end = std::time::Instant::now() + WAIT_LIMIT;
    while saved().iter().any(|entry| entry.fingerprint.is_none()) {
        assert!(std::time::Instant::now() < end, "never saved");
        std::thread::sleep(Duration::from_millis(10));
    }
    app.click("Controller");
    assert!(!is_enabled(&app.window, "Confirm identity…"), "there is nobody left to confirm");
}

#[test]
fn a_desktop_without_a_file_dialog_says_what_to_do_instead() {
    let mut app = WindowTest::not_activated(2);
    let picker = Arc::new(FixedPicker(Err(ErrorCode::NoFilePicker.into())));
    let folder = tempfile::tempdir().unwrap();
    let workspace = Workspace::new(folder.path());
    let backend = BackendOptions {
        workspace: workspace.clone(),
        lock: workspace.lock().unwrap(),
        passwords: app.fleet.passwords.clone(),
        connectors: Arc::new(app.fleet.connector).into(),
        starter: None,
        picker,
    };
    let backend = TokioBackend::new(backend, || {}).unwrap();
    app.window = window_in(workspace, backend, list(&app.fleet, false), SIZE);
    app.click("Tick all");
    choose(&mut app.window, &["Server settings", "Activation…"]);
    app.click("Choose…");
    app.wait_for("Type the path of the file into the field");

    // Their serial numbers are not known yet; the file is looked into when they are reached.
    let file = app.activation_line(0) + &app.activation_line(1);
    fs::write(folder.path().join("keys.csv"), format!("OPCUA.Activation.Ver.1.0\n{file}")).unwrap();
    type_into(&mut app.window, "File", "keys.csv");
    app.click("Read file");
    app.wait_for("Not read yet, looked up");
    app.click("Apply");
    app.click("Activate");
    app.wait_for("2 done");
    assert!(app.activated(0) && app.activated(1));
}

#[test]
fn fifty_are_activated_from_one_file_with_five_bad_lines_one_cable_pulled_and_a_cancel() {
    const COUNT: usize = 50;
    const UNREACHABLE: usize = 44;
    let mut app = WindowTest::not_activated(COUNT);
    let file: String = (0..COUNT)
        .map(|index| match index {
            3 => String::new(),
            11 => app.activation_line(index).replacen('-', "!", 1),
            19 => app.activation_line(index).replacen(',', ";", 1),
            27 => app.activation_line(index) + &app.activation_line(index),
            // Another controller's keys: only the controller can know.
            35 => {
                let keys = demo_keys(&"R7A9999999".parse().unwrap());
                format!("{},{},{}\n", app.fleet.controller(index).serial(), keys.licence, keys.activation)
            }
            _ => app.activation_line(index),
        })
        .collect();
    fs::write(app.chosen_file(), format!("OPCUA.Activation.Ver.1.0\r\n{file}")).unwrap();
    app.runtime.block_on(app.fleet.controller(UNREACHABLE).shutdown());
    for index in (0..COUNT).filter(|index| *index != UNREACHABLE) {
        app.fleet.controller(index).faults().update(|faults| faults.latency = Duration::from_millis(40));
    }
    app.window.state_mut().model.options.parallelism = 4;

    let open = |app: &mut WindowTest| {
        choose(&mut app.window, &["Server settings", "Activation…"]);
        app.click("Choose…");
        app.wait_for("Keys found for 46 of 50 controllers");
    };
    app.click("Tick all");
    open(&mut app);
    for part in ["Line 12: ", "Line 20: ", "Line 29: ", "Not in the file"] {
        assert!(shows(&app.window, part), "no {part:?} in the preview");
    }
    app.click("Apply");
    app.click("Activate");

    // In mid-batch: asked first, and what is done stays done.
    let finished = |app: &WindowTest| app.window.state().model.job.as_ref().map_or(0, |job| job.finished);
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        window.state().model.job.as_ref().is_some_and(|job| job.finished >= 8)
    });
    app.click("Cancel");
    assert!(shows(&app.window, "Stop after the step in hand?"));
    app.click("Stop");
    app.wait_for("Stopped");
    assert!(finished(&app) == COUNT && shows(&app.window, "not started"));
    let states: Vec<RowState> =
        app.window.state().model.job.as_ref().unwrap().rows.iter().map(|row| row.state.clone()).collect();
    assert!(states.iter().filter(|state| **state == RowState::NotStarted).count() >= COUNT - 30);
    for (index, state) in states.iter().enumerate() {
        assert_eq!(*state == RowState::Done, app.activated(index), "what is said of controller {index} is so");
    }
    app.click("Close");

    // And simply done again, with all that are wrong named.
    open(&mut app);
    app.click("Apply");
    app.click("Activate");
    app.wait_for("Completed");
    assert!(shows(&app.window, "44 done, 6 failed"));
    let failed = |app: &WindowTest, index: usize| {
        app.window.state().model.job.as_ref().unwrap().rows[index].state.problem().map(|problem| problem.code)
    };
    for index in 0..COUNT {
        let expected = match index {
            3 | 11 | 19 | 27 => Some(ErrorCode::NotInFile),
            35 => Some(ErrorCode::WrongKeys),
            UNREACHABLE => Some(ErrorCode::Unreachable),
            _ => None,
        };
        assert_eq!(failed(&app, index), expected, "controller {index}");
        assert_eq!(app.activated(index), expected.is_none(), "controller {index}");
    }
    app.click("Close");
    assert!(app.window.state().model.dialogs.is_empty());
}
