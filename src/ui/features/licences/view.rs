use egui::{Align, Label, Layout, RichText, ScrollArea, TextEdit, Ui, vec2};

use crate::licences::Licences;
use crate::texts::TextKey as T;
use crate::ui::features::licences::LicencesView;
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, small_note};

const LIST_WIDTH: f32 = 320.0;

/// The licences of everything linked in (manual appendix B-2): the list on the left, the texts on the right.
pub fn show(ui: &Ui, view: &mut LicencesView, focus: bool, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Close), None)), close: None };
    dialog(ui, "licences", text(T::LicencesTitle), theme::DIALOG_LOG, buttons, |ui| {
        let filter = TextEdit::singleline(&mut view.filter)
            .hint_text(text(T::LicencesFilter))
            .desired_width(LIST_WIDTH)
            .margin(theme::SEARCH_MARGIN);
        let filter = ui.add(filter).accessible_name(text(T::LicencesFilter));
        if focus {
            filter.request_focus();
        }
        if filter.changed() {
            view.find();
        }
        ui.add_space(theme::SPACE);
        let height = (ui.ctx().content_rect().height() - theme::LOG_MARGIN).clamp(theme::LIST_ROW, theme::LOG_HEIGHT);
        ui.allocate_ui_with_layout(vec2(ui.available_width(), height), Layout::left_to_right(Align::Min), |ui| {
            components(ui, view, height, model);
            ui.separator();
            texts(ui, view, height);
        });
    })
}

fn components(ui: &mut Ui, view: &mut LicencesView, height: f32, model: &Model) {
    ui.vertical(|ui| {
        ui.set_width(LIST_WIDTH);
        if view.shown().is_empty() {
            small_note(ui, T::LicencesNone.text(model.language));
            return;
        }
        ui.spacing_mut().item_spacing.y = 0.0;
        let rows = ScrollArea::vertical().id_salt("components").max_height(height).auto_shrink(false);
        let mut clicked = None;
        rows.show_rows(ui, theme::LIST_ROW, view.shown().len(), |ui, range| {
            for at in range {
                let index = view.shown()[at];
                let component = &Licences::get().components()[index];
                let size = vec2(ui.available_width(), theme::LIST_ROW);
                let version = RichText::new(&component.version).size(theme::SMALL_TEXT).color(palette(ui).weak);
                let button = egui::Button::selectable(view.is_selected(index), &component.name).right_text(version);
                let line = format!("{} {}", component.name, component.version);
                if ui.add_sized(size, button.truncate()).accessible_name(&line).clicked() {
                    clicked = Some(index);
                }
            }
        });
        if let Some(index) = clicked {
            view.select(index);
        }
    });
}

fn texts(ui: &mut Ui, view: &LicencesView, height: f32) {
    let Some(component) = view.selected() else { return };
    ui.vertical(|ui| {
        ui.label(RichText::new(&component.name).strong());
        ui.label(RichText::new(&component.licence).size(theme::SMALL_TEXT).color(palette(ui).weak));
        ui.add_space(theme::SPACE);
        // A component of its own scrolls from its beginning.
        let area = ScrollArea::vertical().id_salt(("texts", &component.name, &component.version));
        area.max_height(height - 3.0 * theme::LIST_ROW).auto_shrink(false).show(ui, |ui| {
            for text in Licences::get().texts_of(component) {
                ui.add(Label::new(RichText::new(text).size(theme::SMALL_TEXT)).wrap().selectable(true));
                ui.separator();
            }
        });
    });
}
