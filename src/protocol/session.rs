//! Sessions: the first contact, logging in and out.

use serde::{Deserialize, Serialize};

use super::request::requests;
use super::response::{MAX_TEXT, check_count, shorten};
use super::{Response, WireSecret};

requests! {
    /// Sessions.
    SESSION_REQUESTS
    GET "/v1/hello" GetHello { none } nothing -> Hello, "";
    POST "/v1/login" Login { json } nothing -> SessionStarted, "";
    POST "/v1/logout" Logout { none } session -> (), "";
}

/// Asks which protocol versions the controller speaks.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetHello;

/// The answer to [`GetHello`].
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hello {
    /// Always [`super::PRODUCT`].
    pub product: String,
    /// The protocol versions the controller speaks.
    pub versions: Vec<u32>,
}

impl Response for Hello {
    fn check(&mut self) -> Result<(), &'static str> {
        shorten(&mut self.product);
        check_count(&self.versions)
    }
}

/// Begins a session.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Login {
    /// The connection password; may be empty.
    pub password: WireSecret,
}

/// A session has begun.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SessionStarted {
    /// To be sent as `Authorization: Bearer`. Printable ASCII, at most 4096 bytes.
    pub token: WireSecret,
    /// The session ends after this time without a request, in seconds.
    pub idle_secs: u64,
}

impl Response for SessionStarted {
    fn check(&mut self) -> Result<(), &'static str> {
        let token = self.token.expose();
        if token.len() > MAX_TEXT || !token.bytes().all(|byte| byte.is_ascii_graphic()) {
            return Err("its session token fits into no header");
        }
        Ok(())
    }
}

/// Ends the session that it is sent with.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct Logout;
