use std::collections::BTreeMap;

use super::io::IoKind;
use crate::model::text_table::TextTable;
use crate::model::untrusted_text::one_line;
use crate::model::{ErrorCode, Problem, text};

/// The largest file of labels, in bytes.
pub const MAX_LABEL_FILE_BYTES: usize = 4 * 1024 * 1024;

/// Labels of I/O bits, read from a file that a spreadsheet saves: kind, number and label in each line, such as
/// `input,0,Door closed`. The kind is `input`, `output` or `memory`; a heading may stand above.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct IoLabels {
    labels: BTreeMap<(IoKind, u16), String>,
    /// Lines that hold no label, counted from 1. A heading is none of them.
    pub skipped: Vec<usize>,
}

impl IoLabels {
    /// Reads a file, as UTF-8 or UTF-16. Of two labels for a bit, the later one counts.
    ///
    /// Errors: [`ErrorCode::BadIoLabels`] if it is no text, or if no line holds a label.
    pub fn read(bytes: &[u8]) -> Result<Self, Problem> {
        let text = text::decode(bytes).map_err(|error| Problem::with_detail(ErrorCode::BadIoLabels, error))?;
        let mut found = Self::default();
        for (index, row) in TextTable::read(&text, MAX_ROWS).rows.into_iter().enumerate() {
            match label_of(&row.fields) {
                Some((kind, bit, label)) => {
                    found.labels.insert((kind, bit), label);
                }
                None if index == 0 => {}
                None => found.skipped.push(row.line),
            }
        }
        if found.labels.is_empty() {
            return Err(ErrorCode::BadIoLabels.into());
        }
        Ok(found)
    }

    /// The label of a bit.
    pub fn label(&self, kind: IoKind, bit: u16) -> Option<&str> {
        self.labels.get(&(kind, bit)).map(String::as_str)
    }

    /// How many bits have one.
    pub fn count(&self) -> usize {
        self.labels.len()
    }
}

fn label_of(fields: &[String]) -> Option<(IoKind, u16, String)> {
    let [kind, number, label, ..] = fields else { return None };
    let kind = match kind.to_ascii_lowercase().as_str() {
        "input" | "in" => IoKind::Input,
        "output" | "out" => IoKind::Output,
        "memory" | "mem" => IoKind::Memory,
        _ => return None,
    };
    let label = one_line(label, MAX_LABEL_CHARS);
    (!label.is_empty()).then_some((kind, number.parse().ok()?, label))
}

/// Every bit of every kind, and a heading.
const MAX_ROWS: usize = 3 * 65_536 + 1;
const MAX_LABEL_CHARS: usize = 60;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_read_as_spreadsheets_save_them() {
        let labels = IoLabels::read(
            "Kind;Number;Label\r\nInput;0;Door closed\r\nOUT;3;Gripper\r\nmem;512;\"Ready; go\"\r\n".as_bytes(),
        );
        let labels = labels.unwrap();
        assert_eq!(labels.label(IoKind::Input, 0), Some("Door closed"));
        assert_eq!(labels.label(IoKind::Output, 3), Some("Gripper"));
        assert_eq!(labels.label(IoKind::Memory, 512), Some("Ready; go"));
        assert_eq!(labels.label(IoKind::Output, 0), None);
        assert_eq!((labels.count(), labels.skipped.len()), (3, 0));
    }

    #[test]
    fn lines_without_a_label_are_counted_and_the_later_label_counts() {
        let labels = IoLabels::read(b"input,1,First\ninput,70000,Far\nvalve,1,x\ninput,2\n\ninput,1,Second\n").unwrap();
        assert_eq!(labels.skipped, [2, 3, 4]);
        assert_eq!(labels.label(IoKind::Input, 1), Some("Second"));
    }

    #[test]
    fn a_file_without_labels_is_refused() {
        for bytes in [&b""[..], b"name,address\nPaint,192.168.0.1\n", b"input,1,M\xfcller"] {
            let refused = IoLabels::read(bytes).map_err(|problem| problem.code);
            assert_eq!(refused, Err(ErrorCode::BadIoLabels));
        }
    }
}
