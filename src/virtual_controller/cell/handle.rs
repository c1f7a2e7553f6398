use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use parking_lot::Mutex;

use super::backup_memory::BackupMemory;
use super::command::{CellCommand, CommandRefusal, Setting, SettingRefusal};
use super::record::CellRecord;
use super::simulation::Cell;
use super::snapshot::{CellDescription, CellSnapshot};
use super::spel::error::SpelError;
use super::spel_declaration::SpelDeclaration;
use super::time::CellClock;
use super::variables::VariableError;
use crate::model::{SpelType, SpelValue};

/// How an Execute stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Execution {
    /// It still runs. Nothing changes before so much time has passed, unless something else acts on the cell.
    Running {
        /// At least a millisecond, at most a second.
        ask_again: Duration,
    },
    /// It has ended: what it printed, empty for nothing, or why it ended before its end.
    Ended(Result<String, SpelError>),
    /// Another one was begun since.
    Superseded,
}

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

    /// Begins to run a text of the SPEL+ subset, as the remote command Execute does. [`CellHandle::execution`] then says how
    /// the Execute with the returned number stands; a text that is not understood ends at once.
    pub fn execute(&self, text: &str) -> Result<u64, CommandRefusal> {
        self.change(|cell| cell.execute_text(text))
    }

    /// How an Execute stands.
    pub fn execution(&self, number: u64) -> Execution {
        let mut inner = self.0.inner.lock();
        inner.cell.advance_to(self.0.clock.now());
        let cell = &inner.cell;
        match cell.immediate_result(number) {
            Some(result) => Execution::Ended(result.clone()),
            None if cell.is_executing_number(number) => {
                let left = cell.next_event().map_or(0, |event| event.nanos_since(cell.now()));
                let ask_again = self.0.clock.real_time(Duration::from_nanos(left));
                Execution::Running { ask_again: ask_again.clamp(Duration::from_millis(1), Duration::from_secs(1)) }
            }
            None => Execution::Superseded,
        }
    }

    /// Whether an Execute still runs.
    pub fn is_executing(&self) -> bool {
        let mut inner = self.0.inner.lock();
        inner.cell.advance_to(self.0.clock.now());
        inner.cell.is_executing()
    }

    /// `count` values of a backup variable: of an array from an element on, of a scalar (1 value) with no element number. With
    /// a type, the variable must have been declared with it.
    pub fn variable(
        &self,
        name: &str,
        kind: Option<SpelType>,
        element: &[u16],
        count: usize,
    ) -> Result<Vec<SpelValue>, VariableError> {
        let mut inner = self.0.inner.lock();
        inner.cell.advance_to(self.0.clock.now());
        inner.cell.variable(name, kind, element, count).map(<[SpelValue]>::to_vec)
    }

    /// The type that a backup variable was declared with.
    pub fn variable_kind(&self, name: &str) -> Result<SpelType, VariableError> {
        self.0.inner.lock().cell.variable_kind(name)
    }

    /// The number of the robot that remote commands without a robot number are about, from 1 on.
    pub fn current_robot(&self) -> u8 {
        self.0.inner.lock().cell.current_robot()
    }

    /// The numbers of the alarms that last, in ascending order.
    pub fn alarms(&self) -> Vec<u8> {
        let mut inner = self.0.inner.lock();
        inner.cell.advance_to(self.0.clock.now());
        inner.cell.alarms()
    }

    /// What a power-off must not lose.
    pub fn backup(&self) -> BackupMemory {
        self.0.inner.lock().cell.backup()
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
