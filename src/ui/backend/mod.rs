//! Where the work is done that a frame may not wait for.

mod authority;
mod tokio_backend;
mod trust_files;
mod unfinished;
mod vault;

use std::collections::VecDeque;
use std::path::PathBuf;

use async_trait::async_trait;
use secrecy::SecretString;

pub use authority::{AuthorityDone, AuthorityWork};
pub use tokio_backend::{BackendOptions, TokioBackend};
pub use vault::VaultWork;

use super::model::trust::ReadTrustFile;
use super::model::{DroppedFile, ExportFound, JobId, Task, TaskEvent};
use super::picker::FileKind;
use crate::jobs::{Enrolled, JobController, Summary, WatchEvent};
use crate::model::{Address, ConnectionKind, ControllerInfo, Credentials, Problem};
use crate::pki::Fingerprint;
use crate::workspace::{Configuration, ControllerEntry, StoreStatus};

/// Work to be done.
#[derive(Debug, Clone)]
pub enum Command {
    /// Ends with [`Event::JobEnded`].
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
    /// Ends with [`Event::AuthorityDone`]. Cannot be cancelled.
    Authority {
        job: JobId,
        work: AuthorityWork,
    },
    /// Stops a job after the step in hand.
    Cancel(JobId),
    /// Creating, opening and changing the passphrase end with [`Event::VaultDone`].
    Vault(VaultWork),
    /// Forgets the passwords of deleted controllers.
    Forget(Vec<Fingerprint>),
    /// Lets a person choose a file; ends with [`Event::FilePicked`].
    PickFile {
        job: JobId,
        kind: FileKind,
        title: String,
    },
    /// Lets a person choose where a file is saved; ends with [`Event::FilePicked`].
    PickTarget {
        job: JobId,
        kind: FileKind,
        title: String,
        /// The path to begin with.
        begin: PathBuf,
    },
    /// Ends with [`Event::FileRead`]. A file of more than `most` bytes is refused.
    ReadFile {
        job: JobId,
        path: PathBuf,
        most: usize,
    },
    /// Lets a person choose files; ends with [`Event::FilesPicked`].
    PickFiles {
        job: JobId,
        kind: FileKind,
        title: String,
    },
    /// Reads files with certificates and CRLs; ends with [`Event::TrustFilesRead`].
    ReadTrustFiles {
        job: JobId,
        paths: Vec<PathBuf>,
    },
    /// Reports the lists of a controller with [`Event::TrustSeen`] until it is cancelled.
    WatchTrust {
        job: JobId,
        controller: Box<JobController>,
    },
    /// Finds out what files are, by their content; ends with [`Event::Recognised`].
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

/// What came of it.
#[derive(Debug)]
pub enum Event {
    Job {
        job: JobId,
        event: TaskEvent,
    },
    JobEnded {
        job: JobId,
        summary: Summary,
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
    AuthorityDone {
        job: JobId,
        result: Result<AuthorityDone, Problem>,
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

/// Does [`Command`]s in the background. Neither call may block.
pub trait Backend {
    fn send(&mut self, command: Command);
    fn poll(&mut self) -> Option<Event>;
    /// Whether work goes on that would leave a controller or a file half changed if the program ended now.
    fn has_unfinished_work(&self) -> bool;
}

/// A virtual controller to be added to the list.
#[derive(Debug, Clone)]
pub struct NewVirtual {
    pub entry: ControllerEntry,
    pub password: SecretString,
}

/// Starts the simulated controllers the welcome page offers.
#[async_trait]
pub trait VirtualFleetStarter: Send + Sync {
    async fn start(&self) -> Result<Vec<NewVirtual>, Problem>;
}

/// For tests: keeps what was sent and plays back what it is given.
#[derive(Debug, Default)]
pub struct RecordingBackend {
    pub sent: Vec<Command>,
    pub events: VecDeque<Event>,
    pub unfinished_work: bool,
}

impl Backend for RecordingBackend {
    fn send(&mut self, command: Command) {
        self.sent.push(command);
    }

    fn poll(&mut self) -> Option<Event> {
        self.events.pop_front()
    }

    fn has_unfinished_work(&self) -> bool {
        self.unfinished_work
    }
}
