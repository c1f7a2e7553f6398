//! Files held over the window and dropped onto it.

use std::path::PathBuf;

use egui::{Align2, Area, Context, Frame, Id, Label, Order, RichText, Stroke, Ui};

use super::theme::{self, palette};
use crate::texts::{self, TextKey as T};
use crate::ui::model::{DropForm, DroppedFile, Message, Model};

/// Names shown before the rest is counted.
const MOST: usize = 6;

/// Tells the model what is held over the window, when that changes, and what was dropped.
pub fn read(ctx: &Context, model: &Model, messages: &mut Vec<Message>) {
    let (hovered, dropped) = ctx.input(|input| {
        let hovered: Vec<PathBuf> =
            input.raw.hovered_files.iter().map(|file| file.path.clone().unwrap_or_default()).collect();
        let dropped: Vec<PathBuf> = input.raw.dropped_files.iter().map(|file| file.path().to_owned()).collect();
        (hovered, dropped)
    });
    if !dropped.is_empty() {
        messages.push(Message::Dropped(dropped));
    } else if model.hover.as_ref().map_or(&[][..], |hover| &hover.paths) != hovered {
        messages.push(Message::Hovered(hovered));
    }
}

/// Says what dropping the files would do, over everything else.
pub fn overlay(ctx: &Context, model: &Model) {
    let Some(hover) = &model.hover else { return };
    let text = |key: T| key.text(model.language);
    let screen = ctx.content_rect();
    Area::new(Id::unique("drop"))
        .order(Order::Tooltip)
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .interactable(false)
        .show(ctx, |ui| {
            let palette = palette(ui);
            let width = theme::DIALOG.min(screen.width() - 2.0 * theme::SPACE_LARGE);
            let frame = Frame::window(ui.style()).stroke(Stroke::new(2.0, palette.accent));
            frame.show(ui, |ui| {
                ui.set_width(width);
                ui.label(RichText::new(texts::drop_title(model.language, hover.paths.len())).heading().strong());
                ui.add_space(theme::SPACE);
                match &hover.found {
                    None if hover.taken => {
                        ui.label(RichText::new(text(T::TrustDropHere)).color(palette.accent));
                    }
                    None if hover.paths.iter().all(|path| path.as_os_str().is_empty()) => {
                        ui.label(RichText::new(text(T::DropUnseen)).color(palette.weak));
                    }
                    None => drop(ui.label(RichText::new(text(T::Reading)).color(palette.weak))),
                    Some(form) => {
                        files(ui, &form.files, model);
                        conclusion(ui, form, model);
                    }
                }
            });
        });
}

/// Each file and what it is, or why it cannot be used.
pub fn files(ui: &mut Ui, files: &[DroppedFile], model: &Model) {
    let palette = palette(ui);
    for file in files.iter().take(MOST) {
        ui.add(Label::new(RichText::new(file.name()).strong()).truncate());
        let (said, color) = match &file.found {
            Ok(kind) => (texts::recognised(*kind).text(model.language), palette.weak),
            Err(problem) => (problem.code.explain(model.language).message, palette.error),
        };
        ui.add(Label::new(RichText::new(said).size(theme::SMALL_TEXT).color(color)).wrap());
    }
    if files.len() > MOST {
        let more = texts::more(model.language, files.len() - MOST);
        ui.label(RichText::new(more).size(theme::SMALL_TEXT).color(palette.weak));
    }
    if !files.is_empty() {
        ui.add_space(theme::SPACE);
    }
}

fn conclusion(ui: &mut Ui, form: &DropForm, model: &Model) {
    let palette = palette(ui);
    let name = |at: usize| form.choices[at].title.text(model.language);
    let (said, color) = match (form.blocked, form.only(), form.offers()) {
        (Some(why), ..) => (why.text(model.language).to_owned(), palette.error),
        (None, Some(at), _) => (texts::drop_opens(model.language, name(at)), palette.accent),
        (None, None, true) => (T::DropAsks.text(model.language).to_owned(), palette.accent),
        (None, None, false) => match form.choices.iter().position(|choice| choice.why.is_some()) {
            Some(at) => {
                let why = form.choices[at].why.map_or("", |why| why.text(model.language));
                (texts::drop_disabled(model.language, name(at), why), palette.error)
            }
            None => (T::DropNothing.text(model.language).to_owned(), palette.error),
        },
    };
    ui.add(Label::new(RichText::new(said).color(color)).wrap());
}
