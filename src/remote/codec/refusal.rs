use std::fmt;

/// Why a controller refuses a request: the two digits of an error reply, the same in both forms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum RefusalCode {
    /// 10: the request does not begin as a command does.
    BadStart,
    /// 11: the command is unknown, to this firmware too, or nobody is logged in.
    UnknownCommand,
    /// 12: the request has a wrong format.
    BadFormat,
    /// 13: wrong password.
    WrongPassword,
    /// 14: the count of elements is omitted or not 1–100, or elements of a String array are asked for.
    BadCount,
    /// 15: no such variable, or the array has other dimensions or fewer elements.
    NoSuchVariable,
    /// 16: wrong checksum. Frames only.
    BadChecksum,
    /// 19: the request was not complete in time.
    TimedOut,
    /// 20: the controller is in a state in which the command is not accepted, see
    /// [`Command::conditions`](super::Command::conditions).
    NotReady,
    /// 21: an Execute is running.
    ExecuteRunning,
    /// 98: a controller with a global IP address accepts only logins with a password. Text form only.
    PasswordRequired,
    /// 99: system or communication error.
    SystemError,
    /// A code that the manual does not have: 0–97.
    Other(u8),
}

impl RefusalCode {
    /// Every code of the manual, in ascending order.
    pub const ALL: [Self; 12] = [
        Self::BadStart,
        Self::UnknownCommand,
        Self::BadFormat,
        Self::WrongPassword,
        Self::BadCount,
        Self::NoSuchVariable,
        Self::BadChecksum,
        Self::TimedOut,
        Self::NotReady,
        Self::ExecuteRunning,
        Self::PasswordRequired,
        Self::SystemError,
    ];

    /// The number on the wire, 0–99.
    pub const fn number(self) -> u8 {
        match self {
            Self::BadStart => 10,
            Self::UnknownCommand => 11,
            Self::BadFormat => 12,
            Self::WrongPassword => 13,
            Self::BadCount => 14,
            Self::NoSuchVariable => 15,
            Self::BadChecksum => 16,
            Self::TimedOut => 19,
            Self::NotReady => 20,
            Self::ExecuteRunning => 21,
            Self::PasswordRequired => 98,
            Self::SystemError => 99,
            Self::Other(number) => number,
        }
    }

    /// The code with this number; `None` above 99, which two digits do not hold.
    pub fn from_number(number: u8) -> Option<Self> {
        let known = Self::ALL.into_iter().find(|code| code.number() == number);
        (number <= 99).then(|| known.unwrap_or(Self::Other(number)))
    }

    /// The two ASCII digits of an error reply.
    pub(super) const fn digits(self) -> [u8; 2] {
        let number = self.number() % 100;
        [b'0' + number / 10, b'0' + number % 10]
    }

    /// Reads [`RefusalCode::digits`].
    pub(super) fn from_digits(digits: [u8; 2]) -> Option<Self> {
        let [tens, ones] = digits;
        let all_digits = tens.is_ascii_digit() && ones.is_ascii_digit();
        all_digits.then(|| Self::from_number((tens - b'0') * 10 + (ones - b'0'))).flatten()
    }
}

impl fmt::Display for RefusalCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:02}", self.number())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_number_of_two_digits_is_a_code_and_comes_back() {
        for number in 0..=99 {
            let code = RefusalCode::from_number(number).unwrap();
            assert_eq!((code.number(), RefusalCode::from_digits(code.digits())), (number, Some(code)));
            assert_eq!(matches!(code, RefusalCode::Other(_)), !RefusalCode::ALL.contains(&code));
        }
        assert_eq!(RefusalCode::from_number(100), None);
        assert_eq!(RefusalCode::from_digits(*b"1x"), None);
    }
}
