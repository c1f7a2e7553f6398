//! What the window knows: the list of controllers, the running job, the open dialogs.
//!
//! A [`Message`] goes in, [`BackendCommand`]s for the backend come out. Nothing here knows the features, does I/O or
//! draws.

mod closing;
mod columns;
mod command;
mod command_palette;
mod details;
mod dialog;
mod dropped;
mod file_form;
mod files;
mod job;
mod job_id;
mod row_facts;
mod row_menu;
mod row_state;
mod rows;
mod secret;
mod task;
mod ui_command;

use std::collections::BTreeMap;
use std::fmt;
use std::path::PathBuf;

use chrono::{DateTime, Utc};

use crate::model::{Language, Problem};
use crate::texts::Zone;
use crate::workspace::{Configuration, Options, StoreStatus, ThemeChoice, Workspace};

pub use closing::{CloseChoice, Closing};
pub use command::{
    AuthorityResult, AuthorityWork, BackendCommand, BackendEvent, ExportFound, FileContents, ReadTrustFile,
    RecorderEvent, RecorderWork, VaultWork,
};
pub use command_palette::{CommandPalette, PaletteAction};
pub use dialog::{Dialog, DialogAnswer, DialogPlace};
pub use dropped::{DropChoice, DropForm, DroppedFile, HoveringFiles, MAX_DROPPED};
pub use file_form::{BrowseField, BrowseFor, FileForm};
pub use files::first_path;
pub use job::{CancelState, Job, JobRow};
pub use job_id::JobId;
pub use row_facts::{LastResult, OverviewRead};
pub use row_menu::{RowMenu, Targets};
pub use row_state::RowState;
pub use rows::{Column, EXPIRES_SOON, Expiry, Row, RowId, Rows};
pub use secret::SecretInput;
pub use task::{Task, TaskEvent, TaskFacts, TaskReport};
pub use ui_command::UiCommand;

/// What a change of the model asks the backend for.
pub type Commands = Vec<BackendCommand>;

/// Draws what a feature adds to the processing dialog after the end of its job.
pub type Footer = fn(&mut egui::Ui, &Job, &Model, &mut Vec<Message>);

/// Everything the views draw from.
#[derive(Debug)]
pub struct Model {
    /// Language of every text of the window.
    pub language: Language,
    /// The time of this frame.
    pub now: DateTime<Utc>,
    /// The time zone that times are shown in.
    pub zone: Zone,
    /// The table.
    pub rows: Rows,
    /// What is chosen in the dialogs "Options" and "Backup", and the sizes of the window.
    pub options: Options,
    /// The folder with the list and the files of the controllers.
    pub workspace: Workspace,
    /// The last one is on top and has the keyboard.
    pub dialogs: Vec<Box<dyn Dialog>>,
    /// Dialogs that were closed while their work goes on.
    hidden: Vec<Box<dyn Dialog>>,
    /// The job that runs, or the one whose summary is shown.
    pub job: Option<Job>,
    /// The context menu of a row.
    pub row_menu: Option<RowMenu>,
    /// The command palette, while it is open.
    pub command_palette: Option<CommandPalette>,
    /// The window is to be closed while work goes on.
    pub closing: Option<Closing>,
    /// What the status bar says until the next thing happens.
    pub status: Option<String>,
    /// Files held over the window.
    pub hover: Option<HoveringFiles>,
    /// Whether this program can start virtual controllers.
    pub virtual_available: bool,
    /// Whether they are being started.
    pub virtual_starting: bool,
    /// What the store of connection passwords is like; `None` where there is none, as in the demo.
    pub store: Option<StoreStatus>,
    /// Why a password that was entered is known only until the window is closed.
    pub not_kept: Option<Problem>,
    /// Something the window remembers has changed since it was last saved.
    pub unsaved: bool,
    pub(in crate::ui) last_job: u64,
    /// Files that were dropped are looked at.
    pub(in crate::ui) dropping: Option<JobId>,
    /// The desktop's dialog finds a file for this field.
    browsing: Option<(JobId, BrowseField)>,
}

/// What can happen: an engineer did something, or the backend reports.
#[derive(Debug)]
pub enum Message {
    /// A command was chosen in a menu, by its button or its key.
    Invoke(UiCommand),
    // table
    /// A row was ticked or unticked.
    Toggle {
        /// The row.
        row: RowId,
        /// With Shift: also every row between it and the one ticked before.
        range: bool,
    },
    /// Every row shown is to be ticked, or unticked.
    TickAll(bool),
    /// The heading of a column was clicked.
    Sort(Column),
    /// The filter of the table was edited.
    Filter(String),
    /// By rows of the view; clamped.
    MoveCursor(isize),
    /// Space was pressed: the row under the cursor is ticked or unticked.
    ToggleCursor,
    /// The table has scrolled to the cursor.
    Revealed,
    /// Columns have these widths in points, by their keys.
    Widths(BTreeMap<String, f32>),
    /// The window has this inner size in points.
    Resized((f32, f32)),
    /// Put a column before the one at this position.
    MoveColumn {
        /// The column.
        column: Column,
        /// Its new position from the left, counted from 0.
        position: usize,
    },
    /// Open the context menu; `None`: of the row under the cursor.
    OpenRowMenu(Option<RowMenu>),
    /// The context menu is to be closed.
    CloseRowMenu,
    /// A command of the context menu of this row.
    InvokeFor {
        /// The command.
        command: UiCommand,
        /// The row whose menu it was.
        row: RowId,
    },
    /// Show the details of this row.
    OpenDetails(RowId),
    /// The details pane is to be closed.
    CloseDetails,
    /// The details pane has this width in points.
    DetailsWidth(f32),
    /// Read settings and lists of this row's controller for its details.
    ReadOverview(RowId),
    /// Something was done in the command palette.
    Palette(PaletteAction),
    // dialogs
    /// The main button of the dialog on top.
    Submit,
    /// Cancel, Close or Esc.
    Close,
    /// Something that one dialog offers.
    Act(ExtraAction),
    /// Let the desktop's dialog find the file the dialog on top asks for.
    ChooseFile,
    /// Let the desktop's dialog find the file for a field of the dialog on top.
    Browse(BrowseField),
    /// Show a folder in the desktop's file manager.
    OpenFolder(PathBuf),
    /// These files are held over the window.
    Hovered(Vec<PathBuf>),
    /// These files were dropped onto the window.
    Dropped(Vec<PathBuf>),
    /// Read the file whose path is typed into the dialog on top.
    ReadFile,
    /// Verify the servers that run anew after the ended job.
    VerifyChanged,
    /// Go on with the job after all.
    KeepGoing,
    /// Ask for the passwords the ended job lacked.
    EnterPasswords,
    /// Another language was chosen.
    SetLanguage(Language),
    /// Other colours were chosen.
    SetTheme(ThemeChoice),
    /// How many controllers jobs work on at once was chosen.
    SetParallelism(usize),
    /// Verifying after changes was switched on or off.
    SetVerifyAfterChanges(bool),
    /// Virtual controllers are to be started.
    StartVirtual,
    /// The question about closing was answered.
    Closing(CloseChoice),
    /// The configuration is to be saved, if it has changed.
    Save,
    /// The backend reports something.
    Event(BackendEvent),
}

impl Message {
    /// An action of one dialog: a function of its feature.
    pub fn act(action: impl FnOnce(&mut Model) -> Vec<BackendCommand> + 'static) -> Self {
        Self::Act(ExtraAction(Box::new(action)))
    }
}

/// What a dialog offers besides its main button and Close.
pub struct ExtraAction(pub(in crate::ui) Act);

type Act = Box<dyn FnOnce(&mut Model) -> Commands>;

impl fmt::Debug for ExtraAction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Action(…)")
    }
}

impl Model {
    /// The model of a window that was just opened. `now`: the time by this PC's clock.
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
            hidden: Vec::new(),
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

    /// Moves the window's clock.
    pub fn set_now(&mut self, now: DateTime<Utc>) {
        self.now = now;
        self.rows.refresh_expiry(now);
        self.dialogs.iter_mut().for_each(|dialog| dialog.refresh(now));
    }

    /// Asks the backend to save what the window remembers.
    pub(in crate::ui) fn save(&mut self) -> Vec<BackendCommand> {
        self.unsaved = false;
        vec![BackendCommand::Save(Box::new(self.configuration()))]
    }

    pub(in crate::ui) fn next_job(&mut self) -> JobId {
        self.last_job += 1;
        JobId(self.last_job)
    }
}
