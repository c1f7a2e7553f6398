//! What the window asks the backend for, and what the backend reports.

use std::path::PathBuf;

use chrono::{DateTime, Utc};
use secrecy::SecretString;

use super::{DroppedFile, JobId, Task, TaskEvent};
use crate::jobs::{Enrolled, JobController, JobSummary, LiveEvent, LiveLogin, LiveRequest, TrustFile, WatchEvent};
use crate::model::{Address, ConnectionKind, ControllerInfo, Credentials, FirmwareVersion, Problem};
use crate::pki::{Csr, Fingerprint, IssueRequest, RevocationReason};
use crate::ui::picker::FileKind;
use crate::workspace::authority::{AuthorityOverview, NewAuthority};
use crate::workspace::{Configuration, ControllerEntry, PasswordPlace, StoreStatus};

/// Work to be done.
#[derive(Debug, Clone)]
pub enum BackendCommand {
    /// Ends with [`BackendEvent::JobEnded`].
    Run {
        job: JobId,
        controllers: Vec<JobController>,
        task: Task,
        parallelism: usize,
        /// To be remembered for all these controllers first.
        password: Option<SecretString>,
    },
    Probe {
        job: JobId,
        connection: ConnectionKind,
        address: Address,
    },
    Enroll {
        job: JobId,
        connection: ConnectionKind,
        address: Address,
        fingerprint: Fingerprint,
        credentials: Credentials,
    },
    /// Reads what the settings export of a controller on the PC says of itself.
    LookAtExport {
        job: JobId,
        of: Box<ControllerInfo>,
        /// Instead of the one in the workspace.
        file: Option<PathBuf>,
    },
    /// Ends with [`BackendEvent::AuthorityDone`]. Cannot be cancelled.
    Authority {
        job: JobId,
        work: AuthorityWork,
    },
    /// Stops a job after the step in hand.
    Cancel(JobId),
    /// Creating, opening and changing the passphrase end with [`BackendEvent::VaultDone`].
    Vault(VaultWork),
    /// Forgets the passwords of deleted controllers.
    Forget(Vec<Fingerprint>),
    /// Lets a person choose a file; ends with [`BackendEvent::FilePicked`].
    PickFile {
        job: JobId,
        kind: FileKind,
        title: String,
    },
    /// Lets a person choose where a file is saved; ends with [`BackendEvent::FilePicked`].
    PickTarget {
        job: JobId,
        kind: FileKind,
        title: String,
        /// The path to begin with.
        begin: PathBuf,
    },
    /// Ends with [`BackendEvent::FileRead`]. A file of more than `most` bytes is refused.
    ReadFile {
        job: JobId,
        path: PathBuf,
        most: usize,
    },
    /// Lets a person choose files; ends with [`BackendEvent::FilesPicked`].
    PickFiles {
        job: JobId,
        kind: FileKind,
        title: String,
    },
    /// Reads files with certificates and CRLs; ends with [`BackendEvent::TrustFilesRead`].
    ReadTrustFiles {
        job: JobId,
        paths: Vec<PathBuf>,
    },
    /// Reports the lists of a controller with [`BackendEvent::TrustSeen`] until it is cancelled.
    WatchTrust {
        job: JobId,
        controller: Box<JobController>,
    },
    /// Reports what the OPC UA server of a controller shows with [`BackendEvent::LiveSeen`] until it is cancelled.
    WatchValues {
        job: JobId,
        controller: Box<JobController>,
        login: Box<LiveLogin>,
    },
    /// Asks a running [`BackendCommand::WatchValues`] for something. One that has ended does not answer.
    AskValues {
        job: JobId,
        request: LiveRequest,
    },
    /// Finds out what files are, by their content; ends with [`BackendEvent::Recognised`].
    Recognise {
        job: JobId,
        paths: Vec<PathBuf>,
    },
    /// Shows a folder in the desktop's file manager.
    OpenFolder(PathBuf),
    StartVirtualControllers,
    Save(Box<Configuration>),
    /// Brings the window to the front.
    ShowWindow,
    Quit,
}

/// What the backend reports.
#[derive(Debug)]
pub enum BackendEvent {
    Job {
        job: JobId,
        event: TaskEvent,
    },
    JobEnded {
        job: JobId,
        summary: JobSummary,
    },
    Probed {
        job: JobId,
        result: Result<Fingerprint, Problem>,
    },
    Enrolled {
        job: JobId,
        result: Result<Box<Enrolled>, Problem>,
    },
    /// `None`: nothing was chosen.
    FilePicked {
        job: JobId,
        result: Result<Option<PathBuf>, Problem>,
    },
    FileRead {
        job: JobId,
        result: Result<(PathBuf, FileContents), Problem>,
    },
    /// In the order they were asked for.
    Recognised {
        job: JobId,
        files: Vec<DroppedFile>,
    },
    ExportSeen {
        job: JobId,
        result: Result<ExportFound, Problem>,
    },
    /// Empty: nothing was chosen.
    FilesPicked {
        job: JobId,
        result: Result<Vec<PathBuf>, Problem>,
    },
    /// In the order they were asked for.
    TrustFilesRead {
        job: JobId,
        files: Vec<ReadTrustFile>,
    },
    TrustSeen {
        job: JobId,
        event: WatchEvent,
    },
    LiveSeen {
        job: JobId,
        event: LiveEvent,
    },
    AuthorityDone {
        job: JobId,
        result: Result<AuthorityResult, Problem>,
    },
    VirtualStarted(Result<Vec<ControllerEntry>, Problem>),
    VaultDone(Result<(), Problem>),
    /// What the store of passwords is like has changed.
    PasswordStore(StoreStatus),
    /// A password works, but only until the program ends.
    PasswordNotKept(Problem),
    SaveFailed(Problem),
    FolderNotOpened(Problem),
    /// The program was started again on the same workspace.
    StartedAgain,
    /// The system asks the program to end: log-off, shutdown, Ctrl-C in the terminal it was started from.
    StopRequested,
}

/// What is in a file. There may be keys in it, so `Debug` tells its length only.
#[derive(Clone, PartialEq, Eq)]
pub struct FileContents(pub Vec<u8>);

impl std::fmt::Debug for FileContents {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "FileContents({} bytes)", self.0.len())
    }
}

/// Something for the small CA to do.
#[derive(Debug, Clone)]
pub enum AuthorityWork {
    /// Needs no passphrase.
    Look,
    Create {
        new: Box<NewAuthority>,
        passphrase: SecretString,
    },
    Restore {
        path: PathBuf,
        passphrase: SecretString,
    },
    /// Finds out whether the passphrase is right.
    Unlock {
        passphrase: SecretString,
    },
    Sign {
        csr: Box<Csr>,
        request: Box<IssueRequest>,
        passphrase: SecretString,
    },
    Revoke {
        serial_numbers: Vec<String>,
        reason: RevocationReason,
        passphrase: SecretString,
    },
    PublishCrl {
        passphrase: SecretString,
    },
    BackUp {
        path: PathBuf,
        passphrase: SecretString,
    },
}

/// What the CA is like afterwards.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AuthorityResult {
    /// `None`: there is none.
    pub overview: Option<Box<AuthorityOverview>>,
    /// The file that was written for the engineer.
    pub saved: Option<PathBuf>,
}

/// Something for the store of connection passwords to do.
#[derive(Debug, Clone)]
pub enum VaultWork {
    /// Makes a vault; passwords of these controllers are taken over from the keyring.
    Create {
        passphrase: SecretString,
        controllers: Vec<Fingerprint>,
    },
    Open {
        passphrase: SecretString,
    },
    ChangePassphrase {
        passphrase: SecretString,
        new: SecretString,
    },
    Use(PasswordPlace),
    /// The passphrase is not asked for again.
    Decline,
    Close,
}

/// What a settings export says of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExportFound {
    pub exported: DateTime<Utc>,
    pub firmware: FirmwareVersion,
}

/// A file that was read.
#[derive(Debug, Clone)]
pub struct ReadTrustFile {
    pub path: PathBuf,
    pub result: Result<TrustFile, Problem>,
}
