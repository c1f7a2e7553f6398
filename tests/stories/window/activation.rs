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

use crate::common::plant::{self, Plant};
use crate::common::window::{self, SIZE, choose, is_enabled, shows, type_into, wait_until, window_in};
use crate::common::window_desk::{Desk, PATIENCE, list, listed};

const PICKED: &str = "picked.csv";

impl Desk {
    /// A window over controllers that are not activated; the desktop's dialog always chooses `Desk::file`.
    fn not_activated(count: usize) -> Self {
        Self::choosing_a_file(|| Plant::not_activated(count), listed)
    }

    fn choosing_a_file<F: Future<Output = Plant>>(
        plant: impl FnOnce() -> F,
        list: impl FnOnce(&Plant) -> Configuration,
    ) -> Self {
        Self::start(plant, list, None, |folder| FixedPicker(Ok(Some(folder.join(PICKED)))))
    }

    fn chosen_file(&self) -> PathBuf {
        self.folder.path().join(PICKED)
    }

    fn activated(&self, index: usize) -> bool {
        self.plant.controller(index).info().activated
    }
}

#[test]
fn one_controller_is_activated_by_the_keys_that_were_pasted() {
    let mut desk = Desk::not_activated(1);
    desk.click("Tick cell 1");
    choose(&mut desk.window, &["Server settings", "Activation…"]);
    assert!(!is_enabled(&desk.window, "Apply"), "both keys are still empty");

    let keys = demo_keys(&desk.plant.controller(0).serial());
    let pasted = format!("  {} ", keys.licence.to_string().to_uppercase().replace('-', " "));
    type_into(&mut desk.window, "Licence key", &pasted);
    let normalised = keys.licence.to_string();
    assert!(desk.window.query_all_by_value(&normalised).next().is_some(), "shown as the certificate writes it");
    assert!(!is_enabled(&desk.window, "Apply"), "the activation key is still empty");
    type_into(&mut desk.window, "Activation key", "ＡBCD");
    assert!(shows(&desk.window, "is neither a half-width letter nor a digit"));
    let typed = keys.activation.to_string().to_lowercase();
    type_into(&mut desk.window, "Activation key", &typed[..typed.len() - 1]);
    assert!(shows(&desk.window, "23 of 24 letters and digits") && !is_enabled(&desk.window, "Apply"));
    type_into(&mut desk.window, "Activation key", &typed);

    desk.click("Apply");
    assert!(shows(&desk.window, "The OPC UA server is stopped"));
    assert!(!desk.activated(0), "nothing is sent before the confirmation");
    desk.click("Activate");
    desk.wait_for("Completed");
    assert!(shows(&desk.window, "1 done"));
    desk.click("Close");
    assert!(desk.activated(0));
    assert!(desk.window.query_all_by_label("Yes").next().is_some(), "the row knows it");
    assert!(desk.window.state().model.dialogs.is_empty());
}

#[test]
fn many_are_activated_from_a_file_with_mistakes_that_are_shown_before_anything_is_sent() {
    let mut desk = Desk::not_activated(3);
    // The second line is damaged, the third controller's is missing.
    let file =
        desk.activation_line(0) + &desk.activation_line(1).replacen('-', "", 4).replacen(',', "!,", 2) + "OTHER1,x\n";
    let stranger = "R7A9999999,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n";
    fs::write(desk.chosen_file(), format!("OPCUA.Activation.Ver.1.0\r\n{file}{stranger}")).unwrap();

    desk.click("Tick all");
    choose(&mut desk.window, &["Server settings", "Activation…"]);
    assert!(!is_enabled(&desk.window, "Read file"), "no file is named yet");

    // A file that is not there, and one that is something else.
    type_into(&mut desk.window, "File", "nowhere.csv");
    desk.click("Read file");
    desk.wait_for("The file cannot be read");
    let wrong = desk.chosen_file().with_file_name("wrong.csv");
    fs::write(&wrong, "Name,Type,Address\n").unwrap();
    type_into(&mut desk.window, "File", &wrong.display().to_string());
    desk.click("Read file");
    desk.wait_for("the first line is not");

    desk.click("Choose…");
    desk.wait_for("Keys found for 1 of 3 controllers");
    for part in ["Line 2", "Line 3: ", "Not in the file", "Line 4: it has 2 fields", "R7A9999999"] {
        assert!(shows(&desk.window, part), "no {part:?} in the preview");
    }
    desk.click("Apply");
    desk.click("Activate");
    desk.wait_for("Completed");
    assert!(shows(&desk.window, "1 done, 2 failed"));
    desk.click("Close");
    assert_eq!([0, 1, 2].map(|index| desk.activated(index)), [true, false, false]);
}

#[test]
fn current_firmware_is_not_activated_by_keys() {
    let mut desk = Desk::choosing_a_file(|| Plant::start(2, FleetFirmware::Current), |plant| list(plant, true));
    desk.click("Server settings");
    assert!(!is_enabled(&desk.window, "Activation…"), "nothing is ticked");
    desk.window.key_press(egui::Key::Escape);
    window::settle(&mut desk.window);
    desk.click("Tick cell 1");
    desk.click("Server settings");
    assert!(!is_enabled(&desk.window, "Activation…"));
}

#[test]
fn controllers_of_a_connection_list_are_imported_and_confirmed() {
    let mut desk = Desk::choosing_a_file(|| Plant::start(3, FleetFirmware::Mixed), |_| Configuration::default());
    // There is no list in the workspace yet: no failure, and a file can be chosen.
    choose(&mut desk.window, &["Controller", "Get connection list…"]);
    wait_until(&mut desk.window, PATIENCE, |window| is_enabled(window, "Read file"));
    assert!(!shows(&desk.window, "The file cannot be read"));
    desk.click("Cancel");

    let at = |index: usize| desk.plant.controller(index).management_address().to_string();
    let list = format!(
        "Name,Type,Address\nweld,Ethernet,{}\n码垛,Ethernet,{}\nspare,Ethernet,10.0.0.9\nweld,Ethernet,10.0.0.8\n\
         Service,USB,\nSimulator,Virtual,127.0.0.1\npress,Ethernet,10.0.0.999\n",
        at(0),
        at(1)
    );
    fs::write(desk.workspace.connection_list_path(), list).unwrap();
    choose(&mut desk.window, &["Controller", "Get connection list…"]);
    desk.wait_for("Import 3 of 3 controllers");
    for part in ["Line 5", "the name also stands in line 2", "USB", "simulation", "10.0.0.999"] {
        assert!(shows(&desk.window, part), "no {part:?} in the preview");
    }
    desk.click("spare");
    desk.click("Import");
    assert_eq!(desk.window.state().model.rows.all().len(), 2);
    assert!(shows(&desk.window, "2 controllers added"));
    assert_eq!(desk.window.query_all_by_label("Not confirmed").count(), 2);

    // Nothing is sent to them until their fingerprints were compared.
    // What was imported is ticked already.
    desk.click("Get new information");
    for index in [0, 1] {
        let shown = desk.plant.controller(index).fingerprint().grouped().replace(':', " ");
        desk.wait_for(&shown[..23]);
        assert!(shows(&desk.window, &format!("{} of 2", index + 1)));
        if index == 0 {
            // The field has the keyboard as soon as it is there.
            desk.window.event(egui::Event::Text("wrong-password".into()));
            window::settle(&mut desk.window);
            desk.click("It matches, go on");
            desk.wait_for("The connection password is wrong");
            desk.click("Try again");
            desk.wait_for(&shown[..23]);
            type_into(&mut desk.window, "Connection password", plant::PASSWORD);
        }
        desk.click("It matches, go on");
    }
    wait_until(&mut desk.window, PATIENCE, |window| window.state().model.dialogs.is_empty());
    assert!(!shows(&desk.window, "Not confirmed"));
    wait_until(&mut desk.window, PATIENCE, |window| {
        window.state().model.rows.all().iter().all(|row| row.entry.last.is_some())
    });
    let saved = || desk.workspace.load().unwrap().configuration.controllers;
    let end = std::time::Instant::now() + PATIENCE;
    while saved().iter().any(|entry| entry.fingerprint.is_none()) {
        assert!(std::time::Instant::now() < end, "never saved");
        std::thread::sleep(Duration::from_millis(10));
    }
    desk.click("Controller");
    assert!(!is_enabled(&desk.window, "Confirm identity…"), "there is nobody left to confirm");
}

#[test]
fn a_desktop_without_a_file_dialog_says_what_to_do_instead() {
    let mut desk = Desk::not_activated(2);
    let picker = Arc::new(FixedPicker(Err(ErrorCode::NoFilePicker.into())));
    let folder = tempfile::tempdir().unwrap();
    let workspace = Workspace::new(folder.path());
    let backend = BackendOptions {
        workspace: workspace.clone(),
        lock: workspace.lock().unwrap(),
        passwords: desk.plant.passwords.clone(),
        connectors: Arc::new(desk.plant.connector).into(),
        starter: None,
        picker,
    };
    let backend = TokioBackend::new(backend, || {}).unwrap();
    desk.window = window_in(workspace, backend, list(&desk.plant, false), SIZE);
    desk.click("Tick all");
    choose(&mut desk.window, &["Server settings", "Activation…"]);
    desk.click("Choose…");
    desk.wait_for("Type the path of the file into the field");

    // Their serial numbers are not known yet; the file is looked into when they are reached.
    let file = desk.activation_line(0) + &desk.activation_line(1);
    fs::write(folder.path().join("keys.csv"), format!("OPCUA.Activation.Ver.1.0\n{file}")).unwrap();
    type_into(&mut desk.window, "File", "keys.csv");
    desk.click("Read file");
    desk.wait_for("Not read yet, looked up");
    desk.click("Apply");
    desk.click("Activate");
    desk.wait_for("2 done");
    assert!(desk.activated(0) && desk.activated(1));
}

#[test]
fn fifty_are_activated_from_one_file_with_five_bad_lines_one_cable_pulled_and_a_cancel() {
    const COUNT: usize = 50;
    const UNREACHABLE: usize = 44;
    let mut desk = Desk::not_activated(COUNT);
    let file: String = (0..COUNT)
        .map(|index| match index {
            3 => String::new(),
            11 => desk.activation_line(index).replacen('-', "!", 1),
            19 => desk.activation_line(index).replacen(',', ";", 1),
            27 => desk.activation_line(index) + &desk.activation_line(index),
            // Another controller's keys: only the controller can know.
            35 => {
                let keys = demo_keys(&"R7A9999999".parse().unwrap());
                format!("{},{},{}\n", desk.plant.controller(index).serial(), keys.licence, keys.activation)
            }
            _ => desk.activation_line(index),
        })
        .collect();
    fs::write(desk.chosen_file(), format!("OPCUA.Activation.Ver.1.0\r\n{file}")).unwrap();
    desk.runtime.block_on(desk.plant.controller(UNREACHABLE).shutdown());
    for index in (0..COUNT).filter(|index| *index != UNREACHABLE) {
        desk.plant.controller(index).faults().update(|faults| faults.latency = Duration::from_millis(40));
    }
    desk.window.state_mut().model.options.parallelism = 4;

    let open = |desk: &mut Desk| {
        choose(&mut desk.window, &["Server settings", "Activation…"]);
        desk.click("Choose…");
        desk.wait_for("Keys found for 46 of 50 controllers");
    };
    desk.click("Tick all");
    open(&mut desk);
    for part in ["Line 12: ", "Line 20: ", "Line 29: ", "Not in the file"] {
        assert!(shows(&desk.window, part), "no {part:?} in the preview");
    }
    desk.click("Apply");
    desk.click("Activate");

    // In mid-batch: asked first, and what is done stays done.
    let finished = |desk: &Desk| desk.window.state().model.job.as_ref().map_or(0, |job| job.finished);
    wait_until(&mut desk.window, PATIENCE, |window| {
        window.state().model.job.as_ref().is_some_and(|job| job.finished >= 8)
    });
    desk.click("Cancel");
    assert!(shows(&desk.window, "Stop after the step in hand?"));
    desk.click("Stop");
    desk.wait_for("Stopped");
    assert!(finished(&desk) == COUNT && shows(&desk.window, "not started"));
    let states: Vec<RowState> =
        desk.window.state().model.job.as_ref().unwrap().rows.iter().map(|row| row.state.clone()).collect();
    assert!(states.iter().filter(|state| **state == RowState::NotStarted).count() >= COUNT - 30);
    for (index, state) in states.iter().enumerate() {
        assert_eq!(*state == RowState::Done, desk.activated(index), "what is said of controller {index} is so");
    }
    desk.click("Close");

    // And simply done again, with all that are wrong named.
    open(&mut desk);
    desk.click("Apply");
    desk.click("Activate");
    desk.wait_for("Completed");
    assert!(shows(&desk.window, "44 done, 6 failed"));
    let failed = |desk: &Desk, index: usize| {
        desk.window.state().model.job.as_ref().unwrap().rows[index].state.problem().map(|problem| problem.code)
    };
    for index in 0..COUNT {
        let expected = match index {
            3 | 11 | 19 | 27 => Some(ErrorCode::NotInFile),
            35 => Some(ErrorCode::WrongKeys),
            UNREACHABLE => Some(ErrorCode::Unreachable),
            _ => None,
        };
        assert_eq!(failed(&desk, index), expected, "controller {index}");
        assert_eq!(desk.activated(index), expected.is_none(), "controller {index}");
    }
    desk.click("Close");
    assert!(desk.window.state().model.dialogs.is_empty());
}
