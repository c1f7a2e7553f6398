//! Whether copies of certificates are kept (manual 2.8.1).

use egui::{Label, RichText, Ui};

use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, UiCommand};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, small_note};

/// Whether backups are kept.
#[derive(Debug)]
pub struct BackupDialog {
    /// Whether backups will be kept.
    pub on: bool,
}

impl UiCommand {
    /// Whether copies of certificates are kept.
    pub const BACKUP: Self = Self::new(T::Backup, T::BackupTip, |model, _| {
        model.open(BackupDialog { on: model.options.backup });
        vec![]
    })
    .in_menu(T::MenuOptions);
}

impl Dialog for BackupDialog {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        backup(ui, &mut self.on, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.options.backup = self.on;
        model.save()
    }
}

fn backup(ui: &Ui, on: &mut bool, model: &Model) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let buttons = Buttons { submit: Some((text(T::Apply), None)), close: Some(text(T::Cancel)) };
    dialog(ui, "backup", text(T::BackupTitle), theme::DIALOG, buttons, |ui| {
        ui.checkbox(on, text(T::BackupOn));
        ui.add_space(theme::SPACE);
        ui.add(Label::new(text(T::BackupWhere)).wrap());
        let folder = model.workspace.root().display().to_string();
        ui.add(Label::new(RichText::new(folder).monospace().color(palette(ui).weak)).wrap().selectable(true));
        ui.add_space(theme::SPACE);
        small_note(ui, text(T::BackupKeys));
        small_note(ui, text(T::BackupRestore));
    })
}
