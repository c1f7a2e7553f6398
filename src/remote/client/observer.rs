use std::fmt::Write as _;
use std::sync::Arc;

/// Which way bytes went.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Direction {
    /// To the controller.
    Sent,
    /// From the controller.
    Received,
}

/// Bytes of an exchange, for a log. Those of a login have asterisks for the password.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Observed {
    /// Which way.
    pub direction: Direction,
    /// What went over the line.
    pub bytes: Vec<u8>,
}

impl Observed {
    /// The bytes as text; control characters as `<06>`.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for byte in &self.bytes {
            let _never = match byte {
                b' '..=b'~' => write!(text, "{}", char::from(*byte)),
                byte => write!(text, "<{byte:02X}>"),
            };
        }
        text
    }

    /// The bytes in hexadecimal, with blanks between them.
    pub fn hex(&self) -> String {
        let bytes: Vec<String> = self.bytes.iter().map(|byte| format!("{byte:02X}")).collect();
        bytes.join(" ")
    }
}

/// Is told of everything that goes over the line. Must not block.
pub type Observer = Arc<dyn Fn(&Observed) + Send + Sync>;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_shown_as_text_and_in_hexadecimal() {
        let observed = Observed { direction: Direction::Sent, bytes: b"\x02G\x00\x03D".to_vec() };
        assert_eq!(observed.text(), "<02>G<00><03>D");
        assert_eq!(observed.hex(), "02 47 00 03 44");
    }
}
