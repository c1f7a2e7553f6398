//! The controller-management protocol, version 1: what the configurator and a controller say to each other.
//!
//! This page is meant to be enough to implement either end.
//!
//! # Transport
//! HTTPS, HTTP/1.1 over TLS 1.2 or 1.3. The controller presents a self-signed certificate that is its *management
//! identity*; it is unrelated to the certificate of its OPC UA server and survives every change described here. The
//! client does not look at names or dates in it: it pins the SHA-256 of its DER, the *fingerprint*, which a person
//! compared once with the one the controller shows. A client sends nothing, not even a password, to a controller
//! whose fingerprint differs.
//!
//! A request has exactly one `Host` header, and at most one of `Content-Length` and `Transfer-Encoding: chunked`; any other
//! is refused with 400, and the connection ends. A controller may end the connection after a body in chunks. The head of
//! a request is at most 16 KiB long, its path 2 KiB.
//!
//! Bodies are JSON in UTF-8. A request body is at most [`MAX_REQUEST_BYTES`] long, a response body at most
//! [`MAX_RESPONSE_BYTES`]; longer ones are refused with `413` and [`ErrorCode::RequestTooLarge`], or dropped by the
//! client. Binary data is base64 with padding. Times are RFC 3339 in UTC. Unknown members of a request are refused,
//! unknown members of a response are ignored.
//!
//! # Session
//! [`HELLO`] needs no session and says which versions the controller speaks. [`LOGIN`] takes the connection password
//! and gives a token, which every further request carries as `Authorization: Bearer <token>`. A token is valid until
//! [`LOGOUT`], for [`SESSION_IDLE_SECS`] without a request, or until the controller restarts. A wrong password is
//! answered after a delay; after [`LOGIN_ATTEMPTS`] of them from one network address, further logins from there are
//! refused for [`LOCK_OUT_SECS`] with `429` and [`ErrorCode::LockedOut`], right password or not.
//!
//! # Requests
//! | method and path | request | response |
//! |---|---|---|
//! | `GET` [`HELLO`] | – | [`Hello`] |
//! | `POST` [`LOGIN`] | [`Login`] | [`Session`] |
//! | `POST` [`LOGOUT`] | – | – |
//! | `GET` [`INFO`] | – | [`ControllerInfo`](crate::model::ControllerInfo) |
//! | `GET` [`SETTINGS`] | – | [`Revisioned`]`<`[`ServerSettings`](crate::model::ServerSettings)`>` |
//! | `PUT` [`SETTINGS`] | [`SetSettings`] | [`Changed`] |
//! | `GET` [`USERS`] | – | [`Revisioned`]`<Vec<`[`UserName`](crate::model::UserName)`>>` |
//! | `POST` [`USERS`] | [`AddUser`] | [`Changed`] |
//! | `POST` [`USERS_REMOVE`] | [`RemoveUsers`] | [`Changed`] |
//! | `POST` [`SERVER_START`] | – | [`Changed`] |
//! | `POST` [`SERVER_STOP`] | – | [`Changed`] |
//! | `POST` [`SELF_SIGNED`] | [`MakeSelfSigned`] | [`Installed`], current firmware |
//! | `POST` [`CERTIFICATE_IMPORT`] | [`ImportCertificate`] | [`Installed`], legacy firmware |
//! | `GET` [`CERTIFICATES`] | – | [`Revisioned`]`<`[`HeldCertificates`]`>` |
//! | `POST` [`CERTIFICATE_SELECT`] | [`SelectCertificate`] | [`Changed`] |
//! | `POST` [`CSR`] | [`MakeCsr`] | [`CsrMade`], current firmware |
//! | `POST` [`CSR_IMPORT`] | [`ImportCsr`] | [`CsrMade`], legacy firmware |
//! | `POST` [`CA_SIGNED`] | [`ImportCaSigned`] | [`Installed`] |
//! | `GET` [`CLIENTS`]`/trusted` | – | [`Revisioned`]`<Vec<`[`ListedCertificate`]`>>` |
//! | `GET` [`CLIENTS`]`/issuers` | – | [`Revisioned`]`<Vec<`[`ListedCertificate`]`>>`, current firmware |
//! | `GET` [`CLIENTS`]`/rejected` | – | [`Revisioned`]`<Vec<`[`RejectedClient`]`>>`, seen last first |
//! | `GET` [`CRLS`] | – | [`Revisioned`]`<Vec<`[`ListedCrl`]`>>` |
//! | `GET` [`CRLS`]`/` and a [`CrlSummary::id`](crate::model::CrlSummary::id) | – | [`Base64Bytes`]: the DER |
//! | `GET` [`TRUST`] | – | [`TrustStamp`] |
//! | `POST` [`TRUST`] | [`EditTrust`] | [`TrustChanged`] |
//! | `POST` [`SETTINGS_EXPORT`] | [`ExportSettings`] | [`SettingsExport`], legacy firmware |
//! | `POST` [`SETTINGS_IMPORT`] | [`ImportSettings`] | [`Changed`], legacy firmware |
//! | `GET` [`LOG`], with `?from=` a byte | – | [`LogChunk`] |
//! | `POST` [`ACTIVATION`] | [`Activate`] | [`Changed`], legacy firmware |
//!
//! # Changes
//! Every change names the revision of the configuration it was based on. If the controller's is another, it answers
//! `409` with [`ErrorCode::ChangedMeanwhile`] and does nothing. A change is applied whole or not at all: the
//! controller checks it, stages it, stops its OPC UA server if that runs, swaps, starts the server again if it was
//! running, and answers only then. If any of it fails, configuration and server are left as they were before.
//! Starting and stopping the server does not change the revision. While a task runs or a teach pendant is connected,
//! changes, start and stop are refused and everything else is answered.
//!
//! A change whose answer was lost may have been applied; the client finds out by reading the revision again.
//!
//! # Trust
//! The certificates in the trusted list and the issuers list, and the CRLs, are part of the configuration: changing them
//! ([`EditTrust`]) is a change as any other, but the OPC UA server is not stopped for it. It takes effect at once, for
//! new connections as for open ones: those that would not be let in any more are ended, and the answer names them.
//!
//! The rejected list is filled by the controller with certificates that were refused. It is bounded and no part of the
//! configuration: what only removes from it does not change the revision. [`TrustStamp`] tells cheaply whether it, or
//! anything else of this, is another than before. A certificate that is put into another list leaves it.
//!
//! Limits of the lists are in [`ControllerInfo`](crate::model::ControllerInfo). Legacy firmware has no issuers list;
//! whatever names it is refused with [`ErrorCode::FirmwareTooOld`].
//!
//! # Failures
//! Every failure has a status of 400 or above and a [`Failure`] as its body. [`status_of`] says which status goes
//! with which code; a client decides by the code alone. A body that is not the message expected is refused with the
//! code for wrong values of its kind ([`ErrorCode::BadSettings`], [`ErrorCode::BadCredential`], …), what fits no other
//! code with [`ErrorCode::Refused`].
//!
//! | status | when |
//! |---|---|
//! | 400 | the request is malformed, or breaks a rule of the manual |
//! | 401 | no session, session over, wrong password |
//! | 404, 405 | no such path; not this method |
//! | 409 | changed meanwhile; or the controller's state forbids it: task running, teach pendant connected |
//! | 413, 414, 431 | body, path or headers too large |
//! | 429 | locked out |
//! | 500 | the controller failed |
//! | 505 | another version of HTTP than 1.1 |
//! | 507 | the controller's storage is full |

mod activation;
mod base64_bytes;
mod certificates;
mod log;
mod messages;
mod settings_export;
mod tls_time;
mod trust;

pub use activation::Activate;
pub use certificates::{
    CsrMade, HeldCertificate, HeldCertificates, ImportCaSigned, ImportCsr, MakeCsr, SelectCertificate,
};
pub use log::{LogChunk, MAX_LOG_CHUNK_BYTES};
pub use messages::{
    AddUser, Changed, Failure, Hello, ImportCertificate, Installed, Login, MakeSelfSigned, RemoveUsers, Revisioned,
    Session, SetSettings, WireSecret,
};

pub use settings_export::{
    EXPORT_FORMAT, EXPORT_VERSION, ExportContent, ExportError, ExportSettings, ExportedUser, ImportSettings,
    MAX_EXPORT_BYTES, SettingsExport,
};
pub use tls_time::TlsTime;
pub use trust::{
    CutClient, EditTrust, ListedCertificate, ListedCrl, MAX_SENT_CRL_BYTES, MAX_TRUST_STEPS, RejectedClient,
    TrustChanged, TrustStamp, TrustStep,
};

use crate::model::{ClientList, ErrorCode};

pub use base64_bytes::Base64Bytes;

/// The version this crate speaks. Versions differ in the first part of the path.
pub const VERSION: u32 = 1;

pub const HELLO: &str = "/v1/hello";
pub const LOGIN: &str = "/v1/login";
pub const LOGOUT: &str = "/v1/logout";
pub const INFO: &str = "/v1/info";
pub const SETTINGS: &str = "/v1/settings";
pub const USERS: &str = "/v1/users";
pub const USERS_REMOVE: &str = "/v1/users/remove";
pub const SERVER_START: &str = "/v1/server/start";
pub const SERVER_STOP: &str = "/v1/server/stop";
pub const SELF_SIGNED: &str = "/v1/certificates/self-signed";
pub const CERTIFICATE_IMPORT: &str = "/v1/certificates/import";
pub const CERTIFICATES: &str = "/v1/certificates";
pub const CERTIFICATE_SELECT: &str = "/v1/certificates/select";
pub const CSR: &str = "/v1/certificates/csr";
pub const CSR_IMPORT: &str = "/v1/certificates/csr/import";
pub const CA_SIGNED: &str = "/v1/certificates/ca-signed";
pub const CLIENTS: &str = "/v1/clients";
pub const CRLS: &str = "/v1/crls";
pub const TRUST: &str = "/v1/trust";
pub const ACTIVATION: &str = "/v1/activation";
pub const LOG: &str = "/v1/log";
pub const SETTINGS_EXPORT: &str = "/v1/settings/export";
pub const SETTINGS_IMPORT: &str = "/v1/settings/import";

/// What [`Hello::product`] says, so that another HTTPS server is not taken for a controller.
pub const PRODUCT: &str = "opcua-controller-management";

pub const MAX_REQUEST_BYTES: usize = 1024 * 1024;
pub const MAX_RESPONSE_BYTES: usize = 4 * 1024 * 1024;
pub const SESSION_IDLE_SECS: u64 = 300;
pub const LOGIN_ATTEMPTS: u32 = 5;
pub const LOCK_OUT_SECS: u64 = 60;

/// Where a list of client certificates lives.
pub fn clients_path(list: ClientList) -> String {
    format!("{CLIENTS}/{}", list.as_str())
}

/// Where the DER of one CRL is.
pub fn crl_path(id: &str) -> String {
    format!("{CRLS}/{id}")
}

/// The HTTP status that carries an error code.
pub const fn status_of(code: ErrorCode) -> u16 {
    match code {
        ErrorCode::WrongPassword | ErrorCode::SessionExpired => 401,
        ErrorCode::ChangedMeanwhile | ErrorCode::TaskRunning | ErrorCode::TeachPendantConnected => 409,
        ErrorCode::RequestTooLarge => 413,
        ErrorCode::LockedOut => 429,
        ErrorCode::ServerError | ErrorCode::Internal => 500,
        ErrorCode::DiskFull => 507,
        _ => 400,
    }
}
