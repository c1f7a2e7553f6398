use std::collections::HashMap;
use std::sync::Arc;

use opcua::types::{CloseSessionRequest, NodeId, ObjectId, RequestHeader, StatusCode};

use super::channel_keys::{ChannelKeys, Sender};
use super::sessions::SessionNumber;

/// What the gate knows of the secure channel of one connection.
#[derive(Debug, Default)]
pub(super) struct ChannelState {
    /// The newest last; a client may use the one before until it has used the newest.
    keys: Vec<Arc<ChannelKeys>>,
    last: Option<LastRequest>,
    asked: HashMap<u32, PendingCreateSession>,
}

/// The last message of the client that went to the server.
#[derive(Debug, Clone, Copy)]
pub(super) struct LastRequest {
    pub(super) channel: u32,
    pub(super) token: u32,
    pub(super) sequence: u32,
}

/// A CreateSession request that the server has not answered yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PendingCreateSession {
    Session(SessionNumber),
    /// The server is made to refuse it, and the client gets this status.
    Refused(StatusCode),
}

impl ChannelState {
    pub(super) fn opened(&mut self, keys: ChannelKeys) {
        self.keys.push(Arc::new(keys));
        if self.keys.len() > 2 {
            self.keys.remove(0);
        }
    }

    pub(super) fn keys(&self, token: u32) -> Option<Arc<ChannelKeys>> {
        self.keys.iter().rev().find(|keys| keys.are_of(token)).cloned()
    }

    pub(super) fn sent(&mut self, sent: LastRequest) {
        self.last = Some(sent);
    }

    /// The server was sent an OpenSecureChannel request with this number.
    pub(super) fn renewed(&mut self, sequence: u32) {
        if let Some(last) = &mut self.last {
            last.sequence = sequence;
        }
    }

    /// False if too many requests are unanswered.
    pub(super) fn ask(&mut self, request: u32, asked: PendingCreateSession) -> bool {
        self.asked.len() < MAX_ASKED && self.asked.insert(request, asked).is_none()
    }

    pub(super) fn is_asked(&self, request: u32) -> bool {
        self.asked.contains_key(&request)
    }

    pub(super) fn answered(&mut self, request: u32) -> Option<PendingCreateSession> {
        self.asked.remove(&request)
    }

    pub(super) fn awaits_answers(&self) -> bool {
        !self.asked.is_empty()
    }

    /// CloseSession (OPC 10000-4 §5.7.4) for each of these sessions, as the next messages of the client. Call it once.
    pub(super) fn close_sessions(&self, sessions: &[NodeId]) -> Vec<u8> {
        let Some(last) = self.last else { return Vec::new() };
        let Some(keys) = self.keys(last.token) else { return Vec::new() };
        let head = [&b"MSGF\0\0\0\0"[..], &last.channel.to_le_bytes(), &last.token.to_le_bytes()].concat();
        let mut messages = Vec::new();
        let mut number = last.sequence;
        for session in sessions {
            number = if number >= LAST_SEQUENCE_NUMBER { 1 } else { number + 1 };
            let request_header = RequestHeader { authentication_token: session.clone(), ..Default::default() };
            let request = CloseSessionRequest { request_header, delete_subscriptions: true };
            let sequence = [number.to_le_bytes(), u32::MAX.to_le_bytes()].concat();
            let service = ObjectId::CloseSessionRequest_Encoding_DefaultBinary;
            messages.extend(keys.message(Sender::Client, &head, &sequence, service, &request).unwrap_or_default());
        }
        messages
    }
}

/// A client waits for the answer before it asks again.
const MAX_ASKED: usize = 16;
/// OPC 10000-6 §6.7.2.4: from here on the numbers begin again.
const LAST_SEQUENCE_NUMBER: u32 = u32::MAX - 1024;
