use thiserror::Error;

/// Why Execute does not run a text, or ends before its end.
///
/// A number is the vendor's where its list of status codes has one for the case (RC+ status codes: 2000 and following
/// interpreter, 4000 and following motion, 7000 and following points). The others are numbered from 8001 on, in the range
/// that SPEL+ leaves to users.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SpelError {
    /// 2000: not a statement of the subset, or written in a wrong way. With the text from there on.
    #[error("not understood: {0}")]
    Unsupported(String),
    /// 2001: the current robot cannot do this motion.
    #[error("the robot cannot execute this motion command")]
    UnsupportedMotion,
    /// 2344: no such I/O bit.
    #[error("there is no such I/O bit")]
    IoBit,
    /// 2345: no such I/O byte.
    #[error("there is no such I/O byte")]
    IoByte,
    /// 2346: no such I/O word.
    #[error("there is no such I/O word")]
    IoWord,
    /// 2347: no such bit of the memory I/O.
    #[error("there is no such memory I/O bit")]
    MemoryBit,
    /// 2348: no such byte of the memory I/O.
    #[error("there is no such memory I/O byte")]
    MemoryByte,
    /// 2349: no such word of the memory I/O.
    #[error("there is no such memory I/O word")]
    MemoryWord,
    /// 4002: a value out of the range of a statement or function.
    #[error("a value is out of range")]
    OutOfRange,
    /// 4007: the robot cannot reach the point.
    #[error("the robot cannot reach the point")]
    OutOfReach,
    /// 7003: no such robot.
    #[error("there is no such robot")]
    UnknownRobot,
    /// 7006: a point number above 999.
    #[error("there is no such point number")]
    PointNumber,
    /// 7007: the point is not defined.
    #[error("the point is not defined")]
    UndefinedPoint,
    /// 8001: longer than 256 bytes.
    #[error("the text is longer than 256 bytes")]
    TextTooLong,
    /// 8002: no such backup variable.
    #[error("there is no such backup variable")]
    UnknownVariable,
    /// 8003: a value of another type than is needed.
    #[error("the value has another type")]
    WrongType,
    /// 8004: no such element, or another number of dimensions.
    #[error("the array has no such element")]
    Element,
    /// 8005: the result is longer than 4060 bytes.
    #[error("the result is longer than 4060 bytes")]
    ResultTooLong,
    /// 8006: a motion with the motors off.
    #[error("the motors are off")]
    MotorsOff,
    /// 8007: ended by Abort, Stop, the safeguard, an emergency stop, an error or a change of the mode.
    #[error("the command was ended before its end")]
    Aborted,
    /// 8008: division by 0.
    #[error("division by 0")]
    DivisionByZero,
}

impl SpelError {
    /// The number, as `Err` gives it.
    pub const fn number(&self) -> u16 {
        match self {
            Self::Unsupported(_) => 2000,
            Self::UnsupportedMotion => 2001,
            Self::IoBit => 2344,
            Self::IoByte => 2345,
            Self::IoWord => 2346,
            Self::MemoryBit => 2347,
            Self::MemoryByte => 2348,
            Self::MemoryWord => 2349,
            Self::OutOfRange => 4002,
            Self::OutOfReach => 4007,
            Self::UnknownRobot => 7003,
            Self::PointNumber => 7006,
            Self::UndefinedPoint => 7007,
            Self::TextTooLong => 8001,
            Self::UnknownVariable => 8002,
            Self::WrongType => 8003,
            Self::Element => 8004,
            Self::ResultTooLong => 8005,
            Self::MotorsOff => 8006,
            Self::Aborted => 8007,
            Self::DivisionByZero => 8008,
        }
    }
}

/// The text of `ErrMsg$`, in English; empty for a number that the virtual controller does not raise.
pub fn error_message(number: u16) -> &'static str {
    match number {
        580 => "Error of the OPC UA server.",
        581 => "The log of the OPC UA server is on.",
        582 => "The log of the OPC UA server is full.",
        2000 => "Unsupported command.",
        2001 => "Unsupported motion command.",
        2344 => "I/O bit number out of range.",
        2345 => "I/O byte number out of range.",
        2346 => "I/O word number out of range.",
        2347 => "Memory I/O bit number out of range.",
        2348 => "Memory I/O byte number out of range.",
        2349 => "Memory I/O word number out of range.",
        4002 => "Value out of range.",
        4007 => "Point outside of the motion range.",
        7003 => "Robot not found.",
        7006 => "Point number out of range.",
        7007 => "Point not defined.",
        7930 => "The OPC UA server is not activated.",
        7931 => "No certificate for the OPC UA server.",
        7932 => "Invalid parameter of the OPC UA server.",
        7933 => "The port of the OPC UA server is in use.",
        8001 => "Command longer than 256 bytes.",
        8002 => "Variable not found.",
        8003 => "Wrong type of a value.",
        8004 => "Array element out of range.",
        8005 => "Result longer than 4060 bytes.",
        8006 => "Motors off.",
        8007 => "Command aborted.",
        8008 => "Division by 0.",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_error_has_a_number_of_its_own_and_a_text() {
        let errors = [
            SpelError::Unsupported(String::new()),
            SpelError::UnsupportedMotion,
            SpelError::IoBit,
            SpelError::IoByte,
            SpelError::IoWord,
            SpelError::MemoryBit,
            SpelError::MemoryByte,
            SpelError::MemoryWord,
            SpelError::OutOfRange,
            SpelError::OutOfReach,
            SpelError::UnknownRobot,
            SpelError::PointNumber,
            SpelError::UndefinedPoint,
            SpelError::TextTooLong,
            SpelError::UnknownVariable,
            SpelError::WrongType,
            SpelError::Element,
            SpelError::ResultTooLong,
            SpelError::MotorsOff,
            SpelError::Aborted,
            SpelError::DivisionByZero,
        ];
        let mut numbers: Vec<u16> = errors.iter().map(SpelError::number).collect();
        assert!(numbers.iter().all(|number| !error_message(*number).is_empty()));
        numbers.sort_unstable();
        numbers.dedup();
        assert_eq!(numbers.len(), errors.len());
        assert_eq!(error_message(1), "");
    }
}
