//! A simulated PLC: memory areas, FINS over TCP and UDP, several clients, node assignment, faults.
//!
//! It answers as a CJ2M does: the areas CIO, W, H, A, D, T, C and banks of extended data memory; read, write, fill,
//! multiple read, transfer, controller data, status, clock, RUN and STOP. A user program does not run: memory changes
//! when clients write it, or through [`SimulatedPlc::state`].

mod faults;
mod memory;
mod nodes;
mod service;
mod tcp;
mod udp;

use std::fmt;
use std::io;
use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::sync::Arc;

use parking_lot::{Mutex, MutexGuard};
use thiserror::Error;
use tokio::net::{TcpListener, UdpSocket};
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use super::codec::cpu::{ControllerData, OperatingMode};
use super::codec::end_code::{EndCode, KnownEndCode};
use super::codec::header::{Endpoint, Header, MessageKind};
use super::codec::response::Response;
pub use faults::Faults;
pub use memory::{Memory, MemoryError};
use nodes::ConnectedNodes;
pub use service::{PlcState, WriteRecord};

/// What a simulated PLC is.
#[derive(Debug, Clone)]
pub struct PlcConfig {
    /// Where it listens. Default 127.0.0.1; anything else lets the whole network in.
    pub bind: IpAddr,
    /// Port of TCP and UDP; 0, the default, is a free one.
    pub port: u16,
    /// Whether it listens over TCP. Default: yes.
    pub tcp: bool,
    /// Whether it listens over UDP. Default: yes.
    pub udp: bool,
    /// Its node, 1 to 254. Default 1.
    pub node: u8,
    /// Most clients over TCP at once. Default 16 (W421 7-4).
    pub connections: usize,
    /// The model that it gives as its own, at most 20 ASCII characters.
    pub model: String,
    /// Banks of extended data memory, at most 25. Default 4.
    pub extended_memory_banks: u8,
    /// The operating mode. Default RUN.
    pub mode: OperatingMode,
    /// Whether writes are refused in RUN mode, as CV series do (W227 5-3). Default: no, as CS, CJ and CP do.
    pub refuses_writes_in_run: bool,
}

impl Default for PlcConfig {
    fn default() -> Self {
        Self {
            bind: Ipv4Addr::LOCALHOST.into(),
            port: 0,
            tcp: true,
            udp: true,
            node: 1,
            connections: 16,
            model: "CJ2M-CPU35".to_owned(),
            extended_memory_banks: 4,
            mode: OperatingMode::Run,
            refuses_writes_in_run: false,
        }
    }
}

/// Why a simulated PLC does not start.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum PlcError {
    /// The port is in use, or the address is not one of this computer.
    #[error("{address} cannot be listened on")]
    Listen {
        /// Where it was to listen.
        address: SocketAddr,
        /// What the operating system says.
        source: io::Error,
    },
    /// The node is not 1 to 254.
    #[error("{0} is no node of a PLC; nodes are 1 to 254")]
    Node(u8),
    /// Neither TCP nor UDP.
    #[error("neither TCP nor UDP is switched on")]
    NoTransport,
}

/// A PLC that runs until it is shut down or dropped.
pub struct SimulatedPlc {
    shared: Arc<Shared>,
    address: SocketAddr,
    stop: CancellationToken,
    tasks: JoinSet<()>,
}

/// What all connections have in common.
struct Shared {
    node: u8,
    state: Mutex<PlcState>,
    faults: Mutex<Faults>,
    nodes: Mutex<ConnectedNodes>,
}

/// What becomes of an answer.
enum Delivery {
    /// No answer.
    Nothing,
    /// The message, whole.
    Whole(Vec<u8>),
    /// The message up to so many bytes of what travels; then the connection ends.
    Cut(Vec<u8>, usize),
}

impl SimulatedPlc {
    /// Starts to listen.
    ///
    /// # Errors
    /// See [`PlcError`].
    ///
    /// # Panics
    /// Outside a Tokio runtime.
    pub async fn start(config: PlcConfig) -> Result<Self, PlcError> {
        if !(1..=254).contains(&config.node) {
            return Err(PlcError::Node(config.node));
        }
        let (tcp, udp) = listen(&config).await?;
        let local = tcp.as_ref().map(TcpListener::local_addr).or_else(|| udp.as_ref().map(UdpSocket::local_addr));
        let asked = SocketAddr::new(config.bind, config.port);
        let listen_error = |source| PlcError::Listen { address: asked, source };
        let address = local.ok_or(PlcError::NoTransport)?.map_err(listen_error)?;
        let data = ControllerData {
            model: config.model,
            version: "02.01".to_owned(),
            program_kilowords: 60,
            data_memory_words: 32_768,
            extended_memory_banks: config.extended_memory_banks.min(25),
        };
        let shared = Arc::new(Shared {
            node: config.node,
            state: Mutex::new(PlcState::new(data, config.mode, config.refuses_writes_in_run)),
            faults: Mutex::new(Faults::default()),
            nodes: Mutex::new(ConnectedNodes::new(config.node, config.connections)),
        });
        let stop = CancellationToken::new();
        let mut tasks = JoinSet::new();
        if let Some(listener) = tcp {
            tasks.spawn(tcp::listen(listener, Arc::clone(&shared), stop.clone()));
        }
        if let Some(socket) = udp {
            tasks.spawn(udp::serve(socket, Arc::clone(&shared), stop.clone()));
        }
        Ok(Self { shared, address, stop, tasks })
    }

    /// Where it listens, over TCP and UDP.
    pub const fn address(&self) -> SocketAddr {
        self.address
    }

    /// Memory, status, clock and counters. No client is answered while this is held.
    pub fn state(&self) -> MutexGuard<'_, PlcState> {
        self.shared.state.lock()
    }

    /// The switches for faults.
    pub fn faults(&self) -> MutexGuard<'_, Faults> {
        self.shared.faults.lock()
    }

    /// The nodes of the clients that are connected over TCP.
    pub fn connected(&self) -> Vec<u8> {
        self.shared.nodes.lock().connected()
    }

    /// Ends all connections and stops to listen.
    pub async fn shutdown(mut self) {
        self.stop.cancel();
        while self.tasks.join_next().await.is_some() {}
    }
}

impl Drop for SimulatedPlc {
    fn drop(&mut self) {
        self.stop.cancel();
    }
}

impl fmt::Debug for SimulatedPlc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SimulatedPlc").field("address", &self.address).finish_non_exhaustive()
    }
}

/// TCP and UDP on the same port, which is a free one for 0.
async fn listen(config: &PlcConfig) -> Result<(Option<TcpListener>, Option<UdpSocket>), PlcError> {
    const TRIES: usize = 20;
    let asked = SocketAddr::new(config.bind, config.port);
    let error = |source| PlcError::Listen { address: asked, source };
    let mut tries = 0;
    loop {
        tries += 1;
        let tcp = if config.tcp { Some(TcpListener::bind(asked).await.map_err(error)?) } else { None };
        let address = match &tcp {
            Some(tcp) => tcp.local_addr().map_err(error)?,
            None => asked,
        };
        if !config.udp {
            return Ok((tcp, None));
        }
        match UdpSocket::bind(address).await {
            Ok(udp) => return Ok((tcp, Some(udp))),
            // The port that is free for TCP is in use for UDP.
            Err(_) if config.port == 0 && tries < TRIES => {}
            Err(source) => return Err(error(source)),
        }
    }
}

impl Shared {
    /// Executes a message and says what becomes of the answer. `delay` is waited before it.
    fn answer(&self, message: &[u8]) -> (Delivery, Faults) {
        let faults = self.faults.lock().clone();
        let Ok((header, command)) = Header::decode(message) else { return (Delivery::Nothing, faults) };
        if faults.is_silent || header.kind == MessageKind::Response {
            return (Delivery::Nothing, faults);
        }
        let response = match faults.end_code {
            Some(end) => refusal(command, end),
            None => match self.destination_error(header.destination) {
                Some(end) => refusal(command, end.into()),
                None => self.state.lock().answer(command, header.source),
            },
        };
        if faults.loses_answers || header.kind == MessageKind::CommandWithoutResponse {
            return (Delivery::Nothing, faults);
        }
        let mut answer_header = Header::response_to(&header);
        // Broadcasts and messages to the node itself are answered with the PLC's own node, as far as they name none.
        if header.destination.node == BROADCAST {
            answer_header.source.node = self.node;
        }
        if faults.answers_wrong_node {
            answer_header.destination.node = answer_header.destination.node.wrapping_add(1);
        }
        let mut answer = answer_header.encode().to_vec();
        response.encode_into(&mut answer);
        let delivery = match faults.cuts_after {
            Some(bytes) => Delivery::Cut(answer, bytes),
            None => Delivery::Whole(answer),
        };
        (delivery, faults)
    }

    /// Why a message is not for this PLC. It has no other networks and no other units than the CPU.
    fn destination_error(&self, to: Endpoint) -> Option<KnownEndCode> {
        if to.network != 0 {
            return Some(KnownEndCode::NoRoutingTables);
        }
        if ![0, self.node, BROADCAST].contains(&to.node) {
            return Some(KnownEndCode::DestinationNotInNetwork);
        }
        (to.unit != 0).then_some(KnownEndCode::UnitMissing)
    }
}

const BROADCAST: u8 = 255;

fn refusal(command: &[u8], end: EndCode) -> Response {
    let code = [0, 1].map(|at| command.get(at).copied().unwrap_or_default());
    Response::ended(super::codec::command::CommandCode(u16::from_be_bytes(code)), end)
}
