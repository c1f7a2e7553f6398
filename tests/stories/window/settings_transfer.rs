//! Export and import of settings, and the server log, through the real window against virtual controllers.

use std::collections::BTreeSet;
use std::path::PathBuf;

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use opcua_configurator::jobs::{
    AddUser, SelfSigned, SelfSignedFields, SetSettings, SettingsChange, StartServer, StopServer,
};
use opcua_configurator::model::{Credential, KeyLength, SecurityPolicy, ServerSettings, UserPassword, Validity};
use opcua_configurator::ui::features::server_log::SaveLogForm;
use opcua_configurator::ui::picker::FixedPicker;
use opcua_configurator::virtual_controller::FleetFirmware;

use crate::common::plant::Plant;
use crate::common::window::{choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_desk::{Desk, PATIENCE, listed};

impl Desk {
    fn choose(&mut self, item: &str) {
        choose(&mut self.window, &["Server settings", item]);
    }

    fn add_user(&self, name: &str) {
        let credential = Credential { name: name.parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() };
        self.run(AddUser { credential, based_on: None });
    }

    fn users(&self, index: usize) -> usize {
        self.plant.controller(index).state().users.len()
    }

    fn export_file(&self, index: usize) -> PathBuf {
        self.workspace.settings_files().path(&self.plant.controller(index).serial())
    }
}

#[test]
fn settings_of_many_are_exported_and_put_back() {
    let (mut desk, manager) = Desk::with_file_manager(2, FleetFirmware::Legacy);
    desk.add_user("operator1");
    desk.click("Tick all");
    desk.choose("Export…");
    type_into(&mut desk.window, "Passphrase", "short");
    assert!(shows(&desk.window, "At least 8 characters, or none") && !is_enabled(&desk.window, "Export"));
    type_into(&mut desk.window, "Passphrase", "correct horse");
    desk.click("Export");
    assert!(shows(&desk.window, "A settings export of the same name in the workspace is overwritten"));
    assert!(!shows(&desk.window, "ackup"), "it is an export");
    desk.click("Export");
    desk.wait_for("Completed");
    // Each file, and the folder that holds them all.
    for index in 0..2 {
        let file = desk.export_file(index).strip_prefix(desk.workspace.root()).unwrap().display().to_string();
        assert!(shows(&desk.window, &file), "{file}");
    }
    assert!(shows(&desk.window, "Saved in") && shows(&desk.window, &desk.workspace.root().display().to_string()));
    let root = desk.workspace.root().to_owned();
    desk.open_folder(&manager, &root);
    desk.finish("2 done");
    assert!(desk.export_file(0).is_file() && desk.export_file(1).is_file());

    desk.add_user("operator2");
    desk.choose("Import…");
    type_into(&mut desk.window, "Passphrase", "wrong horse");
    desk.click("Import");
    desk.click("Replace settings");
    desk.wait_for("2 failed");
    desk.click("Close");
    assert_eq!((desk.users(0), desk.users(1)), (2, 2), "nothing was changed");

    desk.choose("Import…");
    type_into(&mut desk.window, "Passphrase", "correct horse");
    desk.click("Import");
    assert!(shows(&desk.window, "are replaced by those of the file"));
    desk.confirm_and_finish("2 done");
    assert_eq!((desk.users(0), desk.users(1)), (1, 1));
}

#[test]
fn the_file_of_one_controller_is_looked_at_before_it_is_imported() {
    let (mut desk, manager) = Desk::with_file_manager(1, FleetFirmware::Legacy);
    desk.click("Tick cell 1");
    desk.choose("Import…");
    desk.wait_for("option.json");
    // The folder can be opened before there is anything in it.
    let folder = desk.export_file(0).parent().unwrap().to_owned();
    desk.open_folder(&manager, &folder);
    wait_until(&mut desk.window, PATIENCE, |window| shows(window, "Remedy"));
    assert!(!is_enabled(&desk.window, "Import"));
    desk.click("Cancel");

    // Without a passphrase the connection password protects the file.
    desk.choose("Export…");
    desk.click("Export");
    desk.confirm_and_finish("1 done");
    desk.add_user("operator1");
    desk.choose("Import…");
    desk.wait_for(&format!("firmware {}", desk.plant.controller(0).firmware()));
    desk.click("Import");
    desk.click("Replace settings");
    desk.wait_for("Completed");
    assert!(shows(&desk.window, "Imported from") && shows(&desk.window, &folder.display().to_string()));
    desk.finish("1 done");
    assert_eq!(desk.users(0), 0);
}

#[test]
fn current_firmware_says_why_not() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    desk.click("Tick cell 1");
    desk.click("Server settings");
    for item in ["Export…", "Import…"] {
        let node = desk.window.get_by_label(item);
        assert!(node.accesskit_node().is_disabled());
        node.hover();
        for _ in 0..60 {
            desk.window.step();
        }
        assert!(shows(&desk.window, "Only for firmware before 8.0.0"), "{item}");
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
    let mut desk = Desk::start(|| Plant::start(1, FleetFirmware::Current), listed, None, picked);
    desk.run(certificate());
    let faults = desk.plant.controller(0).faults();
    let log = |on: bool| SetSettings {
        change: SettingsChange { server_log: Some(on), ..SettingsChange::default() },
        log_password: on.then(|| ServerSettings::LOG_PASSWORD.to_owned()),
        ..SetSettings::default()
    };
    desk.run(log(true));
    desk.run(StartServer);
    desk.run(log(false));
    // Full with the two lines that are in the log, and not with the one that a new log begins with.
    faults.update(|switches| switches.log_limit = Some(1024 + 100));

    desk.click("Tick cell 1");
    desk.choose("Basic settings…");
    desk.wait_for("Delete log");
    desk.click("On");
    desk.click("Delete log");
    assert!(shows(&desk.window, "199532 switches it on") && !is_enabled(&desk.window, "Apply"));
    type_into(&mut desk.window, "Password for the log", ServerSettings::LOG_PASSWORD);
    desk.click("Apply");
    desk.confirm_and_finish("1 done");
    desk.wait_for("Run (581)");

    desk.choose("Server log…");
    desk.wait_for("server started");
    desk.click("Save…");
    assert!(shows(&desk.window, "The whole log is read"));
    desk.click("Browse…");
    let file = desk.folder.path().join("picked.txt");
    wait_until(&mut desk.window, PATIENCE, |window| {
        let form = window.state().model.top::<SaveLogForm>();
        form.is_some_and(|form| form.path == file.display().to_string())
    });
    desk.click("Save");
    desk.finish("1 done");
    let saved = std::fs::read_to_string(&file).unwrap();
    assert!(saved.contains("INFO server started: opc.tcp://") && saved.ends_with('\n'), "{saved}");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        assert_eq!(std::fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600);
    }
    assert!(shows(&desk.window, "server started"), "the log is still shown");
    desk.click("Close");
}

#[test]
fn the_log_is_read_filtered_refreshed_and_deleted() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Legacy);
    desk.click("Tick cell 1");
    desk.choose("Server log…");
    desk.wait_for("The log is empty");
    assert!(!is_enabled(&desk.window, "Delete…") && shows(&desk.window, "0 B, 0 lines"));

    desk.run(certificate());
    desk.run(SetSettings {
        change: SettingsChange {
            server_log: Some(true),
            security_policies: Some(BTreeSet::from([SecurityPolicy::Basic256Sha256])),
            ..SettingsChange::default()
        },
        log_password: Some(ServerSettings::LOG_PASSWORD.to_owned()),
        ..SetSettings::default()
    });
    desk.run(StartServer);
    desk.run(StopServer);
    desk.click("Refresh");
    desk.wait_for("server started");
    assert!(shows(&desk.window, "server stopped"));
    type_into(&mut desk.window, "Filter lines", "SERVER STOPPED");
    assert!(shows(&desk.window, "server stopped") && !shows(&desk.window, "server started"));
    type_into(&mut desk.window, "Filter lines", "nobody says this");
    assert!(shows(&desk.window, "No line matches the filter"));
    desk.window.key_press(egui::Key::Enter);
    desk.window.run_ok();
    assert!(shows(&desk.window, "No line matches the filter"), "Enter does not close it");

    desk.click("Delete…");
    assert!(shows(&desk.window, "The server log in the controller is deleted"));
    desk.confirm_and_finish("1 done");
    desk.wait_for("The log is empty");
    desk.click("Close");
}
