//! What the window can do: one file or folder a feature, named as its command.
//!
//! A feature holds its form and its checks (without egui), what its main button does, what it does with results, and how
//! it is drawn. It declares its commands as constants of [`UiCommand`](C): their words, key, when they are disabled and what
//! they do. Its dialog implements [`Dialog`](crate::ui::model::Dialog). Here, it is named in `mod`, and its commands are
//! put into [`COMMANDS`] and into a menu.
//!
//! | feature | what |
//! |---|---|
//! | `add_controller`, `delete_controllers`, `connection_list` | the list of controllers |
//! | `server_control` | information, start and stop |
//! | `basic_settings`, `users`, `server_log`, `activation`, `settings_transfer` | the server's settings |
//! | `self_signed`, `create_csr`, `import_ca_signed`, `user_specified`, `restore_backup`, `export_self_signed`, `type_select` | the server's certificates |
//! | `subject_fields`, `certificate_import` | what some of these share |
//! | [`client_certificates`] | client certificates and CRLs |
//! | `certificate_authority`, `verify`, [`live_values`], [`remote_control`], [`recorder`] | tools |
//! | `backup`, `options`, [`vault`] | how this program works |
//! | `licences`, `about` | help |
//! | `dropped_files` | which dialog takes files dropped onto the window |
//! | `window` | commands of the window itself |

mod about;
pub mod activation;
pub mod add_controller;
pub mod backup;
pub mod basic_settings;
pub mod certificate_authority;
pub mod certificate_import;
pub mod client_certificates;
pub mod connection_list;
pub mod create_csr;
pub mod delete_controllers;
mod dropped_files;
pub mod export_self_signed;
pub mod import_ca_signed;
pub mod licences;
pub mod live_values;
mod options;
pub mod recorder;
pub mod remote_control;
pub mod restore_backup;
pub mod self_signed;
mod server_control;
pub mod server_log;
pub mod settings_transfer;
mod subject_fields;
pub mod type_select;
pub mod user_specified;
pub mod users;
pub mod vault;
pub mod verify;
mod window;

use super::model::UiCommand as C;

/// Every command, in the order in which the command palette and the list of keys show them.
pub const COMMANDS: &[C] = &[
    C::ADD_CONTROLLER,
    C::DELETE_CONTROLLERS,
    C::CONNECTION_LIST,
    C::CONFIRM_IDENTITY,
    C::QUIT,
    C::START,
    C::STOP,
    C::GET_INFO,
    C::BASIC_SETTINGS,
    C::USERS,
    C::SERVER_LOG,
    C::ACTIVATION,
    C::EXPORT_SETTINGS,
    C::IMPORT_SETTINGS,
    C::SELF_SIGNED,
    C::USER_SPECIFIED,
    C::CA_SIGNED,
    C::EXPORT_SELF_SIGNED,
    C::TYPE_SELECT,
    C::RESTORE_BACKUP,
    C::CLIENT_CERTIFICATES,
    C::CRL,
    C::BACKUP,
    C::OPTIONS,
    C::CERTIFICATE_AUTHORITY,
    C::VERIFY,
    C::LIVE_VALUES,
    C::RECORDER,
    C::OPEN_RECORDING,
    C::REMOTE_CONTROL,
    C::SHORTCUTS,
    C::LICENCES,
    C::ABOUT,
    C::TICK_ALL,
    C::SEARCH,
    C::ROW_DETAILS,
    C::COMMAND_PALETTE,
];

/// The entries of a menu, in groups with lines between them.
pub type MenuEntries = &'static [&'static [C]];

/// The menu "Controller".
pub const CONTROLLER_MENU: MenuEntries = &[
    &[C::ADD_CONTROLLER, C::CONNECTION_LIST],
    &[C::CONFIRM_IDENTITY, C::DELETE_CONTROLLERS],
    &[C::ROW_DETAILS],
    &[C::QUIT],
];
/// The entry "Create and save" on top of the menu "Certificate".
pub const CREATE_MENU: MenuEntries = &[&[C::SELF_SIGNED, C::USER_SPECIFIED, C::CA_SIGNED]];
/// The menu "Certificate" below that.
pub const CERTIFICATE_MENU: MenuEntries =
    &[&[C::EXPORT_SELF_SIGNED, C::TYPE_SELECT, C::RESTORE_BACKUP], &[C::CLIENT_CERTIFICATES, C::CRL]];
/// The menu "Server settings".
pub const SERVER_MENU: MenuEntries =
    &[&[C::BASIC_SETTINGS, C::USERS, C::SERVER_LOG, C::ACTIVATION], &[C::EXPORT_SETTINGS, C::IMPORT_SETTINGS]];
/// The menu "Tools".
pub const TOOLS_MENU: MenuEntries =
    &[&[C::CERTIFICATE_AUTHORITY, C::VERIFY], &[C::LIVE_VALUES, C::REMOTE_CONTROL], &[C::RECORDER, C::OPEN_RECORDING]];
/// The menu "Help".
pub const HELP_MENU: MenuEntries = &[&[C::COMMAND_PALETTE], &[C::SHORTCUTS, C::LICENCES, C::ABOUT]];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texts::TextKey as T;

    #[test]
    fn a_command_is_in_the_menu_it_names() {
        let menus: [(T, &[MenuEntries]); 6] = [
            (T::MenuController, &[CONTROLLER_MENU]),
            (T::MenuCertificate, &[CREATE_MENU, CERTIFICATE_MENU]),
            (T::MenuServer, &[SERVER_MENU]),
            (T::MenuOptions, &[&[&[C::BACKUP, C::OPTIONS]]]),
            (T::MenuTools, &[TOOLS_MENU]),
            (T::MenuHelp, &[HELP_MENU]),
        ];
        let placed = menus.iter().flat_map(|(menu, parts)| {
            parts.iter().copied().flatten().copied().flatten().map(move |command| (*command, Some(*menu)))
        });
        let placed: Vec<(C, Option<T>)> = placed.collect();
        for (command, menu) in &placed {
            assert_eq!(command.menu(), *menu, "{command:?}");
            assert!(COMMANDS.contains(command), "{command:?} is in no list of all commands");
        }
        for command in COMMANDS.iter().filter(|command| command.menu().is_some()) {
            assert_eq!(placed.iter().filter(|(other, _)| other == command).count(), 1, "{command:?}");
        }
    }

    #[test]
    fn no_two_commands_share_their_text_or_their_key() {
        for (at, command) in COMMANDS.iter().enumerate() {
            for other in &COMMANDS[at + 1..] {
                assert_ne!(command, other);
                assert!(
                    command.shortcut().is_none() || command.shortcut() != other.shortcut(),
                    "{command:?} {other:?}"
                );
            }
        }
    }
}
