//! Every frame and line that the manuals print, and those worked out by their rules, in both directions.

use super::*;
use crate::model::{SpelType, SpelValue, StatusFlag, StatusFlags};

fn start() -> Request {
    Request::Start { function: FunctionNumber::new(0).unwrap() }
}

fn bit(number: u16) -> BitNumber {
    BitNumber::new(number).unwrap()
}

fn port(number: u8) -> PortNumber {
    PortNumber::new(number).unwrap()
}

fn status(on: &[StatusFlag], code: u16) -> RemoteStatus {
    let mut flags = StatusFlags::default();
    on.iter().for_each(|flag| flags.set(*flag, true));
    RemoteStatus { flags, code }
}

/// Requests with their frames, and with their lines where they exist in print.
fn requests() -> Vec<(Request, &'static str, &'static str)> {
    let robot = RobotNumber::new(1).unwrap();
    vec![
        (start(), "02 47 00 03 44", "$Start,0"),
        (Request::GetIO { bit: bit(1) }, "02 69 00 01 03 6B", "$GetIO,1"),
        (Request::SetIO { bit: bit(1), on: true }, "02 49 00 01 01 03 4A", "$SetIO,1,1"),
        (Request::GetIOByte { port: port(1) }, "02 62 01 03 60", "$GetIOByte,1"),
        (Request::SetIOByte { port: port(1), value: 0x0F }, "02 42 01 0F 03 4F", "$SetIOByte,1,0F"),
        (Request::GetIOWord { port: port(1) }, "02 77 01 03 75", "$GetIOWord,1"),
        (Request::SetIOWord { port: port(1), value: 0x010F }, "02 57 01 01 0F 03 5B", "$SetIOWord,1,010F"),
        (Request::GetMemIO { bit: bit(1) }, "02 6F 00 01 03 6D", "$GetMemIO,1"),
        (Request::SetMemIO { bit: bit(1), on: true }, "02 4F 00 01 01 03 4C", "$SetMemIO,1,1"),
        (Request::GetMemIOByte { port: port(1) }, "02 74 01 03 76", "$GetMemIOByte,1"),
        (Request::SetMemIOByte { port: port(1), value: 0x0F }, "02 54 01 0F 03 59", "$SetMemIOByte,1,0F"),
        (Request::GetMemIOWord { port: port(1) }, "02 75 01 03 77", "$GetMemIOWord,1"),
        (Request::SetMemIOWord { port: port(1), value: 0x010F }, "02 55 01 01 0F 03 59", "$SetMemIOWord,1,010F"),
        (
            Request::GetVariable { variable: read("g_Status", SpelType::Integer) },
            "02 76 67 5F 53 74 61 74 75 73 2C 03 03 56",
            "$GetVariable,g_Status,Integer",
        ),
        (
            Request::SetVariable { variable: write("g_Status", SpelType::Integer, SpelValue::Int16(0)) },
            "02 56 67 5F 53 74 61 74 75 73 2C 00 00 2C 03 03 5A",
            "$SetVariable,g_Status,0,Integer",
        ),
        (
            Request::GetVariable { variable: elements("g_intArray", SpelType::Integer, &[0], 10) },
            "02 76 67 5F 69 6E 74 41 72 72 61 79 2C 00 00 2C 03 2C 00 0A 03 42",
            "$GetVariable,g_intArray(0),Integer,10",
        ),
        (
            Request::GetVariable { variable: elements("g_int3Array", SpelType::Integer, &[3, 5, 0], 10) },
            "02 76 67 5F 69 6E 74 33 41 72 72 61 79 2C 00 03 2C 00 05 2C 00 00 2C 03 2C 00 0A 03 77",
            "$GetVariable,g_int3Array(3,5,0),Integer,10",
        ),
        (
            Request::GetVariable { variable: elements("gby2", SpelType::Byte, &[3, 0], 3) },
            "02 76 67 62 79 32 2C 00 03 2C 00 00 2C 01 2C 00 03 03 3A",
            "$GetVariable,gby2(3,0),Byte,3",
        ),
        (
            Request::Execute { spel: SpelCommand::new("print here").unwrap() },
            "02 58 22 70 72 69 6E 74 20 68 65 72 65 22 03 10",
            "$Execute,\"print here\"",
        ),
        (Request::ResetAlm { alarm: AlarmNumber::new(5).unwrap() }, "02 5A 05 03 5C", "$ResetAlm,5"),
        (Request::GetStatus, "02 53 03 50", "$GetStatus"),
        (Request::Login { password: Password::default() }, "02 4C 03 4F", "$Login,"),
        (Request::Logout, "02 6C 03 6F", "$Logout"),
        (Request::Stop, "02 51 03 52", "$Stop"),
        (Request::Pause, "02 50 03 53", "$Pause"),
        (Request::Continue, "02 43 03 40", "$Continue"),
        (Request::Reset, "02 52 03 51", "$Reset"),
        (Request::Abort, "02 41 03 42", "$Abort"),
        (Request::GetAlm, "02 7A 03 79", "$GetAlm"),
        (Request::GetCurRobot, "02 79 03 7A", "$GetCurRobot"),
        (Request::SetMotorsOn { robot }, "02 4D 01 03 4F", "$SetMotorsOn,1"),
    ]
}

#[test]
fn every_worked_request_is_written_and_read() {
    for (request, frame, text) in requests() {
        let frame = bytes(frame);
        assert_eq!(*frame::encode_request(&request).unwrap(), frame, "{request:?}");
        let one_by_one: Vec<&[u8]> = frame.chunks(1).collect();
        for pieces in [vec![&frame[..]], one_by_one] {
            assert_eq!(received(pieces), [frame::RequestEvent::Request(request.clone())], "{request:?}");
        }
        for terminator in [text::Terminator::CrLf, text::Terminator::Cr, text::Terminator::Lf] {
            let sent = [text.as_bytes(), terminator.bytes()].concat();
            assert_eq!(*text::encode_request(&request, terminator).unwrap(), sent);
            assert_eq!(line(&sent).unwrap().request, Ok(request.clone()), "{text}");
        }
    }
}

/// Requests, their good answers, the frames of these, and the lines.
fn replies() -> Vec<(Request, Reply, &'static str, &'static str)> {
    let ready = status(&[StatusFlag::Auto, StatusFlag::Ready], 0);
    let warning = status(&[StatusFlag::Auto, StatusFlag::Warning, StatusFlag::Running], 517);
    let integer = Request::GetVariable { variable: read("g_Status", SpelType::Integer) };
    let array = Request::GetVariable { variable: elements("gby2", SpelType::Byte, &[3, 0], 3) };
    let execute = Request::Execute { spel: SpelCommand::new("print here").unwrap() };
    let print = Request::Execute { spel: SpelCommand::new("print realpos").unwrap() };
    let position = " X: -182.632 Y:  240.114 Z:  -20.002 U:  -36.156 V:    0.000 W:    0.000 /R /0";
    vec![
        (Request::GetAlm, Reply::Alarms(vec![]), "06 7A 00 03 79", "#GetAlm,0"),
        (Request::GetAlm, Reply::Alarms(vec![1, 9]), "06 7A 02 01 09 03 73", "#GetAlm,2,1,9"),
        (start(), Reply::Done, "06 47 03 44", "#Start,0"),
        (Request::Login { password: Password::default() }, Reply::Done, "06 4C 03 4F", "#Login,0"),
        (Request::GetIO { bit: bit(1) }, Reply::Bit(true), "06 69 01 03 6B", "#GetIO,1"),
        (Request::GetIOByte { port: port(1) }, Reply::Byte(0x0F), "06 62 0F 03 6E", "#GetIOByte,0F"),
        (Request::GetIOWord { port: port(1) }, Reply::Word(0x010F), "06 77 01 0F 03 7A", "#GetIOWord,010F"),
        (Request::GetCurRobot, Reply::Robot(1), "06 79 01 03 7B", "#GetCurRobot,1"),
        (
            Request::GetStatus,
            Reply::Status(ready),
            "06 53 00 00 01 00 00 00 00 00 00 00 01 30 30 30 30 03 50",
            "#GetStatus,00100000001,0000",
        ),
        (
            Request::GetStatus,
            Reply::Status(warning),
            "06 53 00 00 01 01 00 00 00 00 00 01 00 30 35 31 37 03 52",
            "#GetStatus,00110000010,0517",
        ),
        (integer, Reply::Values(vec![SpelValue::Int16(-2)]), "06 76 FF FE 03 74", "#GetVariable,-2"),
        (
            array,
            Reply::Values(vec![SpelValue::Int8(1), SpelValue::Int8(3), SpelValue::Int8(-1)]),
            "06 76 01 03 FF 03 88",
            "#GetVariable,1,3,-1",
        ),
        (execute.clone(), Reply::Output(None), "06 58 03 5B", "#Execute,0"),
        (execute, Reply::Output(Some("2.5".to_owned())), "06 58 22 32 2E 35 22 03 72", "#Execute,\"2.5\""),
        (
            print,
            Reply::Output(Some(position.to_owned())),
            "",
            "#Execute,\" X: -182.632 Y:  240.114 Z:  -20.002 U:  -36.156 V:    0.000 W:    0.000 /R /0\"",
        ),
    ]
}

#[test]
fn every_worked_answer_is_written_and_read() {
    for (request, reply, frame, text) in replies() {
        let good = Some(Ok(Answer::Good(reply.clone())));
        let written = frame::encode_reply(request.command(), &reply).unwrap();
        if !frame.is_empty() {
            assert_eq!(*written, bytes(frame), "{request:?}");
        }
        let one_by_one: Vec<&[u8]> = written.chunks(1).collect();
        assert_eq!(answer(&request, one_by_one), good, "{request:?}");
        assert_eq!(answer(&request, [&written[..]]), good);
        let sent = [text.as_bytes(), b"\r\n"].concat();
        let written = text::encode_reply(&request.command().into(), &request, &reply, text::Terminator::CrLf);
        assert_eq!(written, Ok(sent.clone()));
        assert_eq!(answer_line(&request, &sent), good, "{text}");
    }
}

#[test]
fn worked_refusals_are_written_and_read() {
    for (request, code, frame, text) in [
        (start(), RefusalCode::UnknownCommand, "15 47 31 31 03 44", "!Start,11\r\n"),
        (Request::GetStatus, RefusalCode::BadChecksum, "15 53 31 36 03 57", "!GetStatus,16\r\n"),
        (Request::Reset, RefusalCode::NotReady, "15 52 32 30 03 53", "!Reset,20\r\n"),
    ] {
        let command = request.command();
        assert_eq!(frame::encode_refusal(command.letter().unwrap(), code), bytes(frame));
        assert_eq!(answer(&request, [&bytes(frame)[..]]), Some(Ok(Answer::Refused(code))));
        assert_eq!(text::encode_refusal(&command.into(), code, text::Terminator::CrLf), text.as_bytes());
        assert_eq!(answer_line(&request, text.as_bytes()), Some(Ok(Answer::Refused(code))));
    }
    // The other reading of "two-byte code".
    let binary = bytes("15 47 00 0B 03 4F");
    assert_eq!(answer(&start(), [&binary[..]]), Some(Ok(Answer::Refused(RefusalCode::UnknownCommand))));
}

/// Ten flags, without Test: the manual's older example, and the frame that such firmware sends.
#[test]
fn the_status_of_old_firmware_is_understood() {
    let expected = status(&[StatusFlag::Auto, StatusFlag::Ready], 0);
    let good = Some(Ok(Answer::Good(Reply::Status(expected))));
    assert_eq!(answer_line(&Request::GetStatus, b"#GetStatus,0100000001,0000\r\n"), good);
    let frame = bytes("06 53 00 01 00 00 00 00 00 00 00 01 30 30 30 30 03 50");
    assert_eq!(answer(&Request::GetStatus, frame.chunks(1)), good);
}

/// A client compares the answer with what it sent.
#[test]
fn an_answer_repeats_the_spelling_of_the_command() {
    let request = line(b"$gETsTATUS\r\n").unwrap();
    assert_eq!(request.request, Ok(Request::GetStatus));
    let reply = Reply::Status(RemoteStatus::default());
    let sent = text::encode_reply(&request.spelling, &Request::GetStatus, &reply, text::Terminator::Cr).unwrap();
    assert_eq!(sent, b"#gETsTATUS,00000000000,0000\r");
    let refused = text::encode_refusal(&request.spelling, RefusalCode::NotReady, text::Terminator::Lf);
    assert_eq!(refused, b"!gETsTATUS,20\n");
    assert_eq!(answer_line(&Request::GetStatus, &refused), Some(Ok(Answer::Refused(RefusalCode::NotReady))));
}

#[test]
fn the_remote_function_is_opened_by_one_byte() {
    let frame = bytes("04 02 53 03 50 04");
    let events = received([&frame[..]]);
    let request = frame::RequestEvent::Request(Request::GetStatus);
    assert_eq!(events, [frame::RequestEvent::Open, request, frame::RequestEvent::Open]);
}

#[test]
fn monitoring_commands_are_text_only() {
    let health = Request::GetHealthRB {
        robot: RobotNumber::new(1).unwrap(),
        part: PartNumber::new(2).unwrap(),
        joint: JointNumber::new(3).unwrap(),
    };
    let message =
        Request::GetErrMsg { code: ErrorNumber::new(1234).unwrap(), language: MessageLanguage::new(4).unwrap() };
    for (request, sent, reply, answered) in [
        (Request::GetContName, &b"$GetContName\r\n"[..], Reply::Text("0".to_owned()), &b"#GetContName,0\r\n"[..]),
        (Request::GetContVer, b"$GetContVer\r\n", Reply::Text("7. 5. 1".to_owned()), b"#GetContVer,7. 5. 1\r\n"),
        (
            health,
            b"$GetHealthRB,1,2,3\r\n",
            Reply::List(["2026/01/02 03:04:05", "12.5", "30"].map(str::to_owned).to_vec()),
            b"#GetHealthRB,2026/01/02 03:04:05,12.5,30\r\n",
        ),
        (
            message,
            b"$GetErrMsg,1234,4\r\n",
            Reply::Text("错误, 停止".to_owned()),
            b"#GetErrMsg,\xb4\xed\xce\xf3, \xcd\xa3\xd6\xb9\r\n",
        ),
    ] {
        assert_eq!(*text::encode_request(&request, text::Terminator::CrLf).unwrap(), sent);
        assert_eq!(line(sent).unwrap().request, Ok(request.clone()));
        let spelling = request.command().into();
        assert_eq!(text::encode_reply(&spelling, &request, &reply, text::Terminator::CrLf).unwrap(), answered);
        assert_eq!(answer_line(&request, answered), Some(Ok(Answer::Good(reply))));
        assert_eq!(frame::encode_request(&request), Err(EncodeError::TextOnly(request.command().name())));
    }
}
