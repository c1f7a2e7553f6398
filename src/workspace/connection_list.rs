//! The connection list of the vendor's programming environment, as a CSV file (manual 2.5.3).

use thiserror::Error;

use super::{Configuration, ControllerEntry};
use crate::model::{Address, AddressError, ControllerName, ControllerSeries, ErrorCode, NameError, Problem};

/// The columns, as the first line names them.
pub const CONNECTION_LIST_COLUMNS: [&str; 3] = ["Name", "Type", "Address"];

/// A larger file is not a connection list.
pub const MAX_CONNECTION_LIST_BYTES: usize = 1024 * 1024;

/// More entries are not read.
pub const MAX_CONNECTIONS: usize = 10_000;

/// A connection list, line by line, nothing decided yet.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ConnectionList {
    rows: Vec<Row>,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Row {
    line: u64,
    fields: Vec<String>,
}

/// Why the bytes are no connection list at all.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ConnectionListError {
    #[error("the file has {0} bytes; at most {MAX_CONNECTION_LIST_BYTES} are read")]
    TooLarge(usize),
    #[error("line {line} is not UTF-8 text")]
    NotUtf8 { line: u64 },
    #[error("the first line is not \"Name,Type,Address\"")]
    Columns,
    #[error("it has more than {MAX_CONNECTIONS} entries")]
    TooMany,
}

impl From<ConnectionListError> for Problem {
    fn from(error: ConnectionListError) -> Self {
        Self::with_detail(ErrorCode::BadConnectionList, error)
    }
}

/// What will be done with one line of the list.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlannedConnection {
    /// Counted from 1, the first line of the file included.
    pub line: u64,
    /// As it stands in the file.
    pub name: String,
    /// As it stands in the file.
    pub address: String,
    pub verdict: Result<NewConnection, Skipped>,
}

/// An entry that can be added.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NewConnection {
    pub name: ControllerName,
    pub address: Address,
}

/// Why a line is left out.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Skipped {
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
    #[error("it has {0} field{s}; name, type and address are required", s = if *.0 == 1 { "" } else { "s" })]
    Fields(usize),
    #[error("\"{0}\" is not a type of connection; known are Ethernet, USB and Virtual")]
    Type(String),
    #[error("{0}")]
    Name(NameError),
    #[error("{0}")]
    Address(AddressError),
    #[error("the name also stands in line {0}")]
    NameTwice(u64),
    #[error("the address also stands in line {0}")]
    AddressTwice(u64),
}

impl Skipped {
    /// The mistake to be told about; `None` where leaving the line out is what was wanted.
    pub fn problem(&self, line: u64) -> Option<Problem> {
        let code = match self {
            Self::Usb | Self::Virtual | Self::NameRegistered | Self::AddressRegistered(_) => return None,
            Self::Fields(_) | Self::Type(_) => ErrorCode::BadConnectionList,
            Self::Name(_) => ErrorCode::BadName,
            Self::Address(_) => ErrorCode::BadAddress,
            Self::NameTwice(_) => ErrorCode::NameTaken,
            Self::AddressTwice(_) => ErrorCode::AddressTaken,
        };
        Some(Problem::with_detail(code, format!("line {line}: {self}")))
    }
}

impl NewConnection {
    /// The entry to be registered, under a series that is a guess, since the list does not know it.
    pub fn entry(self, series: ControllerSeries) -> ControllerEntry {
        ControllerEntry::unconfirmed(self.name, self.address, series)
    }
}

impl ConnectionList {
    /// Reads UTF-8 with or without BOM, fields separated by commas and quoted where needed. Case and blanks around
    /// the names of the columns do not matter, nor do empty lines.
    pub fn parse(bytes: &[u8]) -> Result<Self, ConnectionListError> {
        if bytes.len() > MAX_CONNECTION_LIST_BYTES {
            return Err(ConnectionListError::TooLarge(bytes.len()));
        }
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let before = bytes.iter().take(error.valid_up_to()).filter(|byte| **byte == b'\n').count();
            ConnectionListError::NotUtf8 { line: before as u64 + 1 }
        })?;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        // Text that is UTF-8 cannot fail to be a list of records of any length.
        let mut records = reader.records().filter_map(Result::ok);
        let is_header = |record: &csv::StringRecord| {
            record.len() == CONNECTION_LIST_COLUMNS.len()
                && record.iter().zip(CONNECTION_LIST_COLUMNS).all(|(found, wanted)| found.eq_ignore_ascii_case(wanted))
        };
        if !records.next().as_ref().is_some_and(is_header) {
            return Err(ConnectionListError::Columns);
        }
        let mut rows = Vec::new();
        let mut lines = LineCounter { bytes: text.as_bytes(), counted: 0, line: 1 };
        for record in records.filter(|record| record.iter().any(|field| !field.is_empty())) {
            if rows.len() == MAX_CONNECTIONS {
                return Err(ConnectionListError::TooMany);
            }
            let from = record.position().map_or(0, csv::Position::byte);
            rows.push(Row { line: lines.line_from(from), fields: record.iter().map(str::to_owned).collect() });
        }
        Ok(Self { rows })
    }

    /// What an import would add to the list of controllers and what it would leave out, in the file's order.
    pub fn plan(&self, configuration: &Configuration) -> Vec<PlannedConnection> {
        let mut names = std::collections::HashMap::new();
        let mut addresses = std::collections::HashMap::new();
        let plan_one = |row: &Row| {
            let verdict = row.read(configuration).and_then(|new| {
                if let Some(line) = names.get(&new.name) {
                    return Err(Skipped::NameTwice(*line));
                }
                if let Some(line) = addresses.get(&new.address) {
                    return Err(Skipped::AddressTwice(*line));
                }
                names.insert(new.name.clone(), row.line);
                addresses.insert(new.address.clone(), row.line);
                Ok(new)
            });
            PlannedConnection { line: row.line, name: row.field(0), address: row.field(2), verdict }
        };
        self.rows.iter().map(plan_one).collect()
    }
}

/// Numbers records by the lines they stand in. The reader's own count is late by the line ends and empty lines before a
/// record.
struct LineCounter<'a> {
    bytes: &'a [u8],
    counted: usize,
    line: u64,
}

impl LineCounter<'_> {
    /// The line of the first character at `from` or after it that ends no line. Asked for ascending places only.
    fn line_from(&mut self, from: u64) -> u64 {
        let from = usize::try_from(from).unwrap_or(usize::MAX);
        for byte in self.bytes.iter().skip(self.counted) {
            if self.counted >= from && !matches!(byte, b'\r' | b'\n') {
                break;
            }
            self.counted += 1;
            self.line += u64::from(*byte == b'\n');
        }
        self.line
    }
}

impl Row {
    fn field(&self, index: usize) -> String {
        self.fields.get(index).cloned().unwrap_or_default()
    }

    fn read(&self, configuration: &Configuration) -> Result<NewConnection, Skipped> {
        let [name, kind, address] = &self.fields[..] else {
            return Err(Skipped::Fields(self.fields.len()));
        };
        match kind.to_ascii_lowercase().as_str() {
            "ethernet" => {}
            "usb" => return Err(Skipped::Usb),
            "virtual" => return Err(Skipped::Virtual),
            _ => return Err(Skipped::Type(kind.clone())),
        }
        let name: ControllerName = name.parse().map_err(Skipped::Name)?;
        let address: Address = address.parse().map_err(Skipped::Address)?;
        if configuration.controllers.iter().any(|c| c.name == name) {
            return Err(Skipped::NameRegistered);
        }
        match configuration.controllers.iter().find(|c| c.address == address) {
            Some(taken) => Err(Skipped::AddressRegistered(taken.name.clone())),
            None => Ok(NewConnection { name, address }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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

    fn verdicts(text: &str, list: &[(&str, &str)]) -> Vec<(u64, Result<String, Skipped>)> {
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
                (3, Err(Skipped::NameRegistered)),
                (4, Ok("Assembly line 3".into())),
                (5, Err(Skipped::AddressRegistered("Line 4".parse().unwrap()))),
                (6, Err(Skipped::Usb)),
                (7, Err(Skipped::Virtual)),
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
                (4, Err(Skipped::NameTwice(2))),
                (5, Err(Skipped::AddressTwice(2))),
                (6, Err(Skipped::Name(NameError::TooLong(33)))),
                (7, Err(Skipped::Address(AddressError::Host("10.0.0.999".into())))),
                (8, Err(Skipped::Type("Bluetooth".into()))),
                (9, Err(Skipped::Fields(2))),
                (10, Err(Skipped::Name(NameError::Empty))),
                (11, Ok("Cell, 9".into())),
            ]
        );
        let told = found[1].1.as_ref().unwrap_err().problem(4).unwrap();
        assert_eq!(told, Problem::with_detail(ErrorCode::NameTaken, "line 4: the name also stands in line 2"));
    }

    #[test]
    fn what_is_no_connection_list_is_refused() {
        let refused = |bytes: &[u8]| ConnectionList::parse(bytes).unwrap_err();
        assert_eq!(refused(b""), ConnectionListError::Columns);
        assert_eq!(refused(b"Name;Type;Address\n"), ConnectionListError::Columns);
        assert_eq!(refused(b"Name,Type,Address\n\xff"), ConnectionListError::NotUtf8 { line: 2 });
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
