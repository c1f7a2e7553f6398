//! Which code a refusal of the cell becomes.
//!
//! The manual names a code for a state (20), a running Execute (21) and a variable (15). It names none for a function, robot,
//! port or alarm that the controller does not have, nor for a SPEL+ statement that fails: these are 99, which real
//! controllers answer to an Execute that fails or is stopped.

use crate::remote::RefusalCode;
use crate::virtual_controller::cell::{CommandRefusal, SpelError, VariableError};

pub(super) const fn of_command(refusal: CommandRefusal) -> RefusalCode {
    match refusal {
        CommandRefusal::NotAuto
        | CommandRefusal::NotReady
        | CommandRefusal::NotRunning
        | CommandRefusal::NotPaused
        | CommandRefusal::InError
        | CommandRefusal::EmergencyStop
        | CommandRefusal::SafeguardOpen
        | CommandRefusal::MotorsOff
        | CommandRefusal::NotStepping => RefusalCode::NotReady,
        CommandRefusal::ExecuteRunning => RefusalCode::ExecuteRunning,
        CommandRefusal::Variable(error) => of_variable(error),
        CommandRefusal::UnknownRobot
        | CommandRefusal::UnknownFunction
        | CommandRefusal::UnknownPort
        | CommandRefusal::UnknownAlarm
        | CommandRefusal::NoMonitor
        | CommandRefusal::OutOfRange
        | CommandRefusal::NotSupported => RefusalCode::SystemError,
    }
}

pub(super) const fn of_variable(error: VariableError) -> RefusalCode {
    match error {
        VariableError::Unknown | VariableError::Dimensions | VariableError::Element => RefusalCode::NoSuchVariable,
        VariableError::Value => RefusalCode::BadFormat,
    }
}

pub(super) const fn of_execute(error: &SpelError) -> RefusalCode {
    match error {
        SpelError::TextTooLong => RefusalCode::BadFormat,
        _ => RefusalCode::SystemError,
    }
}
