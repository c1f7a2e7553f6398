//! The one place where the model changes.

use super::features::COMMANDS;
use super::model::{
    BackendCommand, BackendEvent, Column, JobId, Message, Model, PaletteAction, RowId, Targets, Task, UiCommand,
};
use super::shell::error::ErrorDialog;
use super::shell::processing::ProcessingDialog;
use crate::jobs::JobSummary;
use crate::model::ErrorCode;
use crate::texts;

/// Takes one message in; what comes out is for the backend.
pub fn reduce(model: &mut Model, message: Message) -> Vec<BackendCommand> {
    let mut commands = Vec::new();
    match message {
        Message::Invoke(command) if command.why_disabled(model).is_some() => {}
        Message::Invoke(command) => commands = command.invoke(model),
        Message::Toggle { row, range } => model.rows.toggle(row, range),
        Message::TickAll(on) => model.rows.tick_shown(on),
        Message::Sort(column) => model.sort(column),
        Message::Filter(text) => model.rows.set_filter(text),
        Message::MoveCursor(by) => model.rows.move_cursor(by),
        Message::ToggleCursor => model.rows.toggle_cursor(),
        Message::Revealed => model.rows.reveal = false,
        Message::Widths(columns) => {
            model.options.window.columns = columns;
            model.unsaved = true;
        }
        Message::Resized(size) => {
            model.options.window.size = Some(size);
            model.unsaved = true;
        }
        Message::MoveColumn { column, position } => model.move_column(column, position),
        Message::OpenRowMenu(Some(menu)) => {
            model.rows.set_cursor(menu.row);
            model.row_menu = Some(menu);
        }
        Message::OpenRowMenu(None) => model.open_menu_at_cursor(),
        Message::CloseRowMenu => model.row_menu = None,
        Message::InvokeFor { command, row } => commands = model.invoke_for(command, row),
        Message::OpenDetails(row) => {
            model.rows.set_cursor(row);
            model.show_details(true);
        }
        Message::CloseDetails => model.show_details(false),
        Message::DetailsWidth(width) => {
            model.options.window.details_width = Some(width);
            model.unsaved = true;
        }
        Message::ReadOverview(row) => commands = model.read_overview(row),
        Message::Palette(PaletteAction::Close) => model.command_palette = None,
        Message::Palette(action) => {
            let language = model.language;
            if let Some(palette) = &mut model.command_palette {
                palette.apply(action, language, COMMANDS);
            }
        }
        Message::Submit => {
            if let Some(dialog) = model.dialogs.pop() {
                commands = dialog.submit(model);
            }
        }
        Message::Close => {
            if let Some(dialog) = model.dialogs.pop() {
                commands = dialog.close(model);
            }
        }
        Message::Act(action) => commands = (action.0)(model),
        Message::ChooseFile => commands = model.choose_file(),
        Message::Browse(field) => commands = model.browse(field),
        Message::OpenFolder(folder) => commands.push(BackendCommand::OpenFolder(folder)),
        Message::Hovered(paths) => commands = model.hovered(paths),
        Message::Dropped(paths) => commands = model.drop_files(paths),
        Message::ReadFile => commands = model.read_typed(),
        Message::VerifyChanged => commands = model.verify_changed(),
        Message::KeepGoing => model.keep_going(),
        Message::EnterPasswords => model.ask_passwords(),
        Message::SetLanguage(language) => {
            model.language = language;
            model.options.language = Some(language);
            model.status = None;
            commands = model.save();
        }
        Message::SetTheme(theme) => {
            model.options.theme = theme;
            commands = model.save();
        }
        Message::SetParallelism(count) => {
            model.options.parallelism = count.clamp(1, crate::workspace::MAX_PARALLELISM);
            model.unsaved = true;
        }
        Message::SetVerifyAfterChanges(on) => {
            model.options.verify_after_changes = on;
            commands = model.save();
        }
        Message::StartVirtual => {
            if model.virtual_available && !model.virtual_starting {
                model.virtual_starting = true;
                commands.push(BackendCommand::StartVirtualControllers);
            }
        }
        Message::Closing(choice) => commands = model.choose_about_closing(choice),
        Message::Save => commands = model.save(),
        Message::Event(event) => commands = model.event(event),
    }
    commands
}

impl Model {
    /// Does a command for the row's menu. The ticks are as before afterwards.
    fn invoke_for(&mut self, command: UiCommand, row: RowId) -> Vec<BackendCommand> {
        match self.targets_of(row) {
            Targets::Ticked => reduce(self, Message::Invoke(command)),
            Targets::Row(row) => {
                let ticked = self.rows.tick_only(row);
                let commands = reduce(self, Message::Invoke(command));
                self.rows.restore_ticks(&ticked);
                commands
            }
        }
    }

    fn sort(&mut self, column: Column) {
        self.rows.sort_by(column);
        self.options.window.sort = self.rows.sort.map(|(column, ascending)| (column.key().to_owned(), ascending));
        self.unsaved = true;
    }

    fn event(&mut self, event: BackendEvent) -> Vec<BackendCommand> {
        match event {
            BackendEvent::Job { job, event } => self.job_event(job, event),
            BackendEvent::JobEnded { job, summary } => self.job_ended(job, summary),
            BackendEvent::Probed { job, result } => {
                self.probed(job, result);
                vec![]
            }
            BackendEvent::Enrolled { job, result } => self.enrolled(job, result),
            BackendEvent::FilePicked { job, result } => self.file_picked(job, result),
            BackendEvent::FileRead { job, result } => {
                self.file_read(job, result);
                vec![]
            }
            BackendEvent::FilesPicked { job, result } => self.trust_files_picked(job, result),
            BackendEvent::TrustFilesRead { job, files } => {
                self.trust_files_read(job, files);
                vec![]
            }
            BackendEvent::TrustSeen { job, event } => {
                self.trust_seen(job, event);
                vec![]
            }
            BackendEvent::LiveSeen { job, event } => self.live_seen(job, event),
            BackendEvent::RemoteSeen { job, event } => self.remote_seen(job, event),
            BackendEvent::TextSaved(result) => self.text_saved(result),
            BackendEvent::Recorder { job, event } => self.recorder_seen(job, event),
            BackendEvent::Recognised { job, files } => self.recognised(job, files),
            BackendEvent::ExportSeen { job, result } => {
                self.export_seen(job, result);
                vec![]
            }
            BackendEvent::AuthorityDone { job, result } => self.authority_done(job, result),
            BackendEvent::VirtualStarted(result) => self.virtual_started(result),
            BackendEvent::StopRequested => self.stop_requested(),
            BackendEvent::StartedAgain => vec![BackendCommand::ShowWindow],
            BackendEvent::VaultDone(result) => self.vault_done(result),
            BackendEvent::PasswordStore(store) => {
                self.store_changed(store);
                vec![]
            }
            BackendEvent::PasswordNotKept(problem) => {
                self.password_not_kept(problem);
                vec![]
            }
            BackendEvent::SaveFailed(problem) | BackendEvent::FolderNotOpened(problem) => {
                // Once is enough for the same trouble.
                let shown = self.dialog::<ErrorDialog>().is_some_and(|shown| shown.0.code == problem.code);
                if !shown {
                    self.show_problem(problem);
                }
                vec![]
            }
        }
    }

    fn job_ended(&mut self, id: JobId, summary: JobSummary) -> Vec<BackendCommand> {
        let Some(job) = self.job.as_mut().filter(|job| job.id == id) else { return vec![] };
        job.summary = Some(summary);
        let (task, failure) = (job.task.clone(), job.first_failed());
        let asks_passwords = task.asks_passwords && !job.without_password().is_empty();
        self.keep_open_after(summary);
        self.rows.rebuild();
        let mut commands = self.save();
        if asks_passwords {
            self.ask_passwords();
        } else if let Some(hook) = task.end_hook() {
            commands.extend(hook(self));
        } else if task.is_shown {
            commands.extend(self.processing_ended(&task, summary, failure));
        } else if let Some(problem) = self.job.take().and_then(|job| job.first_problem().cloned()) {
            task.close_waiting(self);
            self.show_problem(problem);
        }
        commands
    }

    fn processing_ended(&mut self, task: &Task, summary: JobSummary, failure: Option<usize>) -> Vec<BackendCommand> {
        let all_done = summary.failed == 0 && summary.not_started == 0;
        let alone = self.is_only::<ProcessingDialog>();
        if all_done && alone && self.options.verify_after_changes && !self.changed_servers().is_empty() {
            return self.verify_changed();
        }
        if all_done && task.is_quiet {
            self.status = Some(texts::job_done(self.language, task.title, summary.done));
            self.end_processing();
        } else if let Some(view) = self.dialog::<ProcessingDialog>() {
            view.selected = view.selected.or(failure);
        }
        vec![]
    }

    /// Asks for the passphrase of a vault that was found closed, or else for the passwords that the job lacked.
    pub(super) fn ask_passwords(&mut self) {
        let Some(job) = self.job.as_ref().filter(|job| job.summary.is_some()) else { return };
        let failed = |code: ErrorCode| job.rows.iter().any(|row| row.state.problem().is_some_and(|p| p.code == code));
        if failed(ErrorCode::VaultLocked) {
            let (rows, task) = (job.without_password(), job.task.clone());
            return self.ask_vault_for(rows, task);
        }
        self.ask_connection_passwords();
    }
}
