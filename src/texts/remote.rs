//! What is said of remote commands.

use super::TextKey as T;
use crate::remote::{Command, Condition};

in_every_language! {
    remote:
    /// The state of a controller in one line. `flags`: names of the states that are on. `code`: of the error or warning.
    fn remote_status(flags: &[&str], code: u16) -> String;
    /// The login succeeded. `target`: where.
    fn remote_logged_in(target: &str) -> String;
    /// The numbers of alarms; there is at least one.
    fn remote_alarms(numbers: &str) -> String;
    /// A command was done.
    fn remote_done(command: &str) -> String;
    /// The connection was lost while values were watched; it is tried again.
    fn remote_watch_goes_on(problem: &str) -> String;
    /// A value of an argument is not possible. `argument`: its name. `possible`: what is.
    fn remote_bad_argument(argument: &str, value: &str, possible: &str) -> String;
}

impl Command {
    /// What happens when the command is done, for the question before it is sent; `None` for a command that only reads.
    pub const fn consequence(self) -> Option<T> {
        Some(match self {
            Self::Start => T::RemoteActStart,
            Self::Stop => T::RemoteActStop,
            Self::Pause => T::RemoteActPause,
            Self::Continue => T::RemoteActContinue,
            Self::Reset => T::RemoteActReset,
            Self::SetMotorsOn => T::RemoteActMotorsOn,
            Self::SetMotorsOff => T::RemoteActMotorsOff,
            Self::SetCurRobot => T::RemoteActRobot,
            Self::Home => T::RemoteActHome,
            Self::SetIO | Self::SetIOByte | Self::SetIOWord => T::RemoteActOutputs,
            Self::SetMemIO | Self::SetMemIOByte | Self::SetMemIOWord => T::RemoteActMemory,
            Self::SetVariable => T::RemoteActVariable,
            Self::Execute => T::RemoteActExecute,
            Self::Abort => T::RemoteActAbort,
            Self::ResetAlm => T::RemoteActAlarm,
            Self::Login
            | Self::Logout
            | Self::GetCurRobot
            | Self::GetIO
            | Self::GetIOByte
            | Self::GetIOWord
            | Self::GetMemIO
            | Self::GetMemIOByte
            | Self::GetMemIOWord
            | Self::GetVariable
            | Self::GetStatus
            | Self::GetAlm
            | Self::GetContName
            | Self::GetContNo
            | Self::GetContType
            | Self::GetContVer
            | Self::GetContDev
            | Self::GetSubnetMask
            | Self::GetDefaultGateway
            | Self::GetContMacAdd
            | Self::GetContSettings
            | Self::GetRobotInfo
            | Self::GetRobotName
            | Self::GetRobotSerial
            | Self::GetMotor
            | Self::GetHofs
            | Self::GetHealthCont
            | Self::GetHealthRB
            | Self::GetPartWarning
            | Self::GetCpuLoad
            | Self::GetPrjName
            | Self::GetErrMsg
            | Self::GetErrFunc => return None,
        })
    }
}

impl Condition {
    /// Why a command is not accepted if the condition is not met, and what to do.
    pub const fn unmet_text(self) -> T {
        match self {
            Self::Auto => T::RemoteNeedsAuto,
            Self::Ready => T::RemoteNeedsReady,
            Self::Running => T::RemoteNeedsRunning,
            Self::Paused => T::RemoteNeedsPaused,
            Self::NoError => T::RemoteNeedsNoError,
            Self::NoEStop => T::RemoteNeedsNoEStop,
            Self::NoSafeguard => T::RemoteNeedsNoSafeguard,
        }
    }
}
