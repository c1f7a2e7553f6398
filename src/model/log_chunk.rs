use serde::{Deserialize, Serialize};

/// A piece of the server log (manual 6.3). A controller without a log gives an empty text and the size 0.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct LogChunk {
    /// Size of the whole log in bytes.
    pub size: u64,
    /// Offset in the log of the first byte of `text`.
    pub from: u64,
    /// Offset of the byte after `text`: where the next piece begins; [`LogChunk::size`] at the end.
    pub next: u64,
    /// Whole lines, unless one line alone is longer than a piece.
    pub text: String,
}

impl LogChunk {
    /// The longest piece, in bytes of the log.
    pub const MAX_BYTES: usize = 256 * 1024;
}
