use egui::{ComboBox, DragValue, Popup, PopupCloseBehavior, Response, RichText, ScrollArea, TextEdit, Ui};

use crate::model::{Country, Language, Validity};
use crate::texts::{self, TextKey as T};
use crate::ui::features::self_signed::SelfSignedForm;
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, choices, dialog, form, labelled, mistake, note, small_note, text_field};

/// A self-signed server certificate for one controller or many (manual 2.7.1.2), or the request for one that a CA
/// signs (2.7.1.5).
pub fn show(ui: &Ui, certificate: &mut SelfSignedForm, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let why = match certificate.task(model) {
        Some(_) => None,
        None if certificate.reading => Some(T::Reading),
        None => ["common name", "state", "locality", "organisation"].iter().find_map(|field| certificate.error(field)),
    };
    let title = if certificate.request.is_none() { T::SelfSignedTitle } else { T::CsrTitle };
    let buttons = Buttons { submit: Some((text(T::CreateAndSave), why.map(text))), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, title, &certificate.names);
    dialog(ui, "self-signed", &title, theme::DIALOG, buttons, |ui| {
        if certificate.reading {
            ui.label(RichText::new(text(T::Reading)).color(palette(ui).weak));
            return;
        }
        if certificate.request.is_some() {
            note(ui, palette(ui).warning, |ui| {
                ui.add(egui::Label::new(text(T::ConfirmInvalidatesCaSigned)).wrap());
            });
            ui.add_space(theme::SPACE);
        }
        form(ui, "self-signed", |ui| fields(ui, certificate, model));
    })
}

fn fields(ui: &mut Ui, certificate: &mut SelfSignedForm, model: &Model) {
    let text = |key: T| key.text(model.language);
    labelled(ui, text(T::CommonName), |ui| {
        if certificate.is_single() {
            let response = text_field(ui, &mut certificate.common_name, "");
            complain(ui, certificate, "common name", model);
            return Some(response);
        }
        let mut each = text(T::CommonNameEach).to_owned();
        Some(ui.add_enabled_ui(false, |ui| text_field(ui, &mut each, "")).inner)
    });
    labelled(ui, text(T::Country), |ui| Some(country(ui, certificate, model.language)));
    let optional = text(T::Optional);
    labelled(ui, text(T::State), |ui| {
        let response = text_field(ui, &mut certificate.state, optional);
        complain(ui, certificate, "state", model);
        Some(response)
    });
    labelled(ui, text(T::Locality), |ui| {
        let response = text_field(ui, &mut certificate.locality, optional);
        complain(ui, certificate, "locality", model);
        Some(response)
    });
    labelled(ui, text(T::Organisation), |ui| {
        let response = text_field(ui, &mut certificate.organisation, optional);
        complain(ui, certificate, "organisation", model);
        Some(response)
    });
    labelled(ui, text(T::KeyLength), |ui| {
        choices(ui, |ui| {
            for length in &certificate.offered {
                let label = texts::bits(model.language, length.bits());
                ui.radio_value(&mut certificate.key_length, *length, label);
            }
        });
        if certificate.is_single() {
            small_note(ui, text(T::KeyLengthOne));
        } else if certificate.key_length.bits() != 2048 {
            small_note(ui, text(T::KeyLengthMany));
        }
        None
    });
    if let Some(format) = &mut certificate.request {
        labelled(ui, text(T::FileFormat), |ui| {
            crate::ui::features::export_self_signed::format(ui, format);
            None
        });
        return;
    }
    labelled(ui, text(T::Validity), |ui| {
        Some(ui.add(DragValue::new(&mut certificate.years).range(Validity::MIN_YEARS..=Validity::MAX_YEARS)))
    });
}

fn complain(ui: &mut Ui, certificate: &SelfSignedForm, field: &str, model: &Model) {
    if let Some(error) = certificate.error(field) {
        mistake(ui, error.text(model.language));
    }
}

/// A list to choose from that can be searched in every language and by code.
fn country(ui: &mut Ui, certificate: &mut SelfSignedForm, language: Language) -> Response {
    let chosen = match Country::from_code(certificate.country) {
        Some(country) => format!("{} – {}", country.code(), country.name(language)),
        None => T::CountryNone.text(language).to_owned(),
    };
    let list = ComboBox::from_id_salt("country")
        .selected_text(chosen)
        .width(ui.available_width())
        .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
        .show_ui(ui, |ui| {
            let search = TextEdit::singleline(&mut certificate.country_search)
                .hint_text(T::CountrySearch.text(language))
                .desired_width(f32::INFINITY);
            ui.add(search).accessible_name(T::CountrySearch.text(language));
            let wanted = certificate.country_search.trim().to_lowercase();
            ScrollArea::vertical().max_height(theme::LIST_HEIGHT).show(ui, |ui| {
                let mut choose = |ui: &mut Ui, code: &'static str, label: &str| {
                    if ui.selectable_label(certificate.country == code, label).clicked() {
                        certificate.country = code;
                        Popup::close_all(ui.ctx());
                    }
                };
                if wanted.is_empty() {
                    choose(ui, "", T::CountryNone.text(language));
                }
                for country in Country::ALL {
                    let named = |language| country.name(language).to_lowercase().contains(&wanted);
                    if Language::ALL.into_iter().any(named) || country.code().to_lowercase() == wanted {
                        let label = format!("{} – {}", country.code(), country.name(language));
                        choose(ui, country.code(), &label);
                    }
                }
            });
        });
    list.response
}
