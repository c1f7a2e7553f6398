//! How the dialogs are drawn.

mod opened;
mod plot;
mod running;
mod setup;
mod summary;

use egui::Ui;

use super::form::RecorderForm;
use crate::ui::model::{DialogAnswer, DialogPlace, Message, Model};

pub use opened::show as opened;

/// The settings at first, then the recordings.
pub fn recorder(
    ui: &Ui,
    form: &mut RecorderForm,
    place: DialogPlace,
    model: &Model,
    messages: &mut Vec<Message>,
) -> DialogAnswer {
    if form.recordings.is_empty() {
        setup::show(ui, form, model, messages)
    } else {
        running::show(ui, form, place, model, messages)
    }
}
