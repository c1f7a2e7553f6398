use std::net::{IpAddr, Ipv4Addr, SocketAddr};
use std::path::Path;
use std::time::Duration;

use chrono::TimeDelta;
use secrecy::SecretString;
use tokio::task::spawn_blocking;

use super::cell::{CellOptions, RobotModel};
use super::controller::ControllerSpec;
use super::fleet::{
    FleetError, FleetFirmware, FolderLock, OutsideControl, plausible_identity, serial_number, shutdown_all, start_all,
};
use super::new_controller::{NewCertificate, NewController};
use super::opcua::AdmissionOptions;
use super::password::hash_connection_password;
use super::ports::free_port;
use super::remote::RemoteOptions;
use super::state::ControllerIdentity;
use super::switch_on::VirtualController;
use crate::model::{
    Address, ControllerName, ControllerSeries, FirmwareVersion, KeyLength, SecurityPolicy, ServerPort, StartupMode,
    UserTokenPolicy, Validity, clock,
};
use crate::pki::Fingerprint;

/// The connection password of every demo controller.
pub const DEMO_PASSWORD: &str = "demo";

/// How many controllers make a demo with everything in it.
pub const DEMO_COUNT: usize = 8;

/// Controllers worth looking at: old and new ones, running, stopped and in trouble.
#[derive(Debug)]
pub struct DemoFleet {
    controllers: Vec<VirtualController>,
    entries: Vec<DemoEntry>,
    _outside: OutsideControl,
    _lock: FolderLock,
}

/// What a list of controllers needs to know about one of the demo.
#[derive(Debug, Clone)]
pub struct DemoEntry {
    /// Its name.
    pub name: ControllerName,
    /// Its series.
    pub series: ControllerSeries,
    /// Where its management protocol answers.
    pub address: Address,
    /// `None` for the one that cannot be reached.
    pub fingerprint: Option<Fingerprint>,
    /// Its connection password.
    pub password: SecretString,
}

impl DemoFleet {
    /// In the order they are to be listed, the unreachable one among them.
    pub fn entries(&self) -> &[DemoEntry] {
        &self.entries
    }

    /// Those that are switched on.
    pub fn controllers(&self) -> &[VirtualController] {
        &self.controllers
    }

    /// Switches all controllers off and waits for that.
    pub async fn shutdown(self) {
        shutdown_all(self.controllers).await;
    }
}

/// Starts a demo of `count` controllers, [`DEMO_COUNT`] of which differ; those beyond are plain ones. Its state is
/// kept under `data`, and a demo that is started there again finds it as it was left, apart from its addresses.
pub async fn demo_fleet(data: &Path, bind: IpAddr, count: usize, seed: u64) -> Result<DemoFleet, FleetError> {
    let lock = FolderLock::take(data)?;
    let hash = spawn_blocking(|| hash_connection_password(&DEMO_PASSWORD.into()));
    let hash = hash.await??;
    let cast = (0..count).map(|index| role(seed, index)).collect::<Result<Vec<_>, _>>()?;
    let mut specs = Vec::new();
    for role in cast.iter().filter(|role| role.part != DemoPart::Unreachable) {
        specs.push(role.spec(data, bind, &hash)?);
    }
    let controllers = start_all(specs).await?;

    let host = if bind.is_unspecified() { IpAddr::V4(Ipv4Addr::LOCALHOST) } else { bind };
    let mut started = controllers.iter();
    let mut entries = Vec::with_capacity(cast.len());
    for role in cast {
        let controller = if role.part == DemoPart::Unreachable { None } else { started.next() };
        let (at, fingerprint) = match controller {
            Some(controller) => (controller.reachable_address(), Some(controller.fingerprint())),
            None => (SocketAddr::new(host, free_port(bind).map_err(FleetError::NoFreePort)?), None),
        };
        if let Some(controller) = controller
            && role.part == DemoPart::Slow
        {
            controller.faults().update(|switches| switches.latency = SLOWNESS);
        }
        entries.push(DemoEntry {
            name: role.identity.name,
            series: role.identity.series,
            address: address(at)?,
            fingerprint,
            password: DEMO_PASSWORD.into(),
        });
    }
    match OutsideControl::of(data, &controllers).await {
        Ok(outside) => Ok(DemoFleet { controllers, entries, _outside: outside, _lock: lock }),
        Err(error) => {
            shutdown_all(controllers).await;
            Err(error)
        }
    }
}

/// What a controller of the demo shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum DemoPart {
    Running,
    Stopped,
    ExpiredCertificate,
    ExpiresSoon,
    NotActivated,
    PortConflict,
    Slow,
    Unreachable,
    Plain,
}

struct DemoRole {
    part: DemoPart,
    identity: ControllerIdentity,
    cell: CellOptions,
}

/// How slow the slow one is, for each request.
const SLOWNESS: Duration = Duration::from_millis(1500);

fn role(seed: u64, index: usize) -> Result<DemoRole, FleetError> {
    use ControllerSeries::{Rc90, Rc700, Rc800, TVt};
    let version = FirmwareVersion::new;
    let (part, series, firmware, name) = match index {
        0 => (DemoPart::Running, Rc700, version(7, 5, 58), "焊接单元 3 号 – 主控制器"),
        1 => (DemoPart::Running, Rc800, version(8, 1, 0), "Assembly line 2"),
        2 => (DemoPart::ExpiresSoon, Rc800, version(8, 0, 0), "Packaging line 4, east hall, top"),
        3 => (DemoPart::ExpiredCertificate, Rc90, version(7, 5, 4), "装配线 A-12"),
        4 => (DemoPart::NotActivated, TVt, version(7, 5, 54), "Inspection VT6"),
        5 => (DemoPart::PortConflict, Rc700, version(7, 5, 4), "码垛机器人 7"),
        6 => (DemoPart::Slow, Rc90, version(7, 5, 6), "Old press, building B"),
        7 => (DemoPart::Unreachable, Rc800, version(8, 1, 2), "涂装车间 1 号"),
        _ => {
            let identity = plausible_identity(seed, index, FleetFirmware::Mixed)?;
            let part = if index.is_multiple_of(3) { DemoPart::Plain } else { DemoPart::Stopped };
            return Ok(DemoRole { part, identity, cell: cell(seed, index) });
        }
    };
    let serial = serial_number(series, seed, index)?;
    let identity = ControllerIdentity { serial, series, firmware, name: name.parse()? };
    Ok(DemoRole { part, identity, cell: cell(seed, index) })
}

/// A six-axis robot, a SCARA, or both on one controller.
fn cell(seed: u64, index: usize) -> CellOptions {
    let robots = match index % 3 {
        0 => vec![RobotModel::C4A601S],
        1 => vec![RobotModel::C4A601S, RobotModel::Gx4A251S],
        _ => vec![RobotModel::Gx4A251S],
    };
    CellOptions { robots, seed: seed.wrapping_add(index as u64), ..CellOptions::default() }
}

impl DemoRole {
    fn spec(&self, data: &Path, bind: IpAddr, hash: &str) -> Result<ControllerSpec, FleetError> {
        let folder = data.join(self.identity.serial.folder_name());
        let mut initial = NewController::new(self.identity.clone(), hash.to_owned());
        let port = free_port(bind).map_err(FleetError::NoFreePort)?;
        initial.settings.port = ServerPort::try_from(port)?;
        initial.used_ports.retain(|used| *used != port);
        initial.settings.user_tokens.insert(UserTokenPolicy::Anonymous);
        initial.certificate = match self.part {
            DemoPart::ExpiredCertificate => certificate(1, TimeDelta::days(-40)),
            DemoPart::ExpiresSoon => certificate(2, TimeDelta::days(12)),
            DemoPart::NotActivated | DemoPart::Plain => None,
            _ => certificate(5, TimeDelta::days(1400)),
        };
        match self.part {
            DemoPart::Running | DemoPart::ExpiresSoon | DemoPart::ExpiredCertificate | DemoPart::Slow => {
                initial.settings.startup = StartupMode::Auto;
            }
            DemoPart::NotActivated => initial.activated = false,
            DemoPart::PortConflict => {
                initial.settings.startup = StartupMode::Auto;
                initial.used_ports.push(port);
            }
            DemoPart::Stopped | DemoPart::Unreachable | DemoPart::Plain => {}
        }
        if self.part == DemoPart::Slow {
            // What old installations look like.
            initial.settings.security_policies.insert(SecurityPolicy::None);
            initial.settings.security_policies.insert(SecurityPolicy::Basic256);
        }
        Ok(ControllerSpec {
            folder,
            bind,
            management_port: 0,
            admission: AdmissionOptions::default(),
            cell: self.cell.clone(),
            remote: RemoteOptions::default(),
            initial,
        })
    }
}

/// A certificate of so many years that ends so far from now.
fn certificate(years: u8, ends_in: TimeDelta) -> Option<NewCertificate> {
    let validity = Validity::try_from(years).ok()?;
    Some(NewCertificate {
        key_length: KeyLength::Rsa2048,
        made: clock::now() + ends_in - validity.duration(),
        validity,
    })
}

fn address(at: SocketAddr) -> Result<Address, FleetError> {
    Ok(at.to_string().parse()?)
}
