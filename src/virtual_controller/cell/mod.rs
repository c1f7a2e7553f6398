//! The simulated cell behind a virtual controller: robots, a program, I/O, safety, wear, and the data that the force sensor
//! and the motion log produce (manual 3.2 and chapter 4).
//!
//! Plain, synchronous calculation: no I/O, no threads, no OPC UA. A [`Cell`] is a function of its [`CellConfig`], of
//! simulated time ([`CellTime`]) and of what was asked of it at which simulated time; a [`CellHandle`] shares it and drives
//! it by a [`CellClock`], which may run faster than real time.
//!
//! # Files
//! Each uses only those above it; the `impl` blocks of [`Cell`] at the end are one concern each.
//!
//! | file | idea |
//! |---|---|
//! | `time` | [`CellTime`], [`CellClock`], [`ClockRate`] |
//! | `noise` | numbers that look random and follow from a seed |
//! | `robot_model` | [`RobotModel`]: the figures of the robots |
//! | `io` | [`IoPort`], [`IoValues`]: ports, bit numbers, bits |
//! | `status` | states, modes and status texts of nodes |
//! | `spel_declaration` | [`SpelDeclaration`]: one backup variable |
//! | `spel_declarations` | [`SpelDeclarations`]: the project file that declares backup variables |
//! | `backup_memory` | [`BackupMemory`]: what outlives a power-off |
//! | `spel` | the SPEL+ subset of Execute: statements, before they are executed |
//! | `snapshot` | [`CellDescription`] and [`CellSnapshot`]: everything that the address space shows |
//! | `config` | [`CellConfig`]: what a cell is built from |
//! | `command` | [`CellCommand`], [`Setting`] and why they are refused |
//! | `command_text` | commands as text |
//! | `settings` | the configuration nodes of both data acquisitions |
//! | `variables` | the declared backup variables with their values |
//! | `kinematics` | joints to pose and back |
//! | `dynamics` | joint torques |
//! | `profile` | trapezoidal speed along a path |
//! | `motion` | one motion, and the load it puts on the joints |
//! | `wear` | parts that wear |
//! | `robot` | one robot over time: motions, overload rates, temperatures |
//! | `robot_unit` | a robot with its wear and settings |
//! | `force` | what a force sensor feels |
//! | `program` | the statements of the tasks |
//! | `task` | one task and where it is |
//! | `io_history` | the standard I/O over time |
//! | `force_channel`, `motion_channel` | the queues behind the nodes `Data` |
//! | `samples` | records and blocks at one moment |
//! | `record` | [`CellRecord`]: what was read, for tests |
//! | `immediate` | what Execute runs |
//! | `simulation` | [`Cell`]: its parts, and how time passes |
//! | `execution` | of [`Cell`]: executing statements |
//! | `acceptance` | of [`Cell`]: commands, accepted or refused |
//! | `alarms` | of [`Cell`]: parts at the end of their life |
//! | `spel_evaluation` | of [`Cell`]: values and points of the SPEL+ subset |
//! | `immediate_execution` | of [`Cell`]: Execute |
//! | `backup` | of [`Cell`]: what outlives a power-off |
//! | `acquisition` | of [`Cell`]: RecordStart, RecordEnd, reads and writes of clients |
//! | `observation` | of [`Cell`]: the snapshot |
//! | `handle` | [`CellHandle`] |
//!
//! # Decisions
//! - State changes at events (a motion ends, a task goes on, a command comes); between two events every value is a formula
//!   of the time since. A cell that nobody looks at costs nothing, and the values do not depend on who looks when.
//! - The queues hold numbers of records, not records: these are calculated when they are read, from the robot's past, which
//!   is kept as long as a reader may ask for it and at most 2048 segments long.
//! - The motion log takes a sample every 0.5 ms at SamplingInterval 0 and keeps 500 blocks of eight; the force sensor keeps
//!   2000 records. The manual states no such numbers. What is overwritten before a client's first read is not reported.
//! - The program starts by itself two seconds after power-on, so that there is something to see. It is not the running task
//!   of the fault switches, which makes the controller refuse changes.

mod acceptance;
mod acquisition;
mod alarms;
mod backup;
mod backup_memory;
mod command;
mod command_text;
mod config;
mod dynamics;
mod execution;
mod force;
mod force_channel;
mod handle;
mod immediate;
mod immediate_execution;
mod io;
mod io_history;
mod kinematics;
mod motion;
mod motion_channel;
mod noise;
mod observation;
mod profile;
mod program;
mod record;
mod robot;
mod robot_model;
mod robot_unit;
mod samples;
mod settings;
mod simulation;
mod snapshot;
mod spel;
mod spel_declaration;
mod spel_declarations;
mod spel_evaluation;
mod status;
mod task;
#[cfg(test)]
mod tests;
mod time;
mod variables;
mod wear;

pub use backup_memory::{BackupMemory, KeptVariable};
pub use command::{CellCommand, CommandRefusal, ForceRecording, RobotChoice, Setting, SettingRefusal};
pub use command_text::{COMMANDS, UnknownCommand};
pub use config::{CellConfig, CellOptions, MAX_ROBOTS};
pub use handle::{CellHandle, Execution};
pub use io::{IoDirection, IoGroup, IoPort, IoValues, find_bit, io_ports};
pub use record::{CellRecord, RecordedPacket};
pub use robot_model::{AxisModel, MotionProfile, RobotKind, RobotModel, UnknownRobotModel};
pub use simulation::Cell;
pub use snapshot::{
    AxisValues, CellDescription, CellSnapshot, ChannelValues, ConsumableValues, ControllerDescription,
    ControllerValues, ForceSensorValues, MotionLogValues, Pose, RobotDescription, RobotValues, SafetyValues,
    TaskDescription, TaskValues,
};
pub use spel::error::{SpelError, error_message};
pub use spel_declaration::{MAX_DIMENSIONS, MAX_SPEL_VARIABLES, SPEL_PREFIX, SpelDeclaration};
pub use spel_declarations::{MAX_DECLARATION_BYTES, MAX_FINDINGS, SpelDeclarations, SpelFinding, SpelMistake};
pub use status::{
    DataStatus, ExecutionMode, OperatingMode, Part, QueueStatus, RecordingStatus, StatusFlag, StatusFlags, TaskKind,
    TaskState,
};
pub use time::{CellClock, CellTime, ClockRate, ClockRateError};
pub use variables::VariableError;

pub use crate::model::{SpelType, SpelValue};
