use async_trait::async_trait;

use super::{Confirmation, Operation, Outcome, Run, Step};
use crate::model::Problem;
use crate::protocol::LogChunk;

/// No log is longer; a controller that gives more than this is not read to the end.
const MAX_LOG_BYTES: usize = 16 * 1024 * 1024;

/// Reads the log of an OPC UA server (manual 6.3). It is switched on and off, and deleted, by
/// [`SetSettings`](super::SetSettings).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ReadLog {
    pub part: LogPart,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LogPart {
    /// The last of it, up to 256 KiB: one request.
    End,
    /// All of it from this byte on.
    From(u64),
}

#[async_trait]
impl Operation for ReadLog {
    fn confirmation(&self) -> Option<Confirmation> {
        None
    }

    async fn run(&self, run: &mut Run<'_>) -> Result<Outcome, Problem> {
        run.begin(Step::Read)?;
        let LogPart::From(from) = self.part else {
            return Ok(Outcome::Log(run.session.log(None).await?));
        };
        let mut whole = LogChunk { from, next: from, ..LogChunk::default() };
        loop {
            let chunk = run.session.log(Some(whole.next)).await?;
            let advanced = chunk.next > whole.next;
            whole.size = chunk.size;
            whole.next = chunk.next;
            whole.text.push_str(&chunk.text);
            if !advanced || whole.next >= whole.size || whole.text.len() >= MAX_LOG_BYTES {
                return Ok(Outcome::Log(whole));
            }
            run.begin(Step::Read)?;
        }
    }
}
