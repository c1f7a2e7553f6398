use std::fmt;

use crate::model::{StatusFlag, StatusFlags};

/// One condition of the state of the controller under which a command is accepted ("input acceptance conditions" of the
/// remote commands; SPEL+ guide, remote control).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Condition {
    /// The operating mode is AUTO, with the control device set to remote.
    Auto,
    /// No task runs or is paused.
    Ready,
    /// Tasks run.
    Running,
    /// Tasks are paused.
    Paused,
    /// There is no error that Reset has not cleared.
    NoError,
    /// The emergency stop is released and reset.
    NoEStop,
    /// The safeguard is closed.
    NoSafeguard,
}

impl Condition {
    /// The flag of GetStatus that decides, and which value it must have.
    pub const fn flag(self) -> (StatusFlag, bool) {
        match self {
            Self::Auto => (StatusFlag::Auto, true),
            Self::Ready => (StatusFlag::Ready, true),
            Self::Running => (StatusFlag::Running, true),
            Self::Paused => (StatusFlag::Paused, true),
            Self::NoError => (StatusFlag::Error, false),
            Self::NoEStop => (StatusFlag::EStop, false),
            Self::NoSafeguard => (StatusFlag::Safeguard, false),
        }
    }

    /// Whether the condition is met in this state.
    pub const fn is_met(self, flags: StatusFlags) -> bool {
        let (flag, wanted) = self.flag();
        flags.contains(flag) == wanted
    }
}

impl fmt::Display for Condition {
    /// The flag and the value it must have: `Auto on`, `EStop off`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (flag, wanted) = self.flag();
        write!(f, "{} {}", flag.name(), if wanted { "on" } else { "off" })
    }
}
