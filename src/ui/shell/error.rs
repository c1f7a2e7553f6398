use egui::{Label, RichText, Ui};

use crate::model::{Language, Problem};
use crate::texts::TextKey as T;
use crate::ui::model::{Dialog, DialogAnswer, DialogPlace, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog};

/// A failure that is shown over everything else.
#[derive(Debug)]
pub struct ErrorDialog(pub Problem);

impl Dialog for ErrorDialog {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        show(ui, &self.0, model)
    }
}

impl Model {
    /// Shows a failure above all other dialogs.
    pub fn show_problem(&mut self, problem: Problem) {
        self.open(ErrorDialog(problem));
    }
}

/// Message, cause, remedy, detail.
fn show(ui: &Ui, problem: &Problem, model: &Model) -> DialogAnswer {
    let language = model.language;
    let buttons = Buttons { submit: Some((T::Close.text(language), None)), close: None };
    dialog(ui, "error", problem.code.explain(language).message, theme::DIALOG, buttons, |ui| {
        explanation(ui, problem, language);
    })
}

/// Cause, remedy and what helps support, below a message.
pub fn explanation(ui: &mut Ui, problem: &Problem, language: Language) {
    let explained = problem.code.explain(language);
    let weak = palette(ui).weak;
    let mut part = |title: T, text: &str, technical: bool| {
        ui.label(RichText::new(title.text(language)).size(theme::SMALL_TEXT).color(weak));
        let text = if technical { RichText::new(text).monospace() } else { RichText::new(text) };
        // To be copied into a report.
        ui.add(Label::new(text).wrap().selectable(true));
        ui.add_space(theme::SPACE);
    };
    part(T::Cause, explained.cause, false);
    part(T::Remedy, explained.remedy, false);
    let code = problem.code.as_str();
    match &problem.detail {
        Some(detail) => part(T::Detail, &format!("{code}: {detail}"), true),
        None => part(T::Detail, code, true),
    }
}
