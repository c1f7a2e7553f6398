use std::sync::Arc;
use std::time::Duration;

use opcua::crypto::{CertificateStore, PrivateKey, X509, X509Data};
use opcua::sync::RwLock;
use parking_lot::Mutex;
use tokio::task::JoinSet;

use super::attempt::{self, ReadServerState};
use super::client_session::ClientSession;
use super::connection::{ConnectionSetup, ReceiveLimits};
use super::endpoint::Endpoint;
use super::failure::{ConnectFailure, ConnectFailureCause, ConnectStage};
use super::open_session::SessionRequest;
use super::server_location::ServerLocation;
use super::session_channel;
use super::user_login::UserLogin;
use crate::model::{ErrorCode, Problem};
use crate::pki::Certificate;
use crate::workspace::{ConfiguratorIdentity, KeyFile};

/// How long a client waits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ConnectTimeouts {
    /// For the TCP connection. Default 4 s.
    pub connect: Duration,
    /// For everything of one try, from TCP to goodbye. Default 10 s: a controller needs seconds for RSA with 4096 bits
    /// and for hashing a password.
    pub attempt: Duration,
}

impl Default for ConnectTimeouts {
    fn default() -> Self {
        Self { connect: Duration::from_secs(4), attempt: Duration::from_secs(10) }
    }
}

/// Tries one server under one application instance certificate.
pub struct OpcUaClient {
    application_uri: String,
    store: Arc<RwLock<CertificateStore>>,
    own: Option<(X509, PrivateKey)>,
    timeouts: ConnectTimeouts,
    /// Dropped before its folder.
    _key_file: KeyFile,
    /// Where the library writes the certificates of servers; removed in the end.
    _folder: tempfile::TempDir,
}

impl std::fmt::Debug for OpcUaClient {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("OpcUaClient").field("application_uri", &self.application_uri).finish_non_exhaustive()
    }
}

impl OpcUaClient {
    /// Blocks while it reads key and certificate.
    pub fn new(identity: &ConfiguratorIdentity, timeouts: ConnectTimeouts) -> Result<Self, Problem> {
        let folder = tempfile::tempdir().map_err(|e| Problem::with_detail(ErrorCode::WorkspaceReadOnly, e))?;
        // The library reads both again for every connection; absolute paths keep it from copying the key.
        let certificate = std::path::absolute(&identity.certificate_path)
            .map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?;
        let key_file = identity.open_key(folder.path())?;
        let (mut store, certificate, key) = CertificateStore::new_with_x509_data(
            folder.path(),
            false,
            Some(&certificate),
            Some(&key_file.path),
            None::<X509Data>,
        );
        // It knows exact copies only, and no issuers; the caller judges the certificate before this client sees it.
        store.set_skip_verify_certs(true);
        store.set_trust_unknown_certs(true);
        let own = certificate.zip(key);
        if own.is_none() {
            return Err(Problem::with_detail(ErrorCode::FileUnreadable, identity.key_path.display()));
        }
        Ok(Self {
            application_uri: identity.application_uri(),
            store: Arc::new(RwLock::new(store)),
            own,
            timeouts,
            _key_file: key_file,
            _folder: folder,
        })
    }

    /// The endpoints that the server offers, over a channel without security (OPC 10000-4 §5.5.4).
    pub async fn endpoints(&self, target: &ServerLocation) -> Result<Vec<Endpoint>, ConnectFailure> {
        let connection = self.connection(target, ReceiveLimits::ONE_TRY);
        self.bounded(connection.stage.clone(), async move { connection.endpoints().await }).await
    }

    /// Opens a channel as the endpoint wants it, creates and activates a session, reads the server's state, and says
    /// goodbye. `expected` is the certificate the server must have: with another it comes to no secure channel, and no
    /// password is sent.
    pub async fn attempt(
        &self,
        target: &ServerLocation,
        endpoint: &Endpoint,
        expected: &Certificate,
        login: &UserLogin,
    ) -> Result<ReadServerState, ConnectFailure> {
        let request = self.session_request(target, endpoint, expected, login, ReceiveLimits::ONE_TRY)?;
        let request = SessionRequest { session_timeout_ms: attempt::SESSION_TIMEOUT_MS, ..request };
        self.bounded(request.connection.stage.clone(), attempt::attempt(request)).await
    }

    /// Opens a channel as the endpoint wants it, and a session that stays open. `expected` is the certificate the server
    /// must have, as for [`OpcUaClient::attempt`].
    pub async fn session(
        &self,
        target: &ServerLocation,
        endpoint: &Endpoint,
        expected: &Certificate,
        login: &UserLogin,
    ) -> Result<ClientSession, ConnectFailure> {
        let request = self.session_request(target, endpoint, expected, login, ReceiveLimits::SESSION)?;
        let session = self.bounded(request.connection.stage.clone(), request.open()).await?;
        Ok(ClientSession::new(session))
    }

    fn session_request(
        &self,
        target: &ServerLocation,
        endpoint: &Endpoint,
        expected: &Certificate,
        login: &UserLogin,
        limits: ReceiveLimits,
    ) -> Result<SessionRequest, ConnectFailure> {
        let Some((own_certificate, own_key)) = self.own.clone() else {
            return Err(ConnectFailure::of(
                ConnectStage::Channel,
                ConnectFailureCause::Internal("the client has no key".to_owned()),
            ));
        };
        Ok(SessionRequest {
            connection: self.connection(target, limits),
            endpoint: endpoint.clone(),
            expected: expected.der().to_vec(),
            login: login.clone(),
            application_uri: self.application_uri.clone(),
            own_certificate,
            own_key,
            session_timeout_ms: session_channel::SESSION_TIMEOUT_MS,
        })
    }

    fn connection(&self, target: &ServerLocation, limits: ReceiveLimits) -> ConnectionSetup {
        ConnectionSetup {
            target: target.clone(),
            store: self.store.clone(),
            connect: self.timeouts.connect,
            stage: Arc::new(Mutex::new(ConnectStage::Connect)),
            limits,
        }
    }

    /// In a task of its own, which ends with this call: what the peer sends may trip the library up.
    async fn bounded<R: Send + 'static>(
        &self,
        stage: Arc<Mutex<ConnectStage>>,
        work: impl Future<Output = Result<R, ConnectFailure>> + Send + 'static,
    ) -> Result<R, ConnectFailure> {
        let mut task = JoinSet::new();
        task.spawn(work);
        match tokio::time::timeout(self.timeouts.attempt, task.join_next()).await {
            Ok(Some(Ok(result))) => result,
            Ok(Some(Err(_)) | None) => Err(ConnectFailure::of(
                *stage.lock(),
                ConnectFailureCause::NotOpcUa("its answer cannot be read".to_owned()),
            )),
            Err(_) => Err(ConnectFailure::of(*stage.lock(), ConnectFailureCause::TimedOut)),
        }
    }
}
