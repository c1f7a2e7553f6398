use thiserror::Error;

use super::{ActivationKeys, KeyError};
use crate::model::SerialNumber;
use crate::model::text::{self, TextError};
use crate::model::text_table::{SEPARATORS, TextTable, TextTableRow};

/// What the first line of an activation file says, and nothing else.
pub const FIRST_LINE: &str = "OPCUA.Activation.Ver.1.0";

/// What it starts with in every version.
const FIRST_LINE_START: &str = "OPCUA.Activation.";

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
    /// The controller that the keys were bought for.
    pub serial: SerialNumber,
    /// Its licence key and activation key.
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
    /// What is wrong with the line.
    pub mistake: ActivationMistake,
}

/// What is wrong with a line. Never carries a key.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ActivationMistake {
    /// The line does not have three fields; holds how many it has.
    #[error("it has {0} field{s}; serial number, licence key and activation key are required", s = if *.0 == 1 { "" } else { "s" })]
    Fields(usize),
    /// Fields are separated by another character than in the lines before.
    #[error("its fields are separated by {found:?}, those of the lines before by {expected:?}")]
    Separator {
        /// The separator of this line.
        found: char,
        /// The separator of the lines before.
        expected: char,
    },
    /// A quotation mark is not closed, or a field holds a line end.
    #[error("a quotation mark is not closed, or a field has a line end in it")]
    Quotes,
    /// The first field is not a serial number.
    #[error("the serial number is not one: 1 to 32 letters, digits, \"-\" or \"_\"")]
    Serial,
    /// The second field is not a licence key.
    #[error("licence key: {0}")]
    Licence(KeyError),
    /// The third field is not an activation key.
    #[error("activation key: {0}")]
    Activation(KeyError),
    /// Another line names the serial number as well; none of them is used. Holds the number of that line.
    #[error("the serial number also stands in line {0}")]
    Duplicate(usize),
}

/// Why the bytes are no activation file at all.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ActivationFileError {
    /// The file is larger than [`MAX_ACTIVATION_FILE_BYTES`]; holds its size in bytes.
    #[error("the file has {0} bytes; at most {MAX_ACTIVATION_FILE_BYTES} are read")]
    TooLarge(usize),
    /// The bytes are not text in a known Unicode encoding.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The file holds no line with keys.
    #[error("it is empty; the first line has to be \"{FIRST_LINE}\"")]
    Empty,
    /// What stands there instead, if it is like it; otherwise nothing, since it may be a secret of some other file.
    #[error("the first line is not \"{FIRST_LINE}\"{difference}", difference = difference(.0))]
    FirstLine(String),
}

fn difference(found: &str) -> String {
    let starts = |word: &str| found.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word));
    let what = if found.is_empty() {
        return "; it is something else".to_owned();
    } else if found.eq_ignore_ascii_case(FIRST_LINE) {
        "; upper and lower case differ"
    } else if starts(FIRST_LINE) {
        "; other text follows it"
    } else if starts(FIRST_LINE_START) {
        "; it is of another version"
    } else {
        ""
    };
    format!(" but \"{found}\"{what}")
}

/// What an activation file says about one controller.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ActivationEntry<'a> {
    /// One good line names the controller.
    Line(&'a ActivationLine),
    /// The line of the controller gives no keys.
    Mistake(&'a LineMistake),
    /// The file does not name the controller.
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

    /// What the file says about a controller. Upper and lower case of its serial number do not matter.
    pub fn find(&self, serial: &SerialNumber) -> ActivationEntry<'_> {
        let is_it = |found: &SerialNumber| found.as_str().eq_ignore_ascii_case(serial.as_str());
        if let Some(line) = self.lines.iter().find(|line| is_it(&line.serial)) {
            return ActivationEntry::Line(line);
        }
        match self.mistakes.iter().find(|mistake| mistake.serial.as_ref().is_some_and(is_it)) {
            Some(mistake) => ActivationEntry::Mistake(mistake),
            None => ActivationEntry::Missing,
        }
    }
}

/// Reads an activation file: text as [`text::decode`] takes it, first line [`FIRST_LINE`], then
/// `serial,licence,activation`, one controller a line. What spreadsheets add when they save it does not matter, see
/// [`TextTable::read`]: other separators, quotation marks, empty lines, and empty fields at the end.
pub fn parse(bytes: &[u8]) -> Result<ActivationFile, ActivationFileError> {
    if bytes.len() > MAX_ACTIVATION_FILE_BYTES {
        return Err(ActivationFileError::TooLarge(bytes.len()));
    }
    let table = TextTable::read(&text::decode(bytes)?, usize::MAX);
    let (first, rows) = table.rows.split_first().ok_or(ActivationFileError::Empty)?;
    if first.fields != [FIRST_LINE] {
        return Err(ActivationFileError::FirstLine(shown(first)));
    }
    let mut file = ActivationFile { lines: Vec::new(), mistakes: Vec::new() };
    for row in rows {
        match one(row, table.separator) {
            Ok(line) => file.lines.push(line),
            Err(mistake) => file.mistakes.push(mistake),
        }
    }
    file.refuse_duplicates();
    Ok(file)
}

/// Whether text begins as an activation file of any version, in upper or lower case.
pub fn begins(text: &str) -> bool {
    let first = TextTable::read(text, 1).rows.into_iter().next().and_then(|row| row.fields.into_iter().next());
    first.is_some_and(|field| {
        field.get(..FIRST_LINE_START.len()).is_some_and(|start| start.eq_ignore_ascii_case(FIRST_LINE_START))
    })
}

/// The first field of a first line that is another but like it, short enough for a message.
fn shown(first: &TextTableRow) -> String {
    let field = first.fields.first().map_or("", String::as_str);
    let folded = field.to_ascii_lowercase();
    if !folded.contains("opcua") && !folded.contains("activation") {
        return String::new();
    }
    let mut shown: String = field.chars().filter(|c| !c.is_control()).take(MAX_SHOWN).collect();
    if field.chars().nth(MAX_SHOWN).is_some() || first.fields.len() > 1 {
        shown.push('…');
    }
    shown
}

/// Where the end of the first line is missing, the serial number follows it, and then the keys.
const MAX_SHOWN: usize = FIRST_LINE.len() + 8;

fn one(row: &TextTableRow, separator: char) -> Result<ActivationLine, LineMistake> {
    let (line, fields) = (row.line, &row.fields);
    let is_other = |found: &char| *found != separator && fields.len() == 1 && fields[0].contains(*found);
    let other = SEPARATORS.into_iter().find(is_other);
    let parts: Vec<&str> = match other {
        Some(other) => fields[0].split(other).collect(),
        None => fields.iter().map(String::as_str).collect(),
    };
    // With a separator missing, a key could be part of the first field; with a line end in it, it is of two lines.
    let first = parts.first().filter(|_| parts.len() >= 3 && !row.is_broken);
    let serial = first.and_then(|serial| serial.trim().parse::<SerialNumber>().ok());
    let wrong = |mistake| LineMistake { line, serial: serial.clone(), mistake };
    if row.is_broken {
        return Err(wrong(ActivationMistake::Quotes));
    }
    if let Some(found) = other {
        return Err(wrong(ActivationMistake::Separator { found, expected: separator }));
    }
    let [_, licence, activation] = &fields[..] else {
        return Err(wrong(ActivationMistake::Fields(fields.len())));
    };
    let Some(serial) = serial.clone() else {
        return Err(wrong(ActivationMistake::Serial));
    };
    let licence = licence.parse().map_err(|error| wrong(ActivationMistake::Licence(error)))?;
    let activation = activation.parse().map_err(|error| wrong(ActivationMistake::Activation(error)))?;
    Ok(ActivationLine { line, serial, keys: ActivationKeys { licence, activation } })
}

impl ActivationFile {
    /// A serial number that stands in several good lines has none; upper and lower case are the same.
    fn refuse_duplicates(&mut self) {
        let folded = |serial: &SerialNumber| serial.as_str().to_ascii_uppercase();
        let mut by_serial: std::collections::HashMap<String, Vec<usize>> = std::collections::HashMap::new();
        for line in &self.lines {
            by_serial.entry(folded(&line.serial)).or_default().push(line.line);
        }
        let mut duplicates = Vec::new();
        self.lines.retain(|line| {
            let elsewhere =
                by_serial.get(&folded(&line.serial)).and_then(|lines| lines.iter().find(|other| **other != line.line));
            if let Some(other) = elsewhere {
                let mistake = ActivationMistake::Duplicate(*other);
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

    fn mistakes(body: &str) -> Vec<(usize, ActivationMistake)> {
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
            SAMPLE.replace(',', "\t"),
            SAMPLE.replace('\n', "\r"),
            SAMPLE.replace('\n', ",\n"),
            SAMPLE.replace(',', "\",\"").replace('\n', "\"\n\"").trim_end_matches('"').replacen("OP", "\"OP", 1),
            SAMPLE.replace("1.0\n", "1.0 ,,\n"),
        ] {
            assert_eq!(parse(spelling.as_bytes()).unwrap(), plain, "{spelling:?}");
        }
    }

    /// Cases 03 and 05: the same file after "Save" in Excel, LibreOffice and others.
    #[test]
    fn files_as_spreadsheets_save_them_give_the_same_keys() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
        let read = |name: &str| {
            let file = parse(&std::fs::read(folder.join(name)).unwrap()).unwrap_or_else(|e| panic!("{name}: {e}"));
            assert_eq!(file.mistakes(), [], "{name}");
            file
        };
        let expected = read("03-csv/act-cr-only.csv");
        assert_eq!(expected.lines().len(), 4);
        for name in [
            "03-csv/act-excel-comma.csv",
            "03-csv/act-excel-semicolon.csv",
            "03-csv/act-first-line-trailing-space.csv",
            "03-csv/act-leading-blank-line.csv",
            "03-csv/act-lowercase-serial.csv",
            "03-csv/act-quoted-fields-only.csv",
            "03-csv/act-trailing-comma-rows.csv",
            "05-utf16/act-excel-unicode-text-tab-utf16.txt",
        ] {
            let file = read(name);
            assert_eq!(file.lines().len(), 4, "{name}");
            for line in expected.lines() {
                let ActivationEntry::Line(found) = file.find(&line.serial) else { panic!("{name}: {}", line.serial) };
                assert_eq!(found.keys, line.keys, "{name}");
            }
        }
    }

    #[test]
    fn what_is_no_activation_file_is_refused() {
        let refused = |bytes: &[u8]| parse(bytes).unwrap_err();
        assert_eq!(refused(b""), ActivationFileError::Empty);
        assert_eq!(refused(b"\n,,\n"), ActivationFileError::Empty);
        let mut broken = SAMPLE.as_bytes().to_vec();
        broken.push(0xe7);
        assert_eq!(refused(&broken), ActivationFileError::Text(TextError::NotUtf8 { line: 4 }));
        let large = vec![b' '; MAX_ACTIVATION_FILE_BYTES + 1];
        assert_eq!(refused(&large), ActivationFileError::TooLarge(MAX_ACTIVATION_FILE_BYTES + 1));
    }

    #[test]
    fn a_refused_first_line_shows_what_differs_and_no_key() {
        let told = |first: &str| parse(SAMPLE.replacen(FIRST_LINE, first, 1).as_bytes()).unwrap_err().to_string();
        for (first, shown) in [
            ("OPCUA.Activation.Ver.2.0", " but \"OPCUA.Activation.Ver.2.0\"; it is of another version"),
            ("opcua.activation.ver.1.0", " but \"opcua.activation.ver.1.0\"; upper and lower case differ"),
            ("OPCUA.Activation.Ver.1.0!", " but \"OPCUA.Activation.Ver.1.0!\"; other text follows it"),
            ("OPCUA Activation,x", " but \"OPCUA Activation…\""),
            ("Passw0rd1", "; it is something else"),
            ("", "; it is something else"),
            ("aaaa-aaaa-aaaa-aaaa", "; it is something else"),
        ] {
            let told = told(first);
            assert_eq!(told, format!("the first line is not \"{FIRST_LINE}\"{shown}"));
        }
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
            R7A0000006,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX,new\n\
            R7A0000007,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX,\n\
            \"R7A0000008,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n\
            R7A0000009,aaaa-aaaa-aaaa-aaaa,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n";
        assert_eq!(
            mistakes(body),
            [
                (2, ActivationMistake::Fields(2)),
                (4, ActivationMistake::Serial),
                (5, ActivationMistake::Licence(KeyError::Length { found: 15, expected: 16 })),
                (6, ActivationMistake::Activation(KeyError::Character('！'))),
                (7, ActivationMistake::Separator { found: ';', expected: ',' }),
                (8, ActivationMistake::Fields(1)),
                (9, ActivationMistake::Fields(4)),
                (11, ActivationMistake::Quotes),
            ]
        );
        let text = format!("{FIRST_LINE}\n{body}");
        let file = parse(text.as_bytes()).unwrap();
        let other = file.find(&"R7A0000005".parse().unwrap());
        assert!(matches!(other, ActivationEntry::Mistake(LineMistake { line: 7, .. })), "{other:?}");
        assert!(ActivationMistake::Fields(1).to_string().starts_with("it has 1 field;"));
        assert!(ActivationMistake::Fields(2).to_string().starts_with("it has 2 fields;"));
    }

    #[test]
    fn a_serial_number_that_stands_twice_has_no_keys() {
        let text = format!("{SAMPLE}r7a0000001,cccc-cccc-cccc-cccc,XXXX-XXXX-XXXX-XXXX-XXXX-XXXX\n");
        let file = parse(text.as_bytes()).unwrap();
        let serial = "R7A0000001".parse().unwrap();
        let ActivationEntry::Mistake(mistake) = file.find(&serial) else { panic!("{file:?}") };
        assert_eq!((mistake.line, &mistake.mistake), (2, &ActivationMistake::Duplicate(4)));
        assert_eq!(file.mistakes()[1].mistake, ActivationMistake::Duplicate(2));
        assert!(matches!(file.find(&"R9B0000001".parse().unwrap()), ActivationEntry::Line(_)));
        assert_eq!(file.find(&"TVT0000001".parse().unwrap()), ActivationEntry::Missing);
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
