use egui::{Align, Button, Checkbox, Frame, Label, Layout, RichText, ScrollArea, Sense, Stroke, Ui, Vec2, vec2};
use egui_extras::{Column, TableBuilder};

use super::line::{self, LineClick, LineContext};
use super::{cell, moves};
use crate::texts::{self, TextKey as T};
use crate::ui::features::client_certificates::{Pane, PaneKind, TrustAction, TrustForm};
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{chip, sort_heading};

/// One list: how full it is, what can be done with it, and its lines. Only the lines in sight are laid out. `alone`:
/// there is no room for the others, which can be changed to.
pub fn show(
    ui: &mut Ui,
    form: &mut TrustForm,
    index: usize,
    size: Vec2,
    alone: bool,
    model: &Model,
    messages: &mut Vec<Message>,
) {
    let palette = palette(ui);
    let has_focus = form.focus == index && form.panes.len() > 1;
    let line = if has_focus { palette.accent } else { palette.line };
    let layout = Layout::top_down(Align::Min);
    ui.allocate_ui_with_layout(size, layout, |ui| {
        ui.set_min_size(size);
        ui.push_id(index, |ui| {
            Frame::new().stroke(Stroke::new(1.0, line)).corner_radius(8).inner_margin(theme::TRUST_MARGIN).show(
                ui,
                |ui| {
                    let inner = size - theme::TRUST_MARGIN.sum() - vec2(2.0, 2.0);
                    ui.set_min_size(inner);
                    ui.set_max_size(inner);
                    let top = ui.cursor().top();
                    head(ui, form, index, alone, model, messages);
                    ui.add_space(theme::SPACE / 2.0);
                    let height = inner.y - (ui.cursor().top() - top);
                    if form.panes[index].shown() == 0 {
                        empty(ui, form, index, height, model);
                    } else {
                        table(ui, form, index, height, model, messages);
                    }
                },
            );
        });
    });
}

fn head(ui: &mut Ui, form: &mut TrustForm, index: usize, alone: bool, model: &Model, messages: &mut Vec<Message>) {
    let size = vec2(ui.available_width(), theme::BUTTON_HEIGHT);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.spacing_mut().button_padding.x = theme::SPACE;
        buttons(ui, form, index, model, messages);
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            if alone {
                tabs(ui, form, model);
            } else {
                title(ui, &form.panes[index], model);
            }
        });
    });
}

fn title(ui: &mut Ui, pane: &Pane, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    ui.label(RichText::new(pane.kind.title().text(language)).strong());
    if pane.new_ones() > 0 {
        chip(ui, &texts::new_clients(language, pane.new_ones()), palette.warning);
    }
    let color = if pane.is_full() && !pane.is_empty() { palette.error } else { palette.weak };
    let said = fullness(pane, model);
    ui.add(Label::new(RichText::new(&said).size(theme::HEADER_TEXT).color(color)).truncate()).on_hover_text(said);
}

/// How many there are, of how many that fit, and how many are ticked.
fn fullness(pane: &Pane, model: &Model) -> String {
    // There is no such list.
    if pane.limit == Some(0) {
        return String::new();
    }
    let full = texts::how_full(model.language, pane.len(), pane.limit);
    match pane.ticked_count() {
        0 => full,
        ticked => texts::full_and_ticked(model.language, &full, ticked, pane.ticked_hidden()),
    }
}

/// One tab a list.
fn tabs(ui: &mut Ui, form: &mut TrustForm, model: &Model) {
    for index in 0..form.panes.len() {
        let pane = &form.panes[index];
        let mut said = format!("{}  {}", pane.kind.title().text(model.language), fullness(pane, model));
        if pane.new_ones() > 0 {
            said = format!("{said} ({})", texts::new_clients(model.language, pane.new_ones()));
        }
        let selected = form.focus == index;
        let name = pane.kind.title().text(model.language);
        let text = RichText::new(said.trim_end());
        let button = Button::selectable(selected, if selected { text.strong() } else { text });
        if ui.add(button).accessible_name(name).clicked() {
            form.focus = index;
        }
    }
}

/// From right to left.
fn buttons(ui: &mut Ui, form: &TrustForm, index: usize, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let pane = &form.panes[index];
    let busy = (!form.is_ready()).then_some(T::TrustBusy);
    let nothing = (pane.ticked_count() == 0 && pane.cursor().is_none()).then_some(T::TrustChoose);
    let name = text(pane.kind.title());
    let mut button = |ui: &mut Ui, label: T, why: Option<T>, tip: Option<T>, action: TrustAction| {
        let response = ui.add_enabled(why.is_none(), Button::new(text(label)).min_size(vec2(0.0, theme::DENSE_HEIGHT)));
        let response = response.accessible_name(format!("{}: {}", name, text(label)));
        let response = response.on_disabled_hover_text(why.map_or("", text));
        let response = match tip {
            Some(tip) => response.on_hover_text(text(tip)),
            None => response,
        };
        if response.clicked() {
            messages.push(super::act(action));
        }
    };
    if pane.kind.destination().is_some() {
        let legacy = (pane.kind == PaneKind::Issuers && !form.has_issuers()).then_some(T::TrustIssuersWhy);
        let full = pane.is_full().then_some(T::TrustFull);
        button(ui, T::TrustAddTo, busy.or(legacy).or(full), None, TrustAction::Add(pane.kind));
    }
    button(ui, T::DeleteControllers, busy.or(nothing), None, TrustAction::Delete(pane.kind));
    if let Some((to, label, tip)) = moves(pane.kind) {
        let full = form.pane(to).is_some_and(Pane::is_full).then_some(T::TrustFull);
        button(ui, label, busy.or(nothing).or(full), Some(tip), TrustAction::Move { from: pane.kind, to });
    }
}

/// Says what to do.
fn empty(ui: &mut Ui, form: &TrustForm, index: usize, height: f32, model: &Model) {
    let pane = &form.panes[index];
    let key = match pane.kind {
        _ if !pane.is_empty() => T::TrustNothingFound,
        PaneKind::Issuers if !form.has_issuers() => T::TrustIssuersLegacy,
        kind => kind.empty_text(),
    };
    let weak = palette(ui).weak;
    ui.add_space((height * 0.2).max(0.0));
    ui.vertical_centered(|ui| {
        ui.set_max_width((ui.available_width() - 4.0 * theme::SPACE).min(theme::DIALOG));
        ui.add(Label::new(RichText::new(key.text(model.language)).color(weak)).wrap());
    });
}

fn table(ui: &mut Ui, form: &mut TrustForm, index: usize, height: f32, model: &Model, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let has_focus = form.focus == index;
    let pane = &mut form.panes[index];
    let columns = pane.kind.columns();
    let mut clicked = None;
    ScrollArea::horizontal().id_salt("wide").auto_shrink(false).max_height(height).show(ui, |ui| {
        ui.spacing_mut().item_spacing = vec2(10.0, 0.0);
        let below =
            height - theme::HEADER_HEIGHT - ui.spacing().scroll.bar_width - ui.spacing().scroll.bar_outer_margin;
        // When a dialog is measured before it is first drawn, columns would shrink to what they hold, and stay so.
        let measured = ui.is_sizing_pass();
        theme::style_rows(ui);
        let mut builder = TableBuilder::new(ui)
            .id_salt("lines")
            .sense(Sense::hover())
            .resizable(true)
            .cell_layout(Layout::left_to_right(Align::Center))
            .auto_shrink(false)
            .min_scrolled_height(below)
            .max_scroll_height(below)
            .column(Column::exact(theme::TICK_COLUMN).resizable(false));
        for column in columns {
            let last = columns.last() == Some(column);
            let width = cell::width(*column);
            let kind = if last { Column::remainder() } else { Column::initial(width) };
            builder =
                builder.column(kind.at_least(if last || measured { width } else { theme::MIN_COLUMN }).clip(true));
        }
        if std::mem::take(&mut pane.reveal)
            && let Some(cursor) = pane.cursor()
        {
            builder = builder.scroll_to_row(cursor, None);
        }
        builder
            .header(theme::HEADER_HEIGHT, |mut header| {
                header.col(|ui| tick_all(ui, pane, model));
                // Most columns lie beyond the edge of the list.
                let mut beyond = false;
                for column in columns {
                    if beyond {
                        break;
                    }
                    header.col(|ui| {
                        beyond = ui.max_rect().left() > ui.clip_rect().right();
                        let ascending = (pane.sort.0 == *column).then_some(pane.sort.1);
                        if sort_heading(ui, column.heading(), ascending, model.language) {
                            pane.sort_by(*column);
                        }
                    });
                }
            })
            .body(|mut body| {
                let lines =
                    LineContext { clip: body.ui_mut().clip_rect(), widths: body.widths().to_vec(), columns, has_focus };
                body.rows(theme::ROW_HEIGHT, pane.shown(), |mut row| {
                    let position = row.index();
                    row.col(|ui| clicked = line::show(ui, position, pane, &lines, model, palette).or(clicked));
                });
            });
    });
    match clicked {
        None => {}
        Some((at, LineClick::Tick { range })) => {
            form.focus = index;
            form.panes[index].toggle(at, range);
        }
        Some((at, click)) => {
            form.focus = index;
            form.panes[index].place_cursor(at);
            if click == LineClick::Open {
                messages.push(super::act(TrustAction::Details));
            }
        }
    }
}

fn tick_all(ui: &mut Ui, pane: &mut Pane, model: &Model) {
    ui.add_space(10.0);
    let mut all = pane.all_shown_ticked();
    let some = pane.ticked_count() > pane.ticked_hidden() && !all;
    let name = format!("{}: {}", pane.kind.title().text(model.language), T::TickAll.text(model.language));
    let response = ui.add(Checkbox::without_text(&mut all).indeterminate(some)).accessible_name(name);
    if response.clicked() {
        pane.tick_shown(all);
    }
}
