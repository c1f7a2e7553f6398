use super::fault::Fault;
use super::frame::MessageHeader;

/// Bytes on their way in one direction, chunk by chunk: first those that may go on, then those still to be looked at.
#[derive(Debug, Default)]
pub(in super::super) struct ChunkBuffer {
    bytes: Vec<u8>,
    /// How many at the front may go on.
    good: usize,
    /// How many after `good` belong to a chunk that may go on.
    passing: usize,
}

impl ChunkBuffer {
    pub(in super::super) fn new(bytes: Vec<u8>) -> Self {
        Self { bytes, good: 0, passing: 0 }
    }

    /// The header of the next chunk to look at, once what is before it was let pass. `None` if it is not there yet.
    pub(in super::super) fn next(&mut self, max_chunk: usize) -> Result<Option<MessageHeader>, Fault> {
        let here = self.passing.min(self.bytes.len() - self.good);
        self.good += here;
        self.passing -= here;
        if self.passing > 0 { Ok(None) } else { MessageHeader::parse(self.rest(), max_chunk) }
    }

    /// From the header of the next chunk on.
    pub(in super::super) fn rest(&self) -> &[u8] {
        &self.bytes[self.good..]
    }

    /// The next chunk, if all of it is here.
    pub(in super::super) fn chunk(&self, header: MessageHeader) -> Option<&[u8]> {
        self.rest().get(..header.size)
    }

    /// Lets the next chunk pass, here or not.
    pub(in super::super) fn pass(&mut self, header: MessageHeader) {
        self.passing = header.size;
    }

    /// Puts another chunk in the place of the next one, which is here, and lets it pass.
    pub(in super::super) fn replace(&mut self, header: MessageHeader, chunk: Vec<u8>) {
        self.passing = chunk.len();
        self.bytes.splice(self.good..self.good + header.size, chunk);
    }

    /// What may go on.
    pub(in super::super) fn good(&self) -> &[u8] {
        &self.bytes[..self.good]
    }

    /// It has gone on.
    pub(in super::super) fn sent(&mut self) {
        self.bytes.drain(..self.good);
        self.good = 0;
    }

    /// Whether the receiver has seen whole chunks only, once what may go on has gone on.
    pub(in super::super) fn is_between_chunks(&self) -> bool {
        self.passing == 0
    }

    /// Where to read more into.
    pub(in super::super) fn room(&mut self) -> &mut Vec<u8> {
        self.bytes.reserve(READ_AT_LEAST);
        &mut self.bytes
    }
}

const READ_AT_LEAST: usize = 4096;

#[cfg(test)]
mod tests {
    use super::*;

    fn chunk(fill: u8, size: u32) -> Vec<u8> {
        let mut chunk = b"MSGF".to_vec();
        chunk.extend(size.to_le_bytes());
        chunk.resize(size as usize, fill);
        chunk
    }

    /// What arrives behind a chunk_buffer that lets everything pass, fed with pieces of this size.
    fn through(bytes: &[u8], piece: usize) -> Vec<u8> {
        let (mut chunk_buffer, mut out) = (ChunkBuffer::default(), Vec::new());
        for piece in bytes.chunks(piece) {
            chunk_buffer.room().extend(piece);
            while let Some(header) = chunk_buffer.next(1000).unwrap() {
                chunk_buffer.pass(header);
            }
            out.extend(chunk_buffer.good());
            chunk_buffer.sent();
        }
        assert!(chunk_buffer.is_between_chunks());
        out
    }

    #[test]
    fn chunks_pass_however_the_network_cuts_them() {
        let bytes = [chunk(1, 24), chunk(2, 1000), chunk(3, 30)].concat();
        for piece in [1, 7, 8, 9, 24, 25, 500, 2000] {
            assert_eq!(through(&bytes, piece), bytes, "{piece}");
        }
    }

    #[test]
    fn nothing_passes_before_its_header_was_seen() {
        let mut chunk_buffer = ChunkBuffer::new(chunk(1, 24)[..7].to_vec());
        assert_eq!(chunk_buffer.next(1000), Ok(None));
        assert_eq!(chunk_buffer.good(), b"");
        chunk_buffer.room().extend(&chunk(1, 24)[7..20]);
        let header = chunk_buffer.next(1000).unwrap().unwrap();
        assert_eq!((header.size, chunk_buffer.chunk(header)), (24, None));
        assert_eq!(chunk_buffer.good(), b"");
        chunk_buffer.pass(header);
        assert_eq!(chunk_buffer.next(1000), Ok(None));
        assert_eq!(chunk_buffer.good().len(), 20);
        assert!(!chunk_buffer.is_between_chunks());
    }

    #[test]
    fn a_chunk_can_be_replaced_by_another_one() {
        let mut chunk_buffer = ChunkBuffer::new([chunk(1, 24), chunk(2, 40), chunk(3, 24)].concat());
        let first = chunk_buffer.next(1000).unwrap().unwrap();
        chunk_buffer.pass(first);
        let second = chunk_buffer.next(1000).unwrap().unwrap();
        assert_eq!(chunk_buffer.chunk(second), Some(&*chunk(2, 40)));
        chunk_buffer.replace(second, chunk(9, 33));
        let third = chunk_buffer.next(1000).unwrap().unwrap();
        chunk_buffer.pass(third);
        assert_eq!(chunk_buffer.next(1000), Ok(None));
        assert_eq!(chunk_buffer.good(), [chunk(1, 24), chunk(9, 33), chunk(3, 24)].concat());
    }
}
