use std::sync::atomic::{AtomicU8, AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// How far a connection has come. The lower one makes room for others first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u8)]
pub enum ConnectionStage {
    /// A TCP connection, nothing else.
    Accepted,
    /// It speaks the protocol: a TLS handshake, or a secure channel without security.
    Opened,
    /// A secure channel whose client has proved that it has the key of a trusted certificate.
    Proven,
    /// It has a session that is used.
    InSession,
}

/// How far one connection has come, and when it was last used.
#[derive(Debug)]
pub struct Activity {
    since: Instant,
    reached: AtomicU8,
    /// Milliseconds after `since`.
    used: AtomicU64,
}

impl Activity {
    pub fn new() -> Self {
        Self { since: Instant::now(), reached: AtomicU8::new(ConnectionStage::Accepted as u8), used: AtomicU64::new(0) }
    }

    /// The connection has come this far, or further.
    pub fn reached(&self, stage: ConnectionStage) {
        self.reached.fetch_max(stage as u8, Ordering::Relaxed);
    }

    /// The connection is used.
    pub fn used(&self) {
        let after = u64::try_from(self.since.elapsed().as_millis()).unwrap_or(u64::MAX);
        self.used.store(after, Ordering::Relaxed);
    }

    pub fn has_session(&self) -> bool {
        self.reached.load(Ordering::Relaxed) == ConnectionStage::InSession as u8
    }

    /// A session that was not used for longer than `silence` does not count.
    pub fn stage(&self, silence: Duration) -> ConnectionStage {
        let used = Duration::from_millis(self.used.load(Ordering::Relaxed));
        let is_silent = self.since.elapsed().saturating_sub(used) > silence;
        match self.reached.load(Ordering::Relaxed) {
            reached if reached == ConnectionStage::Accepted as u8 => ConnectionStage::Accepted,
            reached if reached == ConnectionStage::Opened as u8 => ConnectionStage::Opened,
            reached if reached == ConnectionStage::InSession as u8 && !is_silent => ConnectionStage::InSession,
            _ => ConnectionStage::Proven,
        }
    }
}
