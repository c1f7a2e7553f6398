//! Export and import of settings.

use secrecy::ExposeSecret as _;

use super::*;
use crate::jobs::{ExportSettings, ImportSettings, ServerEffect};
use crate::model::FirmwareVersion;
use crate::ui::features::settings_transfer::{ExportPreview, TransferForm};
use crate::ui::model::ExportFound;

fn know(model: &mut Model, name: &str, firmware: FirmwareVersion) {
    let row = model.rows.all().iter().find(|row| row.entry.name.as_str() == name).unwrap().id;
    let info = ControllerInfo { firmware, series: crate::model::ControllerSeries::Rc700, ..info() };
    model.rows.set_info(row, info, now());
}

fn legacy() -> FirmwareVersion {
    FirmwareVersion::new(7, 5, 54)
}

fn form(model: &mut Model) -> &mut TransferForm {
    model.top_mut::<TransferForm>().expect("a form")
}

#[test]
fn only_legacy_firmware_has_its_settings_exported() {
    let mut model = model();
    let why = |model: &Model| UiCommand::EXPORT_SETTINGS.why_disabled(model);
    assert_eq!(why(&model), Some(crate::texts::TextKey::WhyTick));
    tick(&mut model, &["Paint", "Weld 2"]);
    assert_eq!(why(&model), None, "nothing is known yet; the controllers say so themselves");
    know(&mut model, "Paint", legacy());
    assert_eq!(why(&model), None);
    know(&mut model, "Weld 2", FirmwareVersion::new(8, 0, 0));
    assert_eq!(why(&model), Some(crate::texts::TextKey::WhyLegacyOnly));
    tick(&mut model, &["Weld 2"]);
    assert_eq!(why(&model), None);
}

#[test]
fn an_export_goes_out_after_it_was_confirmed_with_the_passphrase_or_none() {
    let mut model = model();
    tick(&mut model, &["Paint", "Weld 2"]);
    assert!(reduce(&mut model, Message::Invoke(UiCommand::EXPORT_SETTINGS)).is_empty());
    assert!(form(&mut model).path.ends_with("<serial>/option.json"));
    let workspace = model.workspace.clone();
    let task = form(&mut model).task(&workspace).unwrap();
    assert!(task.operation::<ExportSettings>().unwrap().passphrase.is_none());
    form(&mut model).passphrase.0 = "7 chars".into();
    assert!(form(&mut model).task(&workspace).is_none());
    reduce(&mut model, Message::Submit);
    form(&mut model).passphrase.0 = "correct horse".into();
    assert!(reduce(&mut model, Message::Submit).is_empty());
    assert!(model.top::<ConfirmDialog>().unwrap().confirmation.overwrites_export);
    let commands = reduce(&mut model, Message::Submit);
    assert!(!format!("{commands:?} {:?}", model.dialogs).contains("correct"), "no secret in a log");
    let [BackendCommand::Run { task, controllers, .. }] = &commands[..] else { panic!("{commands:?}") };
    let passphrase = task.operation::<ExportSettings>().unwrap().passphrase.as_ref().unwrap();
    assert_eq!((passphrase.expose_secret(), controllers.len()), ("correct horse", 2));
    assert!(model.is_only::<ProcessingDialog>());
}

#[test]
fn the_file_is_looked_at_before_an_import() {
    let mut model = model();
    know(&mut model, "Paint", legacy());
    tick(&mut model, &["Paint"]);
    let look = |model: &mut Model| match reduce(model, Message::Invoke(UiCommand::IMPORT_SETTINGS))[..] {
        [BackendCommand::LookAtExport { job, .. }] => job,
        ref other => panic!("{other:?}"),
    };
    let seen = |model: &mut Model, job, result| {
        assert!(reduce(model, Message::Event(BackendEvent::ExportSeen { job, result })).is_empty());
    };
    let old = look(&mut model);
    assert!(form(&mut model).path.ends_with("SN1/option.json"));
    let workspace = model.workspace.clone();
    assert!(form(&mut model).task(&workspace).is_none(), "still looking");
    reduce(&mut model, Message::Close);
    let job = look(&mut model);
    let found = ExportFound { exported: now(), firmware: legacy() };
    seen(&mut model, old, Ok(found));
    assert_eq!(form(&mut model).preview, ExportPreview::Reading(job), "that was for the one closed");
    seen(&mut model, job, Err(ErrorCode::ExportMissing.into()));
    assert!(form(&mut model).task(&workspace).is_none());
    reduce(&mut model, Message::Close);

    let job = look(&mut model);
    seen(&mut model, job, Ok(found));
    form(&mut model).passphrase.0 = "short".into();
    reduce(&mut model, Message::Submit);
    let confirmation = model.top::<ConfirmDialog>().expect("a question").confirmation;
    assert!(confirmation.server == ServerEffect::Restarts && confirmation.replaces_settings);
    let commands = reduce(&mut model, Message::Submit);
    let [BackendCommand::Run { task, .. }] = &commands[..] else { panic!("{commands:?}") };
    assert!(task.operation::<ImportSettings>().unwrap().passphrase.is_some());
}

#[test]
fn many_are_imported_without_a_look_and_cancel_leads_back() {
    let mut model = model();
    tick(&mut model, &["Paint", "Weld 2"]);
    assert!(reduce(&mut model, Message::Invoke(UiCommand::IMPORT_SETTINGS)).is_empty());
    reduce(&mut model, Message::Submit);
    reduce(&mut model, Message::Close);
    assert_eq!(form(&mut model).preview, ExportPreview::None);
}
