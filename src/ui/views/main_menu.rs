use egui::{MenuBar, TextWrapMode, Ui};

use crate::model::Language;
use crate::texts::{TextKey as T, theme};
use crate::ui::command::UiCommand as C;
use crate::ui::model::{Message, Model};
use crate::ui::widgets::command_item;
use crate::workspace::ThemeChoice;

/// Below "Create and save" in the menu of certificates.
pub(super) const CREATE: &[C] = &[C::SelfSigned, C::UserSpecified, C::CaSigned];
pub(super) const CERTIFICATE: &[C] = &[C::ExportSelfSigned, C::TypeSelect, C::RestoreBackup];
pub(super) const CLIENT_LISTS: &[C] = &[C::ClientLists, C::Crl];
pub(super) const SERVER: &[C] = &[C::BasicSettings, C::Users, C::ServerLog, C::Activation];
pub(super) const SERVER_FILES: &[C] = &[C::ExportSettings, C::ImportSettings];

pub fn show(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let menu = |ui: &mut Ui, title: T, groups: &[&[C]], messages: &mut Vec<Message>| {
        ui.menu_button(text(title), |ui| items(ui, groups, model, messages));
    };
    MenuBar::new().ui(ui, |ui| {
        menu(
            ui,
            T::MenuController,
            &[
                &[C::AddController, C::ConnectionList],
                &[C::ConfirmIdentity, C::DeleteControllers],
                &[C::RowDetails],
                &[C::Quit],
            ],
            messages,
        );
        ui.menu_button(text(T::MenuCertificate), |ui| {
            ui.menu_button(text(T::MenuCreate), |ui| {
                items(ui, &[CREATE], model, messages);
            });
            items(ui, &[CERTIFICATE, CLIENT_LISTS], model, messages);
        });
        menu(ui, T::MenuServer, &[SERVER, SERVER_FILES], messages);
        ui.menu_button(text(T::MenuOptions), |ui| options(ui, model, messages));
        menu(ui, T::MenuTools, &[&[C::CertificateAuthority, C::Verify]], messages);
        menu(ui, T::MenuHelp, &[&[C::CommandPalette], &[C::Shortcuts, C::Licences, C::About]], messages);
    });
}

fn options(ui: &mut Ui, model: &Model, messages: &mut Vec<Message>) {
    items(ui, &[&[C::Backup]], model, messages);
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
    items(ui, &[&[C::Options]], model, messages);
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
