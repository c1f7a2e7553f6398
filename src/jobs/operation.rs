use std::path::{Path, PathBuf};

use async_trait::async_trait;
use secrecy::SecretString;
use tokio_util::sync::CancellationToken;

use super::JobController;
use crate::model::{ErrorCode, Feature, Problem, Revisioned, ServerStatus};
use crate::session::ControllerSession;

/// What is done to one controller.
#[async_trait]
pub trait Operation: std::fmt::Debug + Send + Sync {
    /// What [`Operation::run`] returns when it succeeds.
    type Output: OperationOutput;

    /// What must be said and agreed to first; `None` when nothing is changed.
    fn confirmation(&self) -> Option<Confirmation>;

    /// Everything that can be found wrong without talking to the controller.
    fn check(&self, _controller: &JobController) -> Result<(), Problem> {
        Ok(())
    }

    /// Does it, once everything was agreed to.
    async fn run(&self, run: &mut OperationRun<'_>) -> Result<Self::Output, Problem>;

    /// The status in which it leaves the server, and its result then, for an operation that changes nothing else. When
    /// the answer was lost and the server has this status, the operation succeeded. Default: none.
    fn wanted_status(&self) -> Option<(ServerStatus, Self::Output)> {
        None
    }

    /// Whether the program has to stay until the step in hand has ended, because a controller or a file on the PC would
    /// be left half changed, or a file that was asked for would be missing. Default: true for an operation that asks for a confirmation or
    /// changes the server's status.
    fn must_be_finished(&self) -> bool {
        self.confirmation().is_some() || self.wanted_status().is_some()
    }

    /// The information the runner reads afterwards is all that is wanted. Default: it is not.
    fn is_information(&self) -> bool {
        false
    }
}

/// What an operation does to a running OPC UA server.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ServerEffect {
    /// It goes on running.
    #[default]
    GoesOn,
    /// It is stopped for the change, which ends all connections, and started again.
    Restarts,
    /// It is stopped, which ends all connections, and stays so.
    Stops,
}

/// What an operation does that a person must agree to. What only some controllers are subject to is said as well.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Confirmation {
    /// What happens to a running server.
    pub server: ServerEffect,
    /// The server certificate of the same type in the controller is replaced, and the server uses the new one.
    pub replaces_certificate: bool,
    /// The server uses another of the certificates in the controller.
    pub changes_certificate: bool,
    /// On legacy firmware, the CA-signed certificate in the controller becomes invalid at once. A server that uses it
    /// stops, which ends all connections, and cannot be started until another certificate is imported or selected.
    pub invalidates_ca_signed: bool,
    /// The signing request in the controller and its key are replaced by those of a backup. If the backup holds no
    /// certificate for them, the same follows as of [`Confirmation::invalidates_ca_signed`].
    pub replaces_request: bool,
    /// Clients reach the server by other ports, security policies or user tokens than before.
    pub changes_endpoints: bool,
    /// The server log is switched on: the server stops by itself once the log is full.
    pub starts_log: bool,
    /// The server log in the controller is deleted.
    pub deletes_log: bool,
    /// Settings, users and activation keys in the controller are replaced by those of a file.
    pub replaces_settings: bool,
    /// Files on the PC that belong to a former certificate or request are moved into a folder named after their date.
    pub moves_files_aside: bool,
    /// A former settings export on the PC is replaced.
    pub overwrites_export: bool,
    /// Clients that are connected and not trusted any more are disconnected. The server is not stopped.
    pub disconnects_clients: bool,
}

/// The step a controller is at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JobStep {
    /// Opens the session.
    Connect,
    /// Reads from the controller.
    Read,
    /// Connecting as an OPC UA client.
    Verify,
    /// Makes a key, which may take a minute on a slow PC.
    MakeKey,
    /// Signs a certificate with the key of the small CA.
    Sign,
    /// Sends the change.
    Apply,
    /// Saves a backup on the PC.
    SaveBackup,
}

/// What an operation returns when it succeeds.
///
/// Window and command line treat some facts about a result in the same way for every operation; each result
/// states them.
pub trait OperationOutput: std::fmt::Debug + Send + 'static {
    /// The facts that this result has in common with others.
    fn facts(&self) -> OutputFacts<'_>;
}

/// Facts about the result of an operation that do not depend on its type.
#[derive(Debug, Clone, PartialEq)]
pub struct OutputFacts<'a> {
    /// The file on the PC that was written.
    pub written: Option<&'a Path>,
    /// The file on the PC whose content is in the controller now.
    pub used: Option<&'a Path>,
    /// Files on the PC that were moved to make room: where they are now.
    pub moved_aside: &'a [PathBuf],
    /// The operation did its work, and what it found is not good. The command line ends with exit code 1 then.
    pub shortcoming: Option<Problem>,
}

impl OutputFacts<'_> {
    /// No file, nothing moved, nothing found.
    pub const NONE: Self = Self { written: None, used: None, moved_aside: &[], shortcoming: None };
}

/// The result of an operation that returns nothing: the information the runner reads afterwards says the rest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct NoOutput;

impl OperationOutput for NoOutput {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts::NONE
    }
}

/// What was read from a controller.
impl<T: std::fmt::Debug + Send + 'static> OperationOutput for Revisioned<T> {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts::NONE
    }
}

/// One controller's turn: the open session, and a way to say where it is.
pub struct OperationRun<'a> {
    /// The controller this run is about.
    pub controller: &'a JobController,
    /// The open session with it.
    pub session: &'a mut dyn ControllerSession,
    /// The password among the controller's credentials: protects the files that are saved for it.
    pub password: &'a SecretString,
    pub(super) key_makers: &'a tokio::sync::Semaphore,
    pub(super) cancel: &'a CancellationToken,
    pub(super) on_step: &'a (dyn Fn(JobStep) + Send + Sync),
}

impl std::fmt::Debug for OperationRun<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("OperationRun").field("controller", &self.controller.name).finish_non_exhaustive()
    }
}

impl OperationRun<'_> {
    /// An error if the controller does not offer this ([`Capabilities::require`](crate::model::Capabilities::require)).
    pub async fn require(&mut self, feature: Feature) -> Result<(), Problem> {
        self.session.capabilities().await?.require(feature)
    }

    /// Reports the next step. After a cancel there is none: the step in hand was the last.
    pub fn begin(&self, step: JobStep) -> Result<(), Problem> {
        if self.cancel.is_cancelled() {
            return Err(ErrorCode::Cancelled.into());
        }
        (self.on_step)(step);
        Ok(())
    }

    /// Runs work that waits for the disk or is slow for another reason: off the async threads.
    pub async fn off_thread<R: Send + 'static>(
        &self,
        work: impl FnOnce() -> Result<R, Problem> + Send + 'static,
    ) -> Result<R, Problem> {
        tokio::task::spawn_blocking(work).await.map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?
    }

    /// Runs work that keeps a core busy for a while, on as many cores as there are and no more.
    pub async fn on_a_core<R: Send + 'static>(&self, work: impl FnOnce() -> R + Send + 'static) -> Result<R, Problem> {
        let internal = |e: &dyn std::fmt::Display| Problem::with_detail(ErrorCode::Internal, e);
        let _core = self.key_makers.acquire().await.map_err(|e| internal(&e))?;
        if self.cancel.is_cancelled() {
            return Err(ErrorCode::Cancelled.into());
        }
        tokio::task::spawn_blocking(work).await.map_err(|e| internal(&e))
    }
}
