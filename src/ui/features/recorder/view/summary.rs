use egui::{Grid, Label, RichText, ScrollArea, Ui, vec2};

use crate::recorder::Sidecar;
use crate::texts;
use crate::ui::model::Model;
use crate::ui::theme::{self, palette};

/// Gaps that are listed.
const MAX_GAPS: usize = 100;

/// What a recording holds, and what is missing in it.
pub fn show(ui: &mut Ui, sidecar: &Sidecar, model: &Model) {
    let palette = palette(ui);
    let zone = model.zone;
    let facts = texts::recording_facts(model.language, sidecar, |at| zone.date_time(at));
    ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
    // Two facts a line: a summary leaves its room to the plots.
    Grid::new("recording facts").num_columns(4).spacing(vec2(theme::SPACE_LARGE, 2.0)).show(ui, |ui| {
        for pair in facts.chunks(2) {
            for (label, value) in pair {
                ui.label(RichText::new(label.text(model.language)).size(theme::SMALL_TEXT).color(palette.weak));
                ui.add(Label::new(value).selectable(true));
            }
            ui.end_row();
        }
    });
    if sidecar.gaps.is_empty() {
        return;
    }
    ScrollArea::vertical().id_salt("gaps").max_height(theme::LIST_ROW * 2.5).auto_shrink([false, true]).show(
        ui,
        |ui| {
            for gap in sidecar.gaps.iter().take(MAX_GAPS) {
                let said = texts::recording_gap(model.language, gap);
                ui.add(Label::new(RichText::new(said).size(theme::SMALL_TEXT).color(palette.warning)).selectable(true));
            }
            if sidecar.gaps.len() > MAX_GAPS {
                let more = texts::more(model.language, sidecar.gaps.len() - MAX_GAPS);
                ui.label(RichText::new(more).size(theme::SMALL_TEXT).color(palette.weak));
            }
        },
    );
}
