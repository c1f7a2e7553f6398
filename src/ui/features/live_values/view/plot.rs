use egui::{Align, Button, Label, Layout, RichText, ScrollArea, Sense, Ui, vec2};
use egui_plot::{Line, LineStyle, PlotPoints};

use super::value::ValueCells;
use crate::texts::{self, TextKey as T};
use crate::ui::features::live_values::LiveForm;
use crate::ui::features::live_values::plot::{PlotSeries, SPANS};
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::small_note;

/// The values that are plotted, and a list of them.
pub fn show(ui: &mut Ui, form: &mut LiveForm, height: f32, model: &Model, messages: &mut Vec<Message>) {
    if form.plot.series().is_empty() {
        small_note(ui, T::LivePlotEmpty.text(model.language));
        ui.add_space(height - theme::DENSE_HEIGHT);
        return;
    }
    tools(ui, form, model, messages);
    let height = height - theme::BUTTON_HEIGHT - 2.0 * theme::SPACE;
    ui.horizontal_top(|ui| {
        let width = (ui.available_width() - theme::PLOT_LIST - theme::SPACE).max(theme::PLOT_LIST);
        ui.allocate_ui_with_layout(vec2(width, height), Layout::top_down(Align::Min), |ui| {
            ui.set_max_width(width);
            lines(ui, form, width, height, model);
        });
        ScrollArea::vertical().id_salt("series").max_height(height).auto_shrink(false).show(ui, |ui| {
            let cells = ValueCells { form, model };
            ui.vertical(|ui| {
                for series in form.plot.series() {
                    entry(ui, &cells, series, messages);
                }
            });
        });
    });
}

fn tools(ui: &mut Ui, form: &mut LiveForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.horizontal_wrapped(|ui| {
        for (index, span) in SPANS.iter().enumerate() {
            let label = texts::live_span(model.language, *span);
            if ui.add(Button::selectable(form.plot.span == index, label)).clicked() {
                form.plot.span = index;
            }
        }
        let is_held = form.plot.held_at.is_some();
        if ui.button(text(if is_held { T::LivePlotResume } else { T::LivePlotPause })).clicked() {
            let (_, last) = form.plot.range(model.now, form.is_live());
            form.plot.held_at = (!is_held).then_some(last);
        }
        if ui.button(text(T::LivePlotClear)).clicked() {
            messages.push(Message::act(|model| model.live_unplot(None)));
        }
    });
    ui.add_space(theme::SPACE);
}

fn lines(ui: &mut Ui, form: &LiveForm, width: f32, height: f32, model: &Model) {
    let palette = palette(ui);
    let (from, to) = form.plot.range(model.now, form.is_live());
    let hold = form.is_live() && form.plot.held_at.is_none();
    if hold {
        // The lines move on also while no value changes.
        ui.ctx().request_repaint_after(REFRESH);
    }
    let plot = egui_plot::Plot::new("live plot")
        .width(width)
        .height(height)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .show_background(false)
        .grid_color(palette.line)
        .x_axis_formatter(|mark, _| ago(mark.value));
    plot.show(ui, |plot| {
        plot.set_plot_bounds_x(from - to..=0.0);
        plot.set_auto_bounds([false, true]);
        for series in form.plot.series() {
            let color = palette.plot[series.color % palette.plot.len()];
            for stretch in series.stretches(from, to, width as usize, hold) {
                let line = Line::new(series.point.name.clone(), PlotPoints::from(stretch)).color(color).width(1.5);
                plot.line(line.style(style(series)));
            }
        }
    });
}

/// How often the plot is drawn at least while it follows the values.
const REFRESH: std::time::Duration = std::time::Duration::from_millis(200);

/// A value beyond the number of colours has a dashed line.
fn style(series: &PlotSeries) -> LineStyle {
    if series.color < 8 { LineStyle::Solid } else { LineStyle::dashed_loose() }
}

/// A time before the newest one: `-5`, or `-2:30` from a minute on.
fn ago(seconds: f64) -> String {
    let whole = seconds.abs().round() as u64;
    match whole {
        0 => "0".to_owned(),
        1..60 => format!("-{whole} s"),
        _ => format!("-{}:{:02}", whole / 60, whole % 60),
    }
}

/// Colour, name and value of a line.
fn entry(ui: &mut Ui, cells: &ValueCells<'_>, series: &PlotSeries, messages: &mut Vec<Message>) {
    let palette = palette(ui);
    let size = vec2(ui.available_width(), theme::LIST_ROW);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        let remove = Button::new("×").small();
        let remove = ui.add(remove).on_hover_text(cells.text(T::LivePlotRemove));
        if remove.clicked() {
            let node = series.point.node.clone();
            messages.push(Message::act(move |model| model.live_unplot(Some(&node))));
        }
        let value = cells.form.value(&series.point.node).map(|value| value.value.clone()).unwrap_or_default();
        let value = texts::live_value(cells.model.language, &value, cells.model.zone);
        let unit = series.point.unit.as_deref().unwrap_or_default();
        let color = if cells.form.is_live() { palette.text } else { palette.off };
        ui.label(RichText::new(format!("{value} {unit}").trim_end()).color(color));
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let (rect, _) = ui.allocate_exact_size(vec2(14.0, 3.0), Sense::hover());
            ui.painter().rect_filled(rect, 1.0, palette.plot[series.color % palette.plot.len()]);
            let name = Label::new(&series.point.name).truncate();
            ui.add(name).on_hover_text(series.point.node.to_string());
        });
    });
}

#[cfg(test)]
mod tests {
    #[test]
    fn times_are_told_as_seconds_or_minutes() {
        assert_eq!([0.0, -5.0, -59.6, -150.0].map(super::ago), ["0", "-5 s", "-1:00", "-2:30"]);
    }
}
