//! The file that says what a bridge copies: TOML.
//!
//! ```toml
//! cycle-ms = 100                  # 10 to 60000; 100 without it
//!
//! [plc]
//! to = "192.168.250.90:9600"      # the port is 9600 without it
//! transport = "tcp"               # or "udp"
//! client-node = 97                # without it, the PLC gives one
//! server-node = 90                # without it, the PLC says it
//!
//! [robot]
//! kind = "remote"                 # "same-plc", "plc" or "remote"
//! to = "tcp://192.168.250.97:5000"
//! password-file = "robot-password"
//!
//! [[row]]
//! name = "product"                # for people
//! plc = "D300-304"
//! robot = "var product"
//! direction = "to-robot"          # or "to-plc"
//! type = "u16"                    # bit, u16, i16, u32, i32, f32, bcd, bcd32, text; u16 without it, bit for bits
//! word-order = "low-first"        # or "high-first"
//! ```
//!
//! With `kind = "plc"` or `"same-plc"` a PLC stands in the place of the robot, and `robot` names addresses.

use std::path::PathBuf;
use std::time::Duration;

use serde::Deserialize;
use thiserror::Error;

use super::super::address::{AddressError, AddressRange};
use super::super::client::{ClientSettings, DEFAULT_FINS_PORT, Transport};
use super::super::data_type::{DataType, ValueError};
use super::robot::{Direction, ItemError, RobotItem, elements};
use crate::model::{self, Cause, with_cause};

/// Most bytes of a map.
pub const MAX_MAP_BYTES: usize = 1024 * 1024;

const MOST_ROWS: usize = 1_000;
const CYCLE: std::ops::RangeInclusive<u64> = 10..=60_000;
const DEFAULT_CYCLE: u64 = 100;

/// What a bridge copies, and between whom.
#[derive(Debug, Clone)]
pub struct BridgeMap {
    /// How to reach the PLC.
    pub plc: ClientSettings,
    /// How to reach the robot.
    pub robot: RobotTarget,
    /// From the beginning of a cycle to the beginning of the next one.
    pub cycle: Duration,
    /// What is copied, in this order.
    pub rows: Vec<Row>,
}

/// The robot of a bridge.
#[derive(Debug, Clone)]
pub enum RobotTarget {
    /// A PLC in the place of a robot.
    Plc(Box<ClientSettings>),
    /// A controller with remote Ethernet.
    Remote {
        /// Where it is, as text.
        to: String,
        /// The file with its password; relative to the folder of the map.
        password_file: Option<PathBuf>,
    },
}

/// A row: elements of the PLC and an item of the robot.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// For people; the PLC's elements if the file gives none.
    pub name: String,
    /// The PLC's elements.
    pub plc: AddressRange,
    /// The robot's item.
    pub item: RobotItem,
    /// Which way it is copied.
    pub direction: Direction,
}

/// Why a text is no map.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum MapError {
    /// The text is no TOML, or has other keys.
    #[error("{0}")]
    Toml(Cause),
    /// An address of a PLC is none.
    #[error("{key}: {source}")]
    Host {
        /// The key.
        key: &'static str,
        /// What is wrong with it.
        source: model::AddressError,
    },
    /// The nodes are not 1 to 254.
    #[error("{0} is no node; nodes are 1 to 254")]
    Node(u8),
    /// The cycle is too short or too long.
    #[error("cycle-ms: {0} is outside 10 to 60000")]
    Cycle(u64),
    /// There is no row.
    #[error("there is no row")]
    NoRows,
    /// There are too many rows.
    #[error("{0} rows are more than {MOST_ROWS}")]
    TooManyRows(usize),
    /// A key is missing.
    #[error("{0} is missing")]
    Missing(&'static str),
    /// A row is wrong.
    #[error("row {number}: {source}")]
    Row {
        /// Which row, from 1.
        number: usize,
        /// What is wrong with it.
        source: RowMistake,
    },
}

/// What is wrong with a row.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum RowMistake {
    /// The PLC's elements.
    #[error(transparent)]
    Address(#[from] AddressError),
    /// Type or word order.
    #[error(transparent)]
    Type(#[from] ValueError),
    /// The robot's item.
    #[error(transparent)]
    Item(#[from] ItemError),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct FileMap {
    cycle_ms: Option<u64>,
    plc: FilePlc,
    robot: FileRobot,
    #[serde(default)]
    row: Vec<FileRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct FilePlc {
    to: String,
    #[serde(default)]
    transport: FileTransport,
    client_node: Option<u8>,
    server_node: Option<u8>,
}

#[derive(Deserialize, Default)]
#[serde(rename_all = "kebab-case")]
enum FileTransport {
    #[default]
    Tcp,
    Udp,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum RobotKind {
    SamePlc,
    Plc,
    Remote,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct FileRobot {
    kind: RobotKind,
    to: Option<String>,
    #[serde(default)]
    transport: FileTransport,
    client_node: Option<u8>,
    server_node: Option<u8>,
    password_file: Option<PathBuf>,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
enum FileDirection {
    ToRobot,
    ToPlc,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct FileRow {
    name: Option<String>,
    plc: String,
    robot: String,
    direction: FileDirection,
    #[serde(rename = "type")]
    data_type: Option<String>,
    word_order: Option<String>,
}

impl BridgeMap {
    /// Reads a map.
    ///
    /// # Errors
    /// See [`MapError`].
    pub fn parse(text: &str) -> Result<Self, MapError> {
        let file: FileMap = toml::from_str(text).map_err(with_cause(MapError::Toml))?;
        let cycle = file.cycle_ms.unwrap_or(DEFAULT_CYCLE);
        if !CYCLE.contains(&cycle) {
            return Err(MapError::Cycle(cycle));
        }
        match file.row.len() {
            0 => return Err(MapError::NoRows),
            rows if rows > MOST_ROWS => return Err(MapError::TooManyRows(rows)),
            _ => {}
        }
        let FilePlc { to, transport, client_node, server_node } = file.plc;
        let plc = settings("plc.to", &to, &transport, client_node, server_node)?;
        let robot = file.robot.target(&plc)?;
        let rows = file
            .row
            .into_iter()
            .enumerate()
            .map(|(at, row)| row.checked().map_err(|source| MapError::Row { number: at + 1, source }));
        Ok(Self { plc, robot, cycle: Duration::from_millis(cycle), rows: rows.collect::<Result<_, _>>()? })
    }
}

fn settings(
    key: &'static str,
    to: &str,
    transport: &FileTransport,
    client_node: Option<u8>,
    server_node: Option<u8>,
) -> Result<ClientSettings, MapError> {
    let to = model::Address::with_default_port(to, DEFAULT_FINS_PORT);
    let to = to.map_err(|source| MapError::Host { key, source })?;
    for node in [client_node, server_node].into_iter().flatten() {
        if !(1..=254).contains(&node) {
            return Err(MapError::Node(node));
        }
    }
    let transport = match transport {
        FileTransport::Tcp => Transport::Tcp,
        FileTransport::Udp => Transport::Udp,
    };
    Ok(ClientSettings { client_node, server_node, ..ClientSettings::new(to, transport) })
}

impl FileRobot {
    fn target(self, plc: &ClientSettings) -> Result<RobotTarget, MapError> {
        let to = self.to.ok_or(MapError::Missing("robot.to"));
        Ok(match self.kind {
            // A connection of its own; over TCP a node belongs to one connection.
            RobotKind::SamePlc if plc.transport == Transport::Tcp => {
                RobotTarget::Plc(Box::new(ClientSettings { client_node: None, ..plc.clone() }))
            }
            RobotKind::SamePlc => RobotTarget::Plc(Box::new(plc.clone())),
            RobotKind::Plc => {
                let settings = settings("robot.to", &to?, &self.transport, self.client_node, self.server_node)?;
                RobotTarget::Plc(Box::new(settings))
            }
            RobotKind::Remote => RobotTarget::Remote { to: to?, password_file: self.password_file },
        })
    }
}

impl FileRow {
    fn checked(self) -> Result<Row, RowMistake> {
        let plc: AddressRange = self.plc.parse()?;
        let data_type = match &self.data_type {
            Some(name) => name.parse()?,
            None if plc.start.is_bit() => DataType::Bit,
            None => DataType::U16,
        };
        let (words, unit) = (usize::from(plc.count), data_type.words());
        if !words.is_multiple_of(unit) {
            return Err(ValueError::OddWords { words, data_type }.into());
        }
        let count = words / unit;
        elements(plc.start, data_type, count)?;
        let item = RobotItem {
            text: self.robot,
            data_type,
            count,
            word_order: self.word_order.map(|order| order.parse()).transpose()?.unwrap_or_default(),
        };
        let direction = match self.direction {
            FileDirection::ToRobot => Direction::ToRobot,
            FileDirection::ToPlc => Direction::ToPlc,
        };
        Ok(Row { name: self.name.unwrap_or_else(|| plc.to_string()), plc, item, direction })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "[plc]\nto = \"127.0.0.1\"\n[robot]\nkind = \"same-plc\"\n";

    fn with_row(row: &str) -> Result<BridgeMap, MapError> {
        BridgeMap::parse(&format!("{HEAD}[[row]]\n{row}\n"))
    }

    #[test]
    fn a_map_has_a_plc_a_robot_and_rows() {
        let map = BridgeMap::parse(
            "cycle-ms = 50\n[plc]\nto = \"10.0.0.90\"\ntransport = \"udp\"\nclient-node = 97\n\
             [robot]\nkind = \"remote\"\nto = \"tcp://10.0.0.97:5000\"\npassword-file = \"p\"\n\
             [[row]]\nname = \"speed\"\nplc = \"D100-103\"\nrobot = \"var speed\"\ndirection = \"to-robot\"\n\
             type = \"f32\"\nword-order = \"high-first\"\n\
             [[row]]\nplc = \"CIO0.00-0.07\"\nrobot = \"outb 0\"\ndirection = \"to-plc\"\n",
        )
        .unwrap();
        assert_eq!((map.cycle, map.plc.to.authority().as_str()), (Duration::from_millis(50), "10.0.0.90:9600"));
        assert_eq!((map.plc.transport, map.plc.client_node), (Transport::Udp, Some(97)));
        assert!(matches!(&map.robot, RobotTarget::Remote { to, .. } if to == "tcp://10.0.0.97:5000"));
        let [speed, bits] = &map.rows[..] else { panic!() };
        assert_eq!((speed.item.count, speed.item.data_type), (2, DataType::F32));
        assert_eq!((bits.name.as_str(), bits.item.count), ("CIO0.00-CIO0.07", 8));
        assert_eq!((bits.item.data_type, bits.direction), (DataType::Bit, Direction::ToPlc));
    }

    #[test]
    fn the_same_plc_has_a_second_connection_with_a_node_of_its_own() {
        let text = HEAD.replace("[robot]", "client-node = 97\n[robot]");
        let row = "[[row]]\nplc = \"D0\"\nrobot = \"D1\"\ndirection = \"to-robot\"\n";
        let map = BridgeMap::parse(&format!("{text}{row}")).unwrap();
        let RobotTarget::Plc(robot) = map.robot else { panic!() };
        assert_eq!((map.plc.client_node, robot.client_node), (Some(97), None));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_row() {
        let good = "plc = \"D0\"\nrobot = \"D1\"\ndirection = \"to-robot\"";
        assert!(with_row(good).is_ok());
        assert_eq!(BridgeMap::parse(HEAD).unwrap_err(), MapError::NoRows);
        for (row, wrong) in [
            (good.replace("D0", "X0"), "row 1: \"X0\" names no memory area"),
            (format!("{good}\ntype = \"u64\""), "row 1: \"u64\" is no type"),
            (format!("{good}\ntype = \"u32\""), "row 1: 1 words are not a whole number of u32 values"),
            (format!("{good}\ntype = \"bit\""), "row 1: D0: a word has no values of the type bit"),
            (format!("{good}\nword-order = \"x\""), "row 1: \"x\" is no word order"),
            (good.replace("to-robot", "both"), "unknown variant `both`"),
            (format!("{good}\ncolour = 1"), "unknown field `colour`"),
        ] {
            let error = with_row(&row).unwrap_err().to_string();
            assert!(error.contains(wrong), "{error}");
        }
        for (map, wrong) in [
            (format!("cycle-ms = 5\n{HEAD}[[row]]\n{good}"), "cycle-ms: 5 is outside 10 to 60000"),
            (format!("{HEAD}[[row]]\n{good}").replace("127.0.0.1", "http://x"), "plc.to: leave out \"http://\""),
            (format!("{HEAD}[[row]]\n{good}").replace("same-plc", "plc"), "robot.to is missing"),
            (format!("{HEAD}[[row]]\n{good}").replace("[robot]", "server-node = 255\n[robot]"), "255 is no node"),
        ] {
            let error = BridgeMap::parse(&map).unwrap_err().to_string();
            assert!(error.contains(wrong), "{error}");
        }
    }
}
