//! The state of a controller, its OPC UA server and the server's log.

use serde::{Deserialize, Serialize};

use super::Response;
use super::request::requests;
use super::response::{MAX_LISTED, check_time, shorten};
use crate::model::{Changed, ControllerInfo, ErrorCode, LogChunk};

requests! {
    /// The controller's state and its OPC UA server.
    SERVER_REQUESTS
    GET "/v1/info" GetInfo { none } session -> ControllerInfo, "";
    POST "/v1/server/start" StartServer { none } session -> Changed, "";
    POST "/v1/server/stop" StopServer { none } session -> Changed, "";
    GET "/v1/log" GetLog { none } session -> LogChunk, "query `from=` and an offset in bytes; without it, the end of the log", at GetLog::target_with_parameters;
}

/// Reads the state of the controller.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetInfo;

/// Starts the OPC UA server. Does nothing if it runs.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct StartServer;

/// Stops the OPC UA server, which ends all its connections. Does nothing if it does not run.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct StopServer;

/// Reads a piece of the server log, at most [`LogChunk::MAX_BYTES`] of it, in whole lines where that is possible.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct GetLog {
    /// The offset in the log, in bytes, at which the piece begins. `None`: the last piece.
    pub from: Option<u64>,
}

impl GetLog {
    fn target_with_parameters(&self) -> String {
        match self.from {
            None => <Self as super::Request>::PATH.to_owned(),
            Some(from) => format!("{}?from={from}", <Self as super::Request>::PATH),
        }
    }
}

impl Response for ControllerInfo {
    fn check(&mut self) -> Result<(), &'static str> {
        if !self.is_small() {
            return Err("its information is too large");
        }
        for text in [&mut self.name, &mut self.application_name, &mut self.endpoint] {
            shorten(text);
        }
        if let Some(certificate) = &mut self.certificate {
            certificate.summary.check()?;
        }
        // What only the PC can find out is not the state of a controller.
        if self.error.is_some_and(|code| !code.is_a_controllers()) {
            self.error = Some(ErrorCode::ServerError);
        }
        let limits = [&mut self.limits.trusted, &mut self.limits.issuers, &mut self.limits.crls];
        limits.into_iter().for_each(|limit| *limit = (*limit).min(MAX_LISTED));
        check_time(self.clock)
    }
}

impl Response for LogChunk {
    /// The text stays as it is: it has lines, and `--json` writes it with escapes. What shows it as text uses
    /// [`untrusted_text::lines`](crate::model::untrusted_text::lines).
    fn check(&mut self) -> Result<(), &'static str> {
        // Bytes that are not UTF-8 arrive as characters of three bytes.
        if self.text.len() > 3 * Self::MAX_BYTES {
            return Err("a piece of its log is too large");
        }
        if self.next < self.from {
            return Err("a piece of its log ends before it begins");
        }
        Ok(())
    }
}
