//! The plant API: another process of the same account acts on the cells of a fleet, as the plant around them would. The file
//! `plant.json` in the fleet's folder, which only this account can read, says where and with which token.
//!
//! One connection over the loopback, any number of requests. A request is a line of JSON, `{"token": …, "serial": …,
//! "command": …}`, its command one of [`COMMANDS`](super::cell::COMMANDS) or missing. The answer is a line of JSON with the
//! state of the cell afterwards, `{"serial": …, "refused": …, "state": …}`, `refused` being the reason or `null`; or
//! `{"error": …}`.

use std::io::{self, BufRead as _, BufReader, Read as _, Write as _};
use std::net::{Ipv4Addr, SocketAddr, TcpStream};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use std::{fs, str};

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use subtle::ConstantTimeEq as _;
use thiserror::Error;
use tokio::io::{AsyncBufReadExt as _, AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpListener;
use tokio::sync::Semaphore;
use tokio::time::timeout;
use tokio_util::sync::{CancellationToken, DropGuard};

use super::cell::{CellCommand, CellHandle, CellSnapshot, StatusFlag};
use crate::model::SerialNumber;
use crate::platform::private;

/// Where the plant API of a running fleet is.
#[derive(Debug, Serialize, Deserialize)]
struct Announcement {
    address: SocketAddr,
    token: String,
}

#[derive(Debug, Serialize, Deserialize)]
struct Request {
    token: String,
    serial: SerialNumber,
    #[serde(default)]
    command: Option<String>,
}

/// Why the plant API gave no answer.
#[derive(Debug, Error)]
pub enum PlantError {
    /// The file is missing or unreadable: no fleet runs with this folder.
    #[error("{path}: {source}")]
    NotRunning {
        /// The file.
        path: PathBuf,
        /// Why it could not be read.
        source: io::Error,
    },
    /// The fleet does not answer any more.
    #[error("the virtual controllers do not answer: {0}")]
    Connection(#[from] io::Error),
    /// The fleet does not know what to do with the request.
    #[error("{0}")]
    Refused(String),
}

/// The answer about one cell.
#[derive(Debug, Clone, PartialEq)]
pub struct PlantAnswer {
    /// Why the command was refused.
    pub refused: Option<String>,
    /// The state of the cell after it.
    pub state: Value,
}

/// Gives a command to a cell of the fleet with this folder, in another process, or only asks for its state. Blocks for at most
/// ten seconds.
pub fn ask_plant(data: &Path, serial: &SerialNumber, command: Option<&str>) -> Result<PlantAnswer, PlantError> {
    let path = path(data);
    let read = || -> io::Result<Announcement> {
        let mut content = Vec::new();
        fs::File::open(&path)?.take(MAX_LINE as u64).read_to_end(&mut content)?;
        Ok(serde_json::from_slice(&content)?)
    };
    let Announcement { address, token } = read().map_err(|source| PlantError::NotRunning { path, source })?;
    let mut stream = TcpStream::connect_timeout(&address, STEP_LIMIT)?;
    stream.set_read_timeout(Some(STEP_LIMIT))?;
    stream.set_write_timeout(Some(STEP_LIMIT))?;
    let request = Request { token, serial: serial.clone(), command: command.map(str::to_owned) };
    let mut line = serde_json::to_vec(&request).map_err(io::Error::from)?;
    line.push(b'\n');
    stream.write_all(&line)?;
    let mut answer = String::new();
    BufReader::new(stream.take(MAX_ANSWER as u64)).read_line(&mut answer)?;
    let mut answer: Value = serde_json::from_str(&answer).map_err(io::Error::from)?;
    if let Some(error) = answer["error"].as_str() {
        return Err(PlantError::Refused(error.to_owned()));
    }
    Ok(PlantAnswer { refused: answer["refused"].as_str().map(str::to_owned), state: answer["state"].take() })
}

fn path(data: &Path) -> PathBuf {
    data.join("plant.json")
}

/// Serves the plant API as long as what is returned lives.
pub(super) async fn serve(data: &Path, cells: Vec<(SerialNumber, CellHandle)>) -> io::Result<DropGuard> {
    let listener = TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await?;
    let mut secret = [0; 32];
    getrandom::fill(&mut secret).map_err(|error| io::Error::other(error.to_string()))?;
    let announcement = Announcement { address: listener.local_addr()?, token: hex::encode(secret) };
    let path = path(data);
    announce(&path, &announcement)?;
    let off = CancellationToken::new();
    let guard = off.clone().drop_guard();
    let plant = Arc::new(Plant { token: announcement.token, cells });
    tokio::spawn(async move {
        off.run_until_cancelled_owned(accept(listener, plant)).await;
        // What it says is not true any more. A fleet that was started since has written its own.
        let _gone = remove_own(&path, &announcement.address);
    });
    Ok(guard)
}

fn announce(path: &Path, announcement: &Announcement) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    private::create_file(path)?.write_all(&serde_json::to_vec(announcement)?)
}

fn remove_own(path: &Path, address: &SocketAddr) -> io::Result<()> {
    let known: Announcement = serde_json::from_slice(&fs::read(path)?)?;
    if known.address == *address { fs::remove_file(path) } else { Ok(()) }
}

struct Plant {
    token: String,
    cells: Vec<(SerialNumber, CellHandle)>,
}

async fn accept(listener: TcpListener, plant: Arc<Plant>) {
    let slots = Arc::new(Semaphore::new(MAX_CONNECTIONS));
    loop {
        let Ok((stream, _)) = listener.accept().await else {
            tokio::time::sleep(PAUSE).await;
            continue;
        };
        // Beyond the limit the connection is closed.
        let Ok(slot) = Arc::clone(&slots).try_acquire_owned() else { continue };
        let plant = Arc::clone(&plant);
        tokio::spawn(async move {
            let _ended = talk(stream, &plant).await;
            drop(slot);
        });
    }
}

/// Answers line after line. A line that is too long or comes too late ends the connection.
async fn talk(stream: tokio::net::TcpStream, plant: &Plant) -> io::Result<()> {
    let (reader, mut writer) = stream.into_split();
    let mut reader = tokio::io::BufReader::new(reader);
    let mut line = Vec::new();
    loop {
        line.clear();
        let mut bounded = (&mut reader).take(MAX_LINE as u64);
        if timeout(STEP_LIMIT, bounded.read_until(b'\n', &mut line)).await?? == 0 || !line.ends_with(b"\n") {
            return Ok(());
        }
        let mut answer = plant.answer(&line).to_string();
        answer.push('\n');
        timeout(STEP_LIMIT, writer.write_all(answer.as_bytes())).await??;
    }
}

impl Plant {
    fn answer(&self, line: &[u8]) -> Value {
        let Ok(Request { token, serial, command }) = serde_json::from_slice(line) else {
            return json!({ "error": "not a request of the plant API" });
        };
        if !bool::from(token.as_bytes().ct_eq(self.token.as_bytes())) {
            return json!({ "error": "wrong token" });
        }
        let Some((_, cell)) = self.cells.iter().find(|(known, _)| *known == serial) else {
            return json!({ "error": format!("there is no virtual controller {serial}") });
        };
        let refused = match command.as_deref().map(str::parse::<CellCommand>) {
            None => None,
            Some(Ok(command)) => cell.command(command).err().map(|refusal| refusal.to_string()),
            Some(Err(unknown)) => return json!({ "error": unknown.to_string() }),
        };
        json!({ "serial": serial, "refused": refused, "state": state(&cell.snapshot(), cell) })
    }
}

/// What a person or a test wants to know of a cell at a glance.
fn state(now: &CellSnapshot, cell: &CellHandle) -> Value {
    let about = cell.description();
    let flags = now.controller.flags;
    let robots = now.robots.iter().zip(&about.robots).map(|(robot, about)| {
        json!({
            "number": about.number,
            "model": about.model.name(),
            "motors_on": robot.motors_on,
            "power_high": robot.power_high,
            "at_home": robot.at_home,
            "joints": robot.axes.iter().map(|axis| axis.position).collect::<Vec<_>>(),
            "position": robot.actual.to_array(),
        })
    });
    let tasks = now.tasks.iter().zip(&about.tasks).map(|(task, about)| {
        json!({ "number": about.number, "function": task.function, "state": format!("{:?}", task.state).to_lowercase() })
    });
    let channel = |values: &super::cell::ChannelValues| {
        json!({
            "recording": values.recording.as_str(),
            "data": values.data.as_str(),
            "error": values.error.as_str(),
        })
    };
    json!({
        "seconds": now.time.secs(),
        "mode": format!("{:?}", now.safety.mode).to_lowercase(),
        "flags": StatusFlag::ALL.into_iter().filter(|flag| flags.contains(*flag)).map(StatusFlag::name).collect::<Vec<_>>(),
        "status_code": now.controller.status_code,
        "emergency_stop": now.safety.emergency_stop,
        "door_open": now.safety.protective_stop,
        "robots": robots.collect::<Vec<_>>(),
        "tasks": tasks.collect::<Vec<_>>(),
        "force_sensor": now.force_sensor.monitors.iter().map(channel).collect::<Vec<_>>(),
        "motion_log": channel(&now.motion_log.channel),
    })
}

const STEP_LIMIT: Duration = Duration::from_secs(10);
const PAUSE: Duration = Duration::from_millis(100);
const MAX_LINE: usize = 4096;
const MAX_ANSWER: usize = 64 * 1024;
const MAX_CONNECTIONS: usize = 16;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::virtual_controller::tests::cell_handle;

    async fn ask(data: &Path, serial: &str, command: Option<&'static str>) -> Result<PlantAnswer, PlantError> {
        let (data, serial) = (data.to_owned(), serial.parse().unwrap());
        tokio::task::spawn_blocking(move || ask_plant(&data, &serial, command)).await.unwrap()
    }

    #[tokio::test]
    async fn commands_reach_the_cell_and_refusals_come_back() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(ask(folder.path(), "SN0000123", None).await, Err(PlantError::NotRunning { .. })));
        let cell = cell_handle();
        let serial: SerialNumber = "SN0000123".parse().unwrap();
        let served = serve(folder.path(), vec![(serial, cell.clone())]).await.unwrap();
        assert!(private::is_private(&path(folder.path())));

        let idle = ask(folder.path(), "SN0000123", None).await.unwrap();
        assert_eq!((idle.refused, &idle.state["flags"]), (None, &json!(["Auto", "Ready"])));
        let stopped = ask(folder.path(), "SN0000123", Some("emergency-stop on")).await.unwrap();
        assert_eq!(stopped.refused, None);
        assert_eq!(
            (&stopped.state["emergency_stop"], &stopped.state["robots"][0]["model"]),
            (&json!(true), &json!("C4-A601S"))
        );
        assert!(cell.snapshot().safety.emergency_stop);
        let refused = ask(folder.path(), "SN0000123", Some("start 0")).await.unwrap();
        assert_eq!(refused.refused.as_deref(), Some("the emergency stop is on"));

        assert!(matches!(ask(folder.path(), "SN0000999", None).await, Err(PlantError::Refused(_))));
        assert!(matches!(ask(folder.path(), "SN0000123", Some("dance")).await, Err(PlantError::Refused(_))));
        let address = serde_json::from_slice::<Announcement>(&fs::read(path(folder.path())).unwrap()).unwrap().address;
        drop(served);
        while path(folder.path()).exists() {
            tokio::task::yield_now().await;
        }
        assert!(TcpStream::connect_timeout(&address, STEP_LIMIT).is_err());
    }

    #[tokio::test]
    async fn a_stranger_without_the_token_gets_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let cell = cell_handle();
        let _served = serve(folder.path(), vec![("SN0000123".parse().unwrap(), cell.clone())]).await.unwrap();
        let address = serde_json::from_slice::<Announcement>(&fs::read(path(folder.path())).unwrap()).unwrap().address;
        let answers = tokio::task::spawn_blocking(move || {
            let say = |text: &[u8]| {
                let mut stream = TcpStream::connect(address).unwrap();
                stream.set_read_timeout(Some(STEP_LIMIT)).unwrap();
                // The peer may have closed the connection already.
                let _sent = stream.write_all(text);
                let mut answer = String::new();
                let _read = BufReader::new(stream).read_line(&mut answer);
                answer
            };
            let request = br#"{"token":"guess","serial":"SN0000123","command":"emergency-stop on"}"#;
            [say(&[request.as_slice(), b"\n"].concat()), say(b"{}\n"), say(&[b'x'; 10_000])]
        });
        assert_eq!(
            answers.await.unwrap(),
            ["{\"error\":\"wrong token\"}\n", "{\"error\":\"not a request of the plant API\"}\n", ""]
        );
        assert!(!cell.snapshot().safety.emergency_stop);
    }
}
