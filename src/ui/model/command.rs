//! What the window asks the backend for, and what the backend reports.

use std::path::PathBuf;

use chrono::{DateTime, Utc};
use secrecy::SecretString;

use super::{DroppedFile, JobId, Task, TaskEvent};
use crate::jobs::{
    Enrolled, JobController, JobSummary, LiveEvent, LiveLogin, LiveRequest, RecordEnd, RecordEvent, RecordRequest,
    RemoteConnection, RemoteControlEvent, RemoteControlRequest, TrustFile, WatchEvent,
};
use crate::model::{Address, ConnectionKind, ControllerInfo, Credentials, FirmwareVersion, Problem};
use crate::pki::{Csr, Fingerprint, IssueRequest, RevocationReason};
use crate::recorder::{LiveValues, Recorded, RecordingHeader, Sidecar};
use crate::ui::picker::FileKind;
use crate::workspace::authority::{AuthorityOverview, NewAuthority};
use crate::workspace::{Configuration, ControllerEntry, PasswordPlace, StoreStatus};

/// Work to be done.
#[derive(Debug, Clone)]
pub enum BackendCommand {
    /// Ends with [`BackendEvent::JobEnded`].
    Run {
        /// The job that the events name.
        job: JobId,
        /// The controllers, in the order of their indexes in events.
        controllers: Vec<JobController>,
        /// What is done to each.
        task: Task,
        /// How many controllers are worked on at once.
        parallelism: usize,
        /// To be remembered for all these controllers first.
        password: Option<SecretString>,
    },
    /// Reads the identity that answers at an address.
    Probe {
        /// The job that the events name.
        job: JobId,
        /// The protocol to be spoken.
        connection: ConnectionKind,
        /// Where the controller answers.
        address: Address,
    },
    /// Logs in for the first time, and reads the first information.
    Enroll {
        /// The job that the events name.
        job: JobId,
        /// The protocol to be spoken.
        connection: ConnectionKind,
        /// Where the controller answers.
        address: Address,
        /// The identity that was confirmed.
        fingerprint: Fingerprint,
        /// What the program proves itself with.
        credentials: Credentials,
    },
    /// Reads what the settings export of a controller on the PC says of itself.
    LookAtExport {
        /// The job that the events name.
        job: JobId,
        /// The controller that the export has to fit.
        of: Box<ControllerInfo>,
        /// Instead of the one in the workspace.
        file: Option<PathBuf>,
    },
    /// Ends with [`BackendEvent::AuthorityDone`]. Cannot be cancelled.
    Authority {
        /// The job that the event names.
        job: JobId,
        /// What the CA is to do.
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
        /// The job that the event names.
        job: JobId,
        /// Which files are offered first.
        kind: FileKind,
        /// Title of the file dialog.
        title: String,
    },
    /// Lets a person choose where a file is saved; ends with [`BackendEvent::FilePicked`].
    PickTarget {
        /// The job that the event names.
        job: JobId,
        /// Which files are offered first.
        kind: FileKind,
        /// Title of the file dialog.
        title: String,
        /// The path to begin with.
        begin: PathBuf,
    },
    /// Lets a person choose a folder; ends with [`BackendEvent::FilePicked`].
    PickFolder {
        /// The job that the event names.
        job: JobId,
        /// Title of the file dialog.
        title: String,
        /// The folder to begin with.
        begin: PathBuf,
    },
    /// Ends with [`BackendEvent::FileRead`]. A file of more than `most` bytes is refused.
    ReadFile {
        /// The job that the event names.
        job: JobId,
        /// The file.
        path: PathBuf,
        /// Greatest size in bytes; a larger file is an error.
        most: usize,
    },
    /// Lets a person choose files; ends with [`BackendEvent::FilesPicked`].
    PickFiles {
        /// The job that the event names.
        job: JobId,
        /// Which files are offered first.
        kind: FileKind,
        /// Title of the file dialog.
        title: String,
    },
    /// Reads files with certificates and CRLs; ends with [`BackendEvent::TrustFilesRead`].
    ReadTrustFiles {
        /// The job that the event names.
        job: JobId,
        /// The files.
        paths: Vec<PathBuf>,
    },
    /// Reports the lists of a controller with [`BackendEvent::TrustSeen`] until it is cancelled.
    WatchTrust {
        /// The job that the events name.
        job: JobId,
        /// The controller whose lists are watched.
        controller: Box<JobController>,
    },
    /// Reports what the OPC UA server of a controller shows with [`BackendEvent::LiveSeen`] until it is cancelled.
    WatchValues {
        /// The job that the events name.
        job: JobId,
        /// The controller whose server is watched.
        controller: Box<JobController>,
        /// How the program logs in.
        login: Box<LiveLogin>,
    },
    /// Asks a running [`BackendCommand::WatchValues`] for something. One that has ended does not answer.
    AskValues {
        /// The job that watches.
        job: JobId,
        /// What is asked for.
        request: LiveRequest,
    },
    /// Watches and controls a controller with remote commands, and reports with [`BackendEvent::RemoteSeen`] until it is
    /// cancelled.
    ControlRemotely {
        /// The job that the events name.
        job: JobId,
        /// Where to connect, and how to log in.
        connection: Box<RemoteConnection>,
    },
    /// Asks a running [`BackendCommand::ControlRemotely`] for something. One that has ended does not answer.
    AskRemote {
        /// The job that watches.
        job: JobId,
        /// What is asked for.
        request: RemoteControlRequest,
    },
    /// Writes a text file, readable by its owner only; ends with [`BackendEvent::TextSaved`].
    SaveText {
        /// The file. One of the same name is replaced.
        path: PathBuf,
        /// Its content.
        text: String,
    },
    /// Something about recordings; its results come as [`BackendEvent::Recorder`].
    Recorder {
        /// The job that the events name. [`BackendCommand::Cancel`] ends a recording, and its files are completed.
        job: JobId,
        /// What is to be done.
        work: RecorderWork,
    },
    /// Finds out what files are, by their content; ends with [`BackendEvent::Recognised`].
    Recognise {
        /// The job that the event names.
        job: JobId,
        /// The files.
        paths: Vec<PathBuf>,
    },
    /// Shows a folder in the desktop's file manager.
    OpenFolder(PathBuf),
    /// Starts the virtual controllers of the welcome page.
    StartVirtualControllers,
    /// Writes the configuration file.
    Save(Box<Configuration>),
    /// Brings the window to the front.
    ShowWindow,
    /// Ends the program.
    Quit,
}

/// What the backend reports.
#[derive(Debug)]
pub enum BackendEvent {
    /// A job has made progress.
    Job {
        /// The job.
        job: JobId,
        /// What happened.
        event: TaskEvent,
    },
    /// A job has ended; no more events of it follow.
    JobEnded {
        /// The job.
        job: JobId,
        /// How many controllers succeeded, failed and were not begun.
        summary: JobSummary,
    },
    /// The answer to [`BackendCommand::Probe`].
    Probed {
        /// The job.
        job: JobId,
        /// The identity that answered.
        result: Result<Fingerprint, Problem>,
    },
    /// The answer to [`BackendCommand::Enroll`].
    Enrolled {
        /// The job.
        job: JobId,
        /// The first information, or why there is none.
        result: Result<Box<Enrolled>, Problem>,
    },
    /// `None`: nothing was chosen.
    FilePicked {
        /// The job.
        job: JobId,
        /// The chosen file; `None` if the dialog was cancelled.
        result: Result<Option<PathBuf>, Problem>,
    },
    /// A file was read.
    FileRead {
        /// The job.
        job: JobId,
        /// The file and its bytes.
        result: Result<(PathBuf, FileContents), Problem>,
    },
    /// In the order they were asked for.
    Recognised {
        /// The job.
        job: JobId,
        /// What each file is.
        files: Vec<DroppedFile>,
    },
    /// The answer to [`BackendCommand::LookAtExport`].
    ExportSeen {
        /// The job.
        job: JobId,
        /// What the export says of itself, or why it cannot be imported.
        result: Result<ExportFound, Problem>,
    },
    /// Empty: nothing was chosen.
    FilesPicked {
        /// The job.
        job: JobId,
        /// The chosen files; none if the dialog was cancelled.
        result: Result<Vec<PathBuf>, Problem>,
    },
    /// In the order they were asked for.
    TrustFilesRead {
        /// The job.
        job: JobId,
        /// The files, in the order in which they were asked for.
        files: Vec<ReadTrustFile>,
    },
    /// The lists of a watched controller were read.
    TrustSeen {
        /// The job.
        job: JobId,
        /// What was seen.
        event: WatchEvent,
    },
    /// A running watch of values has seen something, or answers [`BackendCommand::AskValues`].
    LiveSeen {
        /// The job.
        job: JobId,
        /// What was seen.
        event: LiveEvent,
    },
    /// A running watch with remote commands has seen something, or answers [`BackendCommand::AskRemote`].
    RemoteSeen {
        /// The job.
        job: JobId,
        /// What was seen.
        event: RemoteControlEvent,
    },
    /// The answer to [`BackendCommand::SaveText`]: the file.
    TextSaved(Result<PathBuf, Problem>),
    /// What came of [`BackendCommand::Recorder`].
    Recorder {
        /// The job.
        job: JobId,
        /// What happened.
        event: RecorderEvent,
    },
    /// The answer to [`BackendCommand::Authority`].
    AuthorityDone {
        /// The job.
        job: JobId,
        /// What the CA is like afterwards.
        result: Result<AuthorityResult, Problem>,
    },
    /// The answer to [`BackendCommand::StartVirtualControllers`].
    VirtualStarted(Result<Vec<ControllerEntry>, Problem>),
    /// The answer to [`BackendCommand::Vault`].
    VaultDone(Result<(), Problem>),
    /// What the store of passwords is like has changed.
    PasswordStore(StoreStatus),
    /// A password works, but only until the program ends.
    PasswordNotKept(Problem),
    /// The configuration could not be written.
    SaveFailed(Problem),
    /// The file manager could not be started.
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
    /// Makes a CA in the workspace.
    Create {
        /// Names, keys and validities of the new CA.
        new: Box<NewAuthority>,
        /// The passphrase that will protect its keys.
        passphrase: SecretString,
    },
    /// Restores a CA from a backup.
    Restore {
        /// The backup file.
        path: PathBuf,
        /// The passphrase of the backup, which is that of the CA.
        passphrase: SecretString,
    },
    /// Finds out whether the passphrase is right.
    Unlock {
        /// The passphrase of the CA.
        passphrase: SecretString,
    },
    /// Issues a certificate for a signing request.
    Sign {
        /// The signing request.
        csr: Box<Csr>,
        /// What goes into the certificate.
        request: Box<IssueRequest>,
        /// The passphrase of the CA.
        passphrase: SecretString,
    },
    /// Revokes certificates and publishes a new CRL.
    Revoke {
        /// The certificates, by serial number in upper-case hexadecimal.
        serial_numbers: Vec<String>,
        /// Why they are revoked.
        reason: RevocationReason,
        /// The passphrase of the CA.
        passphrase: SecretString,
    },
    /// Publishes a new CRL.
    PublishCrl {
        /// The passphrase of the CA.
        passphrase: SecretString,
    },
    /// Writes a backup of the CA.
    BackUp {
        /// The file to be written.
        path: PathBuf,
        /// The passphrase of the CA, which protects the backup.
        passphrase: SecretString,
    },
}

/// Something to be done about recordings.
#[derive(Debug, Clone)]
pub enum RecorderWork {
    /// Completes the recordings in a folder that a program which was killed has left; ends with
    /// [`RecorderEvent::Recovered`].
    Recover(PathBuf),
    /// Records; ends with [`RecorderEvent::Ended`]. The window does not close before.
    Record(Box<RecordRequest>),
    /// Reads what a recording is about; ends with [`RecorderEvent::Described`].
    Describe(PathBuf),
    /// Reads values of a recording; ends with [`RecorderEvent::Loaded`].
    Load {
        /// A file of the recording.
        file: PathBuf,
        /// Gets the values while they are read.
        values: LiveValues,
    },
}

impl RecorderWork {
    /// Whether files would be left unfinished if the program ended before the work does.
    pub const fn writes(&self) -> bool {
        matches!(self, Self::Recover(_) | Self::Record(_))
    }
}

/// What happened to recordings.
#[derive(Debug)]
pub enum RecorderEvent {
    /// The recordings that were completed, or could not be.
    Recovered(Vec<Result<Recorded, Problem>>),
    /// A running recording reports something.
    Seen(RecordEvent),
    /// A recording has ended.
    Ended(Box<RecordEnd>),
    /// What a recording is about.
    Described(Result<Box<RecordingHeader>, Problem>),
    /// The values are read: what the recording holds.
    Loaded(Result<Box<Sidecar>, Problem>),
}

impl RecorderEvent {
    /// Whether no other event of the same work follows.
    pub const fn is_last(&self) -> bool {
        !matches!(self, Self::Seen(_))
    }
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
        /// The passphrase of the new vault.
        passphrase: SecretString,
        /// Controllers whose passwords are moved into it from the keyring.
        controllers: Vec<Fingerprint>,
    },
    /// Opens the vault.
    Open {
        /// Its passphrase.
        passphrase: SecretString,
    },
    /// Gives the vault another passphrase.
    ChangePassphrase {
        /// The passphrase it has now.
        passphrase: SecretString,
        /// The passphrase it gets.
        new: SecretString,
    },
    /// Keeps passwords in another place from now on.
    Use(PasswordPlace),
    /// The passphrase is not asked for again.
    Decline,
    /// Closes the vault: its key and passwords are wiped from memory.
    Close,
}

/// What a settings export says of itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExportFound {
    /// When the export was made, by the clock of the controller.
    pub exported: DateTime<Utc>,
    /// Firmware that made the export.
    pub firmware: FirmwareVersion,
}

/// A file that was read.
#[derive(Debug, Clone)]
pub struct ReadTrustFile {
    /// The file.
    pub path: PathBuf,
    /// Its certificates and CRLs, or why there are none.
    pub result: Result<TrustFile, Problem>,
}
