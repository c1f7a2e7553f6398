use egui::{Color32, Label, RichText, Ui};

use crate::model::StatusFlag;
use crate::model::untrusted_text::one_line;
use crate::texts::{self, TextKey as T};
use crate::ui::features::remote_control::RemoteForm;
use crate::ui::model::Model;
use crate::ui::theme::{Palette, palette};
use crate::ui::widgets::chip;

/// The eleven states, and the error or warning. Grey while the connection is lost.
pub fn show(ui: &mut Ui, form: &RemoteForm, model: &Model) {
    let text = |key: T| key.text(model.language);
    let palette = palette(ui);
    let Some(status) = form.status else { return };
    ui.horizontal_wrapped(|ui| {
        for flag in StatusFlag::ALL {
            let is_on = status.flags.contains(flag);
            let color = if is_on && form.is_live() { color(flag, palette) } else { palette.off };
            let said = text(if is_on { T::LiveOn } else { T::LiveOff });
            let lamp = chip(ui, &format!("{}: {said}", flag.name()), color);
            lamp.on_hover_text(text(texts::status_flag(flag)));
        }
    });
    if status.code > 0 {
        let message = form.message.as_deref().map(|message| one_line(message, MAX_MESSAGE));
        let said = texts::remote_error(model.language, status.code, message.as_deref());
        let color = if status.flags.contains(StatusFlag::Warning) { palette.warning } else { palette.error };
        let color = if form.is_live() { color } else { palette.off };
        ui.add(Label::new(RichText::new(said).color(color).strong()).wrap().selectable(true));
    }
}

const fn color(flag: StatusFlag, palette: &Palette) -> Color32 {
    match flag {
        StatusFlag::SError | StatusFlag::Safeguard | StatusFlag::EStop | StatusFlag::Error => palette.error,
        StatusFlag::Warning | StatusFlag::Test | StatusFlag::Teach | StatusFlag::Paused => palette.warning,
        StatusFlag::Auto | StatusFlag::Running | StatusFlag::Ready => palette.ok,
    }
}

/// Characters of the controller's text.
const MAX_MESSAGE: usize = 300;
