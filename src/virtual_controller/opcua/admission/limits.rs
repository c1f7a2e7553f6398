use std::time::Duration;

use crate::virtual_controller::connection_limits::ConnectionLimits;

/// What peers may take of a server before, and without, being let in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct AdmissionLimits {
    /// Connections: far more than the sessions a server takes, since discovery needs connections too.
    pub(super) slots: ConnectionLimits,
    /// From the first byte of a connection to the end of its first OpenSecureChannel request.
    pub(super) open: Duration,
    /// From there to a session.
    pub(super) session: Duration,
    /// A peer that takes no data for so long is dropped.
    pub(super) stall: Duration,
    /// What a peer gets to read the last words.
    pub(super) linger: Duration,
    /// The largest chunk, which is also what the server offers in its Acknowledge.
    pub(super) chunk: usize,
}

impl Default for AdmissionLimits {
    fn default() -> Self {
        Self {
            slots: ConnectionLimits {
                connections: 100,
                per_source: 50,
                // As long as a session lives.
                silence: Duration::from_millis(super::super::endpoints::SESSION_TIMEOUT_MS),
            },
            open: Duration::from_secs(5),
            session: Duration::from_secs(60),
            stall: Duration::from_secs(10),
            linger: Duration::from_secs(1),
            chunk: 65_535,
        }
    }
}
