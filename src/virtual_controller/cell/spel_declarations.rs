//! The declarations of SPEL variables in a project file (manual 4.2): `Global Preserve <type> <name>[, <name>…]`, one
//! statement a line, `'` begins a comment.

use std::collections::HashSet;
use std::fmt;

use thiserror::Error;

use super::spel_value::{MAX_SPEL_VARIABLES, SPEL_PREFIX, SpelDeclaration, SpelType};

/// The variables of a project file that the address space shows, and what was not taken.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SpelDeclarations {
    /// At most 256, in the order of the file.
    pub variables: Vec<SpelDeclaration>,
    /// At most [`MAX_FINDINGS`], in the order of the file.
    pub findings: Vec<SpelFinding>,
}

/// Findings kept of one file; the last one then says that there are more.
pub const MAX_FINDINGS: usize = 50;

/// Bytes of a project file that are read.
pub const MAX_DECLARATION_BYTES: usize = 64 * 1024;

/// Characters of a name in SPEL+.
const MAX_NAME: usize = 32;

/// Something in a project file that is not shown in the address space.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SpelFinding {
    /// The line, from 1 on.
    pub line: usize,
    /// Why not.
    pub mistake: SpelMistake,
}

impl fmt::Display for SpelFinding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.mistake)
    }
}

/// Why a declaration is not shown.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SpelMistake {
    /// Not `Global …`.
    #[error("not a Global declaration")]
    NotGlobal,
    /// `Global` without `Preserve`.
    #[error("not a backup variable: Preserve is missing")]
    NotPreserved,
    /// No data type of SPEL+.
    #[error("{0} is not a data type")]
    UnknownType(String),
    /// Nothing after the data type, or nothing between two commas.
    #[error("a name is missing")]
    NoName,
    /// Not a letter followed by at most 31 letters, digits and underscores.
    #[error("{0} is not a name")]
    BadName(String),
    /// The name does not begin with `OPCUA_`.
    #[error("{0} does not begin with OPCUA_")]
    NoPrefix(String),
    /// Arrays are not supported.
    #[error("{0} is an array")]
    Array(String),
    /// The name was declared before.
    #[error("{0} is declared twice")]
    Duplicate(String),
    /// More than 256 variables.
    #[error("{0} is beyond the limit of 256 variables")]
    TooMany(String),
    /// Not UTF-8.
    #[error("not a text in UTF-8")]
    NotText,
    /// The file has more than [`MAX_DECLARATION_BYTES`]; nothing from this line on was read.
    #[error("the file is too large; this and the following lines are not read")]
    TooLarge,
    /// More than [`MAX_FINDINGS`].
    #[error("more mistakes follow")]
    More,
}

impl SpelDeclarations {
    /// Reads the content of a project file. Bytes beyond [`MAX_DECLARATION_BYTES`] are not looked at.
    pub fn parse(content: &[u8]) -> Self {
        let mut found = Self::default();
        let mut names = HashSet::new();
        let is_cut = content.len() > MAX_DECLARATION_BYTES;
        let content = &content[..content.len().min(MAX_DECLARATION_BYTES)];
        let mut lines: Vec<&[u8]> = content.split(|byte| *byte == b'\n').collect();
        let cut = if is_cut { lines.pop() } else { None };
        for (line, bytes) in (1..).zip(&lines) {
            match std::str::from_utf8(bytes) {
                Ok(text) => found.line(line, text.trim_start_matches('\u{FEFF}'), &mut names),
                Err(_) => found.note(line, SpelMistake::NotText),
            }
        }
        if cut.is_some() {
            found.note(lines.len() + 1, SpelMistake::TooLarge);
        }
        found
    }

    fn line(&mut self, line: usize, text: &str, names: &mut HashSet<String>) {
        // The manual's example is printed with a typographic apostrophe.
        let code = text.split(['\'', '‘', '’']).next().unwrap_or_default().trim();
        if code.is_empty() {
            return;
        }
        let (keyword, rest) = word(code);
        if !keyword.eq_ignore_ascii_case("Global") {
            return self.note(line, SpelMistake::NotGlobal);
        }
        let (preserve, rest) = word(rest);
        if !preserve.eq_ignore_ascii_case("Preserve") {
            return self.note(line, SpelMistake::NotPreserved);
        }
        let (type_name, rest) = word(rest);
        let Some(kind) = SpelType::from_keyword(type_name) else {
            return self.note(line, SpelMistake::UnknownType(shown(type_name)));
        };
        for name in names_of(rest) {
            match self.check(name, names) {
                Ok(()) => {
                    names.insert(name.to_ascii_lowercase());
                    self.variables.push(SpelDeclaration { name: name.to_owned(), kind });
                }
                Err(mistake) => self.note(line, mistake),
            }
        }
    }

    fn check(&self, name: &str, names: &HashSet<String>) -> Result<(), SpelMistake> {
        if name.is_empty() {
            return Err(SpelMistake::NoName);
        }
        if let Some((array, _)) = name.split_once('(') {
            return Err(SpelMistake::Array(shown(array.trim())));
        }
        let is_name = name.starts_with(|first: char| first.is_ascii_alphabetic())
            && name.chars().all(|other| other.is_ascii_alphanumeric() || other == '_')
            && name.len() <= MAX_NAME;
        if !is_name {
            return Err(SpelMistake::BadName(shown(name)));
        }
        let prefix = name.get(..SPEL_PREFIX.len());
        if !prefix.is_some_and(|prefix| prefix.eq_ignore_ascii_case(SPEL_PREFIX)) {
            return Err(SpelMistake::NoPrefix(name.to_owned()));
        }
        if names.contains(&name.to_ascii_lowercase()) {
            return Err(SpelMistake::Duplicate(name.to_owned()));
        }
        if self.variables.len() >= MAX_SPEL_VARIABLES {
            return Err(SpelMistake::TooMany(name.to_owned()));
        }
        Ok(())
    }

    fn note(&mut self, line: usize, mistake: SpelMistake) {
        if self.findings.len() + 1 < MAX_FINDINGS {
            self.findings.push(SpelFinding { line, mistake });
        } else if self.findings.len() < MAX_FINDINGS {
            self.findings.push(SpelFinding { line, mistake: SpelMistake::More });
        }
    }
}

/// The first word, and what follows it.
fn word(text: &str) -> (&str, &str) {
    let text = text.trim_start();
    text.split_once(char::is_whitespace).unwrap_or((text, ""))
}

/// The names between commas; a comma between the brackets of an array separates its dimensions.
fn names_of(list: &str) -> Vec<&str> {
    let mut depth = 0_usize;
    list.split(move |character: char| {
        match character {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        character == ',' && depth == 0
    })
    .map(str::trim)
    .collect()
}

/// A foreign word for a message: without control characters, not too long.
fn shown(word: &str) -> String {
    word.chars().filter(|character| !character.is_control()).take(MAX_NAME).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> SpelDeclarations {
        SpelDeclarations::parse(text.as_bytes())
    }

    fn findings(text: &str) -> Vec<String> {
        parse(text).findings.iter().map(SpelFinding::to_string).collect()
    }

    /// Manual 4.2.2.
    #[test]
    fn the_example_of_the_manual() {
        let found = parse(
            "‘ OPC UA 输出用的变量\n\
             Global Preserve UShort OPCUA_ItemCode\n\
             Global Preserve UInt32 OPCUA_ElectricPower\r\n\
             \n\
             global  preserve\tushort OPCUA_CycleTime ' in hundredths\n\
             Global Preserve Real OPCUA_A, OPCUA_B\n",
        );
        assert_eq!(found.findings, []);
        let names: Vec<_> = found.variables.iter().map(|variable| (variable.name.as_str(), variable.kind)).collect();
        assert_eq!(
            names,
            [
                ("OPCUA_ItemCode", SpelType::UShort),
                ("OPCUA_ElectricPower", SpelType::UInt32),
                ("OPCUA_CycleTime", SpelType::UShort),
                ("OPCUA_A", SpelType::Real),
                ("OPCUA_B", SpelType::Real),
            ]
        );
    }

    #[test]
    fn every_type_can_be_declared() {
        let lines = SpelType::ALL.map(|kind| format!("Global Preserve {kind} OPCUA_{kind}"));
        let found = parse(&lines.join("\n"));
        assert_eq!(found.findings, []);
        assert_eq!(found.variables.iter().map(|variable| variable.kind).collect::<Vec<_>>(), SpelType::ALL);
    }

    #[test]
    fn what_is_not_shown_is_named_by_its_line() {
        assert_eq!(
            findings(
                "Function main\n\
                 Global Integer OPCUA_A\n\
                 Global Preserve Variant OPCUA_B\n\
                 Global Preserve Long\n\
                 Global Preserve Long OPCUA_C,\n\
                 Global Preserve Long 7up\n\
                 Global Preserve Long ItemCode\n\
                 Global Preserve Long OPCUA_List(10, 3), OPCUA_D\n\
                 Global Preserve Byte opcua_d\n\
                 Global Preserve String OPCUA_ThisNameIsLongerThanThirtyTwo\n\
                 Global Preserve String OPCUA_Grüße\n"
            ),
            [
                "line 1: not a Global declaration",
                "line 2: not a backup variable: Preserve is missing",
                "line 3: Variant is not a data type",
                "line 4: a name is missing",
                "line 5: a name is missing",
                "line 6: 7up is not a name",
                "line 7: ItemCode does not begin with OPCUA_",
                "line 8: OPCUA_List is an array",
                "line 9: opcua_d is declared twice",
                "line 10: OPCUA_ThisNameIsLongerThanThirty is not a name",
                "line 11: OPCUA_Grüße is not a name",
            ]
        );
    }

    #[test]
    fn files_and_findings_are_bounded() {
        let many: String = (0..300).map(|at| format!("Global Preserve Byte OPCUA_{at}\n")).collect();
        let found = parse(&many);
        assert_eq!((found.variables.len(), found.findings.len()), (256, 44));
        assert_eq!(found.findings[0].to_string(), "line 257: OPCUA_256 is beyond the limit of 256 variables");

        let wrong = findings(&"x\n".repeat(1000));
        assert_eq!((wrong.len(), wrong[49].as_str()), (MAX_FINDINGS, "line 50: more mistakes follow"));

        let mut large = vec![b'\''; MAX_DECLARATION_BYTES - 1];
        large.extend(b"\nGlobal Preserve Byte OPCUA_A\n");
        let found = SpelDeclarations::parse(&large);
        assert_eq!(found.variables, []);
        assert_eq!(found.findings, [SpelFinding { line: 2, mistake: SpelMistake::TooLarge }]);
    }

    #[test]
    fn bytes_of_any_kind_are_survived() {
        let found = SpelDeclarations::parse(
            b"\xFF\xFE\nGlobal Preserve Byte OPCUA_A\x00\n\xEF\xBB\xBFGlobal Preserve Byte OPCUA_B",
        );
        assert_eq!(found.findings[0], SpelFinding { line: 1, mistake: SpelMistake::NotText });
        assert_eq!(found.findings[1].mistake, SpelMistake::BadName("OPCUA_A".to_owned()));
        assert_eq!(found.variables.len(), 1);
    }
}
