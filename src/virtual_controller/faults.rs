use std::sync::Arc;
use std::time::Duration;

use chrono::{DateTime, TimeDelta, Utc};
use parking_lot::Mutex;
use thiserror::Error;

use crate::model::clock;

/// The fault switches of one controller, set at run time by a test or a demonstration. Clones share them.
#[derive(Debug, Clone, Default)]
pub struct Faults(Arc<Mutex<FaultSwitches>>);

/// What is wrong with a controller. By default nothing is.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FaultSwitches {
    /// The controller runs a program: it answers questions but refuses changes, start and stop.
    pub task_running: bool,
    /// A teach pendant has control: as with a running task.
    pub teach_pendant_connected: bool,
    /// The controller refuses changes, start and stop without saying why.
    pub refuse: bool,
    /// Nothing more can be written to the controller's storage.
    pub disk_full: bool,
    /// The OPC UA server fails to start (580).
    pub server_error: bool,
    /// The server log is full at so many bytes, instead of 1 MiB.
    pub log_limit: Option<u64>,
    /// How long every request waits before the controller looks at it.
    pub latency: Duration,
    /// How far the controller's clock is ahead; negative: behind.
    pub clock_offset: TimeDelta,
    /// The next change loses its connection there. Thrown back once that has happened.
    pub drop_next_change: Option<DropPoint>,
}

/// Where in a change the connection is lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DropPoint {
    /// Checked and staged, but nothing applied: the change must leave no trace.
    BeforeApply,
    /// Applied, but the answer is lost: the client has to find out by reading the revision.
    AfterApply,
}

/// The switch that refuses a change, a start or a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum FaultRefusal {
    #[error("the controller runs a program")]
    TaskRunning,
    #[error("a teach pendant has control")]
    TeachPendantConnected,
    #[error("the controller refuses without a reason")]
    Refused,
}

impl Faults {
    /// How the switches stand now.
    pub fn get(&self) -> FaultSwitches {
        self.0.lock().clone()
    }

    /// Changes switches. Takes effect with the next request.
    pub fn update(&self, throw: impl FnOnce(&mut FaultSwitches)) {
        throw(&mut self.0.lock());
    }

    /// Whether what is wrong forbids changes, start and stop. Questions are answered all the same, so that an
    /// engineer sees the controller in the list while it works (manual 6.2 speaks of refused connections).
    pub(super) fn admit_change(&self) -> Result<(), FaultRefusal> {
        let switches = self.0.lock();
        if switches.task_running {
            Err(FaultRefusal::TaskRunning)
        } else if switches.teach_pendant_connected {
            Err(FaultRefusal::TeachPendantConnected)
        } else if switches.refuse {
            Err(FaultRefusal::Refused)
        } else {
            Ok(())
        }
    }

    /// Takes the order to drop the connection, if it is for this point.
    pub(super) fn take_drop(&self, point: DropPoint) -> bool {
        let mut switches = self.0.lock();
        let hit = switches.drop_next_change == Some(point);
        if hit {
            switches.drop_next_change = None;
        }
        hit
    }

    /// The controller's clock.
    pub(super) fn now(&self) -> DateTime<Utc> {
        let offset = self.0.lock().clock_offset;
        let now = clock::now();
        now.checked_add_signed(offset).unwrap_or(now)
    }
}
