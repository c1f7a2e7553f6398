use std::fs::{File, TryLockError};
use std::io;
use std::net::{IpAddr, SocketAddr};
use std::path::{Path, PathBuf};

use secrecy::SecretString;
use serde::{Deserialize, Serialize};
use thiserror::Error;
use tokio::task::{JoinError, JoinSet, spawn_blocking};
use tokio_util::sync::DropGuard;

use super::cell::CellOptions;
use super::controller::{ControllerSpec, SwitchOnError};
use super::file_limit::raise_file_limit;
use super::new_controller::NewController;
use super::opcua::{AdmissionOptions, HashError};
use super::password::hash_connection_password;
use super::ports::free_port;
use super::remote::{RemoteOptions, SerialChoice};
use super::state::ControllerIdentity;
use super::switch_on::VirtualController;
use super::{plant, switchboard};
use crate::model::{
    AddressError, ControllerName, ControllerSeries, FirmwareVersion, NameError, PortError, SerialNumber, ServerPort,
};
use crate::platform::private;

/// Many virtual controllers in one process.
#[derive(Debug, Clone)]
pub struct FleetConfig {
    /// At most [`MAX_FLEET`].
    pub count: usize,
    /// The address that every controller listens on.
    pub bind: IpAddr,
    /// The management port of the first controller, the next one's is one higher; 0 takes free ones.
    pub management_port: u16,
    /// The OPC UA port of the first controller, the next one's is one higher; 0 picks free ones. A controller that
    /// exists already keeps its own.
    pub opcua_port: u16,
    /// Which firmware new controllers have.
    pub firmware: FleetFirmware,
    /// Whether legacy controllers that do not exist yet come activated; current ones always do.
    pub activated: bool,
    /// The connection password of controllers that do not exist yet. All of them share its hash.
    pub password: SecretString,
    /// Each controller lives in a folder here, named by its serial number. One process at a time.
    pub data: PathBuf,
    /// How the OPC UA servers admit clients.
    pub admission: AdmissionOptions,
    /// The robots of each controller, and how fast their time runs. The seed is that of the first controller.
    pub cell: CellOptions,
    /// How each controller answers remote commands. The ports are those of the first controller, the next one's are one
    /// higher; 0 takes free ones. A serial device can be that of one controller only.
    pub remote: RemoteOptions,
    /// Names, serial numbers and series follow from it alone.
    pub seed: u64,
}

/// Which firmware the controllers of a fleet have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FleetFirmware {
    /// All legacy.
    Legacy,
    /// All current.
    Current,
    /// Legacy and current ones in turn.
    Mixed,
}

/// Most controllers of a fleet: their serial numbers have four digits.
pub const MAX_FLEET: usize = 9_999;

/// Why a fleet cannot be started.
#[derive(Debug, Error)]
pub enum FleetError {
    /// More controllers than [`MAX_FLEET`].
    #[error("{count} controllers are too many; at most {MAX_FLEET} fit into one process")]
    TooMany {
        /// How many were asked for.
        count: usize,
    },
    /// The ports end before each controller has one.
    #[error("the ports from {first} on do not suffice for {count} controllers")]
    Ports {
        /// The first port.
        first: u16,
        /// How many controllers were asked for.
        count: usize,
    },
    /// A serial device for more than one controller.
    #[error("{count} controllers cannot share one serial device")]
    SharedDevice {
        /// How many controllers were asked for.
        count: usize,
    },
    /// Another process uses the folder.
    #[error("{path} is in use by another process")]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// The folder cannot be used.
    #[error("{path}: {source}")]
    Data {
        /// The folder or file.
        path: PathBuf,
        /// The error of the operating system.
        source: io::Error,
    },
    /// The operating system gives no free port.
    #[error("no free port: {0}")]
    NoFreePort(#[source] io::Error),
    /// A controller cannot be switched on.
    #[error("controller {serial}: {source}")]
    Controller {
        /// Its serial number.
        serial: SerialNumber,
        /// Why.
        source: SwitchOnError,
    },
    /// A connection password could not be hashed.
    #[error(transparent)]
    Password(#[from] HashError),
    /// A port cannot be that of an OPC UA server.
    #[error(transparent)]
    Port(#[from] PortError),
    /// An address of a controller is not one.
    #[error(transparent)]
    Address(#[from] AddressError),
    /// A name or serial number cannot be made.
    #[error(transparent)]
    Name(#[from] NameError),
    /// A thread ended before its work was done.
    #[error("a worker thread died")]
    Worker(#[from] JoinError),
}

/// Running controllers. Dropped without [`Fleet::shutdown`], they stop as well, without waiting.
#[derive(Debug)]
pub struct Fleet {
    controllers: Vec<VirtualController>,
    _outside: OutsideControl,
    _lock: FolderLock,
}

/// What a process that started a controller says about it, on one line.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ReadyLine {
    /// Name of the controller.
    pub name: String,
    /// Its serial number.
    pub serial: SerialNumber,
    /// Its series.
    pub series: ControllerSeries,
    /// Its firmware.
    pub firmware: FirmwareVersion,
    /// `host:port` of the management protocol.
    pub management: String,
    /// The fingerprint of its management identity.
    pub fingerprint: crate::pki::Fingerprint,
    /// `opc.tcp://host:port`.
    pub opcua: String,
    /// `host:port` of the remote commands as text, where they are answered.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub remote: Option<String>,
    /// `host:port` of the remote commands in frames, where they are answered.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub remote_frames: Option<String>,
    /// The serial device or pseudo-terminal of the remote commands, where they are answered.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub remote_serial: Option<String>,
}

impl Fleet {
    /// Switches all controllers on, or none: if one fails, the others are switched off again.
    pub async fn start(config: FleetConfig) -> Result<Self, FleetError> {
        config.check_ports()?;
        raise_file_limit();
        let lock = FolderLock::take(&config.data)?;
        let password = config.password.clone();
        let hash = spawn_blocking(move || hash_connection_password(&password)).await??;
        let specs = (0..config.count).map(|index| config.spec(index, &hash)).collect::<Result<Vec<_>, _>>()?;
        let controllers = start_all(specs).await?;
        match OutsideControl::of(&config.data, &controllers).await {
            Ok(outside) => Ok(Self { controllers, _outside: outside, _lock: lock }),
            Err(error) => {
                shutdown_all(controllers).await;
                Err(error)
            }
        }
    }

    /// The controllers, in the order of their ports.
    pub fn controllers(&self) -> &[VirtualController] {
        &self.controllers
    }

    /// Switches all controllers off and waits for that.
    pub async fn shutdown(self) {
        shutdown_all(self.controllers).await;
    }
}

impl FleetConfig {
    fn check_ports(&self) -> Result<(), FleetError> {
        if self.count > MAX_FLEET {
            return Err(FleetError::TooMany { count: self.count });
        }
        if matches!(self.remote.serial, Some(SerialChoice::Device { .. })) && self.count > 1 {
            return Err(FleetError::SharedDevice { count: self.count });
        }
        let remote = [self.remote.text_port, self.remote.frames_port].map(Option::unwrap_or_default);
        for first in [self.management_port, self.opcua_port].into_iter().chain(remote) {
            if first != 0 && usize::from(u16::MAX - first) + 1 < self.count {
                return Err(FleetError::Ports { first, count: self.count });
            }
        }
        Ok(())
    }

    fn spec(&self, index: usize, hash: &str) -> Result<ControllerSpec, FleetError> {
        let identity = plausible_identity(self.seed, index, self.firmware)?;
        let nth = |first: u16| first.checked_add(u16::try_from(index).ok()?);
        let ports = |first: u16| nth(first).ok_or(FleetError::Ports { first, count: self.count });
        let folder = self.data.join(identity.serial.folder_name());
        let mut initial = NewController::new(identity, hash.to_owned());
        initial.activated = self.activated;
        let opcua = match self.opcua_port {
            0 => free_port(self.bind).map_err(FleetError::NoFreePort)?,
            first => ports(first)?,
        };
        initial.settings.port = ServerPort::try_from(opcua)?;
        initial.used_ports.retain(|port| *port != opcua);
        let management_port = match self.management_port {
            0 => 0,
            first => ports(first)?,
        };
        let seed = self.cell.seed.wrapping_add(index as u64);
        let cell = CellOptions { seed, ..self.cell.clone() };
        let remote_port = |first: Option<u16>| match first {
            None | Some(0) => Ok(first),
            Some(first) => ports(first).map(Some),
        };
        let remote = RemoteOptions {
            text_port: remote_port(self.remote.text_port)?,
            frames_port: remote_port(self.remote.frames_port)?,
            ..self.remote.clone()
        };
        Ok(ControllerSpec {
            folder,
            bind: self.bind,
            management_port,
            admission: self.admission,
            cell,
            remote,
            initial,
        })
    }
}

impl VirtualController {
    /// What a process prints when the controller is ready.
    pub fn ready_line(&self) -> ReadyLine {
        let reachable =
            |address: SocketAddr| SocketAddr::new(self.reachable_address().ip(), address.port()).to_string();
        ReadyLine {
            name: self.name().to_string(),
            serial: self.serial(),
            series: self.series(),
            firmware: self.firmware(),
            management: self.reachable_address().to_string(),
            fingerprint: self.fingerprint(),
            opcua: self.endpoint(),
            remote: self.remote().text_address().map(reachable),
            remote_frames: self.remote().frames_address().map(reachable),
            remote_serial: self.remote().serial_path().map(|path| path.display().to_string()),
        }
    }
}

/// Lets other processes set the fault switches of the controllers in a folder and act on their cells, until dropped.
#[derive(Debug)]
pub(super) struct OutsideControl {
    _switches: DropGuard,
    _plant: DropGuard,
}

impl OutsideControl {
    pub(super) async fn of(data: &Path, controllers: &[VirtualController]) -> Result<Self, FleetError> {
        let cells = controllers.iter().map(|controller| (controller.serial(), controller.cell().clone()));
        let plant = plant::serve(data, cells.collect()).await;
        let plant = plant.map_err(|source| FleetError::Data { path: data.to_owned(), source })?;
        let faults = controllers.iter().map(|controller| (controller.serial(), controller.faults()));
        Ok(Self { _switches: switchboard::watch(data, faults.collect()), _plant: plant })
    }
}

/// Side by side; in the order of `specs`.
pub(super) async fn start_all(specs: Vec<ControllerSpec>) -> Result<Vec<VirtualController>, FleetError> {
    let mut starting = JoinSet::new();
    let count = specs.len();
    for (index, spec) in specs.into_iter().enumerate() {
        starting.spawn(async move {
            let serial = spec.initial.identity.serial.clone();
            let started = VirtualController::start(spec).await;
            (index, started.map_err(|source| FleetError::Controller { serial, source }))
        });
    }
    let mut started = Vec::with_capacity(count);
    let mut failure = None;
    while let Some(joined) = starting.join_next().await {
        match joined {
            Ok((index, Ok(controller))) => started.push((index, controller)),
            Ok((_, Err(error))) => failure = Some(error),
            Err(error) => failure = Some(FleetError::Worker(error)),
        }
    }
    started.sort_by_key(|(index, _)| *index);
    let controllers: Vec<_> = started.into_iter().map(|(_, controller)| controller).collect();
    match failure {
        None => Ok(controllers),
        Some(error) => {
            shutdown_all(controllers).await;
            Err(error)
        }
    }
}

pub(super) async fn shutdown_all(controllers: Vec<VirtualController>) {
    let mut stopping = JoinSet::new();
    for controller in controllers {
        stopping.spawn(async move { controller.shutdown().await });
    }
    while stopping.join_next().await.is_some() {}
}

/// Keeps a second process away from the folder for as long as it lives. Gone with the process, however that ends.
#[derive(Debug)]
pub(super) struct FolderLock {
    _file: File,
}

impl FolderLock {
    /// Makes the folder if it is missing.
    pub(super) fn take(folder: &Path) -> Result<Self, FleetError> {
        let data = |source| FleetError::Data { path: folder.to_owned(), source };
        private::create_folder(folder).map_err(data)?;
        let file = private::open_file(&folder.join(".lock")).map_err(data)?;
        match file.try_lock() {
            Ok(()) => Ok(Self { _file: file }),
            Err(TryLockError::WouldBlock) => Err(FleetError::Busy { path: folder.to_owned() }),
            Err(TryLockError::Error(source)) => Err(data(source)),
        }
    }
}

/// What stands where robots stand.
const PLACES: [&str; 12] = [
    "Welding cell",
    "焊接单元",
    "Assembly line",
    "装配线",
    "Palletiser",
    "码垛",
    "Press",
    "冲压",
    "Inspection",
    "检测工位",
    "Packing",
    "包装",
];

/// Series, firmware, serial number and name of the `index`th controller of a fleet.
pub(super) fn plausible_identity(
    seed: u64,
    index: usize,
    firmware: FleetFirmware,
) -> Result<ControllerIdentity, NameError> {
    let draw = scatter(seed, index);
    let current = match firmware {
        FleetFirmware::Legacy => false,
        FleetFirmware::Current => true,
        FleetFirmware::Mixed => index % 2 == 1,
    };
    let pick = |choices: &[(ControllerSeries, FirmwareVersion)]| choices[draw as usize % choices.len()];
    let (series, firmware) = if current {
        pick(&[
            (ControllerSeries::Rc800, FirmwareVersion::new(8, 0, 0)),
            (ControllerSeries::Rc800, FirmwareVersion::new(8, 1, 0)),
            (ControllerSeries::Rc800, FirmwareVersion::new(8, 1, 2)),
        ])
    } else {
        pick(&[
            (ControllerSeries::Rc90, FirmwareVersion::new(7, 5, 4)),
            (ControllerSeries::Rc700, FirmwareVersion::new(7, 5, 4)),
            (ControllerSeries::Rc700, FirmwareVersion::new(7, 5, 58)),
            (ControllerSeries::TVt, FirmwareVersion::new(7, 5, 54)),
        ])
    };
    let place = PLACES[(draw >> 8) as usize % PLACES.len()];
    let name: ControllerName = format!("{place} {:03}", index + 1).parse()?;
    Ok(ControllerIdentity { serial: serial_number(series, seed, index)?, series, firmware, name })
}

/// `R7A0000001`: three characters of the series, three digits of the seed, four of the index.
pub(super) fn serial_number(series: ControllerSeries, seed: u64, index: usize) -> Result<SerialNumber, NameError> {
    let prefix = match series {
        ControllerSeries::Rc90 => "R9B",
        ControllerSeries::Rc700 => "R7A",
        ControllerSeries::TVt => "TVT",
        ControllerSeries::Rc800 => "RC8",
    };
    format!("{prefix}{:03}{:04}", seed % 1000, index + 1).parse()
}

/// SplitMix64: the same on every machine.
fn scatter(seed: u64, index: usize) -> u64 {
    let mut z = seed.wrapping_add((index as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}
