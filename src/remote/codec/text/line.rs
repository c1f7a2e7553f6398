use zeroize::Zeroizing;

use crate::remote::codec::received::Received;

/// What ends a line; set in the controller. Reading understands all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Terminator {
    /// CR LF, the controller's default.
    #[default]
    CrLf,
    /// CR.
    Cr,
    /// LF.
    Lf,
}

impl Terminator {
    /// The bytes.
    pub const fn bytes(self) -> &'static [u8] {
        match self {
            Self::CrLf => b"\r\n",
            Self::Cr => b"\r",
            Self::Lf => b"\n",
        }
    }
}

/// The longest request, in bytes: a command of Execute and what stands around it is shorter.
pub(super) const MAX_REQUEST: usize = 1024;
/// The longest answer, in bytes: the result of Execute is 4060.
pub(super) const MAX_ANSWER: usize = 8192;

/// Splits bytes that come in pieces of any size into lines.
#[derive(Debug)]
pub(super) struct Lines {
    received: Received,
    most: usize,
    /// The line is too long: what comes of it is dropped.
    dropping: bool,
    /// A LF that comes next belongs to the CR before it.
    after_cr: bool,
}

/// A line that was longer than allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct TooLong;

impl Lines {
    /// Of at most so many bytes.
    pub fn new(most: usize) -> Self {
        Self { received: Received::default(), most, dropping: false, after_cr: false }
    }

    pub fn add(&mut self, bytes: &[u8]) {
        self.received.add(bytes);
    }

    /// The next line without its end. Empty lines are left out.
    pub fn next(&mut self) -> Option<Result<Zeroizing<Vec<u8>>, TooLong>> {
        if self.received.overflowed() {
            self.dropping = true;
        }
        loop {
            if self.after_cr && !self.received.bytes().is_empty() {
                self.after_cr = false;
                if self.received.bytes().starts_with(b"\n") {
                    self.received.drop_front(1);
                }
            }
            let bytes = self.received.bytes();
            let Some(end) = bytes.iter().position(|byte| matches!(byte, b'\r' | b'\n')) else {
                if bytes.len() > self.most {
                    self.dropping = true;
                }
                if self.dropping {
                    self.received.drop_front(self.received.bytes().len());
                }
                return None;
            };
            self.after_cr = bytes[end] == b'\r';
            let is_too_long = std::mem::take(&mut self.dropping) || end > self.most;
            let line = if is_too_long { Err(TooLong) } else { Ok(Zeroizing::new(bytes[..end].to_vec())) };
            self.received.drop_front(end + 1);
            if line.as_ref().is_ok_and(|line| line.is_empty()) {
                continue;
            }
            return Some(line);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(pieces: &[&[u8]]) -> Vec<Result<Vec<u8>, TooLong>> {
        let mut lines = Lines::new(8);
        let mut found = Vec::new();
        for piece in pieces {
            lines.add(piece);
            found.extend(std::iter::from_fn(|| lines.next()).map(|line| line.map(|line| line.to_vec())));
        }
        found
    }

    #[test]
    fn every_line_end_is_understood_in_pieces_of_any_size() {
        let expected = [Ok(b"one".to_vec()), Ok(b"two".to_vec()), Ok(b"three".to_vec()), Ok(b"four".to_vec())];
        let text = b"one\r\ntwo\rthree\n\r\n\nfour\n";
        assert_eq!(lines(&[text]), expected);
        let bytes: Vec<&[u8]> = text.chunks(1).collect();
        assert_eq!(lines(&bytes), expected);
        assert_eq!(lines(&[b"no end"]), []);
    }

    #[test]
    fn a_long_line_is_dropped_to_its_end() {
        assert_eq!(
            lines(&[b"12345678\n123456789\nok\n"]),
            [Ok(b"12345678".to_vec()), Err(TooLong), Ok(b"ok".to_vec())]
        );
        assert_eq!(lines(&[b"123456789", b"0", b"\r\nok\r\n"]), [Err(TooLong), Ok(b"ok".to_vec())]);
        let flood = vec![b'x'; 100_000];
        assert_eq!(lines(&[&flood, &flood, b"\nok\n"]), [Err(TooLong), Ok(b"ok".to_vec())]);
    }
}
