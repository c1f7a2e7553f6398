//! Connection passwords on a PC without a keyring, and controllers that are switched off, through the real window.

use std::net::{IpAddr, Ipv4Addr, TcpListener};
use std::sync::Arc;

use opcua_configurator::ui::backend::{BackendOptions, TokioBackend};
use opcua_configurator::ui::picker::FixedPicker;
use opcua_configurator::virtual_controller::cell::CellOptions;
use opcua_configurator::virtual_controller::{AdmissionOptions, Fleet, FleetConfig, FleetFirmware};
use opcua_configurator::workspace::{Configuration, NoKeyring, PasswordPlace, PasswordStore, VaultState};

use crate::common::plant;
use crate::common::window::{SIZE, choose, shows, type_into, wait_until, window_in};
use crate::common::window_desk::{Desk, PATIENCE, listed};

const PASSPHRASE: &str = "correct horse";

/// Controllers that were confirmed before, on a PC without a keyring; no password is known.
fn desk(count: usize) -> Desk {
    let desk = Desk::with_controllers(count, FleetFirmware::Current);
    let configuration = listed(&desk.plant);
    opened(desk, Some(configuration))
}

/// Closes the window and opens it again: only what is in the workspace is known.
fn start_again(desk: Desk) -> Desk {
    opened(desk, None)
}

fn opened(desk: Desk, configuration: Option<Configuration>) -> Desk {
    let Desk { window, plant, runtime, workspace, folder } = desk;
    // The lock of the workspace goes with it.
    drop(window);
    let lock = workspace.lock().unwrap();
    if let Some(configuration) = configuration {
        workspace.save(&configuration, &lock).unwrap();
    }
    let configuration = workspace.load().unwrap().configuration;
    let store = PasswordStore::new(workspace.vault(), configuration.options.passwords, NoKeyring);
    let backend = BackendOptions {
        workspace: workspace.clone(),
        lock,
        passwords: Arc::new(store),
        connectors: Arc::new(plant.connector).into(),
        starter: None,
        picker: Arc::new(FixedPicker(Ok(None))),
    };
    let backend = TokioBackend::new(backend, || {}).unwrap();
    let window = window_in(workspace.clone(), backend, configuration, SIZE);
    let mut desk = Desk { window, plant, runtime, workspace, folder };
    wait_until(&mut desk.window, PATIENCE, |window| window.state().model.store.is_some());
    desk
}

fn idle(desk: &mut Desk) {
    wait_until(&mut desk.window, PATIENCE, |window| {
        let model = &window.state().model;
        model.job.is_none() && model.dialogs.is_empty()
    });
}

/// Once it is asked for.
fn open_vault(desk: &mut Desk, passphrase: &str) {
    desk.wait_for("Open the vault for passwords");
    type_into(&mut desk.window, "Passphrase", passphrase);
    desk.click("Open");
    idle(desk);
}

fn vault(desk: &Desk) -> Option<VaultState> {
    desk.window.state().model.store.map(|store| store.vault)
}

#[test]
fn a_vault_keeps_passwords_where_there_is_no_keyring() {
    let mut desk = desk(2);
    desk.click("Tick all");
    desk.click("Get new information");
    desk.wait_for("Connection password needed");
    assert!(shows(&desk.window, "known until this window is closed"));
    type_into(&mut desk.window, "Connection password", plant::PASSWORD);
    desk.click("Use for these controllers");
    // What was asked for is done, and no complaint lies over it.
    idle(&mut desk);
    assert!(shows(&desk.window, "Get new information: 2 controllers done"));
    desk.click("Passwords are not kept");
    desk.wait_for("Create a vault for passwords");
    type_into(&mut desk.window, "Passphrase", "short");
    assert!(shows(&desk.window, "At least 8 characters"));
    type_into(&mut desk.window, "Passphrase", PASSPHRASE);
    type_into(&mut desk.window, "Passphrase again", PASSPHRASE);
    desk.click("Create");
    desk.wait_for("The vault was created");
    wait_until(&mut desk.window, PATIENCE, |window| {
        window.state().model.store.is_some_and(|store| store.vault == VaultState::Open { passwords: 2 })
    });
    assert!(!shows(&desk.window, "Passwords are not kept"));
    desk.wait_until_saved(|configuration| configuration.options.passwords == PasswordPlace::Vault);

    desk = start_again(desk);
    desk.click("Tick all");
    desk.click("Get new information");
    desk.wait_for("Open the vault for passwords");
    type_into(&mut desk.window, "Passphrase", "correct house");
    desk.click("Open");
    desk.wait_for("The passphrase does not open the vault");
    type_into(&mut desk.window, "Passphrase", PASSPHRASE);
    desk.click("Open");
    idle(&mut desk);
    assert!(shows(&desk.window, "Get new information: 2 controllers done"));
    // Once in a run is enough.
    desk.click("Get new information");
    idle(&mut desk);

    choose(&mut desk.window, &["Options", "Options…"]);
    assert!(shows(&desk.window, "The vault is open and holds 2 passwords"));
    desk.click("Change passphrase…");
    type_into(&mut desk.window, "Passphrase", PASSPHRASE);
    type_into(&mut desk.window, "New passphrase", "battery staple");
    type_into(&mut desk.window, "Passphrase again", "battery staple");
    desk.click("Change");
    wait_until(&mut desk.window, PATIENCE, |window| window.state().model.dialogs.len() == 1);
    desk.click("Close vault");
    desk.wait_for("The vault is closed");
    desk.click("Close");
    desk.click("Get new information");
    open_vault(&mut desk, "battery staple");
}

#[test]
fn who_does_not_open_the_vault_enters_passwords_as_before() {
    let mut desk = desk(1);
    desk.workspace.vault().create(&PASSPHRASE.into()).unwrap();
    desk.tick(&["cell 1"]);
    desk.click("Get new information");
    desk.wait_for("Open the vault for passwords");
    desk.click("Cancel");
    desk.wait_for("Connection password needed");
    type_into(&mut desk.window, "Connection password", plant::PASSWORD);
    desk.click("OK");
    idle(&mut desk);
    assert_eq!(vault(&desk), Some(VaultState::Declined));
    desk.click("Get new information");
    idle(&mut desk);
    // Later it was opened all the same, and takes in what was entered.
    desk.click("Passwords are not kept");
    open_vault(&mut desk, PASSPHRASE);
    assert_eq!(vault(&desk), Some(VaultState::Open { passwords: 1 }));
}

/// A controller of a plant of its own, which can be switched on later under an address that is known before.
fn controller(port: u16, password: &str, folder: &std::path::Path) -> FleetConfig {
    FleetConfig {
        count: 1,
        bind: IpAddr::V4(Ipv4Addr::LOCALHOST),
        management_port: port,
        opcua_port: 0,
        firmware: FleetFirmware::Current,
        activated: true,
        password: password.into(),
        data: folder.join("virtual"),
        admission: AdmissionOptions::default(),
        cell: CellOptions::default(),
        seed: 7,
    }
}

#[test]
fn a_controller_that_is_switched_off_is_added_now_and_confirmed_later_and_its_missing_password_is_remembered() {
    let mut desk = desk(0);
    let free = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = free.local_addr().unwrap().port();
    drop(free);
    desk.click("Add a controller");
    type_into(&mut desk.window, "Name", "Weld 1");
    type_into(&mut desk.window, "IP address", &format!("127.0.0.1:{port}"));
    desk.click("Apply");
    desk.wait_for("Add without confirming its identity");
    desk.click("Add without confirming its identity");
    assert!(shows(&desk.window, "Not confirmed") && shows(&desk.window, "Weld 1 was added"));
    desk.wait_until_saved(|configuration| {
        configuration.controllers.iter().any(|entry| entry.fingerprint.is_none() && entry.name.as_str() == "Weld 1")
    });

    // It has no password, and somebody switches it on.
    let folder = tempfile::tempdir().unwrap();
    let fleet = desk.runtime.block_on(Fleet::start(controller(port, "", folder.path()))).unwrap();
    desk.workspace.vault().create(&PASSPHRASE.into()).unwrap();
    desk.tick(&["Weld 1"]);
    desk.click("Get new information");
    let shown = fleet.controllers()[0].fingerprint().grouped().replace(':', " ");
    desk.wait_for(&shown[..23]);
    assert!(desk.window.state().model.rows.all()[0].entry.fingerprint.is_none());
    desk.click("It matches, go on");
    // The vault is asked for as soon as there is something to put into it.
    open_vault(&mut desk, PASSPHRASE);
    assert!(!shows(&desk.window, "Not confirmed"));
    desk.wait_until_saved(|configuration| configuration.controllers.iter().all(|entry| entry.fingerprint.is_some()));
    desk = start_again(desk);
    desk.tick(&["Weld 1"]);
    desk.click("Get new information");
    // That there is no password is known: it is not asked for.
    open_vault(&mut desk, PASSPHRASE);
    assert!(shows(&desk.window, "Get new information: 1 controller done"));
    desk.runtime.block_on(fleet.shutdown());
}
