use std::fmt;
use std::net::SocketAddr;
use std::sync::Arc;

use crate::virtual_controller::cell::SpelFinding;
use crate::virtual_controller::connection_limits::SourceNetwork;

/// Receives the events of a running server. By default there is no receiver.
///
/// Called on the server's own tasks: a listener must return at once.
#[derive(Clone, Default)]
pub struct ServerEvents(Option<Arc<Listener>>);

type Listener = dyn Fn(ServerEvent<'_>) + Send + Sync;

/// One thing that happened. `Display` is one line of English without a secret: an unknown user's name, which may be a
/// password typed into the wrong field, is not part of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ServerEvent<'a> {
    /// The server listens.
    Started {
        /// Its URL.
        endpoint: &'a str,
        /// The security policies it offers, separated by commas.
        policies: &'a str,
    },
    /// The server does not listen any more.
    Stopped {
        /// Its URL.
        endpoint: &'a str,
    },
    /// A client has connected.
    Connected {
        /// Where it connected from.
        client: SocketAddr,
    },
    /// The connection of a client has ended.
    Disconnected {
        /// Where it connected from.
        client: SocketAddr,
    },
    /// A client was refused because no connection is free.
    TooManyConnections {
        /// Where it connected from.
        client: SocketAddr,
    },
    /// A client did not get, or did not keep, a secure channel or a session.
    Refused {
        /// Where it connected from.
        client: SocketAddr,
        /// Why, in English.
        reason: &'a str,
    },
    /// An open connection was ended by a change of trust.
    Cut {
        /// Where it connected from.
        client: SocketAddr,
        /// Why, in English.
        reason: &'a str,
    },
    /// No more refusals of this source are reported for a minute.
    RefusalsQuiet {
        /// The address or network.
        source: SourceNetwork,
    },
    /// No more connections of this source are reported for a minute.
    ConnectionsQuiet {
        /// The address or network.
        source: SourceNetwork,
    },
    /// So many lines about this source were left out.
    LinesLeftOut {
        /// The address or network.
        source: SourceNetwork,
        /// How many lines.
        count: u64,
    },
    /// A line of the project's variables is not shown in the address space.
    VariableNotShown {
        /// Why it is not shown.
        finding: &'a SpelFinding,
    },
    /// The project's variables cannot be read.
    VariablesUnreadable {
        /// Why, in English.
        reason: &'a str,
    },
    /// A user has logged in.
    LoggedIn {
        /// The user; `None` without a user name.
        user: Option<&'a str>,
        /// The security policy of the channel.
        policy: &'a str,
        /// The message security mode of the channel.
        mode: &'a str,
    },
    /// A login was refused.
    LoginRefused {
        /// Where the client connected from, if that is known.
        client: Option<SocketAddr>,
        /// The user, if one of that name exists.
        user: Option<&'a str>,
        /// Why, in English.
        reason: &'a str,
    },
}

impl ServerEvents {
    /// Calls `listener` for each event.
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
