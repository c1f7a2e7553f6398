//! The remote commands of a virtual controller: text over TCP (remote Ethernet), and frames over TCP, a pseudo-terminal or a
//! serial device (remote RS232). They act on the same simulated cell that the OPC UA server shows.
//!
//! | file | idea |
//! |---|---|
//! | `options` | [`RemoteOptions`]: what is switched on, and how |
//! | `refusals` | the code of a refusal of the cell |
//! | `monitoring` | the commands of the vendor's monitoring client |
//! | `request_handler` | what the requests ask of a cell |
//! | `wire` | both forms of the messages |
//! | `conversation` | one client: login, time-outs, an Execute that runs |
//! | `backup_file` | what outlives a power-off, on disk |
//! | `connection` | a conversation over a stream |
//! | `listener` | a TCP port: one client after the other |
//! | `serial_line` | a pseudo-terminal or serial device |
//!
//! # Decisions
//! - Each port and the serial line has one client at a time. A second one is disconnected without an answer.
//! - A client of the frames opens the remote function with EOT first; until then, and until Login, every other command is
//!   refused with 11. EOT has no answer. EOT in a session begins it anew.
//! - GetIO, GetIOByte and GetIOWord read inputs, as Sw, In and InW do; the setting commands set outputs.
//! - With remote set for monitoring only, a command that is not for monitoring is refused with 20, as a condition that is not
//!   met. Logout is then accepted while tasks run; of the control device it is refused with 20.
//! - A function, robot, port or alarm that the controller does not have is refused with 99, see `refusals`.
//! - The time-out of a session does not run while an Execute does. What an Execute still does when its client is gone is
//!   ended; tasks go on.
//! - A request that was begun and is not complete when the time is over is refused with 19, in frames 100 ms after the last
//!   byte; then, over TCP, the connection is closed. So it is after ten wrong passwords, and after 64 KiB without a request,
//!   which is refused with 12.
//! - A login without a password is refused with 98 if the client reached the controller at an address of the internet and
//!   no password is set.
//! - The answers to Abort and to the Execute that it ends (99) come in this order.

mod backup_file;
mod connection;
mod conversation;
mod listener;
mod monitoring;
mod options;
mod refusals;
mod request_handler;
#[cfg(unix)]
mod serial_line;
#[cfg(test)]
mod tests;
mod wire;

use std::io;
use std::net::{IpAddr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parking_lot::Mutex;
use thiserror::Error;
use tokio::net::TcpListener;
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

pub(super) use backup_file::BackupFile;
use listener::{Form, listen};
pub use options::{RemoteOptions, RemoteRole, SerialChoice};
use request_handler::RequestHandler;
#[cfg(unix)]
use serial_line::SerialLine;

use super::cell::CellHandle;

/// The remote commands of one cell, answered until it is dropped or stopped.
#[derive(Debug)]
pub struct RemoteServer {
    text: Option<SocketAddr>,
    frames: Option<SocketAddr>,
    serial: Option<PathBuf>,
    off: CancellationToken,
    tasks: Mutex<JoinSet<()>>,
    kept: BackupFile,
}

/// Why remote commands cannot be answered.
#[derive(Debug, Error)]
pub enum RemoteServerError {
    /// A port cannot be listened on.
    #[error("remote commands cannot be listened for on {address}: {source}")]
    Listen {
        /// The address with the port.
        address: SocketAddr,
        /// The error of the operating system.
        source: io::Error,
    },
    /// A pseudo-terminal cannot be made, or a serial device not opened.
    #[error("the serial line {name} cannot be opened: {source}")]
    Serial {
        /// The device, or `pty`.
        name: String,
        /// The error of the operating system.
        source: io::Error,
    },
}

impl RemoteServer {
    /// Listens as the options say, on `bind`, for clients that act on `cell`. What clients change is not kept over a
    /// power-off. Has to be called in a runtime.
    pub async fn start(bind: IpAddr, options: RemoteOptions, cell: CellHandle) -> Result<Self, RemoteServerError> {
        Self::start_kept(bind, options, cell, BackupFile::none()).await
    }

    /// As [`RemoteServer::start`], with a file for what outlives a power-off.
    pub(super) async fn start_kept(
        bind: IpAddr,
        options: RemoteOptions,
        cell: CellHandle,
        kept: BackupFile,
    ) -> Result<Self, RemoteServerError> {
        let off = CancellationToken::new();
        let mut tasks = JoinSet::new();
        let options = Arc::new(options);
        let handler = RequestHandler::new(cell, Arc::clone(&options));
        let mut addresses = [None, None];
        let ports = [(options.text_port, Form::Text), (options.frames_port, Form::Frames)];
        for (address, (port, form)) in addresses.iter_mut().zip(ports) {
            let Some(port) = port else { continue };
            let wanted = SocketAddr::new(bind, port);
            let failed = |source| RemoteServerError::Listen { address: wanted, source };
            let listener = TcpListener::bind(wanted).await.map_err(failed)?;
            *address = Some(listener.local_addr().map_err(failed)?);
            tasks.spawn(listen(listener, form, handler.clone(), kept.clone(), off.clone()));
        }
        let serial = match &options.serial {
            Some(choice) => Some(open_serial(choice, &mut tasks, &handler, &kept, &off)?),
            None => None,
        };
        let [text, frames] = addresses;
        Ok(Self { text, frames, serial, off, tasks: Mutex::new(tasks), kept })
    }

    /// Where the text form is answered.
    pub fn text_address(&self) -> Option<SocketAddr> {
        self.text
    }

    /// Where frames are answered over TCP.
    pub fn frames_address(&self) -> Option<SocketAddr> {
        self.frames
    }

    /// The serial device, or the end of the pseudo-terminal that a client opens.
    pub fn serial_path(&self) -> Option<&Path> {
        self.serial.as_deref()
    }

    /// Disconnects the clients, closes the ports, and keeps what outlives a power-off.
    pub async fn stop(&self) {
        self.off.cancel();
        let mut tasks = std::mem::take(&mut *self.tasks.lock());
        while tasks.join_next().await.is_some() {}
        self.kept.keep().await;
    }
}

impl Drop for RemoteServer {
    fn drop(&mut self) {
        self.off.cancel();
    }
}

#[cfg(unix)]
fn open_serial(
    choice: &SerialChoice,
    tasks: &mut JoinSet<()>,
    handler: &RequestHandler,
    kept: &BackupFile,
    off: &CancellationToken,
) -> Result<PathBuf, RemoteServerError> {
    let line = SerialLine::open(choice).map_err(|source| RemoteServerError::Serial { name: name(choice), source })?;
    let path = line.path().to_owned();
    tasks.spawn(line.listen(handler.clone(), kept.clone(), off.clone()));
    Ok(path)
}

/// Windows: only TCP. A serial device server or a program for virtual COM ports carries frames to the TCP port.
#[cfg(not(unix))]
fn open_serial(
    choice: &SerialChoice,
    _tasks: &mut JoinSet<()>,
    _handler: &RequestHandler,
    _kept: &BackupFile,
    _off: &CancellationToken,
) -> Result<PathBuf, RemoteServerError> {
    Err(RemoteServerError::Serial { name: name(choice), source: io::ErrorKind::Unsupported.into() })
}

fn name(choice: &SerialChoice) -> String {
    match choice {
        SerialChoice::PseudoTerminal => "pty".to_owned(),
        SerialChoice::Device { path, .. } => path.display().to_string(),
    }
}
