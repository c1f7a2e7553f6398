use std::collections::BTreeMap;

use egui::{Align, Checkbox, Label, Layout, RichText, ScrollArea, Sense, Ui, vec2};
use egui_extras::{Column as TableColumn, TableBuilder, TableRow};

use crate::model::ServerStatus;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{Column, Expiry, Message, Model, Row, RowState};
use crate::ui::theme::{self, Palette, palette};
use crate::ui::widgets::{chip, sort_heading, word};

const fn title(column: Column) -> T {
    match column {
        Column::Name => T::ColumnName,
        Column::Type => T::ColumnType,
        Column::Address => T::ColumnAddress,
        Column::Serial => T::ColumnSerial,
        Column::Status => T::ColumnStatus,
        Column::Expiry => T::ColumnExpiry,
        Column::Certificate => T::ColumnCertificate,
        Column::Activation => T::ColumnActivation,
        Column::Retrieved => T::ColumnRetrieved,
    }
}

pub fn show(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| table(ui, model, messages));
    if model.rows.shown() == 0 {
        nothing_found(ui, model, messages);
    }
}

fn table(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    ui.spacing_mut().item_spacing = vec2(10.0, 0.0);
    // The text of ticked rows.
    ui.visuals_mut().selection.stroke.color = palette.text;
    let mut builder = TableBuilder::new(ui)
        .id_salt("controllers")
        .striped(true)
        .sense(Sense::click())
        .resizable(true)
        .cell_layout(Layout::left_to_right(Align::Center))
        .auto_shrink(false)
        .column(TableColumn::exact(theme::TICK_COLUMN).resizable(false));
    let widths = &model.options.window.columns;
    for (column, initial) in Column::ALL.into_iter().zip(theme::COLUMN_WIDTHS) {
        let initial = widths.get(column.key()).copied().unwrap_or(initial);
        let last = column == Column::Retrieved;
        let kind = if last { TableColumn::remainder() } else { TableColumn::initial(initial) };
        builder = builder.column(kind.at_least(if last { initial } else { theme::MIN_COLUMN }).clip(true));
    }
    if let (true, Some(cursor)) = (model.rows.reveal, model.rows.cursor()) {
        builder = builder.scroll_to_row(cursor, None);
        messages.push(Message::Revealed);
    }
    builder
        .header(theme::HEADER_HEIGHT, |mut header| {
            header.col(|ui| tick_all(ui, model, messages));
            for column in Column::ALL {
                header.col(|ui| {
                    let ascending = model.rows.sort.and_then(|(by, ascending)| (by == column).then_some(ascending));
                    if sort_heading(ui, title(column), ascending, model.language) {
                        messages.push(Message::Sort(column));
                    }
                });
            }
        })
        .body(|body| {
            remember_widths(body.widths(), model, messages);
            body.rows(theme::ROW_HEIGHT, model.rows.shown(), |mut row| {
                let position = row.index();
                if let Some(entry) = model.rows.at(position) {
                    draw(&mut row, entry, model.rows.cursor() == Some(position), model, palette, messages);
                }
            });
        });
}

fn tick_all(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    ui.add_space(10.0);
    let mut all = model.rows.all_shown_ticked();
    let some = model.rows.ticked_count() > model.rows.ticked_hidden() && !all;
    let response = ui.add(Checkbox::without_text(&mut all).indeterminate(some));
    let response = response.accessible_name(T::TickAll.text(model.language));
    if response.on_hover_text(T::TickAllTip.text(model.language)).clicked() {
        messages.push(Message::TickAll(all));
    }
}

fn remember_widths(widths: &[f32], model: &Model, messages: &mut Vec<Message>) {
    // The last column takes whatever is left.
    let shown = || Column::ALL.into_iter().zip(theme::COLUMN_WIDTHS).zip(&widths[1..]).take(Column::ALL.len() - 1);
    let known = &model.options.window.columns;
    let changed = shown().any(|((column, initial), width)| {
        let before = known.get(column.key()).copied().unwrap_or(initial);
        (before - width).abs() > 0.5
    });
    if changed {
        let widths: BTreeMap<String, f32> =
            shown().map(|((c, _), width)| (c.key().to_owned(), width.round())).collect();
        messages.push(Message::Widths(widths));
    }
}

fn draw(
    row: &mut TableRow<'_, '_>,
    entry: &Row,
    is_cursor: bool,
    model: &Model,
    palette: &Palette,
    messages: &mut Vec<Message>,
) {
    let language = model.language;
    let info = entry.info();
    row.set_selected(entry.ticked);
    let mut shift = false;
    row.col(|ui| {
        shift = ui.input(|input| input.modifiers.shift);
        if is_cursor {
            let rect = ui.max_rect();
            let bar = egui::Rect::from_min_size(rect.left_top(), vec2(3.0, theme::ROW_HEIGHT));
            ui.painter().rect_filled(bar, 0.0, palette.accent);
        }
        ui.add_space(10.0);
        let mut ticked = entry.ticked;
        let tick = ui.add(Checkbox::without_text(&mut ticked));
        if tick.accessible_name(texts::tick_row(language, entry.entry.name.as_str())).clicked() {
            messages.push(Message::Toggle { row: entry.id, range: shift });
        }
    });
    let cell = |ui: &mut Ui, text: RichText| {
        ui.add(Label::new(text).truncate());
    };
    let nothing = || RichText::new("—").color(palette.weak);
    row.col(|ui| cell(ui, RichText::new(entry.entry.name.as_str()).strong()));
    row.col(|ui| cell(ui, RichText::new(entry.entry.series.as_str())));
    row.col(|ui| cell(ui, RichText::new(&entry.address).monospace()));
    row.col(|ui| {
        let serial = info.map(|info| RichText::new(info.serial.as_str()).monospace().color(palette.weak));
        cell(ui, serial.unwrap_or_else(nothing));
    });
    row.col(|ui| status(ui, entry, model, palette));
    row.col(|ui| match entry.not_after() {
        Some(end) => expiry(ui, entry.expiry, &model.zone.date(end), model, palette),
        None => cell(ui, nothing()),
    });
    row.col(|ui| {
        let kind = entry.certificate_type().map(|kind| texts::certificate_type(kind).text(language));
        cell(ui, kind.map_or_else(nothing, RichText::new));
    });
    row.col(|ui| {
        let activated = info.map(|info| if info.activated { T::Yes } else { T::No }.text(language));
        cell(ui, activated.map_or_else(nothing, RichText::new));
    });
    row.col(|ui| {
        let at = entry.entry.last.as_ref().map(|last| model.zone.date_time(last.at));
        cell(ui, at.map_or_else(nothing, |at| RichText::new(at).color(palette.weak)));
    });
    let response = row.response();
    if response.clicked() {
        messages.push(Message::Toggle { row: entry.id, range: shift });
    }
}

/// Where the running job is with it; else what was read last.
fn status(ui: &mut Ui, entry: &Row, model: &Model, palette: &Palette) {
    let language = model.language;
    let text = |key: T| key.text(language);
    match &entry.live {
        Some(RowState::Waiting) => drop(chip(ui, text(T::StateWaiting), palette.off)),
        Some(RowState::Step(step)) => drop(chip(ui, text(texts::step(*step)), palette.accent)),
        Some(RowState::Done) => drop(chip(ui, text(T::StateDone), palette.ok)),
        Some(RowState::NotStarted) => drop(chip(ui, text(T::StateNotStarted), palette.off)),
        Some(RowState::Failed(problem)) => {
            let message = problem.code.explain(language).message;
            chip(ui, text(T::StateFailed), palette.error).on_hover_text(message);
        }
        None if entry.entry.fingerprint.is_none() => {
            chip(ui, text(T::NotConfirmed), palette.warning).on_hover_text(text(T::NotConfirmedTip));
        }
        None => match entry.info() {
            None => {
                ui.label(RichText::new("—").color(palette.weak)).on_hover_text(text(T::NotRead));
            }
            Some(info) => {
                let color = match info.status {
                    ServerStatus::Run => palette.ok,
                    ServerStatus::Stop => palette.off,
                    ServerStatus::Error => palette.error,
                };
                let word = text(texts::status(info.status));
                match info.error {
                    None => drop(chip(ui, word, color)),
                    Some(error) => {
                        let response = chip(ui, &texts::status_with_error(word, error), color);
                        response.on_hover_text(texts::error_in_full(language, error));
                    }
                }
            }
        },
    }
}

fn expiry(ui: &mut Ui, expiry: Option<Expiry>, date: &str, model: &Model, palette: &Palette) {
    let language = model.language;
    match expiry {
        Some(Expiry::Past) => {
            ui.label(RichText::new(date).color(palette.error));
            word(ui, T::Expired.text(language), palette.error);
        }
        Some(Expiry::Soon { days }) => {
            ui.label(RichText::new(date).color(palette.warning));
            let response = word(ui, T::ExpiresSoon.text(language), palette.warning);
            response.on_hover_text(texts::days_left(language, days));
        }
        _ => {
            ui.label(date);
        }
    }
}

fn nothing_found(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let rect = ui.max_rect().shrink2(vec2(0.0, 120.0));
    ui.scope_builder(egui::UiBuilder::new().max_rect(rect), |ui| {
        ui.vertical_centered(|ui| {
            ui.label(RichText::new(T::NothingFound.text(model.language)).color(palette(ui).weak));
            ui.add_space(theme::SPACE);
            if ui.button(T::ClearSearch.text(model.language)).clicked() {
                messages.push(Message::Filter(String::new()));
            }
        });
    });
}
