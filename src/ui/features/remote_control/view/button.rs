use egui::{Button, Response, Ui};

use crate::remote::{Command, Request};
use crate::texts::TextKey as T;
use crate::ui::features::remote_control::{RemoteForm, WhyNot};
use crate::ui::model::{Message, Model};

/// A button that sends a command. Its tooltip says what then happens, or why it cannot be sent now.
pub fn act(
    ui: &mut Ui,
    form: &RemoteForm,
    label: T,
    request: &Request,
    model: &Model,
    messages: &mut Vec<Message>,
) -> Response {
    act_unless(ui, form.why_not(request.command()), label, request, model, messages)
}

/// As [`act`], with the reason why not.
pub fn act_unless(
    ui: &mut Ui,
    why: Option<WhyNot>,
    label: T,
    request: &Request,
    model: &Model,
    messages: &mut Vec<Message>,
) -> Response {
    let response = ui.add_enabled(why.is_none(), Button::new(label.text(model.language)));
    let response = explain(response, why.as_ref(), request.command(), model);
    if response.clicked() {
        send(request.clone(), messages);
    }
    response
}

/// Says what a command does, or why it cannot be sent now.
pub fn explain(response: Response, why: Option<&WhyNot>, command: Command, model: &Model) -> Response {
    match why {
        Some(why) => response.on_disabled_hover_text(why.text(model.language)),
        None => match command.consequence() {
            Some(consequence) => response.on_hover_text(consequence.text(model.language)),
            None => response,
        },
    }
}

/// Sends a command.
pub fn send(request: Request, messages: &mut Vec<Message>) {
    messages.push(Message::act(move |model| model.act_remotely(request)));
}
