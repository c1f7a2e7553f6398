//! State, store and OPC UA server together. Knows nothing of the management protocol's connections, which are in `api`
//! and `listener`.
//!
//! | file | contents |
//! |---|---|
//! | `mod` | [`Controller`]: opened from its folder |
//! | `queries` | reads of the state, which never wait |
//! | `change` | changes, whole or not at all |
//! | `error` | why a controller refuses a request |
//! | `trust` | client lists and CRLs: a change, and the rejected list beside it |
//! | `server_slot` | the OPC UA server, made of a state |

mod change;
mod error;
mod queries;
mod server_slot;
mod trust;

use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;

use chrono::{DateTime, Utc};
use parking_lot::{Mutex, RwLock};
use thiserror::Error;
use tokio::sync::Mutex as AsyncMutex;
use tokio::task::{JoinError, spawn_blocking};

pub(super) use change::{ChangeFailure, Effect};
pub(super) use error::{ControllerError, ServerStartError};
use server_slot::ServerSlot;

use super::cell::{BackupMemory, Cell, CellClock, CellConfig, CellHandle, CellOptions, SpelDeclaration};
use super::faults::Faults;
use super::new_controller::{NewController, NewControllerError};
use super::opcua::AdmissionOptions;
use super::project_file;
use super::rejected::RejectedClients;
use super::remote::{BackupFile, RemoteOptions, RemoteServerError};
use super::server_log::ServerLog;
use super::state::{ControllerIdentity, ControllerState, OperatingContext};
use super::store::{Store, StoreError};
use crate::model::ErrorCode;

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
    /// The robots on it, and how fast their time runs.
    pub cell: CellOptions,
    /// How it answers remote commands.
    pub remote: RemoteOptions,
    /// What the controller is if its folder holds none yet.
    pub initial: NewController,
}

/// Why a virtual controller could not be switched on.
#[derive(Debug, Error)]
pub enum SwitchOnError {
    /// The state cannot be read or written.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// A new controller cannot be made.
    #[error(transparent)]
    Initial(#[from] NewControllerError),
    /// The TLS identity cannot be used.
    #[error("the management identity cannot be used: {0}")]
    Tls(#[from] rustls::Error),
    /// A port cannot be listened on.
    #[error("the management protocol cannot listen on {address}: {source}")]
    Listen {
        /// The address with the port.
        address: SocketAddr,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// Remote commands cannot be answered.
    #[error(transparent)]
    Remote(#[from] RemoteServerError),
    /// A thread ended before its work was done.
    #[error("a worker thread died")]
    Worker(#[from] JoinError),
}

/// The controller behind the management protocol.
///
/// Questions read a snapshot and never wait. Changes, start and stop take their turn at [`Controller::server`].
#[derive(Debug)]
pub(super) struct Controller {
    state: RwLock<Arc<ControllerState>>,
    store: Arc<Store>,
    faults: Faults,
    log: Arc<ServerLog>,
    rejected: Arc<RejectedClients>,
    folder: PathBuf,
    bind: IpAddr,
    management_port: u16,
    admission: AdmissionOptions,
    cell: CellHandle,
    kept: BackupFile,
    server: AsyncMutex<ServerSlot>,
    server_state: Mutex<ServerState>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ServerState {
    Stopped,
    Running,
    /// Why the server is not running although it should be, found at this revision of the configuration. Shown as long
    /// as [`Controller::lasts`] says so.
    Failed {
        code: ErrorCode,
        revision: u64,
    },
}

impl Controller {
    /// Opens the state in the spec's folder, or makes and saves the initial one. The OPC UA server is not started.
    pub(super) async fn open(spec: ControllerSpec, management_port: u16) -> Result<Self, SwitchOnError> {
        let ControllerSpec { folder, bind, admission, cell, initial, management_port: _, remote: _ } = spec;
        let faults = Faults::default();
        let store = Store::open(&folder, faults.clone())?;
        let context = OperatingContext { now: faults.now(), bind, management_port };
        let project = folder.clone();
        let (store, state, variables, backup) = spawn_blocking(move || {
            let state = match store.load()? {
                Some(state) => state,
                None => {
                    let state = initial.make(&context)?;
                    store.save(&state)?;
                    state
                }
            };
            // A project that cannot be read is reported when the server starts.
            let declared = project_file::provide(&project).and_then(|()| project_file::load(&project));
            let variables = declared.map(|declared| declared.variables).unwrap_or_default();
            let backup = BackupFile::load(&project).unwrap_or_else(|error| {
                tracing::warn!(%error, "the memory of a virtual controller's battery cannot be read and is lost");
                BackupMemory::default()
            });
            Ok::<_, SwitchOnError>((store, state, variables, backup))
        })
        .await??;
        let cell = switch_on_cell(&state, context.now, variables, backup.clone(), cell);
        Ok(Self {
            kept: BackupFile::new(&folder, faults.clone(), cell.clone(), backup),
            cell,
            log: Arc::new(ServerLog::new(&folder, faults.clone())),
            rejected: Arc::new(RejectedClients::open(&folder, faults.clone(), &state)),
            state: RwLock::new(Arc::new(state)),
            store: Arc::new(store),
            faults,
            folder,
            bind,
            management_port,
            admission,
            server: AsyncMutex::new(ServerSlot { server: None, off: false }),
            server_state: Mutex::new(ServerState::Stopped),
        })
    }

    pub(super) fn state(&self) -> Arc<ControllerState> {
        Arc::clone(&self.state.read())
    }

    pub(super) fn faults(&self) -> &Faults {
        &self.faults
    }

    pub(super) fn rejected(&self) -> &Arc<RejectedClients> {
        &self.rejected
    }

    pub(super) fn log(&self) -> &ServerLog {
        &self.log
    }

    pub(super) fn operating_context(&self) -> OperatingContext {
        OperatingContext { now: self.faults.now(), bind: self.bind, management_port: self.management_port }
    }

    pub(super) fn cell(&self) -> &CellHandle {
        &self.cell
    }

    /// What outlives a power-off.
    pub(super) fn kept(&self) -> &BackupFile {
        &self.kept
    }

    fn failed(&self, code: ErrorCode) {
        *self.server_state.lock() = ServerState::Failed { code, revision: self.state().revision };
    }

    /// Stops the OPC UA server if its log is full.
    pub(super) async fn stop_if_log_is_full(&self) {
        let mut slot = self.server.lock().await;
        if slot.is_running() && self.state().settings.server_log && self.log.is_full() {
            slot.stop().await;
            self.failed(ErrorCode::ServerLogFull);
        }
    }
}

/// The cell of a controller that is switched on at `started`.
fn switch_on_cell(
    state: &ControllerState,
    started: DateTime<Utc>,
    variables: Vec<SpelDeclaration>,
    backup: BackupMemory,
    options: CellOptions,
) -> CellHandle {
    let ControllerIdentity { serial, series, firmware, name } = state.identity.clone();
    let clock = CellClock::running(options.rate);
    let cell = Cell::new(CellConfig { name, serial, series, firmware, started, variables, backup, options });
    CellHandle::new(cell, clock)
}
