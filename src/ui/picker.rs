//! Choosing a file in the desktop's own dialog.
//!
//! Not every desktop has one, so every dialog of ours that takes a file has a field for its path as well.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use super::file_manager;
use crate::model::{ErrorCode, Problem};

/// What is looked for: which files are offered first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FileKind {
    /// Comma-separated text.
    Csv,
    /// Certificates, chains of them, CRLs.
    Trust,
    /// Revocation lists.
    Crl,
    /// Certificates.
    Certificate,
    /// Private keys.
    Key,
    /// PKCS#12.
    Pkcs12,
    /// Certificate signing requests.
    Csr,
    /// Plain text.
    Text,
    /// Recordings of the force sensor or the motion log.
    Recording,
    /// Folders.
    Folder,
}

impl FileKind {
    /// The extensions that are offered first, without their dot.
    pub const fn extensions(self) -> &'static [&'static str] {
        match self {
            Self::Csv => &["csv"],
            Self::Trust => &["der", "cer", "crt", "pem", "p7b", "p7c", "crl"],
            Self::Crl => &["crl", "der", "pem", "p7b", "p7c"],
            Self::Certificate => &["der", "cer", "crt", "pem"],
            Self::Key => &["key", "pem", "der", "p8", "pk8"],
            Self::Pkcs12 => &["pfx", "p12"],
            Self::Csr => &["csr", "req", "der", "pem"],
            Self::Text => &["txt", "log"],
            Self::Recording => &["csv", "parquet", "packets"],
            Self::Folder => &[],
        }
    }
}

/// Told once what was chosen: `None` if nothing was.
pub type Picked = Box<dyn FnOnce(Result<Option<PathBuf>, Problem>) + Send>;

/// Told once which files were chosen: none if nothing was.
pub type PickedSeveral = Box<dyn FnOnce(Result<Vec<PathBuf>, Problem>) + Send>;

/// Lets a person choose a file. Returns at once.
pub trait FilePicker: Send + Sync {
    /// Asks for one file, under a title. `done` is called once, on any thread.
    fn pick(&self, kind: FileKind, title: String, done: Picked);

    /// Likewise, of several files; where that cannot be asked for, of one.
    fn pick_several(&self, kind: FileKind, title: String, done: PickedSeveral) {
        self.pick(kind, title, Box::new(move |chosen| done(chosen.map(|path| path.into_iter().collect()))));
    }

    /// Lets a person choose where a file is saved, beginning with this path. The dialog asks before a file is replaced.
    fn pick_target(&self, kind: FileKind, title: String, _begin: PathBuf, done: Picked) {
        self.pick(kind, title, done);
    }

    /// Lets a person choose a folder, beginning with this one.
    fn pick_folder(&self, title: String, _begin: PathBuf, done: Picked) {
        self.pick(FileKind::Folder, title, done);
    }

    /// Shows a folder in the desktop's file manager. Blocks for a moment.
    fn open_folder(&self, folder: &Path) -> Result<(), Problem>;
}

/// The desktop's own dialog: its portal on Linux, the system's elsewhere.
#[derive(Debug, Clone, Copy, Default)]
pub struct SystemPicker;

/// No person closes a dialog so soon. The library does not tell a dialog that was cancelled from one that could not be
/// opened.
const TOO_SOON: Duration = Duration::from_millis(300);

/// Reports a result even if the thread cannot be started or panics.
struct ResultGuard<T>(Option<OnChosen<T>>);

type OnChosen<T> = Box<dyn FnOnce(Result<T, Problem>) + Send>;

impl<T> ResultGuard<T> {
    fn tell(mut self, result: Result<T, Problem>) {
        if let Some(done) = self.0.take() {
            done(result);
        }
    }
}

impl<T> Drop for ResultGuard<T> {
    fn drop(&mut self) {
        if let Some(done) = self.0.take() {
            done(Err(ErrorCode::NoFilePicker.into()));
        }
    }
}

impl FilePicker for SystemPicker {
    fn pick(&self, kind: FileKind, title: String, done: Picked) {
        ask(kind, title, done, rfd::FileDialog::pick_file, |chosen| chosen);
    }

    fn pick_several(&self, kind: FileKind, title: String, done: PickedSeveral) {
        ask(kind, title, done, rfd::FileDialog::pick_files, Option::unwrap_or_default);
    }

    fn pick_target(&self, kind: FileKind, title: String, begin: PathBuf, done: Picked) {
        let save = move |mut dialog: rfd::FileDialog| {
            if let Some(folder) = begin.parent().filter(|folder| folder.is_dir()) {
                dialog = dialog.set_directory(folder);
            }
            if let Some(name) = begin.file_name() {
                dialog = dialog.set_file_name(name.to_string_lossy());
            }
            dialog.save_file()
        };
        ask(kind, title, done, save, |chosen| chosen);
    }

    fn pick_folder(&self, title: String, begin: PathBuf, done: Picked) {
        let choose = move |dialog: rfd::FileDialog| {
            // The folder may not be there yet.
            let there = begin.ancestors().find(|folder| folder.is_dir());
            there.map_or(dialog.clone(), |folder| dialog.set_directory(folder)).pick_folder()
        };
        ask(FileKind::Folder, title, done, choose, |chosen| chosen);
    }

    fn open_folder(&self, folder: &Path) -> Result<(), Problem> {
        file_manager::open(folder)
    }
}

/// Waits for a person, so it needs a thread of its own.
fn ask<C: 'static, T: Send + 'static>(
    kind: FileKind,
    title: String,
    done: OnChosen<T>,
    open: impl FnOnce(rfd::FileDialog) -> Option<C> + Send + 'static,
    chosen: fn(Option<C>) -> T,
) {
    let tell = ResultGuard(Some(done));
    let ask = move || {
        let started = Instant::now();
        let dialog = rfd::FileDialog::new().set_title(title);
        let dialog = match kind.extensions() {
            [] => dialog,
            extensions => dialog.add_filter(extensions.join(", "), extensions).add_filter("*", &["*"]),
        };
        tell.tell(match open(dialog) {
            None if started.elapsed() < TOO_SOON => Err(ErrorCode::NoFilePicker.into()),
            answer => Ok(chosen(answer)),
        });
    };
    if let Err(error) = std::thread::Builder::new().name("file picker".into()).spawn(ask) {
        tracing::warn!(%error, "no thread for the file dialog");
    }
}

/// For tests: the person always chooses this.
#[derive(Debug, Clone)]
pub struct FixedPicker(pub Result<Option<PathBuf>, Problem>);

impl FilePicker for FixedPicker {
    fn pick(&self, _kind: FileKind, _title: String, done: Picked) {
        done(self.0.clone());
    }

    fn open_folder(&self, folder: &Path) -> Result<(), Problem> {
        Err(Problem::with_detail(ErrorCode::FolderNotOpened, folder.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dialog_that_is_gone_at_once_was_never_there() {
        let (tell, told) = std::sync::mpsc::channel();
        let done = Box::new(move |result: Result<Option<PathBuf>, Problem>| tell.send(result).unwrap());
        ask(FileKind::Csv, "Choose".into(), done, |_| None::<PathBuf>, |chosen| chosen);
        assert_eq!(told.recv().unwrap(), Err(ErrorCode::NoFilePicker.into()));
    }
}
