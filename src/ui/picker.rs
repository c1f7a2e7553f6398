//! Choosing a file in the desktop's own dialog.
//!
//! Not every desktop has one, so every dialog of ours that takes a file has a field for its path as well.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::model::{ErrorCode, Problem};

/// What is looked for: which files are offered first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    Csv,
    /// Certificate signing requests.
    Csr,
}

impl FileKind {
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Csv => &["csv"],
            Self::Csr => &["csr", "req", "der", "pem"],
        }
    }
}

/// Told once what was chosen: `None` if nothing was.
pub type Picked = Box<dyn FnOnce(Result<Option<PathBuf>, Problem>) + Send>;

/// Lets a person choose a file. Returns at once.
pub trait FilePicker: Send + Sync {
    fn pick(&self, kind: FileKind, title: String, done: Picked);
}

/// The desktop's own dialog: its portal on Linux, the system's elsewhere.
#[derive(Debug, Clone, Copy, Default)]
pub struct SystemPicker;

/// Nobody closes a dialog so soon. The library does not tell a dialog that was cancelled from one that could not be
/// opened.
const TOO_SOON: Duration = Duration::from_millis(300);

/// Whoever waits is told even if the thread cannot be started or panics.
struct Tell(Option<Picked>);

impl Tell {
    fn tell(mut self, result: Result<Option<PathBuf>, Problem>) {
        if let Some(done) = self.0.take() {
            done(result);
        }
    }
}

impl Drop for Tell {
    fn drop(&mut self) {
        if let Some(done) = self.0.take() {
            done(Err(ErrorCode::NoFilePicker.into()));
        }
    }
}

impl FilePicker for SystemPicker {
    fn pick(&self, kind: FileKind, title: String, done: Picked) {
        let tell = Tell(Some(done));
        let ask = move || {
            let started = Instant::now();
            let dialog = rfd::FileDialog::new().set_title(title);
            let dialog = dialog.add_filter(kind.extensions().join(", "), kind.extensions()).add_filter("*", &["*"]);
            tell.tell(match dialog.pick_file() {
                None if started.elapsed() < TOO_SOON => Err(ErrorCode::NoFilePicker.into()),
                chosen => Ok(chosen),
            });
        };
        // Waits for a person, so it needs a thread of its own.
        if let Err(error) = std::thread::Builder::new().name("file picker".into()).spawn(ask) {
            tracing::warn!(%error, "no thread for the file dialog");
        }
    }
}

/// For tests: the person always chooses this.
#[derive(Debug, Clone)]
pub struct FixedPicker(pub Result<Option<PathBuf>, Problem>);

impl FilePicker for FixedPicker {
    fn pick(&self, _kind: FileKind, _title: String, done: Picked) {
        done(self.0.clone());
    }
}
