use std::time::Duration;

use super::super::codec::end_code::EndCode;
use super::super::codec::frame::TcpRefusal;

/// What goes wrong in a simulated PLC. All off at the beginning; each may be switched while clients are connected.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Faults {
    /// Commands are neither executed nor answered, as behind a pulled cable.
    pub is_silent: bool,
    /// Commands are executed and not answered.
    pub loses_answers: bool,
    /// Every answer comes so much later.
    pub delay: Option<Duration>,
    /// Answers name another node than that of the client.
    pub answers_wrong_node: bool,
    /// Every command is refused with this end code.
    pub end_code: Option<EndCode>,
    /// Over TCP, an answer ends after so many bytes and the connection is closed; over UDP, the datagram is so short.
    pub cuts_after: Option<usize>,
    /// Connections over TCP are refused with this error.
    pub refuses: Option<TcpRefusal>,
}
