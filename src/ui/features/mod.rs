//! What the window can do: one file or folder a feature, named as its command.
//!
//! A feature holds its form and its checks (without egui), what its main button does, what it does with results, and how
//! it is drawn. Its dialog implements [`Dialog`](crate::ui::model::Dialog). It is registered here, in
//! [`UiCommand::why_disabled`] and `Model::invoke`; its words, tooltip and key are in [`UiCommand`], its place in a
//! menu in `views/main_menu.rs`.
//!
//! | feature | what |
//! |---|---|
//! | `add_controller`, `delete_controllers`, `connection_list` | the list of controllers |
//! | `server_control` | information, start and stop |
//! | `settings`, `users`, `server_log`, `activation`, `settings_transfer` | the server's settings |
//! | `self_signed`, `certificate_import`, `export_self_signed`, `select_certificate` | the server's certificates |
//! | [`trust`] | client certificates and CRLs |
//! | `certificate_authority`, `verify` | tools |
//! | `backup`, `options`, [`vault`] | how this program works |
//! | `licences`, `about` | help |
//! | `dropped_files` | which dialog takes files dropped onto the window |

mod about;
pub mod activation;
pub mod add_controller;
pub mod backup;
pub mod certificate_authority;
pub mod certificate_import;
pub mod connection_list;
pub mod delete_controllers;
mod dropped_files;
pub mod export_self_signed;
pub mod licences;
mod options;
pub mod select_certificate;
pub mod self_signed;
mod server_control;
pub mod server_log;
pub mod settings;
pub mod settings_transfer;
pub mod trust;
pub mod users;
pub mod vault;
pub mod verify;

use about::{AboutDialog, ShortcutsDialog};
use activation::ActivationForm;
use add_controller::AddController;
use backup::BackupDialog;
use delete_controllers::DeleteControllers;
use export_self_signed::ExportForm;
use licences::LicencesView;
use options::OptionsDialog;
use settings_transfer::Transfer;
use trust::Shows;

use super::command::UiCommand;
use super::model::{Command, CommandPalette, Model, Targets};
use crate::model::Feature;
use crate::texts::TextKey as T;

impl UiCommand {
    /// Why it cannot be done to the ticked controllers now; what a disabled item says on hover.
    pub fn why_disabled(self, model: &Model) -> Option<T> {
        self.why_disabled_for(model, Targets::Ticked)
    }

    /// Why it cannot be done to these controllers now.
    pub fn why_disabled_for(self, model: &Model, targets: Targets) -> Option<T> {
        let count = model.target_count(targets);
        match self {
            Self::DeleteControllers
            | Self::Start
            | Self::Stop
            | Self::GetInfo
            | Self::BasicSettings
            | Self::Users
            | Self::SelfSigned
            | Self::CaSigned
            | Self::ExportSelfSigned
            | Self::TypeSelect
            | Self::ClientLists
            | Self::Crl
            | Self::Verify => (count == 0).then_some(T::WhyTick),
            Self::UserSpecified => match count {
                0 => Some(T::WhyTick),
                1 => model.any_target_lacks(targets, Feature::UserSpecifiedCertificate).then_some(T::WhyUserLegacy),
                _ => Some(T::WhyUserOne),
            },
            Self::ConfirmIdentity if count == 0 => Some(T::WhyTick),
            Self::ConfirmIdentity => model.all_targets_are_confirmed(targets).then_some(T::WhyConfirmed),
            Self::Activation if count == 0 => Some(T::WhyTick),
            Self::Activation => {
                model.any_target_lacks(targets, Feature::ActivationKeys).then_some(T::WhyActivationOption)
            }
            Self::ExportSettings | Self::ImportSettings => match count {
                0 => Some(T::WhyTick),
                _ => model.any_target_lacks(targets, Feature::SettingsTransfer).then_some(T::WhyLegacyOnly),
            },
            Self::RestoreBackup => match count {
                0 => Some(T::WhyTick),
                _ => model.any_target_lacks(targets, Feature::KeyImport).then_some(T::WhyLegacyOnly),
            },
            Self::ServerLog => match count {
                0 => Some(T::WhyTick),
                1 => None,
                _ => Some(T::WhyOne),
            },
            Self::TickAll | Self::Search | Self::RowDetails => model.rows.is_empty().then_some(T::WhyEmpty),
            Self::AddController
            | Self::ConnectionList
            | Self::Quit
            | Self::Backup
            | Self::Options
            | Self::CertificateAuthority
            | Self::Shortcuts
            | Self::Licences
            | Self::About
            | Self::CommandPalette => None,
        }
    }
}

impl Model {
    /// Does a command: opens its dialog, or starts its job. The command is not disabled.
    pub(super) fn invoke(&mut self, command: UiCommand) -> Vec<Command> {
        let ticked = self.rows.ticked();
        match command {
            UiCommand::Start => return self.plan(server_control::start_server(), ticked),
            UiCommand::Stop => return self.plan(server_control::stop_server(), ticked),
            UiCommand::GetInfo => return self.get_info(ticked),
            UiCommand::BasicSettings => return self.open_settings(ticked),
            UiCommand::Users => return self.open_users(ticked),
            UiCommand::SelfSigned => return self.open_self_signed(ticked, None),
            UiCommand::CaSigned => self.open_ca_signed(ticked),
            UiCommand::UserSpecified => self.open_user_specified(&ticked),
            UiCommand::RestoreBackup => self.open_restore(ticked),
            UiCommand::TypeSelect => return self.open_type_select(ticked),
            UiCommand::ClientLists => return self.open_trust(Shows::Clients, ticked),
            UiCommand::Crl => return self.open_trust(Shows::Crls, ticked),
            UiCommand::ExportSettings => return self.open_transfer(Transfer::Export, ticked),
            UiCommand::ImportSettings => return self.open_transfer(Transfer::Import, ticked),
            UiCommand::ServerLog => return ticked.first().map(|row| self.open_log(*row)).unwrap_or_default(),
            UiCommand::Verify => return self.verify(ticked),
            UiCommand::CertificateAuthority => return self.open_authority(),
            UiCommand::ConnectionList => return self.open_connection_list(),
            UiCommand::ConfirmIdentity => {
                let rows = self.ticked_unconfirmed().collect();
                return self.confirm_identities(rows, vec![]);
            }
            UiCommand::Activation => self.open(ActivationForm::new(ticked, self)),
            UiCommand::AddController => self.open(AddController::new()),
            UiCommand::DeleteControllers => self.open(DeleteControllers::new(ticked, self)),
            UiCommand::ExportSelfSigned => self.open(ExportForm::new(ticked, self)),
            UiCommand::Backup => self.open(BackupDialog { on: self.options.backup }),
            UiCommand::Options => self.open(OptionsDialog),
            UiCommand::Shortcuts => self.open(ShortcutsDialog),
            UiCommand::Licences => self.open(LicencesView::default()),
            UiCommand::About => self.open(AboutDialog),
            UiCommand::CommandPalette => self.command_palette = Some(CommandPalette::default()),
            UiCommand::RowDetails => self.show_details(!self.options.window.details),
            UiCommand::Quit => return vec![Command::Quit],
            UiCommand::TickAll => self.rows.tick_shown(!self.rows.all_shown_ticked()),
            // The search field of the toolbar takes the keyboard, which only the window can give it.
            UiCommand::Search => {}
        }
        vec![]
    }
}
