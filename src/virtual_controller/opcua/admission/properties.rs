//! Properties that hold for all bytes a peer may send: the gate reads them before the peer is admitted.

use opcua::types::{
    ActivateSessionRequest, BinaryEncodable as _, ByteString, ContextOwned, DecodingOptions, ExtensionObject,
    NamespaceMap, NodeId, ObjectId, UserNameIdentityToken,
};
use proptest::prelude::*;

use super::chunk_buffer::ChunkBuffer;
use super::frame::{
    HEADER, MAX_HELLO, MAX_OPEN, MessageHeader, MessageKind, OpenChannelHeader, SYMMETRIC_HEADER, split_certificates,
    tests::open,
};
use super::{
    channel_keys::{ChannelKeys, Sender, decode},
    logins,
};

const CHUNK: usize = 65_535;

/// The same cases every time, and no file of those that failed: a failure prints its input.
fn cases(count: u32) -> ProptestConfig {
    let rng_seed = proptest::test_runner::RngSeed::Fixed(1);
    ProptestConfig { cases: count, failure_persistence: None, rng_seed, ..ProptestConfig::default() }
}

fn bytes(most: usize) -> impl Strategy<Value = Vec<u8>> {
    prop::collection::vec(any::<u8>(), 0..most)
}

/// A chunk of this kind, filled up to its size.
fn chunk(kind: &[u8; 4], body: &[u8]) -> Vec<u8> {
    let size = (HEADER + body.len()) as u32;
    [&kind[..], &size.to_le_bytes(), body].concat()
}

/// A sequence in DER with this many bytes in it.
fn sequence(size: usize) -> Vec<u8> {
    let head = match size {
        0..0x80 => vec![0x30, size as u8],
        0x80..0x100 => vec![0x30, 0x81, size as u8],
        _ => vec![0x30, 0x82, (size >> 8) as u8, size as u8],
    };
    [head, vec![1; size]].concat()
}

/// A login with a password in clear.
fn login(password: &[u8]) -> Vec<u8> {
    let contexts = ContextOwned::new_default(NamespaceMap::new(), DecodingOptions::default());
    let user_identity_token = ExtensionObject::from_message(UserNameIdentityToken {
        policy_id: "userpass".into(),
        user_name: "operator1".into(),
        password: ByteString::from(password),
        encryption_algorithm: Default::default(),
    });
    let mut body = vec![0; SYMMETRIC_HEADER - HEADER];
    let service = NodeId::from(ObjectId::ActivateSessionRequest_Encoding_DefaultBinary);
    service.encode(&mut body, &contexts.context()).unwrap();
    let request = ActivateSessionRequest { user_identity_token, ..Default::default() };
    request.encode(&mut body, &contexts.context()).unwrap();
    chunk(b"MSGF", &body)
}

proptest! {
    #![proptest_config(cases(1000))]

    #[test]
    fn a_header_that_is_taken_promises_no_more_than_its_kind_may_have(
        kind in prop::sample::select(vec!["HEL", "ACK", "ERR", "OPN", "MSG", "CLO", "GET", "\0\0\0"]),
        last in prop::sample::select(vec![b'F', b'C', b'A', 0]),
        size in prop_oneof![any::<u32>(), 0_u32..70_000],
        rest in bytes(16),
    ) {
        let bytes = [kind.as_bytes(), &[last], &size.to_le_bytes(), &rest].concat();
        if let Ok(header) = MessageHeader::parse(&bytes, CHUNK) {
            let header = header.expect("eight bytes are there");
            let most = match header.kind {
                MessageKind::Hello | MessageKind::Acknowledge | MessageKind::Error => MAX_HELLO,
                MessageKind::Open => MAX_OPEN,
                MessageKind::Message | MessageKind::Close => CHUNK,
            };
            prop_assert!(header.size >= HEADER && header.size <= most && header.size == size as usize);
        }
    }

    #[test]
    fn the_clear_part_of_an_open_request_is_read_as_it_was_written(
        channel: u32,
        policy in "\\PC{0,80}",
        certificates in bytes(400),
        thumbprint in bytes(30),
        body in bytes(60),
    ) {
        let chunk = open(channel, &policy, &certificates, &thumbprint, &body);
        let read = OpenChannelHeader::parse(&chunk).unwrap();
        prop_assert_eq!((read.channel, read.policy_uri), (channel, policy.as_str()));
        prop_assert_eq!((read.certificates, read.receiver_thumbprint), (&certificates[..], &thumbprint[..]));
        prop_assert_eq!(&chunk[read.body..], &body[..]);
    }

    #[test]
    fn any_open_request_is_read_or_refused(
        body in bytes(120),
        lengths in prop::collection::vec((0_usize..120, prop_oneof![0_u32..150, any::<u32>()]), 0..4),
    ) {
        let mut chunk = chunk(b"OPNF", &body);
        for (at, length) in lengths {
            if let Some(place) = chunk.get_mut(HEADER + at..HEADER + at + 4) {
                place.copy_from_slice(&length.to_le_bytes());
            }
        }
        if let Ok(read) = OpenChannelHeader::parse(&chunk) {
            let parts = read.policy_uri.len() + read.certificates.len() + read.receiver_thumbprint.len();
            prop_assert_eq!(read.body, HEADER + 4 * 4 + parts);
            prop_assert!(read.body <= chunk.len());
        }
    }

    #[test]
    fn what_is_taken_apart_is_all_that_was_sent(
        parts in prop::collection::vec(prop_oneof![0_usize..8, 120..300_usize], 0..10),
        damage in prop::option::of((0_usize..2000, any::<u8>())),
    ) {
        let mut sent: Vec<u8> = parts.iter().flat_map(|size| sequence(*size)).collect();
        if let Some((at, byte)) = damage
            && let Some(place) = sent.get_mut(at)
        {
            *place = byte;
        }
        if let Some(split) = split_certificates(&sent) {
            prop_assert_eq!(split.concat(), sent.clone());
            prop_assert!(split.len() <= 8 && split.iter().all(|part| part[0] == 0x30));
        }
    }

    #[test]
    fn bytes_pass_whole_and_in_order_however_they_come_and_whatever_is_replaced(
        chunks in prop::collection::vec((24_usize..200, any::<Option<u8>>()), 1..8),
        pieces in prop::collection::vec(1_usize..150, 1..10),
    ) {
        let (mut sent, mut expected) = (Vec::new(), Vec::new());
        for (number, (size, replaced)) in chunks.iter().enumerate() {
            let whole = chunk(b"MSGF", &vec![number as u8; size - HEADER]);
            match replaced {
                Some(length) => expected.extend(vec![0xee; usize::from(*length)]),
                None => expected.extend(&whole),
            }
            sent.extend(whole);
        }
        let (mut chunk_buffer, mut arrived, mut seen) = (ChunkBuffer::default(), Vec::<u8>::new(), 0);
        let mut pieces = pieces.into_iter().cycle();
        let mut rest = &sent[..];
        while !rest.is_empty() {
            let (piece, after) = rest.split_at(pieces.next().expect("endless").min(rest.len()));
            rest = after;
            chunk_buffer.room().extend(piece);
            while let Some(header) = chunk_buffer.next(CHUNK).unwrap() {
                match chunks[seen].1 {
                    Some(_) if chunk_buffer.chunk(header).is_none() => break,
                    Some(length) => chunk_buffer.replace(header, vec![0xee; usize::from(length)]),
                    None => chunk_buffer.pass(header),
                }
                seen += 1;
            }
            arrived.extend(chunk_buffer.good());
            chunk_buffer.sent();
        }
        prop_assert_eq!(seen, chunks.len());
        prop_assert_eq!(arrived, expected);
        prop_assert!(chunk_buffer.is_between_chunks());
    }

    #[test]
    fn no_damaged_login_gets_a_clear_password_through_or_stops_the_gate(
        damage in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4),
        cut in any::<Option<prop::sample::Index>>(),
    ) {
        let password = b"Passw0rd";
        let mut chunk = login(password);
        for (at, byte) in damage {
            let at = SYMMETRIC_HEADER + at.index(chunk.len() - SYMMETRIC_HEADER);
            chunk[at] = byte;
        }
        if let Some(cut) = cut {
            chunk.truncate(SYMMETRIC_HEADER + cut.index(chunk.len() - SYMMETRIC_HEADER));
            let size = chunk.len() as u32;
            chunk[4..8].copy_from_slice(&size.to_le_bytes());
        }
        let keys = ChannelKeys::none();
        let _ = keys.begin(Sender::Client, &chunk);
        let service = ObjectId::ActivateSessionRequest_Encoding_DefaultBinary;
        let body = keys.open(Sender::Client, &chunk).unwrap_or_default();
        let Some(mut request) = decode::<ActivateSessionRequest>(&body, service) else { return Ok(()) };
        let Some(token) = request.user_identity_token.inner_as::<UserNameIdentityToken>() else { return Ok(()) };
        match logins::passed_on(token, false, "mark") {
            Some(token) => prop_assert!(!token.encryption_algorithm.is_empty()),
            None => {
                request.user_identity_token = ExtensionObject::from_message(UserNameIdentityToken::default());
                let harmless = keys.replace(Sender::Client, &chunk, &body, service, &request).unwrap();
                prop_assert!(!harmless.windows(password.len()).any(|window| window == password));
                let header = MessageHeader::parse(&harmless, CHUNK).unwrap().expect("a header");
                prop_assert_eq!(header.size, harmless.len());
            }
        }
    }
}
