//! Export and import of settings, and the server log, through the real window against virtual controllers.

use std::collections::BTreeSet;
use std::path::PathBuf;

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use opcua_configurator::jobs::{
    AddUser, BasicSettingsChange, SelfSigned, SelfSignedFields, SetBasicSettings, StartServer, StopServer,
};
use opcua_configurator::model::{KeyLength, SecurityPolicy, ServerSettings, UserCredential, UserPassword, Validity};
use opcua_configurator::ui::SaveLogForm;
use opcua_configurator::ui::picker::FixedPicker;
use opcua_configurator::virtual_controller::FleetFirmware;

use crate::common::test_fleet::TestFleet;
use crate::common::window::{choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest, listed};

impl WindowTest {
    fn choose(&mut self, item: &str) {
        choose(&mut self.window, &["Server settings", item]);
    }

    fn add_user(&self, name: &str) {
        let credential =
            UserCredential { name: name.parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() };
        self.run(AddUser { credential, based_on: None });
    }

    fn users(&self, index: usize) -> usize {
        self.fleet.controller(index).state().users.len()
    }

    fn export_file(&self, index: usize) -> PathBuf {
        self.workspace.settings_files().path(&self.fleet.controller(index).serial())
    }
}

#[test]
fn settings_of_many_are_exported_and_put_back() {
    let (mut app, manager) = WindowTest::with_file_manager(2, FleetFirmware::Legacy);
    app.add_user("operator1");
    app.click("Tick all");
    app.choose("Export…");
    type_into(&mut app.window, "Passphrase", "short");
    assert!(shows(&app.window, "At least 8 characters, or none") && !is_enabled(&app.window, "Export"));
    type_into(&mut app.window, "Passphrase", "correct horse");
    app.click("Export");
    assert!(shows(&app.window, "A settings export of the same name in the workspace is overwritten"));
    assert!(!shows(&app.window, "ackup"), "it is an export");
    app.click("Export");
    app.wait_for("Completed");
    // Each file, and the folder that holds them all.
    for index in 0..2 {
        let file = app.export_file(index).strip_prefix(app.workspace.root()).unwrap().display().to_string();
        assert!(shows(&app.window, &file), "{file}");
    }
    assert!(shows(&app.window, "Saved in") && shows(&app.window, &app.workspace.root().display().to_string()));
    let root = app.workspace.root().to_owned();
    app.open_folder(&manager, &root);
    app.finish("2 done");
    assert!(app.export_file(0).is_file() && app.export_file(1).is_file());

    app.add_user("operator2");
    app.choose("Import…");
    type_into(&mut app.window, "Passphrase", "wrong horse");
    app.click("Import");
    app.click("Replace settings");
    app.wait_for("2 failed");
    app.click("Close");
    assert_eq!((app.users(0), app.users(1)), (2, 2), "nothing was changed");

    app.choose("Import…");
    type_into(&mut app.window, "Passphrase", "correct horse");
    app.click("Import");
    assert!(shows(&app.window, "are replaced by those of the file"));
    app.confirm_and_finish("2 done");
    assert_eq!((app.users(0), app.users(1)), (1, 1));
}

#[test]
fn the_file_of_one_controller_is_looked_at_before_it_is_imported() {
    let (mut app, manager) = WindowTest::with_file_manager(1, FleetFirmware::Legacy);
    app.click("Tick cell 1");
    app.choose("Import…");
    app.wait_for("option.json");
    // The folder can be opened before there is anything in it.
    let folder = app.export_file(0).parent().unwrap().to_owned();
    app.open_folder(&manager, &folder);
    wait_until(&mut app.window, WAIT_LIMIT, |window| shows(window, "Remedy"));
    assert!(!is_enabled(&app.window, "Import"));
    app.click("Cancel");

    // Without a passphrase the connection password protects the file.
    app.choose("Export…");
    app.click("Export");
    app.confirm_and_finish("1 done");
    app.add_user("operator1");
    app.choose("Import…");
    app.wait_for(&format!("firmware {}", app.fleet.controller(0).firmware()));
    app.click("Import");
    app.click("Replace settings");
    app.wait_for("Completed");
    assert!(shows(&app.window, "Imported from") && shows(&app.window, &folder.display().to_string()));
    app.finish("1 done");
    assert_eq!(app.users(0), 0);
}

#[test]
fn current_firmware_says_why_not() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    app.click("Tick cell 1");
    app.click("Server settings");
    for item in ["Export…", "Import…"] {
        let node = app.window.get_by_label(item);
        assert!(node.accesskit_node().is_disabled());
        node.hover();
        for _ in 0..60 {
            app.window.step();
        }
        assert!(shows(&app.window, "Only for firmware before 8.0.0"), "{item}");
    }
}

fn certificate() -> SelfSigned {
    let fields = SelfSignedFields {
        common_name: None,
        country: "JP".into(),
        state: "Nagano".into(),
        locality: "Suwa".into(),
        organisation: "Example".into(),
        key_length: KeyLength::Rsa2048,
        validity: Validity::try_from(5).unwrap(),
    };
    SelfSigned { fields, backup: None }
}

/// The password is in the hint, and a full log is deleted in the same step.
#[test]
fn the_log_is_switched_on_and_deleted_in_one_step_and_saved() {
    let picked = |folder: &std::path::Path| FixedPicker(Ok(Some(folder.join("picked.txt"))));
    let mut app = WindowTest::start(|| TestFleet::start(1, FleetFirmware::Current), listed, None, picked);
    app.run(certificate());
    let faults = app.fleet.controller(0).faults();
    let log = |on: bool| SetBasicSettings {
        change: BasicSettingsChange { server_log: Some(on), ..BasicSettingsChange::default() },
        log_password: on.then(|| ServerSettings::LOG_PASSWORD.to_owned()),
        ..SetBasicSettings::default()
    };
    app.run(log(true));
    app.run(StartServer);
    app.run(log(false));
    // Full with the two lines that are in the log, and not with the one that a new log begins with.
    faults.update(|switches| switches.log_limit = Some(1024 + 100));

    app.click("Tick cell 1");
    app.choose("Basic settings…");
    app.wait_for("Delete log");
    app.click("On");
    app.click("Delete log");
    assert!(shows(&app.window, "199532 switches it on") && !is_enabled(&app.window, "Apply"));
    type_into(&mut app.window, "Password for the log", ServerSettings::LOG_PASSWORD);
    app.click("Apply");
    app.confirm_and_finish("1 done");
    app.wait_for("Run (581)");

    app.choose("Server log…");
    app.wait_for("server started");
    app.click("Save…");
    assert!(shows(&app.window, "The whole log is read"));
    app.click("Browse…");
    let file = app.folder.path().join("picked.txt");
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        let form = window.state().model.top::<SaveLogForm>();
        form.is_some_and(|form| form.path == file.display().to_string())
    });
    app.click("Save");
    app.finish("1 done");
    let saved = std::fs::read_to_string(&file).unwrap();
    assert!(saved.contains("INFO server started: opc.tcp://") && saved.ends_with('\n'), "{saved}");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        assert_eq!(std::fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600);
    }
    assert!(shows(&app.window, "server started"), "the log is still shown");
    app.click("Close");
}

#[test]
fn the_log_is_read_filtered_refreshed_and_deleted() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Legacy);
    app.click("Tick cell 1");
    app.choose("Server log…");
    app.wait_for("The log is empty");
    assert!(!is_enabled(&app.window, "Delete…") && shows(&app.window, "0 B, 0 lines"));

    app.run(certificate());
    app.run(SetBasicSettings {
        change: BasicSettingsChange {
            server_log: Some(true),
            security_policies: Some(BTreeSet::from([SecurityPolicy::Basic256Sha256])),
            ..BasicSettingsChange::default()
        },
        log_password: Some(ServerSettings::LOG_PASSWORD.to_owned()),
        ..SetBasicSettings::default()
    });
    app.run(StartServer);
    app.run(StopServer);
    app.click("Refresh");
    app.wait_for("server started");
    assert!(shows(&app.window, "server stopped"));
    type_into(&mut app.window, "Filter lines", "SERVER STOPPED");
    assert!(shows(&app.window, "server stopped") && !shows(&app.window, "server started"));
    type_into(&mut app.window, "Filter lines", "nobody says this");
    assert!(shows(&app.window, "No line matches the filter"));
    app.window.key_press(egui::Key::Enter);
    app.window.run_ok();
    assert!(shows(&app.window, "No line matches the filter"), "Enter does not close it");

    app.click("Delete…");
    assert!(shows(&app.window, "The server log in the controller is deleted"));
    app.confirm_and_finish("1 done");
    app.wait_for("The log is empty");
    app.click("Close");
}
