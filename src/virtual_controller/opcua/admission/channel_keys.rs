use std::fmt;

use opcua::crypto::{AesDerivedKeys, SecurityPolicy};
use opcua::types::{
    BinaryDecodable, BinaryEncodable as _, ContextOwned, CreateSessionRequest, DecodingOptions, MessageSecurityMode,
    NamespaceMap, NodeId, ObjectId, OpenSecureChannelRequest, OpenSecureChannelResponse,
};

use super::frame::{HEADER, SYMMETRIC_HEADER};

/// The keys of what a client sends on a secure channel, from the two nonces of OpenSecureChannel
/// (OPC 10000-6 §6.7.5).
///
/// Only for clients that send their issuers along. Many do so in CreateSession too, where the server cannot read it
/// either: that one request is opened, left with the client's own certificate, and closed again. The signature the
/// server gives back is over that certificate alone, as OPC 10000-4 §5.6.2.2 wants it.
pub(in super::super) struct ChannelKeys {
    policy: SecurityPolicy,
    is_encrypted: bool,
    client: AesDerivedKeys,
}

impl ChannelKeys {
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
        let client = policy.make_secure_channel_keys(answer.server_nonce.as_ref(), request.client_nonce.as_ref());
        Some(Self { policy, is_encrypted, client })
    }

    /// The same chunk with another CreateSession request in it. `None` if none is in it, or if it cannot be opened,
    /// which is for the server to complain of.
    pub(in super::super) fn edit_session_request(
        &self,
        chunk: &[u8],
        edit: impl FnOnce(&mut CreateSessionRequest),
    ) -> Option<Vec<u8>> {
        let body = self.open(chunk)?;
        let id = ObjectId::CreateSessionRequest_Encoding_DefaultBinary;
        let mut request: CreateSessionRequest = decode(&body, id)?;
        edit(&mut request);
        let contexts = contexts();
        let mut edited = body[..SEQUENCE_HEADER].to_vec();
        NodeId::from(id).encode(&mut edited, &contexts.context()).ok()?;
        request.encode(&mut edited, &contexts.context()).ok()?;
        self.close(&chunk[..CLEAR], &edited)
    }

    /// Sequence header and body (OPC 10000-6 §6.7.2).
    fn open(&self, chunk: &[u8]) -> Option<Vec<u8>> {
        let (head, sealed) = chunk.split_at_checked(CLEAR)?;
        let plain = if self.is_encrypted {
            if sealed.is_empty() || !sealed.len().is_multiple_of(BLOCK) {
                return None;
            }
            let mut plain = vec![0; sealed.len() + BLOCK];
            let size = self.policy.symmetric_decrypt(&self.client, sealed, &mut plain).ok()?;
            plain.truncate(size);
            plain
        } else {
            sealed.to_vec()
        };
        let (body, signature) =
            plain.split_at_checked(plain.len().checked_sub(self.policy.symmetric_signature_size())?)?;
        self.policy.symmetric_verify_signature(&self.client, &[head, body].concat(), signature).ok()?;
        let padding = if self.is_encrypted { usize::from(*body.last()?) + 1 } else { 0 };
        let end = body.len().checked_sub(padding).filter(|end| *end >= SEQUENCE_HEADER)?;
        Some(body[..end].to_vec())
    }

    fn close(&self, head: &[u8], body: &[u8]) -> Option<Vec<u8>> {
        let signature_size = self.policy.symmetric_signature_size();
        let mut chunk = [head, body].concat();
        if self.is_encrypted {
            let count = BLOCK - 1 - (body.len() + signature_size) % BLOCK;
            // Less than a block.
            chunk.extend(std::iter::repeat_n(count as u8, count + 1));
        }
        let size = u32::try_from(chunk.len() + signature_size).ok()?;
        chunk[4..HEADER].copy_from_slice(&size.to_le_bytes());
        let mut signature = vec![0; signature_size];
        self.policy.symmetric_sign(&self.client, &chunk, &mut signature).ok()?;
        chunk.extend(signature);
        if self.is_encrypted {
            let plain = chunk.split_off(CLEAR);
            let mut sealed = vec![0; plain.len() + BLOCK];
            let size = self.policy.symmetric_encrypt(&self.client, &plain, &mut sealed).ok()?;
            if size != plain.len() {
                return None;
            }
            chunk.extend(&sealed[..size]);
        }
        Some(chunk)
    }
}

/// A message of this type, after its sequence header.
fn decode<T: BinaryDecodable>(bytes: &[u8], id: ObjectId) -> Option<T> {
    let contexts = contexts();
    let mut body = bytes.get(SEQUENCE_HEADER..)?;
    let is_it = NodeId::decode(&mut body, &contexts.context()).ok()? == NodeId::from(id);
    if is_it { T::decode(&mut body, &contexts.context()).ok() } else { None }
}

fn contexts() -> ContextOwned {
    ContextOwned::new_default(NamespaceMap::new(), DecodingOptions::default())
}

impl fmt::Debug for ChannelKeys {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ChannelKeys").field("policy", &self.policy).finish_non_exhaustive()
    }
}

const SEQUENCE_HEADER: usize = 8;
/// Header, channel and token.
const CLEAR: usize = SYMMETRIC_HEADER - SEQUENCE_HEADER;
/// Of AES.
const BLOCK: usize = 16;
