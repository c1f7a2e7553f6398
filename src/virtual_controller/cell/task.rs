use super::program::{Function, Statement};
use super::status::TaskState;
use super::time::CellTime;

/// A task and where in its function it is.
#[derive(Debug, Default)]
pub(super) struct Task {
    function: Option<Function>,
    /// Index of the statement that is next, or that is being executed.
    at: usize,
    phase: Phase,
    /// Monitor of the recording that the task started.
    pub monitor: Option<usize>,
    pub cycles: u32,
    /// When the cycle in progress began.
    pub cycle_start: CellTime,
}

/// What a task is doing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Phase {
    #[default]
    Finished,
    Failed,
    /// Goes on at this moment, with the statement `at`.
    Waiting {
        until: CellTime,
    },
    /// A motion of this robot ends at this moment; then the next statement comes.
    Moving {
        robot: usize,
        until: CellTime,
    },
    /// Stopped before the statement `at` in step mode.
    Halted,
    /// After so many nanoseconds more it goes on with the statement `at`.
    Paused {
        left: u64,
        /// To be halted again.
        halted: bool,
    },
}

impl Task {
    /// Runs a function from its beginning, from `now` on.
    pub fn start(&mut self, function: Function, now: CellTime) {
        *self = Self {
            function: Some(function),
            phase: Phase::Waiting { until: now },
            cycle_start: now,
            ..Self::default()
        };
    }

    /// Name and file of the function that runs or ran last; empty if none ever did.
    pub fn names(&self) -> (&'static str, &'static str) {
        self.function.as_ref().map_or(("", ""), |function| (function.name, function.file))
    }

    pub fn state(&self, now: CellTime) -> TaskState {
        match self.phase {
            Phase::Finished => TaskState::Finished,
            Phase::Failed => TaskState::Error,
            Phase::Waiting { until } if until > now => TaskState::Waiting,
            Phase::Waiting { .. } | Phase::Moving { .. } => TaskState::Running,
            Phase::Halted => TaskState::Halted,
            Phase::Paused { .. } => TaskState::Paused,
        }
    }

    /// Executes, waits, is halted or paused.
    pub const fn is_loaded(&self) -> bool {
        !matches!(self.phase, Phase::Finished | Phase::Failed)
    }

    pub const fn is_paused(&self) -> bool {
        matches!(self.phase, Phase::Paused { .. })
    }

    pub const fn is_halted(&self) -> bool {
        matches!(self.phase, Phase::Halted)
    }

    /// When the task does something next.
    pub const fn wakes_at(&self) -> Option<CellTime> {
        match self.phase {
            Phase::Waiting { until } | Phase::Moving { until, .. } => Some(until),
            _ => None,
        }
    }

    /// The robot that executes a motion of this task.
    pub const fn moving_robot(&self) -> Option<usize> {
        match self.phase {
            Phase::Moving { robot, .. } => Some(robot),
            _ => None,
        }
    }

    /// The motion in progress is over.
    pub fn arrive(&mut self) {
        if matches!(self.phase, Phase::Moving { .. }) {
            self.at += 1;
        }
    }

    /// The statement that is next; `None` at the function's end.
    pub fn statement(&self) -> Option<Statement> {
        self.function.as_ref()?.code.get(self.at).copied()
    }

    pub fn next(&mut self) {
        self.at += 1;
    }

    pub fn jump(&mut self, to: usize) {
        self.at = to;
    }

    pub fn wait(&mut self, until: CellTime) {
        self.phase = Phase::Waiting { until };
    }

    pub fn follow_motion(&mut self, robot: usize, until: CellTime) {
        self.phase = Phase::Moving { robot, until };
    }

    pub fn halt(&mut self) {
        self.phase = Phase::Halted;
    }

    /// Ends the task.
    pub fn finish(&mut self) {
        self.phase = Phase::Finished;
    }

    /// Ends the task with an error.
    pub fn fail(&mut self) {
        self.phase = Phase::Failed;
    }

    /// Stops the task until [`Task::resume`]. A motion in progress has to be executed again from where it was stopped.
    pub fn pause(&mut self, now: CellTime) {
        self.phase = match self.phase {
            Phase::Waiting { until } => Phase::Paused { left: until.nanos_since(now), halted: false },
            Phase::Moving { .. } => Phase::Paused { left: 0, halted: false },
            Phase::Halted => Phase::Paused { left: 0, halted: true },
            other => other,
        };
    }

    /// Goes on, not before `earliest`.
    pub fn resume(&mut self, now: CellTime, earliest: CellTime) {
        if let Phase::Paused { left, halted } = self.phase {
            self.phase =
                if halted { Phase::Halted } else { Phase::Waiting { until: now.plus_nanos(left).max(earliest) } };
        }
    }
}
