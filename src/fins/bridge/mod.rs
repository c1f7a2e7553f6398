//! A bridge copies words and bits between a PLC and a robot, cycle after cycle.
//!
//! | file | content |
//! |---|---|
//! | [`map`] | the file that says what is copied |
//! | [`robot`] | what a robot has to offer, and a PLC in the place of one |
//! | [`status`] | live values, counters and errors |
//! | [`cycle`] | one cycle |
//!
//! In each cycle every row is read at its source and then written to its destination, in the order of the file. A value
//! is written only when it was read in the same cycle, and only over a connection that stood before the row was read:
//! after a lost connection the next cycle reads first. A write whose answer was lost counts as unknown; the next cycle
//! reads and writes anew.

pub mod cycle;
pub mod map;
pub mod robot;
pub mod status;

#[cfg(test)]
mod tests;

use std::time::Duration;

use tokio::sync::watch;
use tokio::task::{JoinError, JoinHandle};
use tokio::time::MissedTickBehavior;
use tokio_util::sync::CancellationToken;

use super::client::{ClientSettings, FinsClient};
use map::{BridgeMap, Row};
use robot::{ItemError, RobotSide};
use status::BridgeStatus;

/// A bridge that does not run.
#[derive(Debug)]
pub struct Bridge {
    plc: FinsClient,
    robot: Box<dyn RobotSide>,
    rows: Vec<Row>,
    period: Duration,
    status: BridgeStatus,
}

/// A bridge that runs until it is stopped, or dropped.
#[derive(Debug)]
pub struct RunningBridge {
    status: watch::Receiver<BridgeStatus>,
    stop: CancellationToken,
    task: JoinHandle<Bridge>,
}

impl Bridge {
    /// A bridge between the PLC of a map and a robot.
    ///
    /// # Errors
    /// The robot cannot have a row's item. The number is that of the row, from 0.
    pub fn new(map: BridgeMap, robot: Box<dyn RobotSide>) -> Result<Self, (usize, ItemError)> {
        for (number, row) in map.rows.iter().enumerate() {
            robot.check(&row.item, row.direction).map_err(|error| (number, error))?;
        }
        // A write never connects: what is written was read before over connections that still stand.
        let settings = ClientSettings { connects_for_writes: false, ..map.plc };
        let status = BridgeStatus::new(map.rows.len());
        Ok(Self { plc: FinsClient::new(settings), robot, rows: map.rows, period: map.cycle, status })
    }

    /// The rows, in the order of the status.
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    /// Begins to copy. Counters go on from an earlier run.
    ///
    /// # Panics
    /// Outside a Tokio runtime.
    pub fn start(mut self) -> RunningBridge {
        self.status.is_running = true;
        let (sender, status) = watch::channel(self.status.clone());
        let stop = CancellationToken::new();
        let stopped = stop.clone();
        let task = tokio::spawn(async move {
            let mut ticks = tokio::time::interval(self.period);
            // A cycle that was late is not made up for.
            ticks.set_missed_tick_behavior(MissedTickBehavior::Delay);
            loop {
                tokio::select! {
                    biased;
                    () = stopped.cancelled() => break,
                    _ = ticks.tick() => {}
                }
                self.cycle(&stopped).await;
                sender.send_replace(self.status.clone());
            }
            self.status.is_running = false;
            sender.send_replace(self.status.clone());
            self
        });
        RunningBridge { status, stop, task }
    }
}

impl RunningBridge {
    /// The newest status, and a signal for each new one.
    pub fn status(&self) -> watch::Receiver<BridgeStatus> {
        self.status.clone()
    }

    /// Ends after the row that is being copied, which takes at most the times of the client and the robot.
    ///
    /// # Errors
    /// The task of the bridge panicked.
    pub async fn stop(mut self) -> Result<Bridge, JoinError> {
        self.stop.cancel();
        (&mut self.task).await
    }
}

impl Drop for RunningBridge {
    fn drop(&mut self) {
        self.stop.cancel();
    }
}
