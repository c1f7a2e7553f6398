use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use parking_lot::Mutex;

use super::command::{CellCommand, CommandRefusal, Setting, SettingRefusal};
use super::record::CellRecord;
use super::simulation::Cell;
use super::snapshot::{CellDescription, CellSnapshot};
use super::spel_value::SpelDeclaration;
use super::time::CellClock;

/// A cell with its clock, shared between the OPC UA server and what else acts on the cell. Clones are the same cell.
///
/// Every function first moves the cell to the time of its clock. Functions do not block longer than the calculation takes,
/// which is microseconds.
#[derive(Clone)]
pub struct CellHandle(Arc<Shared>);

struct Shared {
    clock: CellClock,
    inner: Mutex<Inner>,
}

struct Inner {
    cell: Cell,
    /// The latest snapshot, until time moves or something changes.
    snapshot: Option<Arc<CellSnapshot>>,
}

impl CellHandle {
    /// Shares `cell`, driven by `clock`.
    pub fn new(cell: Cell, clock: CellClock) -> Self {
        Self(Arc::new(Shared { clock, inner: Mutex::new(Inner { cell, snapshot: None }) }))
    }

    /// What the cell consists of.
    pub fn description(&self) -> Arc<CellDescription> {
        Arc::clone(self.0.inner.lock().cell.description())
    }

    /// The value of every node now. The values belong together: one snapshot is one moment.
    pub fn snapshot(&self) -> Arc<CellSnapshot> {
        let mut inner = self.0.inner.lock();
        let Inner { cell, snapshot } = &mut *inner;
        cell.advance_to(self.0.clock.now());
        match snapshot {
            Some(known) if known.time == cell.now() => Arc::clone(known),
            _ => Arc::clone(snapshot.insert(Arc::new(cell.snapshot()))),
        }
    }

    /// Moves the cell to the time of its clock. The other functions do so too; the time they take grows with the time that
    /// passed since, so this should be called every [`CellHandle::keep_up_period`].
    pub fn keep_up(&self) {
        self.0.inner.lock().cell.advance_to(self.0.clock.now());
    }

    /// Ten minutes of simulated time, but not less than a second of real time.
    pub fn keep_up_period(&self) -> Duration {
        self.0.clock.real_time(Duration::from_secs(600)).max(Duration::from_secs(1))
    }

    /// Takes a client's write, whole or not at all.
    pub fn write(&self, setting: Setting) -> Result<(), SettingRefusal> {
        self.change(|cell| cell.write(setting))
    }

    /// Does what is asked now, or nothing if it is refused.
    pub fn command(&self, command: CellCommand) -> Result<(), CommandRefusal> {
        self.change(|cell| cell.command(command))
    }

    /// Replaces the declared SPEL variables, as at a start of the OPC UA server. See [`Cell::declare_variables`].
    pub fn declare_variables(&self, declarations: Vec<SpelDeclaration>) {
        self.change(|cell| cell.declare_variables(declarations));
    }

    /// Reads the node Data of force sensor monitor `monitor` (1 or 2): the next header, data records or footer, never two
    /// kinds at once, or `None` if there is nothing. What is returned is taken out of the queue. Data records are whole
    /// records laid end to end, at most DataNum and not more than fit into `max_bytes`; a single packet that does not fit is
    /// returned all the same.
    pub fn read_force_data(&self, monitor: u8, max_bytes: usize) -> Option<Vec<u8>> {
        self.change(|cell| cell.read_force_data(monitor, max_bytes))
    }

    /// Reads the node Data of the motion log: whole blocks, at most DataNum and not more than fit into `max_bytes`, but at
    /// least one if there is one; `None` if there is none. What is returned is taken out of the queue.
    pub fn read_motion_log(&self, max_bytes: usize) -> Option<Vec<u8>> {
        self.change(|cell| cell.read_motion_log(max_bytes))
    }

    /// From now on, keeps the newest `limit` packets that are read, for a comparison with what a client has decoded.
    pub fn keep_record(&self, limit: usize) {
        self.change(|cell| cell.keep_record(limit));
    }

    /// What was read since [`CellHandle::keep_record`].
    pub fn record(&self) -> Option<CellRecord> {
        self.0.inner.lock().cell.record().cloned()
    }

    fn change<T>(&self, act: impl FnOnce(&mut Cell) -> T) -> T {
        let mut inner = self.0.inner.lock();
        inner.cell.advance_to(self.0.clock.now());
        inner.snapshot = None;
        act(&mut inner.cell)
    }
}

impl fmt::Debug for CellHandle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CellHandle").field("clock", &self.0.clock).finish_non_exhaustive()
    }
}
