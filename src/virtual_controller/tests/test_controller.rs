//! A controller to try things on, and a client that knows nothing but the protocol's rustdoc.

use std::path::Path;
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use reqwest::{Method, StatusCode};
use rustls::client::danger::{HandshakeSignatureValid, ServerCertVerified, ServerCertVerifier};
use rustls::crypto::{CryptoProvider, aws_lc_rs, verify_tls12_signature, verify_tls13_signature};
use rustls::pki_types::{CertificateDer, ServerName, UnixTime};
use rustls::{DigitallySignedStruct, Error, SignatureScheme};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::json;
use tempfile::TempDir;

use crate::model::{
    Base64Bytes, ControllerSeries, ErrorCode, FirmwareVersion, KeyLength, SelfSignedRequest, ServerPort, ServerStatus,
    Subject, Validity,
};
use crate::pki::{Fingerprint, PrivateKey, ServerNames, self_signed};
use crate::protocol::{self, FailureBody, Hello, Request as _, SessionStarted};
use crate::virtual_controller::cell::{BackupMemory, Cell, CellClock, CellConfig, CellHandle, CellOptions};
use crate::virtual_controller::ports::free_port;
use crate::virtual_controller::remote::RemoteOptions;
use crate::virtual_controller::{
    AdmissionOptions, ControllerIdentity, ControllerSpec, ControllerState, NewCertificate, NewController,
    SwitchOnError, VirtualController, hash_connection_password,
};

pub const LOOPBACK: std::net::IpAddr = std::net::IpAddr::V4(std::net::Ipv4Addr::LOCALHOST);
pub const PASSWORD: &str = "connect me";
pub const LEGACY: FirmwareVersion = FirmwareVersion::new(7, 5, 58);
pub const CURRENT: FirmwareVersion = FirmwareVersion::new(8, 1, 0);

static HASH: LazyLock<String> = LazyLock::new(|| hash_connection_password(&PASSWORD.into()).unwrap());
pub static KEY: LazyLock<PrivateKey> = LazyLock::new(|| PrivateKey::generate(KeyLength::Rsa2048).unwrap());

pub struct TestController {
    pub controller: VirtualController,
    pub folder: TempDir,
}

/// Every story ends, well or badly.
pub async fn bounded<T>(story: impl Future<Output = T>) -> T {
    tokio::time::timeout(Duration::from_secs(120), story).await.expect("the story did not end")
}

pub fn initial(firmware: FirmwareVersion) -> NewController {
    let series = if firmware == CURRENT { ControllerSeries::Rc800 } else { ControllerSeries::Rc700 };
    let identity =
        ControllerIdentity {
            serial: "R7A0000001".parse().unwrap(), series, firmware, name: "测试 1".parse().unwrap()
        };
    let mut initial = NewController::new(identity, HASH.clone());
    initial.settings.port = ServerPort::try_from(free_port(LOOPBACK).unwrap()).unwrap();
    initial
}

pub fn with_certificate(mut initial: NewController) -> NewController {
    let made = chrono::Utc::now();
    let validity = Validity::try_from(2).unwrap();
    initial.certificate = Some(NewCertificate { key_length: KeyLength::Rsa2048, made, validity });
    initial
}

/// A cell with a six-axis robot, whose time stands.
pub fn cell_handle() -> CellHandle {
    let config = CellConfig {
        name: "Cell 1".parse().unwrap(),
        serial: "SN0000123".parse().unwrap(),
        series: ControllerSeries::Rc800,
        firmware: FirmwareVersion::new(8, 1, 0),
        started: chrono::DateTime::UNIX_EPOCH,
        variables: Vec::new(),
        backup: BackupMemory::default(),
        options: CellOptions::default(),
    };
    CellHandle::new(Cell::new(config), CellClock::manual())
}

pub async fn switch_on(folder: &Path, initial: NewController) -> Result<VirtualController, SwitchOnError> {
    switch_on_with(folder, initial, RemoteOptions::default()).await
}

pub async fn switch_on_with(
    folder: &Path,
    initial: NewController,
    remote: RemoteOptions,
) -> Result<VirtualController, SwitchOnError> {
    let spec = ControllerSpec {
        folder: folder.to_owned(),
        bind: LOOPBACK,
        management_port: 0,
        admission: AdmissionOptions::default(),
        cell: CellOptions::default(),
        remote,
        initial,
    };
    VirtualController::start(spec).await
}

impl TestController {
    pub async fn new(initial: NewController) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let controller = switch_on(folder.path(), initial).await.unwrap();
        Self { controller, folder }
    }

    pub async fn client(&self) -> ApiClient {
        let mut client = ApiClient::new(&self.controller);
        client.login(PASSWORD).await.unwrap();
        client
    }

    pub fn state(&self) -> Arc<ControllerState> {
        self.controller.state()
    }

    pub fn status(&self) -> (ServerStatus, Option<ErrorCode>) {
        let info = self.controller.info();
        (info.status, info.error)
    }

    pub fn revision(&self) -> u64 {
        self.state().revision
    }

    /// Whether the OPC UA port accepts connections.
    pub fn answers(&self) -> bool {
        std::net::TcpStream::connect((LOOPBACK, self.state().settings.port.get())).is_ok()
    }
}

pub struct ApiClient {
    http: reqwest::Client,
    base: String,
    token: Option<String>,
}

/// A failed request, or a lost connection.
#[derive(Debug)]
pub enum RequestFailure {
    Failure(StatusCode, FailureBody),
    Lost,
}

impl ApiClient {
    pub fn new(controller: &VirtualController) -> Self {
        let tls = tls(controller);
        let http = reqwest::Client::builder()
            .tls_backend_preconfigured(tls)
            .no_proxy()
            .timeout(Duration::from_secs(60))
            .build()
            .unwrap();
        Self { http, base: format!("https://{}", controller.management_address()), token: None }
    }

    pub async fn login(&mut self, password: &str) -> Result<(), RequestFailure> {
        let session: SessionStarted = self.post(protocol::Login::PATH, &json!({ "password": password })).await?;
        assert_eq!(session.idle_secs, protocol::SESSION_IDLE_SECS);
        self.token = Some(session.token.expose().to_owned());
        Ok(())
    }

    pub async fn get<T: DeserializeOwned>(&self, path: &str) -> Result<T, RequestFailure> {
        self.send(Method::GET, path, Vec::new()).await
    }

    pub async fn post<T: DeserializeOwned>(&self, path: &str, body: &impl Serialize) -> Result<T, RequestFailure> {
        self.send(Method::POST, path, serde_json::to_vec(body).unwrap()).await
    }

    pub async fn put<T: DeserializeOwned>(&self, path: &str, body: &impl Serialize) -> Result<T, RequestFailure> {
        self.send(Method::PUT, path, serde_json::to_vec(body).unwrap()).await
    }

    /// A response without a body is `null`.
    pub async fn send<T: DeserializeOwned>(
        &self,
        method: Method,
        path: &str,
        body: Vec<u8>,
    ) -> Result<T, RequestFailure> {
        let mut request = self.http.request(method, format!("{}{path}", self.base)).body(body);
        if let Some(token) = &self.token {
            request = request.bearer_auth(token);
        }
        let response = request.send().await.map_err(|_| RequestFailure::Lost)?;
        let status = response.status();
        let bytes = response.bytes().await.map_err(|_| RequestFailure::Lost)?;
        if status.is_success() {
            let bytes = if bytes.is_empty() { b"null".as_slice() } else { &bytes };
            return Ok(serde_json::from_slice(bytes).unwrap());
        }
        let failure: FailureBody = serde_json::from_slice(&bytes).expect("every failure is a Failure");
        if status != StatusCode::NOT_FOUND && status != StatusCode::METHOD_NOT_ALLOWED {
            assert_eq!(status.as_u16(), protocol::status_of(failure.code), "{failure:?}");
        }
        Err(RequestFailure::Failure(status, failure))
    }

    pub async fn hello(&self) -> Hello {
        self.get(protocol::GetHello::PATH).await.unwrap()
    }
}

/// TLS to a controller whose certificate is known.
pub fn tls(controller: &VirtualController) -> rustls::ClientConfig {
    let provider = Arc::new(aws_lc_rs::default_provider());
    rustls::ClientConfig::builder_with_provider(Arc::clone(&provider))
        .with_safe_default_protocol_versions()
        .unwrap()
        .dangerous()
        .with_custom_certificate_verifier(Arc::new(Pin(controller.fingerprint(), provider)))
        .with_no_client_auth()
}

/// The code of a request that must fail.
pub fn code<T: std::fmt::Debug>(result: Result<T, RequestFailure>) -> ErrorCode {
    match result {
        Err(RequestFailure::Failure(_, failure)) => failure.code,
        other => panic!("not a refusal: {other:?}"),
    }
}

pub fn request(name: &str, bits: u16) -> SelfSignedRequest {
    SelfSignedRequest {
        subject: Subject {
            common_name: name.to_owned(),
            country: "JP".to_owned(),
            state: String::new(),
            locality: String::new(),
            organisation: String::new(),
        },
        key_length: KeyLength::try_from(bits).unwrap(),
        validity: Validity::try_from(1).unwrap(),
    }
}

pub fn certificate(name: &str, now: chrono::DateTime<chrono::Utc>) -> crate::pki::Certificate {
    let names = ServerNames { application_uri: format!("urn:{name}"), ips: vec![LOOPBACK], dns: Vec::new() };
    self_signed(&request(name, 2048), &names, &KEY, now).unwrap()
}

/// Entries for a client list, each another certificate.
pub fn clients(prefix: &str, count: usize) -> Vec<(String, Base64Bytes)> {
    let name = |i: usize| format!("{prefix}{i}");
    let der = |i: usize| certificate(&name(i), chrono::Utc::now()).der().to_vec();
    (0..count).map(|i| (format!("{}.der", name(i)), Base64Bytes(der(i)))).collect()
}

#[derive(Debug)]
struct Pin(Fingerprint, Arc<CryptoProvider>);

impl ServerCertVerifier for Pin {
    fn verify_server_cert(
        &self,
        presented: &CertificateDer<'_>,
        _: &[CertificateDer<'_>],
        _: &ServerName<'_>,
        _: &[u8],
        _: UnixTime,
    ) -> Result<ServerCertVerified, Error> {
        assert_eq!(Fingerprint::of(presented), self.0);
        Ok(ServerCertVerified::assertion())
    }

    fn verify_tls12_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signature: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        verify_tls12_signature(message, certificate, signature, &self.1.signature_verification_algorithms)
    }

    fn verify_tls13_signature(
        &self,
        message: &[u8],
        certificate: &CertificateDer<'_>,
        signature: &DigitallySignedStruct,
    ) -> Result<HandshakeSignatureValid, Error> {
        verify_tls13_signature(message, certificate, signature, &self.1.signature_verification_algorithms)
    }

    fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
        self.1.signature_verification_algorithms.supported_schemes()
    }
}
