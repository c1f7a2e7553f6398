use std::time::Duration;

use tokio_util::sync::CancellationToken;

use super::TrustSnapshot;
use crate::jobs::{JobContext, JobController};
use crate::model::{ErrorCode, Problem};
use crate::session::ControllerSession;

/// How often a controller is asked whether anything is new.
pub const WATCH_INTERVAL: Duration = Duration::from_secs(1);

/// What [`watch_trust`] sees.
#[derive(Debug, Clone, PartialEq)]
pub enum WatchEvent {
    /// At first, after every reconnection, and whenever anything is another than before.
    Lists(Box<TrustSnapshot>),
    /// The controller cannot be asked just now. It is tried again.
    Lost(Problem),
    /// Trying again would not help, such as with a wrong password, which would lock this computer out in the end. The
    /// watch is over.
    Ended(Problem),
}

/// Keeps the lists of one controller fresh, as long as a dialog shows them: reports them at first and whenever they
/// change, until cancelled.
///
/// One session of its own, beside those of jobs (a controller takes many, and answers questions while it is being
/// changed), kept from idling by a small question every [`WATCH_INTERVAL`]; the lists are read only when the answer is
/// another. A lost connection is opened again, at first at once, then after pauses of up to 15 s.
pub async fn watch_trust(
    controller: JobController,
    context: JobContext,
    cancel: CancellationToken,
    on_event: impl Fn(WatchEvent) + Send + Sync,
) {
    let Some(fingerprint) = controller.fingerprint else {
        return on_event(WatchEvent::Ended(ErrorCode::FingerprintUnknown.into()));
    };
    let mut pause = FIRST_PAUSE;
    loop {
        let mut session = None;
        let watching = async {
            let credentials = context.credentials(fingerprint).await?;
            let session = session.insert(context.connect(&controller, fingerprint, &credentials).await?);
            watch(session.as_mut(), &mut pause, &on_event).await
        };
        let ended = tokio::select! {
            () = cancel.cancelled() => None,
            Err(problem) = watching => Some(problem),
        };
        // A controller has room for few sessions; one whose connection was lost ends there by itself.
        let is_lost = ended.as_ref().is_some_and(|problem| is_lost(problem.code));
        if let Some(mut session) = session.filter(|_| !is_lost) {
            session.close().await;
        }
        match ended {
            None => return,
            Some(problem) if problem.code.is_lasting() => return on_event(WatchEvent::Ended(problem)),
            // The controller was restarted, or the session was given up for others: nothing to tell.
            Some(problem) if problem.code == ErrorCode::SessionExpired => {}
            Some(problem) => on_event(WatchEvent::Lost(problem)),
        }
        tokio::select! {
            () = cancel.cancelled() => return,
            () = tokio::time::sleep(pause) => pause = (pause * 2).min(LAST_PAUSE),
        }
    }
}

const fn is_lost(code: ErrorCode) -> bool {
    use ErrorCode::*;
    matches!(code, ConnectionLost | Unreachable | HandshakeLost | Timeout | SessionExpired)
}

const FIRST_PAUSE: Duration = Duration::from_millis(500);
const LAST_PAUSE: Duration = Duration::from_secs(15);

/// Ends only with a failure.
async fn watch(
    session: &mut dyn ControllerSession,
    pause: &mut Duration,
    on_event: &(impl Fn(WatchEvent) + Send + Sync),
) -> Result<std::convert::Infallible, Problem> {
    loop {
        // Before the lists: what changes while they are read is seen at the next look.
        let stamp = session.trust_stamp().await?;
        on_event(WatchEvent::Lists(Box::new(TrustSnapshot::read(session).await?)));
        *pause = FIRST_PAUSE;
        loop {
            tokio::time::sleep(WATCH_INTERVAL).await;
            if session.trust_stamp().await? != stamp {
                break;
            }
        }
    }
}
