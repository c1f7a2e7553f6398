use egui::{ComboBox, DragValue, Label, RichText, Ui};

use crate::model::{AuthorityValidity, CertificateProfile, KeyLength, Validity};
use crate::pki::REVOCATION_REASONS;
use crate::texts::{self, TextKey as T};
use crate::ui::features::certificate_authority::{
    AuthorityAction, AuthorityForm, CreateAuthorityForm, SignControllersForm, SignFileForm,
};
use crate::ui::model::{DialogAnswer, Message, Model, SecretInput};
use crate::ui::shell::confirm::names;
use crate::ui::shell::error;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{
    Buttons, choices, dialog, file_field, form, labelled, mistake, note, secret_field, small_note, text_field,
};

/// Something the CA is asked for, with its passphrase.
pub fn show(
    ui: &Ui,
    asked: &mut AuthorityForm,
    focus: bool,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let (title, submit) = match &asked.action {
        AuthorityAction::Create(_) => (T::CaCreateTitle, T::CaCreateNow),
        AuthorityAction::Restore { .. } => (T::CaRestoreTitle, T::CaRestoreNow),
        AuthorityAction::SignControllers(_) => (T::CaSignTitle, T::CaSign),
        AuthorityAction::SignFile(_) if asked.reads_file() => (T::CaSignFileTitle, T::ReadFile),
        AuthorityAction::SignFile(_) => (T::CaSignFileTitle, T::CaSign),
        AuthorityAction::Revoke { .. } => (T::CaRevokeTitle, T::CaRevokeNow),
        AuthorityAction::PublishCrl { .. } => (T::CaCrlTitle, T::CaPublishNow),
        AuthorityAction::BackUp { .. } => (T::CaBackUpTitle, T::CaBackUpNow),
    };
    let why = asked.incomplete().map(text);
    let buttons = Buttons { submit: Some((text(submit), why)), close: Some(text(T::Cancel)) };
    dialog(ui, "authority form", text(title), theme::DIALOG_WIDE, buttons, |ui| {
        let AuthorityForm { action, passphrase, show_passphrase, working, problem } = asked;
        ui.add_enabled_ui(working.is_none(), |ui| {
            let first = match action {
                AuthorityAction::Create(form) => {
                    create(ui, form, (passphrase, show_passphrase), focus, model);
                    return;
                }
                AuthorityAction::Restore { path } => self::path(ui, path, T::CaRestoreText, focus, model),
                AuthorityAction::BackUp { path } => self::path(ui, path, T::CaBackUpText, false, model),
                AuthorityAction::SignControllers(form) => sign_controllers(ui, form, model),
                AuthorityAction::SignFile(form) => sign_file(ui, form, focus, model, messages),
                AuthorityAction::Revoke { names, reason, .. } => revoke(ui, names, reason, model),
                AuthorityAction::PublishCrl { rows, names, push, trust } => {
                    publish(ui, (!rows.is_empty()).then_some(names), push, trust, model)
                }
            };
            form(ui, "passphrase", |ui| {
                labelled(ui, text(T::Passphrase), |ui| {
                    let response = secret_field(ui, &mut passphrase.0, show_passphrase, "", model.language);
                    if focus && first {
                        response.request_focus();
                    }
                    Some(response)
                });
            });
        });
        if working.is_some() {
            ui.add_space(theme::SPACE);
            ui.label(RichText::new(text(T::CaWorking)).color(palette(ui).weak));
        }
        if let Some(problem) = problem {
            ui.add_space(theme::SPACE);
            note(ui, palette(ui).error, |ui| {
                ui.label(RichText::new(problem.code.explain(model.language).message).strong());
                ui.add_space(theme::SPACE);
                error::explanation(ui, problem, model.language);
            });
        }
    })
}

fn create(
    ui: &mut Ui,
    new: &mut CreateAuthorityForm,
    (passphrase, show): (&mut SecretInput, &mut bool),
    focus: bool,
    model: &Model,
) {
    let text = |key: T| key.text(model.language);
    form(ui, "create", |ui| {
        labelled(ui, text(T::CommonName), |ui| {
            let response = text_field(ui, &mut new.common_name, text(T::CaNameHint));
            if focus {
                response.request_focus();
            }
            complain(ui, new.name_error(), model);
            Some(response)
        });
        labelled(ui, text(T::Organisation), |ui| {
            let response = text_field(ui, &mut new.organisation, text(T::Optional));
            complain(ui, new.organisation_error(), model);
            Some(response)
        });
        labelled(ui, text(T::Validity), |ui| {
            let range = AuthorityValidity::MIN_YEARS..=AuthorityValidity::MAX_YEARS;
            Some(ui.add(DragValue::new(&mut new.years).range(range)))
        });
        labelled(ui, text(T::KeyLength), |ui| {
            choices(ui, |ui| {
                for length in [KeyLength::Rsa2048, KeyLength::Rsa4096] {
                    ui.radio_value(&mut new.key_length, length, texts::bits(model.language, length.bits()));
                }
            });
            None
        });
        labelled(ui, "", |ui| {
            ui.checkbox(&mut new.intermediate, text(T::CaIntermediate));
            small_note(ui, text(T::CaIntermediateTip));
            None
        });
        labelled(ui, text(T::Passphrase), |ui| {
            let response = secret_field(ui, &mut passphrase.0, show, "", model.language);
            complain(ui, new.passphrase_error(passphrase), model);
            Some(response)
        });
        labelled(ui, text(T::CaPassphraseAgain), |ui| {
            let response = secret_field(ui, &mut new.again.0, show, "", model.language);
            complain(ui, new.again_error(passphrase), model);
            Some(response)
        });
    });
    ui.add_space(theme::SPACE);
    note(ui, palette(ui).warning, |ui| drop(ui.add(Label::new(text(T::CaKeep)).wrap())));
}

fn complain(ui: &mut Ui, error: Option<T>, model: &Model) {
    if let Some(error) = error {
        mistake(ui, error.text(model.language));
    }
}

/// Each of these says whether the passphrase is the first thing to be typed.
fn path(ui: &mut Ui, path: &mut String, says: T, focus: bool, model: &Model) -> bool {
    ui.add(Label::new(says.text(model.language)).wrap());
    ui.add_space(theme::SPACE);
    form(ui, "path", |ui| {
        labelled(ui, T::FileLabel.text(model.language), |ui| {
            let response = text_field(ui, path, T::FileHint.text(model.language));
            if focus {
                response.request_focus();
            }
            Some(response)
        });
    });
    !focus
}

fn sign_controllers(ui: &mut Ui, signing: &mut SignControllersForm, model: &Model) -> bool {
    let text = |key: T| key.text(model.language);
    note(ui, palette(ui).warning, |ui| {
        ui.add(Label::new(text(T::ConfirmStops)).wrap());
        ui.add(Label::new(text(T::CaSignText)).wrap());
    });
    ui.add_space(theme::SPACE);
    names(ui, &signing.names);
    ui.add_space(theme::SPACE);
    form(ui, "sign", |ui| {
        labelled(ui, text(T::Validity), |ui| Some(years(ui, &mut signing.years)));
        labelled(ui, text(T::Organisation), |ui| {
            let response = text_field(ui, &mut signing.organisation, text(T::Optional));
            complain(ui, signing.organisation_error(), model);
            Some(response)
        });
        labelled(ui, "", |ui| {
            ui.checkbox(&mut signing.new_key, text(T::CaNewKey));
            ui.checkbox(&mut signing.renew, text(T::CaRenew));
            ui.checkbox(&mut signing.accept_warnings, text(T::CaAcceptWarnings));
            None
        });
    });
    true
}

fn years(ui: &mut Ui, years: &mut u8) -> egui::Response {
    ui.add(DragValue::new(years).range(Validity::MIN_YEARS..=Validity::MAX_YEARS))
}

fn sign_file(ui: &mut Ui, signing: &mut SignFileForm, focus: bool, model: &Model, messages: &mut Vec<Message>) -> bool {
    let text = |key: T| key.text(model.language);
    ui.add(Label::new(text(T::CaSignFileText)).wrap());
    ui.add_space(theme::SPACE);
    file_field(ui, &mut signing.file, focus, model, messages);
    form(ui, "sign file", |ui| {
        labelled(ui, text(T::CaRequest), |ui| {
            ui.add_space(theme::SPACE / 2.0);
            let said = match &signing.csr {
                Some(csr) if signing.file.is_shown() => {
                    texts::request(model.language, csr.common_name().unwrap_or("—"), csr.key_bits())
                }
                _ => "—".to_owned(),
            };
            ui.label(said);
            None
        });
        labelled(ui, text(T::CaProfile), |ui| {
            choices(ui, |ui| {
                for (profile, key) in
                    [(CertificateProfile::Client, T::CaClient), (CertificateProfile::Server, T::CaServer)]
                {
                    ui.radio_value(&mut signing.profile, profile, text(key));
                }
            });
            None
        });
        labelled(ui, text(T::Validity), |ui| Some(years(ui, &mut signing.years)));
    });
    false
}

fn revoke(ui: &mut Ui, revoked: &[String], reason: &mut crate::pki::RevocationReason, model: &Model) -> bool {
    let text = |key: T| key.text(model.language);
    note(ui, palette(ui).warning, |ui| drop(ui.add(Label::new(text(T::CaRevokeText)).wrap())));
    ui.add_space(theme::SPACE);
    names(ui, revoked);
    ui.add_space(theme::SPACE);
    form(ui, "revoke", |ui| {
        labelled(ui, text(T::CaReason), |ui| {
            let chosen = texts::reason(*reason);
            let list = ComboBox::from_id_salt("reason")
                .selected_text(text(chosen))
                .width(ui.available_width())
                .show_ui(ui, |ui| {
                    for one in REVOCATION_REASONS {
                        ui.selectable_value(reason, one, text(texts::reason(one)));
                    }
                });
            Some(list.response)
        });
    });
    true
}

fn publish(
    ui: &mut Ui,
    controllers: Option<&mut Vec<String>>,
    push: &mut bool,
    trust: &mut bool,
    model: &Model,
) -> bool {
    let text = |key: T| key.text(model.language);
    ui.add(Label::new(text(T::CaPublishText)).wrap());
    ui.add_space(theme::SPACE);
    match controllers {
        None => small_note(ui, text(T::CaPushNone)),
        Some(controllers) => {
            ui.checkbox(push, text(T::CaPush));
            ui.add_enabled_ui(*push, |ui| ui.checkbox(trust, text(T::CaTrust)));
            names(ui, controllers);
            if *push {
                small_note(ui, text(T::ConfirmDisconnectsClients));
            }
        }
    }
    ui.add_space(theme::SPACE);
    true
}
