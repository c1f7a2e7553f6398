//! What an engineer is told of each error of the recorder.

use std::io;

use super::error::RecorderError;
use super::recording::RecordingError;
use super::source::SourceError;
use crate::model::{ErrorCode, Problem};

impl From<RecordingError> for Problem {
    fn from(error: RecordingError) -> Self {
        match error {
            RecordingError::Source(error) => error.into(),
            RecordingError::Files(error) => error.into(),
        }
    }
}

impl From<SourceError> for Problem {
    fn from(error: SourceError) -> Self {
        Self::with_detail(error.code(), error)
    }
}

impl SourceError {
    /// What an engineer is told of it.
    pub const fn code(&self) -> ErrorCode {
        match self {
            Self::Connect(error) => error.code(),
            Self::Session(_) => ErrorCode::OpcUaConnectionFailed,
            Self::NoNodes(_) | Self::OddValue { .. } => ErrorCode::NoDataNodes,
            Self::SettingRefused { .. } => ErrorCode::DataSettingsRefused,
        }
    }
}

impl From<RecorderError> for Problem {
    fn from(error: RecorderError) -> Self {
        let code = match &error {
            RecorderError::Write { source, .. } if is_full(source) => ErrorCode::WorkspaceFull,
            RecorderError::Write { .. } | RecorderError::Parquet { .. } => ErrorCode::WorkspaceReadOnly,
            RecorderError::Read { source, .. } if source.kind() == io::ErrorKind::NotFound => ErrorCode::FileNotFound,
            RecorderError::Read { .. } => ErrorCode::FileUnreadable,
            RecorderError::NotARecording { .. } | RecorderError::DamagedTable { .. } => ErrorCode::FileFormat,
            RecorderError::NoDescription(_) => ErrorCode::NoRecordingDescription,
            RecorderError::UnknownFormat(_) => ErrorCode::BadFileName,
            RecorderError::BrokenOff => ErrorCode::Internal,
        };
        Self::with_detail(code, error)
    }
}

fn is_full(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded | io::ErrorKind::FileTooLarge)
}
