use std::fmt;
use std::net::SocketAddr;
use std::sync::Arc;

use crate::virtual_controller::cell::SpelFinding;
use crate::virtual_controller::connection_limits::SourceNetwork;

/// Who is told what happens in a running server; nobody by default.
///
/// Called on the server's own tasks: a listener must return at once.
#[derive(Clone, Default)]
pub struct ServerEvents(Option<Arc<Listener>>);

type Listener = dyn Fn(ServerEvent<'_>) + Send + Sync;

/// One thing that happened. `Display` is one line of English without a secret: an unknown user's name, which may be a
/// password typed into the wrong field, is not part of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ServerEvent<'a> {
    Started {
        endpoint: &'a str,
        policies: &'a str,
    },
    Stopped {
        endpoint: &'a str,
    },
    Connected {
        client: SocketAddr,
    },
    Disconnected {
        client: SocketAddr,
    },
    TooManyConnections {
        client: SocketAddr,
    },
    /// A client did not get, or did not keep, a secure channel or a session.
    Refused {
        client: SocketAddr,
        reason: &'a str,
    },
    /// An open connection was ended by a change of trust.
    Cut {
        client: SocketAddr,
        reason: &'a str,
    },
    /// No more refusals of this source are told for a minute.
    RefusalsQuiet {
        source: SourceNetwork,
    },
    /// No more connections of this source are told for a minute.
    ConnectionsQuiet {
        source: SourceNetwork,
    },
    /// So many lines about this source were not told.
    LinesLeftOut {
        source: SourceNetwork,
        count: u64,
    },
    /// A line of the project's variables is not shown in the address space.
    VariableNotShown {
        finding: &'a SpelFinding,
    },
    /// The project's variables cannot be read.
    VariablesUnreadable {
        reason: &'a str,
    },
    LoggedIn {
        user: Option<&'a str>,
        policy: &'a str,
        mode: &'a str,
    },
    LoginRefused {
        client: Option<SocketAddr>,
        user: Option<&'a str>,
        reason: &'a str,
    },
}

impl ServerEvents {
    pub fn new(listener: impl Fn(ServerEvent<'_>) + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(listener)))
    }

    pub(in super::super) fn tell(&self, event: ServerEvent<'_>) {
        if let Some(listener) = &self.0 {
            listener(event);
        }
    }
}

impl fmt::Debug for ServerEvents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "Events(told)" } else { "Events(not told)" })
    }
}

impl ServerEvent<'_> {
    /// Whether it is something to look at.
    pub fn is_warning(&self) -> bool {
        matches!(
            self,
            Self::TooManyConnections { .. }
                | Self::Refused { .. }
                | Self::Cut { .. }
                | Self::RefusalsQuiet { .. }
                | Self::LinesLeftOut { .. }
                | Self::LoginRefused { .. }
                | Self::VariableNotShown { .. }
                | Self::VariablesUnreadable { .. }
        )
    }

    /// Whether any peer can make it happen, and as often as it likes: one that has neither the key of a trusted
    /// certificate nor a password.
    pub fn is_open_to_strangers(&self) -> bool {
        match self {
            Self::Started { .. }
            | Self::Stopped { .. }
            | Self::Cut { .. }
            | Self::VariableNotShown { .. }
            | Self::VariablesUnreadable { .. } => false,
            Self::LoggedIn { user, mode, .. } => user.is_none() && *mode == "None",
            Self::Connected { .. }
            | Self::Disconnected { .. }
            | Self::TooManyConnections { .. }
            | Self::Refused { .. }
            | Self::RefusalsQuiet { .. }
            | Self::ConnectionsQuiet { .. }
            | Self::LinesLeftOut { .. }
            | Self::LoginRefused { .. } => true,
        }
    }
}

impl fmt::Display for ServerEvent<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Started { endpoint, policies } => write!(f, "server started: {endpoint}, {policies}"),
            Self::Stopped { endpoint } => write!(f, "server stopped: {endpoint}"),
            Self::Connected { client } => write!(f, "connection from {client} opened"),
            Self::Disconnected { client } => write!(f, "connection from {client} closed"),
            Self::TooManyConnections { client } => write!(f, "connection from {client} refused: too many"),
            Self::Refused { client, reason } => write!(f, "client {client} refused: {reason}"),
            Self::Cut { client, reason } => write!(f, "client {client} cut off: {reason}"),
            Self::RefusalsQuiet { source } => write!(f, "refusals of {source} are too many; left out for a minute"),
            Self::ConnectionsQuiet { source } => {
                write!(f, "connections of {source} are too many; left out for a minute")
            }
            Self::LinesLeftOut { source, count } => write!(f, "{count} lines about {source} were left out"),
            Self::VariableNotShown { finding } => write!(f, "variables: {finding}"),
            Self::VariablesUnreadable { reason } => write!(f, "variables cannot be read: {reason}"),
            Self::LoggedIn { user, policy, mode } => {
                write!(f, "session of {} activated: {policy}, {mode}", user.unwrap_or("an anonymous user"))
            }
            Self::LoginRefused { client, user, reason } => {
                write!(f, "session of {} refused: {reason}", user.unwrap_or("an anonymous or unknown user"))?;
                client.map_or(Ok(()), |client| write!(f, ", from {client}"))
            }
        }
    }
}
