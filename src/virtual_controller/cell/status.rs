pub use crate::model::{StatusFlag, StatusFlags};

/// The operating mode of the controller, chosen with the mode switch of the teach pendant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum OperatingMode {
    /// AUTO: programs run at full speed, and remote commands are accepted.
    Auto,
    /// TEACH: reduced speed (T1).
    Teach,
    /// TEST: full speed in manual operation (T2).
    Test,
}

impl OperatingMode {
    /// The value of OperationalMode (manual 3.2.2.1; OPC 40010-1, OperationalModeEnumeration): 1
    /// MANUAL_REDUCED_SPEED, 2 MANUAL_HIGH_SPEED, 3 AUTOMATIC.
    pub const fn operational_mode(self) -> i32 {
        match self {
            Self::Teach => 1,
            Self::Test => 2,
            Self::Auto => 3,
        }
    }
}

/// How a task's program is executed (manual 3.2.2.1; OPC 40010-1, ExecutionModeEnumeration).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ExecutionMode {
    /// Normal execution: CYCLE.
    Cycle,
    /// Step in, step over or walk: STEP.
    Step,
}

impl ExecutionMode {
    /// The value of ExecutionMode: 0 CYCLE, 2 STEP.
    pub const fn value(self) -> i32 {
        match self {
            Self::Cycle => 0,
            Self::Step => 2,
        }
    }
}

/// The state of a task.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TaskState {
    /// Executes statements.
    Running,
    /// Executes a Wait statement.
    Waiting,
    /// Stopped between two steps.
    Halted,
    /// Paused by Pause or by the safeguard.
    Paused,
    /// Stopped by an error.
    Error,
    /// Not started, ended or aborted.
    Finished,
}

impl TaskState {
    /// The value of TaskProgramLoaded: the task executes, waits or is paused (manual 3.2.2.1).
    pub const fn is_loaded(self) -> bool {
        matches!(self, Self::Running | Self::Waiting | Self::Halted | Self::Paused)
    }
}

/// The kind of a task.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TaskKind {
    /// Started by Start or by another task; stopped by Stop.
    Normal,
    /// Runs from power-on in every safety state.
    Background,
}

/// A part that wears (manual 3.2.3.7).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Part {
    /// Battery of the controller or of the robot's encoders.
    Battery,
    /// Timing belt.
    Belt,
    /// Grease.
    Grease,
    /// Motor.
    Motor,
    /// Reduction gear.
    Gear,
    /// Ball screw spline.
    BallScrewSpline,
}

impl Part {
    /// The parts of an axis, in the order of the manual.
    pub const OF_AXIS: [Self; 6] =
        [Self::Battery, Self::Belt, Self::Grease, Self::Motor, Self::Gear, Self::BallScrewSpline];

    /// The name of the part's node.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Battery => "Battery",
            Self::Belt => "Belt",
            Self::Grease => "Grease",
            Self::Motor => "Motor",
            Self::Gear => "Gear",
            Self::BallScrewSpline => "BallScrewSpline",
        }
    }
}

/// Whether data is recorded: the nodes MonitorStatus and LoggingStatus (manual 3.2.3.2, 3.2.3.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum RecordingStatus {
    /// Not recording.
    #[default]
    Stop,
    /// Recording.
    Run,
}

impl RecordingStatus {
    /// The node's value.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Stop => "Stop",
            Self::Run => "Run",
        }
    }
}

/// Whether the node Data has something to be read: the node DataExistsStatus. (Section 4.3.2 once calls the empty state
/// Stop.)
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum DataStatus {
    /// Nothing to be read.
    #[default]
    Empty,
    /// The next read of Data gives data.
    Ready,
}

impl DataStatus {
    /// The node's value.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Empty => "Empty",
            Self::Ready => "Ready",
        }
    }
}

/// What went wrong in a queue: the node ErrorStatus.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum QueueStatus {
    /// Nothing.
    #[default]
    None,
    /// Data was overwritten since the last read of Data.
    Warning,
    /// Recording was broken off.
    Error,
}

impl QueueStatus {
    /// The node's value.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::None => "None",
            Self::Warning => "Warning",
            Self::Error => "Error",
        }
    }
}
