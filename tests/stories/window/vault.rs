//! Connection passwords on a PC without a keyring, and controllers that are switched off, through the real window.

use std::net::{IpAddr, Ipv4Addr, TcpListener};
use std::sync::Arc;

use opcua_configurator::ui::backend::{BackendOptions, TokioBackend};
use opcua_configurator::ui::picker::FixedPicker;
use opcua_configurator::virtual_controller::cell::CellOptions;
use opcua_configurator::virtual_controller::remote::RemoteOptions;
use opcua_configurator::virtual_controller::{AdmissionOptions, Fleet, FleetConfig, FleetFirmware};
use opcua_configurator::workspace::{Configuration, NoKeyring, PasswordPlace, PasswordStore, VaultState};

use crate::common::test_fleet;
use crate::common::window::{SIZE, choose, shows, type_into, wait_until, window_in};
use crate::common::window_test::{WAIT_LIMIT, WindowTest, listed};

const PASSPHRASE: &str = "correct horse";

/// Controllers that were confirmed before, on a PC without a keyring; no password is known.
fn app(count: usize) -> WindowTest {
    let app = WindowTest::with_controllers(count, FleetFirmware::Current);
    let configuration = listed(&app.fleet);
    opened(app, Some(configuration))
}

/// Closes the window and opens it again: only what is in the workspace is known.
fn start_again(app: WindowTest) -> WindowTest {
    opened(app, None)
}

fn opened(app: WindowTest, configuration: Option<Configuration>) -> WindowTest {
    let WindowTest { window, fleet, runtime, workspace, folder } = app;
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
        connectors: Arc::new(fleet.connector).into(),
        starter: None,
        picker: Arc::new(FixedPicker(Ok(None))),
    };
    let backend = TokioBackend::new(backend, || {}).unwrap();
    let window = window_in(workspace.clone(), backend, configuration, SIZE);
    let mut app = WindowTest { window, fleet, runtime, workspace, folder };
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.store.is_some());
    app
}

fn idle(app: &mut WindowTest) {
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        let model = &window.state().model;
        model.job.is_none() && model.dialogs.is_empty()
    });
}

/// Once it is asked for.
fn open_vault(app: &mut WindowTest, passphrase: &str) {
    app.wait_for("Open the vault for passwords");
    type_into(&mut app.window, "Passphrase", passphrase);
    app.click("Open");
    idle(app);
}

fn vault(app: &WindowTest) -> Option<VaultState> {
    app.window.state().model.store.map(|store| store.vault)
}

#[test]
fn a_vault_keeps_passwords_where_there_is_no_keyring() {
    let mut app = app(2);
    app.click("Tick all");
    app.click("Get new information");
    app.wait_for("Connection password needed");
    assert!(shows(&app.window, "known until this window is closed"));
    type_into(&mut app.window, "Connection password", test_fleet::PASSWORD);
    app.click("Use for these controllers");
    // What was asked for is done, and no complaint lies over it.
    idle(&mut app);
    assert!(shows(&app.window, "Get new information: 2 controllers done"));
    app.click("Passwords are not kept");
    app.wait_for("Create a vault for passwords");
    type_into(&mut app.window, "Passphrase", "short");
    assert!(shows(&app.window, "At least 8 characters"));
    type_into(&mut app.window, "Passphrase", PASSPHRASE);
    type_into(&mut app.window, "Passphrase again", PASSPHRASE);
    app.click("Create");
    app.wait_for("The vault was created");
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        window.state().model.store.is_some_and(|store| store.vault == VaultState::Open { passwords: 2 })
    });
    assert!(!shows(&app.window, "Passwords are not kept"));
    app.wait_until_saved(|configuration| configuration.options.passwords == PasswordPlace::Vault);

    app = start_again(app);
    app.click("Tick all");
    app.click("Get new information");
    app.wait_for("Open the vault for passwords");
    type_into(&mut app.window, "Passphrase", "correct house");
    app.click("Open");
    app.wait_for("The passphrase does not open the vault");
    type_into(&mut app.window, "Passphrase", PASSPHRASE);
    app.click("Open");
    idle(&mut app);
    assert!(shows(&app.window, "Get new information: 2 controllers done"));
    // Once in a run is enough.
    app.click("Get new information");
    idle(&mut app);

    choose(&mut app.window, &["Options", "Options…"]);
    assert!(shows(&app.window, "The vault is open and holds 2 passwords"));
    app.click("Change passphrase…");
    type_into(&mut app.window, "Passphrase", PASSPHRASE);
    type_into(&mut app.window, "New passphrase", "battery staple");
    type_into(&mut app.window, "Passphrase again", "battery staple");
    app.click("Change");
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.dialogs.len() == 1);
    app.click("Close vault");
    app.wait_for("The vault is closed");
    app.click("Close");
    app.click("Get new information");
    open_vault(&mut app, "battery staple");
}

#[test]
fn who_does_not_open_the_vault_enters_passwords_as_before() {
    let mut app = app(1);
    app.workspace.vault().create(&PASSPHRASE.into()).unwrap();
    app.tick(&["cell 1"]);
    app.click("Get new information");
    app.wait_for("Open the vault for passwords");
    app.click("Cancel");
    app.wait_for("Connection password needed");
    type_into(&mut app.window, "Connection password", test_fleet::PASSWORD);
    app.click("OK");
    idle(&mut app);
    assert_eq!(vault(&app), Some(VaultState::Declined));
    app.click("Get new information");
    idle(&mut app);
    // Later it was opened all the same, and takes in what was entered.
    app.click("Passwords are not kept");
    open_vault(&mut app, PASSPHRASE);
    assert_eq!(vault(&app), Some(VaultState::Open { passwords: 1 }));
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
        remote: RemoteOptions::default(),
        seed: 7,
    }
}

#[test]
fn a_controller_that_is_switched_off_is_added_now_and_confirmed_later_and_its_missing_password_is_remembered() {
    let mut app = app(0);
    let free = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = free.local_addr().unwrap().port();
    drop(free);
    app.click("Add a controller");
    type_into(&mut app.window, "Name", "Weld 1");
    type_into(&mut app.window, "IP address", &format!("127.0.0.1:{port}"));
    app.click("Apply");
    app.wait_for("Add without confirming its identity");
    app.click("Add without confirming its identity");
    assert!(shows(&app.window, "Not confirmed") && shows(&app.window, "Weld 1 was added"));
    app.wait_until_saved(|configuration| {
        configuration.controllers.iter().any(|entry| entry.fingerprint.is_none() && entry.name.as_str() == "Weld 1")
    });

    // It has no password, and is switched on.
    let folder = tempfile::tempdir().unwrap();
    let fleet = app.runtime.block_on(Fleet::start(controller(port, "", folder.path()))).unwrap();
    app.workspace.vault().create(&PASSPHRASE.into()).unwrap();
    app.tick(&["Weld 1"]);
    app.click("Get new information");
    let shown = fleet.controllers()[0].fingerprint().grouped().replace(':', " ");
    app.wait_for(&shown[..23]);
    assert!(app.window.state().model.rows.all()[0].entry.fingerprint.is_none());
    app.click("It matches, go on");
    // The vault is asked for as soon as there is something to put into it.
    open_vault(&mut app, PASSPHRASE);
    assert!(!shows(&app.window, "Not confirmed"));
    app.wait_until_saved(|configuration| configuration.controllers.iter().all(|entry| entry.fingerprint.is_some()));
    app = start_again(app);
    app.tick(&["Weld 1"]);
    app.click("Get new information");
    // That there is no password is known: it is not asked for.
    open_vault(&mut app, PASSPHRASE);
    assert!(shows(&app.window, "Get new information: 1 controller done"));
    app.runtime.block_on(fleet.shutdown());
}
