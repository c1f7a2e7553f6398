use egui::{
    Align, Align2, Button, Color32, Context, Frame, Id, Key, Layout, Modal, Modifiers, Rect, Response, RichText,
    ScrollArea, Stroke, Ui, vec2,
};

use super::primary;
use crate::ui::model::DialogAnswer;
use crate::ui::theme::{self, palette};

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
) -> DialogAnswer {
    let room = ui.ctx().content_rect();
    let frame = Frame::window(ui.style());
    let width = width.min(room.width() - frame.total_margin().sum().x - 2.0 * theme::SPACE);
    let id = Id::unique(id);
    let mut area = Modal::default_area(id);
    if let Some(place) = Placement::last(ui.ctx(), id).and_then(|last| last.kept(room)) {
        area = area.anchor(Align2::CENTER_TOP, vec2(0.0, place.top() - room.top()));
    }
    let shown = Modal::new(id).area(area).frame(frame).show(ui.ctx(), |ui| {
        ui.set_width(width);
        ui.add(egui::Label::new(RichText::new(title).heading().strong()).truncate());
        ui.add_space(theme::SPACE);
        ScrollArea::vertical()
            .max_height(room.height() - theme::DIALOG_MARGIN)
            .auto_shrink([false, true])
            .show(ui, body);
        if buttons.submit.is_none() && buttons.close.is_none() {
            return DialogAnswer::None;
        }
        ui.add_space(theme::SPACE_LARGE);
        foot(ui, buttons)
    });
    settle(ui.ctx(), &shown.response);
    let escape = || ui.ctx().input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape));
    if shown.inner == DialogAnswer::None && shown.is_top_modal && !shown.any_popup_open && escape() {
        return DialogAnswer::Close;
    }
    shown.inner
}

/// Growth in points up to which a dialog keeps its upper edge: a warning or two, not the contents that were awaited.
const KEEPS_PLACE: f32 = 160.0;

/// Where a dialog was drawn last. Centred when it opens, it then keeps its upper edge, so that it does not move under
/// the mouse when a warning appears in it.
#[derive(Debug, Clone, Copy)]
struct Placement {
    window: Rect,
    dialog: Rect,
    /// How it lay when it was centred and had its size; `None` while it is still being centred.
    centred: Option<Rect>,
    /// A dialog that was not drawn in the pass before is a new one.
    pass: u64,
}

impl Placement {
    fn last(ctx: &Context, id: Id) -> Option<Self> {
        let placement: Option<Self> = ctx.data(|data| data.get_temp(id.with("placement")));
        placement.filter(|placement| placement.pass + 1 >= ctx.cumulative_pass_nr())
    }

    /// The place to keep; `None` where the dialog has to be centred: it is new, the window or its contents have
    /// changed, or it would reach beyond the window's lower edge.
    fn kept(&self, window: Rect) -> Option<Rect> {
        self.centred.filter(|centred| {
            let growth = (self.dialog.height() - centred.height()).abs();
            let fits = centred.top() + self.dialog.height() <= window.bottom();
            self.window == window && growth <= KEEPS_PLACE && fits
        })
    }
}

/// Notes where the dialog is. Its place follows from the size it had a frame ago, so after a change one more frame is
/// due, which nothing else would draw.
fn settle(ctx: &Context, dialog: &Response) {
    let (id, window) = (dialog.id, ctx.content_rect());
    let before = Placement::last(ctx, id);
    let stable = before.is_some_and(|before| before.dialog == dialog.rect);
    let kept = before.and_then(|before| before.kept(window));
    let centred = kept.or_else(|| stable.then_some(dialog.rect));
    let now = Placement { window, dialog: dialog.rect, centred, pass: ctx.cumulative_pass_nr() };
    ctx.data_mut(|data| data.insert_temp(id.with("placement"), now));
    if !stable {
        ctx.request_repaint();
    }
}

fn foot(ui: &mut Ui, buttons: Buttons<'_>) -> DialogAnswer {
    let mut answer = DialogAnswer::None;
    ui.allocate_ui_with_layout(
        egui::vec2(ui.available_width(), theme::BUTTON_HEIGHT),
        Layout::right_to_left(Align::Center),
        |ui| {
            if let Some((text, why)) = buttons.submit {
                let button = if why.is_none() { primary(ui, text) } else { Button::new(text) };
                let response = ui.add_enabled(why.is_none(), button);
                if response.on_disabled_hover_text(why.unwrap_or_default()).clicked() {
                    answer = DialogAnswer::Submit;
                }
            }
            if let Some(text) = buttons.close
                && ui.button(text).clicked()
            {
                answer = DialogAnswer::Close;
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
