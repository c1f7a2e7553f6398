use opcua::types::StatusCode;

use super::fault::Fault;

/// Bytes before anything that depends on the kind of message (OPC 10000-6 §7.1.2.2).
pub(super) const HEADER: usize = 8;
/// Bytes before the body of a chunk with symmetric security: header, channel, token, sequence number, request.
pub(super) const SYMMETRIC_HEADER: usize = HEADER + 4 + 4 + 8;
/// A Hello carries an endpoint URL of at most 4096 bytes.
pub(super) const MAX_HELLO: usize = HEADER + 5 * 4 + 4 + 4096;
/// More than an OpenSecureChannel with a chain of four certificates takes.
pub(super) const MAX_OPEN: usize = 16 * 1024;
/// Longer chains are refused.
pub(super) const MAX_SENT_CERTIFICATES: usize = 8;

/// What travels on a connection (OPC 10000-6 §7.1.2.2, §6.7.2.2).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) enum MessageKind {
    Hello,
    Acknowledge,
    Error,
    Open,
    Message,
    Close,
}

/// The first eight bytes of a message or chunk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) struct MessageHeader {
    pub(in super::super) kind: MessageKind,
    /// `F`, or for parts of a longer message `C` and `A`.
    pub(super) last: u8,
    /// Of the whole chunk, header included.
    pub(super) size: usize,
}

impl MessageHeader {
    /// `None` while fewer than [`HEADER`] bytes are there. `max_chunk` bounds messages; the rest has limits of its own.
    pub(super) fn parse(bytes: &[u8], max_chunk: usize) -> Result<Option<Self>, Fault> {
        let Some(&[a, b, c, last, ref size @ ..]) = bytes.first_chunk::<HEADER>() else { return Ok(None) };
        let (kind, min, max) = match &[a, b, c] {
            b"HEL" => (MessageKind::Hello, HEADER + 5 * 4 + 4, MAX_HELLO),
            b"ACK" => (MessageKind::Acknowledge, HEADER + 5 * 4, HEADER + 5 * 4),
            b"ERR" => (MessageKind::Error, HEADER + 4 + 4, MAX_HELLO),
            b"OPN" => (MessageKind::Open, HEADER + 4 + 3 * 4, MAX_OPEN),
            b"MSG" => (MessageKind::Message, SYMMETRIC_HEADER, max_chunk),
            b"CLO" => (MessageKind::Close, SYMMETRIC_HEADER, max_chunk),
            _ => return Err(Fault::new(StatusCode::BadTcpMessageTypeInvalid, "not an OPC UA message")),
        };
        if last != b'F' && !(kind == MessageKind::Message && matches!(last, b'C' | b'A')) {
            return Err(Fault::new(StatusCode::BadTcpMessageTypeInvalid, "not a chunk of this kind of message"));
        }
        let size = u32::from_le_bytes(*size) as usize;
        if size < min {
            return Err(Fault::new(StatusCode::BadTcpMessageTypeInvalid, "message too short"));
        }
        if size > max {
            let reason = format!("{size} bytes where at most {max} are taken");
            return Err(Fault::new(StatusCode::BadTcpMessageTooLarge, reason));
        }
        Ok(Some(Self { kind, last, size }))
    }
}

/// The longest message that a client takes, by its Hello (OPC 10000-6 §7.1.2.3): in bytes, or in chunks that its buffer
/// bounds. `None` without a limit, or for something else than a whole Hello.
pub(super) fn longest_response(hello: &[u8]) -> Option<usize> {
    let fields = hello.get(HEADER..HEADER + 5 * 4)?;
    let field = |at: usize| -> Option<usize> {
        let bytes = fields.get(at * 4..)?.first_chunk::<4>()?;
        usize::try_from(u32::from_le_bytes(*bytes)).ok()
    };
    let (buffer, bytes, chunks) = (field(1)?, field(3)?, field(4)?);
    let by_chunks = (chunks != 0).then(|| buffer.saturating_sub(CHUNK_OVERHEAD).saturating_mul(chunks));
    let by_bytes = (bytes != 0).then_some(bytes);
    by_bytes.into_iter().chain(by_chunks).min()
}

/// More than headers, padding and signature take of a chunk.
const CHUNK_OVERHEAD: usize = 1024;

/// The part of an OpenSecureChannel chunk that is not encrypted (OPC 10000-6 §6.7.2.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in super::super) struct OpenChannelHeader<'a> {
    /// 0 in the first request of a connection.
    pub(in super::super) channel: u32,
    pub(in super::super) policy_uri: &'a str,
    /// The sender's certificate, in DER, perhaps followed by its issuers.
    pub(super) certificates: &'a [u8],
    pub(super) receiver_thumbprint: &'a [u8],
    /// Where the sequence header begins, which may be encrypted as all that follows.
    pub(super) body: usize,
}

impl<'a> OpenChannelHeader<'a> {
    /// `chunk` is a whole one.
    pub(in super::super) fn parse(chunk: &'a [u8]) -> Result<Self, Fault> {
        let mut rest = chunk.get(HEADER..).unwrap_or_default();
        let channel = number(&mut rest)?;
        let policy = byte_string(&mut rest)?;
        let certificates = byte_string(&mut rest)?;
        let receiver_thumbprint = byte_string(&mut rest)?;
        let policy_uri = std::str::from_utf8(policy)
            .map_err(|_| Fault::new(StatusCode::BadSecurityPolicyRejected, "the security policy is not text"))?;
        Ok(Self { channel, policy_uri, certificates, receiver_thumbprint, body: chunk.len() - rest.len() })
    }
}

/// The channel a chunk belongs to, from the four bytes after its header.
pub(super) fn channel_of(chunk: &[u8]) -> Option<u32> {
    chunk.get(HEADER..)?.first_chunk().map(|bytes| u32::from_le_bytes(*bytes))
}

/// Takes concatenated DER certificates apart, leaf first, without looking into them. `None` for anything else, also for
/// more than [`MAX_SENT_CERTIFICATES`].
pub(super) fn split_certificates(mut bytes: &[u8]) -> Option<Vec<&[u8]>> {
    let mut certificates = Vec::new();
    while !bytes.is_empty() {
        // A sequence whose length is written the one way DER allows.
        let size = match *bytes {
            [0x30, length @ 0..=0x7f, ..] => 2 + usize::from(length),
            [0x30, 0x81, length @ 0x80..=0xff, ..] => 3 + usize::from(length),
            [0x30, 0x82, high @ 1..=0xff, low, ..] => 4 + usize::from(u16::from_be_bytes([high, low])),
            _ => return None,
        };
        if size > bytes.len() || certificates.len() == MAX_SENT_CERTIFICATES {
            return None;
        }
        let (certificate, rest) = bytes.split_at(size);
        certificates.push(certificate);
        bytes = rest;
    }
    Some(certificates)
}

fn number(rest: &mut &[u8]) -> Result<u32, Fault> {
    let (bytes, after) = rest.split_first_chunk().ok_or_else(truncated)?;
    *rest = after;
    Ok(u32::from_le_bytes(*bytes))
}

/// A byte string whose length stands before it; -1, the null one, is taken for empty.
fn byte_string<'a>(rest: &mut &'a [u8]) -> Result<&'a [u8], Fault> {
    let length = match number(rest)? {
        u32::MAX => 0,
        length => length as usize,
    };
    let (bytes, after) = rest.split_at_checked(length).ok_or_else(truncated)?;
    *rest = after;
    Ok(bytes)
}

fn truncated() -> Fault {
    Fault::new(StatusCode::BadDecodingError, "the security header does not fit into its chunk")
}

#[cfg(test)]
pub(in super::super) mod tests {
    use super::*;

    const CHUNK: usize = 65_535;

    /// An OpenSecureChannel chunk with these parts.
    pub(in super::super::super) fn open(
        channel: u32,
        policy: &str,
        certificates: &[u8],
        thumbprint: &[u8],
        body: &[u8],
    ) -> Vec<u8> {
        let mut chunk = b"OPNF\0\0\0\0".to_vec();
        chunk.extend(channel.to_le_bytes());
        for field in [policy.as_bytes(), certificates, thumbprint] {
            chunk.extend((field.len() as u32).to_le_bytes());
            chunk.extend(field);
        }
        chunk.extend(body);
        let size = chunk.len() as u32;
        chunk[4..8].copy_from_slice(&size.to_le_bytes());
        chunk
    }

    fn header(kind: &[u8; 4], size: u32) -> Result<Option<MessageHeader>, StatusCode> {
        let mut bytes = kind.to_vec();
        bytes.extend(size.to_le_bytes());
        MessageHeader::parse(&bytes, CHUNK).map_err(|fault| fault.status)
    }

    #[test]
    fn a_header_says_what_comes_and_how_much() {
        let good = |kind, last, size| Ok(Some(MessageHeader { kind, last, size }));
        assert_eq!(header(b"HELF", 60), good(MessageKind::Hello, b'F', 60));
        assert_eq!(header(b"OPNF", 16_384), good(MessageKind::Open, b'F', 16_384));
        assert_eq!(header(b"MSGC", 65_535), good(MessageKind::Message, b'C', 65_535));
        assert_eq!(header(b"CLOF", 60), good(MessageKind::Close, b'F', 60));
        assert_eq!(MessageHeader::parse(b"HELF\0\0\0", CHUNK), Ok(None), "one byte is missing");
    }

    #[test]
    fn what_is_no_message_or_lies_about_its_size_is_refused() {
        let wrong = Err(StatusCode::BadTcpMessageTypeInvalid);
        for (kind, size) in
            [(b"GET ", 60), (b"HELC", 60), (b"OPNC", 60), (b"CLOA", 60), (b"MSGX", 60), (b"HELF", 0), (b"MSGF", 23)]
        {
            assert_eq!(header(kind, size), wrong, "{kind:?} {size}");
        }
        let large = Err(StatusCode::BadTcpMessageTooLarge);
        for (kind, size) in [(b"HELF", u32::MAX), (b"HELF", 4129), (b"OPNF", 16_385), (b"MSGF", 65_536)] {
            assert_eq!(header(kind, size), large, "{kind:?} {size}");
        }
    }

    #[test]
    fn the_clear_part_of_an_open_request_is_read_and_its_lengths_are_not_believed() {
        let chunk = open(7, "policy", b"certificate", b"thumbprint", b"secret");
        let read = OpenChannelHeader::parse(&chunk).unwrap();
        assert_eq!((read.channel, read.policy_uri), (7, "policy"));
        assert_eq!((read.certificates, read.receiver_thumbprint), (&b"certificate"[..], &b"thumbprint"[..]));
        assert_eq!(&chunk[read.body..], b"secret");

        let mut null = open(0, "", b"", b"", b"");
        null[12..].fill(0xff);
        let read = OpenChannelHeader::parse(&null).unwrap();
        assert_eq!((read.policy_uri, read.certificates), ("", &b""[..]));

        for length in [0x7fff_ffff_u32, u32::MAX - 1, 100] {
            let mut chunk = open(0, "policy", b"certificate", b"thumbprint", b"");
            chunk[12..16].copy_from_slice(&length.to_le_bytes());
            assert_eq!(OpenChannelHeader::parse(&chunk).unwrap_err().status, StatusCode::BadDecodingError, "{length}");
        }
        let not_text =
            open(0, "x", b"", b"", b"").into_iter().map(|b| if b == b'x' { 0xff } else { b }).collect::<Vec<_>>();
        assert_eq!(OpenChannelHeader::parse(&not_text).unwrap_err().status, StatusCode::BadSecurityPolicyRejected);
    }

    #[test]
    fn a_hello_says_how_long_a_response_may_be() {
        let hello = |buffer: u32, bytes: u32, chunks: u32| {
            let fields = [0, buffer, 65_535, bytes, chunks].map(u32::to_le_bytes).concat();
            longest_response(&[&b"HELF\x20\0\0\0"[..], &fields, &u32::MAX.to_le_bytes()].concat())
        };
        assert_eq!(hello(65_535, 0, 0), None);
        assert_eq!(hello(65_535, 20_000, 0), Some(20_000));
        assert_eq!(hello(9216, 0, 2), Some(16_384));
        assert_eq!(hello(9216, 10_000, 2), Some(10_000));
        assert_eq!(hello(100, 0, 5), Some(0));
        assert_eq!(longest_response(b"HELF"), None);
    }

    #[test]
    fn a_chain_is_taken_apart_and_nothing_else_is() {
        let certificate = |size: usize| {
            let mut der = match size {
                0..0x80 => vec![0x30, size as u8],
                0x80..0x100 => vec![0x30, 0x81, size as u8],
                _ => vec![0x30, 0x82, (size >> 8) as u8, size as u8],
            };
            der.resize(der.len() + size, 1);
            der
        };
        let chain = [certificate(1000), certificate(200), certificate(5)];
        let sent = chain.concat();
        let split = split_certificates(&sent).unwrap();
        assert_eq!(split, chain.iter().map(Vec::as_slice).collect::<Vec<_>>());
        assert_eq!(split_certificates(b""), Some(vec![]));
        assert_eq!(split_certificates(&certificate(5).repeat(MAX_SENT_CERTIFICATES)).map(|c| c.len()), Some(8));
        assert_eq!(split_certificates(&certificate(5).repeat(MAX_SENT_CERTIFICATES + 1)), None);
        for bad in [
            &b"\x30\x82\xff\xff1234"[..],
            b"\x30",
            b"\x31\x00",
            b"\x30\x80",
            b"\x30\x81\x05aaaaa",
            b"\x30\x84\0\0\0\x01a",
        ] {
            assert_eq!(split_certificates(bad), None, "{bad:?}");
        }
        assert_eq!(split_certificates(&[&certificate(5)[..], b"x"].concat()), None);
    }
}
