//! Everything that the address space shows of the cell: [`CellDescription`] says which nodes there are, and
//! [`CellSnapshot`] has their values at one moment.

use std::sync::Arc;
use std::time::Duration;

use chrono::{DateTime, Utc};

use super::io::{IoPort, IoValues};
use super::robot_model::{RobotKind, RobotModel};
use super::spel_declaration::SpelDeclaration;
use super::status::{
    DataStatus, ExecutionMode, OperatingMode, Part, QueueStatus, RecordingStatus, StatusFlags, TaskKind, TaskState,
};
use super::time::CellTime;
use crate::model::{FirmwareGeneration, FirmwareVersion, SerialNumber, SpelValue};

/// What a cell consists of. It stays the same while the OPC UA server runs; the variables are taken at its start.
#[derive(Debug, Clone, PartialEq)]
pub struct CellDescription {
    /// The controller.
    pub controller: ControllerDescription,
    /// The robots, by number from 1 on.
    pub robots: Vec<RobotDescription>,
    /// The tasks, in the order of [`CellSnapshot::tasks`].
    pub tasks: Vec<TaskDescription>,
    /// The I/O ports, in the order of [`CellSnapshot::io`].
    pub io: &'static [IoPort],
    /// The project: node SpelProjectName.
    pub project: String,
    /// The variables, in the order of [`CellSnapshot::variables`]; at most 256.
    pub variables: Arc<[SpelDeclaration]>,
    /// Whether clients may write inputs and see word nodes, as in the vendor's virtual controllers.
    pub virtual_io: bool,
}

/// The controller's fixed facts (manual 3.2.2.1, Controllers and Software).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ControllerDescription {
    /// ComponentName.
    pub name: String,
    /// SerialNumber.
    pub serial: SerialNumber,
    /// Manufacturer of the controller and of its software.
    pub manufacturer: &'static str,
    /// Model and ProductCode.
    pub model: &'static str,
    /// Model of the software.
    pub software_model: &'static str,
    /// SoftwareRevision.
    pub firmware: FirmwareVersion,
}

impl ControllerDescription {
    /// Decides which nodes there are (manual 3.2.3).
    pub fn generation(&self) -> FirmwareGeneration {
        self.firmware.generation()
    }
}

/// A robot's fixed facts (manual 3.2.2.1, MotionDevices).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotDescription {
    /// RobotNumber: from 1 on (manual 3.2.3.5).
    pub number: u8,
    /// Model, which also says the kind and the axes.
    pub model: RobotModel,
    /// ComponentName.
    pub name: String,
    /// SerialNumber.
    pub serial: String,
    /// Manufacturer.
    pub manufacturer: &'static str,
}

impl RobotDescription {
    /// MotionDeviceCategory.
    pub fn kind(&self) -> RobotKind {
        self.model.kind()
    }
}

/// A task's fixed facts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TaskDescription {
    /// The number: 1–32 for normal tasks, 65–80 for background tasks.
    pub number: u8,
    /// Normal or background.
    pub kind: TaskKind,
}

/// The values of a cell at one moment. Vectors are in the order of [`CellDescription`].
#[derive(Debug, Clone, PartialEq)]
pub struct CellSnapshot {
    /// The moment.
    pub time: CellTime,
    /// The moment by the controller's clock.
    pub clock: DateTime<Utc>,
    /// The controller.
    pub controller: ControllerValues,
    /// The robots.
    pub robots: Vec<RobotValues>,
    /// The tasks.
    pub tasks: Vec<TaskValues>,
    /// The safety states.
    pub safety: SafetyValues,
    /// All I/O.
    pub io: IoValues,
    /// The SPEL variables.
    pub variables: Arc<[SpelValue]>,
    /// The force sensor's data acquisition.
    pub force_sensor: ForceSensorValues,
    /// The motion log's data acquisition.
    pub motion_log: MotionLogValues,
}

/// The controller's values (manual 3.2.2.1 and 3.2.3.10). CurrentUser is Null.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ControllerValues {
    /// TotalPowerOnTime.
    pub total_power_on: Duration,
    /// StartUpTime.
    pub started: DateTime<Utc>,
    /// Temperature inside of the controller, in °C.
    pub temperature: f64,
    /// CPULoad, in per cent.
    pub cpu_load: f64,
    /// One node a state.
    pub flags: StatusFlags,
    /// StatusCode: the number of the error, else of the warning, else 0.
    pub status_code: u16,
    /// The controller's battery.
    pub battery: ConsumableValues,
}

/// A robot's values (manual 3.2.2.1, 3.2.3.6–3.2.3.9).
#[derive(Debug, Clone, PartialEq)]
pub struct RobotValues {
    /// InControl: the motors are on.
    pub motors_on: bool,
    /// Power: high.
    pub power_high: bool,
    /// Home: the robot is at its home position.
    pub at_home: bool,
    /// SpeedOverride: the value of SpeedFactor, in per cent.
    pub speed_override: f64,
    /// CurPos: where the motion control wants the robot to be.
    pub target: Pose,
    /// RealPos: where the robot is.
    pub actual: Pose,
    /// IntegrationMotorOnTime: how long the motors have been on.
    pub motors_on_time: Duration,
    /// MotorOnCount: how often the motors have been switched on.
    pub motors_on_count: u32,
    /// The battery of the encoders.
    pub battery: ConsumableValues,
    /// The axes, joint 1 first.
    pub axes: Vec<AxisValues>,
}

/// An axis's values (manual 3.2.2.1, 3.2.3.7, 3.2.3.9). MotorTemperature and the motor's identification are Null.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisValues {
    /// ActualPosition, in degrees or mm.
    pub position: f64,
    /// Speed, in degrees or mm a second.
    pub speed: f64,
    /// Acceleration, in degrees or mm a second squared.
    pub acceleration: f64,
    /// Torque, in per cent of the rated torque.
    pub torque: f64,
    /// The value of OLRate: 1.0 is the limit for continuous work, 2.0 the highest.
    pub overload_rate: f64,
    /// Hofs, in pulses: from the encoder's origin to the mechanical origin.
    pub home_offset: i64,
    /// In the order of [`Part::OF_AXIS`].
    pub parts: [ConsumableValues; 6],
}

impl AxisValues {
    /// EffectiveLoadRate: [`AxisValues::overload_rate`] in per cent, 0–200 (OPC 40010-1 §7.5.3).
    pub fn load_percent(&self) -> u16 {
        // Limited first, so nothing is cut off.
        (self.overload_rate * 100.0).round().clamp(0.0, 200.0) as u16
    }

    /// The part of this axis.
    pub fn part(&self, part: Part) -> ConsumableValues {
        Part::OF_AXIS.iter().position(|known| *known == part).map_or(ConsumableValues::NONE, |at| self.parts[at])
    }
}

/// The wear of one part (manual 3.2.3.7).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConsumableValues {
    /// Available: the part exists and its wear is managed.
    pub available: bool,
    /// InstallationDate; `None` when not available.
    pub installed: Option<DateTime<Utc>>,
    /// MonthRemaining; −1 when not available.
    pub months_remaining: f64,
    /// ConsumptionRate, in per cent, where 100 is the recommended time of replacement; −1 when not available.
    pub consumption_rate: f64,
}

impl ConsumableValues {
    /// A part that the robot does not have or whose wear is not managed.
    pub const NONE: Self = Self { available: false, installed: None, months_remaining: -1.0, consumption_rate: -1.0 };
}

/// Position and orientation of the tool in the robot's base coordinates: millimetres, and degrees about Z (U), Y (V) and X
/// (W). A SCARA has V and W 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pose {
    /// X, in mm.
    pub x: f64,
    /// Y, in mm.
    pub y: f64,
    /// Z, in mm.
    pub z: f64,
    /// Rotation about Z, in degrees.
    pub u: f64,
    /// Rotation about Y, in degrees.
    pub v: f64,
    /// Rotation about X, in degrees.
    pub w: f64,
}

impl Pose {
    /// X, Y, Z, U, V, W.
    pub const fn to_array(self) -> [f64; 6] {
        [self.x, self.y, self.z, self.u, self.v, self.w]
    }
}

/// A task's values (manual 3.2.2.1, TaskControls).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TaskValues {
    /// ComponentName: the function that the task runs; empty if none was started.
    pub function: &'static str,
    /// TaskProgramName: the file of the function; empty if none was started.
    pub program: &'static str,
    /// ExecutionMode.
    pub execution: ExecutionMode,
    /// The state; TaskProgramLoaded follows from it.
    pub state: TaskState,
}

/// The safety states (manual 3.2.2.1, SafetyStates).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SafetyValues {
    /// OperationalMode follows from it.
    pub mode: OperatingMode,
    /// EmergencyStop is on.
    pub emergency_stop: bool,
    /// ProtectiveStop is on: the safety door is open.
    pub protective_stop: bool,
}

/// The nodes of the force sensor's monitor system (manual 3.2.3.2).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ForceSensorValues {
    /// Port: `true` sends the data of the next RecordStart to OPC UA, `false` to the programming software.
    pub port: bool,
    /// Option: not used by the controller.
    pub option: Arc<str>,
    /// DataType: 0–3.
    pub data_type: u16,
    /// DataNum: the most data records in one read; 0 leaves it to the controller.
    pub data_num: u16,
    /// ForceSensorMonitor_1 and ForceSensorMonitor_2.
    pub monitors: [ChannelValues; 2],
}

/// The nodes of the motion log's monitor system (manual 3.2.3.4). Current firmware only.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MotionLogValues {
    /// DataType: 0.
    pub data_type: u16,
    /// DataNum: 0–200 blocks in one read; 0 leaves it to the controller.
    pub data_num: u16,
    /// SamplingInterval: 0–4; the time between samples is 2ⁿ times that at 0.
    pub sampling_interval: u16,
    /// The only channel.
    pub channel: ChannelValues,
}

/// The status nodes of one channel with a node Data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ChannelValues {
    /// MonitorStatus or LoggingStatus.
    pub recording: RecordingStatus,
    /// DataExistsStatus.
    pub data: DataStatus,
    /// ErrorStatus.
    pub error: QueueStatus,
}
