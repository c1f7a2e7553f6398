//! The one place where the model changes.

use super::trust::Shows;
use super::{
    ActivationForm, AddController, CancelState, Column, CommandPalette, Dialog, ExportForm, Job, JobId, JobRow,
    LastResult, LicencesView, Message, Model, PaletteAction, PasswordForm, ProcessingView, RowId, RowState, Task,
    TaskEvent, Transfer, Typed,
};
use crate::jobs::{self, JobController, Summary};
use crate::model::{ErrorCode, FileFormat};
use crate::texts::{self, TextKey as T};
use crate::ui::backend::{Command, Event};
use crate::ui::command::UiCommand;

/// Takes one message in; what comes out is for the backend.
pub fn reduce(model: &mut Model, message: Message) -> Vec<Command> {
    let mut commands = Vec::new();
    match message {
        Message::Invoke(command) if command.why_disabled(model).is_some() => {}
        Message::Invoke(command) => commands = model.invoke(command),
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
                palette.apply(action, language);
            }
        }
        Message::Submit => commands = model.submit(),
        Message::Close => commands = model.close(),
        Message::DeleteUsers => commands = model.delete_users(),
        Message::NewUser => model.new_user(),
        Message::ChooseFile => commands = model.choose_file(),
        Message::Browse(field) => commands = model.browse(field),
        Message::OpenFolder(folder) => commands.push(Command::OpenFolder(folder)),
        Message::Hovered(paths) => commands = model.hovered(paths),
        Message::Dropped(paths) => commands = model.drop_files(paths),
        Message::ReadFile => commands = model.read_typed(),
        Message::AddUnconfirmed => commands = model.add_unconfirmed(),
        Message::Vault(request) => commands = model.vault_request(request),
        Message::SkipIdentity => commands = model.skip_identity(),
        Message::NewCsr => commands = model.new_csr(),
        Message::RefreshLog => commands = model.refresh_log(),
        Message::DeleteLog => commands = model.delete_log(),
        Message::SaveLog => model.ask_where_to_save_log(),
        Message::VerifyChanged => commands = model.verify_changed(),
        Message::TrustConfigurator => commands = model.trust_configurator(),
        Message::Trust(action) => commands = model.trust_action(action),
        Message::Authority(command) => model.ask_authority(command),
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
                commands.push(Command::StartVirtualControllers);
            }
        }
        Message::Closing(choice) => commands = model.choose_about_closing(choice),
        Message::Save => commands = model.save(),
        Message::Event(event) => commands = model.event(event),
    }
    commands
}

/// Reads all information of controllers.
pub(super) fn get_info() -> Task {
    Task::new(T::GetInfo, jobs::GetInfo).act(T::GetInfo).quiet()
}

fn start_server() -> Task {
    Task::new(T::Start, jobs::StartServer).act(T::Start).quiet().restarts_server()
}

impl Model {
    pub(super) fn save(&mut self) -> Vec<Command> {
        self.unsaved = false;
        vec![Command::Save(Box::new(self.configuration()))]
    }

    fn sort(&mut self, column: Column) {
        self.rows.sort_by(column);
        self.options.window.sort = self.rows.sort.map(|(column, ascending)| (column.key().to_owned(), ascending));
        self.unsaved = true;
    }

    fn invoke(&mut self, command: UiCommand) -> Vec<Command> {
        let ticked = self.rows.ticked();
        let dialog = match command {
            UiCommand::Start => return self.plan(start_server(), ticked),
            UiCommand::Stop => return self.plan(Task::new(T::Stop, jobs::StopServer).act(T::Stop), ticked),
            UiCommand::GetInfo => return self.get_info(ticked),
            UiCommand::BasicSettings => return self.open_settings(ticked),
            UiCommand::Users => return self.open_users(ticked),
            UiCommand::SelfSigned => return self.open_self_signed(ticked, None),
            UiCommand::CaSigned => {
                self.open_ca_signed(ticked);
                return vec![];
            }
            UiCommand::UserSpecified => {
                self.open_user_specified(&ticked);
                return vec![];
            }
            UiCommand::RestoreBackup => {
                self.open_restore(ticked);
                return vec![];
            }
            UiCommand::TypeSelect => return self.open_type_select(ticked),
            UiCommand::ClientLists => return self.open_trust(Shows::Clients, ticked),
            UiCommand::Crl => return self.open_trust(Shows::Crls, ticked),
            UiCommand::ExportSettings => return self.open_transfer(Transfer::Export, ticked),
            UiCommand::ImportSettings => return self.open_transfer(Transfer::Import, ticked),
            UiCommand::ServerLog => return ticked.first().map(|row| self.open_log(*row)).unwrap_or_default(),
            UiCommand::Verify => return self.verify(ticked),
            UiCommand::CertificateAuthority => return self.open_authority(),
            UiCommand::CommandPalette => {
                self.command_palette = Some(CommandPalette::default());
                return vec![];
            }
            UiCommand::RowDetails => {
                self.show_details(!self.options.window.details);
                return vec![];
            }
            UiCommand::Quit => return vec![Command::Quit],
            UiCommand::TickAll => {
                self.rows.tick_shown(!self.rows.all_shown_ticked());
                return vec![];
            }
            UiCommand::ConnectionList => return self.open_connection_list(),
            UiCommand::ConfirmIdentity => {
                let rows = self.ticked_unconfirmed().collect();
                return self.confirm_identities(rows, vec![]);
            }
            UiCommand::Activation => Dialog::Activation(ActivationForm::new(ticked, self)),
            UiCommand::AddController => Dialog::AddController(AddController::new()),
            UiCommand::DeleteControllers => Dialog::Delete { names: self.rows.names(&ticked), rows: ticked },
            UiCommand::ExportSelfSigned => Dialog::ExportSelfSigned(ExportForm {
                names: self.rows.names(&ticked),
                rows: ticked,
                format: FileFormat::default(),
            }),
            UiCommand::Backup => Dialog::Backup { on: self.options.backup },
            UiCommand::Options => Dialog::Options,
            UiCommand::Shortcuts => Dialog::Shortcuts,
            UiCommand::Licences => Dialog::Licences(LicencesView::default()),
            UiCommand::About => Dialog::About,
            // The views' own business, or not there yet.
            _ => return vec![],
        };
        self.dialogs.push(dialog);
        vec![]
    }

    /// Asks first when the task changes something, else starts it.
    pub(super) fn plan(&mut self, task: Task, rows: Vec<RowId>) -> Vec<Command> {
        match task.confirmation() {
            Some(confirmation) => {
                let names = self.rows.names(&rows);
                self.dialogs.push(Dialog::Confirm { task, rows, names, confirmation });
                vec![]
            }
            None => self.start(task, rows, None),
        }
    }

    pub(super) fn start(
        &mut self,
        task: Task,
        rows: Vec<RowId>,
        password: Option<secrecy::SecretString>,
    ) -> Vec<Command> {
        let id = self.next_job();
        let entries: Vec<_> = rows.iter().filter_map(|row| self.rows.get(*row)).collect();
        let controllers: Vec<JobController> = entries.iter().map(|row| JobController::from(&row.entry)).collect();
        let rows = entries.iter().map(|row| JobRow::new(row.id, row.entry.name.to_string())).collect::<Vec<_>>();
        self.status = None;
        if task.is_shown {
            for row in &rows {
                self.rows.set_live(row.row, Some(RowState::Waiting));
            }
            let over_form = !self.dialogs.is_empty();
            self.dialogs.push(Dialog::Processing(ProcessingView { over_form, ..ProcessingView::default() }));
        }
        self.job =
            Some(Job { id, task: task.clone(), rows, finished: 0, failed: 0, cancel: CancelState::No, summary: None });
        vec![Command::Run { job: id, controllers, task, parallelism: self.options.parallelism, password }]
    }

    /// Stops waiting for the job of a form that was closed.
    pub(super) fn drop_job(&mut self) -> Vec<Command> {
        match self.job.take() {
            Some(job) if job.summary.is_none() => vec![Command::Cancel(job.id)],
            _ => vec![],
        }
    }

    fn event(&mut self, event: Event) -> Vec<Command> {
        match event {
            Event::Job { job, event } => self.job_event(job, event),
            Event::JobEnded { job, summary } => self.job_ended(job, summary),
            Event::Probed { job, result } => {
                self.probed(job, result);
                vec![]
            }
            Event::Enrolled { job, result } => self.enrolled(job, result),
            Event::FilePicked { job, result } => self.file_picked(job, result),
            Event::FileRead { job, result } => {
                self.file_read(job, result);
                vec![]
            }
            Event::FilesPicked { job, result } => self.trust_files_picked(job, result),
            Event::TrustFilesRead { job, files } => {
                self.trust_files_read(job, files);
                vec![]
            }
            Event::TrustSeen { job, event } => {
                self.trust_seen(job, event);
                vec![]
            }
            Event::Recognised { job, files } => self.recognised(job, files),
            Event::ExportSeen { job, result } => {
                self.export_seen(job, result);
                vec![]
            }
            Event::AuthorityDone { job, result } => self.authority_done(job, result),
            Event::VirtualStarted(result) => self.virtual_started(result),
            Event::StopRequested => self.stop_requested(),
            Event::StartedAgain => vec![Command::ShowWindow],
            Event::VaultDone(result) => self.vault_done(result),
            Event::PasswordStore(store) => {
                self.store_changed(store);
                vec![]
            }
            Event::PasswordNotKept(problem) => {
                self.password_not_kept(problem);
                vec![]
            }
            Event::SaveFailed(problem) | Event::FolderNotOpened(problem) => {
                // Once is enough for the same trouble.
                let shown = self.dialogs.iter().any(|d| matches!(d, Dialog::Error(p) if p.code == problem.code));
                if !shown {
                    self.show_problem(problem);
                }
                vec![]
            }
        }
    }

    fn job_event(&mut self, id: JobId, event: TaskEvent) -> Vec<Command> {
        let Some(job) = self.job.as_mut().filter(|job| job.id == id) else { return vec![] };
        match event {
            TaskEvent::Step { index, step } => {
                if let Some(row) = job.rows.get_mut(index) {
                    row.state = RowState::Step(step);
                    if job.task.is_shown {
                        self.rows.set_live(row.row, Some(RowState::Step(step)));
                    }
                }
                vec![]
            }
            TaskEvent::Finished { index, report } => {
                let is_shown = job.task.is_shown;
                let Some(row) = job.rows.get_mut(index) else { return vec![] };
                row.state = match &report.result {
                    Ok(facts) => {
                        (row.written, row.used) = (facts.written.clone(), facts.used.clone());
                        row.moved_aside.clone_from(&facts.moved_aside);
                        RowState::Done
                    }
                    Err(problem) if problem.code == ErrorCode::Cancelled => RowState::NotStarted,
                    Err(problem) => RowState::Failed(problem.clone()),
                };
                let (row, state) = (row.row, row.state.clone());
                job.finished += 1;
                job.failed += usize::from(state.problem().is_some());
                if is_shown {
                    let result = LastResult { title: job.task.title, at: self.now, state: state.clone() };
                    self.rows.set_result(row, result);
                    self.rows.set_live(row, Some(state));
                }
                if let Some(info) = report.info.clone() {
                    self.rows.set_info(row, info, self.now);
                }
                report.deliver(self, row)
            }
        }
    }

    fn job_ended(&mut self, id: JobId, summary: Summary) -> Vec<Command> {
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
            self.drop_form();
            self.show_problem(problem);
        }
        commands
    }

    fn processing_ended(&mut self, task: &Task, summary: Summary, failure: Option<usize>) -> Vec<Command> {
        let all_done = summary.failed == 0 && summary.not_started == 0;
        let alone = matches!(self.dialogs[..], [Dialog::Processing(_)]);
        if all_done && alone && self.options.verify_after_changes && !self.changed_servers().is_empty() {
            return self.verify_changed();
        }
        if all_done && task.is_quiet {
            self.status = Some(texts::job_done(self.language, task.title, summary.done));
            self.end_processing();
        } else if let Some(Dialog::Processing(view)) = self.processing_dialog() {
            view.selected = view.selected.or(failure);
        }
        vec![]
    }

    /// Passwords were asked for, and none was given.
    pub(super) fn without_password(&mut self, task: &Task) -> Vec<Command> {
        if let Some(hook) = task.password_hook() {
            return hook(self);
        }
        if !task.is_shown {
            self.drop_form();
            self.job = None;
        } else if let Some(Dialog::Processing(view)) = self.dialogs.last_mut() {
            view.selected = view.selected.or(self.job.as_ref().and_then(Job::first_failed));
        }
        vec![]
    }

    fn processing_dialog(&mut self) -> Option<&mut Dialog> {
        self.dialogs.iter_mut().rev().find(|dialog| matches!(dialog, Dialog::Processing(_)))
    }

    pub(super) fn end_processing(&mut self) {
        self.dialogs.retain(|dialog| !matches!(dialog, Dialog::Processing(_)));
        self.rows.clear_live();
        self.job = None;
    }

    fn keep_going(&mut self) {
        if let Some(job) = &mut self.job
            && job.cancel == CancelState::Asking
        {
            job.cancel = CancelState::No;
        }
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

    pub(super) fn ask_connection_passwords(&mut self) {
        let Some(job) = self.job.as_ref().filter(|job| job.summary.is_some()) else { return };
        let rows = job.without_password();
        if rows.is_empty() {
            return;
        }
        let wrong = job
            .rows
            .iter()
            .any(|row| row.state.problem().is_some_and(|problem| problem.code == ErrorCode::WrongPassword));
        self.dialogs.push(Dialog::Password(PasswordForm {
            names: self.rows.names(&rows),
            rows,
            password: Typed::default(),
            show_password: false,
            wrong,
            task: job.task.clone(),
        }));
    }
}
