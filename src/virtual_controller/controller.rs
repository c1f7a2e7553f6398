use std::net::{IpAddr, SocketAddr};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use parking_lot::{Mutex, RwLock};
use thiserror::Error;
use tokio::net::TcpListener;
use tokio::sync::Mutex as AsyncMutex;
use tokio::task::{JoinHandle, spawn_blocking};
use tokio_util::sync::CancellationToken;

use super::api::Api;
use super::faults::{DropPoint, Faults};
use super::new_controller::NewController;
use super::opcua::{Clock, DeviceIdentity, Events, OpcUaConfig, OpcUaServer, OpcUaUser, StartError};
use super::server_log::ServerLog;
use super::settings_transfer;
use super::state::{Listed, State, Surroundings};
use super::store::{Store, StoreError};
use super::{listener as management, memory, tls};
use crate::model::{
    ClientList, ControllerInfo, ControllerName, ControllerSeries, ErrorCode, FirmwareGeneration, FirmwareVersion,
    Problem, SerialNumber, ServerSettings, ServerStatus, StartupMode, UserName,
};
use crate::pki::{Certificate, Fingerprint, TrustLists, TrustPolicy};
use crate::protocol::{
    Changed, HeldCertificate, HeldCertificates, ListedCertificate, LogChunk, Revisioned, SettingsExport, WireSecret,
};

/// Where a virtual controller lives and answers, and what it is if its folder holds none yet.
#[derive(Debug, Clone)]
pub struct ControllerSpec {
    /// The controller's own folder; made if missing. A state found there wins over `initial`.
    pub folder: PathBuf,
    /// The address its management protocol and its OPC UA server listen on.
    pub bind: IpAddr,
    /// The port of the management protocol; 0 takes a free one.
    pub management_port: u16,
    pub initial: NewController,
}

/// One virtual controller, switched on: its management protocol answers, and its OPC UA server runs when it should.
///
/// Dropped without [`VirtualController::shutdown`], it stops too, but nobody waits for it.
#[derive(Debug)]
pub struct VirtualController {
    controller: Arc<Controller>,
    address: SocketAddr,
    fingerprint: Fingerprint,
    off: CancellationToken,
    api: Mutex<Option<JoinHandle<()>>>,
}

/// Why a virtual controller could not be switched on.
#[derive(Debug, Error)]
pub enum SwitchOnError {
    #[error(transparent)]
    Store(#[from] StoreError),
    #[error("{0}")]
    Initial(Problem),
    #[error("the management identity cannot be used: {0}")]
    Tls(#[from] rustls::Error),
    #[error("cannot listen on {address}: {source}")]
    Listen { address: SocketAddr, source: std::io::Error },
    #[error("a worker thread died")]
    Worker,
}

impl VirtualController {
    /// Switches the controller on. With startup mode AUTO its OPC UA server is started too; should that fail, the
    /// controller is up all the same and says so in its status.
    pub async fn start(spec: ControllerSpec) -> Result<Self, SwitchOnError> {
        let address = SocketAddr::new(spec.bind, spec.management_port);
        let listen = |source| SwitchOnError::Listen { address, source };
        let listener = TcpListener::bind(address).await.map_err(listen)?;
        let address = listener.local_addr().map_err(listen)?;

        let faults = Faults::default();
        let store = Store::open(&spec.folder, faults.clone())?;
        let around = Surroundings { now: faults.now(), bind: spec.bind, management_port: address.port() };
        let (store, state) = spawn_blocking(move || {
            let state = match store.load()? {
                Some(state) => state,
                None => {
                    let state = spec.initial.make(&around).map_err(SwitchOnError::Initial)?;
                    store.save(&state)?;
                    state
                }
            };
            Ok::<_, SwitchOnError>((store, state))
        })
        .await
        .map_err(|_| SwitchOnError::Worker)??;

        let config = tls::server_config(&state.management)?;
        let fingerprint = Fingerprint::of(&state.management.certificate.0);
        let auto = state.settings.startup == StartupMode::Auto;
        let log = Arc::new(ServerLog::new(&spec.folder, faults.clone()));
        let controller = Arc::new(Controller {
            state: RwLock::new(Arc::new(state)),
            store: Arc::new(store),
            faults,
            log,
            folder: spec.folder,
            bind: spec.bind,
            management_port: address.port(),
            server: AsyncMutex::new(Plant { server: None, off: false }),
            standing: Mutex::new(Standing::Stopped),
        });
        if auto && let Err(problem) = controller.start_server_now().await {
            tracing::warn!(serial = %controller.state().identity.serial, %problem, "the OPC UA server did not start");
        }
        let off = CancellationToken::new();
        tokio::spawn(stop_when_log_is_full(Arc::clone(&controller), off.clone()));
        let api =
            tokio::spawn(management::serve(listener, config, Arc::new(Api::new(Arc::clone(&controller))), off.clone()));
        Ok(Self { controller, address, fingerprint, off, api: Mutex::new(Some(api)) })
    }

    /// Where the management protocol answers.
    pub fn management_address(&self) -> SocketAddr {
        self.address
    }

    /// [`Self::management_address`] as a program on this machine reaches it, also when the controller listens on every
    /// address.
    pub fn reachable_address(&self) -> SocketAddr {
        SocketAddr::new(self.controller.surroundings().address(), self.address.port())
    }

    /// SHA-256 of the management identity, which a configurator pins.
    pub fn fingerprint(&self) -> Fingerprint {
        self.fingerprint
    }

    /// `opc.tcp://host:port` of the OPC UA server, running or not.
    pub fn endpoint(&self) -> String {
        self.controller.endpoint(None)
    }

    pub fn info(&self) -> ControllerInfo {
        self.controller.info(None)
    }

    /// The switches that make this controller misbehave.
    pub fn faults(&self) -> Faults {
        self.controller.faults.clone()
    }

    pub fn serial(&self) -> SerialNumber {
        self.controller.state().identity.serial.clone()
    }

    pub fn series(&self) -> ControllerSeries {
        self.controller.state().identity.series
    }

    pub fn firmware(&self) -> FirmwareVersion {
        self.controller.state().identity.firmware
    }

    pub fn name(&self) -> ControllerName {
        self.controller.state().identity.name.clone()
    }

    /// Everything the controller remembers, as it is now.
    pub fn state(&self) -> Arc<State> {
        self.controller.state()
    }

    /// Switches the controller off: a change in hand is finished, the OPC UA server stopped, every connection closed.
    pub async fn shutdown(&self) {
        self.off.cancel();
        self.controller.switch_off().await;
        let api = self.api.lock().take();
        if let Some(api) = api
            && let Err(error) = api.await
        {
            tracing::error!(%error, "the management server died");
        }
    }
}

impl Drop for VirtualController {
    fn drop(&mut self) {
        self.off.cancel();
    }
}

/// The controller behind the management protocol.
///
/// Questions read a snapshot and never wait. Changes, start and stop take their turn at [`Controller::server`].
#[derive(Debug)]
pub(super) struct Controller {
    state: RwLock<Arc<State>>,
    store: Arc<Store>,
    faults: Faults,
    log: Arc<ServerLog>,
    folder: PathBuf,
    bind: IpAddr,
    management_port: u16,
    server: AsyncMutex<Plant>,
    standing: Mutex<Standing>,
}

#[derive(Debug)]
struct Plant {
    server: Option<OpcUaServer>,
    /// The controller is switched off; nothing begins any more.
    off: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Standing {
    Stopped,
    Running,
    /// Why the server is not running although it should be, until the next start or stop that succeeds.
    Failed(ErrorCode),
}

/// What a change means for a running OPC UA server.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Effect {
    /// It has to be stopped and started with the new configuration.
    Restart,
    /// It takes over the list of trusted clients as it runs.
    TrustedClients,
    /// Its certificate may be gone. Without one it stops for good; otherwise it does not notice.
    CertificateLost,
    /// It does not notice.
    Nothing,
}

/// How a change, a start or a stop did not succeed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Outcome {
    Problem(Problem),
    /// A fault switch asks for the connection to be lost here.
    Dropped,
}

impl From<Problem> for Outcome {
    fn from(problem: Problem) -> Self {
        Self::Problem(problem)
    }
}

impl From<StoreError> for Outcome {
    fn from(error: StoreError) -> Self {
        Self::Problem(error.into())
    }
}

const RESTORE_ATTEMPTS: u32 = 3;
const RESTORE_PAUSE: std::time::Duration = std::time::Duration::from_millis(100);

impl Controller {
    pub(super) fn state(&self) -> Arc<State> {
        Arc::clone(&self.state.read())
    }

    pub(super) fn faults(&self) -> &Faults {
        &self.faults
    }

    /// `reached`: the address the asking client used, which names the controller when it listens on every one.
    pub(super) fn info(&self, reached: Option<IpAddr>) -> ControllerInfo {
        let (status, error) = self.status();
        let (state, around) = (self.state(), self.surroundings());
        ControllerInfo {
            name: state.identity.name.to_string(),
            serial: state.identity.serial.clone(),
            series: state.identity.series,
            firmware: state.identity.firmware,
            status,
            error,
            activated: state.activated,
            certificate: state.server_certificate(),
            application_name: state.application_name(&around),
            endpoint: self.endpoint(reached),
            used_ports: state.taken_ports(&around),
            limits: state.limits(),
            clock: around.now,
            revision: state.revision,
        }
    }

    pub(super) fn settings(&self) -> Revisioned<ServerSettings> {
        let state = self.state();
        Revisioned { revision: state.revision, value: state.settings.clone() }
    }

    pub(super) fn users(&self) -> Revisioned<Vec<UserName>> {
        let state = self.state();
        Revisioned { revision: state.revision, value: state.users.iter().map(|user| user.name.clone()).collect() }
    }

    pub(super) fn certificates(&self) -> Revisioned<HeldCertificates> {
        let state = self.state();
        let held = state
            .certificates
            .iter()
            .map(|(kind, pair)| HeldCertificate { kind: *kind, certificate: pair.certificate.clone() })
            .collect();
        let csr = state.csr.as_ref().map(|pending| pending.csr.clone());
        Revisioned { revision: state.revision, value: HeldCertificates { selected: state.selected, held, csr } }
    }

    pub(super) fn clients(&self, list: ClientList) -> Result<Revisioned<Vec<ListedCertificate>>, Problem> {
        let state = self.state();
        if list == ClientList::Issuers && state.generation() == FirmwareGeneration::Legacy {
            return Err(ErrorCode::FirmwareTooOld.into());
        }
        let value = state.list(list).iter().filter_map(super::state::Listed::to_message).collect();
        Ok(Revisioned { revision: state.revision, value })
    }

    /// Makes a change, whole or not at all, even if the one who asked has gone: copy the state, edit the copy, write
    /// it beside the one in force, give the server the new configuration, and only then let the copy take its place.
    /// If a step fails, the ones before it are undone.
    pub(super) async fn change<T: Send + 'static>(
        self: &Arc<Self>,
        revision: u64,
        effect: Effect,
        edit: impl FnOnce(&mut State, &Surroundings) -> Result<T, Problem> + Send + 'static,
    ) -> Result<(Changed, T), Outcome> {
        let this = Arc::clone(self);
        finished(tokio::spawn(async move { this.change_now(revision, effect, edit).await }).await)
    }

    pub(super) async fn start_server(self: &Arc<Self>) -> Result<Changed, Outcome> {
        let this = Arc::clone(self);
        finished(
            tokio::spawn(async move {
                this.faults.admit_change()?;
                this.start_server_now().await?;
                Ok(this.changed())
            })
            .await,
        )
    }

    pub(super) async fn stop_server(self: &Arc<Self>) -> Result<Changed, Outcome> {
        let this = Arc::clone(self);
        finished(
            tokio::spawn(async move {
                this.faults.admit_change()?;
                let mut plant = this.server.lock().await;
                plant.admit()?;
                plant.stop().await;
                memory::give_back();
                *this.standing.lock() = Standing::Stopped;
                Ok(this.changed())
            })
            .await,
        )
    }

    /// Deletes the server log.
    pub(super) async fn delete_log(&self) {
        let log = Arc::clone(&self.log);
        let deleted = spawn_blocking(move || log.delete()).await;
        if let Err(error) = deleted.map_err(std::io::Error::other).flatten() {
            tracing::warn!(%error, "the server log was not deleted");
        }
    }

    /// The server log from byte `from` on, or its end.
    pub(super) async fn log(&self, from: Option<u64>) -> Result<LogChunk, Problem> {
        let log = Arc::clone(&self.log);
        let read = spawn_blocking(move || log.read(from)).await.map_err(std::io::Error::other).flatten();
        read.map_err(|error| Problem::with_detail(ErrorCode::Internal, error))
    }

    /// Settings, users and keys, sealed.
    pub(super) async fn export(&self, passphrase: WireSecret) -> Result<SettingsExport, Problem> {
        let (state, around) = (self.state(), self.surroundings());
        spawn_blocking(move || settings_transfer::export(&state, &around, &passphrase.0))
            .await
            .unwrap_or_else(|error| Err(Problem::with_detail(ErrorCode::Internal, error)))
    }

    /// What a server does by itself whose log is full.
    async fn stop_if_log_is_full(&self) {
        let mut plant = self.server.lock().await;
        if plant.is_running() && self.state().settings.server_log && self.log.is_full() {
            plant.stop().await;
            *self.standing.lock() = Standing::Failed(ErrorCode::ServerLogFull);
        }
    }

    async fn change_now<T: Send + 'static>(
        self: Arc<Self>,
        revision: u64,
        effect: Effect,
        edit: impl FnOnce(&mut State, &Surroundings) -> Result<T, Problem> + Send + 'static,
    ) -> Result<(Changed, T), Outcome> {
        let mut plant = self.server.lock().await;
        plant.admit()?;
        self.faults.admit_change()?;
        let old = self.state();
        if revision != old.revision {
            let detail = format!("revision {revision}, now {}", old.revision);
            return Err(Problem::with_detail(ErrorCode::ChangedMeanwhile, detail).into());
        }

        let (store, around, copy) = (Arc::clone(&self.store), self.surroundings(), State::clone(&old));
        let (new, value, staged) = blocking(move || {
            let mut state = copy;
            let value = edit(&mut state, &around)?;
            state.revision += 1;
            state.check()?;
            let staged = store.stage(&state)?;
            Ok::<_, Outcome>((state, value, staged))
        })
        .await?;
        if self.faults.take_drop(DropPoint::BeforeApply) {
            return Err(Outcome::Dropped);
        }

        let effect = if plant.is_running() { effect } else { Effect::Nothing };
        self.take_effect(&mut plant, effect, &old, &new).await?;
        if let Err(error) = blocking(move || staged.commit()).await {
            match effect {
                Effect::Restart => {
                    plant.stop().await;
                    self.restore(&mut plant, &old).await;
                }
                Effect::CertificateLost if !plant.is_running() => self.restore(&mut plant, &old).await,
                Effect::CertificateLost => {}
                Effect::TrustedClients => self.trust_again(&plant, &old),
                Effect::Nothing => {}
            }
            return Err(error.into());
        }
        *self.state.write() = Arc::new(new);
        if effect == Effect::CertificateLost && !plant.is_running() {
            *self.standing.lock() = Standing::Stopped;
        }
        let changed = self.changed();
        drop(plant);
        if self.faults.take_drop(DropPoint::AfterApply) {
            return Err(Outcome::Dropped);
        }
        Ok((changed, value))
    }

    async fn start_server_now(&self) -> Result<(), Problem> {
        let mut plant = self.server.lock().await;
        plant.admit()?;
        if plant.is_running() {
            return Ok(());
        }
        // One that died by itself.
        plant.stop().await;
        let started = if self.faults.get().server_error { Err(fault()) } else { self.run(&self.state()).await };
        match started {
            Ok(server) => {
                plant.server = Some(server);
                *self.standing.lock() = Standing::Running;
                Ok(())
            }
            Err(problem) => {
                *self.standing.lock() = Standing::Failed(problem.code);
                Err(problem)
            }
        }
    }

    /// Gives the running server the new configuration; if that fails, the old one again.
    async fn take_effect(&self, plant: &mut Plant, effect: Effect, old: &State, new: &State) -> Result<(), Problem> {
        match effect {
            Effect::Restart => self.restart(plant, old, new).await,
            Effect::TrustedClients => plant.trust(new).inspect_err(|_| self.trust_again(plant, old)),
            Effect::CertificateLost => {
                if new.selected_certificate().is_none() {
                    plant.stop().await;
                }
                Ok(())
            }
            Effect::Nothing => Ok(()),
        }
    }

    async fn restart(&self, plant: &mut Plant, old: &State, new: &State) -> Result<(), Problem> {
        // A configuration that cannot run is refused before anything is stopped.
        new.check_start(&self.surroundings())?;
        plant.stop().await;
        let started = if self.faults.get().server_error { Err(fault()) } else { self.run(new).await };
        match started {
            Ok(server) => {
                plant.server = Some(server);
                Ok(())
            }
            Err(problem) => {
                self.restore(plant, old).await;
                Err(problem)
            }
        }
    }

    /// Puts back the server that ran until a moment ago. Should even that fail, the status says so.
    async fn restore(&self, plant: &mut Plant, old: &State) {
        for attempt in 1..=RESTORE_ATTEMPTS {
            match self.run(old).await {
                Ok(server) => {
                    plant.server = Some(server);
                    return;
                }
                Err(problem) if attempt == RESTORE_ATTEMPTS => {
                    tracing::error!(serial = %old.identity.serial, %problem, "the OPC UA server could not be put back");
                    *self.standing.lock() = Standing::Failed(problem.code);
                }
                Err(_) => tokio::time::sleep(RESTORE_PAUSE).await,
            }
        }
    }

    fn trust_again(&self, plant: &Plant, old: &State) {
        if let Err(problem) = plant.trust(old) {
            tracing::error!(serial = %old.identity.serial, %problem, "the trusted clients could not be put back");
        }
    }

    async fn run(&self, state: &State) -> Result<OpcUaServer, Problem> {
        let mut config = opcua_config(state, &self.surroundings(), &self.folder)?;
        if state.settings.server_log {
            if self.log.is_full() {
                return Err(ErrorCode::ServerLogFull.into());
            }
            let log = Arc::clone(&self.log);
            config.events = Events::new(move |event| log.write(event));
        }
        OpcUaServer::start(config).await.map_err(|error| match &error {
            StartError::PortInUse(port) => Problem::with_detail(ErrorCode::PortConflict, port),
            StartError::InvalidParameter(reason) => Problem::with_detail(ErrorCode::InvalidParameter, reason),
            StartError::Failed(reason) => Problem::with_detail(ErrorCode::ServerError, reason),
        })
    }

    async fn switch_off(&self) {
        let mut plant = self.server.lock().await;
        plant.off = true;
        if plant.server.is_some() {
            plant.stop().await;
            memory::give_back();
        }
        *self.standing.lock() = Standing::Stopped;
    }

    fn changed(&self) -> Changed {
        Changed { revision: self.state().revision, status: self.status().0 }
    }

    /// A server that died by itself is noticed here.
    fn status(&self) -> (ServerStatus, Option<ErrorCode>) {
        let standing = *self.standing.lock();
        let notice = self.state().settings.server_log.then_some(ErrorCode::ServerLogOn);
        match standing {
            Standing::Stopped => (ServerStatus::Stop, notice),
            Standing::Failed(code) => (ServerStatus::Error, Some(code)),
            Standing::Running => match self.server.try_lock() {
                Ok(plant) if !plant.is_running() => (ServerStatus::Error, Some(ErrorCode::ServerError)),
                _ => (ServerStatus::Run, notice),
            },
        }
    }

    fn surroundings(&self) -> Surroundings {
        Surroundings { now: self.faults.now(), bind: self.bind, management_port: self.management_port }
    }

    fn endpoint(&self, reached: Option<IpAddr>) -> String {
        let host = match reached {
            Some(address) if self.bind.is_unspecified() => address.to_canonical(),
            _ => self.surroundings().address(),
        };
        format!("opc.tcp://{}", SocketAddr::new(host, self.state().settings.port.get()))
    }
}

impl Plant {
    fn admit(&self) -> Result<(), Problem> {
        if self.off { Err(Problem::with_detail(ErrorCode::Refused, "the controller is switched off")) } else { Ok(()) }
    }

    fn is_running(&self) -> bool {
        self.server.as_ref().is_some_and(OpcUaServer::is_running)
    }

    fn trust(&self, state: &State) -> Result<(), Problem> {
        match &self.server {
            Some(server) => {
                server.set_trust(trust_lists(state)?);
            }
            None => {}
        }
        Ok(())
    }

    async fn stop(&mut self) {
        if let Some(server) = self.server.take() {
            server.stop().await;
        }
    }
}

const OPCUA_FOLDER: &str = "opcua";

fn opcua_config(state: &State, around: &Surroundings, folder: &Path) -> Result<OpcUaConfig, Problem> {
    let pair = state.check_start(around)?;
    let names = state.server_names(around);
    // Clients insist that the server's URI is the one in its certificate, and a certificate from elsewhere has its own.
    let application_uri =
        pair.parse().ok().and_then(|certificate| certificate.application_uri()).unwrap_or(names.application_uri);
    Ok(OpcUaConfig {
        application_name: state.application_name(around),
        application_uri,
        bind: around.bind,
        port: state.settings.port.get(),
        policies: state.settings.security_policies.clone(),
        user_tokens: state.settings.user_tokens.clone(),
        users: state
            .users
            .iter()
            .map(|user| OpcUaUser { name: user.name.to_string(), password_hash: user.password_hash.clone() })
            .collect(),
        certificate_der: pair.certificate.0.clone(),
        private_key_pkcs8: pair.private_key.0.clone(),
        trust: trust_lists(state)?,
        trust_policy: TrustPolicy::default(),
        detailed_status: false,
        refusals: None,
        clock: Clock::default(),
        identity: DeviceIdentity {
            name: state.identity.name.to_string(),
            series: state.identity.series,
            serial: state.identity.serial.clone(),
            firmware: state.identity.firmware,
        },
        events: Events::default(),
        pki_folder: folder.join(OPCUA_FOLDER),
    })
}

fn trust_lists(state: &State) -> Result<TrustLists, Problem> {
    let parsed = |list: &[Listed]| -> Result<Vec<Certificate>, Problem> {
        list.iter()
            .map(|listed| Certificate::from_der(&listed.certificate.0))
            .collect::<Result<_, _>>()
            .map_err(|error| Problem::with_detail(ErrorCode::Internal, error))
    };
    Ok(TrustLists::new(parsed(&state.trusted)?, parsed(&state.issuers)?, Vec::new()))
}

/// What the fault switch says when the server is told to fail.
fn fault() -> Problem {
    Problem::with_detail(ErrorCode::ServerError, "a fault switch is on")
}

async fn stop_when_log_is_full(controller: Arc<Controller>, off: CancellationToken) {
    loop {
        tokio::select! {
            () = off.cancelled() => return,
            () = controller.log.filled() => controller.stop_if_log_is_full().await,
        }
    }
}

fn finished<T>(joined: Result<Result<T, Outcome>, tokio::task::JoinError>) -> Result<T, Outcome> {
    joined.unwrap_or_else(|error| Err(Problem::with_detail(ErrorCode::Internal, error).into()))
}

/// Runs on a thread that may wait. A panic there is the controller's mistake, not the end of it.
async fn blocking<T: Send + 'static, E: From<StoreError> + Send + 'static>(
    work: impl FnOnce() -> Result<T, E> + Send + 'static,
) -> Result<T, E> {
    spawn_blocking(work).await.unwrap_or_else(|error| {
        let source = std::io::Error::other(error.to_string());
        Err(StoreError::Io { path: PathBuf::new(), source }.into())
    })
}
