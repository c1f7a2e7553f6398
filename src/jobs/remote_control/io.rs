use crate::remote::{BitNumber, PortNumber, Request};

/// What kind of I/O a number is of. Numbers of different kinds are independent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum IoKind {
    /// Inputs: read only.
    Input,
    /// Outputs: remote commands set them and do not read them.
    Output,
    /// Memory I/O: read and set.
    Memory,
}

impl IoKind {
    /// Every kind, in the order in which they are shown.
    pub const ALL: [Self; 3] = [Self::Input, Self::Output, Self::Memory];

    /// The command that reads sixteen bits; `None` for outputs.
    pub const fn read_word(self, port: PortNumber) -> Option<Request> {
        match self {
            Self::Input => Some(Request::GetIOWord { port }),
            Self::Output => None,
            Self::Memory => Some(Request::GetMemIOWord { port }),
        }
    }

    /// The command that sets a bit; `None` for inputs.
    pub const fn set_bit(self, bit: BitNumber, on: bool) -> Option<Request> {
        match self {
            Self::Input => None,
            Self::Output => Some(Request::SetIO { bit, on }),
            Self::Memory => Some(Request::SetMemIO { bit, on }),
        }
    }

    /// The command that sets eight bits; `None` for inputs.
    pub const fn set_byte(self, port: PortNumber, value: u8) -> Option<Request> {
        match self {
            Self::Input => None,
            Self::Output => Some(Request::SetIOByte { port, value }),
            Self::Memory => Some(Request::SetMemIOByte { port, value }),
        }
    }

    /// The command that sets sixteen bits; `None` for inputs.
    pub const fn set_word(self, port: PortNumber, value: u16) -> Option<Request> {
        match self {
            Self::Input => None,
            Self::Output => Some(Request::SetIOWord { port, value }),
            Self::Memory => Some(Request::SetMemIOWord { port, value }),
        }
    }
}
