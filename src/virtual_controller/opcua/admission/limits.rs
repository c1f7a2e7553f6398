use std::time::Duration;

/// What peers may take of a server before, and without, being let in.
///
/// A connection without a session is the first to go: when there are too many, the oldest one makes room for a new one
/// (OPC 10000-4 §5.5.2.1), so that whoever only holds connections open keeps nobody out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Limits {
    /// All connections at once. Far more than the sessions a server takes, since discovery needs connections too.
    pub(super) connections: usize,
    /// Connections of one address.
    pub(super) per_address: usize,
    /// From the first byte of a connection to the end of its first OpenSecureChannel request.
    pub(super) open: Duration,
    /// From there to a session.
    pub(super) session: Duration,
    /// How long a connection with a session may say nothing until it counts as one without. As long as a session lives.
    pub(super) silence: Duration,
    /// A peer that takes no data for so long is dropped.
    pub(super) stall: Duration,
    /// What a peer gets to read the last words.
    pub(super) linger: Duration,
    /// The largest chunk, which is also what the server offers in its Acknowledge.
    pub(super) chunk: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            connections: 100,
            per_address: 50,
            open: Duration::from_secs(5),
            session: Duration::from_secs(60),
            silence: Duration::from_millis(super::super::endpoints::SESSION_TIMEOUT_MS),
            stall: Duration::from_secs(10),
            linger: Duration::from_secs(1),
            chunk: 65_535,
        }
    }
}
