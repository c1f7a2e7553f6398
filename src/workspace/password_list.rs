use std::borrow::Cow;
use std::collections::BTreeMap;

use secrecy::SecretString;
use thiserror::Error;
use zeroize::Zeroizing;

use super::{MAX_CONNECTIONS, MAX_VAULT_PASSWORD_BYTES};

/// A larger file is not a list of passwords.
pub const MAX_PASSWORD_LIST_BYTES: usize = 16 * 1024 * 1024;

/// Connection passwords by the name of their controller, from a CSV file. Wiped when it is dropped.
///
/// The first line names the columns; `Name` and `Password` count, others do not. Fields are separated by commas,
/// semicolons or tabs and quoted where needed (RFC 4180). Blanks around a name do not matter, blanks in a password do.
/// An empty password says that the controller has none.
pub struct PasswordList(BTreeMap<String, SecretString>);

/// Why the text is not a list of passwords. Never quotes it.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PasswordListError {
    /// The file is larger than is read.
    #[error("the file has more than {MAX_PASSWORD_LIST_BYTES} bytes")]
    TooLarge,
    /// The first line does not name the columns.
    #[error("the first line has no columns \"Name\" and \"Password\"")]
    Columns,
    /// A line ends before the password; holds its number, counted from 1.
    #[error("line {0} has no field for the password")]
    NoPassword(usize),
    /// A line has an empty name; holds its number, counted from 1.
    #[error("line {0} has no name")]
    NoName(usize),
    /// Two lines have the same name.
    #[error("line {line}: its name stands in line {first} too")]
    Twice {
        /// The later line, counted from 1.
        line: usize,
        /// The earlier line, counted from 1.
        first: usize,
    },
    /// A password is longer than a vault holds; holds its line, counted from 1.
    #[error("line {0}: the password has more than {MAX_VAULT_PASSWORD_BYTES} bytes")]
    TooLong(usize),
    /// A quotation mark is not closed; holds its line, counted from 1.
    #[error("line {0}: a quotation mark has no counterpart")]
    Quotes(usize),
    /// The list has more lines than a configuration has controllers.
    #[error("the list has more than {MAX_CONNECTIONS} controllers")]
    TooMany,
}

impl std::fmt::Debug for PasswordList {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "PasswordList({} controllers)", self.0.len())
    }
}

impl PasswordList {
    /// Reads the text of a list. The first line names the columns; other columns are passed over.
    pub fn parse(text: &str) -> Result<Self, PasswordListError> {
        if text.len() > MAX_PASSWORD_LIST_BYTES {
            return Err(PasswordListError::TooLarge);
        }
        let mut lines = Lines::new(text);
        let header = lines.next().transpose()?.ok_or(PasswordListError::Columns)?.1;
        let column = |name: &str| header.iter().position(|field| field.0.trim().eq_ignore_ascii_case(name));
        let (Some(name), Some(password)) = (column("Name"), column("Password")) else {
            return Err(PasswordListError::Columns);
        };
        let (mut list, mut seen) = (BTreeMap::new(), BTreeMap::new());
        for record in lines {
            let (line, fields) = record?;
            if fields.iter().all(|field| field.0.is_empty()) {
                continue;
            }
            let name = fields.get(name).map(|field| field.0.trim()).filter(|name| !name.is_empty());
            let name = name.ok_or(PasswordListError::NoName(line))?;
            let password = fields.get(password).ok_or(PasswordListError::NoPassword(line))?;
            if password.0.len() > MAX_VAULT_PASSWORD_BYTES {
                return Err(PasswordListError::TooLong(line));
            }
            if let Some(first) = seen.insert(name.to_owned(), line) {
                return Err(PasswordListError::Twice { line, first });
            }
            if list.len() >= MAX_CONNECTIONS {
                return Err(PasswordListError::TooMany);
            }
            list.insert(name.to_owned(), SecretString::from(&*password.0));
        }
        Ok(Self(list))
    }

    /// The password of the controller with this name.
    pub fn get(&self, name: &str) -> Option<&SecretString> {
        self.0.get(name)
    }

    /// By name, in alphabetical order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &SecretString)> {
        self.0.iter().map(|(name, password)| (name.as_str(), password))
    }
}

/// Borrowed from the text, or a copy without doubled quotation marks that is wiped when dropped.
struct Field<'a>(Cow<'a, str>);

impl Drop for Field<'_> {
    fn drop(&mut self) {
        if let Cow::Owned(copy) = &mut self.0 {
            drop(Zeroizing::new(std::mem::take(copy)));
        }
    }
}

/// The records of a CSV text with their line, counted from 1. The `csv` crate keeps copies of fields that cannot be
/// wiped, so it is not used for secrets.
struct Lines<'a> {
    rest: Option<&'a str>,
    separator: char,
    line: usize,
}

impl<'a> Lines<'a> {
    fn new(text: &'a str) -> Self {
        let mut lines = Self { rest: Some(text), separator: ',', line: 1 };
        let first = text.split(['\r', '\n']).next().unwrap_or_default();
        match first.strip_prefix("sep=").and_then(|rest| rest.chars().next()) {
            // Said in a line of its own, as Excel reads it.
            Some(separator) => {
                lines.separator = separator;
                lines.rest = Some(without_line_end(&text[first.len()..]).unwrap_or_default());
                lines.line = 2;
            }
            None => lines.separator = [',', ';', '\t'].into_iter().find(|c| first.contains(*c)).unwrap_or(','),
        }
        lines
    }

    /// The next field, and whether another one follows in the same line.
    fn field(&mut self, text: &'a str) -> Result<(Field<'a>, bool), PasswordListError> {
        let unquoted = PasswordListError::Quotes(self.line);
        let (field, after) = match text.strip_prefix('"') {
            Some(quoted) => {
                let end = end_of_quoted(quoted).ok_or(unquoted.clone())?;
                let (inside, after) = (&quoted[..end], &quoted[end + 1..]);
                self.line += inside.matches('\n').count();
                let field = if inside.contains('"') { Cow::Owned(undoubled(inside)) } else { Cow::Borrowed(inside) };
                (Field(field), after)
            }
            None => {
                let end = text.find([self.separator, '\r', '\n']).unwrap_or(text.len());
                (Field(Cow::Borrowed(&text[..end])), &text[end..])
            }
        };
        if let Some(rest) = after.strip_prefix(self.separator) {
            self.rest = Some(rest);
            return Ok((field, true));
        }
        self.rest = match without_line_end(after) {
            Some("") => None,
            Some(rest) => Some(rest),
            None if after.is_empty() => None,
            None => return Err(unquoted),
        };
        Ok((field, false))
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Result<(usize, Vec<Field<'a>>), PasswordListError>;

    fn next(&mut self) -> Option<Self::Item> {
        let line = self.line;
        let mut fields = Vec::new();
        loop {
            let text = self.rest.take()?;
            match self.field(text) {
                Ok((field, more)) => {
                    fields.push(field);
                    if !more {
                        self.line += 1;
                        return Some(Ok((line, fields)));
                    }
                }
                Err(error) => return Some(Err(error)),
            }
        }
    }
}

/// What follows the line end that `text` begins with.
fn without_line_end(text: &str) -> Option<&str> {
    ["\r\n", "\n", "\r"].iter().find_map(|end| text.strip_prefix(end))
}

/// Where the closing quotation mark is: the first one that is not doubled.
fn end_of_quoted(text: &str) -> Option<usize> {
    let mut from = 0;
    loop {
        let at = from + text.get(from..)?.find('"')?;
        if !text[at + 1..].starts_with('"') {
            return Some(at);
        }
        from = at + 2;
    }
}

fn undoubled(text: &str) -> String {
    // Never grows, so that nothing is left behind.
    let mut single = String::with_capacity(text.len());
    for (index, part) in text.split("\"\"").enumerate() {
        if index > 0 {
            single.push('"');
        }
        single.push_str(part);
    }
    single
}

#[cfg(test)]
mod tests {
    use secrecy::ExposeSecret as _;

    use super::*;
    use crate::model::{ErrorCode, Problem};

    fn list(text: &str) -> Vec<(String, String)> {
        let list = PasswordList::parse(text).unwrap();
        list.iter().map(|(name, password)| (name.to_owned(), password.expose_secret().to_owned())).collect()
    }

    fn pairs(pairs: &[(&str, &str)]) -> Vec<(String, String)> {
        pairs.iter().map(|(name, password)| ((*name).to_owned(), (*password).to_owned())).collect()
    }

    #[test]
    fn what_spreadsheets_write_is_read() {
        let wanted = pairs(&[("weld 1", "a,b"), ("码垛", "say \"x\" ")]);
        for text in [
            "Name,Password\nweld 1,\"a,b\"\n码垛,\"say \"\"x\"\" \"\n",
            "name;PASSWORD\r\nweld 1;a,b\r\n\r\n码垛;\"say \"\"x\"\" \"",
            "Password\tAddress\tName\ra,b\t10.0.0.1\t weld 1 \r\"say \"\"x\"\" \"\t\t码垛\r",
            "sep=;\r\nName;Password;\r\nweld 1;a,b;\r\n\"码垛\";\"say \"\"x\"\" \";\r\n;;\r\n",
        ] {
            assert_eq!(list(text), wanted, "{text}");
        }
        assert_eq!(list("Name,Password\nopen,\n"), pairs(&[("open", "")]), "it has no password");
        assert_eq!(
            list("Name,Password\nweld,\"two\nlines\"\npaint,x"),
            pairs(&[("paint", "x"), ("weld", "two\nlines")])
        );
        assert_eq!(PasswordList::parse("Name,Password").unwrap().get("weld").map(drop), None);
    }

    #[test]
    fn what_is_wrong_is_named_by_its_line_and_quotes_no_password() {
        use PasswordListError::*;
        let long = format!("Name,Password\nweld,{}", "x".repeat(MAX_VAULT_PASSWORD_BYTES + 1));
        for (text, error) in [
            ("", Columns),
            ("weld,secret\n", Columns),
            ("Name\nweld\n", Columns),
            ("Name,Password\nweld\n", NoPassword(2)),
            ("Name,Password\nweld,a\n,secret\n", NoName(3)),
            ("Name,Password\nweld,\"a\nb\"\nweld,secret\n", Twice { line: 4, first: 2 }),
            ("Name,Password\nweld,\"secret\n", Quotes(2)),
            ("Name,Password\nweld,\"secret\"x\n", Quotes(2)),
            (&long, TooLong(2)),
        ] {
            let found = PasswordList::parse(text).unwrap_err();
            assert_eq!(found, error, "{text}");
            assert!(!Problem::from(found).to_string().contains("secret"));
        }
        assert_eq!(PasswordList::parse(&" ".repeat(MAX_PASSWORD_LIST_BYTES + 1)).unwrap_err(), TooLarge);
        let many: String = (0..=MAX_CONNECTIONS).map(|number| format!("c{number},x\n")).collect();
        assert_eq!(PasswordList::parse(&format!("Name,Password\n{many}")).unwrap_err(), TooMany);
        assert_eq!(Problem::from(TooMany).code, ErrorCode::BadPasswordList);
    }
}
