//! How the vault for connection passwords looks, and adding a controller that is switched off.

use opcua_configurator::model::{ErrorCode, Problem};
use opcua_configurator::ui::VaultRequest;
use opcua_configurator::ui::backend::{BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::Message;
use opcua_configurator::workspace::{PasswordPlace, StoreStatus, VaultState};

use crate::harness::{SIZE, choose, click, now, type_into, window};
use crate::pictures::{W, assert_shows, chinese, job, picture, say, tell};
use crate::samples::configuration;

fn open(place: PasswordPlace, vault: VaultState) -> W {
    let mut configuration = configuration(5, now());
    configuration.options.passwords = place;
    let mut window = window(RecordingBackend::default(), configuration, SIZE);
    let keyring_fails = place == PasswordPlace::Keyring;
    tell(&mut window, BackendEvent::PasswordStore(StoreStatus { place, keyring_fails, vault }));
    window
}

#[test]
fn options() {
    let mut window = open(PasswordPlace::Vault, VaultState::Open { passwords: 4 });
    choose(&mut window, &["Options", "Options…"]);
    assert_shows(&window, "The vault is open and holds 4 passwords.");
}

#[test]
fn create() {
    let mut window = open(PasswordPlace::Keyring, VaultState::None);
    tell(&mut window, BackendEvent::PasswordNotKept(ErrorCode::KeyringUnavailable.into()));
    assert_shows(&window, "Passwords are not kept");
    click(&mut window, "Passwords are not kept");
    type_into(&mut window, "Passphrase", "short");
    type_into(&mut window, "Passphrase again", "longer");
    picture(&mut window, "vault_create");
}

#[test]
fn wrong_passphrase() {
    let mut window = open(PasswordPlace::Vault, VaultState::Closed);
    say(&mut window, Message::act(|model| model.vault_request(VaultRequest::Open)));
    type_into(&mut window, "Passphrase", "correct house");
    click(&mut window, "Open");
    tell(&mut window, BackendEvent::VaultDone(Err(ErrorCode::VaultPassphrase.into())));
    chinese(&mut window);
    picture(&mut window, "vault_open_chinese");
}

#[test]
fn change() {
    let mut window = open(PasswordPlace::Vault, VaultState::Open { passwords: 4 });
    say(&mut window, Message::act(|model| model.vault_request(VaultRequest::ChangePassphrase)));
    assert_shows(&window, "Copies of the vault that were made before still open with the old passphrase.");
}

#[test]
fn unreachable() {
    let mut window = open(PasswordPlace::Vault, VaultState::Closed);
    choose(&mut window, &["Controller", "Add controller…"]);
    type_into(&mut window, "Name", "Weld 1b");
    type_into(&mut window, "IP address", "10.0.0.9");
    click(&mut window, "Apply");
    let probe = job(&window);
    let unreachable = Problem::with_detail(ErrorCode::Unreachable, "connection refused (os error 111)");
    tell(&mut window, BackendEvent::Probed { job: probe, result: Err(unreachable) });
    assert_shows(&window, "Add without confirming its identity");
}
