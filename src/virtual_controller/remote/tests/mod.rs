//! The server as a plain client of today sees it: sockets and bytes, with nothing of this program on the client's side.

mod endings;
mod frames;
mod refusals;
mod text;

use std::net::{IpAddr, Ipv4Addr};
use std::time::Duration;

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio::time::timeout;

use super::{RemoteOptions, RemoteRole, RemoteServer};
use crate::model::{ControllerSeries, FirmwareVersion};
use crate::remote::Password;
use crate::virtual_controller::cell::{
    BackupMemory, Cell, CellClock, CellCommand, CellConfig, CellHandle, CellOptions, ClockRate, RobotModel,
    SpelDeclaration, SpelType,
};

const LOOPBACK: IpAddr = IpAddr::V4(Ipv4Addr::LOCALHOST);
/// No answer takes as long.
const WAIT_LIMIT: Duration = Duration::from_secs(20);

/// A cell with both robots and variables of the manual's examples; its time stands at power-on unless the clock runs.
fn cell(clock: CellClock) -> CellHandle {
    let array = |name: &str, bounds: &[u16]| SpelDeclaration {
        bounds: bounds.to_vec(),
        ..SpelDeclaration::scalar(name, SpelType::Integer)
    };
    let mut cell = Cell::new(CellConfig {
        name: "Cell 1".parse().unwrap(),
        serial: "SN0000123".parse().unwrap(),
        series: ControllerSeries::Rc800,
        firmware: FirmwareVersion::new(8, 1, 0),
        started: chrono::DateTime::from_timestamp(1_780_000_000, 0).unwrap(),
        variables: vec![
            SpelDeclaration::scalar("g_Status", SpelType::Integer),
            SpelDeclaration::scalar("g_Text$", SpelType::String),
            SpelDeclaration::scalar("g_Real", SpelType::Real),
            array("g_intArray", &[10]),
            array("g_int3Array", &[10, 10, 10]),
            SpelDeclaration { bounds: vec![2], ..SpelDeclaration::scalar("g_Names$", SpelType::String) },
        ],
        backup: BackupMemory::default(),
        options: CellOptions { robots: vec![RobotModel::C4A601S, RobotModel::Gx4A251S], ..CellOptions::default() },
    });
    // Keeps the program from starting by itself.
    cell.command(CellCommand::Stop).unwrap();
    CellHandle::new(cell, clock)
}

fn fast() -> CellClock {
    CellClock::running(ClockRate::try_from(200.0).unwrap())
}

/// Free ports for both forms.
fn options() -> RemoteOptions {
    RemoteOptions { text_port: Some(0), frames_port: Some(0), ..RemoteOptions::default() }
}

async fn start(cell: &CellHandle, options: RemoteOptions) -> RemoteServer {
    RemoteServer::start(LOOPBACK, options, cell.clone()).await.unwrap()
}

/// A client that takes what one read brings as the answer.
struct Client(TcpStream);

impl Client {
    async fn text(server: &RemoteServer) -> Self {
        Self(TcpStream::connect(server.text_address().unwrap()).await.unwrap())
    }

    async fn frames(server: &RemoteServer) -> Self {
        Self(TcpStream::connect(server.frames_address().unwrap()).await.unwrap())
    }

    /// A client that has logged in.
    async fn logged_in(server: &RemoteServer) -> Self {
        let mut client = Self::text(server).await;
        assert_eq!(client.ask("$Login,").await, "#Login,0\r\n");
        client
    }

    async fn send(&mut self, bytes: &[u8]) {
        self.0.write_all(bytes).await.unwrap();
    }

    /// What one read brings; empty once the connection is closed.
    async fn read(&mut self) -> Vec<u8> {
        let mut buffer = vec![0; 8192];
        let length = timeout(WAIT_LIMIT, self.0.read(&mut buffer)).await.expect("an answer").unwrap_or(0);
        buffer.truncate(length);
        buffer
    }

    /// One line and its answer.
    async fn ask(&mut self, line: &str) -> String {
        self.send(format!("{line}\r\n").as_bytes()).await;
        String::from_utf8(self.read().await).unwrap()
    }

    /// Sends bytes in hexadecimal, and reads the answer in hexadecimal.
    async fn exchange(&mut self, hex: &str) -> String {
        self.send(&bytes(hex)).await;
        shown(&self.read().await)
    }

    async fn is_closed(&mut self) -> bool {
        self.read().await.is_empty()
    }
}

fn bytes(hex: &str) -> Vec<u8> {
    hex.split_whitespace().map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
}

fn shown(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}

/// STX, letter, data, ETX and their checksum.
fn framed(letter: char, data: &[u8]) -> Vec<u8> {
    let mut frame = vec![2, letter as u8];
    frame.extend(data);
    frame.push(3);
    let checksum = frame[1..].iter().fold(0, |sum, byte| sum ^ byte);
    frame.push(checksum);
    frame
}
