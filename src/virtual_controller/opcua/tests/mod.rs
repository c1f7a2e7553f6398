//! A real server and the crate's own client, over loopback.

mod admission;
mod chains;
mod client;
mod hostile;
mod impersonating_proxy;
mod remote;
mod resource_exhaustion;
mod server;
mod sessions;
pub(super) mod test_application;
mod values;

use std::net::{IpAddr, Ipv4Addr};
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use parking_lot::Mutex;
use tempfile::TempDir;
use tokio::time::timeout;
use zeroize::Zeroizing;

use super::*;
use crate::model::{ControllerSeries, FirmwareVersion, SecurityPolicy, UserTokenPolicy};
use crate::pki::{Certificate, CertificateRejection, TrustLists, TrustPolicy};
use crate::virtual_controller::cell::{BackupMemory, Cell, CellClock, CellConfig, CellHandle, CellOptions};
use client::{Client, ClientOptions};
use test_application::{TestApplication, trusting};

const URI: &str = "urn:EpsonRC.SN0000123.127.000.000.001";
const WAIT_LIMIT: Duration = Duration::from_secs(90);

static SERVER: LazyLock<TestApplication> = LazyLock::new(|| TestApplication::new("EpsonRC.SN0000123.127.000.000.001"));
static CLIENT: LazyLock<TestApplication> = LazyLock::new(|| TestApplication::new("client"));

fn config(folder: &TempDir) -> OpcUaConfig {
    OpcUaConfig {
        application_name: "EpsonRC.SN0000123.127.000.000.001".to_owned(),
        application_uri: URI.to_owned(),
        bind: Ipv4Addr::LOCALHOST.into(),
        port: 0,
        policies: SecurityPolicy::ALL.into(),
        user_tokens: UserTokenPolicy::ALL.into(),
        users: vec![],
        certificate_der: SERVER.der.clone(),
        private_key_pkcs8: Zeroizing::new(SERVER.key.serialize_der()),
        trust: TrustLists::default(),
        trust_policy: TrustPolicy::default(),
        detailed_status: false,
        refusals: None,
        clock: CertificateClock::default(),
        cell: cell(CellClock::manual()),
        events: ServerEvents::default(),
        pki_folder: folder.path().join("pki"),
    }
}

/// The cell of a controller with current firmware and a six-axis robot.
fn cell(clock: CellClock) -> CellHandle {
    let config = CellConfig {
        name: "Weld 1".parse().unwrap(),
        serial: "SN0000123".parse().unwrap(),
        series: ControllerSeries::Rc800,
        firmware: FirmwareVersion::new(8, 0, 1),
        started: chrono::DateTime::UNIX_EPOCH,
        variables: Vec::new(),
        backup: BackupMemory::default(),
        options: CellOptions::default(),
    };
    CellHandle::new(Cell::new(config), clock)
}

async fn start(config: OpcUaConfig) -> OpcUaServer {
    timeout(WAIT_LIMIT, OpcUaServer::start(config)).await.unwrap().unwrap()
}

/// What a server told, a line each.
#[derive(Clone, Default)]
struct EventLines(Arc<Mutex<String>>);

impl EventLines {
    fn events(&self) -> ServerEvents {
        let log = self.0.clone();
        ServerEvents::new(move |event| *log.lock() += &format!("{event}\n"))
    }

    fn lines(&self) -> String {
        self.0.lock().clone()
    }

    /// Waits for a line with this in it.
    async fn wait_for(&self, text: &str) {
        let seen = timeout(WAIT_LIMIT, async {
            while !self.lines().contains(text) {
                tokio::time::sleep(Duration::from_millis(10)).await;
            }
        });
        assert!(seen.await.is_ok(), "{text:?} is not in\n{}", self.lines());
    }
}

/// The rejected clients: what was sent, from where, and why it was refused.
#[derive(Default)]
struct RecordedRejections(Mutex<Vec<(Vec<Certificate>, IpAddr, CertificateRejection)>>);

impl RejectionRecorder for RecordedRejections {
    fn record(&self, sent: &[Certificate], address: IpAddr, rejection: &CertificateRejection) {
        self.0.lock().push((sent.to_vec(), address, rejection.clone()));
    }
}
