//! Messages that are cut, damaged, too long or nonsense.

use super::*;
use crate::model::{SpelType, SpelValue};

fn bad(frame: &[u8]) -> (Option<u8>, Fault, &'static str, usize) {
    match received([frame]).as_slice() {
        [frame::RequestEvent::Bad { letter, error }] => (*letter, error.fault, error.field, error.offset),
        other => panic!("{frame:02X?}: {other:?}"),
    }
}

/// Letter and data as a frame with the right checksum.
fn framed(digits: &str) -> Vec<u8> {
    let content = [bytes(digits), vec![0x03]].concat();
    let checksum = content.iter().fold(0, |sum, byte| sum ^ byte);
    [vec![0x02], content, vec![checksum]].concat()
}

#[test]
fn a_bad_frame_is_told_by_field_and_byte() {
    // Start 64, I/O bit set to 2, an unknown letter, a password of 17 characters.
    assert_eq!(bad(&framed("47 40")), (Some(0x47), Fault::OutOfRange, "function", 2));
    assert_eq!(bad(&framed("49 00 01 02")), (Some(0x49), Fault::OutOfRange, "on", 4));
    assert_eq!(bad(&framed("3F")), (Some(0x3F), Fault::UnknownCommand, "command", 1));
    // "GetVariable" without a comma, of an unknown type, and of a name with a blank.
    assert_eq!(bad(&framed("76 67")), (Some(0x76), Fault::Missing, "name", 3));
    assert_eq!(bad(&framed("76 67 2C 0E")), (Some(0x76), Fault::OutOfRange, "type", 4));
    assert_eq!(bad(&framed("76 67 20 2C 03")), (Some(0x76), Fault::Malformed, "name", 2));
    // Elements: count 0, count 101, no count, of strings.
    assert_eq!(bad(&framed("76 67 2C 00 00 2C 03 2C 00 00")), (Some(0x76), Fault::Count, "count", 9));
    assert_eq!(bad(&framed("76 67 2C 00 00 2C 03 2C 00 65")), (Some(0x76), Fault::Count, "count", 9));
    assert_eq!(bad(&framed("76 67 2C 00 00 2C 03")), (Some(0x76), Fault::Count, "count", 8));
    assert_eq!(bad(&framed("76 67 2C 00 00 2C 06 2C 00 01")), (Some(0x76), Fault::Count, "count", 9));
    // The value has the width of another type.
    assert_eq!(bad(&framed("56 67 2C 00 00 2C 04")), (Some(0x56), Fault::Missing, "value", 4));
}

#[test]
fn a_damaged_checksum_is_told_with_both_values() {
    let wrong = Fault::Checksum { expected: 0x44, found: 0x45 };
    assert_eq!(bad(&bytes("02 47 00 03 45")), (Some(0x47), wrong, "BCC", 4));
    // A length that is not fixed: told when the line is silent.
    let wrong = Fault::Checksum { expected: 0x10, found: 0x11 };
    assert_eq!(bad(&bytes("02 58 22 70 72 69 6E 74 20 68 65 72 65 22 03 11")), (Some(0x58), wrong, "BCC", 15));
    assert_eq!(bad(&bytes("02 47 00 02 45")), (Some(0x47), Fault::Malformed, "ETX", 3));
}

#[test]
fn a_cut_frame_is_incomplete_once_the_line_is_silent() {
    let frame = bytes("02 57 01 01 0F 03 5B");
    for cut in 1..frame.len() {
        let mut decoder = frame::RequestDecoder::default();
        decoder.add(&frame[..cut]);
        assert_eq!(decoder.next(false), None);
        assert!(decoder.is_waiting());
        let Some(frame::RequestEvent::Bad { error, .. }) = decoder.next(true) else { panic!("{cut}") };
        assert_eq!((error.fault, error.offset), (Fault::Incomplete, cut));
        assert_eq!(error.refusal(), RefusalCode::TimedOut);
        // The next one is read again.
        decoder.add(&frame);
        assert!(matches!(decoder.next(false), Some(frame::RequestEvent::Request(_))));
    }
}

#[test]
fn noise_before_a_frame_is_skipped() {
    let events = received([&bytes("FF 00 41 02 53 03 50 99 98")[..]]);
    assert_eq!(events, [frame::RequestEvent::Request(Request::GetStatus)]);
    let noise = bytes("FF 00 15 53 31 36 03 57");
    assert_eq!(answer(&Request::GetStatus, noise.chunks(1)), Some(Ok(Answer::Refused(RefusalCode::BadChecksum))));
}

/// Values and indices hold the bytes that a frame is made of.
#[test]
fn data_may_hold_etx_stx_and_commas() {
    for value in [0x032C_0303_0203_2C03_i64, 0x0303_0303_0303_0303, 0x2C2C_2C2C_2C2C_2C2C, 0x2C01_0303_2C0C_0341] {
        let variable = write("g_a", SpelType::Int64, SpelValue::Int64(value));
        let request = Request::SetVariable { variable };
        let frame = frame::encode_request(&request).unwrap();
        assert_eq!(received([&frame[..]]), [frame::RequestEvent::Request(request.clone())]);
        assert_eq!(received(frame.chunks(1)), [frame::RequestEvent::Request(request)]);
    }
    for first in [&[3][..], &[0x2C2C, 0x0303], &[0x0003, 0x2C03, 0x032C]] {
        let request = Request::GetVariable { variable: elements("g_a", SpelType::Real, first, 3) };
        let frame = frame::encode_request(&request).unwrap();
        assert_eq!(received([&frame[..]]), [frame::RequestEvent::Request(request)]);
    }
    let values = Reply::Values(vec![SpelValue::Int16(0x0303), SpelValue::Int16(0x0615)]);
    let request = Request::GetVariable { variable: elements("g_a", SpelType::Integer, &[0], 2) };
    let frame = frame::encode_reply(request.command(), &values).unwrap();
    assert_eq!(answer(&request, frame.chunks(1)), Some(Ok(Answer::Good(values))));
}

/// Element 3 of an array: its first bytes are a whole request for a Boolean if the checksum happens to be a comma.
#[test]
fn a_request_that_may_go_on_is_read_when_the_line_is_silent() {
    let name = "abv";
    assert_eq!([b'v', b'a', b'b', b'v', b',', 0, 3].into_iter().fold(0, |sum, byte| sum ^ byte), b',');
    let scalar = Request::GetVariable { variable: read(name, SpelType::Boolean) };
    let array = Request::GetVariable { variable: elements(name, SpelType::Boolean, &[3], 2) };
    for request in [scalar, array] {
        let frame = frame::encode_request(&request).unwrap();
        assert_eq!(received(frame.chunks(1)), [frame::RequestEvent::Request(request.clone())], "{request:?}");
        assert_eq!(received([&frame[..]]), [frame::RequestEvent::Request(request)]);
    }
}

#[test]
fn a_decoder_holds_no_more_than_its_limit() {
    let flood = vec![0x02; 1_000_000];
    let mut decoder = frame::RequestDecoder::default();
    decoder.add(&flood);
    let error = DecodeError { fault: Fault::TooLong, field: "data", offset: 0 };
    assert_eq!(decoder.next(false), Some(frame::RequestEvent::Bad { letter: None, error }));
    assert!(!decoder.is_waiting());
    // A text without an end.
    decoder.add(&[&[0x02, b'X', b'"'], &[b'x'; 700][..]].concat());
    assert!(matches!(
        decoder.next(false),
        Some(frame::RequestEvent::Bad { letter: Some(b'X'), error: DecodeError { fault: Fault::TooLong, .. } })
    ));
    let execute = Request::Execute { spel: SpelCommand::new("Print 1").unwrap() };
    let endless = [&[0x06, b'X', b'"'], &[b'x'; 5000][..]].concat();
    assert!(matches!(answer(&execute, [&endless[..]]), Some(Err(DecodeError { fault: Fault::TooLong, .. }))));
}

#[test]
fn a_damaged_answer_is_told() {
    let wrong = |digits: &str| answer(&Request::GetStatus, bytes(digits).chunks(1)).unwrap().unwrap_err();
    let error = wrong("06 53 00 00 01 00 00 00 00 00 00 00 01 30 30 30 30 03 51");
    assert_eq!((error.fault, error.field), (Fault::Checksum { expected: 0x50, found: 0x51 }, "BCC"));
    let error = wrong("06 53 00 00 07 00 00 00 00 00 00 00 01 30 30 30 30 03 56");
    assert_eq!((error.fault, error.field), (Fault::Malformed, "flags"));
    assert_eq!(wrong("06 53 00 00 01 00").fault, Fault::Incomplete);
    assert_eq!(wrong("06 47 03 44").fault, Fault::OtherCommand);
    assert_eq!(wrong("15 53 41 42 03 53").fault, Fault::Malformed);
    assert_eq!(answer(&Request::GetStatus, [&[][..]]), None, "nothing came");
}

#[test]
fn a_bad_line_is_told_by_field_and_byte() {
    for (text, fault, field, offset, code) in [
        ("GetStatus", Fault::NoStart, "start", 0, 10),
        ("$GetStatu", Fault::UnknownCommand, "command", 1, 11),
        ("$", Fault::UnknownCommand, "command", 1, 11),
        ("$GetStatus,1", Fault::Trailing, "end", 10, 12),
        ("$Start", Fault::Missing, "function", 6, 12),
        ("$Start,", Fault::Missing, "function", 7, 12),
        ("$Start,64", Fault::OutOfRange, "function", 7, 12),
        ("$Start,-1", Fault::Malformed, "function", 7, 12),
        ("$Start,0,0", Fault::Trailing, "end", 8, 12),
        ("$SetIO,1,2", Fault::OutOfRange, "on", 9, 12),
        ("$SetIOByte,1,100", Fault::OutOfRange, "value", 13, 12),
        ("$SetIOByte,1,0G", Fault::Malformed, "value", 13, 12),
        ("$Login", Fault::Missing, "password", 6, 12),
        ("$Login,12345678901234567", Fault::TooLong, "password", 7, 12),
        ("$Execute,print", Fault::Malformed, "spel", 9, 12),
        ("$Execute,\"\"", Fault::Missing, "spel", 9, 12),
        ("$GetVariable,g_a", Fault::Missing, "type", 16, 12),
        ("$GetVariable,g_a,Whole", Fault::Malformed, "type", 17, 12),
        ("$GetVariable,g_a(1,2,3,4),Byte,1", Fault::Malformed, "element", 16, 12),
        ("$GetVariable,g_a(1),Byte", Fault::Count, "count", 24, 14),
        ("$GetVariable,g_a(1),Byte,", Fault::Count, "count", 25, 14),
        ("$GetVariable,g_a(1),Byte,101", Fault::Count, "count", 25, 14),
        ("$GetVariable,g_a(1),String,1", Fault::Count, "count", 27, 14),
        ("$SetVariable,g_a,300,Byte", Fault::OutOfRange, "value", 17, 12),
    ] {
        let request = line(format!("{text}\r\n").as_bytes()).unwrap();
        let error = request.request.unwrap_err();
        assert_eq!((error.fault, error.field, error.offset), (fault, field, offset), "{text}");
        assert_eq!(error.refusal().number(), code, "{text}");
    }
    let request = line(&[&[b'$'; 5000][..], b"\r\n"].concat()).unwrap();
    assert_eq!(request.request.unwrap_err().fault, Fault::TooLong);
    assert_eq!(line("$机器人,1\r\n".as_bytes()).unwrap().spelling.to_string(), "?????????");
}

#[test]
fn a_bad_answer_line_is_told() {
    let wrong = |text: &str| answer_line(&Request::GetStatus, text.as_bytes()).unwrap().unwrap_err();
    assert_eq!(wrong("GetStatus,1\n").fault, Fault::NoStart);
    assert_eq!(wrong("#GetIO,1\n").fault, Fault::OtherCommand);
    assert_eq!(wrong("#GetStatus,001,0000\n").fault, Fault::Malformed);
    assert_eq!(wrong("#GetStatus,00100000001\n").fault, Fault::Missing);
    assert_eq!(wrong("!GetStatus,100\n").fault, Fault::OutOfRange);
    assert_eq!(wrong("!GetStatus,abc\n").fault, Fault::Malformed);
}

#[test]
fn what_would_end_a_message_is_not_sent() {
    let text = write("g_s$", SpelType::String, SpelValue::String("a\r\n$Stop".to_owned()));
    let request = Request::SetVariable { variable: text };
    assert_eq!(text::encode_request(&request, text::Terminator::CrLf), Err(EncodeError::ControlCharacter));
    assert_eq!(frame::encode_request(&request), Err(EncodeError::ControlCharacter));
    assert_eq!(SpelCommand::new("Print 1\n"), Err(EncodeError::ControlCharacter));
    assert_eq!(SpelCommand::new("x".repeat(257)), Err(EncodeError::TooLong));
    let long = Reply::Output(Some("x".repeat(4061)));
    assert_eq!(frame::encode_reply(Command::Execute, &long), Err(EncodeError::TooLong));
}
