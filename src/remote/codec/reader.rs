use super::decode_error::{DecodeError, Fault};

/// Reads the fields of one message, front to back. Every error names the field and its first byte.
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Bytes of the message before `bytes`.
    before: usize,
    field: &'static str,
}

impl<'a> Reader<'a> {
    /// Of the data of a message in which `before` bytes stand before it.
    pub fn new(bytes: &'a [u8], before: usize) -> Self {
        Self { bytes, at: 0, before, field: "data" }
    }

    /// Begins a field.
    pub fn field(&mut self, name: &'static str) {
        self.field = name;
    }

    pub fn error(&self, fault: Fault) -> DecodeError {
        self.error_at(fault, self.at)
    }

    /// `at` counts from the first byte that this reader has.
    pub fn error_at(&self, fault: Fault, at: usize) -> DecodeError {
        DecodeError::new(fault, self.field, self.before + at)
    }

    pub fn position(&self) -> usize {
        self.at
    }

    pub fn is_at_end(&self) -> bool {
        self.at == self.bytes.len()
    }

    /// The next `N` bytes.
    pub fn array<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        let array = self.bytes[self.at..].first_chunk().copied().ok_or_else(|| self.error(Fault::Missing))?;
        self.at += N;
        Ok(array)
    }

    /// The next `count` bytes.
    pub fn take(&mut self, count: usize) -> Result<&'a [u8], DecodeError> {
        let taken = self.bytes[self.at..].get(..count).ok_or_else(|| self.error(Fault::Missing))?;
        self.at += count;
        Ok(taken)
    }

    /// Everything up to the end.
    pub fn rest(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        self.at = self.bytes.len();
        rest
    }

    /// Everything up to the next of `ends`, which stays, or up to the end.
    pub fn until(&mut self, ends: &[u8]) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|byte| ends.contains(byte)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    /// One byte that has to be this one.
    pub fn expect(&mut self, byte: u8) -> Result<(), DecodeError> {
        match self.bytes.get(self.at) {
            Some(found) if *found == byte => {
                self.at += 1;
                Ok(())
            }
            Some(_) => Err(self.error(Fault::Malformed)),
            None => Err(self.error(Fault::Missing)),
        }
    }

    /// Whether this byte comes next; if so, it is taken.
    pub fn skip(&mut self, byte: u8) -> bool {
        let found = self.bytes.get(self.at) == Some(&byte);
        self.at += usize::from(found);
        found
    }

    /// The next parameter of a text, between the comma before it and the next comma or the end. It may be empty.
    pub fn parameter(&mut self) -> Result<&'a [u8], DecodeError> {
        self.expect(b',')?;
        Ok(self.until(b","))
    }

    /// A decimal number of digits only as the next parameter of a text.
    pub fn decimal(&mut self) -> Result<u64, DecodeError> {
        let digits = self.parameter()?;
        let at = self.at - digits.len();
        match digits {
            [] => Err(self.error_at(Fault::Missing, at)),
            digits if !digits.iter().all(u8::is_ascii_digit) => Err(self.error_at(Fault::Malformed, at)),
            digits => number(digits, 10).ok_or_else(|| self.error_at(Fault::OutOfRange, at)),
        }
    }

    /// A hexadecimal number of at most `most` digits as the next parameter of a text.
    pub fn hexadecimal(&mut self, most: usize) -> Result<u64, DecodeError> {
        let digits = self.parameter()?;
        let at = self.at - digits.len();
        match digits {
            [] => Err(self.error_at(Fault::Missing, at)),
            digits if !digits.iter().all(u8::is_ascii_hexdigit) => Err(self.error_at(Fault::Malformed, at)),
            digits => {
                let value = number(digits, 16).filter(|_| digits.len() <= most);
                value.ok_or_else(|| self.error_at(Fault::OutOfRange, at))
            }
        }
    }

    /// Nothing may follow.
    pub fn finish(&mut self) -> Result<(), DecodeError> {
        self.field = "end";
        if self.is_at_end() { Ok(()) } else { Err(self.error(Fault::Trailing)) }
    }
}

fn number(digits: &[u8], radix: u32) -> Option<u64> {
    std::str::from_utf8(digits).ok().and_then(|digits| u64::from_str_radix(digits, radix).ok())
}
