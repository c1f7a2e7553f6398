//! The controller's end of [`crate::protocol`].

use std::future::{pending, poll_fn};
use std::net::IpAddr;
use std::pin::pin;
use std::sync::{Arc, LazyLock};
use std::time::{Duration, Instant};

use axum::body::{Body, Bytes, HttpBody as _};
use axum::extract::rejection::PathRejection;
use axum::extract::{Extension, FromRequestParts, Path, RawQuery};
use axum::http::request::Parts;
use axum::http::{StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::{get, post};
use axum::{Json, Router};
use parking_lot::Mutex;
use secrecy::ExposeSecret as _;
use serde::de::DeserializeOwned;
use tokio::sync::Mutex as AsyncMutex;
use tokio_util::sync::CancellationToken;

use super::certificate_changes;
use super::changes;
use super::controller::{Controller, Effect, Outcome};
use super::listener::Peer;
use super::login::{Sessions, Throttle};
use super::password::is_password;
use super::request_heads::Refusal;
use super::settings_transfer;
use super::state::{State, Surroundings};
use crate::model::activation::ActivationKeys;
use crate::model::{ClientList, ControllerInfo, ErrorCode, Problem, ServerSettings, UserName};
use crate::protocol::{
    self, Activate, AddUser, Base64Bytes, Changed, CsrMade, EditTrust, ExportSettings, Failure, HeldCertificates,
    Hello, ImportCaSigned, ImportCertificate, ImportCsr, ImportSettings, Installed, ListedCrl, LogChunk, Login,
    MakeCsr, MakeSelfSigned, RemoveUsers, Revisioned, SESSION_IDLE_SECS, SelectCertificate, Session, SetSettings,
    SettingsExport, TrustChanged, TrustStamp, WireSecret,
};

/// How long a wrong password waits for its answer.
const WRONG_PASSWORD_DELAY: Duration = Duration::from_millis(300);
const BODY_TIMEOUT: Duration = Duration::from_secs(10);
/// What is read and thrown away of a body over its limit, so that the client gets to read the answer.
const MAX_DRAINED_BYTES: usize = 8 * protocol::MAX_REQUEST_BYTES;

/// One router for every controller of the process: which one is meant comes with the connection, as an extension.
pub static ROUTER: LazyLock<Router> = LazyLock::new(|| {
    Router::new()
        .route(protocol::HELLO, get(hello))
        .route(protocol::LOGIN, post(login))
        .route(protocol::LOGOUT, post(logout))
        .route(protocol::INFO, get(info))
        .route(protocol::SETTINGS, get(settings).put(set_settings))
        .route(protocol::USERS, get(users).post(add_user))
        .route(protocol::USERS_REMOVE, post(remove_users))
        .route(protocol::SERVER_START, post(start))
        .route(protocol::SERVER_STOP, post(stop))
        .route(protocol::SELF_SIGNED, post(self_signed))
        .route(protocol::CERTIFICATE_IMPORT, post(import_certificate))
        .route(protocol::CERTIFICATES, get(certificates))
        .route(protocol::CERTIFICATE_SELECT, post(select_certificate))
        .route(protocol::CSR, post(make_csr))
        .route(protocol::CSR_IMPORT, post(import_csr))
        .route(protocol::CA_SIGNED, post(import_ca_signed))
        .route(&format!("{}/{{list}}", protocol::CLIENTS), get(clients))
        .route(protocol::CRLS, get(crls))
        .route(&protocol::crl_path("{id}"), get(crl))
        .route(protocol::TRUST, get(trust_stamp).post(edit_trust))
        .route(protocol::ACTIVATION, post(activate))
        .route(protocol::LOG, get(log))
        .route(protocol::SETTINGS_EXPORT, post(export_settings))
        .route(protocol::SETTINGS_IMPORT, post(import_settings))
        .fallback(unknown_path)
        .method_not_allowed_fallback(unknown_method)
});

/// The management protocol of one controller.
#[derive(Debug)]
pub struct Api {
    controller: Arc<Controller>,
    /// Held while a password is compared, so that no two guesses slip by the count together.
    throttle: AsyncMutex<Throttle>,
    sessions: Mutex<Sessions>,
}

/// What a request needs to know about the connection it came by.
#[derive(Debug, Clone)]
pub struct Connection {
    pub api: Arc<Api>,
    pub peer: Arc<Peer>,
    /// The controller's address the client used.
    pub local: IpAddr,
    /// Cuts the connection without an answer.
    pub cut: CancellationToken,
}

impl Api {
    pub fn new(controller: Arc<Controller>) -> Self {
        Self { controller, throttle: AsyncMutex::default(), sessions: Mutex::default() }
    }

    pub fn latency(&self) -> Duration {
        self.controller.faults().get().latency
    }
}

/// A request with a living session.
struct Caller {
    connection: Connection,
    token: WireSecret,
}

/// A failed request. The status is the code's own unless something else is said.
struct Failed {
    status: StatusCode,
    problem: Problem,
}

type Answer<T> = Result<Json<T>, Failed>;

impl Caller {
    fn controller(&self) -> &Arc<Controller> {
        &self.connection.api.controller
    }

    /// What became of a change. If the connection is to be lost here, this is the end of the request.
    async fn settle<T>(&self, outcome: Result<T, Outcome>) -> Result<T, Failed> {
        match outcome {
            Ok(value) => Ok(value),
            Err(Outcome::Problem(problem)) => Err(problem.into()),
            Err(Outcome::Dropped) => {
                self.connection.cut.cancel();
                pending().await
            }
        }
    }
}

impl<S: Send + Sync> FromRequestParts<S> for Caller {
    type Rejection = Failed;

    async fn from_request_parts(parts: &mut Parts, _state: &S) -> Result<Self, Failed> {
        let connection = parts
            .extensions
            .get::<Connection>()
            .cloned()
            .ok_or_else(|| Problem::with_detail(ErrorCode::Internal, "a request without a connection"))?;
        let token = parts
            .headers
            .get(header::AUTHORIZATION)
            .and_then(|value| value.to_str().ok())
            .and_then(|value| value.strip_prefix("Bearer "))
            .ok_or(Problem::new(ErrorCode::SessionExpired))?;
        if !connection.api.sessions.lock().touch(token, Instant::now()) {
            return Err(Problem::new(ErrorCode::SessionExpired).into());
        }
        connection.peer.has_session();
        let token = WireSecret(token.into());
        Ok(Self { connection, token })
    }
}

impl From<Problem> for Failed {
    fn from(problem: Problem) -> Self {
        let status = StatusCode::from_u16(protocol::status_of(problem.code));
        Self { status: status.unwrap_or(StatusCode::INTERNAL_SERVER_ERROR), problem }
    }
}

/// The answer to a request whose head was refused.
pub fn refused(refusal: Refusal) -> Response {
    Failed { status: refusal.status, problem: refusal.problem }.into_response()
}

impl IntoResponse for Failed {
    fn into_response(self) -> Response {
        (self.status, Json(Failure::from(self.problem))).into_response()
    }
}

async fn hello() -> Json<Hello> {
    Json(Hello { product: protocol::PRODUCT.to_owned(), versions: vec![protocol::VERSION] })
}

async fn login(Extension(connection): Extension<Connection>, body: Body) -> Answer<Session> {
    let Login { password } = read(body, Malformed::secret(ErrorCode::Refused)).await?;
    let api = &connection.api;
    let right = {
        let mut throttle = api.throttle.lock().await;
        throttle.admit(connection.peer.address(), Instant::now())?;
        let hash = api.controller.state().connection_password_hash.clone();
        let right = is_password(&hash, &password.0).await;
        if right {
            throttle.right(connection.peer.address());
        } else {
            throttle.wrong(connection.peer.address(), Instant::now());
        }
        right
    };
    if !right {
        tokio::time::sleep(WRONG_PASSWORD_DELAY).await;
        return Err(Problem::new(ErrorCode::WrongPassword).into());
    }
    let token = api.sessions.lock().open(Instant::now())?;
    connection.peer.has_session();
    Ok(Json(Session { token: WireSecret(token), idle_secs: SESSION_IDLE_SECS }))
}

async fn logout(caller: Caller) -> StatusCode {
    caller.connection.api.sessions.lock().close(caller.token.0.expose_secret());
    StatusCode::NO_CONTENT
}

async fn info(caller: Caller) -> Json<ControllerInfo> {
    Json(caller.controller().info(Some(caller.connection.local)))
}

async fn settings(caller: Caller) -> Json<Revisioned<ServerSettings>> {
    Json(caller.controller().settings())
}

async fn set_settings(caller: Caller, body: Body) -> Answer<Changed> {
    let SetSettings { revision, settings, delete_log, log_password } =
        read(body, Malformed::plain(ErrorCode::BadSettings)).await?;
    let edit = move |state: &mut State, around: &Surroundings| {
        changes::set_settings(state, around, settings, log_password.as_deref())
    };
    let outcome = if delete_log {
        caller.controller().change_with_new_log(revision, Effect::Restart, edit).await
    } else {
        caller.controller().change(revision, Effect::Restart, edit).await
    };
    let (changed, ()) = caller.settle(outcome).await?;
    Ok(Json(changed))
}

async fn users(caller: Caller) -> Json<Revisioned<Vec<UserName>>> {
    Json(caller.controller().users())
}

async fn add_user(caller: Caller, body: Body) -> Answer<Changed> {
    let AddUser { revision, name, password } = read(body, Malformed::secret(ErrorCode::BadCredential)).await?;
    let outcome = caller
        .controller()
        .change(revision, Effect::Restart, move |state, _| changes::add_user(state, name, password.expose()))
        .await;
    let (changed, ()) = caller.settle(outcome).await?;
    Ok(Json(changed))
}

async fn remove_users(caller: Caller, body: Body) -> Answer<Changed> {
    let RemoveUsers { revision, names } = read(body, Malformed::plain(ErrorCode::BadCredential)).await?;
    let outcome = caller
        .controller()
        .change(revision, Effect::Restart, move |state, _| changes::remove_users(state, &names))
        .await;
    let (changed, ()) = caller.settle(outcome).await?;
    Ok(Json(changed))
}

async fn start(caller: Caller) -> Answer<Changed> {
    let outcome = caller.controller().start_server().await;
    caller.settle(outcome).await.map(Json)
}

async fn stop(caller: Caller) -> Answer<Changed> {
    let outcome = caller.controller().stop_server().await;
    caller.settle(outcome).await.map(Json)
}

async fn self_signed(caller: Caller, body: Body) -> Answer<Installed> {
    let MakeSelfSigned { revision, request } = read(body, Malformed::plain(ErrorCode::BadCertificateRequest)).await?;
    let outcome = caller
        .controller()
        .change(revision, Effect::Restart, move |state, around| changes::make_self_signed(state, around, &request))
        .await;
    let (changed, certificate) = caller.settle(outcome).await?;
    Ok(Json(Installed { changed, certificate: Base64Bytes(certificate) }))
}

async fn import_certificate(caller: Caller, body: Body) -> Answer<Installed> {
    let ImportCertificate { revision, kind, pkcs12, password } =
        read(body, Malformed::secret(ErrorCode::BadCertificate)).await?;
    let outcome = caller
        .controller()
        .change(revision, Effect::Restart, move |state, around| {
            changes::import_certificate(state, around, kind, &pkcs12.0, password.expose())
        })
        .await;
    let (changed, certificate) = caller.settle(outcome).await?;
    Ok(Json(Installed { changed, certificate: Base64Bytes(certificate) }))
}

async fn certificates(caller: Caller) -> Json<Revisioned<HeldCertificates>> {
    Json(caller.controller().certificates())
}

async fn select_certificate(caller: Caller, body: Body) -> Answer<Changed> {
    let SelectCertificate { revision, kind } = read(body, Malformed::plain(ErrorCode::Refused)).await?;
    let outcome = caller
        .controller()
        .change(revision, Effect::Restart, move |state, _| certificate_changes::select_certificate(state, kind))
        .await;
    let (changed, ()) = caller.settle(outcome).await?;
    Ok(Json(changed))
}

async fn make_csr(caller: Caller, body: Body) -> Answer<CsrMade> {
    let MakeCsr { revision, request } = read(body, Malformed::plain(ErrorCode::BadCertificateRequest)).await?;
    let outcome = caller
        .controller()
        .change(revision, Effect::Nothing, move |state, around| certificate_changes::make_csr(state, around, &request))
        .await;
    let (changed, csr) = caller.settle(outcome).await?;
    Ok(Json(CsrMade { changed, csr: Base64Bytes(csr) }))
}

async fn import_csr(caller: Caller, body: Body) -> Answer<CsrMade> {
    let ImportCsr { revision, csr, pkcs12, password, certificate } =
        read(body, Malformed::secret(ErrorCode::FileFormat)).await?;
    let effect = if certificate.is_some() { Effect::Restart } else { Effect::CertificateLost };
    let outcome = caller
        .controller()
        .change(revision, effect, move |state, around| {
            let certificate = certificate.as_ref().map(|certificate| certificate.0.as_slice());
            certificate_changes::import_csr(state, around, &csr.0, &pkcs12.0, password.expose(), certificate)
        })
        .await;
    let (changed, csr) = caller.settle(outcome).await?;
    Ok(Json(CsrMade { changed, csr: Base64Bytes(csr) }))
}

async fn import_ca_signed(caller: Caller, body: Body) -> Answer<Installed> {
    let ImportCaSigned { revision, certificate } = read(body, Malformed::plain(ErrorCode::BadCertificate)).await?;
    let outcome = caller
        .controller()
        .change(revision, Effect::Restart, move |state, around| {
            certificate_changes::import_ca_signed(state, around, &certificate.0)
        })
        .await;
    let (changed, certificate) = caller.settle(outcome).await?;
    Ok(Json(Installed { changed, certificate: Base64Bytes(certificate) }))
}

async fn clients(caller: Caller, list: Result<Path<String>, PathRejection>) -> Result<Response, Failed> {
    let Path(list) = list.map_err(|_| not_found())?;
    let controller = Arc::clone(caller.controller());
    // Parses certificates.
    off_thread(move || {
        Ok(match list.as_str() {
            "trusted" => Json(controller.clients(ClientList::Trusted)?).into_response(),
            "issuers" => Json(controller.clients(ClientList::Issuers)?).into_response(),
            "rejected" => Json(controller.rejected()).into_response(),
            _ => return Err(not_found()),
        })
    })
    .await
}

async fn crls(caller: Caller) -> Json<Revisioned<Vec<ListedCrl>>> {
    Json(caller.controller().crls())
}

async fn crl(caller: Caller, id: Result<Path<String>, PathRejection>) -> Answer<Base64Bytes> {
    let Path(id) = id.map_err(|_| not_found())?;
    Ok(Json(caller.controller().crl(&id)?))
}

async fn trust_stamp(caller: Caller) -> Json<TrustStamp> {
    Json(caller.controller().trust_stamp())
}

async fn edit_trust(caller: Caller, body: Body) -> Answer<TrustChanged> {
    let change: EditTrust = read(body, Malformed::plain(ErrorCode::BadCertificate)).await?;
    let outcome = caller.controller().edit_trust(change).await;
    caller.settle(outcome).await.map(Json)
}

async fn off_thread<T: Send + 'static>(work: impl FnOnce() -> Result<T, Failed> + Send + 'static) -> Result<T, Failed> {
    tokio::task::spawn_blocking(work).await.map_err(|error| Problem::with_detail(ErrorCode::Internal, error))?
}

async fn activate(caller: Caller, body: Body) -> Answer<Changed> {
    let Activate { revision, licence, activation } = read(body, Malformed::secret(ErrorCode::BadActivationKey)).await?;
    let keys = ActivationKeys { licence, activation };
    let outcome =
        caller.controller().change(revision, Effect::Restart, move |state, _| changes::activate(state, keys)).await;
    let (changed, ()) = caller.settle(outcome).await?;
    Ok(Json(changed))
}

async fn log(caller: Caller, RawQuery(query): RawQuery) -> Answer<LogChunk> {
    let from = match query.as_deref() {
        None | Some("") => None,
        Some(query) => Some(
            query
                .strip_prefix("from=")
                .and_then(|from| from.parse().ok())
                .ok_or_else(|| Problem::with_detail(ErrorCode::Refused, "from=BYTE is all that can be asked for"))?,
        ),
    };
    Ok(Json(caller.controller().log(from).await?))
}

async fn export_settings(caller: Caller, body: Body) -> Answer<SettingsExport> {
    let ExportSettings { passphrase } = read(body, Malformed::secret(ErrorCode::Refused)).await?;
    Ok(Json(caller.controller().export(passphrase).await?))
}

async fn import_settings(caller: Caller, body: Body) -> Answer<Changed> {
    let ImportSettings { revision, export, passphrase } =
        read(body, Malformed::secret(ErrorCode::ExportDamaged)).await?;
    let outcome = caller
        .controller()
        .change(revision, Effect::Restart, move |state, around| {
            settings_transfer::import(state, around, &export, &passphrase.0)
        })
        .await;
    let (changed, ()) = caller.settle(outcome).await?;
    Ok(Json(changed))
}

async fn unknown_path() -> Failed {
    not_found()
}

async fn unknown_method() -> Failed {
    Failed {
        status: StatusCode::METHOD_NOT_ALLOWED,
        problem: Problem::with_detail(ErrorCode::Refused, "this path does not take this method"),
    }
}

fn not_found() -> Failed {
    Failed { status: StatusCode::NOT_FOUND, problem: Problem::with_detail(ErrorCode::Refused, "no such path") }
}

/// What a body that is not the message expected is answered with.
#[derive(Clone, Copy)]
struct Malformed {
    code: ErrorCode,
    /// serde quotes what it did not understand, which may be a secret in the wrong place.
    quoted: bool,
}

impl Malformed {
    const fn plain(code: ErrorCode) -> Self {
        Self { code, quoted: true }
    }

    const fn secret(code: ErrorCode) -> Self {
        Self { code, quoted: false }
    }

    fn problem(self, error: &serde_json::Error) -> Problem {
        if self.quoted {
            Problem::with_detail(self.code, error)
        } else {
            let detail = format!("not the message expected, at line {}, column {}", error.line(), error.column());
            Problem::with_detail(self.code, detail)
        }
    }
}

/// Reads a bounded body in bounded time, whatever its media type is said to be.
async fn read<T: DeserializeOwned>(body: Body, malformed: Malformed) -> Result<T, Failed> {
    let bytes = tokio::time::timeout(BODY_TIMEOUT, collect(body))
        .await
        .map_err(|_| Problem::with_detail(ErrorCode::Refused, "the request did not arrive in time"))??;
    Ok(serde_json::from_slice(&bytes).map_err(|error| malformed.problem(&error))?)
}

async fn collect(body: Body) -> Result<zeroize::Zeroizing<Vec<u8>>, Problem> {
    let announced = usize::try_from(body.size_hint().lower()).unwrap_or(usize::MAX);
    if announced > MAX_DRAINED_BYTES {
        return Err(ErrorCode::RequestTooLarge.into());
    }
    let mut body = pin!(body);
    // Never grown beyond what is announced, so that no copy of a secret is left behind.
    let capacity = if announced <= protocol::MAX_REQUEST_BYTES { announced } else { 0 };
    let mut bytes = zeroize::Zeroizing::new(Vec::with_capacity(capacity));
    let mut total = 0_usize;
    while let Some(frame) = poll_fn(|cx| body.as_mut().poll_frame(cx)).await {
        let frame = frame.map_err(|_| Problem::with_detail(ErrorCode::Refused, "the request broke off"))?;
        let data: Bytes = frame.into_data().unwrap_or_default();
        total = total.saturating_add(data.len());
        if total <= protocol::MAX_REQUEST_BYTES {
            bytes.extend_from_slice(&data);
        } else if total > MAX_DRAINED_BYTES {
            break;
        }
    }
    if total > protocol::MAX_REQUEST_BYTES { Err(ErrorCode::RequestTooLarge.into()) } else { Ok(bytes) }
}
