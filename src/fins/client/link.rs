//! One connection to a PLC, from its handshake to its end.

use std::io;
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr};
use std::time::{Duration, Instant};

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpSocket, TcpStream, UdpSocket, lookup_host};
use tokio::time::{timeout, timeout_at};

use super::super::codec::MAX_MESSAGE_BYTES;
use super::super::codec::command::Command;
use super::super::codec::frame::{FrameDecoder, TcpFrame};
use super::super::codec::header::{Endpoint, Header, MessageKind};
use super::super::codec::response::Response;
use super::error::{ClientError, StrayAnswer};
use super::settings::{ClientSettings, Transport};
use crate::model::{Cause, with_cause};

/// The nodes of both ends of a connection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Nodes {
    /// This program.
    pub client: u8,
    /// The PLC.
    pub server: u8,
}

/// Why an exchange failed, and whether the PLC may have received the command.
#[derive(Debug)]
pub(super) struct ExchangeError {
    pub(super) was_sent: bool,
    pub(super) error: ClientError,
}

#[derive(Debug)]
pub(super) struct Link {
    line: Line,
    nodes: Nodes,
    destination: Endpoint,
    next_service_id: u8,
    pub(super) last_used: Instant,
    /// Whether a response has come over this connection.
    pub(super) is_proven: bool,
}

#[derive(Debug)]
enum Line {
    Tcp { stream: TcpStream, decoder: FrameDecoder },
    Udp(UdpSocket),
}

/// A message that came, or nothing that counts.
type Received = Option<Vec<u8>>;

impl Link {
    /// Connects and agrees on nodes, all within the time of the settings.
    pub(super) async fn open(settings: &ClientSettings) -> Result<Self, ClientError> {
        let to = settings.to.authority();
        let opened = timeout(settings.connect, async {
            let address = resolve(settings).await?;
            match settings.transport {
                Transport::Tcp => open_tcp(settings, address).await,
                Transport::Udp => open_udp(settings, address).await,
            }
        });
        let late = |_| ClientError::ConnectTimeout { to: to.clone(), after: settings.connect };
        let (line, nodes) = opened.await.map_err(late)??;
        let destination = Endpoint { network: settings.network, node: nodes.server, unit: settings.unit };
        Ok(Self { line, nodes, destination, next_service_id: 0, last_used: Instant::now(), is_proven: false })
    }

    pub(super) const fn nodes(&self) -> Nodes {
        self.nodes
    }

    /// Whether the PLC has not closed the connection while nothing was asked.
    pub(super) fn is_open(&mut self) -> bool {
        let Line::Tcp { stream, decoder } = &mut self.line else { return true };
        let mut buffer = [0; 512];
        loop {
            match stream.try_read(&mut buffer) {
                Ok(0) => return false,
                // An answer that came too late, or a confirmation; the next exchange reads over it.
                Ok(read) => decoder.feed(&buffer[..read]),
                Err(error) => return error.kind() == io::ErrorKind::WouldBlock,
            }
            loop {
                match decoder.next_frame() {
                    Ok(None) => break,
                    Ok(Some(TcpFrame::Refused(_))) | Err(_) => return false,
                    Ok(Some(_)) => {}
                }
            }
        }
    }

    /// Sends a command and waits for its response, both within `limit`. After an error over TCP the link is of no use.
    pub(super) async fn exchange(&mut self, command: &Command, limit: Duration) -> Result<Response, ExchangeError> {
        self.next_service_id = self.next_service_id.wrapping_add(1);
        let header = Header::command(self.destination, Endpoint::cpu(self.nodes.client), self.next_service_id);
        let mut message = header.encode().to_vec();
        command.encode_into(&mut message);
        let until = tokio::time::Instant::now() + limit;
        let mut was_sent = false;
        let exchanged = timeout_at(until, async {
            self.line.send(&message, &mut was_sent).await?;
            Ok(())
        });
        let mut stray = None;
        let no_answer = |stray| ClientError::NoAnswer { after: limit, stray };
        let result = match exchanged.await {
            Err(_) => Err(no_answer(None)),
            Ok(Err(error)) => Err(error),
            Ok(Ok(())) => {
                let received = timeout_at(until, self.line.response(&header, command, &mut stray)).await;
                received.unwrap_or_else(|_| Err(no_answer(stray)))
            }
        };
        if result.is_ok() {
            self.last_used = Instant::now();
            self.is_proven = true;
        }
        result.map_err(|error| ExchangeError { was_sent, error })
    }
}

impl Line {
    /// `was_sent`: whether the whole command was handed to the operating system.
    async fn send(&mut self, message: &[u8], was_sent: &mut bool) -> Result<(), ClientError> {
        let lost = with_cause(ClientError::Lost);
        let result = match self {
            Self::Tcp { stream, .. } => {
                let frame = TcpFrame::encode_message(message);
                let mut written = 0;
                loop {
                    match stream.write(&frame[written..]).await {
                        Ok(0) => break Err(io::ErrorKind::WriteZero.into()),
                        Ok(more) => written += more,
                        Err(error) => break Err(error),
                    }
                    if written == frame.len() {
                        break Ok(());
                    }
                }
            }
            Self::Udp(socket) => socket.send(message).await.map(drop),
        };
        *was_sent = result.is_ok();
        result.map_err(lost)
    }

    /// The next message. Over UDP every datagram is one.
    async fn receive(&mut self) -> Result<Received, ClientError> {
        match self {
            Self::Tcp { stream, decoder } => match next_frame(stream, decoder).await? {
                TcpFrame::Message(message) => Ok(Some(message)),
                TcpFrame::Confirmation => Ok(None),
                TcpFrame::Refused(refusal) => Err(ClientError::Refused(refusal)),
                TcpFrame::ClientNode { .. } | TcpFrame::ServerNode { .. } => Err(ClientError::UnexpectedFrame),
            },
            Self::Udp(socket) => {
                let mut buffer = vec![0; MAX_MESSAGE_BYTES + 1];
                let length = socket.recv(&mut buffer).await.map_err(with_cause(ClientError::Lost))?;
                buffer.truncate(length);
                Ok(Some(buffer))
            }
        }
    }

    /// The response to a command. What is for another request is left out, and noted.
    async fn response(
        &mut self,
        asked: &Header,
        command: &Command,
        stray: &mut Option<StrayAnswer>,
    ) -> Result<Response, ClientError> {
        loop {
            let Some(message) = self.receive().await? else { continue };
            let (header, rest) = match Header::decode(&message) {
                Ok(decoded) => decoded,
                // Anybody can send a datagram.
                Err(_) if matches!(self, Self::Udp(_)) => continue,
                Err(error) => return Err(ClientError::Header(error)),
            };
            if header.kind != MessageKind::Response || header.service_id != asked.service_id {
                *stray = Some(StrayAnswer::OtherRequest);
                continue;
            }
            if header.destination.node != asked.source.node {
                *stray = Some(StrayAnswer::ForNode(header.destination));
                continue;
            }
            if header.source != asked.destination {
                *stray = Some(StrayAnswer::FromNode(header.source));
                continue;
            }
            let response = Response::decode(rest).map_err(ClientError::Response)?;
            if response.code == command.code() {
                return Ok(response);
            }
            *stray = Some(StrayAnswer::OtherRequest);
        }
    }
}

async fn next_frame(stream: &mut TcpStream, decoder: &mut FrameDecoder) -> Result<TcpFrame, ClientError> {
    let mut buffer = [0; 4_096];
    loop {
        if let Some(frame) = decoder.next_frame().map_err(ClientError::Frame)? {
            return Ok(frame);
        }
        match stream.read(&mut buffer).await {
            Ok(0) if decoder.is_inside_frame() => {
                return Err(ClientError::Lost(Cause::finding("the PLC closed the connection inside a frame")));
            }
            Ok(0) => return Err(ClientError::Lost(Cause::finding("the PLC closed the connection"))),
            Ok(read) => decoder.feed(&buffer[..read]),
            Err(error) => return Err(ClientError::Lost(Cause::new(error))),
        }
    }
}

async fn resolve(settings: &ClientSettings) -> Result<SocketAddr, ClientError> {
    let to = settings.to.authority();
    let unreachable = |source| ClientError::Unreachable { to: to.clone(), source };
    let found: Vec<SocketAddr> = lookup_host(&to).await.map_err(|e| unreachable(Cause::new(e)))?.collect();
    // Nodes are numbers of IPv4 addresses.
    let ipv4 = found.iter().find(|address| address.is_ipv4()).or_else(|| found.first()).copied();
    ipv4.ok_or_else(|| unreachable(Cause::finding("the name has no address")))
}

async fn open_tcp(settings: &ClientSettings, address: SocketAddr) -> Result<(Line, Nodes), ClientError> {
    let connect = async {
        let socket = if address.is_ipv4() { TcpSocket::new_v4()? } else { TcpSocket::new_v6()? };
        socket.set_keepalive(true)?;
        socket.set_nodelay(true)?;
        socket.connect(address).await
    };
    let unreachable = |error| ClientError::Unreachable { to: settings.to.authority(), source: Cause::new(error) };
    let mut stream = connect.await.map_err(unreachable)?;
    let mut decoder = FrameDecoder::default();
    let request = TcpFrame::ClientNode { node: settings.client_node.map_or(0, u32::from) };
    stream.write_all(&request.encode()).await.map_err(with_cause(ClientError::Lost))?;
    let (client, server) = match next_frame(&mut stream, &mut decoder).await? {
        TcpFrame::ServerNode { error: None, client, server } => (client, server),
        TcpFrame::ServerNode { error: Some(refusal), .. } | TcpFrame::Refused(refusal) => {
            return Err(ClientError::Refused(refusal));
        }
        _ => return Err(ClientError::UnexpectedFrame),
    };
    if let Some(expected) = settings.server_node.filter(|expected| u32::from(*expected) != server) {
        return Err(ClientError::OtherNode { expected, found: server });
    }
    let node = |node: u32, of| u8::try_from(node).map_err(|_| ClientError::NodeUnknown(of));
    let nodes = Nodes { client: node(client, "this program")?, server: node(server, "the PLC")? };
    Ok((Line::Tcp { stream, decoder }, nodes))
}

async fn open_udp(settings: &ClientSettings, address: SocketAddr) -> Result<(Line, Nodes), ClientError> {
    let any = match address {
        SocketAddr::V4(_) => SocketAddr::from((Ipv4Addr::UNSPECIFIED, 0)),
        SocketAddr::V6(_) => SocketAddr::from((Ipv6Addr::UNSPECIFIED, 0)),
    };
    let open = async {
        let socket = UdpSocket::bind(any).await?;
        // From here on only datagrams of the PLC are received.
        socket.connect(address).await?;
        let local = socket.local_addr()?;
        Ok((socket, local))
    };
    let unreachable =
        |error: io::Error| ClientError::Unreachable { to: settings.to.authority(), source: Cause::new(error) };
    let (socket, local) = open.await.map_err(unreachable)?;
    let node = |given: Option<u8>, address: SocketAddr, of| {
        given.or_else(|| node_of(address.ip())).ok_or(ClientError::NodeUnknown(of))
    };
    let nodes = Nodes {
        client: node(settings.client_node, local, "this program")?,
        server: node(settings.server_node, address, "the PLC")?,
    };
    Ok((Line::Udp(socket), nodes))
}

/// The node that follows from an IP address: its last number (W421 section 5, automatic generation).
fn node_of(ip: IpAddr) -> Option<u8> {
    match ip {
        IpAddr::V4(ip) => Some(ip.octets()[3]).filter(|node| (1..=254).contains(node)),
        IpAddr::V6(_) => None,
    }
}
