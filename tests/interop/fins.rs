//! FINS: clients of other projects against the simulated PLC, and a dissector over what client and PLC send.

use std::fs::File;
use std::io::Write as _;
use std::net::SocketAddr;
use std::path::Path;
use std::process::Command;

use opcua_configurator::fins::address::Address;
use opcua_configurator::fins::codec::command::{Command as FinsCommand, CommandCode, ControllerDataPart};
use opcua_configurator::fins::codec::end_code::EndCode;
use opcua_configurator::fins::codec::frame::TcpFrame;
use opcua_configurator::fins::codec::header::{Endpoint, Header};
use opcua_configurator::fins::codec::response::Response;
use opcua_configurator::fins::plc::{PlcConfig, SimulatedPlc};
use serde_json::{Value, json};

use super::peers::{Node, Python, Tshark, answer};

const NODE: u8 = 90;

async fn plc() -> SimulatedPlc {
    let plc = SimulatedPlc::start(PlcConfig { node: NODE, ..PlcConfig::default() }).await.unwrap();
    let time = chrono::NaiveDate::from_ymd_opt(2026, 11, 28).unwrap().and_hms_opt(5, 9, 59).unwrap();
    plc.state().clock = Some(time);
    plc.state().memory.set_words("C5".parse().unwrap(), &[17]).unwrap();
    plc.state().memory.set_bits("T3.F".parse().unwrap(), &[true]).unwrap();
    plc
}

async fn asked(mut command: Command) -> Value {
    tokio::task::spawn_blocking(move || answer(&mut command)).await.unwrap()
}

fn arguments(command: &mut Command, first: &str, to: SocketAddr) {
    command.args([first, &to.ip().to_string(), &to.port().to_string()]);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn omron_fins_reads_and_writes_the_simulated_plc() {
    let Some(node) = Node::find_with("omron_fins.mjs", "omron-fins") else { return };
    for transport in ["tcp", "udp"] {
        let plc = plc().await;
        let mut command = node.script("omron_fins.mjs");
        arguments(&mut command, transport, plc.address());
        command.arg(NODE.to_string());
        let found = asked(command).await;
        for (what, expected) in [
            ("write", json!("0000")),
            // It takes words as numbers with a sign.
            ("words", json!([321, -1])),
            ("writeBits", json!("0000")),
            ("bits", json!([1, 0])),
            ("fill", json!("0000")),
            ("transfer", json!("0000")),
            ("transferred", json!([-21_555, -21_555, -21_555])),
            ("several", json!([321, 17, 1])),
            ("readOnly", json!("2101")),
            ("beyond", json!("1103")),
            ("stop", json!("0000")),
            ("stopped", json!("PROGRAM")),
            ("run", json!("0000")),
        ] {
            assert_eq!(found[what], expected, "{transport} {what}: {found}");
        }
        assert_eq!(found["data"]["CPUUnitModel"], "CJ2M-CPU35", "{found}");
        assert_eq!(found["data"]["AreaData"]["NoOfDMWords"], 32_768, "{found}");
        assert_eq!((&found["status"]["status"], &found["status"]["mode"]), (&json!("RUN"), &json!("RUN")), "{found}");
        let clock = json!({"year": 26, "month": 11, "day": 28, "hour": 5, "minute": 9, "second": 59, "day_of_week": 6});
        assert_eq!(found["clock"], clock, "{found}");
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn fins_driver_reads_and_writes_the_simulated_plc() {
    let Some(python) = Python::find_with("fins_driver.py", "fins-driver") else { return };
    let plc = plc().await;
    let mut command = python.script("fins_driver.py");
    arguments(&mut command, "check", plc.address());
    let found = asked(command).await;
    for (what, expected) in [
        ("write", json!("0000")),
        ("words", json!("0141ffff")),
        ("write bits", json!("0000")),
        ("bits", json!("0100")),
        ("fill", json!("0000")),
        ("transfer", json!("0000")),
        ("transferred", json!("abcdabcdabcd")),
        ("several", json!(["0141", "01", "abcd"])),
        ("read-only", json!("2101")),
        ("beyond", json!("1103")),
        ("stop", json!("0000")),
        ("run", json!("0000")),
    ] {
        assert_eq!(found[what], expected, "{what}: {found}");
    }
}

/// The two endpoints of what is dissected.
const ROBOT: Endpoint = Endpoint::cpu(100);
const PLC: Endpoint = Endpoint::cpu(NODE);

fn command(service_id: u8, command: &FinsCommand) -> Vec<u8> {
    let mut message = Header::command(PLC, ROBOT, service_id).encode().to_vec();
    command.encode_into(&mut message);
    message
}

fn response(service_id: u8, response: &Response) -> Vec<u8> {
    let mut message = Header::response_to(&Header::command(PLC, ROBOT, service_id)).encode().to_vec();
    response.encode_into(&mut message);
    message
}

#[test]
fn the_dissector_of_wireshark_reads_what_is_sent() {
    let Some(tshark) = Tshark::find() else { return };
    let folder = tempfile::tempdir().unwrap();
    let d300 = "D300".parse::<Address>().unwrap().to_wire();
    let messages = [
        (true, command(1, &FinsCommand::Read { start: d300, count: 2 })),
        (false, response(1, &Response::with_data(CommandCode::READ, vec![0, 123, 1, 65]))),
        (true, command(2, &FinsCommand::Write { start: d300, count: 1, data: vec![1, 65] })),
        (false, response(2, &Response::ended(CommandCode::WRITE, EndCode::NORMAL))),
        (true, command(3, &FinsCommand::ControllerData(ControllerDataPart::CpuUnit))),
        (true, command(4, &FinsCommand::Status)),
        (true, command(5, &FinsCommand::Clock)),
        (false, response(5, &Response::with_data(CommandCode::CLOCK, vec![0x26, 0x11, 0x28, 5, 9, 0x59, 6]))),
        (false, response(6, &Response::ended(CommandCode::READ, EndCode::from_wire(0x1103)))),
    ];
    let udp = folder.path().join("udp.pcap");
    write_capture(&udp, Transport::Udp, &messages);
    let dissected =
        tshark.fields(&udp, &["omron.command", "omron.sid", "omron.da1", "omron.sa1", "omron.response.code"]);
    let number = |text: &str| {
        let digits = text.trim_start_matches("0x");
        u32::from_str_radix(digits, if digits.len() == text.len() { 10 } else { 16 }).ok()
    };
    assert_eq!(dissected.len(), messages.len(), "{dissected:?}");
    for ((is_command, message), fields) in messages.iter().zip(&dissected) {
        let code = u32::from(message[10]) << 8 | u32::from(message[11]);
        let numbers: Vec<Option<u32>> = fields.iter().map(|field| number(field)).collect();
        let nodes = if *is_command { (Some(90), Some(100)) } else { (Some(100), Some(90)) };
        assert_eq!(numbers[0], Some(code), "{fields:?}");
        assert_eq!((numbers[1], (numbers[2], numbers[3])), (Some(message[9].into()), nodes), "{fields:?}");
        if !is_command {
            assert_eq!(numbers[4], Some(u32::from(message[12]) << 8 | u32::from(message[13])), "{fields:?}");
        }
    }
    assert!(!tshark.complains(&udp), "the dissector finds something malformed");

    // The frames of FINS/TCP, in the same conversation.
    let tcp = folder.path().join("tcp.pcap");
    let handshake = [
        (true, TcpFrame::ClientNode { node: 100 }.encode()),
        (false, TcpFrame::ServerNode { error: None, client: 100, server: NODE.into() }.encode()),
    ];
    let frames = messages.iter().map(|(is_command, message)| (*is_command, TcpFrame::encode_message(message)));
    let frames: Vec<(bool, Vec<u8>)> = handshake.into_iter().chain(frames).collect();
    write_capture(&tcp, Transport::Tcp, &frames);
    assert!(!tshark.complains(&tcp), "the dissector finds something malformed");
    let dissected = tshark.fields(&tcp, &["omron.tcp.command", "omron.command"]);
    let commands: Vec<u32> = dissected.iter().filter_map(|fields| number(&fields[0])).collect();
    // Older versions of Wireshark know FINS/UDP alone.
    if !commands.is_empty() {
        assert_eq!(commands[..3], [0, 1, 2], "{dissected:?}");
        assert_eq!(commands.len(), frames.len(), "{dissected:?}");
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Transport {
    Udp,
    Tcp,
}

/// Writes packets as a capture of an Ethernet (libpcap's file format, version 2.4).
fn write_capture(file: &Path, transport: Transport, packets: &[(bool, Vec<u8>)]) {
    const LINKTYPE_RAW_IPV4: u32 = 228;
    let mut out = File::create(file).unwrap();
    let mut capture = Vec::new();
    capture.extend(0xA1B2_C3D4_u32.to_le_bytes());
    capture.extend([2_u16, 4].map(u16::to_le_bytes).concat());
    capture.extend([0, 0, 65_535, LINKTYPE_RAW_IPV4].map(u32::to_le_bytes).concat());
    // Bytes that each side has sent, for the sequence numbers of TCP.
    let mut sent = [0_u32; 2];
    for (number, (from_robot, payload)) in packets.iter().enumerate() {
        let (robot, plc) = ([192, 168, 250, 100], [192, 168, 250, 90]);
        let (from, to) = if *from_robot { (robot, plc) } else { (plc, robot) };
        let ports = if *from_robot { [49_152_u16, 9_600] } else { [9_600, 49_152] };
        let mut transport_bytes = ports.map(u16::to_be_bytes).concat();
        let protocol = match transport {
            Transport::Udp => {
                transport_bytes.extend(((payload.len() + 8) as u16).to_be_bytes());
                transport_bytes.extend([0, 0]);
                17
            }
            Transport::Tcp => {
                let side = usize::from(!from_robot);
                transport_bytes.extend((1 + sent[side]).to_be_bytes());
                transport_bytes.extend((1 + sent[1 - side]).to_be_bytes());
                // 20 bytes of header; PSH and ACK; window; no checksum.
                transport_bytes.extend([0x50, 0x18, 0xFF, 0xFF, 0, 0, 0, 0]);
                sent[side] += payload.len() as u32;
                6
            }
        };
        let length = 20 + transport_bytes.len() + payload.len();
        let mut packet = vec![0x45, 0];
        packet.extend((length as u16).to_be_bytes());
        packet.extend([0, number as u8, 0, 0, 64, protocol, 0, 0]);
        packet.extend(from);
        packet.extend(to);
        packet.extend(transport_bytes);
        packet.extend(payload);
        capture.extend([number as u32, 0, length as u32, length as u32].map(u32::to_le_bytes).concat());
        capture.extend(packet);
    }
    out.write_all(&capture).unwrap();
}
