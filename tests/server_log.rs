//! The server log: what it holds, how it is read, and what happens when it is full.

#[path = "common/plant.rs"]
mod plant;

use std::collections::BTreeSet;
use std::net::TcpStream;
use std::time::{Duration, Instant};

use opcua_configurator::jobs::{
    GetInfo, LogPart, Outcome, ReadLog, Report, SelfSigned, SelfSignedFields, SetSettings, SettingsChange, StartServer,
    StopServer,
};
use opcua_configurator::model::{
    ControllerInfo, ErrorCode, KeyLength, SecurityPolicy, ServerSettings, ServerStatus, Validity,
};
use opcua_configurator::protocol::LogChunk;
use opcua_configurator::virtual_controller::FleetFirmware;
use plant::Plant;

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

fn switch(on: bool) -> SetSettings {
    SetSettings {
        change: SettingsChange {
            server_log: Some(on),
            security_policies: Some(BTreeSet::from([SecurityPolicy::Basic256Sha256])),
            ..SettingsChange::default()
        },
        log_password: on.then(|| ServerSettings::LOG_PASSWORD.to_owned()),
        ..SetSettings::default()
    }
}

fn delete() -> SetSettings {
    let change = SettingsChange { delete_log: true, ..SettingsChange::default() };
    SetSettings { change, ..SetSettings::default() }
}

fn code(reports: &[Report]) -> Option<ErrorCode> {
    reports[0].result.as_ref().err().map(|problem| problem.code)
}

async fn standing(plant: &Plant) -> (ServerStatus, Option<ErrorCode>) {
    let ControllerInfo { status, error, .. } = plant.run(GetInfo).await[0].info.clone().unwrap();
    (status, error)
}

async fn log(plant: &Plant, part: LogPart) -> LogChunk {
    match &plant.run(ReadLog { part }).await[0].result {
        Ok(Outcome::Log(log)) => log.clone(),
        other => panic!("{other:?}"),
    }
}

/// A running server on one controller, with its log on.
async fn logging(firmware: FleetFirmware) -> Plant {
    let plant = Plant::start(1, firmware).await;
    plant.run(certificate()).await;
    assert_eq!(code(&plant.run(switch(true)).await), None);
    assert_eq!(code(&plant.run(StartServer).await), None);
    plant
}

fn connect(plant: &Plant) -> std::io::Result<TcpStream> {
    TcpStream::connect(plant.controller(0).endpoint().trim_start_matches("opc.tcp://"))
}

#[tokio::test(flavor = "multi_thread")]
async fn a_log_is_switched_on_read_and_switched_off_again() {
    let plant = Plant::start(1, FleetFirmware::Current).await;
    plant.run(certificate()).await;
    plant.run(StartServer).await;
    assert_eq!(log(&plant, LogPart::From(0)).await, LogChunk::default(), "off, and never on");
    let without = SetSettings { log_password: None, ..switch(true) };
    assert_eq!(code(&plant.run(without).await), Some(ErrorCode::LogPassword));

    assert_eq!(code(&plant.run(switch(true)).await), None);
    assert_eq!(standing(&plant).await, (ServerStatus::Run, Some(ErrorCode::ServerLogOn)), "a notice, not an error");
    let client = connect(&plant).unwrap();
    let from = client.local_addr().unwrap();
    drop(client);
    let asked = Instant::now();
    while !log(&plant, LogPart::End).await.text.contains(&format!("connection from {from} closed")) {
        assert!(asked.elapsed() < Duration::from_secs(20), "{}", log(&plant, LogPart::End).await.text);
        tokio::time::sleep(Duration::from_millis(20)).await;
    }
    plant.run(StopServer).await;
    assert_eq!(standing(&plant).await, (ServerStatus::Stop, Some(ErrorCode::ServerLogOn)));
    let whole = log(&plant, LogPart::From(0)).await;
    let lines: Vec<&str> = whole.text.lines().collect();
    assert!(lines[0].contains("server started: opc.tcp://127.0.0.1:"), "{lines:?}");
    assert!(lines.last().unwrap().contains("server stopped"), "{lines:?}");
    assert_eq!((whole.size, whole.next), (whole.text.len() as u64, whole.size));

    assert_eq!(code(&plant.run(switch(false)).await), None);
    plant.run(StartServer).await;
    assert_eq!(standing(&plant).await, (ServerStatus::Run, None));
    assert_eq!(log(&plant, LogPart::From(0)).await, whole, "kept, and nothing added");
    assert_eq!(code(&plant.run(delete()).await), None);
    assert_eq!(log(&plant, LogPart::End).await, LogChunk::default());
}

#[tokio::test(flavor = "multi_thread")]
async fn a_full_log_stops_the_server_until_it_is_deleted_or_switched_off() {
    let plant = logging(FleetFirmware::Legacy).await;
    plant.controller(0).faults().update(|switches| switches.log_limit = Some(4096));
    let asked = Instant::now();
    while standing(&plant).await != (ServerStatus::Error, Some(ErrorCode::ServerLogFull)) {
        assert!(asked.elapsed() < Duration::from_secs(60), "the log does not fill");
        for _ in 0..10 {
            let _ = connect(&plant);
        }
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    assert!(connect(&plant).is_err(), "it does not even listen");
    let full = log(&plant, LogPart::From(0)).await;
    assert!(full.size <= 4096 && full.text.contains("the log is full; the server stops"), "{}", full.text);
    assert_eq!(code(&plant.run(StartServer).await), Some(ErrorCode::ServerLogFull));

    plant.run(delete()).await;
    assert_eq!(code(&plant.run(StartServer).await), None);
    assert_eq!(standing(&plant).await, (ServerStatus::Run, Some(ErrorCode::ServerLogOn)));
    assert!(log(&plant, LogPart::From(0)).await.size < full.size);

    plant.controller(0).faults().update(|switches| switches.log_limit = Some(1024));
    plant.run(StopServer).await;
    assert_eq!(code(&plant.run(StartServer).await), Some(ErrorCode::ServerLogFull));
    assert_eq!(code(&plant.run(switch(false)).await), None);
    assert_eq!(code(&plant.run(StartServer).await), None, "without a log it does not matter");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_log_can_be_read_while_a_task_runs_but_not_deleted() {
    let plant = logging(FleetFirmware::Legacy).await;
    plant.controller(0).faults().update(|switches| switches.task_running = true);
    assert_eq!(code(&plant.run(delete()).await), Some(ErrorCode::TaskRunning));
    assert!(log(&plant, LogPart::End).await.text.contains("server started"));
}
