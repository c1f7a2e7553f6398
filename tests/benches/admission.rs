//! What the gate in front of a virtual controller's OPC UA server costs: for each read, and for each new session.
//!
//! `cargo bench --bench admission -- [READS] [SESSIONS]`; 2,000 and 20 without arguments.
//!
//! Compared with the same library's server as it is, which has fewer nodes but answers the same question. Client,
//! server and gate share this process and its cores, and everything between them is real: TCP over loopback,
//! signatures, encryption.

#[allow(dead_code, reason = "other benches need more of it")]
mod opcua_client;
mod report;

use std::fs;
use std::net::Ipv4Addr;
use std::path::Path;
use std::slice;
use std::time::{Duration, Instant};

use chrono::Utc;
use opcua::server::{ANONYMOUS_USER_TOKEN_ID, ServerBuilder, ServerEndpoint};
use opcua::types::{ReadValueId, VariableId};
use opcua_client::{Client, Failure, MODES, TestApplication, offered_endpoint};
use opcua_configurator::model::{ControllerSeries, FirmwareVersion, SecurityPolicy, UserTokenPolicy};
use opcua_configurator::pki::{TrustLists, TrustPolicy};
use opcua_configurator::virtual_controller::cell::{
    BackupMemory, Cell, CellClock, CellConfig, CellHandle, CellOptions,
};
use opcua_configurator::virtual_controller::opcua::{CertificateClock, OpcUaConfig, OpcUaServer, ServerEvents};
use report::{Spread, line};
use tokio::task::JoinHandle;
use zeroize::Zeroizing;

const ROUNDS: usize = 5;

#[tokio::main]
async fn main() -> Result<(), Failure> {
    let benching = report::is_benching();
    let reads = report::number(0).unwrap_or(if benching { 2_000 } else { 20 }).max(1);
    let sessions = report::number(1).unwrap_or(if benching { 20 } else { 1 }).max(1);
    let folder = tempfile::tempdir()?;
    let (server, client) = (TestApplication::new("server")?, TestApplication::new("client")?);
    let gated = gated(folder.path(), &server, &client).await?;
    let (bare, _bare_server) = bare(folder.path(), &server, &client).await?;
    let time = ReadValueId::from(opcua::types::NodeId::from(VariableId::Server_ServerStatus_CurrentTime));
    println!("Admission of OPC UA clients, {} cores", report::cores());

    for (policy, mode) in MODES {
        println!("{}, {mode}", policy.to_str());
        let (mut with, mut without, mut with_sessions, mut without_sessions) = (vec![], vec![], vec![], vec![]);
        // In turns, so that a busy machine is as unfair to the one as to the other.
        for _ in 0..report::rounds_when(benching, ROUNDS) {
            for (url, reading, opening) in
                [(gated.endpoint(), &mut with, &mut with_sessions), (bare.clone(), &mut without, &mut without_sessions)]
            {
                let endpoint = offered_endpoint(&url, policy, mode, &client).await?;
                let start = Instant::now();
                for _ in 0..sessions {
                    Client::connect(endpoint.clone(), &client).await?.close().await;
                }
                opening.push(start.elapsed() / u32::try_from(sessions)?);
                let client = Client::connect(endpoint, &client).await?;
                let start = Instant::now();
                for _ in 0..reads {
                    client.read(slice::from_ref(&time)).await?;
                }
                reading.push(start.elapsed() / u32::try_from(reads)?);
                client.close().await;
            }
        }
        let micros = |times: &[Duration]| Spread::of(times.iter().map(|time| time.as_secs_f64() * 1e6));
        line("read with gate (µs)", micros(&with));
        line("read without (µs)", micros(&without));
        line("the gate's part (µs)", format!("{:.0}", micros(&with).median() - micros(&without).median()));
        for (name, times) in [("session with gate (s)", &with_sessions), ("session without (s)", &without_sessions)] {
            let spread = Spread::seconds(times);
            line(name, format!("{spread}; {:.1} a second", spread.median().recip()));
        }
    }
    gated.stop().await;
    Ok(())
}

/// A cell whose time stands.
fn cell() -> Result<CellHandle, Failure> {
    let config = CellConfig {
        name: "Bench".parse()?,
        serial: "RC80010001".parse()?,
        series: ControllerSeries::Rc800,
        firmware: FirmwareVersion::new(8, 1, 0),
        started: Utc::now(),
        variables: Vec::new(),
        backup: BackupMemory::default(),
        options: CellOptions::default(),
    };
    Ok(CellHandle::new(Cell::new(config), CellClock::manual()))
}

async fn gated(folder: &Path, server: &TestApplication, client: &TestApplication) -> Result<OpcUaServer, Failure> {
    Ok(OpcUaServer::start(OpcUaConfig {
        application_name: server.name.to_owned(),
        application_uri: format!("urn:{}", server.name),
        bind: Ipv4Addr::LOCALHOST.into(),
        port: 0,
        policies: [SecurityPolicy::None, SecurityPolicy::Basic256Sha256].into(),
        user_tokens: [UserTokenPolicy::Anonymous].into(),
        users: Vec::new(),
        certificate_der: server.certificate.der().to_vec(),
        private_key_pkcs8: Zeroizing::new(server.key.to_pkcs8_der()?.to_vec()),
        trust: TrustLists::new(vec![client.certificate.clone()], Vec::new(), Vec::new()),
        trust_policy: TrustPolicy::default(),
        detailed_status: false,
        refusals: None,
        clock: CertificateClock::default(),
        cell: cell()?,
        events: ServerEvents::default(),
        pki_folder: folder.join("gated"),
    })
    .await?)
}

/// The library's server as it is, which is told to trust everybody. Its URL.
async fn bare(folder: &Path, server: &TestApplication, client: &TestApplication) -> Result<(String, Running), Failure> {
    let pki = folder.join("bare");
    server.write(&pki)?;
    fs::create_dir_all(pki.join("trusted"))?;
    let listener = tokio::net::TcpListener::bind((Ipv4Addr::LOCALHOST, 0)).await?;
    let port = listener.local_addr()?.port();
    let users = [ANONYMOUS_USER_TOKEN_ID.to_owned()];
    let mut builder = ServerBuilder::new()
        .application_name(server.name)
        .application_uri(format!("urn:{}", server.name))
        .product_uri(client.name)
        .host("127.0.0.1")
        .port(port)
        .pki_dir(&pki)
        .certificate_path("own.der")
        .private_key_path("own.pem")
        .trust_client_certs(true)
        .discovery_urls(vec![format!("opc.tcp://127.0.0.1:{port}/")]);
    for (policy, mode) in MODES {
        builder = builder.add_endpoint(policy.to_str(), ServerEndpoint::new("/", policy, mode, &users));
    }
    let (server, handle) = builder.build()?;
    let running = tokio::spawn(server.run_with(listener));
    Ok((format!("opc.tcp://127.0.0.1:{port}"), Running { handle, _task: running }))
}

struct Running {
    handle: opcua::server::ServerHandle,
    _task: JoinHandle<Result<(), String>>,
}

impl Drop for Running {
    fn drop(&mut self) {
        self.handle.cancel();
    }
}
