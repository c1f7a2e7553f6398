use std::time::Duration;

use thiserror::Error;

use super::super::address::AddressError;
use super::super::codec::command::CommandCode;
use super::super::codec::end_code::EndCode;
use super::super::codec::frame::{FrameError, TcpRefusal};
use super::super::codec::header::{Endpoint, ShortHeader};
use super::super::codec::response::ResponseError;
use crate::model::Cause;

/// Why a request to a PLC failed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ClientError {
    /// The address of the PLC leads nowhere, or nothing listens there.
    #[error("{to} cannot be reached")]
    Unreachable {
        /// The address.
        to: String,
        /// What the operating system says.
        source: Cause,
    },
    /// No connection in time.
    #[error("{to} accepted no connection within {} ms", after.as_millis())]
    ConnectTimeout {
        /// The address.
        to: String,
        /// How long was waited.
        after: Duration,
    },
    /// The PLC refuses the connection, or closes it because of a frame.
    #[error("the PLC refused: {0}")]
    Refused(TcpRefusal),
    /// The PLC has another node than it was expected to have.
    #[error("the PLC at this address is node {found}, not node {expected}")]
    OtherNode {
        /// The node that the settings name.
        expected: u8,
        /// The node that the PLC names.
        found: u32,
    },
    /// A node cannot be taken from the IP address, which is not an IPv4 address ending in 1 to 254.
    #[error("the node of {0} does not follow from its IP address and has to be given")]
    NodeUnknown(&'static str),
    /// The connection ended.
    #[error("the connection was lost")]
    Lost(#[source] Cause),
    /// No answer in time.
    #[error("no answer within {} ms{}", after.as_millis(), stray_text(*.stray))]
    NoAnswer {
        /// How long was waited.
        after: Duration,
        /// An answer that was not for this request, if one came.
        stray: Option<StrayAnswer>,
    },
    /// The bytes that came are no FINS/TCP.
    #[error("what answers is not FINS/TCP")]
    Frame(#[source] FrameError),
    /// A frame came that has no place here.
    #[error("the PLC sent a frame that is not expected here")]
    UnexpectedFrame,
    /// A message is too short.
    #[error("what answers is not FINS")]
    Header(#[source] ShortHeader),
    /// The response is not one to the command.
    #[error("the PLC's response cannot be read")]
    Response(#[source] ResponseError),
    /// The PLC did not execute the command.
    #[error("the PLC refused command {command}: {end}")]
    EndCode {
        /// The command.
        command: CommandCode,
        /// Why.
        end: EndCode,
        /// Network and node of a relay error.
        relay: Option<(u8, u8)>,
    },
    /// The last attempt to connect failed a short time ago.
    #[error("not connected; the next attempt is made in {} ms", remaining.as_millis())]
    Waiting {
        /// Until the next attempt.
        remaining: Duration,
        /// Why the last attempt failed.
        #[source]
        cause: Box<ClientError>,
    },
    /// There is no connection, and this call does not make one.
    #[error("not connected")]
    NotConnected,
    /// The elements are no words, or no bits, or not in their area.
    #[error("the address does not fit the request")]
    Address(#[source] AddressError),
    /// Words were asked for and bits named, or the other way round.
    #[error("{0}")]
    OtherKind(&'static str),
}

/// An answer that came and was not for the request.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StrayAnswer {
    /// It is for another node.
    ForNode(Endpoint),
    /// It comes from another node.
    FromNode(Endpoint),
    /// It is the answer to an earlier or another request.
    OtherRequest,
}

fn stray_text(stray: Option<StrayAnswer>) -> String {
    match stray {
        None => String::new(),
        Some(StrayAnswer::ForNode(to)) => format!("; an answer for node {} came", to.node),
        Some(StrayAnswer::FromNode(from)) => format!("; an answer from node {} came", from.node),
        Some(StrayAnswer::OtherRequest) => "; an answer to another request came".to_owned(),
    }
}

/// How a write ended that did not succeed.
///
/// A long write is cut into several commands, which are sent in the order of their addresses; the first `done` elements
/// are confirmed by the PLC.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum WriteError {
    /// The elements after the first `done` were not written.
    #[error("not written")]
    NotDone {
        /// Elements that the PLC has confirmed.
        done: usize,
        /// Why the rest was not written.
        source: ClientError,
    },
    /// The command was sent and its answer was lost: whether the PLC has written `uncertain` elements after the first
    /// `done` is not known. What comes after those was not written.
    #[error("it is not known whether it was written")]
    Unknown {
        /// Elements that the PLC has confirmed.
        done: usize,
        /// Elements that may be written or not.
        uncertain: usize,
        /// Why the answer is missing.
        source: ClientError,
    },
}

impl ClientError {
    /// The end code of a PLC that refused, if that is the reason.
    pub const fn end_code(&self) -> Option<EndCode> {
        match self {
            Self::EndCode { end, .. } => Some(*end),
            _ => None,
        }
    }
}

impl WriteError {
    /// Why it was not written, or not confirmed.
    pub const fn client_error(&self) -> &ClientError {
        match self {
            Self::NotDone { source, .. } | Self::Unknown { source, .. } => source,
        }
    }

    /// Whether the PLC may have written elements that it did not confirm.
    pub const fn is_unknown(&self) -> bool {
        matches!(self, Self::Unknown { .. })
    }
}
