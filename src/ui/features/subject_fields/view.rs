use egui::{ComboBox, Popup, PopupCloseBehavior, Response, ScrollArea, TextEdit, Ui};

use super::SubjectFields;
use crate::model::{Country, Language};
use crate::texts::{self, TextKey as T};
use crate::ui::model::Model;
use crate::ui::theme;
use crate::ui::widgets::{choices, labelled, mistake, small_note, text_field};

/// The fields, as rows of a form.
pub fn show(ui: &mut Ui, certificate: &mut SubjectFields, model: &Model) {
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
}

fn complain(ui: &mut Ui, certificate: &SubjectFields, field: &str, model: &Model) {
    if let Some(error) = certificate.error(field) {
        mistake(ui, error.text(model.language));
    }
}

/// A list to choose from that can be searched in every language and by code.
fn country(ui: &mut Ui, certificate: &mut SubjectFields, language: Language) -> Response {
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
