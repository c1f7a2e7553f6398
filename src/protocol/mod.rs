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
//! [`GetHello`] needs no session and says which versions the controller speaks. [`Login`] takes the connection password
//! and gives a token, which every further request carries as `Authorization: Bearer <token>`. A token is valid until
//! [`Logout`], for [`SESSION_IDLE_SECS`] without a request, or until the controller restarts. A wrong password is
//! answered after a delay; after [`LOGIN_ATTEMPTS`] of them from one network address, further logins from there are
//! refused for [`LOCK_OUT_SECS`] with `429` and [`ErrorCode::LockedOut`], right password or not.
//!
//! # Requests
//! Each request is a type that implements [`Request`]: method, path, body and response stand together. The tables, made from
//! those types: [`SESSION_REQUESTS`], [`SERVER_REQUESTS`], [`SETTINGS_REQUESTS`], [`USER_REQUESTS`],
//! [`CERTIFICATE_REQUESTS`] and [`TRUST_REQUESTS`]. [`REQUESTS`] is all of them.
//!
//! The response `()` has no content and status 204.
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
//! configuration: what only removes from it does not change the revision. [`TrustStamp`](crate::model::TrustStamp) tells cheaply whether it, or
//! anything else of this, is another than before. A certificate that is put into another list leaves it.
//!
//! Limits of the lists are in [`ControllerInfo`](crate::model::ControllerInfo). Legacy firmware has no issuers list;
//! a request that names it is refused with [`ErrorCode::FirmwareTooOld`].
//!
//! # Failures
//! Every failure has a status of 400 or above and a [`FailureBody`] as its body. [`status_of`] says which status goes
//! with which code; a client decides by the code alone. A body that is not the message expected is refused with the
//! code for wrong values of its kind ([`ErrorCode::BadSettings`], [`ErrorCode::BadCredential`], …), or with
//! [`ErrorCode::Refused`] where no other code fits.
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

mod certificates;
mod messages;
mod request;
mod response;
mod server;
mod session;
mod settings;
mod settings_export;
mod tls_time;
mod trust;
mod users;

pub use certificates::*;
pub use messages::{FailureBody, WireSecret};
pub use request::{Method, Request, RequestNeeds, RequestRow};
pub use response::{MAX_LISTED, Response};
pub use server::*;
pub use session::*;
pub use settings::*;
pub use settings_export::{
    EXPORT_FORMAT, EXPORT_VERSION, ExportContent, ExportError, ExportedUser, MAX_EXPORT_BYTES, SettingsExport,
};
pub use tls_time::TlsTime;
pub use trust::*;
pub use users::*;

use crate::model::ErrorCode;

/// All requests, by topic.
pub const REQUESTS: [&[RequestRow]; 6] =
    [SESSION_REQUESTS, SERVER_REQUESTS, SETTINGS_REQUESTS, USER_REQUESTS, CERTIFICATE_REQUESTS, TRUST_REQUESTS];

/// The version this crate speaks. Versions differ in the first part of the path.
pub const VERSION: u32 = 1;

/// What [`Hello::product`] says, so that another HTTPS server is not taken for a controller.
pub const PRODUCT: &str = "opcua-controller-management";

/// The largest body of a request, in bytes.
pub const MAX_REQUEST_BYTES: usize = 1024 * 1024;
/// The largest body of a response, in bytes.
pub const MAX_RESPONSE_BYTES: usize = 4 * 1024 * 1024;
/// A session ends after this time without a request, in seconds.
pub const SESSION_IDLE_SECS: u64 = 300;
/// Wrong passwords from one network address until it is locked out.
pub const LOGIN_ATTEMPTS: u32 = 5;
/// How long a network address is locked out, in seconds.
pub const LOCK_OUT_SECS: u64 = 60;

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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::model::RevisionToken;

    #[test]
    fn every_row_of_the_tables_is_a_request_of_its_own() {
        let mut seen = BTreeSet::new();
        for row in REQUESTS.into_iter().flatten() {
            assert!(seen.insert((row.method, row.path)), "{row:?} is there twice");
            assert!(row.path.starts_with(&format!("/v{VERSION}/")), "{row:?}");
            assert!(row.method != Method::Get || !row.has_body, "{row:?} is a GET with a body");
            assert!(row.needs != RequestNeeds::Revision || row.has_body, "{row:?} has no place for its revision");
        }
    }

    #[test]
    fn a_request_says_where_it_goes_and_what_it_is_based_on() {
        assert_eq!(GetCrl { id: "AB12".to_owned() }.target(), "/v1/crls/AB12");
        assert_eq!(GetLog { from: None }.target(), "/v1/log");
        assert_eq!(GetLog { from: Some(7) }.target(), "/v1/log?from=7");
        assert_eq!(GetTrusted.target(), GetTrusted::PATH);
        let remove = RemoveUsers { revision: RevisionToken::new(12), names: Vec::new() };
        assert_eq!((remove.revision(), StartServer.revision()), (Some(RevisionToken::new(12)), None));
    }
}
