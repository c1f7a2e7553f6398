//! FINS/TCP: connections, node assignment, frames (W421 7-4).

use std::io;
use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Notify;
use tokio::task::JoinSet;
use tokio::time::{sleep, timeout};
use tokio_util::sync::CancellationToken;

use super::super::codec::frame::{FrameDecoder, TcpFrame, TcpRefusal};
use super::{Delivery, Shared};

/// A client that connects and says nothing, or does not read its answers, is disconnected after this time.
const STEP_LIMIT: Duration = Duration::from_secs(10);

/// Most connections, those included whose client has no node yet.
const MOST_SOCKETS: usize = 256;

pub(super) async fn listen(listener: TcpListener, shared: Arc<Shared>, stop: CancellationToken) {
    let mut connections = JoinSet::new();
    loop {
        let accepted = tokio::select! {
            accepted = listener.accept(), if connections.len() < MOST_SOCKETS => accepted,
            Some(_) = connections.join_next() => continue,
            () = stop.cancelled() => break,
        };
        match accepted {
            Ok((stream, from)) => {
                let (shared, stop) = (Arc::clone(&shared), stop.clone());
                connections.spawn(async move {
                    tokio::select! {
                        _ended = Connection::serve(stream, from, &shared) => {}
                        () = stop.cancelled() => {}
                    }
                });
            }
            // Out of file descriptors: others may be closed meanwhile.
            Err(_) => sleep(Duration::from_millis(100)).await,
        }
    }
    connections.shutdown().await;
}

struct Connection<'a> {
    stream: TcpStream,
    decoder: FrameDecoder,
    shared: &'a Shared,
    confirm: Arc<Notify>,
}

/// Gives the node back when the connection ends, however it ends.
struct Node<'a>(u8, &'a Shared);

impl Drop for Node<'_> {
    fn drop(&mut self) {
        self.1.nodes.lock().disconnect(self.0);
    }
}

impl<'a> Connection<'a> {
    async fn serve(stream: TcpStream, from: SocketAddr, shared: &'a Shared) -> io::Result<()> {
        stream.set_nodelay(true)?;
        let confirm = Arc::new(Notify::new());
        let mut connection = Self { stream, decoder: FrameDecoder::default(), shared, confirm };
        let first = timeout(STEP_LIMIT, connection.next_frame()).await??;
        let Some(TcpFrame::ClientNode { node }) = first else {
            return connection.refuse(TcpRefusal::UnsupportedCommand).await;
        };
        let (is_silent, refused) = {
            let faults = shared.faults.lock();
            (faults.is_silent, faults.refuses)
        };
        if is_silent {
            return connection.swallow().await;
        }
        let given = match refused {
            Some(refusal) => Err(refusal),
            None => shared.nodes.lock().connect(node, from.ip(), &connection.confirm),
        };
        let server = shared.node.into();
        let _node = match given {
            Ok(client) => {
                let guard = Node(client, shared);
                connection.send(&TcpFrame::ServerNode { error: None, client: client.into(), server }).await?;
                guard
            }
            Err(refusal) => {
                return connection.send(&TcpFrame::ServerNode { error: Some(refusal), client: node, server }).await;
            }
        };
        connection.answer_frames().await
    }

    /// Reads until the client has enough.
    async fn swallow(&mut self) -> io::Result<()> {
        let mut buffer = [0; 512];
        while self.stream.read(&mut buffer).await? > 0 {}
        Ok(())
    }

    async fn answer_frames(&mut self) -> io::Result<()> {
        loop {
            let confirm = Arc::clone(&self.confirm);
            let frame = tokio::select! {
                frame = self.next_frame() => frame?,
                () = confirm.notified() => {
                    self.send(&TcpFrame::Confirmation).await?;
                    continue;
                }
            };
            match frame {
                None => return Ok(()),
                Some(TcpFrame::Message(message)) => {
                    if !self.answer(&message).await? {
                        return Ok(());
                    }
                }
                Some(TcpFrame::Confirmation) => {}
                Some(TcpFrame::Refused(_)) => return Ok(()),
                Some(TcpFrame::ClientNode { .. } | TcpFrame::ServerNode { .. }) => {
                    return self.refuse(TcpRefusal::UnsupportedCommand).await;
                }
            }
        }
    }

    /// Whether the connection goes on.
    async fn answer(&mut self, message: &[u8]) -> io::Result<bool> {
        let (delivery, faults) = self.shared.answer(message);
        let (answer, cut) = match delivery {
            Delivery::Nothing => return Ok(true),
            Delivery::Whole(answer) => (answer, None),
            Delivery::Cut(answer, bytes) => (answer, Some(bytes)),
        };
        if let Some(delay) = faults.delay {
            sleep(delay).await;
        }
        let mut frame = TcpFrame::encode_message(&answer);
        frame.truncate(cut.unwrap_or(frame.len()));
        self.write(&frame).await?;
        Ok(cut.is_none())
    }

    /// The next frame; `None` at the end of the connection. What is no frame is refused, which ends it. May be dropped
    /// and called again.
    async fn next_frame(&mut self) -> io::Result<Option<TcpFrame>> {
        let mut buffer = [0; 4_096];
        loop {
            match self.decoder.next_frame() {
                Ok(Some(frame)) => return Ok(Some(frame)),
                Ok(None) => {}
                Err(error) => {
                    self.refuse(error.refusal()).await?;
                    return Ok(None);
                }
            }
            match self.stream.read(&mut buffer).await? {
                0 => return Ok(None),
                read => self.decoder.feed(&buffer[..read]),
            }
        }
    }

    async fn refuse(&mut self, refusal: TcpRefusal) -> io::Result<()> {
        self.send(&TcpFrame::Refused(refusal)).await
    }

    async fn send(&mut self, frame: &TcpFrame) -> io::Result<()> {
        self.write(&frame.encode()).await
    }

    /// In one piece: there are clients that take one read for one answer.
    async fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        timeout(STEP_LIMIT, self.stream.write_all(bytes)).await?
    }
}
