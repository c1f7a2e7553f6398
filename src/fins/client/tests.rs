//! The client against the simulated PLC, and against servers that behave in ways the simulated PLC does not.

use std::time::{Duration, Instant};

use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpListener;

use super::super::address::{Address, AddressRange};
use super::super::codec::cpu::OperatingMode;
use super::super::codec::end_code::{EndCode, KnownEndCode};
use super::super::codec::frame::TcpRefusal;
use super::super::codec::response::Element;
use super::super::plc::{PlcConfig, SimulatedPlc};
use super::*;
use crate::model;

fn at(text: &str) -> Address {
    text.parse().unwrap()
}

fn range(text: &str) -> AddressRange {
    text.parse().unwrap()
}

async fn plc() -> SimulatedPlc {
    SimulatedPlc::start(PlcConfig { node: 90, ..PlcConfig::default() }).await.unwrap()
}

fn settings(to: std::net::SocketAddr, transport: Transport) -> ClientSettings {
    let to = model::Address::with_default_port(&to.to_string(), DEFAULT_FINS_PORT).unwrap();
    ClientSettings {
        client_node: Some(100),
        server_node: Some(90),
        answer: Duration::from_millis(300),
        first_retry: Duration::from_millis(50),
        ..ClientSettings::new(to, transport)
    }
}

fn client(plc: &SimulatedPlc, transport: Transport) -> FinsClient {
    FinsClient::new(settings(plc.address(), transport))
}

const BOTH: [Transport; 2] = [Transport::Tcp, Transport::Udp];

#[tokio::test]
async fn every_command_works_over_both_transports() {
    for transport in BOTH {
        let plc = plc().await;
        let mut client = client(&plc, transport);
        client.write_words(at("D300"), &[123, 321]).await.unwrap();
        assert_eq!(client.nodes(), Some(Nodes { client: 100, server: 90 }));
        assert_eq!(client.read_words(range("D300-301")).await.unwrap(), [123, 321]);
        client.write_bits(at("CIO0.14"), &[true, false, true]).await.unwrap();
        assert_eq!(client.read_bits(range("CIO0.14-1.01")).await.unwrap(), [true, false, true, false]);
        client.fill(range("W10-19"), 7).await.unwrap();
        assert_eq!(client.read_words(range("W9-20")).await.unwrap(), [0, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 0]);
        client.transfer(range("D300-301"), at("E1_5")).await.unwrap();
        plc.state().memory.set_bits(at("T3.F"), &[true]).unwrap();
        let elements = client.read_multiple(&[at("E1_6"), at("T3.F"), at("CIO0.15"), at("W10")]).await.unwrap();
        assert_eq!(elements, [Element::Word(321), Element::Bit(true), Element::Bit(false), Element::Word(7)]);
        let data = client.controller_data().await.unwrap();
        assert_eq!((data.model.as_str(), data.extended_memory_banks), ("CJ2M-CPU35", 4));
        let status = client.status().await.unwrap();
        assert!(status.is_running && status.mode == OperatingMode::Run);
        let time = chrono::NaiveDate::from_ymd_opt(2026, 11, 28).unwrap().and_hms_opt(5, 9, 59).unwrap();
        plc.state().clock = Some(time);
        assert_eq!(client.clock().await.unwrap(), time);
        assert_eq!(client.connections(), 1);
        plc.shutdown().await;
    }
}

#[tokio::test]
async fn what_one_frame_does_not_hold_is_cut_and_joined() {
    for transport in BOTH {
        let plc = plc().await;
        let mut client = client(&plc, transport);
        let words: Vec<u16> = (0..5_000).collect();
        client.write_words(at("D100"), &words).await.unwrap();
        let sizes: Vec<u16> = plc.state().journal().map(|record| record.range.count).collect();
        assert_eq!(sizes, [996, 996, 996, 996, 996, 20]);
        let before = plc.state().commands;
        assert_eq!(client.read_words(range("D100-5099")).await.unwrap(), words);
        assert_eq!(plc.state().commands - before, 6);
        let bits: Vec<bool> = (0..4_000).map(|bit| bit % 3 == 0).collect();
        client.write_bits(at("H0.05"), &bits).await.unwrap();
        let read = client.read_bits(AddressRange::new(at("H0.05"), 4_000).unwrap()).await.unwrap();
        assert!(read == bits);
        let addresses: Vec<Address> = (0..400).map(|word| at(&format!("D{}", 100 + word))).collect();
        let elements = client.read_multiple(&addresses).await.unwrap();
        assert!(elements.iter().enumerate().all(|(at, element)| *element == Element::Word(at as u16)));
    }
}

#[tokio::test]
async fn an_end_code_is_an_error_of_its_own() {
    for transport in BOTH {
        let plc = plc().await;
        let mut client = client(&plc, transport);
        let end = |error: ClientError| match error {
            ClientError::EndCode { end, .. } => end.known(),
            other => panic!("{other}"),
        };
        let error = client.read_words(range("A960")).await.unwrap_err();
        assert_eq!(end(error), Some(KnownEndCode::AddressRangeError));
        let error = client.write_words(at("A0"), &[1]).await.unwrap_err();
        assert!(!error.is_unknown());
        let WriteError::NotDone { done: 0, source } = error else { panic!("{error}") };
        assert_eq!(end(source), Some(KnownEndCode::ReadOnly));
        // A flag of the PLC beside a normal completion is no refusal.
        plc.state().status.non_fatal_errors = 0x10;
        assert_eq!(client.read_words(range("D0")).await.unwrap(), [0]);
        // The answer to the PLC was lost behind it: it may be done.
        plc.faults().end_code = Some(EndCode::from(KnownEndCode::ResponseTimeout));
        assert!(client.write_words(at("D0"), &[1]).await.unwrap_err().is_unknown());
    }
}

#[tokio::test]
async fn a_long_write_says_how_far_it_came() {
    let plc = plc().await;
    let mut client = client(&plc, Transport::Tcp);
    // The second command reaches beyond the end of the area of this PLC.
    plc.state().set_mode(OperatingMode::Program);
    let words = vec![7; 1_200];
    let error = client.write_words(at("A448"), &words).await.unwrap_err();
    let WriteError::NotDone { done: 0, source: ClientError::EndCode { .. } } = error else { panic!("{error:?}") };
    let error = client.write_words(at("D32000"), &words).await.unwrap_err();
    assert!(matches!(error, WriteError::NotDone { done: 0, source: ClientError::Address(_) }));
    let shared = std::sync::Arc::new(plc);
    let watch = std::sync::Arc::clone(&shared);
    let switch = tokio::spawn(async move {
        while watch.state().writes == 0 {
            tokio::task::yield_now().await;
        }
        watch.faults().is_silent = true;
    });
    let error = client.write_words(at("D0"), &vec![7; 30_000]).await.unwrap_err();
    switch.await.unwrap();
    let WriteError::Unknown { done, uncertain, .. } = error else { panic!("{error:?}") };
    assert!(done >= 996 && done % 996 == 0 && uncertain > 0, "{done} {uncertain}");
    let written = shared.state().journal().count();
    assert_eq!(written, done / 996);
}

#[tokio::test]
async fn a_silent_plc_is_noticed_in_time_and_found_again() {
    for transport in BOTH {
        let plc = plc().await;
        let mut client = client(&plc, transport);
        client.read_words(range("D0")).await.unwrap();
        plc.faults().is_silent = true;
        let start = Instant::now();
        let error = client.read_words(range("D0")).await.unwrap_err();
        assert!(matches!(error, ClientError::NoAnswer { stray: None, .. }), "{error}");
        // Over UDP the command is sent twice.
        assert!(start.elapsed() < Duration::from_millis(900), "{:?}", start.elapsed());
        let error = client.write_words(at("D0"), &[1]).await.unwrap_err();
        // Over TCP the connection was given up, and the new one gets no handshake.
        assert_eq!(error.is_unknown(), transport == Transport::Udp, "{error:?}");
        plc.faults().is_silent = false;
        let until = Instant::now() + Duration::from_secs(5);
        while client.read_words(range("D0")).await.is_err() {
            assert!(Instant::now() < until);
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }
}

#[tokio::test]
async fn a_write_whose_answer_is_lost_is_unknown_and_sent_once() {
    for transport in BOTH {
        let plc = plc().await;
        let mut client = client(&plc, transport);
        plc.faults().loses_answers = true;
        let error = client.write_words(at("D0"), &[5]).await.unwrap_err();
        assert!(matches!(error, WriteError::Unknown { done: 0, uncertain: 1, .. }), "{error:?}");
        assert_eq!(plc.state().writes, 1);
        let repeating = ClientSettings { repeats_uncertain_writes: true, ..client.settings().clone() };
        let mut client = FinsClient::new(ClientSettings { client_node: None, ..repeating });
        assert!(client.write_words(at("D0"), &[6]).await.unwrap_err().is_unknown());
        assert_eq!(plc.state().writes, 3);
    }
}

#[tokio::test]
async fn answers_that_are_not_for_this_request_are_left_out() {
    for transport in BOTH {
        let plc = plc().await;
        let mut client = client(&plc, transport);
        plc.faults().answers_wrong_node = true;
        let error = client.read_words(range("D0")).await.unwrap_err();
        let ClientError::NoAnswer { stray: Some(StrayAnswer::ForNode(to)), .. } = error else { panic!("{error}") };
        assert_eq!(to.node, 101);
        plc.faults().answers_wrong_node = false;
        // Answers come so late that each is that of the command before.
        plc.faults().delay = Some(Duration::from_millis(400));
        assert!(client.read_words(range("D0")).await.is_err());
        plc.faults().delay = None;
        plc.state().memory.set_words(at("D0"), &[9]).unwrap();
        let until = Instant::now() + Duration::from_secs(5);
        loop {
            match client.read_words(range("D0")).await {
                Ok(words) => break assert_eq!(words, [9]),
                Err(error) => assert!(Instant::now() < until, "{error}"),
            }
            tokio::time::sleep(Duration::from_millis(20)).await;
        }
    }
}

#[tokio::test]
async fn a_frame_that_is_cut_is_a_lost_connection() {
    let plc = plc().await;
    for bytes in [1, 8, 15, 16, 20, 29] {
        let mut client =
            FinsClient::new(ClientSettings { client_node: None, ..settings(plc.address(), Transport::Tcp) });
        client.read_words(range("D0")).await.unwrap();
        plc.faults().cuts_after = Some(bytes);
        let error = client.write_words(at("D0"), &[1]).await.unwrap_err();
        assert!(matches!(error, WriteError::Unknown { source: ClientError::Lost(_), .. }), "{bytes}: {error:?}");
        plc.faults().cuts_after = None;
        client.read_words(range("D0")).await.unwrap();
        assert_eq!(client.connections(), 2);
    }
    let mut client = client(&plc, Transport::Udp);
    plc.faults().cuts_after = Some(12);
    assert!(matches!(client.status().await.unwrap_err(), ClientError::Response(_)));
}

#[tokio::test]
async fn refusals_of_the_handshake_have_their_reason() {
    let plc = plc().await;
    let mut client = client(&plc, Transport::Tcp);
    for refusal in TcpRefusal::ALL {
        plc.faults().refuses = Some(refusal);
        let mut client = FinsClient::new(client.settings().clone());
        assert_eq!(client.status().await.unwrap_err(), ClientError::Refused(refusal));
    }
    plc.faults().refuses = None;
    client.status().await.unwrap();
    let connect = async |client_node, server_node| {
        let settings = ClientSettings { client_node, server_node, ..settings(plc.address(), Transport::Tcp) };
        FinsClient::new(settings).status().await.unwrap_err()
    };
    assert_eq!(connect(Some(100), None).await, ClientError::Refused(TcpRefusal::NodeConnected));
    assert_eq!(connect(Some(90), None).await, ClientError::Refused(TcpRefusal::SameNode));
    assert_eq!(connect(None, Some(91)).await, ClientError::OtherNode { expected: 91, found: 90 });
    // The connected client gets a confirmation, which it ignores.
    client.status().await.unwrap();
    assert_eq!(client.connections(), 1);
}

#[tokio::test]
async fn after_a_failure_calls_fail_at_once_until_the_next_attempt() {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let to = listener.local_addr().unwrap();
    drop(listener);
    let settings = ClientSettings { first_retry: Duration::from_secs(30), ..settings(to, Transport::Tcp) };
    let mut client = FinsClient::new(settings);
    assert!(matches!(client.status().await.unwrap_err(), ClientError::Unreachable { .. }));
    let start = Instant::now();
    let error = client.write_words(at("D0"), &[1]).await.unwrap_err();
    let WriteError::NotDone { source: ClientError::Waiting { cause, .. }, .. } = error else { panic!("{error:?}") };
    assert!(matches!(*cause, ClientError::Unreachable { .. }));
    assert!(start.elapsed() < Duration::from_millis(100));
}

#[tokio::test]
async fn a_connection_that_the_plc_closed_is_not_written_to() {
    let plc = plc().await;
    let address = plc.address();
    let mut client = client(&plc, Transport::Tcp);
    client.status().await.unwrap();
    plc.shutdown().await;
    let config = PlcConfig { node: 90, port: address.port(), ..PlcConfig::default() };
    let plc = SimulatedPlc::start(config).await.unwrap();
    client.write_words(at("D0"), &[1]).await.unwrap();
    assert_eq!((client.connections(), plc.state().writes), (2, 1));

    plc.shutdown().await;
    let strict = ClientSettings { connects_for_writes: false, ..client.settings().clone() };
    let mut client = FinsClient::new(strict);
    let error = client.write_words(at("D0"), &[1]).await.unwrap_err();
    assert_eq!(error, WriteError::NotDone { done: 0, source: ClientError::NotConnected });
}

#[tokio::test]
async fn an_idle_connection_is_kept_alive() {
    let plc = plc().await;
    let settings = ClientSettings { idle: Duration::ZERO, ..settings(plc.address(), Transport::Tcp) };
    let mut client = FinsClient::new(settings);
    client.keep_alive().await.unwrap();
    assert_eq!((client.connections(), plc.state().commands), (0, 0));
    client.connect().await.unwrap();
    client.keep_alive().await.unwrap();
    assert_eq!(plc.state().commands, 1);
    plc.faults().is_silent = true;
    assert!(matches!(client.keep_alive().await.unwrap_err(), ClientError::NoAnswer { .. }));
    assert_eq!(client.nodes(), None);
}

/// A server that accepts and answers with these bytes.
async fn answering(bytes: &'static [u8]) -> std::net::SocketAddr {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    tokio::spawn(async move {
        while let Ok((mut stream, _)) = listener.accept().await {
            let _ = stream.write_all(bytes).await;
            let mut rest = [0; 64];
            while stream.read(&mut rest).await.is_ok_and(|read| read > 0) {}
        }
    });
    address
}

#[tokio::test]
async fn servers_of_other_protocols_are_told_from_a_plc() {
    let error = async |bytes| {
        let settings =
            ClientSettings { connect: Duration::from_millis(300), ..settings(answering(bytes).await, Transport::Tcp) };
        FinsClient::new(settings).status().await.unwrap_err()
    };
    assert!(matches!(error(b"HTTP/1.1 400 Bad Request\r\n").await, ClientError::Frame(_)));
    assert!(matches!(error(b"").await, ClientError::ConnectTimeout { .. }));
    assert!(matches!(error(b"FINS\0\0\0\x08\0\0\0\x06\0\0\0\0").await, ClientError::UnexpectedFrame));
    assert!(matches!(error(b"FINS\xFF\xFF\xFF\xFF").await, ClientError::Frame(_)));
}

#[tokio::test]
async fn a_call_that_is_dropped_leaves_no_answer_behind() {
    let plc = plc().await;
    let mut client = FinsClient::new(ClientSettings { client_node: None, ..settings(plc.address(), Transport::Tcp) });
    client.status().await.unwrap();
    plc.faults().loses_answers = true;
    let dropped = tokio::time::timeout(Duration::from_millis(30), client.read_words(range("D0"))).await;
    assert!(dropped.is_err());
    assert_eq!(client.nodes(), None);
    plc.faults().loses_answers = false;
    client.read_words(range("D0")).await.unwrap();
}

#[tokio::test]
async fn several_clients_have_nodes_of_their_own() {
    let plc = plc().await;
    let mut clients: Vec<FinsClient> = (0..3)
        .map(|_| FinsClient::new(ClientSettings { client_node: None, ..settings(plc.address(), Transport::Tcp) }))
        .collect();
    for client in &mut clients {
        client.status().await.unwrap();
    }
    assert_eq!(plc.connected(), [239, 240, 241]);
    let node = clients[1].nodes().unwrap().client;
    clients[1].close();
    let until = Instant::now() + Duration::from_secs(5);
    while plc.connected().contains(&node) {
        assert!(Instant::now() < until);
        tokio::task::yield_now().await;
    }
}

#[tokio::test]
async fn run_mode_refuses_writes_where_the_series_does() {
    let plc = SimulatedPlc::start(PlcConfig { node: 90, refuses_writes_in_run: true, ..PlcConfig::default() }).await;
    let plc = plc.unwrap();
    let mut client = client(&plc, Transport::Tcp);
    let error = client.write_words(at("D0"), &[1]).await.unwrap_err();
    let WriteError::NotDone { source: ClientError::EndCode { end, .. }, .. } = error else { panic!("{error:?}") };
    assert_eq!(end.to_wire(), 0x2202);
    plc.state().set_mode(OperatingMode::Monitor);
    client.write_words(at("D0"), &[1]).await.unwrap();
}
