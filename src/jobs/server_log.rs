use std::path::PathBuf;
use std::time::{Duration, Instant};

use async_trait::async_trait;

use super::{Confirmation, JobStep, Operation, OperationOutput, OperationRun, OutputFacts};
use crate::model::{ErrorCode, LogChunk, Problem, untrusted_text};
use crate::workspace::write_atomic;

/// No log is longer; a controller that gives more than this is not read to the end.
const MAX_LOG_BYTES: u64 = 16 * 1024 * 1024;
/// An honest controller fills its answers; this allows for answers that are a quarter full.
const MAX_ANSWERS: u64 = 4 * MAX_LOG_BYTES / LogChunk::MAX_BYTES as u64;
/// For all answers together.
const MAX_TIME: Duration = Duration::from_secs(120);

/// Reads the log of an OPC UA server (manual 6.3). It is switched on and off, and deleted, by
/// [`SetBasicSettings`](super::SetBasicSettings).
///
/// Reads what the log holds when this begins, at most 16 MiB, in at most 256 requests and 120 s;
/// [`LogChunk::next`] of the outcome says how far it came. Lines written meanwhile are left out.
///
/// # Errors
/// [`ErrorCode::NotAController`] if the controller's answers do not fit together: an answer that begins elsewhere than
/// asked for, or that goes on without text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReadLog {
    /// Which part is read.
    pub part: LogPart,
}

/// A part of the server log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LogPart {
    /// The last of it, up to 256 KiB: one request.
    End,
    /// All of it from this byte on.
    From(u64),
}

/// Reads the whole server log and saves it on the PC as text ([`untrusted_text::lines`]), readable by its owner only. A file of the same name is replaced. Limits and errors are those of [`ReadLog`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SaveLog {
    /// The file to be written.
    pub path: PathBuf,
}

/// The server log is in this file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LogSaved {
    /// The file that was written.
    pub path: PathBuf,
}

impl OperationOutput for LogSaved {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts { written: Some(&self.path), used: None, moved_aside: &[], shortcoming: None }
    }
}

/// [`LogChunk::text`] is what was asked for, however many requests that took.
impl OperationOutput for LogChunk {
    fn facts(&self) -> OutputFacts<'_> {
        OutputFacts::NONE
    }
}

#[async_trait]
impl Operation for ReadLog {
    type Output = LogChunk;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<LogChunk, Problem> {
        run.begin(JobStep::Read)?;
        let log = match self.part {
            LogPart::End => run.session.log(None).await?,
            LogPart::From(from) => read_from(from, run).await?,
        };
        Ok(log)
    }
}

#[async_trait]
impl Operation for SaveLog {
    type Output = LogSaved;

    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    fn must_be_finished(&self) -> bool {
        true
    }

    async fn run(&self, run: &mut OperationRun<'_>) -> Result<LogSaved, Problem> {
        run.begin(JobStep::Read)?;
        let text = read_from(0, run).await?.text;
        run.begin(JobStep::SaveBackup)?;
        let path = self.path.clone();
        run.off_thread(move || Ok(write_atomic(&path, untrusted_text::lines(&text).as_bytes())?)).await?;
        Ok(LogSaved { path: self.path.clone() })
    }
}

/// Everything from this byte to what is the end now, within the limits of [`ReadLog`].
async fn read_from(from: u64, run: &mut OperationRun<'_>) -> Result<LogChunk, Problem> {
    let until = Instant::now() + MAX_TIME;
    let first = run.session.log(Some(from)).await?;
    let end = first.size.min(first.from.saturating_add(MAX_LOG_BYTES));
    let mut whole = LogChunk { text: String::new(), next: first.from, ..first };
    let mut chunk = first;
    for answer in 1..=MAX_ANSWERS {
        // The log was deleted meanwhile.
        if chunk.size < whole.next {
            break;
        }
        let advance = chunk.next - chunk.from;
        if chunk.from != whole.next || (advance > 0 && chunk.text.is_empty()) || advance > LogChunk::MAX_BYTES as u64 {
            return Err(Problem::with_detail(ErrorCode::NotAController, "the pieces of its log do not fit together"));
        }
        whole.text.push_str(&chunk.text);
        whole.next = chunk.next;
        if advance == 0 || whole.next >= end || answer == MAX_ANSWERS || Instant::now() >= until {
            break;
        }
        run.begin(JobStep::Read)?;
        chunk = run.session.log(Some(whole.next)).await?;
    }
    Ok(whole)
}
