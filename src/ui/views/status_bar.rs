use egui::{Align, Button, Layout, RichText, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::features::recorder::RecorderForm;
use crate::ui::features::vault::VaultRequest;
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};

pub fn show(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let (language, rows, palette) = (model.language, &model.rows, palette(ui));
    let small = |text: String| RichText::new(text).size(theme::SMALL_TEXT);
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = theme::SPACE_LARGE;
        ui.spacing_mut().interact_size.y = theme::CHIP_HEIGHT;
        let all = rows.all().len();
        let count = match rows.shown() {
            shown if shown == all => texts::controllers(language, all),
            shown => texts::shown_of(language, shown, all),
        };
        ui.label(small(count).color(palette.weak));
        if rows.ticked_count() > 0 {
            ui.label(small(texts::ticked(language, rows.ticked_count(), rows.ticked_hidden())).color(palette.text));
        }
        if rows.expired_count() > 0 {
            ui.label(small(texts::expired(language, rows.expired_count())).color(palette.error));
        }
        if rows.expiring_count() > 0 {
            ui.label(small(texts::expiring(language, rows.expiring_count())).color(palette.warning));
        }
        if model.not_kept.is_some() {
            let text = small(T::PasswordsNotKept.text(language).to_owned()).color(palette.warning);
            let response = ui.add(Button::new(text).frame(false)).on_hover_text(T::PasswordsNotKeptTip.text(language));
            if response.clicked() {
                messages.push(Message::act(|model| model.vault_request(VaultRequest::NotKept)));
            }
        }
        if let Some(form) = model.hidden::<RecorderForm>() {
            let (said, color) = match (form.active(), form.failed()) {
                (0, 0) => (texts::recordings_ended(language, 0), palette.ok),
                (0, failed) => (texts::recordings_ended(language, failed), palette.error),
                (active, _) => (texts::recordings_running(language, active), palette.accent),
            };
            let button = ui.add(Button::new(small(said).color(color)).frame(false));
            if button.on_hover_text(T::RecorderBackTip.text(language)).clicked() {
                messages.push(Message::act(|model| model.open_recorder(vec![])));
            }
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if model.virtual_starting {
                ui.label(small(T::StartingVirtual.text(language).to_owned()));
            } else if let Some(status) = &model.status {
                ui.add(egui::Label::new(small(status.clone())).truncate());
            }
        });
    });
}
