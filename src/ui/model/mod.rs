//! What the window knows. No egui type, no I/O: a [`Message`] goes in, [`Command`](super::backend::Command)s come out.

mod activation;
mod authority;
mod certificates;
mod columns;
mod command_palette;
mod connections;
mod details;
mod dialog;
mod dropped;
mod files;
mod forms;
mod identity;
mod import;
mod job;
mod licences;
mod reduce;
mod reduce_dialogs;
mod row_menu;
mod rows;
mod server_log;
mod task;
mod transfer;
pub mod trust;
mod vault;
mod verify;

#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::path::PathBuf;

use chrono::{DateTime, Utc};

pub use activation::{ActivationForm, ActivationPreview, KeysForm, key_error};
pub use authority::{
    AuthorityAction, AuthorityForm, AuthorityView, CreateAuthorityForm, SignControllersForm, SignFileForm,
};
pub use certificates::{ExportForm, Held, TypeSelectForm};
pub use command_palette::{CommandPalette, PaletteAction};
pub use connections::{ConnectionListForm, FoundConnection, LeftOut};
pub use details::{LastResult, OverviewRead};
pub use dialog::{
    AddController, AddStage, AddUserForm, Dialog, Identity, PasswordForm, ProcessingView, SelfSignedForm, SettingsForm,
    Typed, UsersForm,
};
pub use dropped::{Choice, DropForm, DroppedFile, Hover, MAX_DROPPED};
pub use files::{FileForm, PathField};
pub use import::{CaSignedForm, Checks, ImportReview, ImportSource, RestoreForm, UserFiles, UserSpecifiedForm};
pub use job::{CancelState, Job, JobId, JobRow, RowState};
pub use licences::LicencesView;
pub use reduce::reduce;
pub use row_menu::{RowMenu, Targets};
pub use rows::{Column, EXPIRES_SOON, Expiry, Row, RowId, Rows};
pub use server_log::{LogView, SaveLogForm};
pub use task::{Task, TaskEvent, TaskFacts, TaskReport};
pub use transfer::{ExportFound, Preview, Transfer, TransferForm};
pub use vault::{VaultAction, VaultForm, VaultRequest};
pub use verify::VerifyView;

use super::backend::Event;
use super::closing::{CloseChoice, Closing};
use super::command::UiCommand;
use crate::model::{Language, Problem};
use crate::texts::Zone;
use crate::workspace::{Configuration, Options, StoreStatus, ThemeChoice, Workspace};
use trust::TrustAction;

/// Everything the views draw from.
#[derive(Debug)]
pub struct Model {
    pub language: Language,
    /// The time of this frame.
    pub now: DateTime<Utc>,
    pub zone: Zone,
    pub rows: Rows,
    pub options: Options,
    pub workspace: Workspace,
    /// The last one is on top and has the keyboard.
    pub dialogs: Vec<Dialog>,
    /// The job that runs, or the one whose summary is shown.
    pub job: Option<Job>,
    /// The context menu of a row.
    pub row_menu: Option<RowMenu>,
    pub command_palette: Option<CommandPalette>,
    /// The window is to be closed while work goes on.
    pub closing: Option<Closing>,
    /// What the status bar says until the next thing happens.
    pub status: Option<String>,
    /// Files held over the window.
    pub hover: Option<Hover>,
    pub virtual_available: bool,
    pub virtual_starting: bool,
    /// What the store of connection passwords is like; `None` where there is none, as in the demo.
    pub store: Option<StoreStatus>,
    /// Why a password that was entered is known only until the window is closed.
    pub not_kept: Option<Problem>,
    /// Something the window remembers has changed since it was last saved.
    pub unsaved: bool,
    last_job: u64,
    /// Files that were dropped are looked at.
    dropping: Option<JobId>,
    /// The desktop's dialog finds a file for this field.
    browsing: Option<(JobId, PathField)>,
}

/// What the small CA can be asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AuthorityCommand {
    Create,
    Restore,
    SignControllers,
    SignFile,
    Revoke,
    PublishCrl,
    BackUp,
}

/// What can happen: an engineer did something, or the backend reports.
#[derive(Debug)]
pub enum Message {
    Invoke(UiCommand),
    // table
    Toggle {
        row: RowId,
        range: bool,
    },
    TickAll(bool),
    Sort(Column),
    Filter(String),
    /// By rows of the view; clamped.
    MoveCursor(isize),
    ToggleCursor,
    /// The table has scrolled to the cursor.
    Revealed,
    Widths(BTreeMap<String, f32>),
    Resized((f32, f32)),
    /// Put a column before the one at this position.
    MoveColumn {
        column: Column,
        position: usize,
    },
    /// Open the context menu; `None`: of the row under the cursor.
    OpenRowMenu(Option<RowMenu>),
    CloseRowMenu,
    /// A command of the context menu of this row.
    InvokeFor {
        command: UiCommand,
        row: RowId,
    },
    /// Show the details of this row.
    OpenDetails(RowId),
    CloseDetails,
    DetailsWidth(f32),
    /// Read settings and lists of this row's controller for its details.
    ReadOverview(RowId),
    Palette(PaletteAction),
    // dialogs
    /// The main button of the dialog on top.
    Submit,
    /// Cancel, Close or Esc.
    Close,
    /// Delete the ticked users of the dialog on top.
    DeleteUsers,
    /// Open the dialog for one more user.
    NewUser,
    /// Let the desktop's dialog find the file the dialog on top asks for.
    ChooseFile,
    /// Let the desktop's dialog find the file for a field of the dialog on top.
    Browse(PathField),
    /// Show a folder in the desktop's file manager.
    OpenFolder(PathBuf),
    /// These files are held over the window.
    Hovered(Vec<PathBuf>),
    /// These files were dropped onto the window.
    Dropped(Vec<PathBuf>),
    /// Read the file whose path is typed into the dialog on top.
    ReadFile,
    /// Put the controller into the list that cannot be reached now.
    AddUnconfirmed,
    /// About the vault for connection passwords.
    Vault(VaultRequest),
    /// Leave the controller out whose identity is asked for.
    SkipIdentity,
    /// Open the dialog for a certificate signing request.
    NewCsr,
    /// Read the server log again.
    RefreshLog,
    /// Verify the servers that run anew after the ended job.
    VerifyChanged,
    /// Put this program's certificate into the trusted lists that lack it.
    TrustConfigurator,
    /// Delete the server log that is shown.
    DeleteLog,
    /// Ask where the server log that is shown is to be saved.
    SaveLog,
    /// About client certificates and CRLs.
    Trust(TrustAction),
    /// Open the dialog for something the small CA is to do.
    Authority(AuthorityCommand),
    /// Go on with the job after all.
    KeepGoing,
    /// Ask for the passwords the ended job lacked.
    EnterPasswords,
    SetLanguage(Language),
    SetTheme(ThemeChoice),
    SetParallelism(usize),
    SetVerifyAfterChanges(bool),
    StartVirtual,
    Closing(CloseChoice),
    Save,
    Event(Event),
}

impl Model {
    pub fn new(configuration: Configuration, workspace: Workspace, language: Language, now: DateTime<Utc>) -> Self {
        let mut rows = Rows::new(configuration.controllers, now);
        if let Some((key, ascending)) = &configuration.options.window.sort
            && let Some(column) = Column::from_key(key)
        {
            rows.sort = Some((column, *ascending));
            rows.rebuild();
        }
        Self {
            language: configuration.options.language.unwrap_or(language),
            now,
            zone: Zone::default(),
            rows,
            options: configuration.options,
            workspace,
            dialogs: Vec::new(),
            job: None,
            row_menu: None,
            command_palette: None,
            closing: None,
            status: None,
            hover: None,
            virtual_available: false,
            virtual_starting: false,
            store: None,
            not_kept: None,
            unsaved: false,
            last_job: 0,
            dropping: None,
            browsing: None,
        }
    }

    /// What is saved of it all.
    pub fn configuration(&self) -> Configuration {
        let mut configuration = Configuration::default();
        configuration.controllers = self.rows.all().iter().map(|row| row.entry.clone()).collect();
        configuration.options = self.options.clone();
        configuration
    }

    /// Shows a failure on top of whatever is shown.
    pub fn show_problem(&mut self, problem: Problem) {
        self.dialogs.push(Dialog::Error(problem));
    }

    /// Moves the window's clock.
    pub fn set_now(&mut self, now: DateTime<Utc>) {
        self.now = now;
        self.rows.refresh_expiry(now);
        if let Some(form) = self.trust() {
            form.refresh(now);
        }
    }

    fn next_job(&mut self) -> JobId {
        self.last_job += 1;
        JobId(self.last_job)
    }
}
