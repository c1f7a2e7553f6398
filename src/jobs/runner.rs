use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

use tokio::sync::Semaphore;
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use super::{JobController, JobStep, Operation, OperationOutput, OperationRun};
use crate::model::{ControllerInfo, Credentials, ErrorCode, Problem, RevisionToken};
use crate::pki::Fingerprint;
use crate::session::{Connectors, ControllerSession};
use crate::workspace::Passwords;

/// What every job needs and shares.
#[derive(Clone)]
pub struct JobContext {
    /// The driver of each kind of connection.
    pub connectors: Connectors,
    /// Where the connection passwords are looked up.
    pub passwords: Arc<dyn Passwords>,
    /// How many controllers are worked on at once.
    pub parallelism: usize,
    key_makers: Arc<Semaphore>,
}

impl std::fmt::Debug for JobContext {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("JobContext").field("parallelism", &self.parallelism).finish_non_exhaustive()
    }
}

impl JobContext {
    /// `parallelism`: at least 1 is used.
    pub fn new(connectors: impl Into<Connectors>, passwords: Arc<dyn Passwords>, parallelism: usize) -> Self {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        Self {
            connectors: connectors.into(),
            passwords,
            parallelism: parallelism.max(1),
            key_makers: Arc::new(Semaphore::new(cores)),
        }
    }

    /// The credentials of a controller; [`ErrorCode::PasswordMissing`] if none are known. They may come from a keyring
    /// that asks the user: read off the async threads.
    pub(super) async fn credentials(&self, fingerprint: Fingerprint) -> Result<Credentials, Problem> {
        let passwords = self.passwords.clone();
        tokio::task::spawn_blocking(move || passwords.get(fingerprint))
            .await
            .map_err(|e| Problem::with_detail(ErrorCode::Internal, e))??
            .ok_or_else(|| ErrorCode::PasswordMissing.into())
    }

    /// Opens a session with the driver of the controller's kind of connection.
    pub(super) async fn connect(
        &self,
        controller: &JobController,
        fingerprint: Fingerprint,
        credentials: &Credentials,
    ) -> Result<Box<dyn ControllerSession>, Problem> {
        self.connectors.get(controller.connection)?.connect(&controller.address, fingerprint, credentials).await
    }
}

/// The result of an operation for one controller. `O`: the operation's [`Operation::Output`].
#[derive(Debug, Clone, PartialEq)]
pub struct ControllerReport<O> {
    /// What the operation returned, or why it failed.
    pub result: Result<O, Problem>,
    /// The controller's information after the operation, whether that succeeded or not; `None` if it was not reached.
    pub info: Option<ControllerInfo>,
}

/// What happens while a job runs. `index` counts the job's controllers.
#[derive(Debug, Clone, PartialEq)]
pub enum JobEvent<O> {
    /// A controller has reached a step.
    Step {
        /// Position of the controller in the job.
        index: usize,
        /// The step.
        step: JobStep,
    },
    /// A controller is finished.
    Finished {
        /// Position of the controller in the job.
        index: usize,
        /// Its result.
        report: Box<ControllerReport<O>>,
    },
}

/// How a job ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct JobSummary {
    /// Controllers that succeeded.
    pub done: usize,
    /// Controllers that failed, without those that were cancelled.
    pub failed: usize,
    /// Cancelled before their turn, or before their change was sent.
    pub not_started: usize,
}

impl JobSummary {
    /// Counts one result.
    pub fn add<O>(&mut self, result: &Result<O, Problem>) {
        match result {
            Ok(_) => self.done += 1,
            Err(problem) if problem.code == ErrorCode::Cancelled => self.not_started += 1,
            Err(_) => self.failed += 1,
        }
    }
}

/// Does an operation to every controller, [`JobContext::parallelism`] at a time, in list order.
///
/// One failing never stops the others. After a cancel, controllers whose turn has not come are not started, and the
/// others stop after the step in hand. Every controller gets exactly one [`JobEvent::Finished`].
///
/// A turn ends with that event; its session is closed while the next one has its turn. At most as many sessions are
/// being closed as have their turn, and when this returns, all are.
pub async fn run<O: OperationOutput>(
    controllers: Vec<JobController>,
    operation: Arc<dyn Operation<Output = O>>,
    context: JobContext,
    cancel: CancellationToken,
    on_event: impl Fn(JobEvent<O>) + Send + Sync + 'static,
) -> JobSummary {
    let on_event = Arc::new(on_event);
    let at_once = context.parallelism.max(1);
    let mut summary = JobSummary::default();
    let mut waiting = controllers.into_iter().enumerate();
    let mut turns = JoinSet::new();
    let mut index_of = HashMap::new();
    let mut closing_sessions = JoinSet::new();
    loop {
        while turns.len() < at_once
            && let Some((index, controller)) = waiting.next()
        {
            let (operation, context, cancel) = (operation.clone(), context.clone(), cancel.clone());
            let on_event = on_event.clone();
            let turn = turns.spawn(async move {
                let on_step = |step| on_event(JobEvent::Step { index, step });
                one(&controller, operation.as_ref(), &context, &cancel, &on_step).await
            });
            index_of.insert(turn.id(), index);
        }
        let (id, turn) = match turns.join_next_with_id().await {
            None => break,
            Some(Ok((id, turn))) => (id, turn),
            Some(Err(e)) => (e.id(), TurnResult::failed(Problem::with_detail(ErrorCode::Internal, &e))),
        };
        summary.add(&turn.report.result);
        if let Some(index) = index_of.remove(&id) {
            on_event(JobEvent::Finished { index, report: Box::new(turn.report) });
        }
        if let Some(mut session) = turn.session {
            while closing_sessions.try_join_next().is_some() {}
            if closing_sessions.len() >= at_once {
                closing_sessions.join_next().await;
            }
            closing_sessions.spawn(async move { session.close().await });
        }
    }
    while closing_sessions.join_next().await.is_some() {}
    summary
}

/// A controller's turn is over.
struct TurnResult<O> {
    report: ControllerReport<O>,
    /// Still to be closed.
    session: Option<Box<dyn ControllerSession>>,
}

impl<O> TurnResult<O> {
    fn failed(problem: Problem) -> Self {
        Self { report: ControllerReport { result: Err(problem), info: None }, session: None }
    }
}

async fn one<O: OperationOutput>(
    controller: &JobController,
    operation: &dyn Operation<Output = O>,
    context: &JobContext,
    cancel: &CancellationToken,
    on_step: &(dyn Fn(JobStep) + Send + Sync),
) -> TurnResult<O> {
    if cancel.is_cancelled() {
        return TurnResult::failed(ErrorCode::Cancelled.into());
    }
    if let Err(problem) = operation.check(controller) {
        return TurnResult::failed(problem);
    }
    let Some(fingerprint) = controller.fingerprint else {
        return TurnResult::failed(ErrorCode::FingerprintUnknown.into());
    };
    let open = async {
        let credentials = context.credentials(fingerprint).await?;
        on_step(JobStep::Connect);
        let session = context.connect(controller, fingerprint, &credentials).await?;
        Ok((credentials, session))
    };
    // Nothing has been changed yet, so a cancel waits neither for a keyring that asks nor for a controller that does
    // not answer.
    let opened = tokio::select! {
        biased;
        () = cancel.cancelled() => Err(ErrorCode::Cancelled.into()),
        opened = open => opened,
    };
    let (credentials, mut session) = match opened {
        Ok(opened) => opened,
        Err(problem) => return TurnResult::failed(problem),
    };
    let result = operation
        .run(&mut OperationRun {
            controller,
            session: session.as_mut(),
            password: credentials.password(),
            key_makers: &context.key_makers,
            cancel,
            on_step,
        })
        .await;
    let unanswered = session.unanswered();
    let again = Rereading { controller, context, fingerprint, credentials: &credentials };
    // Also after a failure: the row must show what the controller is like now.
    let report = match result {
        Err(problem) if unanswered.is_some() || (is_silence(&problem) && operation.wanted_status().is_some()) => {
            again.determine_outcome(problem, unanswered, operation, cancel).await
        }
        Err(problem) if matches!(problem.code, ErrorCode::Timeout | ErrorCode::Unreachable) => {
            ControllerReport { result: Err(problem), info: None }
        }
        result => match (result, session.info().await) {
            (Ok(_), Err(problem)) if operation.is_information() => {
                ControllerReport { result: Err(problem), info: None }
            }
            // The change counts as done although the connection was lost afterwards.
            (Ok(output), Err(_)) => ControllerReport { result: Ok(output), info: again.read().await.ok() },
            (result, info) => ControllerReport { result, info: info.ok() },
        },
    };
    TurnResult { report, session: Some(session) }
}

/// Nothing came back.
fn is_silence(problem: &Problem) -> bool {
    matches!(problem.code, ErrorCode::Timeout | ErrorCode::ConnectionLost)
}

/// When a controller that did not answer is read again, each after the one before.
const READ_AGAIN: [Duration; 3] = [Duration::ZERO, Duration::from_secs(1), Duration::from_secs(2)];

/// A way to a controller besides the session that failed.
struct Rereading<'a> {
    controller: &'a JobController,
    context: &'a JobContext,
    fingerprint: Fingerprint,
    credentials: &'a Credentials,
}

impl Rereading<'_> {
    async fn read(&self) -> Result<ControllerInfo, Problem> {
        let mut session = self.context.connect(self.controller, self.fingerprint, self.credentials).await?;
        let info = session.info().await;
        session.close().await;
        info
    }

    /// A change was sent and nothing came back. The controller is read again, a few times at most:
    ///
    /// - Its revision is another than the one the change was based on: [`ErrorCode::AnswerLost`]. Not a success,
    ///   because what the answer carried is lost (a certificate to be backed up, a request to be saved), and because in
    ///   rare cases another program made the change; the row shows the state.
    /// - It is in the state that the start or stop should bring: done, also if another program did it.
    /// - Neither: what went wrong, saying that the change was not seen. The controller may still be at work on it.
    async fn determine_outcome<O: OperationOutput>(
        &self,
        problem: Problem,
        based_on: Option<RevisionToken>,
        operation: &dyn Operation<Output = O>,
        cancel: &CancellationToken,
    ) -> ControllerReport<O> {
        let mut last = None;
        for pause in READ_AGAIN {
            if cancel.is_cancelled() && last.is_some() {
                break;
            }
            tokio::time::sleep(pause).await;
            let Ok(info) = self.read().await else { continue };
            if let Some((wanted, output)) = operation.wanted_status()
                && info.status == wanted
            {
                return ControllerReport { result: Ok(output), info: Some(info) };
            }
            if let Some(before) = based_on.filter(|before| info.revision != *before) {
                let detail = format!("{}; revision {before} is now {}", problem.code.as_str(), info.revision);
                return ControllerReport {
                    result: Err(Problem::with_detail(ErrorCode::AnswerLost, detail)),
                    info: Some(info),
                };
            }
            last = Some(info);
        }
        let seen = match &last {
            Some(info) => format!("not applied when it was read again, revision {}", info.revision),
            None => "whether it was applied could not be read".to_owned(),
        };
        let detail = problem.detail.map_or(seen.clone(), |detail| format!("{detail}; {seen}"));
        ControllerReport { result: Err(Problem::with_detail(problem.code, detail)), info: last }
    }
}
