use egui::{Label, RichText, ScrollArea, Ui};

use crate::texts::{self, TextKey as T};
use crate::ui::features::client_certificates::{MoveTrust, PaneKind};
use crate::ui::model::{DialogAnswer, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, note};

/// The height at which the notes scroll.
const MOST_HIGH: f32 = 320.0;

/// What there is to think about before certificates are moved into a list.
pub fn show(ui: &Ui, asked: &MoveTrust, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let submit = if asked.to == PaneKind::Trusted { text(T::TrustTrust) } else { text(T::TrustMove) };
    let buttons = Buttons { submit: Some((submit, None)), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::TrustMoveTitle, std::slice::from_ref(&asked.name));
    dialog(ui, "move trust", &title, theme::DIALOG, buttons, |ui| {
        ScrollArea::vertical().max_height(MOST_HIGH).auto_shrink([false, true]).show(ui, |ui| {
            for (issued_to, notes) in &asked.notes {
                note(ui, palette(ui).warning, |ui| {
                    ui.add(Label::new(RichText::new(issued_to).strong()).truncate());
                    for one in notes {
                        ui.add(Label::new(texts::capital(&one.text(model.language))).wrap());
                    }
                });
                ui.add_space(theme::SPACE);
            }
        });
    })
}
