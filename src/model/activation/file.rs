use thiserror::Error;

use super::{ActivationKeys, KeyError};
use crate::model::SerialNumber;

/// What the first line of an activation file says, and nothing else.
pub const FIRST_LINE: &str = "OPCUA.Activation.Ver.1.0";

/// What it starts with in every version.
pub const FIRST_LINE_START: &str = "OPCUA.Activation.";

/// A larger file is not one: ten thousand controllers take half of it.
pub const MAX_ACTIVATION_FILE_BYTES: usize = 1024 * 1024;

/// The keys of many controllers, with what was not understood (manual appendix A).
///
/// A mistake costs the controller it concerns, not the others: its line gives no keys, and everything else can be used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ActivationFile {
    lines: Vec<ActivationLine>,
    mistakes: Vec<LineMistake>,
}

/// One good line.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ActivationLine {
    /// Counted from 1, the first line of the file included.
    pub line: usize,
    pub serial: SerialNumber,
    pub keys: ActivationKeys,
}

/// One line that gives no keys.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("line {line}: {mistake}")]
pub struct LineMistake {
    /// Counted from 1, the first line of the file included.
    pub line: usize,
    /// Whom the line is for, as far as that can be read.
    pub serial: Option<SerialNumber>,
    pub mistake: Mistake,
}

/// What is wrong with a line. Never carries a key.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Mistake {
    #[error("it has {0} field{s}; serial number, licence key and activation key are required", s = if *.0 == 1 { "" } else { "s" })]
    Fields(usize),
    #[error("its fields are separated by \"{found}\", those of the lines before by \"{expected}\"")]
    Separator { found: char, expected: char },
    #[error("the serial number is not one: 1 to 32 letters, digits, \"-\" or \"_\"")]
    Serial,
    #[error("licence key: {0}")]
    Licence(KeyError),
    #[error("activation key: {0}")]
    Activation(KeyError),
    /// Which of the lines is meant nobody can know, so none of them is used.
    #[error("the serial number also stands in line {0}")]
    Duplicate(usize),
}

/// Why the bytes are no activation file at all.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ActivationFileError {
    #[error("the file has {0} bytes; at most {MAX_ACTIVATION_FILE_BYTES} are read")]
    TooLarge(usize),
    #[error("line {line} is not UTF-8 text")]
    NotUtf8 { line: usize },
    #[error("the first line is not \"{FIRST_LINE}\"")]
    FirstLine,
}

/// What an activation file says about one controller.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Entry<'a> {
    Line(&'a ActivationLine),
    Mistake(&'a LineMistake),
    Missing,
}

impl ActivationFile {
    /// Good lines, in the file's order; each serial number once.
    pub fn lines(&self) -> &[ActivationLine] {
        &self.lines
    }

    /// In the file's order.
    pub fn mistakes(&self) -> &[LineMistake] {
        &self.mistakes
    }

    pub fn find(&self, serial: &SerialNumber) -> Entry<'_> {
        if let Some(line) = self.lines.iter().find(|line| line.serial == *serial) {
            return Entry::Line(line);
        }
        match self.mistakes.iter().find(|mistake| mistake.serial.as_ref() == Some(serial)) {
            Some(mistake) => Entry::Mistake(mistake),
            None => Entry::Missing,
        }
    }
}

/// Reads an activation file: UTF-8 with or without BOM, lines ending in LF or CRLF, first line exactly
/// [`FIRST_LINE`], then `serial,licence,activation`, one controller a line. Every line is separated by "," or every
/// line by ";". Empty lines and blanks around fields do not matter.
pub fn parse(bytes: &[u8]) -> Result<ActivationFile, ActivationFileError> {
    if bytes.len() > MAX_ACTIVATION_FILE_BYTES {
        return Err(ActivationFileError::TooLarge(bytes.len()));
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let before = bytes.iter().take(error.valid_up_to()).filter(|byte| **byte == b'\n').count();
        ActivationFileError::NotUtf8 { line: before + 1 }
    })?;
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut numbered = (1..).zip(text.lines());
    if numbered.next().map(|(_, line)| line) != Some(FIRST_LINE) {
        return Err(ActivationFileError::FirstLine);
    }
    let mut file = ActivationFile { lines: Vec::new(), mistakes: Vec::new() };
    let mut separator = None;
    for (number, line) in numbered.filter(|(_, line)| !line.trim().is_empty()) {
        match one(number, line, &mut separator) {
            Ok(line) => file.lines.push(line),
            Err(mistake) => file.mistakes.push(mistake),
        }
    }
    file.refuse_duplicates();
    Ok(file)
}

fn one(line: usize, text: &str, separator: &mut Option<char>) -> Result<ActivationLine, LineMistake> {
    let found = text.chars().find(|c| *c == ',' || *c == ';').unwrap_or(',');
    let fields: Vec<&str> = text.split(found).map(str::trim).collect();
    // With a separator missing, a key could be part of the first field.
    let serial = fields.first().filter(|_| fields.len() >= 3).and_then(|serial| serial.parse::<SerialNumber>().ok());
    let wrong = |mistake| LineMistake { line, serial: serial.clone(), mistake };
    let [_, licence, activation] = fields[..] else {
        return Err(wrong(Mistake::Fields(fields.len())));
    };
    let expected = *separator.get_or_insert(found);
    if found != expected {
        return Err(wrong(Mistake::Separator { found, expected }));
    }
    let Some(serial) = serial.clone() else {
        return Err(wrong(Mistake::Serial));
    };
    let licence = licence.parse().map_err(|error| wrong(Mistake::Licence(error)))?;
    let activation = activation.parse().map_err(|error| wrong(Mistake::Activation(error)))?;
    Ok(ActivationLine { line, serial, keys: ActivationKeys { licence, activation } })
}

impl ActivationFile {
    /// A serial number that stands in several good lines has none.
    fn refuse_duplicates(&mut self) {
        let mut by_serial: std::collections::HashMap<SerialNumber, Vec<usize>> = std::collections::HashMap::new();
        for line in &self.lines {
            by_serial.entry(line.serial.clone()).or_default().push(line.line);
        }
        let mut duplicates = Vec::new();
        self.lines.retain(|line| {
            let elsewhere =
                by_serial.get(&line.serial).and_then(|lines| lines.iter().find(|other| **other != line.line));
            if let Some(other) = elsewhere {
                let mistake = Mistake::Duplicate(*other);
                duplicates.push(LineMistake { line: line.line, serial: Some(line.serial.clone()), mistake });
            }
            elsewhere.is_none()
        });
        self.mistakes.append(&mut duplicates);
        self.mistakes.sort_by_key(|mistake| mistake.line);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SAMPLE: &str = "OPCUA.Activation.Ver.1.0\n\
        R7A0000001,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n\
        R9B0000001,bbbb-bbbb-bbbb-bbbb,YYYY-YYYY-YYYY-YYYY-YYYY-YYYY\n";

    fn mistakes(body: &str) -> Vec<(usize, Mistake)> {
        let file = parse(format!("{FIRST_LINE}\n{body}").as_bytes()).unwrap();
        file.mistakes().iter().map(|m| (m.line, m.mistake.clone())).collect()
    }

    #[test]
    fn the_manuals_sample_is_understood_in_every_spelling() {
        let plain = parse(SAMPLE.as_bytes()).unwrap();
        assert_eq!((plain.lines().len(), plain.mistakes().len()), (2, 0));
        assert_eq!(plain.lines()[1].line, 3);
        assert_eq!(plain.lines()[1].keys.licence.to_string(), "bbbb-bbbb-bbbb-bbbb");
        for spelling in [
            format!("\u{feff}{SAMPLE}"),
            SAMPLE.replace('\n', "\r\n"),
            SAMPLE.replace(',', ";"),
            SAMPLE.replace(',', " , "),
            SAMPLE.trim_end().to_owned(),
            format!("{SAMPLE}\n \r\n"),
        ] {
            assert_eq!(parse(spelling.as_bytes()).unwrap(), plain, "{spelling:?}");
        }
    }

    #[test]
    fn what_is_no_activation_file_is_refused() {
        let refused = |bytes: &[u8]| parse(bytes).unwrap_err();
        assert_eq!(refused(b""), ActivationFileError::FirstLine);
        for first in ["OPCUA.Activation.Ver.2.0", "opcua.activation.ver.1.0", " OPCUA.Activation.Ver.1.0", ""] {
            assert_eq!(refused(SAMPLE.replace(FIRST_LINE, first).as_bytes()), ActivationFileError::FirstLine);
        }
        let mut wide: Vec<u8> = vec![0xff, 0xfe];
        wide.extend(SAMPLE.encode_utf16().flat_map(u16::to_le_bytes));
        assert_eq!(refused(&wide), ActivationFileError::NotUtf8 { line: 1 });
        let mut broken = SAMPLE.as_bytes().to_vec();
        broken.push(0xe7);
        assert_eq!(refused(&broken), ActivationFileError::NotUtf8 { line: 4 });
        let large = vec![b' '; MAX_ACTIVATION_FILE_BYTES + 1];
        assert_eq!(refused(&large), ActivationFileError::TooLarge(MAX_ACTIVATION_FILE_BYTES + 1));
    }

    #[test]
    fn every_malformed_line_is_reported_with_its_number() {
        let body = "R7A0000001,aaaa-aaaa-aaaa-aaaa\n\
            \n\
            R7A 000002,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n\
            R7A0000003,aaaa-aaaa-aaaa-aaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n\
            R7A0000004,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXX！\n\
            R7A0000005;aaaa-aaaa-aaaa-aaaa;XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n\
            remember to order more\n\
            R7A0000006,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX,\n\
            R7A0000007,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n";
        assert_eq!(
            mistakes(body),
            [
                (2, Mistake::Fields(2)),
                (4, Mistake::Serial),
                (5, Mistake::Licence(KeyError::Length { found: 15, expected: 16 })),
                (6, Mistake::Activation(KeyError::Character('！'))),
                (7, Mistake::Separator { found: ';', expected: ',' }),
                (8, Mistake::Fields(1)),
                (9, Mistake::Fields(4)),
            ]
        );
        assert!(Mistake::Fields(1).to_string().starts_with("it has 1 field;"));
        assert!(Mistake::Fields(2).to_string().starts_with("it has 2 fields;"));
    }

    #[test]
    fn a_serial_number_that_stands_twice_has_no_keys() {
        let text = format!("{SAMPLE}R7A0000001,cccc-cccc-cccc-cccc,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n");
        let file = parse(text.as_bytes()).unwrap();
        let serial = "R7A0000001".parse().unwrap();
        let Entry::Mistake(mistake) = file.find(&serial) else { panic!("{file:?}") };
        assert_eq!((mistake.line, &mistake.mistake), (2, &Mistake::Duplicate(4)));
        assert_eq!(file.mistakes()[1].mistake, Mistake::Duplicate(2));
        assert!(matches!(file.find(&"R9B0000001".parse().unwrap()), Entry::Line(_)));
        assert_eq!(file.find(&"TVT0000001".parse().unwrap()), Entry::Missing);
    }

    #[test]
    fn a_truncated_or_damaged_file_never_panics_and_never_shows_a_key() {
        for length in 0..SAMPLE.len() {
            if let Ok(file) = parse(&SAMPLE.as_bytes()[..length]) {
                assert!(file.lines().len() <= 2);
            }
        }
        for position in 0..SAMPLE.len() {
            for flip in [0x01, 0x20, 0x80, 0xff] {
                let mut bytes = SAMPLE.as_bytes().to_vec();
                bytes[position] ^= flip;
                let shown = format!("{:?}", parse(&bytes).map(|file| file.mistakes));
                assert!(!shown.contains("XXXX") && !shown.contains("aaaa"), "{shown}");
            }
        }
    }
}
