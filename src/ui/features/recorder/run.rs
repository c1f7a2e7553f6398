//! Starting and ending recordings, and what they report.

use super::form::{ControllerRecording, RecorderForm, RecordingState};
use crate::jobs::{FindServer, FoundServer, RecordEnd, RecordEvent, RecordRequest, TrustConfigurator};
use crate::model::{ErrorCode, Problem};
use crate::recorder::{Recorded, RecordingPhase, StopReason};
use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, JobId, Model, RecorderEvent, RecorderWork, RowId, Task};

impl Model {
    /// Opens the dialog, or leads back to the recordings that go on.
    pub(in crate::ui) fn open_recorder(&mut self, rows: Vec<RowId>) -> Vec<BackendCommand> {
        if !self.show_hidden::<RecorderForm>() {
            let folder = self.workspace.root().join("recordings");
            let names = self.rows.names(&rows);
            self.open(RecorderForm::new(rows, names, folder.display().to_string()));
        }
        vec![]
    }

    /// The main button of the dialog.
    pub(in crate::ui) fn submit_recorder(&mut self, mut form: Box<RecorderForm>) -> Vec<BackendCommand> {
        let commands = if form.recordings.is_empty() {
            self.begin_recordings(&mut form)
        } else if form.active() == 0 {
            form.recordings.clear();
            form.recovered.clear();
            vec![]
        } else {
            self.end_recordings(&mut form)
        };
        self.put_back(form);
        commands
    }

    /// What is left in the folder by a program that was killed is completed first.
    fn begin_recordings(&mut self, form: &mut RecorderForm) -> Vec<BackendCommand> {
        let (Ok(settings), Ok(folder), None) =
            (form.setup.settings(), form.setup.typed_folder(), form.setup.incomplete())
        else {
            return vec![];
        };
        form.setup.use_login();
        form.settings = Some(settings);
        form.plot.begin(settings.source());
        let columns = form.plot.columns(settings.source());
        let recordings = form.rows.iter().zip(&form.names);
        let recordings = recordings.map(|(row, name)| ControllerRecording::new(*row, name.clone(), columns.clone()));
        form.recordings = recordings.collect();
        form.selected = 0;
        let job = self.next_job();
        form.recovering = Some(job);
        vec![BackendCommand::Recorder { job, work: RecorderWork::Recover(self.workspace.root().join(folder)) }]
    }

    /// Asks the controllers of these rows for their servers; the recording of each begins when its answer is there.
    fn find_servers(&mut self, rows: Vec<RowId>) -> Vec<BackendCommand> {
        let Some(form) = self.working_mut::<RecorderForm>() else { return vec![] };
        let columns = form.settings.map(|settings| form.plot.columns(settings.source())).unwrap_or_default();
        for row in &rows {
            if let Some(recording) = form.of_row(*row) {
                *recording = ControllerRecording::new(*row, recording.name.clone(), columns.clone());
            }
        }
        let operation = FindServer { identity: self.workspace.own_identity(), trust_first: false };
        let task = Task::with_results(T::RecorderTitle, operation, Self::server_found).for_dialog::<RecorderForm>();
        let task = task.on_end(Self::servers_asked).without_password(Self::servers_asked);
        self.start(task, rows, None)
    }

    fn server_found(&mut self, row: RowId, result: Result<FoundServer, Problem>) -> Vec<BackendCommand> {
        let job = self.next_job();
        let root = self.workspace.root().to_owned();
        let Some(form) = self.working_mut::<RecorderForm>() else { return vec![] };
        let setup = &form.setup;
        let typed = (form.settings, setup.typed_folder(), setup.limits(), setup.login());
        let (format, keep_packets) = (setup.format, setup.keep_packets);
        // One that lacked a password has failed before.
        let waits = |recording: &&mut ControllerRecording| {
            matches!(recording.state, RecordingState::Finding | RecordingState::Failed(_))
        };
        let Some(recording) = form.of_row(row).filter(waits) else { return vec![] };
        match (result, typed) {
            (Err(problem), _) => {
                recording.state = RecordingState::Failed(problem);
                vec![]
            }
            (Ok(found), (Some(settings), Ok(folder), Ok(limits), Ok(login))) => {
                recording.state = RecordingState::At(RecordingPhase::Connecting);
                recording.job = Some(job);
                let request = RecordRequest {
                    name: recording.name.clone(),
                    found,
                    login,
                    settings,
                    format,
                    keep_packets,
                    folder: root.join(folder),
                    limits,
                    values: Some(recording.values.clone()),
                };
                vec![BackendCommand::Recorder { job, work: RecorderWork::Record(Box::new(request)) }]
            }
            // The settings cannot be changed while recordings are started.
            (Ok(_), _) => vec![],
        }
    }

    /// Every controller was asked.
    fn servers_asked(&mut self) -> Vec<BackendCommand> {
        self.job = None;
        self.stop_finding();
        vec![]
    }

    /// No answer comes any more.
    fn stop_finding(&mut self) {
        let Some(form) = self.working_mut::<RecorderForm>() else { return };
        for recording in form.recordings.iter_mut().filter(|one| one.state == RecordingState::Finding) {
            recording.state = RecordingState::Failed(ErrorCode::Cancelled.into());
        }
    }

    /// Work about recordings reports something.
    pub(in crate::ui) fn recorder_seen(&mut self, job: JobId, event: RecorderEvent) -> Vec<BackendCommand> {
        match event {
            RecorderEvent::Recovered(recovered) => self.recordings_recovered(job, recovered),
            RecorderEvent::Seen(event) => {
                let recording = self.working_mut::<RecorderForm>().and_then(|form| form.of_job(job));
                if let Some(recording) = recording {
                    recording.take_in(event);
                }
                vec![]
            }
            RecorderEvent::Ended(end) => {
                let recording = self.working_mut::<RecorderForm>().and_then(|form| form.of_job(job));
                if let Some(recording) = recording {
                    recording.end(*end);
                }
                vec![]
            }
            RecorderEvent::Described(result) => self.recording_described(job, result),
            RecorderEvent::Loaded(result) => self.recording_loaded(job, result),
        }
    }

    fn recordings_recovered(&mut self, job: JobId, recovered: Vec<Result<Recorded, Problem>>) -> Vec<BackendCommand> {
        let form = self.working_mut::<RecorderForm>();
        let Some(form) = form.filter(|form| form.recovering == Some(job)) else { return vec![] };
        form.recovering = None;
        form.recovered = recovered;
        let waiting = form.recordings.iter().filter(|recording| recording.state == RecordingState::Finding);
        let rows: Vec<RowId> = waiting.map(|recording| recording.row).collect();
        if rows.is_empty() { vec![] } else { self.find_servers(rows) }
    }

    /// Ends every recording that goes on. Their files are completed.
    fn end_recordings(&mut self, form: &mut RecorderForm) -> Vec<BackendCommand> {
        let mut commands: Vec<BackendCommand> = form.jobs().map(BackendCommand::Cancel).collect();
        for recording in &mut form.recordings {
            recording.stop();
        }
        if form.recordings.iter().all(|recording| recording.job.is_none()) {
            commands.extend(self.drop_job());
        }
        commands
    }

    /// Ends the recording of one controller. Its files are completed.
    pub(in crate::ui) fn end_recording(&mut self, row: RowId) -> Vec<BackendCommand> {
        let Some(form) = self.working_mut::<RecorderForm>() else { return vec![] };
        let Some(recording) = form.of_row(row).filter(|recording| recording.state.is_active()) else { return vec![] };
        recording.stop();
        recording.job.map(BackendCommand::Cancel).into_iter().collect()
    }

    /// Ends every recording, as the window closes.
    pub(in crate::ui) fn end_all_recordings(&mut self) -> Vec<BackendCommand> {
        let Some(form) = self.working_mut::<RecorderForm>() else { return vec![] };
        let commands = form.jobs().map(BackendCommand::Cancel).collect();
        form.recordings.iter_mut().for_each(ControllerRecording::stop);
        commands
    }

    /// How many recordings go on.
    pub fn active_recordings(&self) -> usize {
        self.working::<RecorderForm>().map_or(0, RecorderForm::active)
    }

    /// The dialog is closed: recordings go on without it.
    pub(in crate::ui) fn close_recorder(&mut self, form: Box<RecorderForm>) -> Vec<BackendCommand> {
        let is_recording = form.active() > 0;
        if !is_recording {
            return vec![];
        }
        self.hide(form);
        // Other work may begin: a controller that was not found yet is not waited for.
        if self.job.is_none() {
            return vec![];
        }
        let commands = self.drop_job();
        self.stop_finding();
        commands
    }

    /// Starts the recordings again that failed.
    pub(in crate::ui) fn retry_recordings(&mut self) -> Vec<BackendCommand> {
        let failed = self.recordings_that_failed(|_| true);
        if failed.is_empty() || self.job.is_some() { vec![] } else { self.find_servers(failed) }
    }

    fn recordings_that_failed(&self, fits: impl Fn(&Problem) -> bool) -> Vec<RowId> {
        let recordings = self.working::<RecorderForm>().map(|form| form.recordings.as_slice()).unwrap_or_default();
        let failed = recordings.iter().filter(|recording| recording.state.problem().is_some_and(&fits));
        failed.map(|recording| recording.row).collect()
    }

    /// Asks whether this program's certificate may be put into the trusted lists of the controllers that refuse it, then
    /// starts their recordings again.
    pub(in crate::ui) fn trust_for_recordings(&mut self) -> Vec<BackendCommand> {
        let rows = self.recordings_that_failed(|problem| problem.code == ErrorCode::ConfiguratorNotTrusted);
        if rows.is_empty() || self.job.is_some() {
            return vec![];
        }
        let operation = TrustConfigurator { identity: self.workspace.own_identity() };
        let task = Task::with_results(T::TrustConfiguratorTitle, operation, |_, _, _| vec![]);
        let refused = rows.clone();
        let task = task.act(T::TrustTrust).remark(T::ConfirmTrustConfigurator).on_end(move |model| {
            let failed = model.job.as_ref().is_some_and(|job| job.first_problem().is_some());
            if failed {
                return vec![];
            }
            model.end_processing();
            model.find_servers(refused.clone())
        });
        self.plan(task, rows)
    }

    /// Other quantities are to be plotted: the recordings deliver them from now on.
    pub(in crate::ui) fn recorder_plot_changed(&mut self) -> Vec<BackendCommand> {
        if let Some(form) = self.working_mut::<RecorderForm>()
            && let Some(settings) = form.settings
        {
            let columns = form.plot.columns(settings.source());
            for recording in &form.recordings {
                recording.values.show(columns.clone());
            }
        }
        vec![]
    }
}

impl ControllerRecording {
    fn take_in(&mut self, event: RecordEvent) {
        match event {
            RecordEvent::Started(file) => self.file = Some(file),
            RecordEvent::Progress(progress) => {
                if self.state != RecordingState::Ending && self.state.is_active() {
                    self.state = RecordingState::At(progress.phase.clone());
                }
                self.progress = *progress;
            }
        }
    }

    fn end(&mut self, end: RecordEnd) {
        let reason = end.recorded.as_ref().map_or(StopReason::Request, |recorded| recorded.sidecar.stopped_by);
        self.state = end.problem.map_or(RecordingState::Ended(reason), RecordingState::Failed);
        if let Some(recorded) = &end.recorded {
            self.progress.rows = recorded.sidecar.rows;
            self.progress.missing = recorded.sidecar.missing();
            self.progress.gaps = recorded.sidecar.gaps.len() as u64;
            self.file = Some(recorded.file.clone());
        }
        self.recorded = end.recorded;
        self.job = None;
    }

    /// It was told to end.
    fn stop(&mut self) {
        if self.state.is_active() {
            // Before it has begun there is nothing to complete.
            self.state = match self.job {
                Some(_) => RecordingState::Ending,
                None => RecordingState::Ended(StopReason::Request),
            };
        }
    }
}
