use std::collections::HashMap;
use std::sync::Arc;

use secrecy::SecretString;
use tokio::sync::Semaphore;
use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use super::{Operation, Outcome, Run, Step};
use crate::model::{Address, ControllerInfo, ControllerName, ErrorCode, Problem};
use crate::pki::Fingerprint;
use crate::session::Connector;
use crate::workspace::{ControllerEntry, Passwords};

/// A controller as a job sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct JobController {
    pub name: ControllerName,
    pub address: Address,
    pub fingerprint: Option<Fingerprint>,
    /// What was read last; lets an operation refuse before anything is sent.
    pub known: Option<ControllerInfo>,
}

impl From<&ControllerEntry> for JobController {
    fn from(entry: &ControllerEntry) -> Self {
        Self {
            name: entry.name.clone(),
            address: entry.address.clone(),
            fingerprint: entry.fingerprint,
            known: entry.last.as_ref().map(|last| last.info.clone()),
        }
    }
}

/// What every job needs and shares.
#[derive(Clone)]
pub struct JobContext {
    pub connector: Arc<dyn Connector>,
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
    pub fn new(connector: Arc<dyn Connector>, passwords: Arc<dyn Passwords>, parallelism: usize) -> Self {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        Self { connector, passwords, parallelism: parallelism.max(1), key_makers: Arc::new(Semaphore::new(cores)) }
    }

    /// Passwords may come from a keyring that asks the user: off the async threads.
    pub(super) async fn password(&self, fingerprint: Fingerprint) -> Result<SecretString, Problem> {
        let passwords = self.passwords.clone();
        tokio::task::spawn_blocking(move || passwords.get(fingerprint))
            .await
            .map_err(|e| Problem::with_detail(ErrorCode::Internal, e))?
            .ok_or_else(|| ErrorCode::PasswordMissing.into())
    }
}

/// What came of one controller's turn.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    pub result: Result<Outcome, Problem>,
    /// The controller's information after the operation, whether that succeeded or not; `None` if it was not reached.
    pub info: Option<ControllerInfo>,
}

/// What happens while a job runs. `index` counts the job's controllers.
#[derive(Debug, Clone, PartialEq)]
pub enum JobEvent {
    Step { index: usize, step: Step },
    Finished { index: usize, report: Box<Report> },
}

/// How a job ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Summary {
    pub done: usize,
    pub failed: usize,
    /// Cancelled before their turn, or before their change was sent.
    pub not_started: usize,
}

impl Summary {
    pub fn add(&mut self, result: &Result<Outcome, Problem>) {
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
pub async fn run(
    controllers: Vec<JobController>,
    operation: Arc<dyn Operation>,
    context: JobContext,
    cancel: CancellationToken,
    on_event: impl Fn(JobEvent) + Send + Sync + 'static,
) -> Summary {
    let on_event = Arc::new(on_event);
    let turns = Arc::new(Semaphore::new(context.parallelism));
    let mut tasks = JoinSet::new();
    let mut index_of = HashMap::new();
    for (index, controller) in controllers.into_iter().enumerate() {
        let (operation, context, cancel) = (operation.clone(), context.clone(), cancel.clone());
        let (turns, on_event) = (turns.clone(), on_event.clone());
        let task = tasks.spawn(async move {
            let _turn = tokio::select! {
                biased;
                () = cancel.cancelled() => return not_started(),
                turn = turns.acquire() => turn,
            };
            let on_step = |step| on_event(JobEvent::Step { index, step });
            one(&controller, operation.as_ref(), &context, &cancel, &on_step).await
        });
        index_of.insert(task.id(), index);
    }
    let mut summary = Summary::default();
    while let Some(joined) = tasks.join_next_with_id().await {
        let (id, report) = match joined {
            Ok((id, report)) => (id, report),
            Err(e) => {
                let problem = Problem::with_detail(ErrorCode::Internal, &e);
                (e.id(), Report { result: Err(problem), info: None })
            }
        };
        summary.add(&report.result);
        if let Some(index) = index_of.get(&id) {
            on_event(JobEvent::Finished { index: *index, report: Box::new(report) });
        }
    }
    summary
}

fn not_started() -> Report {
    Report { result: Err(ErrorCode::Cancelled.into()), info: None }
}

async fn one(
    controller: &JobController,
    operation: &dyn Operation,
    context: &JobContext,
    cancel: &CancellationToken,
    on_step: &(dyn Fn(Step) + Send + Sync),
) -> Report {
    let failed = |problem| Report { result: Err(problem), info: None };
    if let Err(problem) = operation.check(controller) {
        return failed(problem);
    }
    let Some(fingerprint) = controller.fingerprint else {
        return failed(ErrorCode::FingerprintUnknown.into());
    };
    let password = match context.password(fingerprint).await {
        Ok(password) => password,
        Err(problem) => return failed(problem),
    };
    on_step(Step::Connect);
    // Nothing has been changed yet, so a cancel need not wait for a controller that does not answer.
    let connected = tokio::select! {
        biased;
        () = cancel.cancelled() => return not_started(),
        connected = context.connector.connect(&controller.address, fingerprint, &password) => connected,
    };
    let mut session = match connected {
        Ok(session) => session,
        Err(problem) => return failed(problem),
    };
    let result = operation
        .run(&mut Run {
            controller,
            session: session.as_mut(),
            password: &password,
            key_makers: &context.key_makers,
            cancel,
            on_step,
        })
        .await;
    // Also after a failure: the row must show what the controller is like now.
    let reachable = !matches!(&result, Err(p) if matches!(p.code, ErrorCode::Timeout | ErrorCode::Unreachable));
    let info = if reachable { session.info().await.ok() } else { None };
    session.close().await;
    match (result, info) {
        (Ok(_), None) => failed(ErrorCode::ConnectionLost.into()),
        (result, info) => Report { result, info },
    }
}
