use std::fmt;

use opcua::crypto::{KeySize as _, PrivateKey, PublicKey, SecurityPolicy, X509};
use opcua::types::StatusCode;

use super::fault::Fault;
use super::frame::{HEADER, Open};

/// The server's own certificate and key, as the OPC UA crate takes them.
pub(in super::super) struct Own {
    key: PrivateKey,
    public: PublicKey,
    certificate: Vec<u8>,
    thumbprint: Vec<u8>,
}

/// A client that sent its issuers along with its certificate.
///
/// The server cannot read more than one certificate, so OpenSecureChannel is opened here and sealed again: for the
/// server under its own certificate, for the client under what it expects. Both nonces pass as they are, so the two
/// derive the same symmetric keys from them, and what follows passes untouched and unread.
pub(super) struct ChainedClient {
    policy: SecurityPolicy,
    public: PublicKey,
    thumbprint: Vec<u8>,
}

impl Own {
    pub(in super::super) fn new(certificate: &[u8], key_pem: &str) -> Result<Self, String> {
        let key = PrivateKey::from_pem(key_pem.as_bytes()).map_err(|_| "the server's key cannot be read".to_owned())?;
        let thumbprint = thumbprint(certificate).ok_or("the server's certificate cannot be read")?;
        Ok(Self { public: key.to_public_key(), key, certificate: certificate.to_vec(), thumbprint })
    }

    /// SHA-1 of the certificate, which a client names the receiver by.
    pub(super) fn thumbprint(&self) -> &[u8] {
        &self.thumbprint
    }
}

impl ChainedClient {
    /// `leaf`: the client's own certificate, DER.
    pub(super) fn new(policy: SecurityPolicy, leaf: &[u8]) -> Result<Self, Fault> {
        let certificate = X509::from_der(leaf).map_err(|_| refused())?;
        let public = certificate.public_key().map_err(|_| refused())?;
        Ok(Self { policy, public, thumbprint: certificate.thumbprint().value().to_vec() })
    }

    /// The client's request as the server can read it, if the client signed it.
    pub(super) fn request(&self, own: &Own, chunk: &[u8]) -> Result<Vec<u8>, Fault> {
        let open = Open::parse(chunk)?;
        let body = self.unseal(chunk, open.body, own, &self.public)?;
        self.seal(open.channel, &body, own, &own.thumbprint, &own.public)
    }

    /// The server's answer as the client expects it.
    pub(super) fn answer(&self, own: &Own, chunk: &[u8]) -> Result<Vec<u8>, Fault> {
        let open = Open::parse(chunk)?;
        let body = self.unseal(chunk, open.body, own, &own.public)?;
        self.seal(open.channel, &body, own, &self.thumbprint, &self.public)
    }

    /// Sequence header and body of a chunk that `sender` signed and encrypted for this server (OPC 10000-6 §6.7.2.5).
    fn unseal(&self, chunk: &[u8], at: usize, own: &Own, sender: &PublicKey) -> Result<Vec<u8>, Fault> {
        let encrypted = chunk.get(at..).unwrap_or_default();
        if encrypted.is_empty() || !encrypted.len().is_multiple_of(own.key.size()) {
            return Err(refused());
        }
        let mut plain = vec![0; encrypted.len()];
        let size = self.policy.asymmetric_decrypt(&own.key, encrypted, &mut plain).map_err(|_| refused())?;
        plain.truncate(size);
        let signature_at = size.checked_sub(sender.size()).ok_or_else(refused)?;
        let mut signed = chunk[..at].to_vec();
        signed.extend(&plain[..signature_at]);
        self.policy.asymmetric_verify_signature(sender, &signed, &plain[signature_at..]).map_err(|_| refused())?;
        plain.truncate(signature_at);
        let padding = match *plain.as_slice() {
            // Longer keys need more padding than one byte counts.
            [.., low, high] if own.key.size() > SHORT_KEY => usize::from(u16::from_le_bytes([low, high])) + 2,
            [.., low] => usize::from(low) + 1,
            [] => return Err(refused()),
        };
        let end = plain.len().checked_sub(padding).filter(|end| *end >= SEQUENCE_HEADER).ok_or_else(refused)?;
        plain.truncate(end);
        Ok(plain)
    }

    /// Signed with the server's key and encrypted for `receiver`.
    fn seal(
        &self,
        channel: u32,
        body: &[u8],
        own: &Own,
        receiver_thumbprint: &[u8],
        receiver: &PublicKey,
    ) -> Result<Vec<u8>, Fault> {
        let mut chunk = b"OPNF\0\0\0\0".to_vec();
        debug_assert_eq!(chunk.len(), HEADER);
        chunk.extend(channel.to_le_bytes());
        for field in [self.policy.to_uri().as_bytes(), &own.certificate, receiver_thumbprint] {
            chunk.extend((field.len() as u32).to_le_bytes());
            chunk.extend(field);
        }
        let at = chunk.len();
        chunk.extend(body);

        let padding = self.policy.asymmetric_padding_info(receiver);
        let used = body.len() + padding.minimum_padding + own.key.size();
        let count = (padding.block_size - used % padding.block_size) % padding.block_size;
        let [low, high, ..] = count.to_le_bytes();
        chunk.extend(std::iter::repeat_n(low, count + 1));
        if padding.minimum_padding == 2 {
            chunk.push(high);
        }

        let size = self.policy.calculate_cipher_text_size(chunk.len() + own.key.size() - at, receiver);
        chunk[4..8].copy_from_slice(&((at + size) as u32).to_le_bytes());
        let mut signature = vec![0; own.key.size()];
        self.policy.asymmetric_sign(&own.key, &chunk, &mut signature).map_err(|_| failed())?;
        chunk.extend(signature);
        let mut encrypted = vec![0; size + receiver.size()];
        let written = self.policy.asymmetric_encrypt(receiver, &chunk[at..], &mut encrypted).map_err(|_| failed())?;
        if written != size {
            return Err(failed());
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

fn failed() -> Fault {
    Fault::new(StatusCode::BadInternalError, "the answer cannot be secured")
}

impl fmt::Debug for Own {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Own").field("thumbprint", &hex::encode_upper(&self.thumbprint)).finish_non_exhaustive()
    }
}

impl fmt::Debug for ChainedClient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ChainedClient").field("policy", &self.policy).finish_non_exhaustive()
    }
}

/// In bytes. A padding of more than one block of such a key is counted by one byte (OPC 10000-6 §6.7.2.5).
const SHORT_KEY: usize = 256;
const SEQUENCE_HEADER: usize = 8;
