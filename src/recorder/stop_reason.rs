use serde::{Deserialize, Serialize};

/// Why a recording ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StopReason {
    /// The user, or the system, asked for it.
    Request,
    /// The time was over.
    Duration,
    /// The size was reached.
    Size,
    /// The footer came.
    Footer,
    /// An error after which nothing more could be recorded.
    Error,
    /// The program ended without finishing the recording.
    Killed,
}

impl StopReason {
    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Request => "request",
            Self::Duration => "duration",
            Self::Size => "size",
            Self::Footer => "footer",
            Self::Error => "error",
            Self::Killed => "killed",
        }
    }

    /// An unknown name is [`StopReason::Request`]: some end was written.
    pub(super) fn from_name(name: &str) -> Self {
        [Self::Duration, Self::Size, Self::Footer, Self::Error, Self::Killed]
            .into_iter()
            .find(|reason| reason.as_str() == name)
            .unwrap_or(Self::Request)
    }
}
