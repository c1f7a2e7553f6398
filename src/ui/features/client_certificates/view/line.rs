//! One line of a list. Its columns are painted rather than laid out as widgets: with three lists side by side, hundreds
//! of widgets would take longer than a frame may.

use egui::text::{LayoutJob, TextFormat, TextWrapping};
use egui::{Checkbox, Color32, FontId, Rect, Sense, TextStyle, Ui, WidgetInfo, pos2, vec2};

use super::cell::{self, CellStyle, CellText};
use crate::texts;
use crate::ui::features::client_certificates::{Pane, TrustColumn};
use crate::ui::model::Model;
use crate::ui::theme::{self, Palette};

/// What all lines of a list share.
pub struct LineContext {
    /// What of the list is in sight.
    pub clip: Rect,
    /// Of the tick boxes, and of the columns.
    pub widths: Vec<f32>,
    pub columns: &'static [TrustColumn],
    /// The list has the keyboard.
    pub has_focus: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LineClick {
    Tick { range: bool },
    Place,
    Open,
}

/// Draws the line at a position of the view into the first cell of its row, and beyond. What was clicked, if anything.
pub fn show(
    ui: &mut Ui,
    position: usize,
    pane: &Pane,
    lines: &LineContext,
    model: &Model,
    palette: &Palette,
) -> Option<(usize, LineClick)> {
    let entry = pane.at(position)?;
    let ticked = pane.is_ticked(&entry.id);
    ui.set_clip_rect(lines.clip);
    let top = ui.max_rect().left_top();
    let row = Rect::from_min_max(pos2(lines.clip.left(), top.y), pos2(lines.clip.right(), top.y + theme::ROW_HEIGHT));
    let response = ui.interact(row, ui.scope_id().with("line"), Sense::click());
    if ticked {
        ui.painter().rect_filled(row, 0.0, ui.visuals().selection.bg_fill);
    } else if position.is_multiple_of(2) {
        ui.painter().rect_filled(row, 0.0, palette.stripe);
    }
    if pane.cursor() == Some(position) {
        let bar = Rect::from_min_size(top, vec2(3.0, theme::ROW_HEIGHT));
        ui.painter().rect_filled(bar, 0.0, if lines.has_focus { palette.accent } else { palette.line });
    }
    let pointer = response.hover_pos();
    let mut whole = None;
    let mut left = top.x;
    for (width, column) in lines.widths.iter().zip(std::iter::once(None).chain(lines.columns.iter().map(Some))) {
        let room = Rect::from_min_size(pos2(left, top.y), vec2(*width, theme::ROW_HEIGHT));
        left += width + ui.spacing().item_spacing.x;
        let Some(column) = column.filter(|_| room.intersects(lines.clip)) else { continue };
        let parts = cell::parts(*column, entry, model, palette);
        let cut_off = paint(ui, room, &parts);
        if cut_off && pointer.is_some_and(|at| room.contains(at)) {
            whole = Some(words(&parts));
        }
    }
    response.widget_info(|| {
        let columns = lines.columns.iter().map(|column| words(&cell::parts(*column, entry, model, palette)));
        WidgetInfo::labeled(egui::Role::Row, true, columns.collect::<Vec<_>>().join(", "))
    });
    let modifiers = ui.input(|input| input.modifiers);
    ui.add_space(10.0);
    let mut on = ticked;
    let tick = ui.add(Checkbox::without_text(&mut on));
    let tick = tick.accessible_name(texts::tick_row(model.language, &entry.issued_to));
    let click = if tick.clicked() {
        Some(LineClick::Tick { range: modifiers.shift })
    } else if response.double_clicked() {
        Some(LineClick::Open)
    } else if response.clicked() {
        let ticks = modifiers.shift || modifiers.command;
        Some(if ticks { LineClick::Tick { range: modifiers.shift } } else { LineClick::Place })
    } else {
        None
    };
    if let Some(whole) = whole {
        response.on_hover_text_at_pointer(whole);
    }
    click.map(|click| (position, click))
}

fn words(parts: &[Option<CellText<'_>>]) -> String {
    parts.iter().flatten().map(|part| part.text.as_ref()).collect::<Vec<_>>().join(" ")
}

/// Whether not all of it found room.
fn paint(ui: &Ui, room: Rect, parts: &[Option<CellText<'_>>]) -> bool {
    let clip = room.intersect(ui.clip_rect());
    let painter = ui.painter().with_clip_rect(clip);
    let mut left = room.left();
    let mut cut_off = false;
    for part in parts.iter().flatten() {
        if part.dot {
            let radius = theme::CHIP_DOT + 1.0;
            painter.circle_filled(pos2(left + radius, room.center().y), radius, part.color);
            left += 2.0 * radius + theme::SPACE;
        }
        let galley = ui.fonts_mut(|fonts| fonts.layout_job(job(ui, part, room.right() - left)));
        cut_off |= galley.elided;
        let size = galley.size();
        painter.galley(pos2(left, room.center().y - size.y / 2.0), galley, Color32::PLACEHOLDER);
        left += size.x + theme::SPACE;
    }
    cut_off
}

fn job(ui: &Ui, part: &CellText<'_>, room: f32) -> LayoutJob {
    let font = match part.look {
        CellStyle::Plain => TextStyle::Body.resolve(ui.style()),
        CellStyle::Number => TextStyle::Monospace.resolve(ui.style()),
        CellStyle::Small => FontId { size: theme::SMALL_TEXT, ..TextStyle::Body.resolve(ui.style()) },
    };
    let mut job = LayoutJob::single_section(part.text.to_string(), TextFormat::simple(font, part.color));
    job.wrap = TextWrapping::truncate_at_width(room.max(0.0));
    job
}
