use std::fmt;
use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;

/// Who is told what happens in a running server; nobody by default.
///
/// Told on the server's own tasks: whoever listens must not take long.
#[derive(Clone, Default)]
pub struct Events(Option<Arc<Listener>>);

type Listener = dyn Fn(Event<'_>) + Send + Sync;

/// One thing that happened. `Display` is one line of English without a secret: an unknown user's name, which may be a
/// password typed into the wrong field, is not part of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event<'a> {
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
    /// No more refusals of this address are told for a while.
    Locked {
        address: IpAddr,
    },
    /// They are again; so many were not.
    Unlocked {
        address: IpAddr,
        left_out: u64,
    },
    /// No more connections of this address are told for a while.
    LeftOut {
        address: IpAddr,
    },
    LoggedIn {
        user: Option<&'a str>,
        policy: &'a str,
        mode: &'a str,
    },
    LoginRefused {
        user: Option<&'a str>,
        reason: &'a str,
    },
}

impl Events {
    pub fn new(listener: impl Fn(Event<'_>) + Send + Sync + 'static) -> Self {
        Self(Some(Arc::new(listener)))
    }

    pub(super) fn tell(&self, event: Event<'_>) {
        if let Some(listener) = &self.0 {
            listener(event);
        }
    }
}

impl fmt::Debug for Events {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.0.is_some() { "Events(told)" } else { "Events(not told)" })
    }
}

impl Event<'_> {
    /// Whether it is something to look at.
    pub fn is_warning(&self) -> bool {
        matches!(
            self,
            Self::TooManyConnections { .. }
                | Self::Refused { .. }
                | Self::Cut { .. }
                | Self::Locked { .. }
                | Self::Unlocked { .. }
                | Self::LoginRefused { .. }
        )
    }
}

impl fmt::Display for Event<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Started { endpoint, policies } => write!(f, "server started: {endpoint}, {policies}"),
            Self::Stopped { endpoint } => write!(f, "server stopped: {endpoint}"),
            Self::Connected { client } => write!(f, "connection from {client} opened"),
            Self::Disconnected { client } => write!(f, "connection from {client} closed"),
            Self::TooManyConnections { client } => write!(f, "connection from {client} refused: too many"),
            Self::Refused { client, reason } => write!(f, "client {client} refused: {reason}"),
            Self::Cut { client, reason } => write!(f, "client {client} cut off: {reason}"),
            Self::Locked { address } => write!(f, "refusals of {address} are too many; left out for a minute"),
            Self::Unlocked { address, left_out } => write!(f, "{left_out} refusals of {address} were left out"),
            Self::LeftOut { address } => write!(f, "connections of {address} are too many; left out for a minute"),
            Self::LoggedIn { user, policy, mode } => {
                write!(f, "session of {} activated: {policy}, {mode}", user.unwrap_or("an anonymous user"))
            }
            Self::LoginRefused { user, reason } => {
                write!(f, "session of {} refused: {reason}", user.unwrap_or("an anonymous or unknown user"))
            }
        }
    }
}
