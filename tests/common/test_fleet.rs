//! A plant on this machine: virtual controllers in this process, and jobs that reach them over loopback as they would
//! reach real ones.

use std::net::{IpAddr, Ipv4Addr};
use std::sync::Arc;
use std::time::Duration;

use opcua_configurator::jobs::{
    self, ControllerReport, JobContext, JobController, JobEvent, JobSummary, Operation, OperationOutput,
};
use opcua_configurator::model::ConnectionKind;
use opcua_configurator::pki::Fingerprint;
use opcua_configurator::session::{ManagementConnector, ManagementTimeouts};
use opcua_configurator::virtual_controller::cell::CellOptions;
use opcua_configurator::virtual_controller::remote::RemoteOptions;
use opcua_configurator::virtual_controller::{AdmissionOptions, Fleet, FleetConfig, FleetFirmware, VirtualController};
use opcua_configurator::workspace::{MemoryPasswords, Passwords as _};
use parking_lot::Mutex;
use tokio_util::sync::CancellationToken;

pub const PASSWORD: &str = "plant-password";

pub struct TestFleet {
    fleet: Fleet,
    pub passwords: Arc<MemoryPasswords>,
    pub connector: ManagementConnector,
    _folder: tempfile::TempDir,
}

impl TestFleet {
    pub async fn start(count: usize, firmware: FleetFirmware) -> Self {
        Self::made(count, firmware, true, PASSWORD, RemoteOptions::default()).await
    }

    /// Controllers whose connection password is empty.
    pub async fn without_password(count: usize, firmware: FleetFirmware) -> Self {
        Self::made(count, firmware, true, "", RemoteOptions::default()).await
    }

    /// Legacy controllers whose OPC UA function is not activated yet.
    pub async fn not_activated(count: usize) -> Self {
        Self::made(count, FleetFirmware::Legacy, false, PASSWORD, RemoteOptions::default()).await
    }

    /// Controllers that answer remote commands.
    pub async fn with_remote(count: usize, firmware: FleetFirmware, remote: RemoteOptions) -> Self {
        Self::made(count, firmware, true, PASSWORD, remote).await
    }

    async fn made(
        count: usize,
        firmware: FleetFirmware,
        activated: bool,
        password: &str,
        remote: RemoteOptions,
    ) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let fleet = Fleet::start(FleetConfig {
            count,
            bind: IpAddr::V4(Ipv4Addr::LOCALHOST),
            management_port: 0,
            opcua_port: 0,
            firmware,
            activated,
            password: password.into(),
            data: folder.path().to_owned(),
            admission: AdmissionOptions::default(),
            cell: CellOptions::default(),
            remote,
            seed: 7,
        })
        .await
        .unwrap();
        let passwords = Arc::new(MemoryPasswords::default());
        for controller in fleet.controllers() {
            passwords.set(controller.fingerprint(), password.into()).unwrap();
        }
        let timeouts = ManagementTimeouts {
            connect: Duration::from_secs(5),
            read: Duration::from_secs(10),
            change: Duration::from_secs(60),
        };
        Self { fleet, passwords, connector: ManagementConnector { timeouts }, _folder: folder }
    }

    pub fn controller(&self, index: usize) -> &VirtualController {
        &self.fleet.controllers()[index]
    }

    /// As the configurator's list has them: named "cell 1", "cell 2", …
    pub fn listed(&self) -> Vec<JobController> {
        let listed = |(index, controller): (usize, &VirtualController)| JobController {
            name: format!("cell {}", index + 1).parse().unwrap(),
            address: controller.management_address().to_string().parse().unwrap(),
            connection: ConnectionKind::Management,
            fingerprint: Some(controller.fingerprint()),
            known: None,
        };
        self.fleet.controllers().iter().enumerate().map(listed).collect()
    }

    pub fn context(&self) -> JobContext {
        JobContext::new(Arc::new(self.connector), self.passwords.clone(), 16)
    }

    /// Runs an operation on every controller; reports in list order.
    pub async fn run<O: OperationOutput>(
        &self,
        operation: impl Operation<Output = O> + 'static,
    ) -> Vec<ControllerReport<O>> {
        run(self.listed(), operation, self.context(), CancellationToken::new(), |_| {}).await.0
    }
}

/// Runs an operation, watching its events; reports in list order.
pub async fn run<O: OperationOutput>(
    controllers: Vec<JobController>,
    operation: impl Operation<Output = O> + 'static,
    context: JobContext,
    cancel: CancellationToken,
    watch: impl Fn(&JobEvent<O>) + Send + Sync + 'static,
) -> (Vec<ControllerReport<O>>, JobSummary) {
    let reports = Arc::new(Mutex::new(controllers.iter().map(|_| None).collect::<Vec<_>>()));
    let kept = reports.clone();
    let job = jobs::run(controllers, Arc::new(operation), context, cancel, move |event| {
        watch(&event);
        if let JobEvent::Finished { index, report } = event {
            assert!(kept.lock()[index].replace(*report).is_none(), "finished twice");
        }
    });
    let summary = tokio::time::timeout(Duration::from_secs(120), job).await.expect("a bounded job");
    let reports = reports.lock().drain(..).map(|r| r.expect("every controller is reported")).collect();
    (reports, summary)
}

/// The fingerprint of a controller that is not in this fleet.
pub fn nobody() -> Fingerprint {
    Fingerprint::of(b"nobody")
}
