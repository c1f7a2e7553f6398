use serde::{Deserialize, Serialize};

/// A piece of the server log (manual 6.3).
///
/// `GET /v1/log` gives the end of the log, `GET /v1/log?from=N` what stands from byte N on; at most
/// [`MAX_LOG_CHUNK_BYTES`] of it, in whole lines where that is possible. Without a log the text is empty and the size 0.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct LogChunk {
    /// Bytes of the whole log.
    pub size: u64,
    /// The byte `text` begins at.
    pub from: u64,
    /// The byte after the last of `text`: where to go on; [`LogChunk::size`] at the end.
    pub next: u64,
    pub text: String,
}

pub const MAX_LOG_CHUNK_BYTES: usize = 256 * 1024;
