use egui::{Button, ComboBox, Grid, Label, RichText, TextEdit, Ui, vec2};

use super::button::act_unless;
use crate::model::untrusted_text::one_line;
use crate::model::{Problem, SpelType};
use crate::remote::Command;
use crate::texts::TextKey as T;
use crate::ui::features::remote_control::{RemoteForm, VariableLine, WhyNot};
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::small_note;

/// The variables that are read in each cycle, and a line for one more.
pub fn show(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    small_note(ui, text(T::RemoteVariablesNote));
    ui.add_space(theme::SPACE);
    add(ui, form, model, messages);
    ui.add_space(theme::SPACE);
    let mut lines = std::mem::take(&mut form.variables.lines);
    let grid = Grid::new("remote variables").num_columns(5).spacing(vec2(theme::SPACE_LARGE, 4.0)).striped(true);
    grid.show(ui, |ui| {
        if !lines.is_empty() {
            for heading in [T::LiveVariable, T::RemoteType, T::LiveValue, T::LiveNewValue] {
                let heading = RichText::new(text(heading)).size(theme::HEADER_TEXT).color(palette(ui).weak);
                ui.label(heading);
            }
            ui.end_row();
        }
        for (index, line) in lines.iter_mut().enumerate() {
            show_line(ui, form, index, line, model, messages);
            ui.end_row();
        }
    });
    form.variables.lines = lines;
}

fn add(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let table = &mut form.variables;
    let field = |ui: &mut Ui, value: &mut String, label: T, width: f32| {
        let edit = TextEdit::singleline(value).hint_text(text(label)).desired_width(width).margin(theme::SEARCH_MARGIN);
        ui.add(edit).accessible_name(text(label)).on_hover_text(text(label));
    };
    ui.horizontal_wrapped(|ui| {
        field(ui, &mut table.name, T::RemoteVariableName, 200.0);
        let list = ComboBox::from_id_salt("variable type").selected_text(table.kind.keyword()).show_ui(ui, |ui| {
            for kind in SpelType::ALL {
                ui.selectable_value(&mut table.kind, kind, kind.keyword());
            }
        });
        list.response.on_hover_text(text(T::RemoteType));
        field(ui, &mut table.indices, T::RemoteIndices, 110.0);
        if !table.indices.trim().is_empty() {
            field(ui, &mut table.count, T::RemoteCount, 70.0);
        }
        let why = table.typed().err();
        let button = ui.add_enabled(why.is_none(), Button::new(text(T::Add)));
        if button.on_disabled_hover_text(why.map_or("", text)).clicked() {
            table.add();
            messages.push(Message::act(Model::show_remote));
        }
    });
}

fn show_line(
    ui: &mut Ui,
    form: &RemoteForm,
    index: usize,
    line: &mut VariableLine,
    model: &Model,
    messages: &mut Vec<Message>,
) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    ui.label(line.title());
    ui.label(RichText::new(line.read.kind().keyword()).color(palette.weak));
    match &line.value {
        None => drop(ui.label(RichText::new("…").color(palette.weak))),
        Some(Err(error)) => {
            let said = Problem::from(error.clone()).code.explain(model.language);
            let label = Label::new(RichText::new(said.message).color(palette.error));
            ui.add(label).on_hover_text(said.remedy);
        }
        Some(Ok(_)) => {
            let color = if form.is_live() { palette.text } else { palette.off };
            let value = line.shown().unwrap_or_default();
            let shown = RichText::new(one_line(&value, MAX_CHARS)).color(color);
            ui.add(Label::new(shown).selectable(true)).on_hover_text(one_line(&value, MAX_TIP_CHARS));
        }
    }
    if line.read.range().is_none() {
        let edit = TextEdit::singleline(&mut line.typed).desired_width(theme::LABEL_WIDTH).margin(theme::SEARCH_MARGIN);
        ui.add(edit).accessible_name(format!("{} {}", text(T::LiveNewValue), line.title()));
    } else {
        ui.label(RichText::new(text(T::RemoteArrayReadOnly)).size(theme::SMALL_TEXT).color(palette.weak));
    }
    ui.horizontal(|ui| {
        let why = form.why_not(Command::SetVariable);
        match (why, line.set_typed()) {
            (None, Ok(request)) => drop(act_unless(ui, None, T::RemoteSet, &request, model, messages)),
            (why, typed) => {
                let why = why.or(typed.err().map(WhyNot::Incomplete));
                let button = ui.add_enabled(false, Button::new(text(T::RemoteSet)));
                button.on_disabled_hover_text(why.map(|why| why.text(model.language)).unwrap_or_default());
            }
        }
        if ui.button(text(T::LivePlotRemove)).clicked() {
            messages.push(Message::act(move |model| {
                if let Some(form) = model.dialog::<RemoteForm>()
                    && index < form.variables.lines.len()
                {
                    form.variables.lines.remove(index);
                }
                model.show_remote()
            }));
        }
    });
}

/// Characters of a value in the table, and in its tooltip.
const MAX_CHARS: usize = 60;
const MAX_TIP_CHARS: usize = 1_000;
