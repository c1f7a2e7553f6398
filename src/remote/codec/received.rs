use zeroize::Zeroize as _;

/// Bytes that have come and are not yet read; bounded, and wiped when they are dropped.
#[derive(Debug, Default)]
pub(super) struct Received {
    bytes: Vec<u8>,
    overflowed: bool,
}

/// Several messages, and what one read brings.
const MAX_RECEIVED: usize = 16 * 1024;

impl Received {
    /// Takes bytes in. Beyond the limit they are dropped, and [`Received::overflowed`] tells it.
    pub fn add(&mut self, bytes: &[u8]) {
        let room = MAX_RECEIVED - self.bytes.len();
        self.overflowed |= bytes.len() > room;
        self.bytes.extend_from_slice(&bytes[..bytes.len().min(room)]);
    }

    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Drops the first `count` bytes.
    pub fn drop_front(&mut self, count: usize) {
        let count = count.min(self.bytes.len());
        let left = self.bytes.len() - count;
        self.bytes.copy_within(count.., 0);
        self.bytes[left..].zeroize();
        self.bytes.truncate(left);
    }

    /// Drops everything that is no beginning of a message.
    pub fn skip_to(&mut self, beginnings: &[u8]) {
        let at = self.bytes.iter().position(|byte| beginnings.contains(byte));
        self.drop_front(at.unwrap_or(self.bytes.len()));
    }

    /// Whether bytes were dropped since the last call; everything that is left is dropped with them.
    pub fn overflowed(&mut self) -> bool {
        let overflowed = std::mem::take(&mut self.overflowed);
        if overflowed {
            self.drop_front(self.bytes.len());
        }
        overflowed
    }
}

impl Drop for Received {
    fn drop(&mut self) {
        self.bytes.zeroize();
    }
}
