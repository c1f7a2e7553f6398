use std::fmt;

use opcua::crypto::{AesDerivedKeys, SecurityPolicy};
use opcua::types::{
    BinaryDecodable, BinaryEncodable, ContextOwned, DecodingOptions, MessageSecurityMode, NamespaceMap, NodeId,
    ObjectId, OpenSecureChannelRequest, OpenSecureChannelResponse,
};

use super::frame::{HEADER, SYMMETRIC_HEADER};

/// Which end of a secure channel sends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) enum Sender {
    Client,
    Server,
}

/// What opens and closes the messages of one token of a secure channel (OPC 10000-6 §6.7.5).
///
/// The gate derives the keys from the two nonces of OpenSecureChannel, as client and server do. It opens three kinds of
/// requests (CreateSession, ActivateSession, and the answers to the first); all other messages pass sealed.
pub(in super::super) struct ChannelKeys {
    policy: SecurityPolicy,
    token: u32,
    /// `None` without security.
    keys: Option<Keys>,
}

struct Keys {
    is_encrypted: bool,
    client: AesDerivedKeys,
    server: AesDerivedKeys,
}

/// How the first chunk of a message begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct MessageStart {
    pub(super) sequence: u32,
    pub(super) request: u32,
    /// `None` if no service has this number.
    pub(super) service: Option<ObjectId>,
}

impl ChannelKeys {
    /// Of a channel without security.
    pub(in super::super) fn none() -> Self {
        Self { policy: SecurityPolicy::None, token: 0, keys: None }
    }

    /// From request and answer, each beginning with its sequence header. `None` if they do not open a secured channel.
    pub(in super::super) fn new(policy: SecurityPolicy, request: &[u8], answer: &[u8]) -> Option<Self> {
        let request: OpenSecureChannelRequest =
            decode(request, ObjectId::OpenSecureChannelRequest_Encoding_DefaultBinary)?;
        let answer: OpenSecureChannelResponse =
            decode(answer, ObjectId::OpenSecureChannelResponse_Encoding_DefaultBinary)?;
        let is_encrypted = match request.security_mode {
            MessageSecurityMode::Sign => false,
            MessageSecurityMode::SignAndEncrypt => true,
            MessageSecurityMode::None | MessageSecurityMode::Invalid => return None,
        };
        let (client, server) = (request.client_nonce.as_ref(), answer.server_nonce.as_ref());
        let keys = Keys {
            is_encrypted,
            client: policy.make_secure_channel_keys(server, client),
            server: policy.make_secure_channel_keys(client, server),
        };
        Some(Self { policy, token: answer.security_token.token_id, keys: Some(keys) })
    }

    /// Whether a chunk with this token number is sealed with these keys. Without security the number means nothing.
    pub(super) fn are_of(&self, token: u32) -> bool {
        self.keys.is_none() || self.token == token
    }

    /// The same chunk with another CreateSession request in it. `None` if none is in it, or if it cannot be opened.
    #[cfg(test)]
    pub(in super::super) fn edit_session_request(
        &self,
        chunk: &[u8],
        edit: impl FnOnce(&mut opcua::types::CreateSessionRequest),
    ) -> Option<Vec<u8>> {
        let body = self.open(Sender::Client, chunk)?;
        let mut request: opcua::types::CreateSessionRequest =
            decode(&body, ObjectId::CreateSessionRequest_Encoding_DefaultBinary)?;
        edit(&mut request);
        self.replace(Sender::Client, chunk, &body, ObjectId::CreateSessionRequest_Encoding_DefaultBinary, &request)
    }

    /// How the first chunk of a message begins; its first [`BEGINNING`] bytes are enough. `None` if it is too short.
    pub(super) fn begin(&self, sender: Sender, chunk: &[u8]) -> Option<MessageStart> {
        let sealed = chunk.get(CLEAR..)?;
        let plain = match self.keys_of(sender) {
            Some((keys, true)) => {
                let mut plain = vec![0; BLOCK * 2];
                self.policy.symmetric_decrypt(keys, sealed.get(..BLOCK)?, &mut plain).ok()?;
                plain.truncate(BLOCK);
                plain
            }
            _ => sealed[..sealed.len().min(BLOCK)].to_vec(),
        };
        let (sequence, rest) = plain.split_first_chunk()?;
        let (request, mut service) = rest.split_first_chunk()?;
        let contexts = contexts();
        let service = NodeId::decode(&mut service, &contexts.context()).ok().and_then(|id| id.as_object_id().ok());
        Some(MessageStart { sequence: u32::from_le_bytes(*sequence), request: u32::from_le_bytes(*request), service })
    }

    /// Sequence header and body of a chunk (OPC 10000-6 §6.7.2). `None` if it is not sealed as it should be.
    pub(super) fn open(&self, sender: Sender, chunk: &[u8]) -> Option<Vec<u8>> {
        let (head, sealed) = chunk.split_at_checked(CLEAR)?;
        let Some((keys, is_encrypted)) = self.keys_of(sender) else { return Some(sealed.to_vec()) };
        let plain = if is_encrypted {
            if sealed.is_empty() || !sealed.len().is_multiple_of(BLOCK) {
                return None;
            }
            let mut plain = vec![0; sealed.len() + BLOCK];
            let size = self.policy.symmetric_decrypt(keys, sealed, &mut plain).ok()?;
            plain.truncate(size);
            plain
        } else {
            sealed.to_vec()
        };
        let (body, signature) =
            plain.split_at_checked(plain.len().checked_sub(self.policy.symmetric_signature_size())?)?;
        self.policy.symmetric_verify_signature(keys, &[head, body].concat(), signature).ok()?;
        let padding = if is_encrypted { usize::from(*body.last()?) + 1 } else { 0 };
        let end = body.len().checked_sub(padding).filter(|end| *end >= SEQUENCE_HEADER)?;
        Some(body[..end].to_vec())
    }

    /// `chunk` with another message in it. `body`: what [`ChannelKeys::open`] gave of it.
    pub(super) fn replace(
        &self,
        sender: Sender,
        chunk: &[u8],
        body: &[u8],
        service: ObjectId,
        message: &impl BinaryEncodable,
    ) -> Option<Vec<u8>> {
        self.message(sender, chunk.get(..CLEAR)?, body.get(..SEQUENCE_HEADER)?, service, message)
    }

    /// A message in one chunk. `head`: of the chunk, whose size is set; `sequence`: its sequence header.
    pub(in super::super) fn message(
        &self,
        sender: Sender,
        head: &[u8],
        sequence: &[u8],
        service: ObjectId,
        message: &impl BinaryEncodable,
    ) -> Option<Vec<u8>> {
        let contexts = contexts();
        let mut body = sequence.to_vec();
        NodeId::from(service).encode(&mut body, &contexts.context()).ok()?;
        message.encode(&mut body, &contexts.context()).ok()?;
        self.close(sender, head, &body)
    }

    fn close(&self, sender: Sender, head: &[u8], body: &[u8]) -> Option<Vec<u8>> {
        let mut chunk = [head, body].concat();
        let Some((keys, is_encrypted)) = self.keys_of(sender) else {
            let size = u32::try_from(chunk.len()).ok()?;
            chunk[4..HEADER].copy_from_slice(&size.to_le_bytes());
            return Some(chunk);
        };
        let signature_size = self.policy.symmetric_signature_size();
        if is_encrypted {
            let count = BLOCK - 1 - (body.len() + signature_size) % BLOCK;
            // Less than a block.
            chunk.extend(std::iter::repeat_n(count as u8, count + 1));
        }
        let size = u32::try_from(chunk.len() + signature_size).ok()?;
        chunk[4..HEADER].copy_from_slice(&size.to_le_bytes());
        let mut signature = vec![0; signature_size];
        self.policy.symmetric_sign(keys, &chunk, &mut signature).ok()?;
        chunk.extend(signature);
        if is_encrypted {
            let plain = chunk.split_off(CLEAR);
            let mut sealed = vec![0; plain.len() + BLOCK];
            let size = self.policy.symmetric_encrypt(keys, &plain, &mut sealed).ok()?;
            if size != plain.len() {
                return None;
            }
            chunk.extend(&sealed[..size]);
        }
        Some(chunk)
    }

    /// The keys of what this end sends, and whether it is encrypted.
    fn keys_of(&self, sender: Sender) -> Option<(&AesDerivedKeys, bool)> {
        let keys = self.keys.as_ref()?;
        let of_sender = match sender {
            Sender::Client => &keys.client,
            Sender::Server => &keys.server,
        };
        Some((of_sender, keys.is_encrypted))
    }
}

/// The token number of a chunk of a message, from the four bytes after its channel.
pub(super) fn token_of(chunk: &[u8]) -> Option<u32> {
    chunk.get(HEADER + 4..)?.first_chunk().map(|bytes| u32::from_le_bytes(*bytes))
}

/// A message of this type, after its sequence header.
pub(super) fn decode<T: BinaryDecodable>(bytes: &[u8], id: ObjectId) -> Option<T> {
    let contexts = contexts();
    let mut body = bytes.get(SEQUENCE_HEADER..)?;
    let is_it = NodeId::decode(&mut body, &contexts.context()).ok()? == id;
    if is_it { T::decode(&mut body, &contexts.context()).ok() } else { None }
}

pub(super) fn contexts() -> ContextOwned {
    ContextOwned::new_default(NamespaceMap::new(), DecodingOptions::default())
}

impl fmt::Debug for ChannelKeys {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ChannelKeys").field("policy", &self.policy).field("token", &self.token).finish_non_exhaustive()
    }
}

pub(super) const SEQUENCE_HEADER: usize = 8;
/// Header, channel and token.
pub(super) const CLEAR: usize = SYMMETRIC_HEADER - SEQUENCE_HEADER;
/// Of AES.
const BLOCK: usize = 16;
/// What [`ChannelKeys::begin`] needs of a chunk.
pub(super) const BEGINNING: usize = CLEAR + BLOCK;

#[cfg(test)]
mod tests {
    use opcua::types::{
        ByteString, ChannelSecurityToken, CloseSessionRequest, OpenSecureChannelResponse as Answer, RequestHeader,
    };

    use super::*;

    const POLICIES: [SecurityPolicy; 5] = [
        SecurityPolicy::Basic128Rsa15,
        SecurityPolicy::Basic256,
        SecurityPolicy::Basic256Sha256,
        SecurityPolicy::Aes128Sha256RsaOaep,
        SecurityPolicy::Aes256Sha256RsaPss,
    ];
    const CLOSE: ObjectId = ObjectId::CloseSessionRequest_Encoding_DefaultBinary;

    fn keys(policy: SecurityPolicy, security_mode: MessageSecurityMode) -> ChannelKeys {
        let contexts = contexts();
        let message = |id: ObjectId, message: &dyn Fn(&mut Vec<u8>)| {
            let mut bytes = vec![0; SEQUENCE_HEADER];
            NodeId::from(id).encode(&mut bytes, &contexts.context()).unwrap();
            message(&mut bytes);
            bytes
        };
        let nonce = |byte: u8| ByteString::from(vec![byte; policy.secure_channel_nonce_length()]);
        let request = OpenSecureChannelRequest { security_mode, client_nonce: nonce(1), ..Default::default() };
        let security_token = ChannelSecurityToken { token_id: 5, ..Default::default() };
        let answer = Answer { security_token, server_nonce: nonce(2), ..Default::default() };
        let request = message(ObjectId::OpenSecureChannelRequest_Encoding_DefaultBinary, &|bytes| {
            request.encode(bytes, &contexts.context()).unwrap();
        });
        let answer = message(ObjectId::OpenSecureChannelResponse_Encoding_DefaultBinary, &|bytes| {
            answer.encode(bytes, &contexts.context()).unwrap();
        });
        ChannelKeys::new(policy, &request, &answer).unwrap()
    }

    #[test]
    fn what_is_closed_can_be_opened_again_and_nothing_else_can() {
        let mut all = vec![ChannelKeys::none()];
        for policy in POLICIES {
            all.extend([MessageSecurityMode::Sign, MessageSecurityMode::SignAndEncrypt].map(|mode| keys(policy, mode)));
        }
        let head = [&b"MSGF\0\0\0\0"[..], &7_u32.to_le_bytes(), &5_u32.to_le_bytes()].concat();
        let sequence = [3_u32.to_le_bytes(), 4_u32.to_le_bytes()].concat();
        let request = CloseSessionRequest { request_header: RequestHeader::default(), delete_subscriptions: true };
        for keys in all {
            for sender in [Sender::Client, Sender::Server] {
                let chunk = keys.message(sender, &head, &sequence, CLOSE, &request).unwrap();
                assert_eq!(chunk.len(), u32::from_le_bytes(chunk[4..8].try_into().unwrap()) as usize);
                assert!(keys.are_of(5) && token_of(&chunk) == Some(5));
                let begin = keys.begin(sender, &chunk[..BEGINNING]).unwrap();
                assert_eq!((begin.sequence, begin.request, begin.service), (3, 4, Some(CLOSE)), "{keys:?}");
                let body = keys.open(sender, &chunk).unwrap();
                assert_eq!(decode::<CloseSessionRequest>(&body, CLOSE), Some(request.clone()));
                assert_eq!(decode::<CloseSessionRequest>(&body, ObjectId::RootFolder), None);
                if keys.keys.is_some() {
                    let other = if sender == Sender::Client { Sender::Server } else { Sender::Client };
                    assert!(keys.open(other, &chunk).is_none() && !keys.are_of(6));
                    for at in [0, 8, 12, CLEAR, chunk.len() - 1] {
                        let mut damaged = chunk.clone();
                        damaged[at] ^= 1;
                        assert!(keys.open(sender, &damaged).is_none(), "{keys:?} byte {at}");
                    }
                }
                for cut in 0..chunk.len() {
                    let _ = keys.begin(sender, &chunk[..cut]);
                    assert!(keys.keys.is_none() || keys.open(sender, &chunk[..cut]).is_none());
                }
            }
        }
    }

    #[test]
    fn a_service_is_known_by_its_number_however_that_is_written() {
        let service = |id: &[u8]| {
            let chunk = [&[0; CLEAR + SEQUENCE_HEADER][..], id].concat();
            ChannelKeys::none().begin(Sender::Client, &chunk).and_then(|begin| begin.service)
        };
        assert_eq!(service(&[1, 0, 0xd9, 1]), Some(CLOSE));
        assert_eq!(service(&[2, 0, 0, 0xd9, 1, 0, 0]), Some(CLOSE));
        for no_service in [&[][..], &[1], &[0xff, 0, 0, 0, 0, 0, 0], &[0, 0]] {
            assert_eq!(service(no_service), None, "{no_service:?}");
        }
    }
}
