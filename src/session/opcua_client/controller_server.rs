//! The OPC UA server of a managed controller: where it is, which certificate it must show, and how to log in.

use thiserror::Error;

use super::{
    ClientSession, ConnectFailure, Endpoint, MessageSecurity, OpcUaClient, ServerLocation, TokenKind, UserLogin,
};
use crate::model::{ErrorCode, Problem, SecurityPolicy, ServerStatus};
use crate::pki::Certificate;
use crate::session::ControllerSession;

/// The running OPC UA server of a controller, as the session with the controller describes it.
#[derive(Debug, Clone)]
pub struct ControllerServer {
    /// Where it listens.
    pub target: ServerLocation,
    /// The certificate that the controller has selected; the server must show this one.
    pub certificate: Certificate,
}

/// Why no session with the OPC UA server of a controller could be opened.
#[derive(Debug, Error)]
pub enum ServerConnectError {
    /// The server does not run.
    #[error("the OPC UA server has the status {0:?}")]
    NotRunning(ServerStatus),
    /// The controller has selected no certificate, or one that cannot be read.
    #[error("the controller has no readable server certificate")]
    NoCertificate,
    /// No endpoint with this certificate takes this login over a protected connection.
    #[error("no endpoint fits: {0}")]
    NoEndpoint(&'static str),
    /// The server does not trust the certificate of this program.
    #[error("the server refuses the certificate of this program: {0}")]
    NotTrusted(String),
    /// The server does not let this user in.
    #[error("the server refuses the login: {0}")]
    LoginRefused(String),
    /// Nothing answers, or what answers breaks off.
    #[error("{} at stage {:?}", .0.cause, .0.stage)]
    Failed(ConnectFailure),
}

impl ControllerServer {
    /// Asks the controller for its server's port and certificate. `host`: where the controller is reached.
    ///
    /// Errors: those of the session, [`ServerNotRunning`](ErrorCode::ServerNotRunning),
    /// [`NoCertificate`](ErrorCode::NoCertificate).
    pub async fn find(session: &mut dyn ControllerSession, host: &str) -> Result<Self, Problem> {
        let info = session.info().await?;
        if info.status != ServerStatus::Run {
            return Err(ServerConnectError::NotRunning(info.status).into());
        }
        let settings = session.settings().await?.value;
        let held = session.certificates().await?.value;
        let selected = held.of(held.selected).and_then(|der| Certificate::from_der(der).ok());
        let certificate = selected.ok_or(ServerConnectError::NoCertificate)?;
        Ok(Self { target: ServerLocation { host: host.to_owned(), port: settings.port.get() }, certificate })
    }

    /// Opens a session over the best protected endpoint that takes this login. An endpoint without security is used only
    /// if the server offers no other, and never for a password that would not be encrypted.
    pub async fn connect(&self, client: &OpcUaClient, login: &UserLogin) -> Result<ClientSession, ServerConnectError> {
        let endpoints = client.endpoints(&self.target).await.map_err(ServerConnectError::Failed)?;
        let endpoint = self.choose(&endpoints, login)?;
        client.session(&self.target, endpoint, &self.certificate, login).await.map_err(|failure| {
            let secured = endpoint.mode != Some(MessageSecurity::None);
            match failure {
                failure if secured && failure.is_about_own_certificate() => {
                    ServerConnectError::NotTrusted(failure.cause.to_string())
                }
                failure if failure.is_about_the_login() => ServerConnectError::LoginRefused(failure.cause.to_string()),
                failure => ServerConnectError::Failed(failure),
            }
        })
    }

    fn choose<'a>(&self, endpoints: &'a [Endpoint], login: &UserLogin) -> Result<&'a Endpoint, ServerConnectError> {
        let kind = match login {
            UserLogin::Anonymous => TokenKind::Anonymous,
            UserLogin::User { .. } => TokenKind::UserName,
        };
        let is_consistent = |endpoint: &&Endpoint| match (&endpoint.policy, endpoint.mode) {
            (Ok(SecurityPolicy::None), mode) => mode == Some(MessageSecurity::None),
            (Ok(_), mode) => mode > Some(MessageSecurity::None),
            (Err(_), _) => false,
        };
        let shows_it = |endpoint: &&Endpoint| endpoint.certificates().is_ok_and(|(leaf, _)| leaf == self.certificate);
        let takes = |endpoint: &&Endpoint| {
            let offered = endpoint.tokens.iter().find(|token| token.kind == kind);
            offered.is_some_and(|token| kind == TokenKind::Anonymous || token.protected)
        };
        let mut found = endpoints.iter().filter(is_consistent).peekable();
        found.peek().ok_or(ServerConnectError::NoEndpoint("none with a known security policy"))?;
        let mut found = found.filter(shows_it).peekable();
        found.peek().ok_or(ServerConnectError::NoEndpoint("none shows the selected certificate"))?;
        let key = |endpoint: &&Endpoint| (endpoint.mode, endpoint.policy.clone().ok());
        found.filter(takes).max_by_key(key).ok_or(ServerConnectError::NoEndpoint("none takes this login"))
    }
}

impl From<ServerConnectError> for Problem {
    fn from(error: ServerConnectError) -> Self {
        Self::with_detail(error.code(), error)
    }
}

impl ServerConnectError {
    /// What an engineer is told of it.
    pub const fn code(&self) -> ErrorCode {
        match self {
            Self::NotRunning(_) => ErrorCode::ServerNotRunning,
            Self::NoCertificate => ErrorCode::NoCertificate,
            Self::NoEndpoint(_) => ErrorCode::NoSuitableEndpoint,
            Self::NotTrusted(_) => ErrorCode::ConfiguratorNotTrusted,
            Self::LoginRefused(_) => ErrorCode::OpcUaLoginRefused,
            Self::Failed(_) => ErrorCode::OpcUaConnectionFailed,
        }
    }
}
