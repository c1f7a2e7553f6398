use egui::{MenuBar, TextWrapMode, Ui};

use crate::model::Language;
use crate::texts::{TextKey as T, theme};
use crate::ui::features::{
    CERTIFICATE_MENU, CONTROLLER_MENU, CREATE_MENU, HELP_MENU, MenuEntries, SERVER_MENU, TOOLS_MENU,
};
use crate::ui::model::{Message, Model, UiCommand as C};
use crate::ui::widgets::command_item;
use crate::workspace::ThemeChoice;

pub fn show(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let menu = |ui: &mut Ui, title: T, groups: MenuEntries, messages: &mut Vec<Message>| {
        ui.menu_button(text(title), |ui| items(ui, groups, model, messages));
    };
    MenuBar::new().ui(ui, |ui| {
        menu(ui, T::MenuController, CONTROLLER_MENU, messages);
        ui.menu_button(text(T::MenuCertificate), |ui| {
            ui.menu_button(text(T::MenuCreate), |ui| {
                items(ui, CREATE_MENU, model, messages);
            });
            items(ui, CERTIFICATE_MENU, model, messages);
        });
        menu(ui, T::MenuServer, SERVER_MENU, messages);
        ui.menu_button(text(T::MenuOptions), |ui| options(ui, model, messages));
        menu(ui, T::MenuTools, TOOLS_MENU, messages);
        menu(ui, T::MenuHelp, HELP_MENU, messages);
    });
}

fn options(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    items(ui, &[&[C::BACKUP]], model, messages);
    ui.separator();
    ui.menu_button(T::LanguageLabel.text(model.language), |ui| {
        for language in Language::ALL {
            if ui.radio(model.language == language, language.own_name()).clicked() {
                messages.push(Message::SetLanguage(language));
            }
        }
    });
    ui.menu_button(T::ThemeLabel.text(model.language), |ui| {
        for choice in [ThemeChoice::System, ThemeChoice::Light, ThemeChoice::Dark] {
            if ui.radio(model.options.theme == choice, theme(choice).text(model.language)).clicked() {
                messages.push(Message::SetTheme(choice));
            }
        }
    });
    items(ui, &[&[C::OPTIONS]], model, messages);
}

/// Groups of commands with lines between them.
fn items(ui: &mut Ui, groups: &[&[C]], model: &Model, messages: &mut Vec<Message>) {
    // A menu is as wide as its widest entry.
    ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
    for (index, group) in groups.iter().enumerate() {
        if index > 0 {
            ui.separator();
        }
        for command in *group {
            command_item(ui, *command, model, messages);
        }
    }
}
