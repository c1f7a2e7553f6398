use egui::{
    Align2, Button, DragValue, FontId, Grid, RichText, Sense, Stroke, TextEdit, Ui, WidgetInfo, WidgetText, pos2, vec2,
};

use super::button::{explain, send};
use crate::jobs::IoKind;
use crate::model::Problem;
use crate::remote::Command;
use crate::texts::{self, TextKey as T};
use crate::ui::features::remote_control::{IoView, RemoteForm, WhyNot};
use crate::ui::model::{BrowseField, BrowseFor, Message, Model};
use crate::ui::picker::FileKind;
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{form as fields, mistake, path_field, small_note};

const LABELS: BrowseField = BrowseField {
    kind: FileKind::Csv,
    asks_for: BrowseFor::File,
    text: |model| model.dialog::<RemoteForm>().map(|form| &mut form.io.labels_file.path),
};

/// Four words of I/O as bits, bytes or words.
pub fn show(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    choose(ui, form, model, messages);
    if form.io.kind == IoKind::Output {
        small_note(ui, text(T::RemoteOutputsNote));
    }
    ui.add_space(theme::SPACE);
    match form.io.view {
        IoView::Bits => bits(ui, form, model, messages),
        IoView::Bytes | IoView::Words => numbers(ui, form, model, messages),
    }
    failure(ui, form, model);
    labels(ui, form, model, messages);
}

fn choose(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let before = (form.io.kind, form.io.view, form.io.first);
    ui.horizontal_wrapped(|ui| {
        for kind in IoKind::ALL {
            ui.selectable_value(&mut form.io.kind, kind, text(texts::io_kind(kind)));
        }
        ui.separator();
        for (view, title) in IoView::ALL.into_iter().zip([T::RemoteBits, T::RemoteBytes, T::RemoteWords]) {
            ui.selectable_value(&mut form.io.view, view, text(title));
        }
        ui.separator();
        let label = ui.label(text(T::RemoteFirstWord));
        let most = form.io.most_first();
        ui.add(DragValue::new(&mut form.io.first).range(0..=most)).labelled_by(label.id);
    });
    if before != (form.io.kind, form.io.view, form.io.first) {
        form.io.changed();
        messages.push(Message::act(Model::show_remote));
    }
}

/// Rows of eight or sixteen lamps. Outputs and memory I/O are switched with a click.
fn bits(ui: &mut Ui, form: &RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let has_labels = form.io.labels.count() > 0;
    let width = if has_labels { theme::LABELLED_LAMP } else { theme::LAMP.x };
    let in_row = if ui.available_width() >= 16.0 * width { 16 } else { 8 };
    let numbers: Vec<u16> = form.io.numbers().collect();
    ui.spacing_mut().item_spacing = egui::Vec2::ZERO;
    for row in numbers.chunks(in_row) {
        ui.horizontal(|ui| {
            for bit in row {
                lamp(
                    ui,
                    form,
                    *bit,
                    vec2(width, theme::LAMP.y + if has_labels { theme::LABEL_LINE } else { 0.0 }),
                    model,
                    messages,
                );
            }
        });
    }
}

fn lamp(ui: &mut Ui, form: &RemoteForm, bit: u16, size: egui::Vec2, model: &Model, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let is_on = form.io.bit(bit);
    let label = form.io.labels.label(form.io.kind, bit);
    let command = set_command(form.io.kind);
    let why = command.and_then(|command| form.why_not(command));
    let can_set = command.is_some() && why.is_none();
    let (rect, mut response) = ui.allocate_exact_size(size, if can_set { Sense::click() } else { Sense::hover() });
    if ui.is_rect_visible(rect) {
        let center = pos2(rect.center().x, rect.top() + theme::LAMP_RADIUS + 4.0);
        let color = if form.is_live() { palette.ok } else { palette.off };
        let painter = ui.painter();
        if response.hovered() && can_set || response.has_focus() {
            painter.rect_filled(rect, 6.0, palette.accent.gamma_multiply(theme::CHIP_FILL));
        }
        match is_on {
            Some(true) => drop(painter.circle_filled(center, theme::LAMP_RADIUS, color)),
            Some(false) => drop(painter.circle_stroke(center, theme::LAMP_RADIUS, Stroke::new(1.5, palette.off))),
            None => drop(painter.circle_filled(center, 2.0, palette.off)),
        }
        let at = pos2(rect.center().x, center.y + theme::LAMP_RADIUS + 3.0);
        painter.text(at, Align2::CENTER_TOP, bit, FontId::proportional(theme::SMALL_TEXT), palette.weak);
        if let Some(label) = label {
            let text = RichText::new(label).size(theme::SMALL_TEXT).color(palette.text);
            let wrap = Some(egui::TextWrapMode::Truncate);
            let galley = WidgetText::from(text).into_galley(ui, wrap, rect.width() - 4.0, egui::TextStyle::Small);
            let at = pos2(rect.center().x - galley.size().x / 2.0, at.y + theme::LABEL_LINE);
            ui.painter().galley(at, galley, palette.text);
        }
    }
    let said = texts::remote_bit(model.language, bit, label, is_on);
    let role = if can_set { egui::Role::Button } else { egui::Role::Label };
    response.widget_info(|| WidgetInfo::labeled(role, true, &said));
    if can_set && response.clicked() {
        // One whose state is not known is switched on.
        set(form, bit, is_on != Some(true), messages);
    }
    if can_set {
        response.context_menu(|ui| {
            for (key, on) in [(T::RemoteSetOn, true), (T::RemoteSetOff, false)] {
                if ui.button(key.text(model.language)).clicked() {
                    set(form, bit, on, messages);
                }
            }
        });
    }
    let consequence = command.and_then(Command::consequence).filter(|_| can_set);
    let more = match &why {
        Some(why) => Some(why.text(model.language)),
        None => consequence.map(|key| key.text(model.language).to_owned()),
    };
    response = response.on_hover_text(match more {
        Some(more) => format!("{said}\n{more}"),
        None => said,
    });
    drop(response);
}

fn set(form: &RemoteForm, bit: u16, on: bool, messages: &mut Vec<Message>) {
    if let Some(request) = form.io.set_bit(bit, on) {
        send(request, messages);
    }
}

const fn set_command(kind: IoKind) -> Option<Command> {
    match kind {
        IoKind::Input => None,
        IoKind::Output => Some(Command::SetIO),
        IoKind::Memory => Some(Command::SetMemIO),
    }
}

/// Bytes or words as numbers, with fields for other values.
fn numbers(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    let can_be_set = form.io.kind != IoKind::Input;
    let digits = usize::from(form.io.view.width() / 4);
    let grid = Grid::new("remote numbers").num_columns(6).spacing(vec2(theme::SPACE_LARGE, 4.0)).striped(true);
    grid.show(ui, |ui| {
        for heading in [T::RemoteNumber, T::RemoteHexadecimal, T::RemoteDecimal, T::RemoteBinary] {
            ui.label(RichText::new(text(heading)).size(theme::HEADER_TEXT).color(palette.weak));
        }
        if can_be_set {
            ui.label(RichText::new(text(T::LiveNewValue)).size(theme::HEADER_TEXT).color(palette.weak));
        }
        ui.end_row();
        let color = if form.is_live() { palette.text } else { palette.off };
        for number in form.io.numbers() {
            ui.label(number.to_string());
            let cells = match form.io.value(number) {
                Some(value) => {
                    let bits = format!("{value:0width$b}", width = digits * 4);
                    let bits: Vec<String> =
                        bits.as_bytes().chunks(4).map(|c| String::from_utf8_lossy(c).into_owned()).collect();
                    [format!("{value:0digits$X}"), value.to_string(), bits.join(" ")]
                }
                None => ["–"; 3].map(str::to_owned),
            };
            for cell in cells {
                ui.label(RichText::new(cell).monospace().color(color));
            }
            if let (true, Ok(number)) = (can_be_set, u8::try_from(number)) {
                typed(ui, form, number, model, messages);
            }
            ui.end_row();
        }
    });
}

fn typed(ui: &mut Ui, form: &mut RemoteForm, number: u8, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let field = form.io.typed.entry(number).or_default();
    let edit = TextEdit::singleline(field).desired_width(80.0).margin(theme::SEARCH_MARGIN);
    ui.add(edit).accessible_name(format!("{} {number}", text(T::LiveNewValue)));
    let request = form.io.set_typed(number);
    let command = request.as_ref().map_or(Command::SetIOByte, crate::remote::Request::command);
    let why = form.why_not(command).or(request.as_ref().err().map(|why| WhyNot::Incomplete(*why)));
    let button = ui.add_enabled(why.is_none(), Button::new(text(T::RemoteSet)));
    if explain(button, why.as_ref(), command, model).clicked()
        && let Ok(request) = request
    {
        send(request, messages);
    }
}

/// Why a word could not be read.
fn failure(ui: &mut Ui, form: &RemoteForm, model: &Model) {
    let width = form.io.view.width();
    let error = form.io.numbers().find_map(|number| form.io.failure(number * width));
    if let Some(error) = error {
        let explained = Problem::from(error.clone()).code.explain(model.language);
        ui.add_space(theme::SPACE);
        mistake(ui, texts::remote_io_unread(model.language, explained.message).as_str());
    }
}

/// The file with names of bits.
fn labels(ui: &mut Ui, form: &mut RemoteForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.add_space(theme::SPACE_LARGE);
    fields(ui, "io labels", |ui| {
        let path = &mut form.io.labels_file.path;
        path_field(ui, text(T::RemoteLabels), path, text(T::RemoteLabelsHint), LABELS, model.language, messages);
    });
    let file = &form.io.labels_file;
    ui.horizontal(|ui| {
        let why = file.incomplete();
        let button = ui.add_enabled(why.is_none(), Button::new(text(T::RemoteReadLabels)));
        if button.on_disabled_hover_text(why.map_or("", text)).on_hover_text(text(T::RemoteLabelsTip)).clicked() {
            messages.push(Message::ReadFile);
        }
        if file.is_shown() {
            let (count, skipped) = (form.io.labels.count(), form.io.labels.skipped.len());
            small_note(ui, &texts::remote_labels(model.language, count, skipped));
        }
    });
    if let Some(problem) = &file.problem {
        let explained = problem.code.explain(model.language);
        mistake(ui, explained.message);
        small_note(ui, explained.remedy);
    }
}
