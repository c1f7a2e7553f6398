//! The declarations of backup variables in a project file (manual 4.2): `Global Preserve <type> <name>[, <name>…]`, one
//! statement a line, `'` begins a comment. An array states the highest element number of each dimension behind its name:
//! `Global Preserve Integer g_intArray(10)` has the elements 0 to 10 (RC+ User's Guide, "Arrays").

use std::collections::HashSet;
use std::fmt;

use thiserror::Error;

use super::spel_declaration::{MAX_DIMENSIONS, MAX_SPEL_VARIABLES, SpelDeclaration, has_prefix};
use crate::model::SpelType;

/// The backup variables of a project file, and what the address space does not show although its name says that it should.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct SpelDeclarations {
    /// In the order of the file. The address space shows the first 256 of those that [`SpelDeclaration::is_shown`] names;
    /// remote commands reach all.
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

/// Values of all variables of a project together. The language has no such limit; it bounds what a file can take of the
/// memory.
const MAX_VALUES: usize = 100_000;

/// Something in a project file that is not taken, or that the address space does not show.
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

/// Why a declaration is not taken or not shown.
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
    /// What follows the name in brackets is not one to three numbers.
    #[error("the dimensions of {0} are not one to three numbers")]
    BadDimensions(String),
    /// The address space shows no arrays; remote commands reach it.
    #[error("{0} is an array")]
    Array(String),
    /// More elements than a backup variable may have: 4000, of String 400.
    #[error("{0} has too many elements")]
    TooManyElements(String),
    /// The name was declared before.
    #[error("{0} is declared twice")]
    Duplicate(String),
    /// More than 256 variables; remote commands reach it.
    #[error("{0} is beyond the limit of 256 variables")]
    TooMany(String),
    /// All variables together have more than 100 000 values.
    #[error("{0} is more than the memory for variables holds")]
    NoMemory(String),
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
        for declared in names_of(rest) {
            match self.check(declared, kind, names) {
                Ok(variable) => {
                    names.insert(variable.name.to_ascii_lowercase());
                    if let Some(mistake) = self.why_not_shown(&variable) {
                        self.note(line, mistake);
                    }
                    self.variables.push(variable);
                }
                Err(mistake) => self.note(line, mistake),
            }
        }
    }

    fn check(&self, declared: &str, kind: SpelType, names: &HashSet<String>) -> Result<SpelDeclaration, SpelMistake> {
        if declared.is_empty() {
            return Err(SpelMistake::NoName);
        }
        let (name, dimensions) = match declared.split_once('(') {
            Some((name, dimensions)) => (name.trim_end(), Some(dimensions)),
            None => (declared, None),
        };
        // The name of a String may end with a dollar sign.
        let letters = if kind == SpelType::String { name.strip_suffix('$').unwrap_or(name) } else { name };
        let is_name = letters.starts_with(|first: char| first.is_ascii_alphabetic())
            && letters.chars().all(|other| other.is_ascii_alphanumeric() || other == '_')
            && name.len() <= MAX_NAME;
        if !is_name {
            return Err(SpelMistake::BadName(shown(name)));
        }
        if names.contains(&name.to_ascii_lowercase()) {
            return Err(SpelMistake::Duplicate(name.to_owned()));
        }
        let bounds = match dimensions {
            Some(dimensions) => bounds(dimensions).ok_or_else(|| SpelMistake::BadDimensions(name.to_owned()))?,
            None => Vec::new(),
        };
        let variable = SpelDeclaration { name: name.to_owned(), kind, bounds };
        if !variable.is_within_limits() {
            return Err(SpelMistake::TooManyElements(variable.name));
        }
        let held: usize = self.variables.iter().map(SpelDeclaration::elements).sum();
        if held + variable.elements() > MAX_VALUES {
            return Err(SpelMistake::NoMemory(variable.name));
        }
        Ok(variable)
    }

    /// Why the address space does not show a variable with its prefix.
    fn why_not_shown(&self, variable: &SpelDeclaration) -> Option<SpelMistake> {
        if !has_prefix(&variable.name) {
            return None;
        }
        let name = variable.name.clone();
        if !variable.is_shown() {
            return Some(SpelMistake::Array(name));
        }
        let shown = self.variables.iter().filter(|known| known.is_shown()).count();
        (shown >= MAX_SPEL_VARIABLES).then_some(SpelMistake::TooMany(name))
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

/// The numbers between the brackets of an array, which the first bracket does not belong to.
fn bounds(dimensions: &str) -> Option<Vec<u16>> {
    let numbers = dimensions.trim_end().strip_suffix(')')?;
    let bounds = numbers.split(',').map(|number| number.trim().parse::<u16>().ok()).collect::<Option<Vec<u16>>>()?;
    (bounds.len() <= MAX_DIMENSIONS).then_some(bounds)
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
                 Global Preserve Long OPCUA_Box$\n\
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
                "line 7: OPCUA_Box$ is not a name",
                "line 8: OPCUA_List is an array",
                "line 9: opcua_d is declared twice",
                "line 10: OPCUA_ThisNameIsLongerThanThirty is not a name",
                "line 11: OPCUA_Grüße is not a name",
            ]
        );
    }

    #[test]
    fn arrays_state_the_highest_element_of_each_dimension() {
        let found = parse(
            "Global Preserve Integer g_intArray(10), g_int3Array(10,10, 10), g_Status\n\
             Global Preserve String g_Names$ ( 399 )\n",
        );
        assert_eq!(found.findings, []);
        let arrays: Vec<_> = found.variables.iter().map(|it| (it.name.as_str(), it.bounds.as_slice())).collect();
        assert_eq!(
            arrays,
            [("g_intArray", &[10][..]), ("g_int3Array", &[10, 10, 10]), ("g_Status", &[]), ("g_Names$", &[399]),]
        );
        assert_eq!(
            findings(
                "Global Preserve Byte a(1,1,1,1)\n\
                 Global Preserve Byte b()\n\
                 Global Preserve Byte c(-1)\n\
                 Global Preserve Byte d(3\n\
                 Global Preserve Byte e(4000)\n\
                 Global Preserve String f(400)\n\
                 Global Preserve Byte g(99999)\n"
            ),
            [
                "line 1: the dimensions of a are not one to three numbers",
                "line 2: the dimensions of b are not one to three numbers",
                "line 3: the dimensions of c are not one to three numbers",
                "line 4: the dimensions of d are not one to three numbers",
                "line 5: e has too many elements",
                "line 6: f has too many elements",
                "line 7: the dimensions of g are not one to three numbers",
            ]
        );
    }

    #[test]
    fn files_and_findings_are_bounded() {
        let many: String = (0..300).map(|at| format!("Global Preserve Byte OPCUA_{at}\n")).collect();
        let found = parse(&many);
        assert_eq!((found.variables.len(), found.findings.len()), (300, 44));
        assert_eq!(found.findings[0].to_string(), "line 257: OPCUA_256 is beyond the limit of 256 variables");

        let large: String = (0..30).map(|at| format!("Global Preserve Byte g_{at}(3999)\n")).collect();
        let found = parse(&large);
        assert_eq!((found.variables.len(), found.findings.len()), (25, 5));
        assert_eq!(found.findings[0].to_string(), "line 26: g_25 is more than the memory for variables holds");

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
