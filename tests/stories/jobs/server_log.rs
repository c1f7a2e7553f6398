//! The server log: what it holds, how it is read, and what happens when it is full.

use std::collections::BTreeSet;
use std::io::{Read as _, Write as _};
use std::net::TcpStream;
use std::time::{Duration, Instant};

use opcua_configurator::jobs::{
    BasicSettingsChange, ControllerReport, GetInfo, LogPart, ReadLog, SelfSigned, SelfSignedFields, SetBasicSettings,
    StartServer, StopServer,
};
use opcua_configurator::model::{
    ControllerInfo, ErrorCode, KeyLength, LogChunk, SecurityPolicy, ServerSettings, ServerStatus, Validity,
};
use opcua_configurator::virtual_controller::FleetFirmware;
use tokio::io::AsyncWriteExt as _;
use tokio::net::TcpSocket;

use crate::common::test_fleet::TestFleet;

fn certificate() -> SelfSigned {
    SelfSigned {
        fields: SelfSignedFields {
            common_name: None,
            country: "JP".into(),
            state: "Nagano".into(),
            locality: "Suwa".into(),
            organisation: "Example".into(),
            key_length: KeyLength::Rsa2048,
            validity: Validity::try_from(5).unwrap(),
        },
        backup: None,
    }
}

fn switch(on: bool) -> SetBasicSettings {
    SetBasicSettings {
        change: BasicSettingsChange {
            server_log: Some(on),
            security_policies: Some(BTreeSet::from([SecurityPolicy::Basic256Sha256])),
            ..BasicSettingsChange::default()
        },
        log_password: on.then(|| ServerSettings::LOG_PASSWORD.to_owned()),
        ..SetBasicSettings::default()
    }
}

fn delete() -> SetBasicSettings {
    let change = BasicSettingsChange { delete_log: true, ..BasicSettingsChange::default() };
    SetBasicSettings { change, ..SetBasicSettings::default() }
}

fn code<O>(reports: &[ControllerReport<O>]) -> Option<ErrorCode> {
    reports[0].result.as_ref().err().map(|problem| problem.code)
}

async fn standing(fleet: &TestFleet) -> (ServerStatus, Option<ErrorCode>) {
    let ControllerInfo { status, error, .. } = fleet.run(GetInfo).await[0].info.clone().unwrap();
    (status, error)
}

async fn log(fleet: &TestFleet, part: LogPart) -> LogChunk {
    fleet.run(ReadLog { part }).await.remove(0).result.unwrap()
}

/// A running server on one controller, with its log on.
async fn logging(firmware: FleetFirmware) -> TestFleet {
    let fleet = TestFleet::start(1, firmware).await;
    fleet.run(certificate()).await;
    assert_eq!(code(&fleet.run(switch(true)).await), None);
    assert_eq!(code(&fleet.run(StartServer).await), None);
    fleet
}

/// A client that opens a secure channel without security, as one does to ask for the endpoints.
fn connect(fleet: &TestFleet) -> std::io::Result<TcpStream> {
    let url = fleet.controller(0).endpoint();
    let mut client = TcpStream::connect(url.trim_start_matches("opc.tcp://"))?;
    client.set_read_timeout(Some(Duration::from_secs(20)))?;
    let text = |text: &str| [&(text.len() as i32).to_le_bytes(), text.as_bytes()].concat();
    let message = |kind: &[u8; 4], body: &[u8]| [kind, &(8 + body.len() as u32).to_le_bytes()[..], body].concat();
    // OPC 10000-6 §7.1.2.3: version, buffers, largest message and number of chunks.
    let hello = [0_u32, 65_535, 65_535, 0, 0].map(u32::to_le_bytes).concat();
    client.write_all(&message(b"HELF", &[hello, text(&url)].concat()))?;
    // OPC 10000-6 §6.7.2: channel 0, no policy, no certificates, sequence and request number; then the request.
    let none = text("http://opcfoundation.org/UA/SecurityPolicy#None");
    let header = [&[0; 4][..], &none, &[0xff; 8], &1_u32.to_le_bytes(), &1_u32.to_le_bytes()].concat();
    // OPC 10000-4 §5.5.2: node id 446, an empty request header, version, issue, no security, no nonce, an hour.
    let request_header = [&[0; 2][..], &[0; 8], &[0; 4], &[0; 4], &[0xff; 4], &[0; 4], &[0; 3]].concat();
    let asked = [0_u32, 0, 1].map(u32::to_le_bytes).concat();
    let request = [&[1, 0, 0xbe, 1][..], &request_header, &asked, &[0xff; 4], &3_600_000_u32.to_le_bytes()].concat();
    client.write_all(&message(b"OPNF", &[header, request].concat()))?;
    let mut answers = [0; 28 + 8];
    client.read_exact(&mut answers)?;
    assert_eq!((&answers[..4], &answers[28..32]), (&b"ACKF"[..], &b"OPNF"[..]));
    Ok(client)
}

#[tokio::test(flavor = "multi_thread")]
async fn a_log_is_switched_on_read_and_switched_off_again() {
    let fleet = TestFleet::start(1, FleetFirmware::Current).await;
    fleet.run(certificate()).await;
    fleet.run(StartServer).await;
    assert_eq!(log(&fleet, LogPart::From(0)).await, LogChunk::default(), "off, and never on");
    let without = SetBasicSettings { log_password: None, ..switch(true) };
    assert_eq!(code(&fleet.run(without).await), Some(ErrorCode::LogPassword));

    assert_eq!(code(&fleet.run(switch(true)).await), None);
    assert_eq!(standing(&fleet).await, (ServerStatus::Run, Some(ErrorCode::ServerLogOn)), "a notice, not an error");
    let client = connect(&fleet).unwrap();
    let from = client.local_addr().unwrap();
    drop(client);
    let asked = Instant::now();
    while !log(&fleet, LogPart::End).await.text.contains(&format!("connection from {from} closed")) {
        assert!(asked.elapsed() < Duration::from_secs(20), "{}", log(&fleet, LogPart::End).await.text);
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    fleet.run(StopServer).await;
    assert_eq!(standing(&fleet).await, (ServerStatus::Stop, Some(ErrorCode::ServerLogOn)));
    let whole = log(&fleet, LogPart::From(0)).await;
    let lines: Vec<&str> = whole.text.lines().collect();
    assert!(lines[0].contains("server started: opc.tcp://127.0.0.1:"), "{lines:?}");
    assert!(lines.last().unwrap().contains("server stopped"), "{lines:?}");
    assert_eq!((whole.size, whole.next), (whole.text.len() as u64, whole.size));

    assert_eq!(code(&fleet.run(switch(false)).await), None);
    fleet.run(StartServer).await;
    assert_eq!(standing(&fleet).await, (ServerStatus::Run, None));
    assert_eq!(log(&fleet, LogPart::From(0)).await, whole, "kept, and nothing added");
    assert_eq!(code(&fleet.run(delete()).await), None);
    assert_eq!(log(&fleet, LogPart::End).await, LogChunk::default());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_full_log_stops_the_server_until_it_is_deleted_or_switched_off() {
    let fleet = logging(FleetFirmware::Legacy).await;
    fleet.controller(0).faults().update(|switches| switches.log_limit = Some(2048));
    let asked = Instant::now();
    // What the engineer does is always written.
    while standing(&fleet).await != (ServerStatus::Error, Some(ErrorCode::ServerLogFull)) {
        assert!(asked.elapsed() < Duration::from_secs(60), "the log does not fill");
        fleet.run(StopServer).await;
        fleet.run(StartServer).await;
    }
    assert!(connect(&fleet).is_err(), "it does not even listen");
    let full = log(&fleet, LogPart::From(0)).await;
    assert!(full.size <= 2048 && full.text.contains("the log is full; the server stops"), "{}", full.text);
    assert_eq!(code(&fleet.run(StartServer).await), Some(ErrorCode::ServerLogFull));

    fleet.run(delete()).await;
    assert_eq!(standing(&fleet).await, (ServerStatus::Stop, Some(ErrorCode::ServerLogOn)), "582 went with its cause");
    assert_eq!(code(&fleet.run(StartServer).await), None);
    assert_eq!(standing(&fleet).await, (ServerStatus::Run, Some(ErrorCode::ServerLogOn)));
    assert!(log(&fleet, LogPart::From(0)).await.size < full.size);

    fleet.controller(0).faults().update(|switches| switches.log_limit = Some(1));
    fleet.run(StopServer).await;
    assert_eq!(code(&fleet.run(StartServer).await), Some(ErrorCode::ServerLogFull));
    assert_eq!(code(&fleet.run(switch(false)).await), None);
    assert_eq!(code(&fleet.run(StartServer).await), None, "without a log it does not matter");
}

/// It was so: 5,607 connections from 100 addresses filled the log in 20 s, and the server stopped.
#[tokio::test(flavor = "multi_thread")]
async fn strangers_cannot_stop_the_server_by_filling_its_log() {
    let fleet = logging(FleetFirmware::Legacy).await;
    fleet.controller(0).faults().update(|switches| switches.log_limit = Some(16 * 1024));
    let server = fleet.controller(0).endpoint().trim_start_matches("opc.tcp://").parse().unwrap();
    for number in 0..2000_u32 {
        let socket = TcpSocket::new_v4().unwrap();
        let source = [127, 0, 1, (number % 100) as u8 + 1];
        socket.bind((source, 0).into()).unwrap();
        // Evicted, perhaps.
        if let Ok(mut stranger) = socket.connect(server).await {
            let _ = stranger.write_all(b"GET / HTTP/1.1\r\n\r\n").await;
        }
    }
    let written = log(&fleet, LogPart::From(0)).await;
    assert!(written.text.contains("client 127.0.1.1:"), "{}", written.text);
    assert!((2048..6 * 1024).contains(&written.size), "{} bytes", written.size);
    assert_eq!(standing(&fleet).await, (ServerStatus::Run, Some(ErrorCode::ServerLogOn)));
    fleet.run(StopServer).await;
    assert!(log(&fleet, LogPart::End).await.text.contains("server stopped"));
    assert_eq!(code(&fleet.run(StartServer).await), None);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_full_log_is_deleted_and_switched_on_in_one_step() {
    let fleet = logging(FleetFirmware::Current).await;
    let limit = |bytes| fleet.controller(0).faults().update(|switches| switches.log_limit = bytes);
    assert_eq!(code(&fleet.run(switch(false)).await), None);
    let old = log(&fleet, LogPart::From(0)).await;
    limit(Some(1024 + old.size));
    let both = || {
        let SetBasicSettings { change, log_password, .. } = switch(true);
        SetBasicSettings { change: BasicSettingsChange { delete_log: true, ..change }, log_password, based_on: None }
    };
    assert_eq!(
        code(&fleet.run(switch(true)).await),
        Some(ErrorCode::ServerLogFull),
        "the server runs and stays as it is"
    );
    assert_eq!(standing(&fleet).await, (ServerStatus::Run, None));
    // A change that fails keeps the log.
    fleet.controller(0).faults().update(|switches| switches.server_error = true);
    assert_eq!(code(&fleet.run(both()).await), Some(ErrorCode::ServerError));
    fleet.controller(0).faults().update(|switches| switches.server_error = false);
    assert_eq!(log(&fleet, LogPart::From(0)).await.text, old.text);

    assert_eq!(code(&fleet.run(both()).await), None);
    assert_eq!(standing(&fleet).await, (ServerStatus::Run, Some(ErrorCode::ServerLogOn)));
    let new = log(&fleet, LogPart::From(0)).await;
    assert!(new.text.contains("server started") && !new.text.contains(&old.text), "{}", new.text);
}

#[tokio::test(flavor = "multi_thread")]
async fn a_log_can_be_read_while_a_task_runs_but_not_deleted() {
    let fleet = logging(FleetFirmware::Legacy).await;
    fleet.controller(0).faults().update(|switches| switches.task_running = true);
    assert_eq!(code(&fleet.run(delete()).await), Some(ErrorCode::TaskRunning));
    assert!(log(&fleet, LogPart::End).await.text.contains("server started"));
}
