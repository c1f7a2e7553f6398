use std::fs::{self, File, OpenOptions};
use std::io::{self, Read as _, Seek as _, SeekFrom, Write as _};
use std::path::{Path, PathBuf};
use std::time::Instant;

use chrono::SecondsFormat;
use parking_lot::Mutex;
use tokio::sync::Notify;

use super::faults::Faults;
use super::log_share::UnauthenticatedShare;
use super::opcua::ServerEvent;
use crate::model::LogChunk;

/// The log of a controller's OPC UA server (manual 2.6.1, 6.3): one file in its folder, one event a line, times in UTC
/// by the controller's clock.
///
/// It never grows beyond its limit, [`LOG_LIMIT`] unless a fault switch says otherwise: the last line says that it is
/// full, and [`ServerLog::filled`] ends, so that the server can be stopped. Peers that have proved nothing get a part of
/// it only ([`UnauthenticatedShare`]).
#[derive(Debug)]
pub struct ServerLog {
    path: PathBuf,
    faults: Faults,
    writing: Mutex<Option<OpenLog>>,
    full: Notify,
}

#[derive(Debug)]
struct OpenLog {
    file: File,
    strangers: UnauthenticatedShare,
}

/// Bytes after which the server stops. The manual names no number; this is about ten thousand events.
pub const LOG_LIMIT: u64 = 1024 * 1024;

/// Kept free for the last line; no line is longer than half of it.
const ROOM: u64 = 1024;
const MAX_LINE_CHARS: usize = 120;

impl ServerLog {
    pub fn new(folder: &Path, faults: Faults) -> Self {
        let log = Self { path: folder.join("server.log"), faults, writing: Mutex::new(None), full: Notify::new() };
        // Of a process that was killed in between.
        if log.aside().exists() && log.put_back().is_err() {
            tracing::warn!(path = %log.path.display(), "a server log that was put aside is not put back");
        }
        log
    }

    /// Writes one line, unless the log is full. A log that cannot be written is no reason to fail.
    pub fn write(&self, event: ServerEvent<'_>) {
        if let Err(error) = self.append(event) {
            tracing::warn!(path = %self.path.display(), %error, "the server log was not written");
        }
    }

    pub fn is_full(&self) -> bool {
        fs::metadata(&self.path).is_ok_and(|file| file.len() >= self.threshold())
    }

    /// Ends when the log has become full.
    pub async fn filled(&self) {
        self.full.notified().await;
    }

    /// The log from byte `from` on, or its end, as much as fits into an answer; whole lines where that is possible.
    pub fn read(&self, from: Option<u64>) -> io::Result<LogChunk> {
        let mut file = match File::open(&self.path) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(LogChunk::default()),
            Err(error) => return Err(error),
        };
        let size = file.metadata()?.len();
        let most = LogChunk::MAX_BYTES as u64;
        let mut begin = from.unwrap_or_else(|| size.saturating_sub(most)).min(size);
        file.seek(SeekFrom::Start(begin))?;
        let mut bytes = Vec::new();
        file.take(most).read_to_end(&mut bytes)?;
        let next = begin + bytes.len() as u64;
        let mut text = bytes.as_slice();
        if from.is_none()
            && begin > 0
            && let Some(end) = text.iter().position(|b| *b == b'\n')
        {
            text = &text[end + 1..];
            begin += end as u64 + 1;
        }
        let next = match text.iter().rposition(|b| *b == b'\n') {
            Some(end) if next < size => {
                text = &text[..=end];
                begin + text.len() as u64
            }
            _ => next,
        };
        Ok(LogChunk { size, from: begin, next, text: String::from_utf8_lossy(text).into_owned() })
    }

    /// Puts the log aside, so that a new one begins. What comes of it is decided by [`ServerLog::delete_aside`] or
    /// [`ServerLog::put_back`].
    pub fn put_aside(&self) -> io::Result<()> {
        let mut writing = self.writing.lock();
        *writing = None;
        missing_is_fine(fs::rename(&self.path, self.aside()))
    }

    /// Deletes what was put aside.
    pub fn delete_aside(&self) -> io::Result<()> {
        missing_is_fine(fs::remove_file(self.aside()))
    }

    /// Undoes [`ServerLog::put_aside`]. What was written since stands behind what was put aside.
    pub fn put_back(&self) -> io::Result<()> {
        let mut writing = self.writing.lock();
        *writing = None;
        if !self.aside().exists() {
            return Ok(());
        }
        let since = match fs::read(&self.path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            read => read?,
        };
        fs::rename(self.aside(), &self.path)?;
        open(&self.path)?.write_all(&since)
    }

    fn aside(&self) -> PathBuf {
        self.path.with_extension("log.aside")
    }

    /// From this size on nothing but the last line is written.
    fn threshold(&self) -> u64 {
        self.faults.get().log_limit.unwrap_or(LOG_LIMIT).saturating_sub(ROOM)
    }

    fn append(&self, event: ServerEvent<'_>) -> io::Result<()> {
        let mut slot = self.writing.lock();
        let OpenLog { file, strangers } = match &mut *slot {
            Some(writing) => writing,
            none => {
                let file = open(&self.path)?;
                let strangers = UnauthenticatedShare::new(file.metadata()?.len(), Instant::now());
                none.insert(OpenLog { file, strangers })
            }
        };
        let threshold = self.threshold();
        if file.metadata()?.len() >= threshold {
            return Ok(());
        }
        let now = Instant::now();
        let level = if event.is_warning() { "WARN" } else { "INFO" };
        let what = clean(&event.to_string());
        let line = self.line(level, &what);
        let is_written = !event.is_open_to_strangers() || strangers.admit(&what, line.len() as u64, threshold);
        if let Some(summary) = strangers.summary(now) {
            file.write_all(self.line("WARN", &clean(&summary)).as_bytes())?;
        }
        if is_written {
            file.write_all(line.as_bytes())?;
        }
        if file.metadata()?.len() >= threshold {
            file.write_all(self.line("WARN", "the log is full; the server stops").as_bytes())?;
            self.full.notify_one();
        }
        Ok(())
    }

    fn line(&self, level: &str, what: &str) -> String {
        format!("{} {level} {what}\n", self.faults.now().to_rfc3339_opts(SecondsFormat::Millis, true))
    }
}

/// Without control characters, and not longer than a line may be.
fn clean(what: &str) -> String {
    what.chars().filter(|c| !c.is_control()).take(MAX_LINE_CHARS).collect()
}

fn missing_is_fine(result: io::Result<()>) -> io::Result<()> {
    match result {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

fn open(path: &Path) -> io::Result<File> {
    let mut options = OpenOptions::new();
    options.append(true).create(true);
    #[cfg(unix)]
    std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
    options.open(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn log(folder: &Path, limit: u64) -> ServerLog {
        let faults = Faults::default();
        faults.update(|switches| switches.log_limit = Some(limit));
        ServerLog::new(folder, faults)
    }

    fn logged_in(log: &ServerLog) {
        log.write(ServerEvent::LoggedIn { user: Some("operator1"), policy: "Basic256Sha256", mode: "Sign" });
    }

    fn connected(log: &ServerLog, address: [u8; 4]) {
        log.write(ServerEvent::Connected { client: (address, 50_000).into() });
    }

    #[tokio::test]
    async fn strangers_cannot_fill_a_log_and_those_who_have_proved_something_can() {
        let folder = tempfile::tempdir().unwrap();
        let log = log(folder.path(), 32 * 1024);
        logged_in(&log);
        for number in 0..20_000_u32 {
            let address = (0x0a00_0000 + number).to_be_bytes();
            connected(&log, address);
            log.write(ServerEvent::Refused { client: (address, 50_000).into(), reason: "not an OPC UA message" });
            log.write(ServerEvent::LoginRefused { client: None, user: None, reason: "no such user" });
            log.write(ServerEvent::LoggedIn { user: None, policy: "None", mode: "None" });
        }
        let size = log.read(None).unwrap().size;
        assert!((4096..9 * 1024).contains(&size) && !log.is_full(), "{size}");
        while !log.is_full() {
            logged_in(&log);
        }
        tokio::time::timeout(std::time::Duration::from_secs(5), log.filled()).await.expect("said so");
    }

    #[tokio::test]
    async fn a_log_is_full_below_its_limit_and_says_so_once() {
        let folder = tempfile::tempdir().unwrap();
        let log = log(folder.path(), 4096);
        while !log.is_full() {
            logged_in(&log);
        }
        tokio::time::timeout(std::time::Duration::from_secs(5), log.filled()).await.expect("said so");
        let size = log.read(None).unwrap().size;
        assert!((3072..=4096).contains(&size), "{size}");
        logged_in(&log);
        let chunk = log.read(None).unwrap();
        assert_eq!(chunk.size, size);
        assert!(chunk.text.ends_with("WARN the log is full; the server stops\n"), "{}", chunk.text);
        assert_eq!(chunk.text.matches("is full").count(), 1);
        log.put_aside().unwrap();
        assert!(!log.is_full());
        logged_in(&log);
        log.put_back().unwrap();
        let back = log.read(None).unwrap();
        assert!(log.is_full() && back.size > size && back.text.starts_with(&chunk.text), "{}", back.text);
        for _ in 0..2 {
            log.put_aside().unwrap();
            log.delete_aside().unwrap();
        }
        assert!(!log.is_full());
        assert_eq!(log.read(None).unwrap(), LogChunk::default());
        logged_in(&log);
        assert_eq!(log.read(None).unwrap().text.lines().count(), 1);
    }

    #[test]
    fn a_long_log_is_read_in_pieces_that_fit_together() {
        let folder = tempfile::tempdir().unwrap();
        let log = log(folder.path(), LOG_LIMIT);
        while !log.is_full() {
            logged_in(&log);
        }
        let whole = fs::read_to_string(folder.path().join("server.log")).unwrap();
        let (mut text, mut from, mut pieces) = (String::new(), 0, 0);
        loop {
            let chunk = log.read(Some(from)).unwrap();
            assert_eq!((chunk.from, chunk.size), (from, whole.len() as u64));
            assert!(chunk.text.len() <= LogChunk::MAX_BYTES && chunk.text.ends_with('\n'));
            text += &chunk.text;
            (from, pieces) = (chunk.next, pieces + 1);
            if from == chunk.size {
                break;
            }
        }
        assert_eq!(text, whole);
        assert!(pieces >= 4);
        let tail = log.read(None).unwrap();
        assert!(whole.ends_with(&tail.text) && tail.from > 0 && tail.next == tail.size);
        assert_eq!(tail.from as usize + tail.text.len(), whole.len());
        assert_eq!(log.read(Some(u64::MAX)).unwrap().text, "");
    }
}
