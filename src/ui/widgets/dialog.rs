use egui::{Align, Button, Color32, Frame, Id, Key, Layout, Modal, Modifiers, RichText, ScrollArea, Stroke, Ui};

use super::primary;
use crate::ui::theme::{self, palette};

/// What the engineer decided in a dialog, if anything.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Answer {
    None,
    Submit,
    Close,
}

/// The buttons at the foot of a dialog.
#[derive(Debug, Clone, Copy)]
pub struct Buttons<'a> {
    /// The main button, and why it is disabled.
    pub submit: Option<(&'a str, Option<&'a str>)>,
    pub close: Option<&'a str>,
}

/// A dialog over the window: title, a body that scrolls when the window is low, and buttons.
///
/// Esc closes it; a click beside it does not, as what was typed would be lost.
pub fn dialog(
    ui: &Ui,
    id: impl std::hash::Hash + std::fmt::Debug,
    title: &str,
    width: f32,
    buttons: Buttons<'_>,
    body: impl FnOnce(&mut Ui),
) -> Answer {
    let room = ui.ctx().content_rect();
    let frame = Frame::window(ui.style());
    let width = width.min(room.width() - frame.total_margin().sum().x - 2.0 * theme::SPACE);
    let shown = Modal::new(Id::unique(id)).frame(frame).show(ui.ctx(), |ui| {
        ui.set_width(width);
        ui.add(egui::Label::new(RichText::new(title).heading().strong()).truncate());
        ui.add_space(theme::SPACE);
        ScrollArea::vertical()
            .max_height(room.height() - theme::DIALOG_MARGIN)
            .auto_shrink([false, true])
            .show(ui, body);
        if buttons.submit.is_none() && buttons.close.is_none() {
            return Answer::None;
        }
        ui.add_space(theme::SPACE_LARGE);
        foot(ui, buttons)
    });
    settle(ui.ctx(), &shown.response);
    let escape = || ui.ctx().input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    if shown.inner == Answer::None && shown.is_top_modal && !shown.any_popup_open && escape() {
        return Answer::Close;
    }
    shown.inner
}

/// A dialog is centred by the size it had a frame ago, so after a change of size one more frame is due. Nothing else
/// would draw it.
fn settle(ctx: &egui::Context, dialog: &egui::Response) {
    let place = dialog.id.with("place");
    let before = ctx.data_mut(|data| data.get_temp::<egui::Rect>(place));
    if before != Some(dialog.rect) {
        ctx.data_mut(|data| data.insert_temp(place, dialog.rect));
        ctx.request_repaint();
    }
}

fn foot(ui: &mut Ui, buttons: Buttons<'_>) -> Answer {
    let mut answer = Answer::None;
    ui.allocate_ui_with_layout(
        egui::vec2(ui.available_width(), theme::BUTTON_HEIGHT),
        Layout::right_to_left(Align::Center),
        |ui| {
            if let Some((text, why)) = buttons.submit {
                let button = if why.is_none() { primary(ui, text) } else { Button::new(text) };
                let response = ui.add_enabled(why.is_none(), button);
                if response.on_disabled_hover_text(why.unwrap_or_default()).clicked() {
                    answer = Answer::Submit;
                }
            }
            if let Some(text) = buttons.close
                && ui.button(text).clicked()
            {
                answer = Answer::Close;
            }
        },
    );
    answer
}

/// A boxed remark in a colour: a warning, a failure.
pub fn note(ui: &mut Ui, color: Color32, body: impl FnOnce(&mut Ui)) {
    Frame::new()
        .fill(color.gamma_multiply(0.09))
        .stroke(Stroke::new(1.0, color.gamma_multiply(0.4)))
        .corner_radius(8)
        .inner_margin(theme::CARD_MARGIN)
        .show(ui, |ui| {
            ui.set_width(ui.available_width());
            ui.visuals_mut().override_text_color = Some(palette(ui).text);
            body(ui);
        });
}
