use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The licence key of one controller, `xxxx-xxxx-xxxx-xxxx`: 16 ASCII letters and digits, kept in lower case.
///
/// Read however it was pasted: in either case, with or without dashes, with blanks around and inside. Full-width
/// characters are refused (manual 2.6.3). The key is worth money: `Debug` does not show it.
#[derive(Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct LicenceKey(String);

/// The activation key of one controller, `XXXX-XXXX-XXXX-XXXX-XXXX-XXXX`: 24 ASCII letters and digits, kept in upper
/// case. Read and shown as a [`LicenceKey`] is.
#[derive(Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct ActivationKey(String);

/// Both keys of one controller.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ActivationKeys {
    /// The licence key.
    pub licence: LicenceKey,
    /// The activation key that belongs to it.
    pub activation: ActivationKey,
}

/// Why a text is not a key. Never carries more of it than one character.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum KeyError {
    /// A character that is neither an ASCII letter nor a digit.
    #[error("{0:?} is neither a half-width letter nor a digit")]
    Character(char),
    /// The number of letters and digits is wrong.
    #[error("it has {found} letters and digits; {expected} are required")]
    Length {
        /// Letters and digits in the text.
        found: usize,
        /// Letters and digits of such a key.
        expected: usize,
    },
}

impl LicenceKey {
    /// Letters and digits, without the dashes.
    pub const LENGTH: usize = 16;
}

impl ActivationKey {
    /// Letters and digits, without the dashes.
    pub const LENGTH: usize = 24;
}

/// What word processors make of a dash.
const DASHES: [char; 8] = ['-', '\u{2010}', '\u{2011}', '\u{2012}', '\u{2013}', '\u{2014}', '\u{2015}', '\u{2212}'];
const GROUP: usize = 4;

/// The letters and digits alone.
fn characters(text: &str, expected: usize) -> Result<String, KeyError> {
    let meant = || text.chars().filter(|c| !c.is_whitespace() && !DASHES.contains(c));
    if let Some(wrong) = meant().find(|c| !c.is_ascii_alphanumeric()) {
        return Err(KeyError::Character(wrong));
    }
    let found = meant().count();
    if found == expected { Ok(meant().collect()) } else { Err(KeyError::Length { found, expected }) }
}

fn grouped(characters: &str, f: &mut fmt::Formatter<'_>) -> fmt::Result {
    for (index, c) in characters.chars().enumerate() {
        if index > 0 && index.is_multiple_of(GROUP) {
            f.write_str("-")?;
        }
        write!(f, "{c}")?;
    }
    Ok(())
}

impl FromStr for LicenceKey {
    type Err = KeyError;
    fn from_str(text: &str) -> Result<Self, KeyError> {
        characters(text, Self::LENGTH).map(|key| Self(key.to_ascii_lowercase()))
    }
}

impl FromStr for ActivationKey {
    type Err = KeyError;
    fn from_str(text: &str) -> Result<Self, KeyError> {
        characters(text, Self::LENGTH).map(|key| Self(key.to_ascii_uppercase()))
    }
}

impl fmt::Display for LicenceKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        grouped(&self.0, f)
    }
}

impl fmt::Display for ActivationKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        grouped(&self.0, f)
    }
}

impl fmt::Debug for LicenceKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("LicenceKey(…)")
    }
}

impl fmt::Debug for ActivationKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("ActivationKey(…)")
    }
}

impl TryFrom<String> for LicenceKey {
    type Error = KeyError;
    fn try_from(text: String) -> Result<Self, KeyError> {
        text.parse()
    }
}

impl TryFrom<String> for ActivationKey {
    type Error = KeyError;
    fn try_from(text: String) -> Result<Self, KeyError> {
        text.parse()
    }
}

impl From<LicenceKey> for String {
    fn from(key: LicenceKey) -> Self {
        key.to_string()
    }
}

impl From<ActivationKey> for String {
    fn from(key: ActivationKey) -> Self {
        key.to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pasted_key_is_understood_however_it_looks() {
        let licence = "ab12-cd34-ef56-gh78".parse::<LicenceKey>().unwrap();
        for text in [
            "AB12-CD34-EF56-GH78",
            "ab12cd34ef56gh78",
            " ab12 - cd34 - ef56 - gh78\t",
            "ab12–cd34—ef56−gh78",
            "ab12-cd34-\u{a0}ef56-\r\ngh78",
        ] {
            assert_eq!(text.parse(), Ok(licence.clone()), "{text}");
        }
        assert_eq!(licence.to_string(), "ab12-cd34-ef56-gh78");
        let activation = "aaaabbbbccccddddeeee1111".parse::<ActivationKey>().unwrap();
        assert_eq!(activation.to_string(), "AAAA-BBBB-CCCC-DDDD-EEEE-1111");
    }

    #[test]
    fn a_mistake_is_named_without_repeating_the_key() {
        assert_eq!("".parse::<LicenceKey>(), Err(KeyError::Length { found: 0, expected: 16 }));
        assert_eq!("ab12-cd34-ef56-gh7".parse::<LicenceKey>(), Err(KeyError::Length { found: 15, expected: 16 }));
        assert_eq!("ab12-cd34-ef56-gh789".parse::<LicenceKey>(), Err(KeyError::Length { found: 17, expected: 16 }));
        assert_eq!("ａｂ１２-cd34-ef56-gh78".parse::<LicenceKey>(), Err(KeyError::Character('ａ')));
        assert_eq!("ab12_cd34_ef56_gh78".parse::<LicenceKey>(), Err(KeyError::Character('_')));
        assert_eq!("ab12-cd34-ef56-gh78".parse::<ActivationKey>(), Err(KeyError::Length { found: 16, expected: 24 }));
    }

    #[test]
    fn keys_travel_but_are_not_shown() {
        let key: LicenceKey = serde_json::from_str(r#""AB12CD34EF56GH78""#).unwrap();
        assert_eq!(serde_json::to_string(&key).unwrap(), r#""ab12-cd34-ef56-gh78""#);
        let keys = ActivationKeys { licence: key, activation: "a".repeat(24).parse().unwrap() };
        let shown = format!("{keys:?}");
        assert!(!shown.contains("ab12") && !shown.contains("AAAA"), "{shown}");
    }
}
