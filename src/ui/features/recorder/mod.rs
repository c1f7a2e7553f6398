//! Recording force sensor and motion log data of controllers, and looking at recordings (manual 4.1, 4.3).
//!
//! | file | contents |
//! |---|---|
//! | `setup` | [`RecorderSetup`]: what is recorded, how, and when it ends |
//! | `form` | [`RecorderForm`]: the dialog with a recording of each controller |
//! | `run` | starting and ending recordings, and what they report |
//! | `opened` | [`RecordingView`]: the dialog with a recording that is complete |
//! | `plot` | [`RecordingPlot`]: what of the values is shown, and which part of the time |

mod form;
mod opened;
mod plot;
mod run;
mod setup;
mod view;

use egui::{Key, Modifiers, Ui};

use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, UiCommand};

pub use form::{ControllerRecording, RecorderForm, RecordingState};
pub use opened::RecordingView;
pub use plot::{PlotRange, RecordingPlot};
pub use setup::{RecordedData, RecorderSetup};

impl UiCommand {
    /// Records data of controllers; leads back to recordings that go on.
    pub const RECORDER: Self = Self::new(T::Recorder, T::RecorderTip, Model::open_recorder)
        .in_menu(T::MenuTools)
        .key(Modifiers::COMMAND, Key::R)
        .disabled_if(|model, targets| {
            let has_recordings = model.working::<RecorderForm>().is_some();
            (!has_recordings && model.target_count(targets) == 0).then_some(T::WhyTick)
        });
    /// Shows a recording that is complete.
    pub const OPEN_RECORDING: Self =
        Self::new(T::OpenRecording, T::OpenRecordingTip, |model, _| model.open_recording(None))
            .in_menu(T::MenuTools)
            .key(Modifiers::COMMAND, Key::O);
}

impl Dialog for RecorderForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::recorder(ui, self, place, model, messages)
    }

    /// Starts the recordings, or ends those that go on, or leads back to the settings.
    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.submit_recorder(self)
    }

    /// Recordings go on.
    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.close_recorder(self)
    }

    /// A key that is pressed by mistake ends no recording.
    fn enter_submits(&self, _model: &Model) -> bool {
        self.recordings.is_empty()
    }

    fn stays_after_failure(&mut self) -> bool {
        true
    }
}

impl Dialog for RecordingView {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::opened(ui, self, place, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.put_back(self);
        model.read_recording()
    }

    fn close(self: Box<Self>, _model: &mut Model) -> Vec<BackendCommand> {
        self.running_jobs().map(BackendCommand::Cancel).collect()
    }
}
