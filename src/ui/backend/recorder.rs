//! Recording, and reading recordings.

use tokio_util::sync::CancellationToken;

use crate::jobs;
use crate::model::{ErrorCode, Problem};
use crate::recorder::{self, RecorderError};
use crate::ui::model::{RecorderEvent, RecorderWork};

/// Does the work, and tells what comes of it. `stop` ends it early: a recording completes its files.
pub async fn run(work: RecorderWork, stop: CancellationToken, tell: impl Fn(RecorderEvent) + Send + Sync) {
    let last = match work {
        RecorderWork::Record(request) => {
            let end = jobs::record(*request, stop, |event| tell(RecorderEvent::Seen(event))).await;
            RecorderEvent::Ended(Box::new(end))
        }
        RecorderWork::Recover(folder) => {
            let recovered = blocking(move || Ok(recorder::recover(&folder))).await;
            let told = |recovered: Vec<Result<_, RecorderError>>| {
                recovered.into_iter().map(|one| one.map_err(Problem::from)).collect()
            };
            RecorderEvent::Recovered(recovered.map_or_else(|problem| vec![Err(problem)], told))
        }
        RecorderWork::Describe(file) => {
            RecorderEvent::Described(blocking(move || recorder::header_of(&file)).await.map(Box::new))
        }
        RecorderWork::Load { file, values } => {
            RecorderEvent::Loaded(blocking(move || recorder::load(&file, &values, &stop)).await.map(Box::new))
        }
    };
    tell(last);
}

/// Off the async threads. A library that panics at a damaged file does not leave the window waiting.
async fn blocking<T: Send + 'static>(
    work: impl FnOnce() -> Result<T, RecorderError> + Send + 'static,
) -> Result<T, Problem> {
    match tokio::task::spawn_blocking(work).await {
        Ok(result) => Ok(result?),
        Err(error) => Err(Problem::with_detail(ErrorCode::Internal, error)),
    }
}
