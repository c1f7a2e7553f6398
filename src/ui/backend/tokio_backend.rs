use std::collections::HashMap;
use std::io;
use std::sync::{Arc, mpsc};
use std::thread::JoinHandle;
use std::time::Duration;

use parking_lot::Mutex;
use secrecy::SecretString;
use tokio::runtime::Runtime;
use tokio::sync::mpsc::UnboundedSender;
use tokio_util::sync::CancellationToken;

use super::unfinished::{UnfinishedWork, WorkGuard};
use super::vault::StoreReporter;
use super::{Backend, VirtualFleetStarter, recorder, trust_files};
use crate::jobs::{self, JobContext, JobController, LiveRequest, RemoteControlRequest};
use crate::model::{ControllerInfo, Credentials, ErrorCode, Problem};
use crate::platform::display;
use crate::platform::stop_signal::StopSignals;
use crate::session::Connectors;
use crate::ui::model::{
    BackendCommand, BackendEvent, DroppedFile, ExportFound, FileContents, JobId, RecorderWork, Task,
};
use crate::ui::picker::FilePicker;
use crate::workspace::{
    self, Configuration, Passwords, SettingsFiles, ShowWindowOutcome, StartRequests, Workspace, WorkspaceLock,
};

/// How long dropping the backend waits for tasks that change nothing.
const SHUTDOWN: Duration = Duration::from_millis(500);

/// How long dropping the backend waits for the step in hand of a change: longer than a controller may take to answer
/// ([`ManagementTimeouts::change`](crate::session::ManagementTimeouts)). Reached only if the window went without
/// asking.
const FINISH: Duration = Duration::from_secs(150);

/// What the backend works with.
pub struct BackendOptions {
    /// The folder that files are read from and saved to.
    pub workspace: Workspace,
    /// Permission to write the configuration, held as long as the backend lives.
    pub lock: WorkspaceLock,
    /// Where connection passwords are looked up and kept.
    pub passwords: Arc<dyn Passwords>,
    /// The driver of each kind of connection.
    pub connectors: Connectors,
    /// `None`: the window does not offer virtual controllers.
    pub starter: Option<Arc<dyn VirtualFleetStarter>>,
    /// How a person chooses files.
    pub picker: Arc<dyn FilePicker>,
}

impl std::fmt::Debug for BackendOptions {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("BackendOptions").field("workspace", &self.workspace).finish_non_exhaustive()
    }
}

/// Runs jobs on a runtime of its own and saves on a thread of its own.
pub struct TokioBackend {
    workspace: Workspace,
    context: JobContext,
    starter: Option<Arc<dyn VirtualFleetStarter>>,
    picker: Arc<dyn FilePicker>,
    emit: Emit,
    store: Arc<StoreReporter>,
    events: mpsc::Receiver<BackendEvent>,
    running: HashMap<JobId, CancellationToken>,
    /// Takes requests to the running watches of live values.
    live: HashMap<JobId, UnboundedSender<LiveRequest>>,
    /// Takes requests to the running watches with remote commands.
    remote: HashMap<JobId, UnboundedSender<RemoteControlRequest>>,
    unfinished: UnfinishedWork,
    runtime: Option<Runtime>,
    saver: Option<Saver>,
    requests: Option<StartRequests>,
}

type Emit = Arc<dyn Fn(BackendEvent) + Send + Sync>;

struct Saver {
    queue: mpsc::Sender<Box<Configuration>>,
    thread: JoinHandle<()>,
}

impl std::fmt::Debug for TokioBackend {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("TokioBackend").field("workspace", &self.workspace).finish_non_exhaustive()
    }
}

impl TokioBackend {
    /// `wake` is called whenever [`Backend::poll`] has something new.
    pub fn new(options: BackendOptions, wake: impl Fn() + Send + Sync + 'static) -> io::Result<Self> {
        let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().thread_name("jobs").build()?;
        let (sender, events) = mpsc::channel();
        let wake = Arc::new(wake);
        let unfinished = UnfinishedWork::new({
            let wake = wake.clone();
            move || wake()
        });
        let emit: Emit = Arc::new(move |event| {
            // Fails only when the window is gone.
            if sender.send(event).is_ok() {
                wake();
            }
        });
        let requests = listen_for_starts(&options, &runtime, &emit);
        let saver = Saver::start(options.workspace.clone(), options.lock, emit.clone())?;
        let store = StoreReporter { passwords: options.passwords.clone(), emit: emit.clone(), last: Mutex::new(None) };
        let store = Arc::new(store);
        let first = store.clone();
        runtime.spawn_blocking(move || first.report());
        Ok(Self {
            store,
            workspace: options.workspace,
            context: JobContext::new(options.connectors, options.passwords, 1),
            starter: options.starter,
            picker: options.picker,
            emit,
            events,
            running: HashMap::new(),
            live: HashMap::new(),
            remote: HashMap::new(),
            unfinished,
            runtime: Some(runtime),
            saver: Some(saver),
            requests,
        })
    }

    /// From now on the system's requests to end arrive as [`BackendEvent::StopRequested`]; the second ends the program
    /// at once.
    pub fn receive_stop_signals(&self) {
        let emit = self.emit.clone();
        self.spawn(async move { StopSignals::listen().end_at_second(|| emit(BackendEvent::StopRequested)).await });
    }

    fn spawn(&self, work: impl Future<Output = ()> + Send + 'static) {
        if let Some(runtime) = &self.runtime {
            runtime.spawn(work);
        }
    }

    /// Blocking work that writes files.
    fn spawn_unfinished(&self, work: impl FnOnce() + Send + 'static) {
        let unfinished: WorkGuard = self.unfinished.begin();
        if let Some(runtime) = &self.runtime {
            runtime.spawn_blocking(move || {
                work();
                drop(unfinished);
            });
        }
    }

    fn token(&mut self, job: JobId) -> CancellationToken {
        self.running.retain(|_, token| !token.is_cancelled());
        let token = CancellationToken::new();
        self.running.insert(job, token.clone());
        token
    }

    fn run(
        &mut self,
        job: JobId,
        controllers: Vec<JobController>,
        task: &Task,
        parallelism: usize,
        password: Option<SecretString>,
    ) {
        let cancel = self.token(job);
        let task = task.clone();
        let unfinished = task.must_be_finished().then(|| self.unfinished.begin());
        let mut context = self.context.clone();
        context.parallelism = parallelism.max(1);
        let (emit, store) = (self.emit.clone(), self.store.clone());
        self.spawn(async move {
            if let Some(password) = password {
                let of = controllers.iter().filter_map(|c| c.fingerprint).collect();
                if let Err(problem) = remember(context.passwords.clone(), of, password).await {
                    emit(BackendEvent::PasswordNotKept(problem));
                }
            }
            let on_event = {
                let emit = emit.clone();
                move |event| emit(BackendEvent::Job { job, event })
            };
            let summary = task.run(controllers, context, cancel, Arc::new(on_event)).await;
            report(store).await;
            emit(BackendEvent::JobEnded { job, summary });
            drop(unfinished);
        });
    }

    fn recorder(&mut self, job: JobId, work: RecorderWork) {
        let (emit, stop) = (self.emit.clone(), self.token(job));
        // A file that is read may be left in the middle.
        let unfinished = work.writes().then(|| self.unfinished.begin());
        self.spawn(async move {
            recorder::run(work, stop, move |event| emit(BackendEvent::Recorder { job, event })).await;
            drop(unfinished);
        });
    }

    fn start_virtual(&self) {
        let Some(starter) = self.starter.clone() else { return };
        let (emit, passwords) = (self.emit.clone(), self.context.passwords.clone());
        self.spawn(async move {
            let result = async {
                let mut entries = Vec::new();
                for new in starter.start().await? {
                    if let Some(fingerprint) = new.entry.fingerprint {
                        // That a virtual controller's password is forgotten at the end is as it should be.
                        let _kept = remember(passwords.clone(), vec![fingerprint], new.password).await;
                    }
                    entries.push(new.entry);
                }
                Ok(entries)
            };
            emit(BackendEvent::VirtualStarted(result.await));
        });
    }
}

/// Without it, a second start says that the workspace is open, and shows nothing.
fn listen_for_starts(options: &BackendOptions, runtime: &Runtime, emit: &Emit) -> Option<StartRequests> {
    let requests = StartRequests::listen(options.workspace.root(), &options.lock);
    let requests =
        requests.inspect_err(|error| tracing::info!(%error, "a second start cannot show this window")).ok()?;
    let shown = if display::is_wayland() { ShowWindowOutcome::Marked } else { ShowWindowOutcome::InFront };
    let emit = emit.clone();
    runtime.spawn(requests.serve(shown, move || emit(BackendEvent::StartedAgain)));
    Some(requests)
}

/// A keyring may ask the user to unlock it: off the async threads. The last failure is reported.
async fn remember(
    passwords: Arc<dyn Passwords>,
    controllers: Vec<crate::pki::Fingerprint>,
    password: SecretString,
) -> Result<(), Problem> {
    let kept = tokio::task::spawn_blocking(move || {
        passwords.set_for(&controllers, &Credentials::ConnectionPassword(password))
    });
    Ok(kept.await.map_err(|e| Problem::with_detail(ErrorCode::Internal, e))??)
}

/// What the store is like, before the event of the work that may have changed it.
async fn report(store: Arc<StoreReporter>) {
    if let Err(error) = tokio::task::spawn_blocking(move || store.report()).await {
        tracing::error!(%error, "the state of the password store is not reported");
    }
}

/// The part of an export that is readable without its passphrase. An export that cannot be imported is a problem.
fn look_at_export(files: &SettingsFiles, of: &ControllerInfo) -> Result<ExportFound, Problem> {
    let (export, _) = files.load(&of.serial)?;
    export.check_for(&of.serial, of.series, of.firmware)?;
    Ok(ExportFound { exported: export.exported, firmware: export.firmware })
}

impl Backend for TokioBackend {
    fn send(&mut self, command: BackendCommand) {
        let emit = self.emit.clone();
        let context = self.context.clone();
        match command {
            BackendCommand::Run { job, controllers, task, parallelism, password } => {
                self.run(job, controllers, &task, parallelism, password);
            }
            BackendCommand::Probe { job, connection, address } => {
                let cancel = self.token(job);
                self.spawn(async move {
                    let probed = cancel.run_until_cancelled(jobs::probe(connection, &address, &context)).await;
                    if let Some(result) = probed {
                        emit(BackendEvent::Probed { job, result });
                    }
                });
            }
            BackendCommand::Enroll { job, connection, address, fingerprint, credentials } => {
                let (cancel, store) = (self.token(job), self.store.clone());
                let unfinished = self.unfinished.begin();
                self.spawn(async move {
                    let enrolling = jobs::enroll(connection, &address, fingerprint, credentials, &context);
                    if let Some(result) = cancel.run_until_cancelled(enrolling).await {
                        report(store).await;
                        emit(BackendEvent::Enrolled { job, result: result.map(Box::new) });
                    }
                    drop(unfinished);
                });
            }
            BackendCommand::LookAtExport { job, of, file } => {
                let files = self.workspace.settings_files();
                let files = file.map_or(files.clone(), |file| files.of_file(file));
                if let Some(runtime) = &self.runtime {
                    runtime.spawn_blocking(move || {
                        emit(BackendEvent::ExportSeen { job, result: look_at_export(&files, &of) });
                    });
                }
            }
            BackendCommand::Authority { job, work } => {
                let files = self.workspace.authority();
                self.spawn_unfinished(move || emit(BackendEvent::AuthorityDone { job, result: work.run(&files) }));
            }
            BackendCommand::Cancel(job) => {
                if let Some(token) = self.running.get(&job) {
                    token.cancel();
                }
            }
            BackendCommand::Vault(work) => {
                let store = self.store.clone();
                self.spawn_unfinished(move || {
                    let result = work.run(context.passwords.store());
                    store.report();
                    if let Some(result) = result {
                        emit(BackendEvent::VaultDone(result));
                    }
                });
            }
            BackendCommand::Forget(fingerprints) => {
                let store = self.store.clone();
                self.spawn_unfinished(move || {
                    fingerprints.into_iter().for_each(|f| context.passwords.forget(f));
                    store.report();
                });
            }
            BackendCommand::PickFile { job, kind, title } => {
                self.picker.pick(kind, title, Box::new(move |result| emit(BackendEvent::FilePicked { job, result })));
            }
            BackendCommand::PickTarget { job, kind, title, begin } => {
                let done = Box::new(move |result| emit(BackendEvent::FilePicked { job, result }));
                self.picker.pick_target(kind, title, begin, done);
            }
            BackendCommand::PickFolder { job, title, begin } => {
                let done = Box::new(move |result| emit(BackendEvent::FilePicked { job, result }));
                self.picker.pick_folder(title, begin, done);
            }
            BackendCommand::ReadFile { job, path, most } => {
                if let Some(runtime) = &self.runtime {
                    runtime.spawn_blocking(move || {
                        let result = workspace::read_import_file(&path, most).map_err(Problem::from);
                        emit(BackendEvent::FileRead { job, result: result.map(|bytes| (path, FileContents(bytes))) });
                    });
                }
            }
            BackendCommand::PickFiles { job, kind, title } => {
                self.picker.pick_several(
                    kind,
                    title,
                    Box::new(move |result| emit(BackendEvent::FilesPicked { job, result })),
                );
            }
            BackendCommand::ReadTrustFiles { job, paths } => {
                if let Some(runtime) = &self.runtime {
                    runtime.spawn_blocking(move || {
                        let files = paths.into_iter().map(trust_files::read).collect();
                        emit(BackendEvent::TrustFilesRead { job, files });
                    });
                }
            }
            BackendCommand::WatchTrust { job, controller } => {
                let cancel = self.token(job);
                self.spawn(async move {
                    let on_event = move |event| emit(BackendEvent::TrustSeen { job, event });
                    jobs::watch_trust(*controller, context, cancel, on_event).await;
                });
            }
            BackendCommand::WatchValues { job, controller, login } => {
                let cancel = self.token(job);
                let (sender, requests) = tokio::sync::mpsc::unbounded_channel();
                self.live.retain(|_, watch| !watch.is_closed());
                self.live.insert(job, sender);
                self.spawn(async move {
                    let on_event = move |event| emit(BackendEvent::LiveSeen { job, event });
                    jobs::watch_values(*controller, *login, context, requests, cancel, on_event).await;
                });
            }
            BackendCommand::AskValues { job, request } => {
                // A watch that has ended has told so.
                let _ended = self.live.get(&job).map(|watch| watch.send(request));
            }
            BackendCommand::ControlRemotely { job, connection } => {
                let cancel = self.token(job);
                let (sender, requests) = tokio::sync::mpsc::unbounded_channel();
                self.remote.retain(|_, watch| !watch.is_closed());
                self.remote.insert(job, sender);
                self.spawn(async move {
                    let on_event = move |event| emit(BackendEvent::RemoteSeen { job, event });
                    jobs::control_remotely(*connection, requests, cancel, on_event).await;
                });
            }
            BackendCommand::AskRemote { job, request } => {
                // A watch that has ended has told so.
                let _ended = self.remote.get(&job).map(|watch| watch.send(request));
            }
            BackendCommand::SaveText { path, text } => {
                self.spawn_unfinished(move || {
                    let saved = workspace::write_atomic(&path, text.as_bytes()).map_err(Problem::from);
                    emit(BackendEvent::TextSaved(saved.map(|()| path)));
                });
            }
            BackendCommand::Recorder { job, work } => self.recorder(job, work),
            BackendCommand::Recognise { job, paths } => {
                if let Some(runtime) = &self.runtime {
                    runtime.spawn_blocking(move || {
                        let files = paths.into_iter().map(|path| {
                            let found = workspace::recognise_file(&path).map_err(Problem::from);
                            DroppedFile { path, found }
                        });
                        emit(BackendEvent::Recognised { job, files: files.collect() });
                    });
                }
            }
            BackendCommand::OpenFolder(folder) => {
                let (picker, workspace) = (self.picker.clone(), self.workspace.clone());
                if let Some(runtime) = &self.runtime {
                    runtime.spawn_blocking(move || {
                        let made = workspace.make_folder(&folder).map_err(Problem::from);
                        if let Err(problem) = made.and_then(|()| picker.open_folder(&folder)) {
                            emit(BackendEvent::FolderNotOpened(problem));
                        }
                    });
                }
            }
            BackendCommand::StartVirtualControllers => self.start_virtual(),
            BackendCommand::Save(configuration) => {
                if let Some(saver) = &self.saver
                    && saver.queue.send(configuration).is_err()
                {
                    emit(BackendEvent::SaveFailed(Problem::with_detail(
                        ErrorCode::Internal,
                        "the saving thread ended",
                    )));
                }
            }
            // The window's own business.
            BackendCommand::Quit | BackendCommand::ShowWindow => {}
        }
    }

    fn poll(&mut self) -> Option<BackendEvent> {
        let event = self.events.try_recv().ok()?;
        if let BackendEvent::Recorder { job, event } = &event
            && event.is_last()
        {
            self.running.remove(job);
        }
        if let BackendEvent::JobEnded { job, .. }
        | BackendEvent::Probed { job, .. }
        | BackendEvent::Enrolled { job, .. } = &event
        {
            self.running.remove(job);
        }
        Some(event)
    }

    fn has_unfinished_work(&self) -> bool {
        !self.unfinished.is_empty()
    }
}

impl Drop for TokioBackend {
    /// Blocks until everything that was sent to be saved is saved, and until the step in hand of every change has
    /// ended.
    fn drop(&mut self) {
        for token in self.running.values() {
            token.cancel();
        }
        // Before the lock is given up: then the socket may be that of another window.
        self.requests = None;
        if let Some(Saver { queue, thread }) = self.saver.take() {
            drop(queue);
            if thread.join().is_err() {
                tracing::error!("the saving thread panicked");
            }
        }
        if !self.unfinished.wait(FINISH) {
            tracing::error!("a change was cut off: its step did not end within {} s", FINISH.as_secs());
        }
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_timeout(SHUTDOWN);
        }
    }
}

impl Saver {
    fn start(workspace: Workspace, lock: WorkspaceLock, emit: Emit) -> io::Result<Self> {
        let (queue, configurations) = mpsc::channel::<Box<Configuration>>();
        let thread = std::thread::Builder::new().name("save".into()).spawn(move || {
            workspace.remove_leftovers(&lock);
            while let Ok(mut configuration) = configurations.recv() {
                // Only the newest matters.
                while let Ok(newer) = configurations.try_recv() {
                    configuration = newer;
                }
                if let Err(error) = workspace.save(&configuration, &lock) {
                    emit(BackendEvent::SaveFailed(error.into()));
                }
            }
        })?;
        Ok(Self { queue, thread })
    }
}
