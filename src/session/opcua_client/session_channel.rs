use std::sync::Arc;

use opcua::client::services::CloseSession;
use opcua::client::transport::TransportPollResult;
use opcua::client::{AsyncSecureChannel, UARequest};
use opcua::core::handle::AtomicHandle;
use opcua::types::{Error, NodeId, StatusCode};
use parking_lot::Mutex;
use tokio::task::AbortHandle;
use tokio_util::sync::{CancellationToken, DropGuard};

use super::connection::{ChannelEvents, ClientChannel};
use super::failure::{ConnectFailure, ConnectFailureCause, ConnectStage};
use super::open_session::{CLOSE, OpenSession};
use super::watched_stream::StreamObservations;

/// The channel of an open session, which the session and its subscriptions share.
pub(super) struct SessionChannel {
    secure: AsyncSecureChannel,
    token: NodeId,
    heard: Arc<Mutex<StreamObservations>>,
    /// Cancelled when the connection has ended.
    ended: CancellationToken,
    end_status: Arc<Mutex<Option<StatusCode>>>,
    /// Serves the connection.
    events: AbortHandle,
    /// Numbers of monitored items.
    pub monitored_items: AtomicHandle,
}

impl std::fmt::Debug for SessionChannel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SessionChannel").field("ended", &self.ended.is_cancelled()).finish_non_exhaustive()
    }
}

/// Disconnects. A session that was not closed expires in the server.
impl Drop for SessionChannel {
    fn drop(&mut self) {
        self.events.abort();
    }
}

impl SessionChannel {
    pub fn new(session: OpenSession) -> Self {
        let OpenSession { channel, token } = session;
        let ClientChannel { secure, events, heard, .. } = channel;
        let ended = CancellationToken::new();
        let end_status = Arc::new(Mutex::new(None));
        // The guard also reports the end if the library panics over what the server sent.
        let task = tokio::spawn(serve(events, end_status.clone(), ended.clone().drop_guard()));
        Self {
            secure,
            token,
            heard,
            ended,
            end_status,
            events: task.abort_handle(),
            monitored_items: AtomicHandle::new(1),
        }
    }

    /// Makes a request of this session: with its token and the next request handle.
    pub fn request<'a, R>(&'a self, request: impl FnOnce(&'a Self, NodeId, u32) -> R) -> R {
        request(self, self.token.clone(), self.secure.request_handle())
    }

    pub fn secure(&self) -> &AsyncSecureChannel {
        &self.secure
    }

    /// The answer to a request, unless the connection ends first.
    pub async fn answered<R>(
        &self,
        stage: ConnectStage,
        request: impl Future<Output = Result<R, Error>>,
    ) -> Result<R, ConnectFailure> {
        tokio::select! {
            biased;
            answer = request => answer.map_err(|error| ConnectFailure::from_library(stage, &error, &self.heard.lock())),
            () = self.ended.cancelled() => Err(self.end(stage)),
        }
    }

    /// Returns when the connection has ended, with the reason.
    pub async fn ended(&self) -> ConnectFailure {
        self.ended.cancelled().await;
        self.end(ConnectStage::Read)
    }

    /// Closes session and channel. A server that does not answer within 2 s is disconnected.
    pub async fn close(&self) {
        let request = self.request(|channel, token, handle| {
            CloseSession::new_manual(0, CLOSE, token, handle).delete_subscriptions(true).send(&channel.secure)
        });
        let closed = async {
            if let Err(failure) = self.answered(ConnectStage::CreateSession, request).await {
                tracing::debug!(cause = %failure.cause, "session not closed");
            }
            self.secure.close_channel().await;
            self.ended.cancelled().await;
        };
        let _late = tokio::time::timeout(CLOSE, closed).await;
    }

    fn end(&self, stage: ConnectStage) -> ConnectFailure {
        let code = self.end_status.lock().unwrap_or(StatusCode::BadConnectionClosed);
        ConnectFailure::from_library(stage, &Error::new(code, "closed"), &self.heard.lock())
    }
}

/// Serves the connection until it ends.
async fn serve(mut events: ChannelEvents, end_status: Arc<Mutex<Option<StatusCode>>>, _ended: DropGuard) {
    loop {
        if let TransportPollResult::Closed(status) = events.poll().await {
            *end_status.lock() = Some(status);
            return;
        }
    }
}

/// The server answered something else than what was asked.
pub(super) fn wrong_answer(stage: ConnectStage) -> ConnectFailure {
    ConnectFailure::of(stage, ConnectFailureCause::NotOpcUa("its answer is not what was asked for".to_owned()))
}

/// A server forgets a session in which nothing was asked for so long, in milliseconds.
pub(super) const SESSION_TIMEOUT_MS: f64 = 60_000.0;
/// Values or references in one request.
pub(super) const MAX_OPERATIONS: usize = 1_000;
