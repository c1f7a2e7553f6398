//! The table of controllers.

use egui::{
    Align, Checkbox, CursorIcon, Id, Label, LayerId, Layout, Order, Rect, Response, RichText, ScrollArea, Sense,
    Stroke, Ui, vec2,
};
use egui_extras::{Column as TableColumn, TableBuilder, TableRow};

use crate::model::ServerStatus;
use crate::texts::{self, TextKey as T};
use crate::ui::model::{Column, Expiry, Message, Model, Row, RowMenu, RowState};
use crate::ui::theme::{self, Palette, palette};
use crate::ui::views::row_menu;
use crate::ui::widgets::{chip, column_heading, word};

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
    let columns = model.columns();
    ScrollArea::horizontal().auto_shrink(false).show(ui, |ui| table(ui, &columns, model, messages));
    if model.rows.shown() == 0 {
        nothing_found(ui, model, messages);
    }
}

fn table(ui: &mut Ui, columns: &[Column], model: &Model, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    ui.spacing_mut().item_spacing = vec2(10.0, 0.0);
    theme::style_rows(ui);
    let mut builder = TableBuilder::new(ui)
        // The widths are kept by position, so another order is another table to begin with.
        .id_salt(("controllers", columns))
        .striped(true)
        .sense(Sense::click())
        .resizable(true)
        .cell_layout(Layout::left_to_right(Align::Center))
        .auto_shrink(false)
        .column(TableColumn::exact(theme::TICK_COLUMN).resizable(false));
    for column in columns {
        let initial = width(*column, model);
        let is_last = columns.last() == Some(column);
        let kind = if is_last { TableColumn::remainder() } else { TableColumn::initial(initial) };
        builder = builder.column(kind.at_least(if is_last { initial } else { theme::MIN_COLUMN }).clip(true));
    }
    if let (true, Some(cursor)) = (model.rows.reveal, model.rows.cursor()) {
        builder = builder.scroll_to_row(cursor, None);
        messages.push(Message::Revealed);
    }
    builder
        .header(theme::HEADER_HEIGHT, |mut header| {
            header.col(|ui| tick_all(ui, model, messages));
            let mut places = Vec::with_capacity(columns.len());
            for column in columns {
                header.col(|ui| {
                    let ascending = model.rows.sort.and_then(|(by, ascending)| (by == *column).then_some(ascending));
                    let heading = column_heading(ui, title(*column), ascending, model.language);
                    if heading.clicked() {
                        messages.push(Message::Sort(*column));
                    }
                    places.push(HeadingPlace { column: *column, rect: ui.max_rect(), heading });
                });
            }
            drag_column(&places, messages);
        })
        .body(|body| {
            remember_widths(columns, body.widths(), model, messages);
            body.rows(theme::ROW_HEIGHT, model.rows.shown(), |mut row| {
                let position = row.index();
                if let Some(entry) = model.rows.at(position) {
                    draw(&mut row, columns, entry, model.rows.cursor() == Some(position), model, palette, messages);
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

/// The width of a column: as it was left, else as it is at first.
fn width(column: Column, model: &Model) -> f32 {
    let initial = Column::ALL.into_iter().zip(theme::COLUMN_WIDTHS).find(|(c, _)| *c == column);
    let remembered = model.options.window.columns.get(column.key()).copied();
    remembered.or(initial.map(|(_, width)| width)).unwrap_or(theme::MIN_COLUMN)
}

fn remember_widths(columns: &[Column], widths: &[f32], model: &Model, messages: &mut Vec<Message>) {
    // The last column takes the space that is left; its own width counts where it is not the last.
    let shown = || columns.iter().copied().zip(&widths[1..]).take(columns.len() - 1);
    if shown().any(|(column, now)| (width(column, model) - now).abs() > 0.5) {
        let mut widths = model.options.window.columns.clone();
        widths.extend(shown().map(|(column, now)| (column.key().to_owned(), now.round())));
        messages.push(Message::Widths(widths));
    }
}

/// A column's heading on the screen.
struct HeadingPlace {
    column: Column,
    rect: Rect,
    heading: Response,
}

/// Marks where the heading that is dragged would be put down, and puts it there.
fn drag_column(places: &[HeadingPlace], messages: &mut Vec<Message>) {
    let Some(dragged) = places.iter().find(|place| place.heading.dragged() || place.heading.drag_stopped()) else {
        return;
    };
    let Some(pointer) = dragged.heading.interact_pointer_pos() else { return };
    let position = places.iter().filter(|place| place.rect.center().x < pointer.x).count();
    if dragged.heading.drag_stopped() {
        messages.push(Message::MoveColumn { column: dragged.column, position });
        return;
    }
    let edge = places.get(position).map(|place| place.rect.left()).or(places.last().map(|place| place.rect.right()));
    let ctx = &dragged.heading.ctx;
    ctx.set_cursor_icon(CursorIcon::Grabbing);
    if let Some(x) = edge {
        let color = ctx.global_style().visuals.hyperlink_color;
        let line = ctx.layer_painter(LayerId::new(Order::Tooltip, Id::unique("column edge")));
        line.vline(x - theme::COLUMN_EDGE, dragged.rect.y_range(), Stroke::new(3.0, color));
    }
}

fn draw(
    row: &mut TableRow<'_, '_>,
    columns: &[Column],
    entry: &Row,
    is_cursor: bool,
    model: &Model,
    palette: &Palette,
    messages: &mut Vec<Message>,
) {
    row.set_selected(entry.ticked);
    let mut shift = false;
    row.col(|ui| {
        shift = ui.input(|input| input.modifiers.shift);
        if is_cursor {
            let rect = ui.max_rect();
            let bar = egui::Rect::from_min_size(rect.left_top(), vec2(3.0, theme::ROW_HEIGHT));
            ui.painter().rect_filled(bar, 0.0, palette.accent);
            row_menu::note_cursor_row(ui, rect);
        }
        ui.add_space(10.0);
        let mut ticked = entry.ticked;
        let tick = ui.add(Checkbox::without_text(&mut ticked));
        if tick.accessible_name(texts::tick_row(model.language, entry.entry.name.as_str())).clicked() {
            messages.push(Message::Toggle { row: entry.id, range: shift });
        }
    });
    for column in columns {
        row.col(|ui| draw_cell(ui, *column, entry, model, palette));
    }
    let response = row.response();
    if response.clicked() {
        messages.push(Message::Toggle { row: entry.id, range: shift });
    }
    // The two clicks have ticked and unticked it.
    if response.double_clicked() {
        messages.push(Message::OpenDetails(entry.id));
    }
    if response.secondary_clicked() {
        let at = response.interact_pointer_pos().map(|at| (at.x, at.y));
        messages.push(Message::OpenRowMenu(Some(RowMenu { row: entry.id, at })));
    }
}

fn draw_cell(ui: &mut Ui, column: Column, entry: &Row, model: &Model, palette: &Palette) {
    let (language, info) = (model.language, entry.info());
    let cell = |ui: &mut Ui, text: RichText| drop(ui.add(Label::new(text).truncate()));
    let nothing = || RichText::new("—").color(palette.weak);
    match column {
        Column::Name => cell(ui, RichText::new(entry.entry.name.as_str()).strong()),
        Column::Type => cell(ui, RichText::new(entry.entry.series.as_str())),
        Column::Address => cell(ui, RichText::new(&entry.address).monospace()),
        Column::Serial => {
            let serial = info.map(|info| RichText::new(info.serial.as_str()).monospace().color(palette.weak));
            cell(ui, serial.unwrap_or_else(nothing));
        }
        Column::Status => status(ui, entry, model, palette),
        Column::Expiry => match entry.not_after() {
            Some(end) => expiry(ui, entry.expiry, &model.zone.date(end), model, palette),
            None => cell(ui, nothing()),
        },
        Column::Certificate => {
            let kind = entry.certificate_type().map(|kind| texts::certificate_type(kind).text(language));
            cell(ui, kind.map_or_else(nothing, RichText::new));
        }
        Column::Activation => {
            let activated = info.map(|info| if info.activated { T::Yes } else { T::No }.text(language));
            cell(ui, activated.map_or_else(nothing, RichText::new));
        }
        Column::Retrieved => {
            let at = entry.entry.last.as_ref().map(|last| model.zone.date_time(last.at));
            cell(ui, at.map_or_else(nothing, |at| RichText::new(at).color(palette.weak)));
        }
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
