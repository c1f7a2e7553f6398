//! What is said of recordings.

use std::path::Path;

use super::TextKey as T;
use crate::recorder::{GapCause, Source, StopReason};

in_every_language! {
    recorder:
    /// When the recording of a controller has begun.
    fn recording_started(name: &str, file: &Path) -> String;
    /// When the files of a recording were made from what a program that was killed left.
    fn recording_recovered(file: &Path, rows: u64) -> String;
    /// When a recording is complete. `missing`: records of the force sensor, or blocks of the motion log.
    fn recording_ended(file: &Path, rows: u64, missing: u64, gaps: usize) -> String;
}

impl Source {
    /// What the data is called.
    pub const fn text_key(self) -> T {
        match self {
            Self::Force { .. } => T::RecordingForce,
            Self::Motion { .. } => T::RecordingMotion,
        }
    }
}

impl StopReason {
    /// What ended a recording.
    pub const fn text_key(self) -> T {
        match self {
            Self::Request => T::StopRequest,
            Self::Duration => T::StopDuration,
            Self::Size => T::StopSize,
            Self::Footer => T::StopFooter,
            Self::Error => T::StopError,
            Self::Killed => T::StopKilled,
        }
    }
}

impl GapCause {
    /// Why something is missing.
    pub const fn text_key(self) -> T {
        match self {
            Self::Overwritten => T::GapOverwritten,
            Self::BrokenOff => T::GapBrokenOff,
            Self::ConnectionLost => T::GapConnectionLost,
            Self::Unexplained => T::GapUnexplained,
            Self::ControllerRestarted => T::GapRestarted,
            Self::Undecodable => T::GapUndecodable,
        }
    }
}
