use std::net::SocketAddr;
use std::sync::Arc;

use parking_lot::Mutex;
use tokio::net::TcpListener;
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;

use super::api::ManagementApi;
use super::cell::CellHandle;
use super::controller::{Controller, ControllerSpec, SwitchOnError};
use super::faults::Faults;
use super::remote::RemoteServer;
use super::state::ControllerState;
use super::{listener, tls};
use crate::model::{ControllerInfo, ControllerName, ControllerSeries, FirmwareVersion, SerialNumber, StartupMode};
use crate::pki::Fingerprint;

/// One virtual controller, switched on: its management protocol answers, and its OPC UA server runs when it should.
///
/// Dropped without [`VirtualController::shutdown`], it stops too, without waiting.
#[derive(Debug)]
pub struct VirtualController {
    controller: Arc<Controller>,
    address: SocketAddr,
    fingerprint: Fingerprint,
    off: CancellationToken,
    api: Mutex<Option<JoinHandle<()>>>,
    remote: RemoteServer,
}

impl VirtualController {
    /// Switches the controller on. With startup mode AUTO its OPC UA server is started too; should that fail, the
    /// controller is up all the same and says so in its status.
    pub async fn start(spec: ControllerSpec) -> Result<Self, SwitchOnError> {
        let address = SocketAddr::new(spec.bind, spec.management_port);
        let listen = |source| SwitchOnError::Listen { address, source };
        let listener = TcpListener::bind(address).await.map_err(listen)?;
        let address = listener.local_addr().map_err(listen)?;

        let (bind, remote) = (spec.bind, spec.remote.clone());
        let controller = Arc::new(Controller::open(spec, address.port()).await?);
        let cell = controller.cell().clone();
        let remote = RemoteServer::start_kept(bind, remote, cell, controller.kept().clone()).await?;
        let state = controller.state();
        let config = tls::server_config(&state.management)?;
        let fingerprint = Fingerprint::of(&state.management.certificate.0);
        if state.settings.startup == StartupMode::Auto
            && let Err(error) = controller.start_server_now().await
        {
            tracing::warn!(serial = %state.identity.serial, %error, "the OPC UA server did not start");
        }
        let off = CancellationToken::new();
        tokio::spawn(stop_when_log_is_full(Arc::clone(&controller), off.clone()));
        tokio::spawn(Arc::clone(controller.rejected()).keep(off.clone()));
        tokio::spawn(keep_up(controller.cell().clone(), off.clone()));
        let api = tokio::spawn(listener::serve(
            listener,
            config,
            Arc::new(ManagementApi::new(Arc::clone(&controller))),
            off.clone(),
        ));
        Ok(Self { controller, address, fingerprint, off, api: Mutex::new(Some(api)), remote })
    }

    /// Where the management protocol answers.
    pub fn management_address(&self) -> SocketAddr {
        self.address
    }

    /// [`Self::management_address`] as a program on this machine reaches it, also when the controller listens on every
    /// address.
    pub fn reachable_address(&self) -> SocketAddr {
        SocketAddr::new(self.controller.operating_context().address(), self.address.port())
    }

    /// SHA-256 of the management identity, which a configurator pins.
    pub fn fingerprint(&self) -> Fingerprint {
        self.fingerprint
    }

    /// `opc.tcp://host:port` of the OPC UA server, running or not.
    pub fn endpoint(&self) -> String {
        self.controller.endpoint(None)
    }

    /// What "Get new information" reads.
    pub fn info(&self) -> ControllerInfo {
        self.controller.info(None)
    }

    /// The switches that make this controller misbehave.
    pub fn faults(&self) -> Faults {
        self.controller.faults().clone()
    }

    /// The simulated cell behind this controller.
    pub fn cell(&self) -> &CellHandle {
        self.controller.cell()
    }

    /// Where it answers remote commands.
    pub fn remote(&self) -> &RemoteServer {
        &self.remote
    }

    /// Its serial number.
    pub fn serial(&self) -> SerialNumber {
        self.controller.state().identity.serial.clone()
    }

    /// Its series.
    pub fn series(&self) -> ControllerSeries {
        self.controller.state().identity.series
    }

    /// Its firmware.
    pub fn firmware(&self) -> FirmwareVersion {
        self.controller.state().identity.firmware
    }

    /// The name the controller itself carries.
    pub fn name(&self) -> ControllerName {
        self.controller.state().identity.name.clone()
    }

    /// Everything the controller remembers, as it is now.
    pub fn state(&self) -> Arc<ControllerState> {
        self.controller.state()
    }

    /// Switches the controller off: a change in hand is finished, the OPC UA server stopped, every connection closed.
    pub async fn shutdown(&self) {
        self.off.cancel();
        self.remote.stop().await;
        self.controller.switch_off().await;
        self.controller.rejected().write_soon().await;
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

async fn stop_when_log_is_full(controller: Arc<Controller>, off: CancellationToken) {
    loop {
        tokio::select! {
            () = off.cancelled() => return,
            () = controller.log().filled() => controller.stop_if_log_is_full().await,
        }
    }
}

/// Moves the cell on now and then, so that nobody who looks after a long time waits for its past.
async fn keep_up(cell: CellHandle, off: CancellationToken) {
    loop {
        tokio::select! {
            () = off.cancelled() => return,
            () = tokio::time::sleep(cell.keep_up_period()) => cell.keep_up(),
        }
    }
}
