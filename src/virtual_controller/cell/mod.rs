//! The simulated cell behind a virtual controller: robots, a program, I/O, safety, wear, and the data that the force sensor
//! and the motion log produce (manual 3.2 and chapter 4).
//!
//! Plain, synchronous calculation: no I/O, no threads, no OPC UA. A [`Cell`] is a function of its [`CellConfig`], of
//! simulated time ([`CellTime`]) and of what was asked of it at which simulated time; a [`CellHandle`] shares it and drives
//! it by a [`CellClock`], which may run faster than real time.
//!
//! | file | idea |
//! |---|---|
//! | `time` | [`CellTime`], [`CellClock`], [`ClockRate`] |
//! | `robot_model` | [`RobotModel`]: the figures of the robots |
//! | `io` | [`IoPort`], [`IoValues`]: ports, bit numbers, bits |
//! | `status` | states, modes and status texts of nodes |
//! | `spel_value` | [`SpelType`], [`SpelValue`]: data types of variables |
//! | `snapshot` | [`CellDescription`] and [`CellSnapshot`]: everything that the address space shows |
//! | `config` | [`CellConfig`]: what a cell is built from |
//! | `command` | [`CellCommand`], [`Setting`] and why they are refused |
//! | `settings` | the configuration nodes of both data acquisitions |
//! | `simulation` | [`Cell`] |
//! | `handle` | [`CellHandle`] |

mod command;
mod config;
mod handle;
mod io;
mod robot_model;
mod settings;
mod simulation;
mod snapshot;
mod spel_value;
mod status;
mod time;

pub use command::{CellCommand, CommandRefusal, ForceRecording, RobotChoice, Setting, SettingRefusal};
pub use config::{CellConfig, CellOptions, MAX_ROBOTS};
pub use handle::CellHandle;
pub use io::{IoDirection, IoGroup, IoPort, IoValues, io_ports};
pub use robot_model::{AxisModel, MotionProfile, RobotKind, RobotModel, UnknownRobotModel};
pub use simulation::Cell;
pub use snapshot::{
    AxisValues, CellDescription, CellSnapshot, ChannelValues, ConsumableValues, ControllerDescription,
    ControllerValues, ForceSensorValues, MotionLogValues, Pose, RobotDescription, RobotValues, SafetyValues,
    TaskDescription, TaskValues,
};
pub use spel_value::{MAX_SPEL_VARIABLES, SPEL_PREFIX, SpelDeclaration, SpelType, SpelValue};
pub use status::{
    DataStatus, ExecutionMode, OperatingMode, Part, QueueStatus, RecordingStatus, StatusFlag, StatusFlags, TaskKind,
    TaskState,
};
pub use time::{CellClock, CellTime, ClockRate, ClockRateError};
