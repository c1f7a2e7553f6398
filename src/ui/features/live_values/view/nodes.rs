use egui::{Align, Button, Frame, Label, Layout, RichText, ScrollArea, Sense, Stroke, Ui, UiBuilder, WidgetInfo, vec2};

use super::value::{ValueCells, table};
use crate::jobs::NodeDetails;
use crate::model::opcua::{DataValue, NodeClass};
use crate::model::untrusted_text::one_line;
use crate::texts::TextKey as T;
use crate::ui::features::live_values::browser::{BrowsedNode, ChildrenState};
use crate::ui::features::live_values::{EditValue, LiveForm};
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{note, small_note};

/// The address space as a tree, and the attributes of the selected node.
pub fn show(ui: &mut Ui, form: &mut LiveForm, height: f32, model: &Model, messages: &mut Vec<Message>) {
    let width = theme::NODE_TREE.min(ui.available_width() * 0.5);
    ui.horizontal_top(|ui| {
        framed(ui, width, height, |ui| tree(ui, form, height, model, messages));
        let rest = ui.available_width();
        framed(ui, rest, height, |ui| {
            ScrollArea::vertical().id_salt("attributes").auto_shrink(false).show(ui, |ui| {
                details(ui, &ValueCells { form, model }, messages);
            });
        });
    });
}

fn framed(ui: &mut Ui, width: f32, height: f32, body: impl FnOnce(&mut Ui)) {
    let margin = theme::CARD_MARGIN;
    let size = vec2(width - margin.sum().x, height - margin.sum().y);
    Frame::new().stroke(Stroke::new(1.0, palette(ui).line)).corner_radius(8).inner_margin(margin).show(ui, |ui| {
        ui.allocate_ui_with_layout(size, Layout::top_down(Align::Min), |ui| {
            ui.set_min_size(size);
            ui.set_max_size(size);
            body(ui);
        });
    });
}

/// Only the lines in sight are drawn.
fn tree(ui: &mut Ui, form: &mut LiveForm, height: f32, model: &Model, messages: &mut Vec<Message>) {
    ui.spacing_mut().item_spacing.y = 0.0;
    let mut area = ScrollArea::both().id_salt("nodes").auto_shrink(false);
    if std::mem::take(&mut form.browser.reveal)
        && let Some(line) = form.browser.selected_line()
    {
        area = area.vertical_scroll_offset((theme::DENSE_HEIGHT * (line as f32 + 0.5) - height / 2.0).max(0.0));
    }
    let selected = form.browser.selected_line();
    area.show_rows(ui, theme::DENSE_HEIGHT, form.browser.line_count(), |ui, range| {
        for line in range {
            if let Some(node) = form.browser.line(line) {
                row(ui, node, line, selected == Some(line), model, messages);
            }
        }
    });
}

fn row(ui: &mut Ui, node: &BrowsedNode, line: usize, is_selected: bool, model: &Model, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), theme::DENSE_HEIGHT), Sense::click());
    response.widget_info(|| WidgetInfo::selected(egui::Role::Button, true, is_selected, &node.name));
    if is_selected {
        ui.painter().rect_filled(rect, 4.0, ui.visuals().selection.bg_fill);
    } else if response.hovered() {
        ui.painter().rect_filled(rect, 4.0, ui.visuals().widgets.hovered.weak_bg_fill);
    }
    let mut line_ui = ui.new_child(
        UiBuilder::new().max_rect(rect.shrink2(vec2(4.0, 0.0))).layout(Layout::left_to_right(Align::Center)),
    );
    line_ui.add_space(node.depth as f32 * theme::NODE_INDENT);
    let can_unfold = !matches!(&node.below, ChildrenState::Read(children) if children.is_empty());
    let (arrow, fold) = line_ui.allocate_exact_size(vec2(theme::NODE_INDENT, theme::DENSE_HEIGHT), Sense::click());
    if can_unfold {
        let center = arrow.center();
        let points = match node.is_unfolded {
            true => vec![center + vec2(-4.0, -2.0), center + vec2(4.0, -2.0), center + vec2(0.0, 3.0)],
            false => vec![center + vec2(-2.0, -4.0), center + vec2(3.0, 0.0), center + vec2(-2.0, 4.0)],
        };
        line_ui.painter().add(egui::Shape::convex_polygon(points, palette.weak, Stroke::NONE));
    }
    let color = if node.class == NodeClass::Variable { palette.text } else { palette.weak };
    let name = RichText::new(one_line(&node.name, 120)).color(color);
    line_ui.add(Label::new(name).extend().selectable(false));
    match &node.below {
        ChildrenState::Reading => {
            drop(line_ui.label(RichText::new(T::Reading.text(model.language)).color(palette.weak)))
        }
        ChildrenState::Failed(problem) => {
            let said = problem.code.explain(model.language).message;
            line_ui.label(RichText::new(said).size(theme::SMALL_TEXT).color(palette.error));
        }
        ChildrenState::Unread | ChildrenState::Read(_) => {}
    }
    if (fold.clicked() || response.double_clicked()) && can_unfold {
        let unfold = !node.is_unfolded;
        messages.push(Message::act(move |model| model.live_fold(line, unfold)));
    } else if response.clicked() {
        messages.push(Message::act(move |model| model.live_select(line)));
    }
}

fn details(ui: &mut Ui, cells: &ValueCells<'_>, messages: &mut Vec<Message>) {
    let browser = &cells.form.browser;
    let Some(node) = browser.selected() else { return small_note(ui, cells.text(T::LiveChoose)) };
    ui.add(Label::new(RichText::new(one_line(&node.name, 200)).strong()).truncate());
    match &browser.details {
        None => small_note(ui, cells.text(T::Reading)),
        Some(Err(problem)) => note(ui, palette(ui).error, |ui| {
            let explained = problem.code.explain(cells.model.language);
            ui.label(RichText::new(explained.message).strong());
            if let Some(detail) = &problem.detail {
                small_note(ui, detail);
            }
        }),
        Some(Ok(details)) => {
            if node.class == NodeClass::Variable {
                actions(ui, cells, details, messages);
                if details.is_consumed_by_reading {
                    note(ui, palette(ui).warning, |ui| small_note(ui, cells.text(T::LiveDataNote)));
                }
            }
            ui.add_space(theme::SPACE);
            let value = cells.form.value(&node.node).filter(|_| !details.is_consumed_by_reading);
            attributes(ui, cells, details, value);
        }
    }
}

/// Plotting and writing the value.
fn actions(ui: &mut Ui, cells: &ValueCells<'_>, details: &NodeDetails, messages: &mut Vec<Message>) {
    ui.horizontal(|ui| {
        let plottable = cells.form.plottable();
        let is_plotted = plottable.as_ref().is_ok_and(|point| cells.form.plot.holds(&point.node));
        let key = if is_plotted { T::LiveRemoveFromPlot } else { T::LiveAddToPlot };
        let why = plottable.as_ref().err().map_or("", |why| cells.text(*why));
        let plot = ui.add_enabled(plottable.is_ok(), Button::new(cells.text(key)));
        if plot.on_disabled_hover_text(why).clicked()
            && let Ok(point) = plottable
        {
            messages.push(Message::act(move |model| match is_plotted {
                true => model.live_unplot(Some(&point.node)),
                false => model.live_plot(point),
            }));
        }
        let node = cells.form.browser.selected().map(|node| node.node.clone());
        let before = node.and_then(|node| cells.form.value(&node)).map(|value| value.value.clone()).unwrap_or_default();
        let takes = EditValue::takes(details.data_type.as_deref().unwrap_or_default(), &before);
        let why = match () {
            () if !details.is_writable || !takes => Some(T::LiveNotWritable),
            () if !cells.form.is_live() => Some(T::LiveNotWritableNow),
            () => None,
        };
        let write = ui.add_enabled(why.is_none(), Button::new(cells.text(T::LiveWrite)));
        if write.on_disabled_hover_text(why.map_or("", |why| cells.text(why))).clicked() {
            messages.push(Message::act(Model::edit_live_value));
        }
    });
}

/// The value with its quality and times, then all other attributes. Texts can be selected and copied.
fn attributes(ui: &mut Ui, cells: &ValueCells<'_>, details: &NodeDetails, value: Option<&DataValue>) {
    let palette = palette(ui);
    table(ui, "attributes", 2, |ui| {
        let line = |ui: &mut Ui, name: &str, said: &str, color| {
            ui.label(RichText::new(name).color(palette.weak));
            ui.add(Label::new(RichText::new(said).color(color)).wrap().selectable(true));
            ui.end_row();
        };
        if let Some(value) = value {
            let color = match () {
                () if !cells.form.is_live() => palette.off,
                () if value.quality.is_bad() => palette.warning,
                () => palette.text,
            };
            let zone = cells.model.zone;
            line(ui, cells.text(T::LiveValue), &one_line(&value.value.to_string(), 500), color);
            line(ui, cells.text(T::LiveQuality), value.quality.name(), color);
            for (key, at) in [(T::LiveSourceTime, value.source_time), (T::LiveServerTime, value.server_time)] {
                line(ui, cells.text(key), &at.map_or("–".to_owned(), |at| zone.date_time(at)), color);
            }
        }
        for (name, value) in &details.attributes {
            let said = match (*name, &details.data_type) {
                ("DataType", Some(data_type)) => format!("{data_type} ({})", value.value),
                _ if value.quality.is_bad() => value.quality.name().to_owned(),
                _ => value.value.to_string(),
            };
            line(ui, name, &one_line(&said, 500), palette.text);
        }
    });
}
