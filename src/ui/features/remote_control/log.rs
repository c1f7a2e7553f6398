use std::collections::VecDeque;
use std::path::{Path, PathBuf};

use crate::jobs::LoggedExchange;
use crate::remote::client::Direction;
use crate::texts::{TextKey as T, Zone};

/// How messages are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LogForm {
    /// As text, with control characters as `<06>`.
    #[default]
    Text,
    /// In hexadecimal.
    Hex,
}

/// What went over the line, up to a limit: the oldest messages are dropped first.
#[derive(Debug)]
pub struct ExchangeLog {
    /// How messages are shown.
    pub form: LogForm,
    /// Messages of the cycles are shown as well.
    pub with_polling: bool,
    messages: VecDeque<LoggedExchange>,
    bytes: usize,
    dropped: u64,
}

/// Messages are at most 8 KiB, and nearly all below 40 bytes.
const MAX_MESSAGES: usize = 5_000;
const MAX_BYTES: usize = 1024 * 1024;

impl Default for ExchangeLog {
    fn default() -> Self {
        Self { form: LogForm::Text, with_polling: true, messages: VecDeque::new(), bytes: 0, dropped: 0 }
    }
}

impl ExchangeLog {
    /// Adds messages, in their order.
    pub fn add(&mut self, messages: Vec<LoggedExchange>) {
        for message in messages {
            self.bytes += message.message.bytes.len();
            self.messages.push_back(message);
        }
        while self.messages.len() > MAX_MESSAGES || self.bytes > MAX_BYTES {
            let Some(oldest) = self.messages.pop_front() else { break };
            self.bytes -= oldest.message.bytes.len();
            self.dropped += 1;
        }
    }

    /// Removes everything.
    pub fn clear(&mut self) {
        *self = Self { form: self.form, with_polling: self.with_polling, ..Self::default() };
    }

    /// The messages that are shown, the oldest first.
    pub fn shown(&self) -> impl DoubleEndedIterator<Item = &LoggedExchange> {
        self.messages.iter().filter(|message| self.with_polling || !message.is_polling)
    }

    /// How many messages there are, and how many older ones were dropped.
    pub fn size(&self) -> (usize, u64) {
        (self.messages.len(), self.dropped)
    }

    /// A line as it is shown.
    pub fn line(&self, exchange: &LoggedExchange, zone: Zone) -> String {
        let bytes = match self.form {
            LogForm::Text => exchange.message.text(),
            LogForm::Hex => exchange.message.hex(),
        };
        format!("{}  {}  {bytes}", zone.time_ms(exchange.at), arrow(exchange))
    }

    /// What is shown as text for other programs: date and time, direction, text and hexadecimal in each line, with tabs
    /// between them.
    pub fn written(&self, zone: Zone) -> String {
        let line = |exchange: &LoggedExchange| {
            let (at, message) = (zone.date_time_ms(exchange.at), &exchange.message);
            format!("{at}\t{}\t{}\t{}\n", arrow(exchange), message.text(), message.hex())
        };
        self.shown().map(line).collect()
    }
}

const fn arrow(exchange: &LoggedExchange) -> &'static str {
    match exchange.message.direction {
        Direction::Sent => "→",
        Direction::Received => "←",
    }
}

/// Where the log is to be saved.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SaveExchanges {
    /// As it is typed.
    pub path: String,
    /// The lines.
    pub(super) text: String,
}

impl SaveExchanges {
    /// Why it cannot be saved yet.
    pub fn incomplete(&self) -> Option<T> {
        self.typed().is_empty().then_some(T::FileRule)
    }

    /// The file. A relative path starts at the workspace.
    pub(super) fn target(&self, root: &Path) -> PathBuf {
        root.join(self.typed())
    }

    /// File managers put quotes around a path they copy.
    fn typed(&self) -> &str {
        self.path.trim().trim_matches('"')
    }
}

#[cfg(test)]
mod tests {
    use chrono::{DateTime, FixedOffset};

    use super::*;
    use crate::remote::client::Observed;

    fn exchange(direction: Direction, bytes: &[u8], is_polling: bool) -> LoggedExchange {
        let message = Observed { direction, bytes: bytes.to_vec() };
        LoggedExchange { at: DateTime::UNIX_EPOCH, is_polling, message }
    }

    #[test]
    fn both_forms_are_copied_whichever_is_shown() {
        let zone = Zone::Fixed(FixedOffset::east_opt(0).unwrap());
        let mut log = ExchangeLog::default();
        let (sent, received) =
            (exchange(Direction::Sent, b"\x02S\x03P", true), exchange(Direction::Received, b"#Stop,0\r\n", false));
        log.add(vec![sent.clone(), received.clone()]);
        assert_eq!(log.line(&sent, zone), "00:00:00.000  →  <02>S<03>P");
        log.form = LogForm::Hex;
        assert_eq!(log.line(&sent, zone), "00:00:00.000  →  02 53 03 50");
        log.with_polling = false;
        assert_eq!(log.shown().collect::<Vec<_>>(), [&received]);
        assert_eq!(log.written(zone), "1970-01-01 00:00:00.000\t←\t#Stop,0<0D><0A>\t23 53 74 6F 70 2C 30 0D 0A\n");
    }

    #[test]
    fn the_oldest_messages_are_dropped() {
        let mut log = ExchangeLog::default();
        log.add((0..MAX_MESSAGES + 3).map(|_| exchange(Direction::Sent, b"x", false)).collect());
        assert_eq!(log.size(), (MAX_MESSAGES, 3));
        log.add(vec![exchange(Direction::Received, &vec![b'y'; MAX_BYTES], false)]);
        assert_eq!(log.size(), (1, MAX_MESSAGES as u64 + 3));
        log.clear();
        assert_eq!(log.size(), (0, 0));
    }
}
