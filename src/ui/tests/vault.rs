//! Where passwords are kept, and what is asked for when.

use super::*;
use crate::ui::features::vault::{VaultAction, VaultForm, VaultRequest};
use crate::ui::model::VaultWork;
use crate::workspace::{PasswordPlace, StoreStatus, VaultState};

fn status(vault: VaultState) -> StoreStatus {
    StoreStatus { place: PasswordPlace::Vault, keyring_fails: false, vault }
}

fn with_vault(vault: VaultState) -> Model {
    let mut model = model();
    reduce(&mut model, Message::Event(BackendEvent::PasswordStore(status(vault))));
    model
}

/// Two controllers are read; the first is done, the password of the second is in the closed vault.
fn find_it_closed(model: &mut Model) {
    tick(model, &["Weld 2", "Paint"]);
    let id = job(&reduce(model, Message::Invoke(UiCommand::GET_INFO)));
    done(model, id, 0, NoOutput);
    fail(model, id, 1, ErrorCode::VaultLocked);
    ended(model, id, 1, 1);
}

fn form(model: &mut Model) -> &mut VaultForm {
    model.top_mut::<VaultForm>().expect("the vault is asked about")
}

#[test]
fn the_passphrase_is_asked_for_when_it_is_needed_and_the_job_goes_on() {
    let mut model = with_vault(VaultState::Closed);
    find_it_closed(&mut model);
    assert!(reduce(&mut model, Message::Submit).is_empty(), "nothing was entered");
    form(&mut model).passphrase.0 = "correct house".into();
    let work = reduce(&mut model, Message::Submit);
    assert!(matches!(work[..], [BackendCommand::Vault(VaultWork::Open { .. })]));
    assert!(!format!("{work:?}{:?}", model.dialogs).contains("house"));
    assert!(reduce(&mut model, Message::Submit).is_empty(), "once is enough");
    assert!(reduce(&mut model, Message::Close).is_empty(), "what is being done is not cancelled");
    reduce(&mut model, Message::Event(BackendEvent::VaultDone(Err(ErrorCode::VaultPassphrase.into()))));
    assert_eq!(form(&mut model).problem, Some(ErrorCode::VaultPassphrase.into()));

    reduce(&mut model, Message::Submit);
    let commands = reduce(&mut model, Message::Event(BackendEvent::VaultDone(Ok(()))));
    let [BackendCommand::Run { controllers, password: None, .. }] = &commands[..] else { panic!("{commands:?}") };
    assert_eq!(controllers.len(), 1, "only the one that failed");
    assert!(model.is_only::<ProcessingDialog>());
}

#[test]
fn who_does_not_open_the_vault_is_asked_for_the_password() {
    let mut model = with_vault(VaultState::Closed);
    find_it_closed(&mut model);
    let commands = reduce(&mut model, Message::Close);
    assert!(matches!(commands[..], [BackendCommand::Vault(VaultWork::Decline)]));
    let Some(asked) = model.top_mut::<PasswordDialog>() else { panic!("not asked") };
    assert_eq!(asked.names, ["Paint"]);
    asked.password.0 = "secret".into();
    let commands = reduce(&mut model, Message::Submit);
    assert!(matches!(&commands[..], [BackendCommand::Run { password: Some(_), .. }]));
    // It may be opened later all the same.
    reduce(&mut model, Message::Event(BackendEvent::PasswordStore(status(VaultState::Declined))));
    reduce(&mut model, Message::Event(BackendEvent::PasswordNotKept(ErrorCode::VaultLocked.into())));
    reduce(&mut model, Message::act(|model| model.vault_request(VaultRequest::NotKept)));
    assert_eq!(form(&mut model).action, VaultAction::Open);
}

/// The result is shown also if the password cannot be kept.
#[test]
fn a_password_that_is_not_kept_opens_no_dialog() {
    for code in [ErrorCode::KeyringUnavailable, ErrorCode::VaultLocked, ErrorCode::WorkspaceFull] {
        let mut model = with_vault(VaultState::Declined);
        tick(&mut model, &["Weld 2", "Paint"]);
        let id = job(&reduce(&mut model, Message::Invoke(UiCommand::GET_INFO)));
        reduce(&mut model, Message::Event(BackendEvent::PasswordNotKept(code.into())));
        done(&mut model, id, 0, NoOutput);
        fail(&mut model, id, 1, ErrorCode::Unreachable);
        ended(&mut model, id, 1, 1);
        assert_eq!(model.top::<ProcessingDialog>().unwrap().selected, Some(1));
        assert_eq!(model.not_kept, Some(code.into()));
        reduce(&mut model, Message::Close);
        reduce(&mut model, Message::act(|model| model.vault_request(VaultRequest::NotKept)));
        match code {
            ErrorCode::VaultLocked => assert_eq!(open(&model), ["VaultForm"]),
            ErrorCode::WorkspaceFull => assert_eq!(model.top::<ErrorDialog>().unwrap().0.code, code),
            _ => assert_eq!(open(&model), ["ErrorDialog"]),
        }
    }
}

#[test]
fn a_pc_without_a_keyring_is_offered_a_vault() {
    let mut model = model();
    assert_eq!(model.store, None, "none in the demo");
    let none = StoreStatus { place: PasswordPlace::Keyring, keyring_fails: true, vault: VaultState::None };
    reduce(&mut model, Message::Event(BackendEvent::PasswordStore(none)));
    reduce(&mut model, Message::Event(BackendEvent::PasswordNotKept(ErrorCode::KeyringUnavailable.into())));
    reduce(&mut model, Message::act(|model| model.vault_request(VaultRequest::NotKept)));
    let asked = form(&mut model);
    assert_eq!(asked.action, VaultAction::Create);
    for (passphrase, again, complete) in [
        ("", "", false),
        ("short", "short", false),
        ("correct horse", "correct house", false),
        ("correct horse", "correct horse", true),
    ] {
        let asked = form(&mut model);
        (asked.passphrase.0, asked.again.0) = (passphrase.into(), again.into());
        assert_eq!(asked.incomplete().is_none(), complete, "{passphrase}, {again}");
    }
    let work = reduce(&mut model, Message::Submit);
    let [BackendCommand::Vault(VaultWork::Create { controllers, .. })] = &work[..] else { panic!("{work:?}") };
    assert_eq!(controllers.len(), 3, "the keyring may know them");
    let saved = reduce(&mut model, Message::Event(BackendEvent::VaultDone(Ok(()))));
    let [BackendCommand::Save(configuration)] = &saved[..] else { panic!("{saved:?}") };
    assert_eq!(configuration.options.passwords, PasswordPlace::Vault);
    assert_eq!((model.not_kept.clone(), model.dialogs.len()), (None, 0));
}

#[test]
fn the_passphrase_is_changed_with_the_present_one_and_a_place_is_chosen() {
    let mut model = with_vault(VaultState::Open { passwords: 2 });
    reduce(&mut model, Message::act(|model| model.vault_request(VaultRequest::ChangePassphrase)));
    let asked = form(&mut model);
    (asked.new.0, asked.again.0) = ("another one".into(), "another one".into());
    assert_eq!(asked.incomplete(), Some(TextKey::VaultPassphraseNeeded));
    asked.passphrase.0 = "correct horse".into();
    assert!(matches!(
        reduce(&mut model, Message::Submit)[..],
        [BackendCommand::Vault(VaultWork::ChangePassphrase { .. })]
    ));
    reduce(&mut model, Message::Event(BackendEvent::VaultDone(Ok(()))));
    assert!(model.dialogs.is_empty());

    let chosen =
        reduce(&mut model, Message::act(|model| model.vault_request(VaultRequest::Use(PasswordPlace::Keyring))));
    assert!(matches!(
        chosen[..],
        [BackendCommand::Save(_), BackendCommand::Vault(VaultWork::Use(PasswordPlace::Keyring))]
    ));
    assert!(matches!(
        reduce(&mut model, Message::act(|model| model.vault_request(VaultRequest::Close)))[..],
        [BackendCommand::Vault(VaultWork::Close)]
    ));
    let mut without = with_vault(VaultState::None);
    assert!(
        reduce(&mut without, Message::act(|model| model.vault_request(VaultRequest::Use(PasswordPlace::Vault))))
            .is_empty()
    );
    assert_eq!(form(&mut without).action, VaultAction::Create, "first it is made");
}

/// The vault is asked for after the first password of a run, also where that is of a new controller.
#[test]
fn a_controller_is_added_before_the_vault_is_asked_for() {
    let mut model = with_vault(VaultState::Closed);
    reduce(&mut model, Message::Invoke(UiCommand::ADD_CONTROLLER));
    let Some(open) = model.top_mut::<AddControllerForm>() else { panic!("no form") };
    (open.name, open.address) = ("New".into(), "10.0.0.77".into());
    let [BackendCommand::Probe { job, .. }] = reduce(&mut model, Message::Submit)[..] else { panic!("no probe") };
    let fingerprint = Fingerprint::of(b"new");
    reduce(&mut model, Message::Event(BackendEvent::Probed { job, result: Ok(fingerprint) }));
    let [BackendCommand::Enroll { job, .. }] = reduce(&mut model, Message::Submit)[..] else { panic!("no enrolment") };
    let password_not_kept = Some(ErrorCode::VaultLocked.into());
    let enrolled = crate::jobs::Enrolled { fingerprint, info: info(), password_not_kept };
    let saved = reduce(&mut model, Message::Event(BackendEvent::Enrolled { job, result: Ok(Box::new(enrolled)) }));
    assert!(matches!(saved[..], [BackendCommand::Save(_)]));
    assert_eq!(model.rows.all().len(), 4);
    assert!(model.is_only::<VaultForm>());
    assert!(matches!(reduce(&mut model, Message::Close)[..], [BackendCommand::Vault(VaultWork::Decline)]));
    assert!(model.dialogs.is_empty() && model.not_kept.is_some());
}

/// Tries to add a controller; what came of it.
fn probed(model: &mut Model, result: Result<Fingerprint, Problem>) {
    reduce(model, Message::Invoke(UiCommand::ADD_CONTROLLER));
    let Some(open) = model.top_mut::<AddControllerForm>() else { panic!("no form") };
    (open.name, open.address) = ("New".into(), "10.0.0.77".into());
    let [BackendCommand::Probe { job, .. }] = reduce(model, Message::Submit)[..] else { panic!("no probe") };
    reduce(model, Message::Event(BackendEvent::Probed { job, result }));
}

#[test]
fn a_controller_that_is_switched_off_is_added_without_a_fingerprint() {
    for code in [ErrorCode::Unreachable, ErrorCode::Timeout, ErrorCode::ConnectionLost] {
        let mut model = model();
        probed(&mut model, Err(code.into()));
        let saved = reduce(&mut model, Message::act(Model::add_unconfirmed));
        assert!(matches!(saved[..], [BackendCommand::Save(_)]), "nothing is sent to it");
        let row = model.rows.all().last().unwrap();
        assert_eq!((row.entry.name.as_str(), row.entry.fingerprint, row.info()), ("New", None, None));
        assert!(model.dialogs.is_empty());
        tick(&mut model, &["New"]);
        assert_eq!(UiCommand::CONFIRM_IDENTITY.why_disabled(&model), None);
        let asked = reduce(&mut model, Message::Invoke(UiCommand::GET_INFO));
        assert_eq!(probe(&asked).1, "10.0.0.77", "its identity comes first");
    }
    // Something else is there, or it was not tried.
    let mut model = model();
    probed(&mut model, Err(ErrorCode::NotAController.into()));
    assert!(reduce(&mut model, Message::act(Model::add_unconfirmed)).is_empty());
    reduce(&mut model, Message::Close);
    reduce(&mut model, Message::Invoke(UiCommand::ADD_CONTROLLER));
    assert!(reduce(&mut model, Message::act(Model::add_unconfirmed)).is_empty());
    reduce(&mut model, Message::Close);
    // The name was taken meanwhile.
    probed(&mut model, Err(ErrorCode::Unreachable.into()));
    if let Some(open) = model.top_mut::<AddControllerForm>() {
        open.name = "Paint".into();
    }
    assert!(reduce(&mut model, Message::act(Model::add_unconfirmed)).is_empty());
    assert_eq!(model.rows.all().len(), 3);
}
