//! Lets a second start of the program show the window that has the workspace open already.
//!
//! The window listens in the workspace (`.window`, a Unix socket) or, on Windows, at a named pipe whose name is made of
//! the workspace's path; both are for this account only. A request is one line, and so is the answer. Anything else is
//! dropped; one exchange takes at most 2 s and 32 bytes.

mod exchange;
#[cfg(windows)]
mod pipe;
#[cfg(unix)]
mod socket;

use std::io;
use std::path::Path;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

#[cfg(windows)]
use pipe as system;
#[cfg(unix)]
use socket as system;

pub use exchange::ShowWindowOutcome;
use exchange::ask;
pub use system::StartRequests;

/// Asks the program that has the workspace open to show its window. Blocks up to 3 s.
///
/// Fails if no window has it open: then a command of the command line works on the workspace, or it is open on another
/// computer.
pub fn show_running_window(root: &Path) -> io::Result<ShowWindowOutcome> {
    let (sender, answer) = mpsc::channel();
    let root = root.to_owned();
    // Pipes and sockets do not bound every step by themselves.
    thread::Builder::new().name("running window".to_owned()).spawn(move || {
        let _ = sender.send(system::connect(&root).and_then(ask));
    })?;
    answer.recv_timeout(WAIT_LIMIT).unwrap_or_else(|_| Err(io::ErrorKind::TimedOut.into()))
}

const WAIT_LIMIT: Duration = Duration::from_secs(3);

#[cfg(test)]
mod tests {
    use std::io::Write as _;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::exchange::REQUEST;
    use super::*;
    use crate::workspace::Workspace;

    fn serving(
        workspace: &Workspace,
        shown: ShowWindowOutcome,
    ) -> (tokio::runtime::Runtime, StartRequests, Arc<AtomicUsize>) {
        let runtime = tokio::runtime::Builder::new_multi_thread().worker_threads(1).enable_all().build().unwrap();
        let lock = workspace.lock().unwrap();
        let requests = StartRequests::listen(workspace.root(), &lock).unwrap();
        let asked = Arc::new(AtomicUsize::new(0));
        let count = asked.clone();
        let serve = requests.serve(shown, move || {
            count.fetch_add(1, Ordering::SeqCst);
        });
        runtime.spawn(serve);
        (runtime, requests, asked)
    }

    /// The pipe of Windows is there a moment after the task has started.
    fn shown(root: &Path) -> io::Result<ShowWindowOutcome> {
        (0..50)
            .find_map(|_| show_running_window(root).ok().or_else(|| (thread::sleep(Duration::from_millis(20)), None).1))
            .ok_or_else(|| io::ErrorKind::NotFound.into())
    }

    #[test]
    fn the_window_that_listens_is_asked_and_answers() {
        let folder = tempfile::tempdir().unwrap();
        let workspace = Workspace::new(folder.path().join("焊接"));
        assert!(show_running_window(workspace.root()).is_err(), "there is no window");
        for answer in [ShowWindowOutcome::InFront, ShowWindowOutcome::Marked] {
            let (runtime, requests, asked) = serving(&workspace, answer);
            assert_eq!(shown(workspace.root()).unwrap(), answer);
            assert_eq!(shown(workspace.root()).unwrap(), answer);
            assert_eq!(asked.load(Ordering::SeqCst), 2);
            drop(requests);
            drop(runtime);
            assert!(show_running_window(workspace.root()).is_err(), "the window is closed");
        }
        assert!(show_running_window(folder.path()).is_err(), "another workspace");
    }

    #[test]
    fn strangers_and_silence_do_not_keep_it_from_answering() {
        let folder = tempfile::tempdir().unwrap();
        let workspace = Workspace::new(folder.path());
        let (_runtime, _requests, asked) = serving(&workspace, ShowWindowOutcome::InFront);
        shown(workspace.root()).unwrap();
        let mut noise = system::connect(workspace.root()).unwrap();
        noise.write_all(&[b'x'; REQUEST.len()]).unwrap();
        let silent = system::connect(workspace.root()).unwrap();
        assert_eq!(shown(workspace.root()).unwrap(), ShowWindowOutcome::InFront);
        assert_eq!(asked.load(Ordering::SeqCst), 2);
        drop((noise, silent));
    }
}
