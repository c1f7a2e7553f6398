use std::path::PathBuf;

use super::plot::RecordingPlot;
use crate::model::Problem;
use crate::recorder::{LiveValues, RecordingHeader, Sidecar};
use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, JobId, Model, RecorderWork};

/// A recording that is complete: what it holds, and its values.
#[derive(Debug, Default)]
pub struct RecordingView {
    /// The path of the file, as it is typed.
    pub path: String,
    /// Why the file cannot be shown.
    pub problem: Option<Problem>,
    /// The recording that is shown.
    pub opened: Option<OpenedRecording>,
    /// What of the values is shown.
    pub plot: RecordingPlot,
    /// What the file is about is being read.
    describing: Option<JobId>,
}

/// A recording that was opened.
#[derive(Debug)]
pub struct OpenedRecording {
    /// The file.
    pub file: PathBuf,
    /// What it is about.
    pub header: RecordingHeader,
    /// What it holds, once it was read through.
    pub sidecar: Option<Box<Sidecar>>,
    /// The values that were read, or are being read. Quantities that were added later come after the others.
    pub values: Vec<LoadedValues>,
}

/// Values of some columns.
#[derive(Debug)]
pub struct LoadedValues {
    names: Vec<String>,
    /// The values.
    pub values: LiveValues,
    /// They are being read.
    loading: Option<JobId>,
}

/// Points of all columns that are read at once: with their levels 300 MB. Longer recordings are thinned out in their older
/// part.
const POINTS: usize = 16_000_000;

impl RecordingView {
    /// Why nothing can be read now.
    pub fn incomplete(&self) -> Option<T> {
        if self.is_reading() { Some(T::Reading) } else { self.path.trim().is_empty().then_some(T::FileRule) }
    }

    /// Whether something is being read.
    pub fn is_reading(&self) -> bool {
        self.running_jobs().next().is_some()
    }

    pub(super) fn running_jobs(&self) -> impl Iterator<Item = JobId> {
        let values = self.opened.iter().flat_map(|opened| &opened.values);
        self.describing.into_iter().chain(values.filter_map(|values| values.loading))
    }

    /// Columns of the quantities that are shown and were not read.
    fn lacking(&self) -> Vec<String> {
        let Some(opened) = &self.opened else { return vec![] };
        let is_read = |name: &String| opened.values.iter().any(|values| values.names.contains(name));
        let mut wanted = self.plot.columns(opened.header.settings.source());
        wanted.retain(|name| !is_read(name));
        wanted
    }
}

impl Model {
    /// Opens the dialog, and reads the file.
    pub(in crate::ui) fn open_recording(&mut self, file: Option<PathBuf>) -> Vec<BackendCommand> {
        let path = file.map(|file| file.display().to_string()).unwrap_or_default();
        let reads = !path.is_empty();
        self.open(RecordingView { path, ..RecordingView::default() });
        if reads { self.read_recording() } else { vec![] }
    }

    /// A file was dropped onto the window.
    pub(in crate::ui) fn open_recording_of(&mut self, paths: Vec<PathBuf>) -> Vec<BackendCommand> {
        self.open_recording(paths.into_iter().next())
    }

    /// Reads the file whose path is typed. A relative path starts at the workspace.
    pub(in crate::ui) fn read_recording(&mut self) -> Vec<BackendCommand> {
        let (job, root) = (self.next_job(), self.workspace.root().to_owned());
        let Some(view) = self.dialog::<RecordingView>().filter(|view| view.incomplete().is_none()) else {
            return vec![];
        };
        let file = root.join(view.path.trim().trim_matches('"'));
        (view.describing, view.problem, view.opened) = (Some(job), None, None);
        vec![BackendCommand::Recorder { job, work: RecorderWork::Describe(file) }]
    }

    /// It is known what the file is about.
    pub(in crate::ui) fn recording_described(
        &mut self,
        job: JobId,
        result: Result<Box<RecordingHeader>, Problem>,
    ) -> Vec<BackendCommand> {
        let root = self.workspace.root().to_owned();
        let Some(view) = self.dialog::<RecordingView>().filter(|view| view.describing == Some(job)) else {
            return vec![];
        };
        view.describing = None;
        match result {
            Ok(header) => {
                view.plot.begin(header.settings.source());
                let file = root.join(view.path.trim().trim_matches('"'));
                view.opened = Some(OpenedRecording { file, header: *header, sidecar: None, values: Vec::new() });
                self.recording_plot_changed()
            }
            Err(problem) => {
                view.problem = Some(problem);
                vec![]
            }
        }
    }

    /// Reads the quantities that are shown and were not read, and drops those that are not shown any more.
    pub(in crate::ui) fn recording_plot_changed(&mut self) -> Vec<BackendCommand> {
        let job = self.next_job();
        let Some(view) = self.dialog::<RecordingView>() else { return vec![] };
        let lacking = view.lacking();
        let Some(opened) = &mut view.opened else { return vec![] };
        let wanted = view.plot.columns(opened.header.settings.source());
        let is_wanted = |values: &LoadedValues| values.names.iter().any(|name| wanted.contains(name));
        let unwanted = opened.values.iter().filter(|values| !is_wanted(values)).filter_map(|values| values.loading);
        let mut commands: Vec<BackendCommand> = unwanted.map(BackendCommand::Cancel).collect();
        opened.values.retain(is_wanted);
        // Reading even nothing tells what the recording holds.
        if !lacking.is_empty() || opened.sidecar.is_none() && opened.values.is_empty() {
            let values = LiveValues::limited(lacking.clone(), POINTS / lacking.len().max(1));
            opened.values.push(LoadedValues { names: lacking, values: values.clone(), loading: Some(job) });
            let work = RecorderWork::Load { file: opened.file.clone(), values };
            commands.push(BackendCommand::Recorder { job, work });
        }
        commands
    }

    /// Values were read.
    pub(in crate::ui) fn recording_loaded(
        &mut self,
        job: JobId,
        result: Result<Box<Sidecar>, Problem>,
    ) -> Vec<BackendCommand> {
        let Some(view) = self.dialog::<RecordingView>() else { return vec![] };
        let Some(opened) = &mut view.opened else { return vec![] };
        let Some(values) = opened.values.iter_mut().find(|values| values.loading == Some(job)) else { return vec![] };
        values.loading = None;
        match result {
            Ok(sidecar) => opened.sidecar = Some(sidecar),
            Err(problem) => view.problem = Some(problem),
        }
        vec![]
    }
}
