use egui::{Align, Color32, Grid, Label, Layout, Response, RichText, Sense, Ui, vec2};

use crate::jobs::LivePoint;
use crate::model::opcua::{DataValue, Quality, Value};
use crate::model::untrusted_text::one_line;
use crate::texts::{self, TextKey as T};
use crate::ui::features::live_values::LiveForm;
use crate::ui::model::{Message, Model};
use crate::ui::theme::{self, palette};

/// Draws values of the dialog.
pub struct ValueCells<'a> {
    pub form: &'a LiveForm,
    pub model: &'a Model,
}

impl ValueCells<'_> {
    pub fn text(&self, key: T) -> &'static str {
        key.text(self.model.language)
    }

    /// The value of a variable with its unit; nothing where the server does not have the variable.
    pub fn value(&self, ui: &mut Ui, point: &Option<LivePoint>, messages: &mut Vec<Message>) {
        let color = palette(ui).text;
        match point {
            Some(point) => drop(self.point(ui, point, color, |value| self.written(point, value), messages)),
            None => drop(ui.label("")),
        }
    }

    /// A value for which there is a word, with its colour; another value as it is.
    pub fn word(
        &self,
        ui: &mut Ui,
        point: &Option<LivePoint>,
        word: impl Fn(&Value) -> Option<(T, Color32)>,
        messages: &mut Vec<Message>,
    ) {
        let Some(point) = point else { return drop(ui.label("")) };
        let found = self.form.value(&point.node).and_then(|value| word(&value.value));
        let color = found.map_or(palette(ui).text, |(_, color)| color);
        let said = |value: &Value| match found {
            Some((key, _)) => self.text(key).to_owned(),
            None => self.written(point, value),
        };
        self.point(ui, point, color, said, messages);
    }

    /// A number that stands for something, as an enumeration of the standard has it.
    pub fn enumeration(&self, ui: &mut Ui, point: &Option<LivePoint>, words: &[T], messages: &mut Vec<Message>) {
        let color = palette(ui).text;
        let word = |value: &Value| Some((*words.get(value.as_f64()? as usize)?, color));
        self.word(ui, point, word, messages);
    }

    fn written(&self, point: &LivePoint, value: &Value) -> String {
        let text = texts::live_value(self.model.language, value, self.model.zone);
        match &point.unit {
            Some(unit) if value.as_f64().is_some() => format!("{text} {unit}"),
            _ => text,
        }
    }

    /// A label that can be dragged into the plot. Values of a lost connection are grey.
    pub fn point(
        &self,
        ui: &mut Ui,
        point: &LivePoint,
        color: Color32,
        said: impl FnOnce(&Value) -> String,
        messages: &mut Vec<Message>,
    ) -> Response {
        let palette = palette(ui);
        let value = self.form.value(&point.node);
        let (shown, color) = match value {
            None => ("…".to_owned(), palette.weak),
            Some(DataValue { quality: Quality::Bad { name }, .. }) => (name.clone(), palette.warning),
            Some(value) => (said(&value.value), color),
        };
        let color = if self.form.is_live() { color } else { palette.off };
        let number = value.is_some_and(|value| value.value.as_f64().is_some());
        let sense = if number { Sense::click_and_drag() } else { Sense::click() };
        // A grid gives a label no more room than the lines above; the rest is in the tooltip.
        let shown = RichText::new(one_line(&shown, MAX_CHARS)).color(color);
        let label = Label::new(shown).selectable(false).extend().sense(sense);
        let response = ui.add(label);
        self.offer(&response, point, number, messages);
        response.on_hover_ui(|ui| self.details(ui, point, value))
    }

    /// What can be done with a value: drag it into the plot, or choose that in its menu.
    pub fn offer(&self, response: &Response, point: &LivePoint, number: bool, messages: &mut Vec<Message>) {
        if number {
            response.dnd_set_drag_payload(point.clone());
            if response.dragged() {
                response.ctx.set_cursor_icon(egui::CursorIcon::Grabbing);
            }
        }
        response.context_menu(|ui| {
            let is_plotted = self.form.plot.holds(&point.node);
            let why = match number {
                false => Some(T::LiveNotNumeric),
                true if !is_plotted && self.form.plot.is_full() => Some(T::LivePlotFull),
                true => None,
            };
            let key = if is_plotted { T::LiveRemoveFromPlot } else { T::LiveAddToPlot };
            let item = ui.add_enabled(why.is_none(), egui::Button::new(self.text(key)));
            if item.on_disabled_hover_text(why.map_or("", |why| self.text(why))).clicked() {
                let point = point.clone();
                messages.push(Message::act(move |model| match is_plotted {
                    true => model.live_unplot(Some(&point.node)),
                    false => model.live_plot(point),
                }));
            }
            if ui.button(self.text(T::Copy)).clicked() {
                let value = self.form.value(&point.node).map(|value| value.value.to_string());
                ui.ctx().copy_text(value.unwrap_or_default());
            }
        });
    }

    /// The value in full, its quality and its times.
    fn details(&self, ui: &mut Ui, point: &LivePoint, value: Option<&DataValue>) {
        ui.label(RichText::new(&point.name).strong());
        ui.label(RichText::new(point.node.to_string()).size(theme::SMALL_TEXT).monospace());
        let Some(value) = value else { return };
        ui.label(one_line(&value.value.to_string(), 300));
        let time = |at: Option<chrono::DateTime<chrono::Utc>>| at.map(|at| self.model.zone.date_time(at));
        let rows = [
            (T::LiveQuality, Some(value.quality.name().to_owned())),
            (T::LiveSourceTime, time(value.source_time)),
            (T::LiveServerTime, time(value.server_time)),
        ];
        for (key, said) in rows {
            if let Some(said) = said {
                ui.label(RichText::new(format!("{}  {said}", self.text(key))).size(theme::SMALL_TEXT));
            }
        }
    }

    /// The label and the value of each variable that the server has, in columns.
    pub fn facts(&self, ui: &mut Ui, id: &str, rows: &[(&str, Drawn<'_>)], messages: &mut Vec<Message>) {
        let columns = if ui.available_width() > WIDE { 3 } else { 2 };
        Grid::new(id).num_columns(2 * columns).spacing(vec2(theme::SPACE_LARGE, 4.0)).show(ui, |ui| {
            for (index, (label, draw)) in rows.iter().enumerate() {
                ui.label(RichText::new(*label).color(palette(ui).weak));
                ui.with_layout(Layout::left_to_right(Align::Center), |ui| draw(ui, messages));
                if index % columns == columns - 1 {
                    ui.end_row();
                }
            }
        });
    }
}

/// Draws one value.
pub type Drawn<'a> = &'a dyn Fn(&mut Ui, &mut Vec<Message>);

/// Headings of a table, small and weak.
pub fn headings(ui: &mut Ui, headings: &[&str]) {
    for heading in headings {
        ui.label(RichText::new(*heading).size(theme::HEADER_TEXT).color(palette(ui).weak));
    }
    ui.end_row();
}

/// A table whose rows are drawn by `rows`.
pub fn table(ui: &mut Ui, id: impl std::hash::Hash + std::fmt::Debug, columns: usize, rows: impl FnOnce(&mut Ui)) {
    ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
    let grid = Grid::new(id).num_columns(columns).spacing(vec2(theme::SPACE_LARGE * 1.5, 2.0)).striped(true);
    grid.show(ui, rows);
}

/// The heading of a part of a tab.
pub fn heading(ui: &mut Ui, text: &str) {
    ui.add_space(theme::SPACE);
    ui.add(Label::new(RichText::new(text).strong()).truncate());
}

const WIDE: f32 = 900.0;
/// Characters of a value in a table.
const MAX_CHARS: usize = 48;
