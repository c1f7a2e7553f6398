use egui::{Align, Button, Grid, Label, Layout, RichText, TextEdit, Ui, vec2};

use super::button::explain;
use crate::model::Problem;
use crate::model::untrusted_text::one_line;
use crate::remote::Command;
use crate::texts::TextKey as T;
use crate::ui::features::remote_control::RemoteForm;
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::small_note;

/// A command of SPEL+, and the results of those before it.
pub fn show(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let why = form.why_not_execute();
    ui.horizontal(|ui| {
        let edit = TextEdit::singleline(&mut form.execute.text)
            .hint_text("Print Here")
            .font(egui::TextStyle::Monospace)
            .desired_width((ui.available_width() - theme::LABEL_WIDTH).min(theme::DIALOG_WIDE))
            .margin(theme::SEARCH_MARGIN);
        let field = ui.add(edit).accessible_name(text(T::RemoteSpel));
        field.on_hover_text(text(T::RemoteSpelTip));
        let button = ui.add_enabled(why.is_none(), Button::new(text(T::RemoteExecute)));
        if explain(button, why.as_ref(), Command::Execute, model).clicked() {
            messages.push(Message::act(Model::execute_remote));
        }
    });
    small_note(ui, text(T::RemoteExecuteNote));
    ui.add_space(theme::SPACE);
    history(ui, form, model, messages);
}

fn history(ui: &mut Ui, form: &RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let grid = Grid::new("executed").num_columns(3).spacing(vec2(theme::SPACE_LARGE, 4.0)).striped(true);
    grid.show(ui, |ui| {
        for executed in form.execute.history() {
            let at = RichText::new(model.zone.time_ms(executed.at)).size(theme::SMALL_TEXT).color(palette.weak);
            ui.label(at);
            let again = ui.add(Button::selectable(false, RichText::new(&executed.text).monospace()));
            if again.on_hover_text(T::RemoteAgain.text(model.language)).clicked() {
                let command = executed.text.clone();
                messages.push(Message::act(move |model| {
                    if let Some(form) = model.dialog::<RemoteForm>() {
                        form.execute.text = command;
                    }
                    vec![]
                }));
            }
            let (said, color) = match &executed.result {
                None => ("…".to_owned(), palette.weak),
                Some(Ok(Some(result))) => (one_line(result, MAX_RESULT), palette.text),
                Some(Ok(None)) => (T::RemoteNoResult.text(model.language).to_owned(), palette.weak),
                Some(Err(error)) => {
                    let code = Problem::from(error.clone()).code;
                    (code.explain(model.language).message.to_owned(), palette.error)
                }
            };
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.set_max_width(ui.available_width());
                ui.add(Label::new(RichText::new(said).monospace().color(color)).wrap().selectable(true));
            });
            ui.end_row();
        }
    });
}

/// Characters of a result that are shown; the log has all of it.
const MAX_RESULT: usize = 1_000;
