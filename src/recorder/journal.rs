//! The journal: every packet as it came, appended to a file that is flushed to the disk each second.
//!
//! A journal survives the end of the process at any moment: what was flushed is read again, and the frame that was being
//! written is left out. From it the other files of a recording are made again ([`super::convert`]).
//!
//! The file is the line `OPCUA-RECORDING 1`, then frames. A frame is its kind (1 byte), the length of its content (u32),
//! the time of this computer in milliseconds since 1970 (i64), the content, and the CRC-32 of all of these (u32); numbers
//! are little endian. The first frame is the header.

use std::fs::File;
use std::io::{self, BufReader, Read, Write as _};
use std::path::{Path, PathBuf};

use chrono::{DateTime, SubsecRound as _, Utc};
use serde::{Deserialize, Serialize};

use super::error::RecorderError;
use super::settings::RecordSettings;
use super::stop_reason::StopReason;
use crate::model::clock;
use crate::platform::private;
use crate::records::{JOURNAL, MAX_READ_BYTES};

/// What a recording is about: the first frame of its journal.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordingHeader {
    /// The name in the list of controllers.
    pub controller: String,
    /// The serial number of the controller.
    pub serial: String,
    /// Where the OPC UA server is reached.
    pub url: String,
    /// What is recorded.
    #[serde(flatten)]
    pub settings: RecordSettings,
    /// By the clock of this computer.
    pub started_at: DateTime<Utc>,
    /// The extension of the file that is made of the packets: `csv` or `parquet`.
    pub format: String,
    /// Whether the journal stays when the recording is complete.
    pub keep_packets: bool,
}

/// One entry of a journal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Entry {
    /// One read of the `Data` node.
    Packet {
        /// As they came.
        bytes: Vec<u8>,
        /// Whether ErrorStatus was `Warning` before the read.
        overwritten: bool,
    },
    /// ErrorStatus was `Error`: the controller broke off.
    BrokenOff,
    /// The connection was lost, for this reason.
    ConnectionLost(String),
    /// The recording is complete.
    End(StopReason),
}

/// Kind, length, time.
const FRAME_HEAD: usize = 1 + 4 + 8;

mod kind {
    pub const HEADER: u8 = b'H';
    pub const PACKET: u8 = b'P';
    pub const PACKET_AFTER_WARNING: u8 = b'W';
    pub const BROKEN_OFF: u8 = b'B';
    pub const CONNECTION_LOST: u8 = b'C';
    pub const END: u8 = b'E';
}

/// Appends to a new journal.
#[derive(Debug)]
pub struct JournalWriter {
    path: PathBuf,
    file: File,
    /// Frames that are not yet with the operating system.
    pending: Vec<u8>,
}

impl JournalWriter {
    /// Makes the file, private and locked, with the header in it. Errors if there is one.
    pub fn create(path: &Path, header: &RecordingHeader) -> Result<Self, RecorderError> {
        let file = private::create_file(path).map_err(RecorderError::write(path))?;
        // Tells other processes that the recording goes on. Not every file system has locks.
        if let Err(error) = file.try_lock() {
            tracing::debug!(path = %path.display(), %error, "the journal is not locked");
        }
        let mut journal = Self { path: path.to_owned(), file, pending: JOURNAL.to_vec() };
        let json = serde_json::to_vec(header).map_err(|e| RecorderError::write(path)(io::Error::other(e)))?;
        journal.frame(kind::HEADER, header.started_at, &json);
        journal.sync()?;
        Ok(journal)
    }

    /// Appends an entry. It is on the disk after the next [`JournalWriter::sync`].
    pub fn append(&mut self, at: DateTime<Utc>, entry: &Entry) {
        match entry {
            Entry::Packet { bytes, overwritten: false } => self.frame(kind::PACKET, at, bytes),
            Entry::Packet { bytes, overwritten: true } => self.frame(kind::PACKET_AFTER_WARNING, at, bytes),
            Entry::BrokenOff => self.frame(kind::BROKEN_OFF, at, &[]),
            Entry::ConnectionLost(why) => self.frame(kind::CONNECTION_LOST, at, why.as_bytes()),
            Entry::End(reason) => self.frame(kind::END, at, reason.as_str().as_bytes()),
        }
    }

    fn frame(&mut self, kind: u8, at: DateTime<Utc>, content: &[u8]) {
        let start = self.pending.len();
        self.pending.push(kind);
        let length = u32::try_from(content.len()).unwrap_or(u32::MAX);
        self.pending.extend_from_slice(&length.to_le_bytes());
        self.pending.extend_from_slice(&at.timestamp_millis().to_le_bytes());
        self.pending.extend_from_slice(content);
        let crc = crc32fast::hash(&self.pending[start..]);
        self.pending.extend_from_slice(&crc.to_le_bytes());
    }

    /// Writes what was appended and flushes it to the disk. Blocks for that long.
    pub fn sync(&mut self) -> Result<(), RecorderError> {
        if self.pending.is_empty() {
            return Ok(());
        }
        let done = self.file.write_all(&self.pending).and_then(|()| self.file.sync_data());
        done.map_err(RecorderError::write(&self.path))?;
        self.pending.clear();
        Ok(())
    }
}

/// Reads a journal from its beginning.
#[derive(Debug)]
pub struct JournalReader {
    path: PathBuf,
    file: BufReader<File>,
    header: RecordingHeader,
}

impl JournalReader {
    /// Opens a journal and reads its header.
    pub fn open(path: &Path) -> Result<Self, RecorderError> {
        let file = File::open(path).map_err(RecorderError::read(path))?;
        let mut file = BufReader::with_capacity(1 << 16, file);
        let no_recording = |what| RecorderError::NotARecording { path: path.to_owned(), what };
        let mut magic = [0; JOURNAL.len()];
        match file.read_exact(&mut magic) {
            Ok(()) if magic == JOURNAL => {}
            Ok(()) => return Err(no_recording("the first line is not that of a packet file")),
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                return Err(no_recording("the file ends before its header"));
            }
            Err(error) => return Err(RecorderError::read(path)(error)),
        }
        let frame = next_frame(&mut file).map_err(RecorderError::read(path))?;
        let header = frame.filter(|frame| frame.kind == kind::HEADER);
        let header = header.and_then(|frame| serde_json::from_slice(&frame.content).ok());
        let header = header.ok_or_else(|| no_recording("the header is damaged"))?;
        Ok(Self { path: path.to_owned(), file, header })
    }

    /// What the recording is about.
    pub const fn header(&self) -> &RecordingHeader {
        &self.header
    }

    /// The next entry and the time at which it came; `None` at the end, and before the first frame that is not whole.
    pub fn next_entry(&mut self) -> Result<Option<(DateTime<Utc>, Entry)>, RecorderError> {
        while let Some(Frame { kind, at, content }) =
            next_frame(&mut self.file).map_err(RecorderError::read(&self.path))?
        {
            let text = || String::from_utf8_lossy(&content).into_owned();
            let entry = match kind {
                kind::PACKET => Entry::Packet { bytes: content, overwritten: false },
                kind::PACKET_AFTER_WARNING => Entry::Packet { bytes: content, overwritten: true },
                kind::BROKEN_OFF => Entry::BrokenOff,
                kind::CONNECTION_LOST => Entry::ConnectionLost(text()),
                kind::END => Entry::End(StopReason::from_name(&text())),
                // Of a later version.
                _ => continue,
            };
            return Ok(Some((at, entry)));
        }
        Ok(None)
    }
}

struct Frame {
    kind: u8,
    at: DateTime<Utc>,
    content: Vec<u8>,
}

/// `None` at the end of the file, in the middle of a frame, and at a frame that is damaged.
fn next_frame(file: &mut impl Read) -> io::Result<Option<Frame>> {
    let mut head = [0; FRAME_HEAD];
    if !read_whole(file, &mut head)? {
        return Ok(None);
    }
    let [kind, l0, l1, l2, l3, time @ ..] = head;
    let length = u32::from_le_bytes([l0, l1, l2, l3]) as usize;
    let at = DateTime::from_timestamp_millis(i64::from_le_bytes(time));
    if length > MAX_READ_BYTES {
        return Ok(None);
    }
    let mut content = vec![0; length];
    let mut crc = [0; 4];
    if !read_whole(file, &mut content)? || !read_whole(file, &mut crc)? {
        return Ok(None);
    }
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&head);
    hasher.update(&content);
    let is_whole = hasher.finalize() == u32::from_le_bytes(crc);
    Ok(at.filter(|_| is_whole).map(|at| Frame { kind, at, content }))
}

/// Whether there were enough bytes.
fn read_whole(file: &mut impl Read, bytes: &mut [u8]) -> io::Result<bool> {
    match file.read_exact(bytes) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(false),
        Err(error) => Err(error),
    }
}

/// The time of this computer, as precise as a journal keeps it: to the millisecond.
pub(super) fn now() -> DateTime<Utc> {
    clock::now().trunc_subsecs(3)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn header() -> RecordingHeader {
        RecordingHeader {
            controller: "焊接 1".into(),
            serial: "R7A0000001".into(),
            url: "opc.tcp://127.0.0.1:4840".into(),
            settings: RecordSettings::motion(0, 0).unwrap(),
            started_at: DateTime::from_timestamp_millis(1_800_000_000_123).unwrap(),
            format: "csv".into(),
            keep_packets: false,
        }
    }

    fn read(path: &Path) -> Vec<Entry> {
        let mut reader = JournalReader::open(path).unwrap();
        assert_eq!(*reader.header(), header());
        std::iter::from_fn(|| reader.next_entry().unwrap().map(|(_, entry)| entry)).collect()
    }

    #[test]
    fn what_was_flushed_is_read_and_a_torn_frame_is_left_out() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.packets");
        let mut journal = JournalWriter::create(&path, &header()).unwrap();
        let entries = [
            Entry::Packet { bytes: vec![1; 300], overwritten: false },
            Entry::ConnectionLost("the connection was closed".into()),
            Entry::BrokenOff,
            Entry::Packet { bytes: vec![2; 5], overwritten: true },
            Entry::End(StopReason::Footer),
        ];
        entries.iter().for_each(|entry| journal.append(header().started_at, entry));
        journal.sync().unwrap();
        assert_eq!(read(&path), entries);
        let whole = fs::read(&path).unwrap();
        drop(journal);
        for missing in 1..40 {
            fs::write(&path, &whole[..whole.len() - missing]).unwrap();
            let found = read(&path);
            // The last frame has 23 bytes: 17 around the name of the reason.
            let expected = if missing <= 23 { 4 } else { 3 };
            assert_eq!(found, entries[..expected], "{missing} bytes are missing");
        }
    }

    #[test]
    fn other_files_are_no_recordings() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.packets");
        for bytes in [&b""[..], b"OPCUA-RECORDING 2\n", b"OPCUA-RECORDING 1\n", &[JOURNAL, &[b'H'; 60]].concat()] {
            fs::write(&path, bytes).unwrap();
            let opened = JournalReader::open(&path);
            assert!(matches!(opened, Err(RecorderError::NotARecording { .. })), "{opened:?}");
        }
    }
}
