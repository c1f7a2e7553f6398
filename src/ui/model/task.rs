//! What a job does to each of its controllers, and what the window does with the results.

use std::any::Any;
use std::fmt;
use std::path::{Path, PathBuf};
use std::pin::Pin;
use std::sync::Arc;

use tokio_util::sync::CancellationToken;

use super::{Commands, Dialog, Footer, Model, RowId};
use crate::jobs::{
    self, Confirmation, ControllerReport, JobContext, JobController, JobEvent, JobStep, JobSummary, Operation,
    OperationOutput,
};
use crate::model::{ControllerInfo, Problem};
use crate::texts::TextKey;

/// Takes in the result for one controller. Called on the window's thread.
type OnResult<O> = Arc<dyn Fn(&mut Model, RowId, Result<O, Problem>) -> Commands + Send + Sync>;
/// Hands one result to the feature that started the task.
type Deliver = Box<dyn FnOnce(&mut Model, RowId) -> Commands + Send>;

/// A step of a feature without a result. Called on the window's thread.
type Hook = Arc<dyn Fn(&mut Model) -> Commands + Send + Sync>;

/// An operation, what the window calls it, and which functions of a feature get its results.
///
/// The feature that starts a job makes its task; the window and the backend run it without knowing the operation.
#[derive(Clone)]
pub struct Task {
    /// Names the job in the title of its dialogs.
    pub title: TextKey,
    /// The label of the button that agrees to it: the act itself. Default: OK, for what only reads.
    pub act: TextKey,
    /// What the confirmation says first, besides what follows from [`Confirmation`].
    pub remark: Option<TextKey>,
    /// Whether the processing dialog shows its progress and results. Default: it does.
    pub is_shown: bool,
    /// Nothing to read when all went well: the status bar says so and no click is asked for.
    pub is_quiet: bool,
    /// Whether a server that runs was started by it, or anew for it.
    pub restarts_server: bool,
    /// Whether passwords it lacks are asked for. Default: they are.
    pub asks_passwords: bool,
    /// What the feature adds to the processing dialog after the end.
    pub footer: Option<Footer>,
    close_waiting: Option<fn(&mut Model)>,
    on_end: Option<Hook>,
    without_password: Option<Hook>,
    on_closed: Option<Hook>,
    work: Arc<dyn Work>,
}

impl Task {
    /// A task whose results only the processing dialog shows.
    pub fn new<O: OperationOutput>(title: TextKey, operation: impl Operation<Output = O> + 'static) -> Self {
        Self::with_results(title, operation, |_, _, _| vec![])
    }

    /// A task whose results a feature gets: `on_result` is called once for each controller, in the order in which
    /// they finish.
    pub fn with_results<O: OperationOutput>(
        title: TextKey,
        operation: impl Operation<Output = O> + 'static,
        on_result: impl Fn(&mut Model, RowId, Result<O, Problem>) -> Commands + Send + Sync + 'static,
    ) -> Self {
        Self {
            title,
            act: TextKey::Ok,
            remark: None,
            is_shown: true,
            is_quiet: false,
            restarts_server: false,
            asks_passwords: true,
            footer: None,
            close_waiting: None,
            on_end: None,
            without_password: None,
            on_closed: None,
            work: Arc::new(TypedWork { operation: Arc::new(operation), results: Results(Arc::new(on_result)) }),
        }
    }

    /// What the button says that agrees to it.
    pub fn act(self, act: TextKey) -> Self {
        Self { act, ..self }
    }

    /// A sentence that the confirmation shows besides its own.
    pub fn remark(self, remark: TextKey) -> Self {
        Self { remark: Some(remark), ..self }
    }

    /// No click is asked for when all went well.
    pub fn quiet(self) -> Self {
        Self { is_quiet: true, ..self }
    }

    /// The servers of its controllers run anew after it.
    pub fn restarts_server(self) -> Self {
        Self { restarts_server: true, ..self }
    }

    /// The processing dialog is not opened.
    pub fn in_background(self) -> Self {
        Self { is_shown: false, ..self }
    }

    /// A dialog of this type waits for the results; the processing dialog is not opened. A failure closes that dialog.
    pub fn for_dialog<D: Dialog>(self) -> Self {
        Self { close_waiting: Some(Model::close_after_failure::<D>), ..self.in_background() }
    }

    /// See [`Task::footer`](field@Task::footer).
    pub fn footer(self, footer: Footer) -> Self {
        Self { footer: Some(footer), ..self }
    }

    /// Its failure is not shown, and no password is asked for.
    pub fn optional(self) -> Self {
        Self { asks_passwords: false, ..self.in_background() }.on_end(|model| {
            model.job = None;
            vec![]
        })
    }

    /// Called when all controllers are finished, instead of what the window does by itself: for a task that is shown,
    /// the processing dialog stays open with the first failure; for one that a dialog waits for, a failure closes that
    /// dialog and is shown.
    pub fn on_end(self, hook: impl Fn(&mut Model) -> Commands + Send + Sync + 'static) -> Self {
        Self { on_end: Some(Arc::new(hook)), ..self }
    }

    /// Called when passwords were asked for and none was given. Default: what [`Task::on_end`] does, or else the dialog
    /// that waits is closed.
    pub fn without_password(self, hook: impl Fn(&mut Model) -> Commands + Send + Sync + 'static) -> Self {
        Self { without_password: Some(Arc::new(hook)), ..self }
    }

    /// Called when the processing dialog was closed after the end.
    pub fn on_closed(self, hook: impl Fn(&mut Model) -> Commands + Send + Sync + 'static) -> Self {
        Self { on_closed: Some(Arc::new(hook)), ..self }
    }

    /// Closes the dialog that waits for the results.
    pub(in crate::ui) fn close_waiting(&self, model: &mut Model) {
        if let Some(close) = self.close_waiting {
            close(model);
        }
    }

    pub(in crate::ui) fn end_hook(&self) -> Option<Hook> {
        self.on_end.clone()
    }

    pub(in crate::ui) fn password_hook(&self) -> Option<Hook> {
        self.without_password.clone().or_else(|| self.on_end.clone())
    }

    pub(in crate::ui) fn closed_hook(&self) -> Option<Hook> {
        self.on_closed.clone()
    }

    /// What must be agreed to first; `None` when nothing is changed.
    pub fn confirmation(&self) -> Option<Confirmation> {
        self.work.confirmation()
    }

    /// Whether the program has to stay until the step in hand has ended.
    pub fn must_be_finished(&self) -> bool {
        self.work.must_be_finished()
    }

    /// Runs the operation, as [`jobs::run`] does.
    pub fn run(
        &self,
        controllers: Vec<JobController>,
        context: JobContext,
        cancel: CancellationToken,
        on_event: Arc<dyn Fn(TaskEvent) + Send + Sync>,
    ) -> Pin<Box<dyn Future<Output = JobSummary> + Send>> {
        self.work.run(controllers, context, cancel, on_event)
    }

    /// The operation, if it is a `P`.
    pub fn operation<P: Operation + 'static>(&self) -> Option<&P> {
        self.work.operation().downcast_ref()
    }

    /// The event of a result, for a backend that plays results back instead of running the operation. `None` if the
    /// results of the operation are of another type.
    pub fn finished<O: OperationOutput>(&self, index: usize, report: ControllerReport<O>) -> Option<TaskEvent> {
        let results: &Results<O> = self.work.results().downcast_ref()?;
        Some(results.event(JobEvent::Finished { index, report: Box::new(report) }))
    }

    /// As [`Task::finished`], for a controller that the operation failed for.
    pub fn failed(&self, index: usize, problem: Problem) -> TaskEvent {
        self.work.failed(index, problem)
    }
}

impl fmt::Debug for Task {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Task").field("title", &self.title).field("work", &self.work).finish_non_exhaustive()
    }
}

/// What happens while a task runs. `index` counts the job's controllers.
#[derive(Debug)]
pub enum TaskEvent {
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
        report: Box<TaskReport>,
    },
}

/// A [`ControllerReport`] whose result only the feature that started the task can look at.
pub struct TaskReport {
    /// What the processing dialog shows, or why it failed.
    pub result: Result<TaskFacts, Problem>,
    /// The controller's information after the operation; `None` if it was not reached.
    pub info: Option<ControllerInfo>,
    deliver: Deliver,
}

impl TaskReport {
    /// Hands the result to the feature that started the task.
    pub(in crate::ui) fn deliver(self, model: &mut Model, row: RowId) -> Commands {
        (self.deliver)(model, row)
    }
}

impl fmt::Debug for TaskReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("TaskReport").field("result", &self.result).finish_non_exhaustive()
    }
}

/// What the processing dialog shows of any result: see [`OutputFacts`](jobs::OutputFacts).
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct TaskFacts {
    /// The file that was written.
    pub written: Option<PathBuf>,
    /// The file that was read.
    pub used: Option<PathBuf>,
    /// Files of an earlier set that were moved aside.
    pub moved_aside: Vec<PathBuf>,
}

impl TaskFacts {
    fn of(output: &impl OperationOutput) -> Self {
        // A report of its own shows a shortcoming.
        let jobs::OutputFacts { written, used, moved_aside, shortcoming: _ } = output.facts();
        Self { written: written.map(Path::to_owned), used: used.map(Path::to_owned), moved_aside: moved_aside.to_vec() }
    }
}

/// A [`Task`]'s operation without its type.
trait Work: fmt::Debug + Send + Sync {
    fn confirmation(&self) -> Option<Confirmation>;
    fn must_be_finished(&self) -> bool;
    fn operation(&self) -> &dyn Any;
    fn results(&self) -> &dyn Any;
    fn failed(&self, index: usize, problem: Problem) -> TaskEvent;
    fn run(
        &self,
        controllers: Vec<JobController>,
        context: JobContext,
        cancel: CancellationToken,
        on_event: Arc<dyn Fn(TaskEvent) + Send + Sync>,
    ) -> Pin<Box<dyn Future<Output = JobSummary> + Send>>;
}

struct TypedWork<P: Operation> {
    operation: Arc<P>,
    results: Results<P::Output>,
}

/// Where the results of an operation go.
struct Results<O>(OnResult<O>);

impl<O> Clone for Results<O> {
    fn clone(&self) -> Self {
        Self(self.0.clone())
    }
}

impl<O: OperationOutput> Results<O> {
    fn event(&self, event: JobEvent<O>) -> TaskEvent {
        match event {
            JobEvent::Step { index, step } => TaskEvent::Step { index, step },
            JobEvent::Finished { index, report } => {
                let ControllerReport { result, info } = *report;
                let facts = result.as_ref().map(TaskFacts::of).map_err(Clone::clone);
                let on_result = self.0.clone();
                let deliver = Box::new(move |model: &mut Model, row| on_result(model, row, result));
                TaskEvent::Finished { index, report: Box::new(TaskReport { result: facts, info, deliver }) }
            }
        }
    }
}

impl<P: Operation> fmt::Debug for TypedWork<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.operation.fmt(f)
    }
}

impl<P: Operation + 'static> Work for TypedWork<P> {
    fn confirmation(&self) -> Option<Confirmation> {
        self.operation.confirmation()
    }

    fn must_be_finished(&self) -> bool {
        self.operation.must_be_finished()
    }

    fn operation(&self) -> &dyn Any {
        self.operation.as_ref()
    }

    fn results(&self) -> &dyn Any {
        &self.results
    }

    fn failed(&self, index: usize, problem: Problem) -> TaskEvent {
        let report = Box::new(ControllerReport { result: Err(problem), info: None });
        self.results.event(JobEvent::Finished { index, report })
    }

    fn run(
        &self,
        controllers: Vec<JobController>,
        context: JobContext,
        cancel: CancellationToken,
        on_event: Arc<dyn Fn(TaskEvent) + Send + Sync>,
    ) -> Pin<Box<dyn Future<Output = JobSummary> + Send>> {
        let operation: Arc<dyn Operation<Output = P::Output>> = self.operation.clone();
        let results = self.results.clone();
        Box::pin(jobs::run(controllers, operation, context, cancel, move |event| on_event(results.event(event))))
    }
}
