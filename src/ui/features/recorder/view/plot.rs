use std::ops::Range;

use egui::{Button, Color32, Context, Key, Modifiers, RichText, ScrollArea, Sense, Ui};
use egui_plot::{Line, PlotPoints, Points};

use crate::recorder::{LiveColumn, LiveValues, Quantity, Source};
use crate::texts::{self, TextKey as T};
use crate::ui::features::recorder::plot::{PlotRange, RecordingPlot};
use crate::ui::model::Model;
use crate::ui::theme::{self, Palette, palette};
use crate::ui::widgets::small_note;

/// Whether keys move the plots.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Keys {
    /// As far as no widget takes them.
    Read,
    /// Another dialog is in front.
    Ignore,
}

/// The choice of quantities and a plot of each, one above the other, with the same time. Returns whether other quantities
/// were chosen.
#[expect(clippy::too_many_arguments, reason = "what is drawn, and where")]
pub fn show(
    ui: &mut Ui,
    plot: &mut RecordingPlot,
    source: Source,
    values: &[&LiveValues],
    is_running: bool,
    height: f32,
    keys: Keys,
    model: &Model,
) -> bool {
    let top = ui.cursor().top();
    let changed = quantities(ui, plot, source, model);
    let Some(span) = span(values) else {
        small_note(ui, if is_running { T::RecorderNoValues } else { T::RecorderNoValuesEnded }.text(model.language));
        return changed;
    };
    tools(ui, plot, &span, is_running, model);
    if keys == Keys::Read {
        read_keys(ui.ctx(), plot, &span);
    }
    let height = height - (ui.cursor().top() - top);
    let shown = plot.quantities().to_vec();
    let each =
        (height / shown.len().max(1) as f32 - theme::DENSE_HEIGHT - 3.0 * theme::SPACE).max(theme::PLOT_MIN_HEIGHT);
    ScrollArea::vertical().id_salt("plots").max_height(height).auto_shrink([false, true]).show(ui, |ui| {
        for quantity in shown {
            let drawn = drawn(plot, quantity, source, values, &span, ui.available_width() as usize, palette(ui));
            legend(ui, plot, quantity, &drawn, model);
            lines(ui, plot, quantity, drawn, &span, each);
        }
    });
    if is_running && plot.follows() {
        ui.ctx().request_repaint_after(REFRESH);
    }
    changed
}

/// How often the plots are drawn at least while they follow a recording.
pub const REFRESH: std::time::Duration = std::time::Duration::from_millis(100);

/// The time of all values.
fn span(values: &[&LiveValues]) -> Option<Range<f64>> {
    let of = |columns: &[LiveColumn]| {
        let spans = columns.iter().filter_map(|column| column.series.span());
        spans.reduce(|one, other| one.start.min(other.start)..one.end.max(other.end))
    };
    values
        .iter()
        .filter_map(|values| values.read(of))
        .reduce(|one, other| one.start.min(other.start)..one.end.max(other.end))
}

/// Which quantities are plotted.
fn quantities(ui: &mut Ui, plot: &mut RecordingPlot, source: Source, model: &Model) -> bool {
    let mut changed = false;
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
        for quantity in Quantity::of(source) {
            let is_shown = plot.quantities().contains(&quantity);
            let button = Button::selectable(is_shown, quantity.text_key().text(model.language));
            let response = ui.add_enabled(is_shown || !plot.is_full(), button);
            if response.on_disabled_hover_text(T::RecorderPlotsFull.text(model.language)).clicked() {
                plot.toggle(quantity);
                changed = true;
            }
        }
    });
    changed
}

/// Which part of the time is shown.
fn tools(ui: &mut Ui, plot: &mut RecordingPlot, span: &Range<f64>, is_running: bool, model: &Model) {
    let text = |key: T| key.text(model.language);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
        let whole = Button::selectable(plot.range == PlotRange::Whole, text(T::RecorderWhole));
        if ui.add(whole).on_hover_text(text(T::RecorderWholeTip)).clicked() {
            plot.range = PlotRange::Whole;
        }
        if is_running {
            for seconds in LAST {
                let range = PlotRange::Last(f64::from(seconds));
                let label = texts::live_span(model.language, seconds);
                if ui.add(Button::selectable(plot.range == range, label)).clicked() {
                    plot.range = range;
                }
            }
            let (label, tip) = if plot.follows() {
                (T::LivePlotPause, T::RecorderPauseTip)
            } else {
                (T::LivePlotResume, T::RecorderFollowTip)
            };
            if ui.button(text(label)).on_hover_text(text(tip)).clicked() {
                plot.pause(span);
            }
        }
        for (label, factor, tip) in [("+", 0.5, T::RecorderZoomIn), ("–", 2.0, T::RecorderZoomOut)] {
            let button = ui.button(label).accessible_name(text(tip));
            if button.on_hover_text(text(tip)).clicked() {
                plot.zoom(span, factor, center(plot));
            }
        }
        let shown = plot.seconds(span);
        let said = texts::recording_range(model.language, shown.start, shown.end);
        ui.label(RichText::new(said).size(theme::SMALL_TEXT).color(palette(ui).weak))
            .on_hover_text(text(T::RecorderPlotKeys));
    });
}

/// Of a plot that follows, the newest values stay at the right edge.
const fn center(plot: &RecordingPlot) -> f64 {
    match plot.range {
        PlotRange::Last(_) => 1.0,
        PlotRange::Whole | PlotRange::Held(..) => 0.5,
    }
}

const LAST: [u32; 3] = [5, 30, 300];

/// Arrow keys pan, plus and minus zoom, Home shows everything, P pauses.
fn read_keys(ctx: &Context, plot: &mut RecordingPlot, span: &Range<f64>) {
    // A focused button or field takes its keys itself.
    if egui::Popup::is_any_open(ctx) || ctx.memory(|memory| memory.focused()).is_some() {
        return;
    }
    let pressed = |key: Key| ctx.input_mut(|input| input.consume_key(Modifiers::NONE, key));
    for (key, by) in [(Key::ArrowLeft, -0.25), (Key::ArrowRight, 0.25)] {
        if pressed(key) {
            plot.pan(span, by);
        }
    }
    for (key, factor) in [(Key::Plus, 0.5), (Key::Equals, 0.5), (Key::Minus, 2.0)] {
        if pressed(key) {
            plot.zoom(span, factor, center(plot));
        }
    }
    if pressed(Key::Home) {
        plot.range = PlotRange::Whole;
    }
    if pressed(Key::P) {
        plot.pause(span);
    }
}

/// A column as it is drawn.
struct Drawn {
    name: String,
    unit: String,
    color: Color32,
    is_shown: bool,
    gaps: usize,
    lines: Vec<Vec<[f64; 2]>>,
}

/// The columns of a quantity, as they are in the part of the time that is shown.
fn drawn(
    plot: &RecordingPlot,
    quantity: Quantity,
    source: Source,
    values: &[&LiveValues],
    span: &Range<f64>,
    pixels: usize,
    palette: &Palette,
) -> Vec<Drawn> {
    let colors = palette.plot.iter().cycle();
    let names = quantity.columns(source);
    let one = |(name, color): (String, &Color32)| {
        let is_shown = plot.draws(&name);
        let of = |columns: &[LiveColumn]| {
            let column = columns.iter().find(|column| column.name == name)?;
            let lines = if is_shown { column.series.lines(plot.seconds(span), pixels.max(1)) } else { Vec::new() };
            Some((column.unit.clone(), column.series.gaps(), lines))
        };
        let (unit, gaps, lines) = values.iter().find_map(|values| values.read(of)).unwrap_or_default();
        Drawn { name, unit, color: *color, is_shown, gaps, lines }
    };
    names.into_iter().zip(colors).map(one).collect()
}

/// The quantity with its unit, and a button for each column.
fn legend(ui: &mut Ui, plot: &mut RecordingPlot, quantity: Quantity, drawn: &[Drawn], model: &Model) {
    let palette = palette(ui);
    let unit = drawn.iter().map(|column| column.unit.as_str()).find(|unit| !unit.is_empty()).unwrap_or_default();
    let title = quantity.text_key().text(model.language);
    let title = if unit.is_empty() { title.to_owned() } else { format!("{title} [{unit}]") };
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().interact_size.y = theme::CHIP_HEIGHT;
        ui.spacing_mut().button_padding.x = theme::SPACE / 2.0;
        ui.label(RichText::new(title).size(theme::SMALL_TEXT).strong());
        for column in drawn {
            let color = if column.is_shown { column.color } else { palette.off };
            let (mark, _) = ui.allocate_exact_size(egui::Vec2::splat(theme::PLOT_MARK), Sense::hover());
            ui.painter().rect_filled(mark, 2.0, color);
            let label = RichText::new(&column.name).size(theme::SMALL_TEXT).color(color);
            let button = ui.add(Button::new(label).frame(false)).accessible_name(column.name.as_str());
            if button.on_hover_text(T::RecorderColumnTip.text(model.language)).clicked() {
                plot.toggle_column(&column.name);
            }
        }
        let gaps = drawn.iter().map(|column| column.gaps).max().unwrap_or_default();
        if gaps > 0 {
            let said = texts::recording_gaps(model.language, gaps);
            ui.label(RichText::new(said).size(theme::SMALL_TEXT).color(palette.warning));
        }
    });
}

/// One plot. Dragging pans, the mouse wheel zooms, a double click shows everything.
fn lines(ui: &mut Ui, plot: &mut RecordingPlot, quantity: Quantity, drawn: Vec<Drawn>, span: &Range<f64>, height: f32) {
    let palette = palette(ui);
    let Range { start, end } = plot.seconds(span);
    let shown = egui_plot::Plot::new(("recording", quantity))
        .height(height)
        .allow_drag(false)
        .allow_zoom(false)
        .allow_scroll(false)
        .allow_boxed_zoom(false)
        .allow_axis_zoom_drag(false)
        .allow_double_click_reset(false)
        .show_background(false)
        .grid_color(palette.line)
        .y_axis_min_width(theme::PLOT_AXIS)
        .link_cursor(egui::Id::unique("recordings"), [true, false])
        .x_axis_formatter(|mark, _| seconds(mark.value, mark.step_size))
        .show(ui, |ui| {
            ui.set_plot_bounds_x(start..=end);
            ui.set_auto_bounds([false, true]);
            for column in drawn {
                for points in column.lines {
                    let name = column.name.clone();
                    // A line of one point would not be seen.
                    if points.len() == 1 {
                        ui.points(Points::new(name, PlotPoints::from(points)).color(column.color).radius(2.0));
                    } else {
                        ui.line(Line::new(name, PlotPoints::from(points)).color(column.color).width(1.5));
                    }
                }
            }
        });
    let response = shown.response;
    let width = f64::from(shown.transform.frame().width().max(1.0));
    if response.dragged() && response.drag_delta().x != 0.0 {
        plot.pan(span, -f64::from(response.drag_delta().x) / width);
    }
    if response.double_clicked() {
        plot.range = PlotRange::Whole;
    }
    if let Some(pointer) = response.hover_pos() {
        let at = (f64::from(pointer.x - shown.transform.frame().left()) / width).clamp(0.0, 1.0);
        // The list of plots does not scroll meanwhile.
        let turned = ui.ctx().input_mut(|input| {
            let wheel = f64::from(std::mem::take(&mut input.smooth_scroll_delta.y)) * WHEEL;
            f64::from(input.zoom_delta()) * wheel.exp()
        });
        if (turned - 1.0).abs() > 1e-6 {
            plot.zoom(span, 1.0 / turned, at);
        }
    }
}

/// How much a point of the mouse wheel zooms.
const WHEEL: f64 = 0.004;

/// A time on the axis with as many decimals as its marks need: `2.5`, or `12:30` from two minutes on.
fn seconds(seconds: f64, step: f64) -> String {
    if step >= 10.0 && seconds.abs() >= 120.0 {
        let whole = seconds.round() as i64;
        return format!("{}:{:02}", whole / 60, (whole % 60).abs());
    }
    let decimals = (-step.log10()).ceil().clamp(0.0, 6.0) as usize;
    format!("{seconds:.decimals$} s")
}

#[cfg(test)]
mod tests {
    use super::seconds;

    #[test]
    fn times_have_as_many_decimals_as_they_need() {
        let shown = [(0.0, 1.0), (2.5, 0.5), (0.125, 0.005), (90.0, 30.0), (750.0, 60.0), (130.0, 1.0)];
        let shown = shown.map(|(at, step)| seconds(at, step));
        assert_eq!(shown, ["0 s", "2.5 s", "0.125 s", "90 s", "12:30", "130 s"]);
    }
}
