//! The connection list of the vendor's programming environment, as a CSV file (manual 2.5.3).

use thiserror::Error;

use super::{Configuration, ControllerEntry};
use crate::model::text::{self, TextError};
use crate::model::text_table::{TextTable, TextTableRow};
use crate::model::{Address, AddressError, ControllerName, ControllerSeries, NameError};

/// The columns, as the first line names them.
pub const CONNECTION_LIST_COLUMNS: [&str; 3] = ["Name", "Type", "Address"];

/// A larger file is not a connection list.
pub const MAX_CONNECTION_LIST_BYTES: usize = 1024 * 1024;

/// More entries are not read.
pub const MAX_CONNECTIONS: usize = 10_000;

/// A connection list, line by line, nothing decided yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConnectionList {
    rows: Vec<TextTableRow>,
    columns: Columns,
}

/// Where name, type and address stand, counted from 0: the order is free, and there may be other columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Columns {
    name: usize,
    kind: usize,
    address: usize,
    /// How many the first line names.
    count: usize,
}

/// Why the bytes are no connection list at all.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ConnectionListError {
    /// The file is larger than is read; holds its size in bytes.
    #[error("the file has {0} bytes; at most {MAX_CONNECTION_LIST_BYTES} are read")]
    TooLarge(usize),
    /// The bytes are not text in a known Unicode encoding.
    #[error(transparent)]
    Text(#[from] TextError),
    /// The names that stand there, if one of them is right; otherwise nothing, since it may be a secret of some other
    /// file.
    #[error("the first line does not name the columns Name, Type and Address{found}", found = found(.0))]
    Columns(String),
    /// The list has more lines than a configuration has controllers.
    #[error("it has more than {MAX_CONNECTIONS} entries")]
    TooMany,
}

fn found(columns: &str) -> String {
    if columns.is_empty() { String::new() } else { format!(" but \"{columns}\"") }
}

/// What will be done with one line of the list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlannedConnection {
    /// Counted from 1, the first line of the file included.
    pub line: usize,
    /// As it stands in the file.
    pub name: String,
    /// As it stands in the file.
    pub address: String,
    /// The entry to be added, or why the line is left out.
    pub verdict: Result<NewConnection, SkippedLine>,
}

/// An entry that can be added.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewConnection {
    /// Name of the new entry.
    pub name: ControllerName,
    /// Address of the new entry.
    pub address: Address,
}

/// Why a line is left out.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SkippedLine {
    /// Not an error: the manual asks for it.
    #[error("controllers on USB are not reached over the network")]
    Usb,
    /// Not an error: the manual asks for it.
    #[error("it is a simulation in the programming environment")]
    Virtual,
    /// Not an error: the manual asks for it.
    #[error("the name is already in the list of controllers")]
    NameRegistered,
    /// Not an error: the manual asks for it.
    #[error("the address is already in the list of controllers, as \"{0}\"")]
    AddressRegistered(ControllerName),
    /// The line has too few fields; holds how many.
    #[error("it has {0} field{s}; name, type and address are required", s = if *.0 == 1 { "" } else { "s" })]
    Fields(usize),
    /// A quotation mark is not closed, or a field holds a line end.
    #[error("a quotation mark is not closed, or a field has a line end in it")]
    Quotes,
    /// The type of connection is not known; holds the text.
    #[error("\"{0}\" is not a type of connection; known are Ethernet, USB and Virtual")]
    Type(String),
    /// The name is not one.
    #[error("{0}")]
    Name(#[source] NameError),
    /// The address is not one.
    #[error("{0}")]
    Address(#[source] AddressError),
    /// Another line of the list has the name; holds its number, counted from 1.
    #[error("the name also stands in line {0}")]
    NameTwice(usize),
    /// Another line of the list has the address; holds its number, counted from 1.
    #[error("the address also stands in line {0}")]
    AddressTwice(usize),
}

impl NewConnection {
    /// The entry to be registered, under a series that is a guess, since the list does not know it.
    pub fn entry(self, series: ControllerSeries) -> ControllerEntry {
        ControllerEntry::unconfirmed(self.name, self.address, series)
    }
}

impl ConnectionList {
    /// Reads text as [`text::decode`] takes it, and a table as [`TextTable::read`] does. Case and order of the columns do not
    /// matter, nor do other columns and empty lines.
    pub fn parse(bytes: &[u8]) -> Result<Self, ConnectionListError> {
        if bytes.len() > MAX_CONNECTION_LIST_BYTES {
            return Err(ConnectionListError::TooLarge(bytes.len()));
        }
        let mut rows = TextTable::read(&text::decode(bytes)?, MAX_CONNECTIONS + 2).rows;
        if rows.is_empty() {
            return Err(ConnectionListError::Columns(String::new()));
        }
        let first = rows.remove(0);
        let columns = Columns::of(&first).ok_or_else(|| ConnectionListError::Columns(shown(&first)))?;
        if rows.len() > MAX_CONNECTIONS {
            return Err(ConnectionListError::TooMany);
        }
        Ok(Self { rows, columns })
    }

    /// Whether text begins as a connection list.
    pub fn begins(text: &str) -> bool {
        TextTable::read(text, 1).rows.first().is_some_and(|first| Columns::of(first).is_some())
    }

    /// What an import would add to the list of controllers and what it would leave out, in the file's order.
    pub fn plan(&self, configuration: &Configuration) -> Vec<PlannedConnection> {
        let mut names = std::collections::HashMap::new();
        let mut addresses = std::collections::HashMap::new();
        let plan_one = |row: &TextTableRow| {
            let verdict = self.columns.read(row, configuration).and_then(|new| {
                if let Some(line) = names.get(&new.name) {
                    return Err(SkippedLine::NameTwice(*line));
                }
                if let Some(line) = addresses.get(&new.address) {
                    return Err(SkippedLine::AddressTwice(*line));
                }
                names.insert(new.name.clone(), row.line);
                addresses.insert(new.address.clone(), row.line);
                Ok(new)
            });
            let text = |column: usize| row.fields.get(column).cloned().unwrap_or_default();
            let (name, address) = (text(self.columns.name), text(self.columns.address));
            PlannedConnection { line: row.line, name, address, verdict }
        };
        self.rows.iter().map(plan_one).collect()
    }
}

/// The names of a first line with at least one of the columns, short enough for a message.
fn shown(first: &TextTableRow) -> String {
    let is_column = |field: &String| CONNECTION_LIST_COLUMNS.iter().any(|name| field.eq_ignore_ascii_case(name));
    if !first.fields.iter().any(is_column) {
        return String::new();
    }
    let names = first.fields.join(", ");
    let mut shown: String = names.chars().filter(|c| !c.is_control()).take(MAX_SHOWN).collect();
    if names.chars().nth(MAX_SHOWN).is_some() {
        shown.push('…');
    }
    shown
}

const MAX_SHOWN: usize = 80;

impl Columns {
    fn of(first: &TextTableRow) -> Option<Self> {
        let column = |wanted: &str| first.fields.iter().position(|found| found.eq_ignore_ascii_case(wanted));
        let [name, kind, address] = CONNECTION_LIST_COLUMNS;
        Some(Self { name: column(name)?, kind: column(kind)?, address: column(address)?, count: first.fields.len() })
    }

    fn read(self, row: &TextTableRow, configuration: &Configuration) -> Result<NewConnection, SkippedLine> {
        if row.is_broken {
            return Err(SkippedLine::Quotes);
        }
        if row.fields.len() > self.count {
            return Err(SkippedLine::Fields(row.fields.len()));
        }
        let text = |column: usize| row.fields.get(column).ok_or(SkippedLine::Fields(row.fields.len()));
        let kind = text(self.kind)?;
        if kind.eq_ignore_ascii_case("usb") {
            return Err(SkippedLine::Usb);
        }
        if kind.eq_ignore_ascii_case("virtual") {
            return Err(SkippedLine::Virtual);
        }
        let (name, address) = (text(self.name)?, text(self.address)?);
        if !kind.eq_ignore_ascii_case("ethernet") {
            return Err(SkippedLine::Type(kind.clone()));
        }
        let name: ControllerName = name.parse().map_err(SkippedLine::Name)?;
        let address: Address = address.parse().map_err(SkippedLine::Address)?;
        if configuration.controllers.iter().any(|c| c.name == name) {
            return Err(SkippedLine::NameRegistered);
        }
        match configuration.controllers.iter().find(|c| c.address == address) {
            Some(taken) => Err(SkippedLine::AddressRegistered(taken.name.clone())),
            None => Ok(NewConnection { name, address }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ErrorCode, Problem};

    const SAMPLE: &str = include_str!("../../fixtures/connections.csv");

    fn registered(list: &[(&str, &str)]) -> Configuration {
        let entry = |(name, address): &(&str, &str)| {
            let new = NewConnection { name: name.parse().unwrap(), address: address.parse().unwrap() };
            new.entry(ControllerSeries::Rc700)
        };
        let mut configuration = Configuration::default();
        configuration.controllers.extend(list.iter().map(entry));
        configuration
    }

    fn verdicts(text: &str, list: &[(&str, &str)]) -> Vec<(usize, Result<String, SkippedLine>)> {
        let plan = ConnectionList::parse(text.as_bytes()).unwrap().plan(&registered(list));
        plan.into_iter().map(|p| (p.line, p.verdict.map(|new| new.name.to_string()))).collect()
    }

    #[test]
    fn the_sample_gives_its_network_controllers() {
        let found = verdicts(SAMPLE, &[("Cell 2", "10.0.0.1"), ("Line 4", "192.168.10.4:7943")]);
        assert_eq!(
            found,
            [
                (2, Ok("Cell 1".into())),
                (3, Err(SkippedLine::NameRegistered)),
                (4, Ok("Assembly line 3".into())),
                (5, Err(SkippedLine::AddressRegistered("Line 4".parse().unwrap()))),
                (6, Err(SkippedLine::Usb)),
                (7, Err(SkippedLine::Virtual)),
            ]
        );
        assert!(found.iter().all(|(line, verdict)| match verdict {
            Err(skipped) => skipped.problem(*line).is_none(),
            Ok(_) => true,
        }));
    }

    #[test]
    fn every_mistake_is_named_with_its_line() {
        let long = "x".repeat(33);
        let text = format!(
            "\u{feff}name, TYPE ,Address\r\nCell 1,Ethernet,10.0.0.1\r\n\r\nCell 1,Ethernet,10.0.0.2\r\n\
             Cell 3,Ethernet,10.0.0.1:7943\r\n{long},Ethernet,10.0.0.4\r\nCell 5,Ethernet,10.0.0.999\r\n\
             Cell 6,Bluetooth,10.0.0.6\r\nCell 7,Ethernet\r\n,Ethernet,10.0.0.8\r\n\"Cell, 9\",ethernet,10.0.0.9"
        );
        let found = verdicts(&text, &[]);
        assert_eq!(
            found,
            [
                (2, Ok("Cell 1".into())),
                (4, Err(SkippedLine::NameTwice(2))),
                (5, Err(SkippedLine::AddressTwice(2))),
                (6, Err(SkippedLine::Name(NameError::TooLong(33)))),
                (7, Err(SkippedLine::Address(AddressError::Host("10.0.0.999".into())))),
                (8, Err(SkippedLine::Type("Bluetooth".into()))),
                (9, Err(SkippedLine::Fields(2))),
                (10, Err(SkippedLine::Name(NameError::Empty))),
                (11, Ok("Cell, 9".into())),
            ]
        );
        let told = found[1].1.as_ref().unwrap_err().problem(4).unwrap();
        assert_eq!(told, Problem::with_detail(ErrorCode::NameTaken, "line 4: the name also stands in line 2"));
    }

    /// Cases 03 and 05: the same list after "Save" in Excel, LibreOffice and PowerShell.
    #[test]
    fn lists_as_spreadsheets_save_them_give_the_same_controllers() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
        for (name, first) in [
            ("03-csv/con-columns-reordered.csv", 2),
            ("03-csv/con-excel-trailing.csv", 2),
            ("03-csv/con-semicolon.csv", 2),
            ("03-csv/con-sep.csv", 3),
            ("05-utf16/con-utf16.csv", 2),
        ] {
            let list = ConnectionList::parse(&std::fs::read(folder.join(name)).unwrap());
            let plan = list.unwrap_or_else(|e| panic!("{name}: {e}")).plan(&Configuration::default());
            let found: Vec<_> = plan
                .into_iter()
                .map(|planned| {
                    (planned.line, planned.verdict.map(|new| (new.name.to_string(), new.address.to_string())))
                })
                .collect();
            let controller = |name: &str, address: &str| Ok((name.to_owned(), address.to_owned()));
            let expected = [
                (first, controller("Zelle 1", "192.168.10.1")),
                (first + 1, controller("Zelle für 2", "192.168.10.2")),
                (first + 2, controller("装配线 4", "192.168.10.4")),
            ];
            assert_eq!(found, expected, "{name}");
        }
        let typed = "#TYPE System.Management.Automation.PSCustomObject\r\n\"Name\",\"Note\",\"Type\",\"Address\"\r\n\
                     \"Cell 1\",\"\",\"Ethernet\",\"10.0.0.1\"\r\n\"Cell 2\",\"x\",\"USB\"\r\n";
        assert_eq!(verdicts(typed, &[]), [(3, Ok("Cell 1".into())), (4, Err(SkippedLine::Usb))]);
    }

    #[test]
    fn addresses_from_practice_are_taken_or_named() {
        let text = include_str!("../../tests/cases/03-csv/con-urls.csv");
        let told: Vec<_> =
            verdicts(text, &[]).into_iter().map(|(_, verdict)| verdict.map_err(|e| e.to_string())).collect();
        for (row, part) in [
            (0, "leave out \"opc.tcp://\""),
            (1, "leave out \"https://\""),
            (2, "leading zeros; write 192.168.10.1"),
            (4, "zone \"%eth0\""),
            (5, "zone \"%eth0\""),
            (7, "characters that are not ASCII"),
            (8, "leave out \"/24\""),
            (9, "6 fields"),
            (10, "characters that are not ASCII"),
            (11, "is not a port"),
            (13, "not a type of connection"),
            (14, "not a type of connection"),
            (16, "not an IP address or a host name"),
            (17, "not an IP address or a host name"),
        ] {
            let told = told[row].as_ref().unwrap_err();
            assert!(told.contains(part), "row {row}: {told}");
        }
        for (row, name) in [(3, "d"), (6, "g"), (12, "m"), (15, "p")] {
            assert_eq!(told[row].as_deref(), Ok(name), "row {row}");
        }
    }

    #[test]
    fn what_is_no_connection_list_is_refused() {
        let refused = |bytes: &[u8]| ConnectionList::parse(bytes).unwrap_err();
        let columns = |names: &str| ConnectionListError::Columns(names.to_owned());
        assert_eq!(refused(b""), columns(""));
        assert_eq!(refused(b"Name;Adresse;Typ\n"), columns("Name, Adresse, Typ"));
        assert_eq!(refused(b"Passw0rd1\n"), columns(""));
        let long = format!("name,{}", "x".repeat(100));
        assert_eq!(refused(long.as_bytes()), columns(&format!("name, {}…", "x".repeat(MAX_SHOWN - 6))));
        let told = refused(b"Name;Adresse;Typ\n").to_string();
        assert_eq!(told, "the first line does not name the columns Name, Type and Address but \"Name, Adresse, Typ\"");
        assert_eq!(refused(b"Name,Type,Address\n\xff"), ConnectionListError::Text(TextError::NotUtf8 { line: 2 }));
        let large = vec![b'\n'; MAX_CONNECTION_LIST_BYTES + 1];
        assert_eq!(refused(&large), ConnectionListError::TooLarge(large.len()));
        let many = format!("Name,Type,Address\n{}", "a,USB,\n".repeat(MAX_CONNECTIONS + 1));
        assert_eq!(refused(many.as_bytes()), ConnectionListError::TooMany);
    }

    #[test]
    fn a_truncated_or_damaged_list_never_panics() {
        let configuration = Configuration::default();
        let bytes = SAMPLE.as_bytes();
        for position in 0..bytes.len() {
            let _ = ConnectionList::parse(&bytes[..position]).map(|list| list.plan(&configuration));
            for flip in [0x01, 0x0e, 0x80, 0xff] {
                let mut damaged = bytes.to_vec();
                damaged[position] ^= flip;
                if let Ok(list) = ConnectionList::parse(&damaged) {
                    assert!(list.plan(&configuration).len() <= 7);
                }
            }
        }
    }
}
