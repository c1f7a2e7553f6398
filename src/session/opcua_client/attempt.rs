use opcua::client::UARequest;
use opcua::client::services::Read;
use opcua::types::{NodeId, ReadValueId, StatusCode, VariableId, Variant};

use super::connection::REQUEST;
use super::failure::{ConnectFailure, ConnectFailureCause, ConnectStage, status};
use super::open_session::{OpenSession, SessionRequest};

/// What a client that was let in has read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReadServerState {
    /// `ServerStatus.State`; 0 is Running (OPC 10000-5 §12.6).
    pub state: i32,
}

/// Opens a session, reads the server's state and says goodbye.
pub(super) async fn attempt(request: SessionRequest) -> Result<ReadServerState, ConnectFailure> {
    let mut session = request.open().await?;
    let welcome = read_state(&mut session).await;
    session.close().await;
    welcome
}

async fn read_state(session: &mut OpenSession) -> Result<ReadServerState, ConnectFailure> {
    let OpenSession { channel, token } = session;
    let read = channel
        .drive(ConnectStage::Read, async |secure| {
            Read::new_manual(0, REQUEST, token.clone(), secure.request_handle())
                .node(ReadValueId::from(NodeId::from(VariableId::Server_ServerStatus_State)))
                .node(ReadValueId::from(NodeId::from(VariableId::Server_NamespaceArray)))
                .send(secure)
                .await
        })
        .await?;
    let values = read.results.unwrap_or_default();
    let [state, namespaces] = &values[..] else {
        return Err(ConnectFailure::of(
            ConnectStage::Read,
            ConnectFailureCause::NotOpcUa("its answer is not what was asked for".to_owned()),
        ));
    };
    for value in [state, namespaces] {
        if let Some(code) = value.status.filter(|code| code.is_bad()) {
            return Err(ConnectFailure::of(ConnectStage::Read, status(code, "")));
        }
    }
    match &state.value {
        Some(Variant::Int32(state)) => Ok(ReadServerState { state: *state }),
        _ => Err(ConnectFailure::of(ConnectStage::Read, status(StatusCode::BadTypeMismatch, ""))),
    }
}

/// A server that hears no more of this client forgets it soon.
pub(super) const SESSION_TIMEOUT_MS: f64 = 10_000.0;
