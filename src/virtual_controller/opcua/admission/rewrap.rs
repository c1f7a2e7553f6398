use std::fmt;

use opcua::crypto::{KeySize as _, PrivateKey, PublicKey, SecurityPolicy, X509};
use opcua::types::StatusCode;
use parking_lot::Mutex;

use super::channel_keys::ChannelKeys;
use super::client_to_server::sequence_at;
use super::fault::Fault;
use super::frame::OpenChannelHeader;
use crate::model::{Cause, with_told_cause};
use crate::virtual_controller::opcua::start_error::InvalidParameter;

/// The server's own certificate and key, as the OPC UA crate takes them.
pub(in super::super) struct ServerKeyPair {
    key: PrivateKey,
    public: PublicKey,
    certificate: Vec<u8>,
    thumbprint: Vec<u8>,
}

/// A client with a certificate, to whose channel the gate has the keys.
///
/// OpenSecureChannel is opened here and sealed again: for the server under its own certificate, for the client under
/// what it expects. Both nonces pass as they are, so that the two derive the same symmetric keys from them, and the gate
/// does too. The server, which cannot read more than one certificate, never sees the issuers a client sends along.
pub(super) struct SecuredClient {
    policy: SecurityPolicy,
    public: PublicKey,
    thumbprint: Vec<u8>,
    /// The request under way, from its sequence header on.
    asked: Mutex<Vec<u8>>,
}

impl ServerKeyPair {
    pub(in super::super) fn new(certificate: &[u8], key_pem: &str) -> Result<Self, InvalidParameter> {
        let key = PrivateKey::from_pem(key_pem.as_bytes()).map_err(with_told_cause(InvalidParameter::Key))?;
        let unreadable = || InvalidParameter::Certificate(Cause::finding("it has no thumbprint"));
        let thumbprint = thumbprint(certificate).ok_or_else(unreadable)?;
        Ok(Self { public: key.to_public_key(), key, certificate: certificate.to_vec(), thumbprint })
    }

    /// SHA-1 of the certificate, which a client names the receiver by.
    pub(super) fn thumbprint(&self) -> &[u8] {
        &self.thumbprint
    }
}

impl SecuredClient {
    /// `leaf`: the client's own certificate, DER.
    pub(super) fn new(policy: SecurityPolicy, leaf: &[u8]) -> Result<Self, Fault> {
        let certificate = X509::from_der(leaf).map_err(|_| refused())?;
        let public = certificate.public_key().map_err(|_| refused())?;
        Ok(Self { policy, public, thumbprint: certificate.thumbprint().value().to_vec(), asked: Mutex::default() })
    }

    /// The client's request as the server can read it, if the client signed it; and its sequence number.
    pub(super) fn request(&self, own: &ServerKeyPair, chunk: &[u8]) -> Result<(u32, Vec<u8>), Fault> {
        let body = unseal(self.policy, chunk, &own.key, &self.public)?;
        let sequence = sequence_at(&body, 0).ok_or_else(refused)?;
        let sealed = self.seal(own, chunk, &body, &own.thumbprint, &own.public)?;
        *self.asked.lock() = body;
        Ok((sequence, sealed))
    }

    /// The server's answer as the client expects it, and the keys agreed on with it.
    pub(super) fn answer(&self, own: &ServerKeyPair, chunk: &[u8]) -> Result<(Option<ChannelKeys>, Vec<u8>), Fault> {
        let body = unseal(self.policy, chunk, &own.key, &own.public)?;
        let keys = ChannelKeys::new(self.policy, &std::mem::take(&mut *self.asked.lock()), &body);
        Ok((keys, self.seal(own, chunk, &body, &self.thumbprint, &self.public)?))
    }

    fn seal(
        &self,
        own: &ServerKeyPair,
        chunk: &[u8],
        body: &[u8],
        receiver_thumbprint: &[u8],
        receiver: &PublicKey,
    ) -> Result<Vec<u8>, Fault> {
        let open = OpenChannelHeader::parse(chunk)?;
        let envelope = ChunkEnvelope {
            policy: self.policy,
            channel: open.channel,
            sender: &own.certificate,
            sender_key: &own.key,
            receiver_thumbprint,
            receiver,
        };
        envelope.seal(body)
    }
}

/// Sequence header and body of an OpenSecureChannel chunk that `sender` signed, and encrypted for the owner of `key`
/// (OPC 10000-6 §6.7.2.5).
pub(in super::super) fn unseal(
    policy: SecurityPolicy,
    chunk: &[u8],
    key: &PrivateKey,
    sender: &PublicKey,
) -> Result<Vec<u8>, Fault> {
    let (head, encrypted) = chunk.split_at(OpenChannelHeader::parse(chunk)?.body);
    if encrypted.is_empty() || !encrypted.len().is_multiple_of(key.size()) {
        return Err(refused());
    }
    let mut plain = vec![0; encrypted.len()];
    let size = policy.asymmetric_decrypt(key, encrypted, &mut plain).map_err(|_| refused())?;
    plain.truncate(size);
    let signature_at = size.checked_sub(sender.size()).ok_or_else(refused)?;
    let signed = [head, &plain[..signature_at]].concat();
    policy.asymmetric_verify_signature(sender, &signed, &plain[signature_at..]).map_err(|_| refused())?;
    plain.truncate(signature_at);
    let padding = match *plain.as_slice() {
        // Longer keys need more padding than one byte counts.
        [.., low, high] if key.size() > SHORT_KEY => usize::from(u16::from_le_bytes([low, high])) + 2,
        [.., low] => usize::from(low) + 1,
        [] => return Err(refused()),
    };
    let end = plain.len().checked_sub(padding).filter(|end| *end >= SEQUENCE_HEADER).ok_or_else(refused)?;
    plain.truncate(end);
    Ok(plain)
}

/// What an OpenSecureChannel chunk is put into.
pub(in super::super) struct ChunkEnvelope<'a> {
    pub(in super::super) policy: SecurityPolicy,
    pub(in super::super) channel: u32,
    /// Certificate, or chain, of whom it comes from.
    pub(in super::super) sender: &'a [u8],
    pub(in super::super) sender_key: &'a PrivateKey,
    pub(in super::super) receiver_thumbprint: &'a [u8],
    pub(in super::super) receiver: &'a PublicKey,
}

impl ChunkEnvelope<'_> {
    /// The chunk, signed by its sender and encrypted for its receiver. `body` begins with the sequence header.
    pub(in super::super) fn seal(&self, body: &[u8]) -> Result<Vec<u8>, Fault> {
        let mut chunk = b"OPNF\0\0\0\0".to_vec();
        chunk.extend(self.channel.to_le_bytes());
        for field in [self.policy.to_uri().as_bytes(), self.sender, self.receiver_thumbprint] {
            chunk.extend((field.len() as u32).to_le_bytes());
            chunk.extend(field);
        }
        let at = chunk.len();
        chunk.extend(body);

        let padding = self.policy.asymmetric_padding_info(self.receiver);
        let used = body.len() + padding.minimum_padding + self.sender_key.size();
        let count = (padding.block_size - used % padding.block_size) % padding.block_size;
        let [low, high, ..] = count.to_le_bytes();
        chunk.extend(std::iter::repeat_n(low, count + 1));
        if padding.minimum_padding == 2 {
            chunk.push(high);
        }

        let plain_size = chunk.len() + self.sender_key.size() - at;
        let size = self.policy.calculate_cipher_text_size(plain_size, self.receiver);
        chunk[4..8].copy_from_slice(&((at + size) as u32).to_le_bytes());
        let mut signature = vec![0; self.sender_key.size()];
        self.policy.asymmetric_sign(self.sender_key, &chunk, &mut signature).map_err(|_| Fault::internal())?;
        chunk.extend(signature);
        let mut encrypted = vec![0; size + self.receiver.size()];
        let written = self.policy.asymmetric_encrypt(self.receiver, &chunk[at..], &mut encrypted);
        if !matches!(written, Ok(written) if written == size) {
            return Err(Fault::internal());
        }
        chunk.truncate(at);
        chunk.extend(&encrypted[..size]);
        Ok(chunk)
    }
}

/// SHA-1 of a certificate the crate can read.
fn thumbprint(certificate: &[u8]) -> Option<Vec<u8>> {
    X509::from_der(certificate).ok().map(|certificate| certificate.thumbprint().value().to_vec())
}

/// One answer to everything that may be wrong with a sealed request: telling more would help to guess keys.
fn refused() -> Fault {
    Fault::new(StatusCode::BadSecurityChecksFailed, "the request is not secured as it should be")
}

impl fmt::Debug for ServerKeyPair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ServerKeyPair")
            .field("thumbprint", &hex::encode_upper(&self.thumbprint))
            .finish_non_exhaustive()
    }
}

impl fmt::Debug for SecuredClient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SecuredClient").field("policy", &self.policy).finish_non_exhaustive()
    }
}

/// In bytes. A padding of more than one block of such a key is counted by one byte (OPC 10000-6 §6.7.2.5).
const SHORT_KEY: usize = 256;
const SEQUENCE_HEADER: usize = 8;
