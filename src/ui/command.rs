//! What an engineer can ask the window to do. Menus, buttons and keys all read this one enum.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::model::Language;
use crate::texts::TextKey as T;

/// An action of the main window.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum UiCommand {
    AddController,
    DeleteControllers,
    ConnectionList,
    ConfirmIdentity,
    Quit,
    Start,
    Stop,
    GetInfo,
    BasicSettings,
    Users,
    ServerLog,
    Activation,
    ExportSettings,
    ImportSettings,
    SelfSigned,
    UserSpecified,
    CaSigned,
    ExportSelfSigned,
    TypeSelect,
    RestoreBackup,
    ClientLists,
    Crl,
    Backup,
    Options,
    CertificateAuthority,
    Verify,
    Shortcuts,
    Licences,
    About,
    TickAll,
    Search,
    RowDetails,
    CommandPalette,
}

impl UiCommand {
    pub const ALL: [Self; 33] = [
        Self::AddController,
        Self::DeleteControllers,
        Self::ConnectionList,
        Self::ConfirmIdentity,
        Self::Quit,
        Self::Start,
        Self::Stop,
        Self::GetInfo,
        Self::BasicSettings,
        Self::Users,
        Self::ServerLog,
        Self::Activation,
        Self::ExportSettings,
        Self::ImportSettings,
        Self::SelfSigned,
        Self::UserSpecified,
        Self::CaSigned,
        Self::ExportSelfSigned,
        Self::TypeSelect,
        Self::RestoreBackup,
        Self::ClientLists,
        Self::Crl,
        Self::Backup,
        Self::Options,
        Self::CertificateAuthority,
        Self::Verify,
        Self::Shortcuts,
        Self::Licences,
        Self::About,
        Self::TickAll,
        Self::Search,
        Self::RowDetails,
        Self::CommandPalette,
    ];

    pub const fn text(self) -> T {
        self.text_and_tooltip().0
    }

    pub const fn tooltip(self) -> T {
        self.text_and_tooltip().1
    }

    const fn text_and_tooltip(self) -> (T, T) {
        match self {
            Self::AddController => (T::AddController, T::AddControllerTip),
            Self::DeleteControllers => (T::DeleteControllers, T::DeleteControllersTip),
            Self::ConnectionList => (T::ConnectionList, T::ConnectionListTip),
            Self::ConfirmIdentity => (T::ConfirmIdentity, T::ConfirmIdentityTip),
            Self::Quit => (T::Quit, T::QuitTip),
            Self::Start => (T::Start, T::StartTip),
            Self::Stop => (T::Stop, T::StopTip),
            Self::GetInfo => (T::GetInfo, T::GetInfoTip),
            Self::BasicSettings => (T::BasicSettings, T::BasicSettingsTip),
            Self::Users => (T::Users, T::UsersTip),
            Self::ServerLog => (T::ServerLogCommand, T::ServerLogTip),
            Self::Activation => (T::Activation, T::ActivationTip),
            Self::ExportSettings => (T::ExportSettings, T::ExportSettingsTip),
            Self::ImportSettings => (T::ImportSettings, T::ImportSettingsTip),
            Self::SelfSigned => (T::SelfSigned, T::SelfSignedTip),
            Self::UserSpecified => (T::UserSpecified, T::UserSpecifiedTip),
            Self::CaSigned => (T::CaSigned, T::CaSignedTip),
            Self::ExportSelfSigned => (T::ExportSelfSigned, T::ExportSelfSignedTip),
            Self::TypeSelect => (T::TypeSelect, T::TypeSelectTip),
            Self::RestoreBackup => (T::RestoreBackup, T::RestoreBackupTip),
            Self::ClientLists => (T::ClientLists, T::ClientListsTip),
            Self::Crl => (T::Crl, T::CrlTip),
            Self::Backup => (T::Backup, T::BackupTip),
            Self::Options => (T::Options, T::OptionsTip),
            Self::CertificateAuthority => (T::CertificateAuthority, T::CertificateAuthorityTip),
            Self::Verify => (T::Verify, T::VerifyTip),
            Self::Shortcuts => (T::Shortcuts, T::ShortcutsTip),
            Self::Licences => (T::Licences, T::LicencesTip),
            Self::About => (T::About, T::AboutTip),
            Self::TickAll => (T::TickAll, T::TickAllTip),
            Self::Search => (T::Search, T::SearchTip),
            Self::RowDetails => (T::RowDetails, T::RowDetailsTip),
            Self::CommandPalette => (T::CommandPalette, T::CommandPaletteTip),
        }
    }

    /// The menu it is in; `None` for what is not in a menu.
    pub const fn menu(self) -> Option<T> {
        Some(match self {
            Self::AddController
            | Self::DeleteControllers
            | Self::ConnectionList
            | Self::ConfirmIdentity
            | Self::RowDetails
            | Self::Quit => T::MenuController,
            Self::SelfSigned
            | Self::UserSpecified
            | Self::CaSigned
            | Self::ExportSelfSigned
            | Self::TypeSelect
            | Self::RestoreBackup
            | Self::ClientLists
            | Self::Crl => T::MenuCertificate,
            Self::BasicSettings
            | Self::Users
            | Self::ServerLog
            | Self::Activation
            | Self::ExportSettings
            | Self::ImportSettings => T::MenuServer,
            Self::Backup | Self::Options => T::MenuOptions,
            Self::CertificateAuthority | Self::Verify => T::MenuTools,
            Self::Shortcuts | Self::Licences | Self::About | Self::CommandPalette => T::MenuHelp,
            Self::Start | Self::Stop | Self::GetInfo | Self::TickAll | Self::Search => return None,
        })
    }

    /// Its name with the menu it is in: "Server settings: Users…".
    pub fn full_name(self, language: Language) -> String {
        let name = self.text().text(language);
        self.menu().map_or_else(|| name.to_owned(), |menu| format!("{}: {name}", menu.text(language)))
    }

    pub const fn shortcut(self) -> Option<KeyboardShortcut> {
        let (modifiers, key) = match self {
            Self::AddController => (Modifiers::COMMAND, Key::N),
            Self::DeleteControllers => (Modifiers::NONE, Key::Delete),
            Self::Quit => (Modifiers::COMMAND, Key::Q),
            Self::GetInfo => (Modifiers::NONE, Key::F5),
            Self::BasicSettings => (Modifiers::COMMAND, Key::B),
            Self::Users => (Modifiers::COMMAND, Key::U),
            Self::Shortcuts => (Modifiers::NONE, Key::F1),
            Self::TickAll => (Modifiers::COMMAND, Key::A),
            Self::Search => (Modifiers::COMMAND, Key::F),
            Self::RowDetails => (Modifiers::COMMAND, Key::D),
            Self::CommandPalette => (Modifiers::COMMAND, Key::K),
            _ => return None,
        };
        Some(KeyboardShortcut::new(modifiers, key))
    }
}
