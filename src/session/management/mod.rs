//! The driver for the management protocol over HTTPS.
//!
//! | file | contents |
//! |---|---|
//! | `mod` | [`ManagementConnector`], and one HTTPS connection on which a request is sent |
//! | `session` | the session's calls as requests of the protocol |
//! | `capabilities` | what each firmware offers |
//! | `pinned_tls` | TLS that trusts one certificate |

mod capabilities;
mod pinned_tls;
mod session;

use std::error::Error;
use std::io;
use std::sync::Arc;
use std::time::Duration;

use async_trait::async_trait;
use parking_lot::Mutex;
use reqwest::header::CONTENT_TYPE;
use reqwest::{Method, StatusCode};
use serde::Deserialize;

use self::pinned_tls::PinVerifier;
use super::{Connector, ControllerSession};
use crate::model::{Address, Credentials, ErrorCode, FirmwareVersion, Problem, RevisionToken};
use crate::pki::Fingerprint;
use crate::protocol::{self, FailureBody, GetHello, Login, Request, RequestNeeds, Response as _, WireSecret};
pub(super) use capabilities::capabilities;

/// How long the driver waits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ManagementTimeouts {
    /// For the TCP and TLS handshakes. Default 5 s.
    pub connect: Duration,
    /// For an answer that takes no work in the controller. Default 10 s.
    pub read: Duration,
    /// For a change: the controller may have to make a 4096-bit key and restart its server. Default 120 s.
    pub change: Duration,
}

impl Default for ManagementTimeouts {
    fn default() -> Self {
        Self { connect: Duration::from_secs(5), read: Duration::from_secs(10), change: Duration::from_secs(120) }
    }
}

/// Pauses before another attempt after a handshake that the peer ended.
const HANDSHAKE_RETRIES: [Duration; 2] = [Duration::from_millis(100), Duration::from_millis(400)];

/// For the answer to a logout. A session that is not logged out ends by itself.
const LOGOUT_TIMEOUT: Duration = Duration::from_secs(2);

/// Opens sessions over HTTPS with a pinned certificate.
#[derive(Debug, Clone, Copy, Default)]
pub struct ManagementConnector {
    /// How long each kind of request may take.
    pub timeouts: ManagementTimeouts,
}

#[async_trait]
impl Connector for ManagementConnector {
    async fn probe(&self, address: &Address) -> Result<Fingerprint, Problem> {
        let link = HttpsConnection::new(address, None, self.timeouts)?;
        let hello = link.send(&GetHello).await.map_err(|problem| match problem.code {
            // Every web server answers so; a controller has this path in every version.
            ErrorCode::ProtocolVersion => Problem::with_detail(ErrorCode::NotAController, StatusCode::NOT_FOUND),
            _ => problem,
        })?;
        if hello.product != protocol::PRODUCT {
            return Err(ErrorCode::NotAController.into());
        }
        if !hello.versions.contains(&protocol::VERSION) {
            return Err(Problem::with_detail(ErrorCode::ProtocolVersion, format!("{:?}", hello.versions)));
        }
        link.verifier.seen().ok_or_else(|| ErrorCode::NotAController.into())
    }

    async fn connect(
        &self,
        address: &Address,
        fingerprint: Fingerprint,
        credentials: &Credentials,
    ) -> Result<Box<dyn ControllerSession>, Problem> {
        let mut link = HttpsConnection::new(address, Some(fingerprint), self.timeouts)?;
        let Credentials::ConnectionPassword(password) = credentials;
        let login = Login { password: WireSecret(password.clone()) };
        let session = link.send(&login).await?;
        link.token = Some(session.token);
        Ok(Box::new(link))
    }
}

/// One HTTPS connection that is kept open, and the token of the session on it.
struct HttpsConnection {
    client: reqwest::Client,
    verifier: Arc<PinVerifier>,
    base: String,
    pin: Option<Fingerprint>,
    token: Option<WireSecret>,
    timeouts: ManagementTimeouts,
    /// See [`ControllerSession::unanswered`].
    unanswered: Mutex<Option<RevisionToken>>,
    /// Known once the information was read.
    firmware: Option<FirmwareVersion>,
}

impl HttpsConnection {
    fn new(address: &Address, pin: Option<Fingerprint>, timeouts: ManagementTimeouts) -> Result<Self, Problem> {
        let internal = |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::Internal, e);
        let verifier = PinVerifier::new(pin);
        let tls = verifier.client_config().map_err(|e| internal(&e))?;
        let client = reqwest::Client::builder()
            .tls_backend_preconfigured(tls)
            .https_only(true)
            // A proxy would see the addresses of the controllers, which are on the local network.
            .no_proxy()
            .redirect(reqwest::redirect::Policy::none())
            .connect_timeout(timeouts.connect)
            .pool_max_idle_per_host(1)
            .build()
            .map_err(|e| internal(&e))?;
        let base = format!("https://{}", address.authority());
        Ok(Self { client, verifier, base, pin, token: None, timeouts, unanswered: Mutex::new(None), firmware: None })
    }

    /// Sends a request, and checks the response.
    async fn send<R: Request>(&self, request: &R) -> Result<R::Response, Problem> {
        let timeout = match (R::METHOD, R::NEEDS) {
            (protocol::Method::Get, _) | (_, RequestNeeds::Nothing) => self.timeouts.read,
            _ => self.timeouts.change,
        };
        self.send_within(timeout, request).await
    }

    async fn send_within<R: Request>(&self, timeout: Duration, request: &R) -> Result<R::Response, Problem> {
        let method = match R::METHOD {
            protocol::Method::Get => Method::GET,
            protocol::Method::Put => Method::PUT,
            protocol::Method::Post => Method::POST,
        };
        let based_on = request.revision();
        let mut http = self.client.request(method, format!("{}{}", self.base, request.target())).timeout(timeout);
        if let Some(token) = &self.token {
            http = http.bearer_auth(token.expose());
        }
        if R::HAS_BODY {
            let json = serde_json::to_vec(request).map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?;
            http = http.header(CONTENT_TYPE, "application/json").body(json);
        }
        let lost = || *self.unanswered.lock() = based_on;
        let response = self.exchange(http).await.map_err(|e| {
            // Without a connection nothing was sent.
            if !e.is_connect() {
                lost();
            }
            self.explain(&e)
        })?;
        let status = response.status();
        let bytes = self.read_bounded(response).await.inspect_err(|_| lost())?;
        if status.is_success() {
            // An answer without content is JSON `null`.
            let json: &[u8] = if bytes.is_empty() { b"null" } else { &bytes };
            let answer = serde_json::from_slice(json).map_err(|e| e.to_string());
            return answer
                .and_then(|mut answer: R::Response| answer.check().map_err(str::to_owned).map(|()| answer))
                .map_err(|e| {
                    lost();
                    Problem::with_detail(ErrorCode::NotAController, e)
                });
        }
        if let Ok(failure) = serde_json::from_slice::<FailureBody>(&bytes) {
            return Err(failure.into());
        }
        if let Ok(OtherFailure { code, message }) = serde_json::from_slice(&bytes) {
            return Err(Problem::with_detail(ErrorCode::Refused, format!("{code}: {message}")));
        }
        if status == StatusCode::NOT_FOUND {
            return Err(ErrorCode::ProtocolVersion.into());
        }
        Err(Problem::with_detail(ErrorCode::NotAController, format!("HTTP {status}")))
    }

    /// Sends a request. While the peer ends connections during the TLS handshake, as a controller with too many of them
    /// does, it is tried again a few times: nothing has been sent yet.
    async fn exchange(&self, request: reqwest::RequestBuilder) -> reqwest::Result<reqwest::Response> {
        for pause in HANDSHAKE_RETRIES {
            let Some(again) = request.try_clone() else { break };
            match again.send().await {
                Err(error) if error.is_connect() && handshake_failure(&error) == Some(ErrorCode::HandshakeLost) => {
                    tokio::time::sleep(pause).await;
                }
                done => return done,
            }
        }
        request.send().await
    }

    /// Reads a body of at most [`protocol::MAX_RESPONSE_BYTES`].
    async fn read_bounded(&self, mut response: reqwest::Response) -> Result<Vec<u8>, Problem> {
        let mut bytes = Vec::new();
        while let Some(chunk) = response.chunk().await.map_err(|e| self.explain(&e))? {
            if bytes.len() + chunk.len() > protocol::MAX_RESPONSE_BYTES {
                return Err(Problem::with_detail(ErrorCode::NotAController, "the answer is too large"));
            }
            bytes.extend_from_slice(&chunk);
        }
        Ok(bytes)
    }

    /// What a failed exchange means to the engineer.
    fn explain(&self, error: &reqwest::Error) -> Problem {
        if let (Some(pin), Some(seen)) = (self.pin, self.verifier.seen())
            && pin != seen
        {
            return Problem::with_detail(
                ErrorCode::FingerprintChanged,
                format!("expected {}, found {}", pin.grouped(), seen.grouped()),
            );
        }
        let detail = innermost(error);
        if error.is_connect() {
            return Problem::with_detail(handshake_failure(error).unwrap_or(ErrorCode::Unreachable), detail);
        }
        if error.is_timeout() {
            return ErrorCode::Timeout.into();
        }
        if error.is_decode() || is_caused_by_http_parse(error) {
            return Problem::with_detail(ErrorCode::NotAController, detail);
        }
        Problem::with_detail(ErrorCode::ConnectionLost, detail)
    }
}

/// A failure whose code this version does not know.
#[derive(Deserialize)]
struct OtherFailure {
    code: String,
    message: String,
}

/// An error and everything under it, also what `std::io::Error` wraps without calling it its source.
fn causes<'a>(error: &'a (dyn Error + 'static)) -> impl Iterator<Item = &'a (dyn Error + 'static)> {
    fn under<'a>(error: &'a (dyn Error + 'static)) -> Option<&'a (dyn Error + 'static)> {
        match error.downcast_ref::<io::Error>().and_then(io::Error::get_ref) {
            Some(wrapped) => Some(wrapped),
            None => error.source(),
        }
    }
    std::iter::successors(Some(error), |error| under(*error))
}

fn innermost(error: &reqwest::Error) -> String {
    causes(error).last().map(ToString::to_string).unwrap_or_default()
}

/// Why the TLS handshake failed on a TCP connection that stood: the peer speaks something else, or it hung up without a
/// word, which a controller under load does too. `None` if it was not the handshake.
fn handshake_failure(error: &reqwest::Error) -> Option<ErrorCode> {
    let hung_up = |error: &io::Error| {
        use io::ErrorKind::{BrokenPipe, ConnectionAborted, ConnectionReset, UnexpectedEof};
        matches!(error.kind(), BrokenPipe | ConnectionAborted | ConnectionReset | UnexpectedEof)
    };
    if causes(error).any(|e| e.is::<rustls::Error>()) {
        Some(ErrorCode::NotAController)
    } else if causes(error).filter_map(|e| e.downcast_ref::<io::Error>()).any(hung_up) {
        Some(ErrorCode::HandshakeLost)
    } else {
        None
    }
}

fn is_caused_by_http_parse(error: &reqwest::Error) -> bool {
    causes(error).filter_map(|e| e.downcast_ref::<hyper::Error>()).any(hyper::Error::is_parse)
}
