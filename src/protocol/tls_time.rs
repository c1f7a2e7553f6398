use std::time::{SystemTime, UNIX_EPOCH};

use rustls::pki_types::UnixTime;
use rustls::time_provider::TimeProvider;

/// The time of TLS by this computer's clock; 1970 where the clock stands before it, where the provider of rustls panics.
/// Nothing here depends on it: management identities are pinned, and TLS sessions are not resumed.
#[derive(Debug, Clone, Copy, Default)]
pub struct TlsTime;

impl TimeProvider for TlsTime {
    fn current_time(&self) -> Option<UnixTime> {
        let since_1970 = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        Some(UnixTime::since_unix_epoch(since_1970))
    }
}
