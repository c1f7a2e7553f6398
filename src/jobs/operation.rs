use std::path::PathBuf;

use async_trait::async_trait;
use secrecy::SecretString;
use tokio_util::sync::CancellationToken;

use super::{JobController, TrustChange, TrustSnapshot};
use crate::model::{CertificateSummary, ErrorCode, Problem, ServerSettings, ServerStatus, UserName};
use crate::pki::{Finding, Issuers};
use crate::protocol::{HeldCertificates, LogChunk, Revisioned};
use crate::session::ControllerSession;
use crate::workspace::{SavedCertificate, SavedCsr};

/// What is done to one controller.
#[async_trait]
pub trait Operation: Send + Sync {
    /// What must be said and agreed to first; `None` when nothing is changed.
    fn confirmation(&self) -> Option<Confirmation>;

    /// Everything that can be found wrong without talking to the controller.
    fn check(&self, _controller: &JobController) -> Result<(), Problem> {
        Ok(())
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Outcome, Problem>;

    /// The status in which it leaves the server, for an operation that changes nothing else. Default: none.
    fn wanted_status(&self) -> Option<ServerStatus> {
        None
    }

    /// The information the runner reads afterwards is all that is wanted. Default: it is not.
    fn is_information(&self) -> bool {
        false
    }
}

/// What an operation does that a person must agree to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Confirmation {
    /// The OPC UA server is stopped for the change, and started again if it was running.
    pub stops_server: bool,
    /// The server certificate of the same type in the controller is replaced.
    pub replaces_certificate: bool,
    /// Backup files of the same name on the PC are replaced.
    pub overwrites_backup: bool,
    /// On legacy firmware, the CA-signed certificate in the controller becomes invalid at once, and a server that uses
    /// it stops.
    pub invalidates_ca_signed: bool,
    /// Files of the same name on the PC are replaced.
    pub overwrites_files: bool,
    /// The server log in the controller is deleted.
    pub deletes_log: bool,
    /// Settings and users in the controller are replaced by those of a file.
    pub replaces_settings: bool,
    /// Clients that are connected and not trusted any more are disconnected. The server is not stopped.
    pub disconnects_clients: bool,
}

/// The step a controller is at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Step {
    Connect,
    Read,
    MakeKey,
    Apply,
    SaveBackup,
}

/// What came of an operation.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// Done; the row's information says the rest.
    Done,
    Settings(Revisioned<ServerSettings>),
    Users(Revisioned<Vec<UserName>>),
    /// Client lists and CRLs of a controller.
    TrustLists(Box<TrustSnapshot>),
    /// Client lists or CRLs were changed.
    TrustChanged(Box<TrustChange>),
    /// [`LogChunk::text`] is what was asked for, however many requests that took.
    Log(LogChunk),
    /// The settings of the controller are in this file.
    SettingsExported {
        path: PathBuf,
    },
    Certificate {
        summary: CertificateSummary,
        saved: Option<SavedCertificate>,
    },
    /// A signing request was made and saved.
    Csr {
        common_name: String,
        saved: SavedCsr,
    },
    /// A server certificate from elsewhere was installed and selected; what clients may complain about was accepted.
    Imported {
        summary: CertificateSummary,
        findings: Vec<Finding>,
    },
    /// A server certificate from elsewhere was looked at.
    Checked {
        summary: CertificateSummary,
        findings: Vec<Finding>,
        /// Of a certificate from a CA.
        issuers: Option<Issuers>,
    },
    Certificates(Revisioned<HeldCertificates>),
    /// A server certificate was saved on the PC.
    Exported {
        summary: CertificateSummary,
        file: PathBuf,
    },
}

/// One controller's turn: the open session, and a way to say where it is.
pub struct Run<'a> {
    pub controller: &'a JobController,
    pub session: &'a mut dyn ControllerSession,
    /// The connection password, for protecting what is saved for this controller.
    pub password: &'a SecretString,
    pub(super) key_makers: &'a tokio::sync::Semaphore,
    pub(super) cancel: &'a CancellationToken,
    pub(super) on_step: &'a (dyn Fn(Step) + Send + Sync),
}

impl std::fmt::Debug for Run<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Run").field("controller", &self.controller.name).finish_non_exhaustive()
    }
}

impl Run<'_> {
    /// Reports the next step. After a cancel there is none: the step in hand was the last.
    pub fn begin(&self, step: Step) -> Result<(), Problem> {
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
