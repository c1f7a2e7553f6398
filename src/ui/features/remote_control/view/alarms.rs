use egui::{RichText, Ui};

use super::button::act;
use crate::model::Problem;
use crate::remote::{AlarmNumber, Request};
use crate::texts::{self, TextKey as T};
use crate::ui::features::remote_control::RemoteForm;
use crate::ui::model::{Message, Model};
use crate::ui::theme::palette;
use crate::ui::widgets::small_note;

/// The alarms of parts that wear, each with a button that resets it.
pub fn show(ui: &mut Ui, form: &RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    small_note(ui, text(T::RemoteAlarmsNote));
    match &form.alarms {
        None => drop(ui.label(text(T::Reading))),
        Some(Err(error)) => {
            let said = Problem::from(error.clone()).code.explain(model.language).message;
            ui.label(RichText::new(said).color(palette(ui).error));
        }
        Some(Ok(alarms)) if alarms.is_empty() => {
            ui.label(RichText::new(text(T::RemoteNoAlarm)).color(palette(ui).ok));
        }
        Some(Ok(alarms)) => {
            for alarm in alarms.iter().copied().filter_map(AlarmNumber::new) {
                ui.horizontal(|ui| {
                    ui.label(texts::remote_alarms(model.language, &alarm.to_string()));
                    act(ui, form, T::RemoteResetAlarm, &Request::ResetAlm { alarm }, model, messages);
                });
            }
        }
    }
}
