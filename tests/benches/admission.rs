//! What the gate in front of a virtual controller's OPC UA server costs: for each read, and for each new session.
//!
//! `cargo bench --bench admission -- [READS] [SESSIONS]`; 2,000 and 20 without arguments.
//!
//! Compared with the same library's server as it is, which has fewer nodes but answers the same question. Client,
//! server and gate share this process and its cores, and everything between them is real: TCP over loopback,
//! signatures, encryption.

mod report;

use std::fs;
use std::net::{IpAddr, Ipv4Addr};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use chrono::{TimeDelta, Utc};
use opcua::client::{ClientBuilder, IdentityToken, Session};
use opcua::crypto::SecurityPolicy as WirePolicy;
use opcua::server::{ANONYMOUS_USER_TOKEN_ID, ServerBuilder, ServerEndpoint};
use opcua::types::{MessageSecurityMode, ReadValueId, StatusCode, TimestampsToReturn, VariableId};
use opcua_configurator::model::{
    ControllerSeries, FirmwareVersion, KeyLength, SecurityPolicy, SelfSignedRequest, Subject, UserTokenPolicy, Validity,
};
use opcua_configurator::pki::{Certificate, PrivateKey, ServerNames, TrustLists, TrustPolicy, self_signed};
use opcua_configurator::virtual_controller::cell::{
    BackupMemory, Cell, CellClock, CellConfig, CellHandle, CellOptions,
};
use opcua_configurator::virtual_controller::opcua::{CertificateClock, OpcUaConfig, OpcUaServer, ServerEvents};
use report::{Spread, line};
use rsa::RsaPrivateKey;
use rsa::pkcs8::{DecodePrivateKey as _, EncodePrivateKey as _, LineEnding};
use tokio::task::JoinHandle;
use zeroize::Zeroizing;

const ROUNDS: usize = 5;
const MODES: [(WirePolicy, MessageSecurityMode); 2] =
    [(WirePolicy::None, MessageSecurityMode::None), (WirePolicy::Basic256Sha256, MessageSecurityMode::SignAndEncrypt)];

type Failure = Box<dyn std::error::Error + Send + Sync>;

#[tokio::main]
async fn main() -> Result<(), Failure> {
    let benching = report::is_benching();
    let reads = report::number(0).unwrap_or(if benching { 2_000 } else { 20 }).max(1);
    let sessions = report::number(1).unwrap_or(if benching { 20 } else { 1 }).max(1);
    let folder = tempfile::tempdir()?;
    let (server, client) = (TestApplication::new("server")?, TestApplication::new("client")?);
    let gated = gated(folder.path(), &server, &client).await?;
    let (bare, _bare_server) = bare(folder.path(), &server, &client).await?;
    println!("Admission of OPC UA clients, {} cores", report::cores());

    for (policy, mode) in MODES {
        println!("{}, {mode}", policy.to_str());
        let (mut with, mut without, mut with_sessions, mut without_sessions) = (vec![], vec![], vec![], vec![]);
        // In turns, so that a busy machine is as unfair to the one as to the other.
        for _ in 0..report::rounds_when(benching, ROUNDS) {
            for (url, reading, opening) in
                [(gated.endpoint(), &mut with, &mut with_sessions), (bare.clone(), &mut without, &mut without_sessions)]
            {
                let start = Instant::now();
                for _ in 0..sessions {
                    Client::connect(&url, policy, mode, &server, &client).await?.close().await;
                }
                opening.push(start.elapsed() / u32::try_from(sessions)?);
                let client = Client::connect(&url, policy, mode, &server, &client).await?;
                let start = Instant::now();
                for _ in 0..reads {
                    client.read().await?;
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

/// An application's key and certificate.
struct TestApplication {
    name: &'static str,
    key: PrivateKey,
    certificate: Certificate,
}

impl TestApplication {
    fn new(name: &'static str) -> Result<Self, Failure> {
        let subject = Subject {
            common_name: name.to_owned(),
            country: String::new(),
            state: String::new(),
            locality: String::new(),
            organisation: String::new(),
        };
        let request = SelfSignedRequest { subject, key_length: KeyLength::Rsa2048, validity: Validity::try_from(1)? };
        let names = ServerNames {
            application_uri: format!("urn:{name}"),
            ips: vec![IpAddr::V4(Ipv4Addr::LOCALHOST)],
            dns: Vec::new(),
        };
        let key = PrivateKey::generate(KeyLength::Rsa2048)?;
        let certificate = self_signed(&request, &names, &key, Utc::now() - TimeDelta::hours(1))?;
        Ok(Self { name, key, certificate })
    }

    /// Where the library looks for them.
    fn write(&self, folder: &Path) -> Result<(), Failure> {
        fs::create_dir_all(folder)?;
        fs::write(folder.join("own.der"), self.certificate.der())?;
        let key = RsaPrivateKey::from_pkcs8_der(&self.key.to_pkcs8_der()?)?;
        fs::write(folder.join("own.pem"), key.to_pkcs8_pem(LineEnding::LF)?.as_bytes())?;
        Ok(())
    }
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

struct Client {
    session: Arc<Session>,
    events: JoinHandle<StatusCode>,
    _folder: tempfile::TempDir,
}

impl Client {
    async fn connect(
        url: &str,
        policy: WirePolicy,
        mode: MessageSecurityMode,
        server: &TestApplication,
        client: &TestApplication,
    ) -> Result<Self, Failure> {
        let folder = tempfile::tempdir()?;
        client.write(folder.path())?;
        let mut dialling = ClientBuilder::new()
            .application_name(client.name)
            .application_uri(format!("urn:{}", client.name))
            .product_uri(client.name)
            .pki_dir(folder.path())
            .certificate_path("own.der")
            .private_key_path("own.pem")
            .trust_server_certs(true)
            .verify_server_certs(false)
            .session_retry_limit(0)
            .client()
            .map_err(|errors| errors.join(", "))?;
        let endpoint = opcua::types::EndpointDescription {
            endpoint_url: url.into(),
            server_certificate: server.certificate.der().into(),
            security_policy_uri: policy.to_uri().into(),
            security_mode: mode,
            user_identity_tokens: Some(vec![opcua::types::UserTokenPolicy {
                policy_id: "anonymous".into(),
                token_type: opcua::types::UserTokenType::Anonymous,
                ..Default::default()
            }]),
            ..Default::default()
        };
        let (session, events) = dialling.connect_to_endpoint_directly(endpoint, IdentityToken::Anonymous)?;
        let mut events = events.spawn();
        tokio::select! {
            _ = session.wait_for_connection() => Ok(Self { session, events, _folder: folder }),
            status = &mut events => Err(format!("not connected to {url}: {}", status?).into()),
        }
    }

    async fn read(&self) -> Result<(), Failure> {
        let time = ReadValueId::from(opcua::types::NodeId::from(VariableId::Server_ServerStatus_CurrentTime));
        let values = self.session.read(&[time], TimestampsToReturn::Both, 0.0).await?;
        match values.first() {
            Some(value) if value.value.is_some() => Ok(()),
            _ => Err("nothing was read".into()),
        }
    }

    async fn close(self) {
        let _ = self.session.disconnect().await;
        let _ = self.events.await;
    }
}
