use std::fmt;
use std::str::FromStr;

use secrecy::{ExposeSecret, SecretString};
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The most users one controller takes (manual 2.6.2.2).
pub const MAX_USERS: usize = 10;

const MIN_CHARS: usize = 8;
const MAX_CHARS: usize = 32;

/// Which rule of manual 2.6.2.2 a user name or password breaks. Never carries the password itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum UserCredentialError {
    /// The text has fewer than 8 or more than 32 characters; holds how many.
    #[error("it has {0} characters; 8 to 32 are required")]
    Length(usize),
    /// A character is neither an ASCII letter nor a digit.
    #[error("only the letters A–Z, a–z and the digits 0–9 are allowed")]
    Characters,
}

fn check(text: &str) -> Result<(), UserCredentialError> {
    if !text.bytes().all(|b| b.is_ascii_alphanumeric()) {
        return Err(UserCredentialError::Characters);
    }
    if !(MIN_CHARS..=MAX_CHARS).contains(&text.len()) {
        return Err(UserCredentialError::Length(text.len()));
    }
    Ok(())
}

/// The name of an OPC UA user: 8–32 ASCII letters and digits.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct UserName(String);

impl UserName {
    /// The name as it was entered.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl FromStr for UserName {
    type Err = UserCredentialError;
    fn from_str(text: &str) -> Result<Self, UserCredentialError> {
        check(text).map(|()| Self(text.to_owned()))
    }
}

text_in_messages!(UserName, UserCredentialError);

impl fmt::Display for UserName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// The password of an OPC UA user: 8–32 ASCII letters and digits. Shown by nothing, wiped when dropped.
#[derive(Debug, Clone)]
pub struct UserPassword(SecretString);

impl UserPassword {
    /// Checks the rules of manual 2.6.2.2. The text passed in is not wiped: that is up to the caller.
    pub fn new(text: &str) -> Result<Self, UserCredentialError> {
        check(text).map(|()| Self(SecretString::from(text)))
    }

    /// The password, still protected from `Debug`.
    pub fn secret(&self) -> &SecretString {
        &self.0
    }

    /// The password in plain text.
    pub fn expose(&self) -> &str {
        self.0.expose_secret()
    }
}

/// A user to be added.
#[derive(Debug, Clone)]
pub struct UserCredential {
    /// Name of the user.
    pub name: UserName,
    /// Password of the user.
    pub password: UserPassword,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_passwords_are_8_to_32_letters_and_digits() {
        assert!("operator1".parse::<UserName>().is_ok());
        assert_eq!("short".parse::<UserName>(), Err(UserCredentialError::Length(5)));
        assert_eq!("a".repeat(33).parse::<UserName>(), Err(UserCredentialError::Length(33)));
        for bad in ["operator-1", "operator 1", "操作员操作员操作员", "ｏｐｅｒａｔｏｒ"] {
            assert_eq!(bad.parse::<UserName>(), Err(UserCredentialError::Characters), "{bad}");
        }
        assert!(UserPassword::new("Passw0rd").is_ok());
    }

    #[test]
    fn a_password_is_not_in_its_debug_output() {
        let credential = UserCredential {
            name: "operator1".parse().expect("name"),
            password: UserPassword::new("TopSecret99").expect("password"),
        };
        assert!(!format!("{credential:?}").contains("TopSecret99"));
    }
}
