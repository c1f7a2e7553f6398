//! The codec against captured frames, and against itself.

use proptest::prelude::*;

use super::super::address::{Address, WireAddress};
use super::command::{Command, CommandCode, CommandError, ControllerDataPart};
use super::cpu::{ControllerData, CpuStatus, OperatingMode, PlcErrorKind, decode_clock, encode_clock};
use super::end_code::EndCode;
use super::frame::{FrameDecoder, FrameError, MAX_FRAME_BYTES, TcpFrame, TcpRefusal};
use super::header::{Endpoint, Header, MessageKind, ShortHeader};
use super::response::{Element, Response, ResponseError};

fn bytes(hexadecimal: &str) -> Vec<u8> {
    hex::decode(hexadecimal.replace(' ', "")).unwrap()
}

fn at(text: &str) -> WireAddress {
    text.parse::<Address>().unwrap().to_wire()
}

fn message(header: &Header, command: &Command) -> Vec<u8> {
    let mut message = header.encode().to_vec();
    command.encode_into(&mut message);
    message
}

fn answer(header: &Header, response: &Response) -> Vec<u8> {
    let mut message = header.encode().to_vec();
    response.encode_into(&mut message);
    message
}

fn only_frame(bytes: &[u8]) -> TcpFrame {
    let mut decoder = FrameDecoder::default();
    decoder.feed(bytes);
    let frame = decoder.next_frame().unwrap().unwrap();
    assert!(!decoder.is_inside_frame());
    frame
}

// A robot, node 100, and a CJ2M-CPU35, node 90, as captured on their Ethernet.
const CLIENT: Endpoint = Endpoint::cpu(0x64);
const PLC: Endpoint = Endpoint::cpu(0x5A);

#[test]
fn the_captured_handshake_is_written_and_read() {
    for (frame, captured) in [
        (TcpFrame::ClientNode { node: 100 }, "46494E53 0000000C 00000000 00000000 00000064"),
        (
            TcpFrame::ServerNode { error: None, client: 100, server: 90 },
            "46494E53 00000010 00000001 00000000 00000064 0000005A",
        ),
    ] {
        assert_eq!(frame.encode(), bytes(captured));
        assert_eq!(only_frame(&bytes(captured)), frame);
    }
}

#[test]
fn the_captured_commands_are_written_and_read() {
    let header = Header::command(PLC, CLIENT, 0);
    for (command, captured) in [
        (
            Command::Read { start: at("D300"), count: 1 },
            "46494E53 0000001A 00000002 00000000 800002 005A00 006400 00 0101 82 012C00 0001",
        ),
        (
            Command::Write { start: at("D300"), count: 1, data: vec![0x01, 0x41] },
            "46494E53 0000001C 00000002 00000000 800002 005A00 006400 00 0102 82 012C00 0001 0141",
        ),
    ] {
        assert_eq!(TcpFrame::encode_message(&message(&header, &command)), bytes(captured));
        let TcpFrame::Message(message) = only_frame(&bytes(captured)) else { panic!() };
        let (read, rest) = Header::decode(&message).unwrap();
        assert_eq!((read, Command::decode(rest)), (header, Ok(command)));
    }
}

#[test]
fn the_captured_responses_are_written_and_read() {
    let header = Header::response_to(&Header::command(PLC, CLIENT, 0));
    for (response, captured) in [
        (
            Response::with_data(CommandCode::READ, vec![0x00, 0x7B]),
            "46494E53 00000018 00000002 00000000 C00002 006400 005A00 00 0101 0000 007B",
        ),
        (
            Response::ended(CommandCode::WRITE, EndCode::NORMAL),
            "46494E53 00000016 00000002 00000000 C00002 006400 005A00 00 0102 0000",
        ),
    ] {
        assert_eq!(TcpFrame::encode_message(&answer(&header, &response)), bytes(captured));
        let TcpFrame::Message(message) = only_frame(&bytes(captured)) else { panic!() };
        let (read, rest) = Header::decode(&message).unwrap();
        assert_eq!((read, Response::decode(rest)), (header, Ok(response)));
    }
    let read = Response::decode(&bytes("0101 0000 007B")).unwrap();
    assert_eq!(read.words(1), Ok(vec![123]));
}

/// The program of a robot that reads D300 to D304 and writes D310 to D314; its node is 97.
#[test]
fn the_frames_of_a_robots_program_are_the_same() {
    let header = Header::command(PLC, Endpoint::cpu(0x61), 0);
    let read = Command::Read { start: at("D300"), count: 5 };
    assert_eq!(
        TcpFrame::encode_message(&message(&header, &read)),
        bytes("46494E53 0000001A 00000002 00000000 800002 005A00 006100 00 0101 82 012C00 0005")
    );
    let write = Command::Write { start: at("D310"), count: 5, data: vec![0; 10] };
    let frame = TcpFrame::encode_message(&message(&header, &write));
    assert_eq!((frame.len(), frame[7]), (34 + 10, 26 + 10));
    assert_eq!(frame[28..34], [0x82, 0x01, 0x36, 0x00, 0x00, 0x05]);
}

#[test]
fn the_commands_of_the_manual_have_their_bytes() {
    for (command, hexadecimal) in [
        (Command::Read { start: at("CIO10.13"), count: 1 }, "0101 30 000A0D 0001"),
        (Command::Write { start: at("W3.02"), count: 2, data: vec![1, 0] }, "0102 31 000302 0002 01 00"),
        (Command::Fill { start: at("H20"), count: 100, value: 0xABCD }, "0103 B2 001400 0064 ABCD"),
        (
            Command::ReadMultiple(vec![at("D300"), at("T1.F"), at("C2"), at("E10_5")]),
            "0104 82 012C00 09 000100 89 800200 60 000500",
        ),
        (Command::Transfer { from: at("D0"), to: at("E1_200"), count: 3 }, "0105 82 000000 A1 00C800 0003"),
        (Command::ControllerData(ControllerDataPart::All), "0501"),
        (Command::ControllerData(ControllerDataPart::CpuUnit), "0501 00"),
        (Command::ControllerData(ControllerDataPart::CpuBusUnits), "0501 01"),
        (Command::Status, "0601"),
        (Command::Clock, "0701"),
        (Command::Other { code: CommandCode(0x0402), parameters: vec![] }, "0402"),
    ] {
        let mut encoded = Vec::new();
        command.encode_into(&mut encoded);
        assert_eq!(encoded, bytes(hexadecimal), "{command:?}");
        assert_eq!(Command::decode(&bytes(hexadecimal)), Ok(command));
    }
}

#[test]
fn wrong_parameters_have_the_end_code_of_a_plc() {
    for (hexadecimal, error, code) in [
        ("01", CommandError::TooShort, 0x1002),
        ("0101 82 012C00", CommandError::TooShort, 0x1002),
        ("0101 82 012C00 0001 00", CommandError::TooLong, 0x1001),
        ("0102 82 012C00 0002 0001", CommandError::CountMismatch, 0x1003),
        ("0104 82 012C00 82", CommandError::TooShort, 0x1002),
        ("0501 07", CommandError::BadParameter, 0x110C),
    ] {
        let found = Command::decode(&bytes(hexadecimal)).unwrap_err();
        assert_eq!((found, found.end_code().to_wire()), (error, code), "{hexadecimal}");
    }
    assert_eq!(Header::decode(&[0x80; 9]), Err(ShortHeader(9)));
}

#[test]
fn responses_are_read_as_those_of_their_command() {
    let response = |hexadecimal: &str| Response::decode(&bytes(hexadecimal)).unwrap();
    assert_eq!(response("0101 0000 01 00 03").bits(3), Ok(vec![true, false, true]));
    assert!(matches!(response("0101 0000 007B").words(2), Err(ResponseError::WrongLength { expected: 4, .. })));
    let multiple = response("0104 0000 82 007B 09 01");
    assert_eq!(multiple.elements(&[at("D300"), at("T1.F")]), Ok(vec![Element::Word(123), Element::Bit(true)]));
    assert_eq!(
        multiple.elements(&[at("E0_0"), at("T1.F")]),
        Err(ResponseError::OtherArea { found: 0x82, expected: 0xA0 })
    );
    let relayed = response("0101 8205 01 07");
    assert_eq!(relayed.relay_error_at(), Some((1, 7)));
    assert_eq!(Response::decode(&[1, 1, 0]), Err(ResponseError::TooShort(3)));
}

#[test]
fn what_a_cpu_says_of_itself_is_read_back() {
    let data = ControllerData {
        model: "CJ2M-CPU35".into(),
        version: "02.01".into(),
        program_kilowords: 60,
        data_memory_words: 32_768,
        extended_memory_banks: 4,
    };
    assert_eq!(data.encode().len(), 92);
    let response = |data: Vec<u8>| Response::with_data(CommandCode::CONTROLLER_DATA, data);
    assert_eq!(ControllerData::decode(&response(data.encode())), Ok(data.clone()));
    let all = [data.encode(), ControllerData::encode_bus_units()].concat();
    assert_eq!((all.len(), ControllerData::decode(&response(all))), (158, Ok(data)));

    let mut status = CpuStatus::without_errors(OperatingMode::Run);
    assert_eq!(status.encode()[..2], [0x01, 0x04]);
    status.fatal_errors = 0x8000;
    status.non_fatal_errors = 0x0010;
    status.error_code = 0x00F7;
    status.error_message = "LOW VOLTAGE".into();
    let response = |data: Vec<u8>| Response::with_data(CommandCode::STATUS, data);
    assert_eq!(CpuStatus::decode(&response(status.encode())), Ok(status.clone()));
    assert_eq!(status.fatal().collect::<Vec<_>>(), [PlcErrorKind::Memory]);
    assert_eq!(status.non_fatal().collect::<Vec<_>>(), [PlcErrorKind::Battery]);
    assert!(CpuStatus::decode(&response(vec![0; 25])).is_err());

    let clock = |data: &str| decode_clock(&Response::with_data(CommandCode::CLOCK, bytes(data)));
    let time = clock("26 11 28 04 51 09 06").unwrap();
    assert_eq!(time.to_string(), "2026-11-28 04:51:09");
    assert_eq!(encode_clock(time).to_vec(), bytes("26 11 28 04 51 09 06"));
    assert_eq!(clock("99 12 31 23 59 59 05").unwrap().to_string(), "1999-12-31 23:59:59");
    for wrong in ["26 13 28 04 51 09 06", "26 1A 28 04 51 09 06"] {
        assert_eq!(clock(wrong), Err(ResponseError::BadValue("clock")));
    }
}

#[test]
fn frames_are_read_as_they_arrive() {
    let frames = [
        TcpFrame::ClientNode { node: 0 },
        TcpFrame::ServerNode { error: Some(TcpRefusal::AllConnectionsInUse), client: 0, server: 90 },
        TcpFrame::Message(vec![1, 2, 3]),
        TcpFrame::Message(vec![]),
        TcpFrame::Refused(TcpRefusal::NotFins),
        TcpFrame::Confirmation,
    ];
    let stream: Vec<u8> = frames.iter().flat_map(TcpFrame::encode).collect();
    for piece in [1, 7, 16, stream.len()] {
        let (mut decoder, mut found) = (FrameDecoder::default(), Vec::new());
        for part in stream.chunks(piece) {
            decoder.feed(part);
            while let Some(frame) = decoder.next_frame().unwrap() {
                found.push(frame);
            }
        }
        assert_eq!(found, frames, "{piece} bytes at a time");
        assert!(!decoder.is_inside_frame());
    }
}

#[test]
fn what_is_no_frame_is_refused_before_it_is_whole() {
    for (hexadecimal, error, refusal) in [
        ("47", FrameError::NotFins, 1),
        ("46494E54", FrameError::NotFins, 1),
        ("46494E53 000007E5", FrameError::TooLong(2_021), 2),
        ("46494E53 FFFFFFFF", FrameError::TooLong(u32::MAX), 2),
        ("46494E53 00000004 00000002 00000000", FrameError::TooShort { length: 4, command: 2 }, 3),
        ("46494E53 00000008 00000000 00000000", FrameError::TooShort { length: 8, command: 0 }, 3),
        ("46494E53 00000008 00000005 00000000", FrameError::UnknownCommand(5), 3),
    ] {
        let mut decoder = FrameDecoder::default();
        decoder.feed(&bytes(hexadecimal));
        let found = decoder.next_frame().unwrap_err();
        assert_eq!((found, found.refusal().code()), (error, refusal), "{hexadecimal}");
    }
    assert_eq!(TcpFrame::Message(vec![0; 2_012]).encode().len(), MAX_FRAME_BYTES);
    for refusal in TcpRefusal::ALL {
        assert_eq!(TcpRefusal::from_code(refusal.code()), Some(refusal));
    }
    assert_eq!(TcpRefusal::from_code(0x99), Some(TcpRefusal::Other(0x99)));
}

fn any_endpoint() -> impl Strategy<Value = Endpoint> {
    any::<(u8, u8, u8)>().prop_map(|(network, node, unit)| Endpoint { network, node, unit })
}

proptest! {
    #[test]
    fn headers_are_read_back(destination in any_endpoint(), source in any_endpoint(), service_id: u8, kind in 0..3) {
        let kind = [MessageKind::Command, MessageKind::CommandWithoutResponse, MessageKind::Response][kind as usize];
        let header = Header { kind, gateways: 2, destination, source, service_id };
        let encoded = header.encode();
        prop_assert_eq!(Header::decode(&encoded), Ok((header, &[][..])));
    }

    #[test]
    fn what_is_read_as_a_command_is_written_the_same(
        bytes in prop::collection::vec(any::<u8>(), 0..40),
        code in prop::sample::select(vec![0x0101_u16, 0x0102, 0x0103, 0x0104, 0x0105, 0x0501, 0x0601, 0x0701, 0x0402]),
    ) {
        let bytes = [&code.to_be_bytes()[..], &bytes].concat();
        if let Ok(command) = Command::decode(&bytes) {
            let mut encoded = Vec::new();
            command.encode_into(&mut encoded);
            prop_assert_eq!(encoded, bytes);
        }
    }

    #[test]
    fn what_is_read_as_a_response_is_written_the_same(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        if let Ok(response) = Response::decode(&bytes) {
            let mut encoded = Vec::new();
            response.encode_into(&mut encoded);
            prop_assert_eq!(encoded, bytes);
            // Reading them as any command must not panic.
            let _ = (CpuStatus::decode(&response), ControllerData::decode(&response), decode_clock(&response));
            let _ = (response.words(3), response.bits(3), response.relay_error_at());
        }
    }

    #[test]
    fn any_bytes_are_frames_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..100), piece in 1_usize..20) {
        for begin in [&b"FINS"[..], b""] {
            let bytes = [begin, &bytes].concat();
            let mut decoder = FrameDecoder::default();
            'stream: for part in bytes.chunks(piece) {
                decoder.feed(part);
                loop {
                    match decoder.next_frame() {
                        Ok(Some(_)) => {}
                        Ok(None) => break,
                        Err(_) => break 'stream,
                    }
                }
            }
        }
    }
}
