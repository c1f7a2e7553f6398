use std::path::PathBuf;

use super::plot::RecordingPlot;
use super::setup::RecorderSetup;
use crate::model::Problem;
use crate::recorder::{LiveValues, Progress, RecordSettings, Recorded, RecordingPhase, StopReason};
use crate::ui::model::{JobId, RowId};

/// Recordings of some controllers: their settings at first, then each of them.
#[derive(Debug)]
pub struct RecorderForm {
    /// The rows of the controllers.
    pub rows: Vec<RowId>,
    /// Their names.
    pub names: Vec<String>,
    /// The settings of the next recordings.
    pub setup: RecorderSetup,
    /// What is recorded; set when the recordings begin.
    pub settings: Option<RecordSettings>,
    /// One of each controller; none before they are started.
    pub recordings: Vec<ControllerRecording>,
    /// Index of the one whose values are shown.
    pub selected: usize,
    /// What of the values is shown.
    pub plot: RecordingPlot,
    /// Recordings of a program that was killed, which were completed or could not be.
    pub recovered: Vec<Result<Recorded, Problem>>,
    /// Such recordings are looked for.
    pub(super) recovering: Option<JobId>,
}

/// The recording of one controller.
#[derive(Debug)]
pub struct ControllerRecording {
    /// The row of the controller.
    pub row: RowId,
    /// The name of the controller.
    pub name: String,
    /// What the recording is doing.
    pub state: RecordingState,
    /// How far it has come.
    pub progress: Progress,
    /// The values that are plotted.
    pub values: LiveValues,
    /// The CSV or Parquet file, once there is one.
    pub file: Option<PathBuf>,
    /// The complete files.
    pub recorded: Option<Recorded>,
    /// The recording that runs.
    pub(super) job: Option<JobId>,
}

/// What the recording of a controller is doing.
#[derive(Debug, Clone, PartialEq)]
pub enum RecordingState {
    /// The controller is asked for its server.
    Finding,
    /// The recording runs.
    At(RecordingPhase),
    /// It was told to end, and completes its files.
    Ending,
    /// It has ended.
    Ended(StopReason),
    /// It has ended because of this.
    Failed(Problem),
}

impl RecorderForm {
    /// The settings, for some controllers.
    pub fn new(rows: Vec<RowId>, names: Vec<String>, folder: String) -> Self {
        Self {
            rows,
            names,
            setup: RecorderSetup::new(folder),
            settings: None,
            recordings: Vec::new(),
            selected: 0,
            plot: RecordingPlot::default(),
            recovered: Vec::new(),
            recovering: None,
        }
    }

    /// How many recordings have not ended.
    pub fn active(&self) -> usize {
        self.recordings.iter().filter(|recording| recording.state.is_active()).count()
    }

    /// How many recordings ended because of an error.
    pub fn failed(&self) -> usize {
        self.recordings.iter().filter(|recording| recording.state.problem().is_some()).count()
    }

    /// The one whose values are shown.
    pub fn shown(&self) -> Option<&ControllerRecording> {
        self.recordings.get(self.selected)
    }

    pub(super) fn of_row(&mut self, row: RowId) -> Option<&mut ControllerRecording> {
        self.recordings.iter_mut().find(|recording| recording.row == row)
    }

    pub(super) fn of_job(&mut self, job: JobId) -> Option<&mut ControllerRecording> {
        self.recordings.iter_mut().find(|recording| recording.job == Some(job))
    }

    /// The jobs of the recordings that go on.
    pub(super) fn jobs(&self) -> impl Iterator<Item = JobId> {
        self.recordings.iter().filter(|recording| recording.state.is_active()).filter_map(|recording| recording.job)
    }
}

impl ControllerRecording {
    pub(super) fn new(row: RowId, name: String, columns: Vec<String>) -> Self {
        Self {
            row,
            name,
            state: RecordingState::Finding,
            progress: Progress::default(),
            values: LiveValues::new(columns),
            file: None,
            recorded: None,
            job: None,
        }
    }
}

impl RecordingState {
    /// Whether the recording has not ended.
    pub const fn is_active(&self) -> bool {
        !matches!(self, Self::Ended(_) | Self::Failed(_))
    }

    /// Whether values come, or may come again.
    pub const fn is_recording(&self) -> bool {
        matches!(self, Self::At(_))
    }

    /// Why it has ended early.
    pub const fn problem(&self) -> Option<&Problem> {
        match self {
            Self::Failed(problem) => Some(problem),
            _ => None,
        }
    }
}
