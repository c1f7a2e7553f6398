//! State, store and OPC UA server together.
//!
//! | file | its one idea |
//! |---|---|
//! | `mod` | [`VirtualController`]: switched on and off |
//! | `questions` | what the management protocol asks |
//! | `change` | changes, whole or not at all |
//! | `trust` | client lists and CRLs: a change, and the rejected list beside it |
//! | `plant` | the OPC UA server, made of a state |

mod change;
mod plant;
mod questions;
mod trust;

use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;

use parking_lot::{Mutex, RwLock};
use thiserror::Error;
use tokio::net::TcpListener;
use tokio::sync::Mutex as AsyncMutex;
use tokio::task::{JoinHandle, spawn_blocking};
use tokio_util::sync::CancellationToken;

pub(super) use change::{Effect, Outcome};
use plant::Plant;

use super::api::Api;
use super::faults::Faults;
use super::new_controller::NewController;
use super::opcua::AdmissionOptions;
use super::rejected::RejectedClients;
use super::server_log::ServerLog;
use super::state::{State, Surroundings};
use super::store::{Store, StoreError};
use super::{listener as management, tls};
use crate::model::{
    ControllerInfo, ControllerName, ControllerSeries, ErrorCode, FirmwareVersion, Problem, SerialNumber, StartupMode,
};
use crate::pki::Fingerprint;

/// Where a virtual controller lives and answers, and what it is if its folder holds none yet.
#[derive(Debug, Clone)]
pub struct ControllerSpec {
    /// The controller's own folder; made if missing. A state found there wins over `initial`.
    pub folder: PathBuf,
    /// The address its management protocol and its OPC UA server listen on.
    pub bind: IpAddr,
    /// The port of the management protocol; 0 takes a free one.
    pub management_port: u16,
    /// How its OPC UA server admits clients.
    pub admission: AdmissionOptions,
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
    #[error("the management protocol cannot listen on {address}: {source}")]
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
        let rejected = Arc::new(RejectedClients::open(&spec.folder, faults.clone(), &state));
        let controller = Arc::new(Controller {
            state: RwLock::new(Arc::new(state)),
            store: Arc::new(store),
            faults,
            log,
            rejected,
            folder: spec.folder,
            bind: spec.bind,
            management_port: address.port(),
            admission: spec.admission,
            server: AsyncMutex::new(Plant { server: None, off: false }),
            standing: Mutex::new(Standing::Stopped),
        });
        if auto && let Err(problem) = controller.start_server_now().await {
            tracing::warn!(serial = %controller.state().identity.serial, %problem, "the OPC UA server did not start");
        }
        let off = CancellationToken::new();
        tokio::spawn(stop_when_log_is_full(Arc::clone(&controller), off.clone()));
        tokio::spawn(Arc::clone(&controller.rejected).keep(off.clone()));
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
        self.controller.rejected.write_soon().await;
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
    rejected: Arc<RejectedClients>,
    folder: PathBuf,
    bind: IpAddr,
    management_port: u16,
    admission: AdmissionOptions,
    server: AsyncMutex<Plant>,
    standing: Mutex<Standing>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Standing {
    Stopped,
    Running,
    /// Why the server is not running although it should be, found at this revision of the configuration. Shown as long as
    /// [`Controller::lasts`] says so.
    Failed {
        code: ErrorCode,
        revision: u64,
    },
}

impl Controller {
    pub(super) fn state(&self) -> Arc<State> {
        Arc::clone(&self.state.read())
    }

    pub(super) fn faults(&self) -> &Faults {
        &self.faults
    }

    fn surroundings(&self) -> Surroundings {
        Surroundings { now: self.faults.now(), bind: self.bind, management_port: self.management_port }
    }

    fn failed(&self, code: ErrorCode) {
        *self.standing.lock() = Standing::Failed { code, revision: self.state().revision };
    }

    /// What a server does by itself whose log is full.
    async fn stop_if_log_is_full(&self) {
        let mut plant = self.server.lock().await;
        if plant.is_running() && self.state().settings.server_log && self.log.is_full() {
            plant.stop().await;
            self.failed(ErrorCode::ServerLogFull);
        }
    }
}

async fn stop_when_log_is_full(controller: Arc<Controller>, off: CancellationToken) {
    loop {
        tokio::select! {
            () = off.cancelled() => return,
            () = controller.log.filled() => controller.stop_if_log_is_full().await,
        }
    }
}
