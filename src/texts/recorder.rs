//! What is said of recordings.

use std::path::Path;

use chrono::{DateTime, Utc};

use super::{TextKey as T, byte_count};
use crate::model::Language;
use crate::recorder::{Gap, GapCause, Quantity, Sidecar, Source, StopReason};

in_every_language! {
    recorder:
    /// When the recording of a controller has begun.
    fn recording_started(name: &str, file: &Path) -> String;
    /// When the files of a recording were made from what a program that was killed left.
    fn recording_recovered(file: &Path, rows: u64) -> String;
    /// When a recording is complete. `missing`: records of the force sensor, or blocks of the motion log.
    fn recording_ended(file: &Path, rows: u64, missing: u64, gaps: usize) -> String;
    /// Records or blocks that are missing; 0 with gaps: it is not known how many.
    fn recording_missing(missing: u64, gaps: u64) -> String;
    /// How many gaps a plot has.
    fn recording_gaps(gaps: usize) -> String;
    /// Which part of the time is shown, in seconds.
    fn recording_range(from: f64, to: f64) -> String;
    /// How many recordings go on while their dialog is closed.
    fn recordings_running(count: usize) -> String;
    /// No recording goes on any more while their dialog is closed.
    fn recordings_ended(failed: usize) -> String;
}

/// Why a recording has ended, as a state.
pub fn recording_end(language: Language, reason: StopReason) -> String {
    in_language!(language, recorder::recording_end(reason.text_key().text(language)))
}

/// A gap in a list.
pub fn recording_gap(language: Language, gap: &Gap) -> String {
    let cause = gap.cause.text_key().text(language);
    in_language!(language, recorder::recording_gap(gap.at_row, gap.missing, cause))
}

/// What a recording holds, a fact a line. `time`: how times are written.
pub fn recording_facts(
    language: Language,
    sidecar: &Sidecar,
    time: impl Fn(DateTime<Utc>) -> String,
) -> Vec<(T, String)> {
    let header = &sidecar.header;
    vec![
        (T::RecordingController, format!("{} ({})", header.controller, header.serial)),
        (T::RecordingData, header.settings.source().text_key().text(language).to_owned()),
        (T::RecordingStarted, time(header.started_at)),
        (T::RecordingEnded, time(sidecar.ended_at)),
        (T::RecordingStoppedBy, sidecar.stopped_by.text_key().text(language).to_owned()),
        (T::RecordingSeconds, format!("{:.3} s", sidecar.seconds)),
        (T::RecordingRows, sidecar.rows.to_string()),
        (T::RecordingPackets, sidecar.packets.to_string()),
        (T::RecordingMissing, sidecar.missing().to_string()),
        (T::RecordingGaps, sidecar.gaps.len().to_string()),
    ]
}

/// The size of a file.
pub fn file_size(bytes: u64) -> String {
    byte_count(bytes)
}

impl Quantity {
    /// What a plot of it is called.
    pub const fn text_key(self) -> T {
        match self {
            Self::Forces => T::QuantityForces,
            Self::Torques => T::QuantityTorques,
            Self::Position => T::QuantityPosition,
            Self::Orientation => T::QuantityOrientation,
            Self::ReferencePosition => T::QuantityReferencePosition,
            Self::ReferenceOrientation => T::QuantityReferenceOrientation,
            Self::Correction => T::QuantityCorrection,
            Self::Speed => T::QuantitySpeed,
            Self::Joints => T::QuantityJoints,
            Self::Overload => T::QuantityOverload,
            Self::Program => T::QuantityProgram,
            Self::EncoderPositions => T::QuantityEncoderPositions,
            Self::EncoderTemperatures => T::QuantityEncoderTemperatures,
            Self::DirectCurrents => T::QuantityDirectCurrents,
            Self::QuadratureCurrents => T::QuantityQuadratureCurrents,
            Self::MotorSpeeds => T::QuantityMotorSpeeds,
            Self::ElectricalAngles => T::QuantityElectricalAngles,
            Self::InputsOutputs => T::QuantityInputsOutputs,
            Self::SensorCounts => T::QuantitySensorCounts,
            Self::PulseCounters => T::QuantityPulseCounters,
        }
    }
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
