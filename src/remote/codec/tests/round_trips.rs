//! Whatever is written is read as it was, in both forms, in pieces of any size; and no bytes confuse a decoder.

use proptest::collection::vec;
use proptest::prelude::*;

use super::*;
use crate::model::{SpelType, SpelValue, StatusFlag, StatusFlags};

fn kind() -> impl Strategy<Value = SpelType> {
    proptest::sample::select(SpelType::ALL.to_vec())
}

fn value(kind: SpelType) -> BoxedStrategy<SpelValue> {
    match kind {
        SpelType::Boolean => any::<bool>().prop_map(SpelValue::Boolean).boxed(),
        SpelType::Byte => any::<i8>().prop_map(SpelValue::Int8).boxed(),
        SpelType::Short | SpelType::Integer => any::<i16>().prop_map(SpelValue::Int16).boxed(),
        SpelType::Long | SpelType::Int32 => any::<i32>().prop_map(SpelValue::Int32).boxed(),
        SpelType::Int64 => any::<i64>().prop_map(SpelValue::Int64).boxed(),
        SpelType::UByte => any::<u8>().prop_map(SpelValue::UInt8).boxed(),
        SpelType::UShort => any::<u16>().prop_map(SpelValue::UInt16).boxed(),
        SpelType::UInt32 => any::<u32>().prop_map(SpelValue::UInt32).boxed(),
        SpelType::UInt64 => any::<u64>().prop_map(SpelValue::UInt64).boxed(),
        SpelType::Real => {
            proptest::num::f32::ANY.prop_filter("equal", |f| !f.is_nan()).prop_map(SpelValue::Float).boxed()
        }
        SpelType::Double => {
            proptest::num::f64::ANY.prop_filter("equal", |f| !f.is_nan()).prop_map(SpelValue::Double).boxed()
        }
        SpelType::String => "[ -~äé溶接]{0,60}".prop_map(SpelValue::String).boxed(),
    }
}

fn name() -> impl Strategy<Value = VariableName> {
    "[A-Za-z_][A-Za-z0-9_]{0,31}\\$?".prop_map(|name| name.parse().unwrap())
}

fn variable_read() -> impl Strategy<Value = VariableRead> {
    let range = (vec(any::<u16>(), 1..=3), 1..=100u16);
    (name(), kind(), proptest::option::of(range)).prop_map(|(name, kind, range)| {
        let range = range.and_then(|(first, count)| ElementRange::new(Element::new(&first)?, count));
        let array = range.and_then(|range| VariableRead::elements(name.clone(), kind, range));
        array.unwrap_or(VariableRead::scalar(name, kind))
    })
}

fn variable_write() -> impl Strategy<Value = VariableWrite> {
    (name(), kind()).prop_flat_map(|(name, kind)| {
        value(kind).prop_map(move |value| VariableWrite::new(name.clone(), kind, value).unwrap())
    })
}

fn robot() -> impl Strategy<Value = RobotNumber> {
    (0..=16u8).prop_map(|number| RobotNumber::new(number).unwrap())
}

fn bit() -> impl Strategy<Value = BitNumber> {
    any::<u16>().prop_map(|number| BitNumber::new(number).unwrap())
}

fn port() -> impl Strategy<Value = PortNumber> {
    any::<u8>().prop_map(|number| PortNumber::new(number).unwrap())
}

/// Every command that frames have.
fn request() -> impl Strategy<Value = Request> {
    let password = "[ -~]{0,16}".prop_map(|password| Request::Login { password: Password::new(&password).unwrap() });
    let plain = proptest::sample::select(vec![
        Request::Logout,
        Request::Stop,
        Request::Pause,
        Request::Continue,
        Request::Reset,
        Request::GetCurRobot,
        Request::GetStatus,
        Request::Abort,
        Request::GetAlm,
    ]);
    let spel = "[ -~äé溶接]{1,60}".prop_map(|text| Request::Execute { spel: SpelCommand::new(text).unwrap() });
    let start = (0..=63u8).prop_map(|number| Request::Start { function: FunctionNumber::new(number).unwrap() });
    let alarm = any::<u8>().prop_map(|number| Request::ResetAlm { alarm: AlarmNumber::new(number).unwrap() });
    let robots = prop_oneof![
        robot().prop_map(|robot| Request::SetMotorsOn { robot }),
        robot().prop_map(|robot| Request::SetMotorsOff { robot }),
        robot().prop_map(|robot| Request::SetCurRobot { robot }),
        robot().prop_map(|robot| Request::Home { robot }),
    ];
    let bits = prop_oneof![
        bit().prop_map(|bit| Request::GetIO { bit }),
        bit().prop_map(|bit| Request::GetMemIO { bit }),
        (bit(), any::<bool>()).prop_map(|(bit, on)| Request::SetIO { bit, on }),
        (bit(), any::<bool>()).prop_map(|(bit, on)| Request::SetMemIO { bit, on }),
    ];
    let ports = prop_oneof![
        port().prop_map(|port| Request::GetIOByte { port }),
        port().prop_map(|port| Request::GetIOWord { port }),
        port().prop_map(|port| Request::GetMemIOByte { port }),
        port().prop_map(|port| Request::GetMemIOWord { port }),
        (port(), any::<u8>()).prop_map(|(port, value)| Request::SetIOByte { port, value }),
        (port(), any::<u8>()).prop_map(|(port, value)| Request::SetMemIOByte { port, value }),
        (port(), any::<u16>()).prop_map(|(port, value)| Request::SetIOWord { port, value }),
        (port(), any::<u16>()).prop_map(|(port, value)| Request::SetMemIOWord { port, value }),
    ];
    prop_oneof![
        plain,
        password,
        start,
        alarm,
        robots,
        bits,
        ports,
        spel,
        variable_read().prop_map(|variable| Request::GetVariable { variable }),
        variable_write().prop_map(|variable| Request::SetVariable { variable }),
    ]
}

fn status() -> impl Strategy<Value = RemoteStatus> {
    (any::<u16>(), 0..=9999u16).prop_map(|(bits, code)| {
        let mut flags = StatusFlags::default();
        for (at, flag) in StatusFlag::ALL.into_iter().enumerate() {
            flags.set(flag, bits >> at & 1 == 1);
        }
        RemoteStatus { flags, code }
    })
}

fn exchange() -> impl Strategy<Value = (Request, Reply)> {
    request().prop_flat_map(|request| {
        let reply = match &request {
            Request::GetCurRobot => any::<u8>().prop_map(Reply::Robot).boxed(),
            Request::GetIO { .. } | Request::GetMemIO { .. } => any::<bool>().prop_map(Reply::Bit).boxed(),
            Request::GetIOByte { .. } | Request::GetMemIOByte { .. } => any::<u8>().prop_map(Reply::Byte).boxed(),
            Request::GetIOWord { .. } | Request::GetMemIOWord { .. } => any::<u16>().prop_map(Reply::Word).boxed(),
            Request::GetStatus => status().prop_map(Reply::Status).boxed(),
            Request::GetVariable { variable } => {
                vec(value(variable.kind()), variable.count()).prop_map(Reply::Values).boxed()
            }
            Request::Execute { .. } => proptest::option::of("[ -~äé溶接]{0,60}").prop_map(Reply::Output).boxed(),
            Request::GetAlm => vec(any::<u8>(), 0..10).prop_map(Reply::Alarms).boxed(),
            _ => Just(Reply::Done).boxed(),
        };
        (Just(request), reply)
    })
}

/// The bytes cut into pieces.
fn pieces(bytes: &[u8], cuts: &[usize]) -> Vec<Vec<u8>> {
    let mut at: Vec<usize> = cuts.iter().map(|cut| cut % (bytes.len() + 1)).chain([0, bytes.len()]).collect();
    at.sort_unstable();
    at.windows(2).map(|range| bytes[range[0]..range[1]].to_vec()).collect()
}

proptest! {
    #[test]
    fn requests_come_back_from_frames(requests in vec(request(), 1..4), cuts in vec(any::<usize>(), 0..12)) {
        let mut sent = Vec::new();
        for request in &requests {
            sent.extend(frame::encode_request(request).unwrap().iter());
        }
        let pieces = pieces(&sent, &cuts);
        let expected: Vec<_> = requests.into_iter().map(frame::RequestEvent::Request).collect();
        prop_assert_eq!(received(pieces.iter().map(Vec::as_slice)), expected);
    }

    #[test]
    fn requests_come_back_from_lines(requests in vec(request(), 1..4), cuts in vec(any::<usize>(), 0..12)) {
        let mut sent = Vec::new();
        for request in &requests {
            sent.extend(text::encode_request(request, text::Terminator::CrLf).unwrap().iter());
        }
        let mut decoder = text::RequestDecoder::default();
        let mut found = Vec::new();
        for piece in pieces(&sent, &cuts) {
            decoder.add(&piece);
            found.extend(std::iter::from_fn(|| decoder.next_line()).map(|line| line.request.unwrap()));
        }
        prop_assert_eq!(found, requests);
    }

    #[test]
    fn answers_come_back((request, reply) in exchange(), cuts in vec(any::<usize>(), 0..6)) {
        let sent = frame::encode_reply(request.command(), &reply).unwrap();
        let pieces = pieces(&sent, &cuts);
        prop_assert_eq!(answer(&request, pieces.iter().map(Vec::as_slice)), Some(Ok(Answer::Good(reply.clone()))));
        let spelling = request.command().into();
        let sent = text::encode_reply(&spelling, &request, &reply, text::Terminator::Cr).unwrap();
        prop_assert_eq!(answer_line(&request, &sent), Some(Ok(Answer::Good(reply))));
    }

    #[test]
    fn no_bytes_confuse_a_decoder(request in request(), noise in vec(vec(any::<u8>(), 0..40), 0..6)) {
        let _events = received(noise.iter().map(Vec::as_slice));
        let _answer = answer(&request, noise.iter().map(Vec::as_slice));
        let mut decoder = text::RequestDecoder::default();
        for piece in &noise {
            decoder.add(piece);
            while decoder.next_line().is_some() {}
        }
    }

    /// One bit that tips over is noticed, or is of a byte that makes another message with the same checksum.
    #[test]
    fn a_tipped_bit_never_makes_the_same_request(request in request(), at in any::<usize>(), bit in 0..8) {
        let mut sent = frame::encode_request(&request).unwrap().to_vec();
        let at = at % sent.len();
        sent[at] ^= 1_u8 << bit;
        let events = received([&sent[..]]);
        prop_assert!(!events.contains(&frame::RequestEvent::Request(request)));
    }
}
