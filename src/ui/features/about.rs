//! About the program, and its keys.

use egui::{Grid, Key, Label, Modifiers, RichText, Ui, vec2};

use crate::texts::{self, TextKey as T};
use crate::ui::features::COMMANDS;
use crate::ui::model::{Dialog, DialogAnswer, DialogPlace, Message, Model, UiCommand};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, command_button, dialog, small_note};

/// The version of the program, its workspace and its licence.
#[derive(Debug)]
pub struct AboutDialog;

impl UiCommand {
    /// Says what the program is.
    pub const ABOUT: Self = Self::new(T::About, T::AboutTip, |model, _| {
        model.open(AboutDialog);
        vec![]
    })
    .in_menu(T::MenuHelp);

    /// Shows the keys of the window.
    pub const SHORTCUTS: Self = Self::new(T::Shortcuts, T::ShortcutsTip, |model, _| {
        model.open(ShortcutsDialog);
        vec![]
    })
    .in_menu(T::MenuHelp)
    .key(Modifiers::NONE, Key::F1);
}

impl Dialog for AboutDialog {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        about(ui, model, messages)
    }
}

/// The keys of the window.
#[derive(Debug)]
pub struct ShortcutsDialog;

impl Dialog for ShortcutsDialog {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        shortcuts(ui, model)
    }
}

fn about(ui: &Ui, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Close), None)), close: None };
    dialog(ui, "about", text(T::AppName), theme::DIALOG, buttons, |ui| {
        ui.label(texts::version(model.language, env!("CARGO_PKG_VERSION")));
        ui.add_space(theme::SPACE);
        ui.add(Label::new(text(T::AboutText)).wrap());
        ui.add_space(theme::SPACE);
        let weak = palette(ui).weak;
        ui.label(RichText::new(text(T::WorkspaceLabel)).size(theme::SMALL_TEXT).color(weak));
        ui.add(
            Label::new(RichText::new(model.workspace.root().display().to_string()).monospace()).wrap().selectable(true),
        );
        ui.add_space(theme::SPACE);
        small_note(ui, text(T::AboutLicence));
        ui.add_space(theme::SPACE);
        command_button(ui, UiCommand::LICENCES, false, model, messages);
    })
}

fn shortcuts(ui: &Ui, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Close), None)), close: None };
    dialog(ui, "shortcuts", text(T::Shortcuts), theme::DIALOG, buttons, |ui| {
        ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
        Grid::new("shortcuts").num_columns(2).spacing(vec2(28.0, 8.0)).show(ui, |ui| {
            let line = |ui: &mut Ui, key: &str, what: &str| {
                ui.label(RichText::new(key).color(palette(ui).weak));
                ui.label(what);
                ui.end_row();
            };
            for command in COMMANDS {
                if let Some(shortcut) = command.shortcut() {
                    let key = ui.ctx().format_shortcut(&shortcut);
                    line(ui, &key, text(command.text()).trim_end_matches('…'));
                }
            }
            let fixed = [
                (T::KeyArrows, T::KeyMove),
                (T::KeySpace, T::KeyTick),
                (T::KeyShiftClick, T::KeyRange),
                (T::KeyEnterRow, T::KeyDetails),
                (T::KeyMenu, T::KeyRowMenu),
                (T::KeySideways, T::KeyPanes),
                (T::KeyEnter, T::KeyConfirm),
                (T::KeyEscape, T::KeyCancel),
            ];
            line(ui, &ui.ctx().format_shortcut(&super::client_certificates::UNDO), text(T::KeyUndo));
            for (key, what) in fixed {
                line(ui, text(key), text(what));
            }
        });
    })
}
