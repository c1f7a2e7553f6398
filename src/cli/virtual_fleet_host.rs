//! The demo's controllers inside the program: for `demo`, and for the welcome page of an empty workspace.

use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;
use std::sync::Arc;

use async_trait::async_trait;
use parking_lot::Mutex;
use tokio::runtime::{Handle, Runtime};

use super::runtime;
use crate::model::{ConnectionKind, ErrorCode, Problem, clock};
use crate::pki::Fingerprint;
use crate::ui::backend::{NewVirtualController, VirtualFleetStarter};
use crate::virtual_controller::{DEMO_COUNT, DemoEntry, DemoFleet, demo_fleet};
use crate::workspace::{Configuration, ControllerEntry, Passwords, RetrievedInfo};

/// Runs the demo's controllers on a runtime of their own for as long as it lives.
pub struct VirtualFleetHost {
    runtime: Runtime,
    shared: Arc<SharedFleet>,
}

/// What the welcome page gets hold of.
struct SharedFleet {
    handle: Handle,
    data: PathBuf,
    count: usize,
    seed: u64,
    fleet: Mutex<Option<DemoFleet>>,
}

impl VirtualFleetHost {
    /// Nothing runs yet. `data` keeps what the controllers remember.
    pub fn new(data: PathBuf, count: usize, seed: u64) -> Result<Self, Problem> {
        let runtime = runtime()?;
        let handle = runtime.handle().clone();
        Ok(Self { runtime, shared: Arc::new(SharedFleet { handle, data, count, seed, fleet: Mutex::new(None) }) })
    }

    /// The usual demo, kept in a workspace.
    pub fn in_workspace(root: &std::path::Path) -> Result<Self, Problem> {
        Self::new(root.join("virtual"), DEMO_COUNT, 1)
    }

    /// Whether controllers were started here before.
    pub fn has_controllers(&self) -> bool {
        self.shared.data.is_dir()
    }

    pub fn starter(&self) -> Arc<dyn VirtualFleetStarter> {
        self.shared.clone()
    }

    /// Starts the controllers now and enters them into a list: new ones at its end, known ones at their new address.
    pub fn enter(&self, configuration: &mut Configuration, passwords: &dyn Passwords) -> Result<(), Problem> {
        for NewVirtualController { entry, password } in self.runtime.block_on(self.shared.start())? {
            if let Some(fingerprint) = entry.fingerprint {
                // The password is of use to this process only, so a failure of the keyring is not reported.
                let _kept = passwords.set(fingerprint, password.into());
            }
            match configuration.controllers.iter_mut().find(|known| known.fingerprint == entry.fingerprint) {
                Some(known) => known.address = entry.address,
                None => configuration.controllers.push(entry),
            }
        }
        Ok(())
    }

    /// Switches the controllers off and waits for them.
    pub fn shutdown(self) {
        let fleet = self.shared.fleet.lock().take();
        if let Some(fleet) = fleet {
            self.runtime.block_on(fleet.shutdown());
        }
    }
}

#[async_trait]
impl VirtualFleetStarter for SharedFleet {
    async fn start(&self) -> Result<Vec<NewVirtualController>, Problem> {
        let (data, count, seed) = (self.data.clone(), self.count, self.seed);
        let fleet = self
            .handle
            .spawn(async move { demo_fleet(&data, IpAddr::V4(Ipv4Addr::LOCALHOST), count, seed).await })
            .await
            .map_err(|e| Problem::with_detail(ErrorCode::Internal, e))??;
        let listed = fleet.entries().iter().map(|entry| listed(entry, &fleet)).collect();
        *self.fleet.lock() = Some(fleet);
        Ok(listed)
    }
}

fn listed(entry: &DemoEntry, fleet: &DemoFleet) -> NewVirtualController {
    let running = fleet.controllers().iter().find(|c| Some(c.fingerprint()) == entry.fingerprint);
    // The one that cannot be reached was met once, as every controller in a list.
    let fingerprint = entry.fingerprint.unwrap_or_else(|| Fingerprint::of(entry.name.as_str().as_bytes()));
    NewVirtualController {
        entry: ControllerEntry {
            name: entry.name.clone(),
            address: entry.address.clone(),
            series: entry.series,
            connection: ConnectionKind::Management,
            fingerprint: Some(fingerprint),
            last: running.map(|controller| RetrievedInfo { at: clock::now(), info: controller.info() }),
        },
        password: entry.password.clone(),
    }
}
