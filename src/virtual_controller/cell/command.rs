use thiserror::Error;

use super::status::OperatingMode;
use super::variables::VariableError;
use crate::model::{SpelType, SpelValue};
use crate::remote::Condition;

/// What can be asked of a cell: by the plant around it, by its operator, and by remote commands.
#[derive(Debug, Clone, PartialEq)]
pub enum CellCommand {
    /// Remote command Start: runs function main (0) or main1–main63.
    Start {
        /// 0–63. Functions that the program lacks are refused.
        function: u8,
    },
    /// Remote command Stop: ends all normal tasks.
    Stop,
    /// Remote command Pause: the robots slow down to a stop, the normal tasks wait.
    Pause,
    /// Remote command Continue: paused tasks go on.
    Continue,
    /// Remote command Reset: clears emergency stop and error.
    Reset,
    /// Remote command SetMotorsOn.
    MotorsOn(RobotChoice),
    /// Remote command SetMotorsOff.
    MotorsOff(RobotChoice),
    /// Remote command Home: moves the robot to its home position.
    Home(u8),
    /// Remote command SetCurRobot: the robot that Execute moves.
    CurrentRobot(u8),
    /// Remote command SetVariable.
    SetVariable {
        /// The name; compared without case.
        name: String,
        /// The type the variable must have been declared with; `None` accepts any.
        kind: Option<SpelType>,
        /// The element of an array; empty for a scalar.
        element: Vec<u16>,
        /// A value of the declared type.
        value: SpelValue,
    },
    /// Remote command ResetAlm: the parts behind an alarm were replaced.
    ResetAlarm(u8),
    /// The parts behind an alarm are worn out, which raises it: 1 is the battery of the controller, 2 n the battery of robot n,
    /// 2 n + 1 its grease.
    WearOut(u8),
    /// Remote command Abort: ends what Execute runs.
    Abort,
    /// Power high or low of a robot. Power low limits the speed.
    Power {
        /// Which robots.
        robots: RobotChoice,
        /// High.
        high: bool,
    },
    /// SpeedFactor, in per cent: 1–100. In force from the next motion on.
    SpeedFactor(u8),
    /// Step mode on or off: a normal task stops after each statement until [`CellCommand::StepOn`].
    StepMode(bool),
    /// Executes one statement of each normal task that stopped in step mode.
    StepOn,
    /// The emergency stop switch is pressed or released.
    EmergencyStop(bool),
    /// The safety door is opened or closed.
    SafetyDoor {
        /// Open.
        open: bool,
    },
    /// The mode switch.
    Mode(OperatingMode),
    /// An error stops all normal tasks and switches the motors off: 1–9999.
    RaiseError(u16),
    /// A warning; tasks go on: 1–9999.
    RaiseWarning(u16),
    /// The plant sets an input or memory bit, or a remote command sets an output or memory bit.
    SetBit {
        /// Index into the I/O ports.
        port: usize,
        /// Bit from the port's first on.
        offset: u16,
        /// On.
        on: bool,
    },
    /// As [`CellCommand::SetBit`], for one byte.
    SetByte {
        /// Index into the I/O ports.
        port: usize,
        /// Byte from the port's first on.
        offset: u16,
        /// The new value.
        value: u8,
    },
    /// As [`CellCommand::SetByte`], for two bytes at once.
    SetWord {
        /// Index into the I/O ports.
        port: usize,
        /// Word from the port's first on.
        offset: u16,
        /// The new value; bit 0 is the first bit of the word.
        value: u16,
    },
    /// RecordStart of the force sensor of a robot.
    RecordStart(ForceRecording),
    /// RecordEnd of the force sensor's recording on a monitor: 1 or 2.
    RecordEnd(u8),
    /// The recording on a monitor, 1 or 2, is broken off: the node ErrorStatus becomes Error.
    BreakForceRecording(u8),
    /// Motion logging is switched on or off.
    MotionLogging(bool),
    /// Motion logging is broken off: the node ErrorStatus becomes Error until it is switched on again.
    BreakMotionLogging,
}

/// One robot or all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RobotChoice {
    /// Every robot of the controller: number 0 of the remote commands.
    All,
    /// The robot with this number, from 1 on.
    One(u8),
}

/// The parameters of RecordStart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceRecording {
    /// The robot that carries the sensor, from 1 on.
    pub robot: u8,
    /// How long, in seconds: 0.002–600.
    pub duration: f32,
    /// Time between two records, in seconds: 0.002–600.
    pub interval: f32,
}

/// Why a command is refused. The first seven are the acceptance conditions of the remote commands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum CommandRefusal {
    /// The mode is not Auto.
    #[error("the operating mode is not AUTO")]
    NotAuto,
    /// A task runs or is paused, or the controller is in error or emergency stop.
    #[error("the controller is not ready: a task runs or is paused")]
    NotReady,
    /// No task runs.
    #[error("no task runs")]
    NotRunning,
    /// No task is paused.
    #[error("no task is paused")]
    NotPaused,
    /// There is an error that was not reset.
    #[error("the controller is in the error state")]
    InError,
    /// Emergency stop.
    #[error("the emergency stop is on")]
    EmergencyStop,
    /// The safety door is open.
    #[error("the safeguard is open")]
    SafeguardOpen,
    /// The motors of the robot are off.
    #[error("the motors are off")]
    MotorsOff,
    /// No task has stopped in step mode.
    #[error("no task waits for the next step")]
    NotStepping,
    /// No robot has this number.
    #[error("there is no such robot")]
    UnknownRobot,
    /// The program has no such function.
    #[error("the program has no such function")]
    UnknownFunction,
    /// No port has this index, or the bit or byte is beyond its end.
    #[error("there is no such I/O port")]
    UnknownPort,
    /// No monitor has this number, or both monitors record already.
    #[error("no force sensor monitor is free, or there is no such monitor")]
    NoMonitor,
    /// A number is out of range.
    #[error("a value is out of range")]
    OutOfRange,
    /// This firmware has no motion log.
    #[error("this firmware does not support the function")]
    NotSupported,
    /// Execute runs a command.
    #[error("a command that Execute has started is still running")]
    ExecuteRunning,
    /// No part of the cell has an alarm with this number.
    #[error("there is no such alarm")]
    UnknownAlarm,
    /// The variable is not written.
    #[error(transparent)]
    Variable(#[from] VariableError),
}

impl From<Condition> for CommandRefusal {
    /// The refusal of a command for which this condition is not met.
    fn from(unmet: Condition) -> Self {
        match unmet {
            Condition::Auto => Self::NotAuto,
            Condition::Ready => Self::NotReady,
            Condition::Running => Self::NotRunning,
            Condition::Paused => Self::NotPaused,
            Condition::NoError => Self::InError,
            Condition::NoEStop => Self::EmergencyStop,
            Condition::NoSafeguard => Self::SafeguardOpen,
        }
    }
}

/// A write to a node that clients may write, with the value in the node's data type (manual 3.2.3.2, 3.2.3.4).
#[derive(Debug, Clone, PartialEq)]
pub enum Setting {
    /// Force sensor: Port.
    ForcePort(bool),
    /// Force sensor: Option. Kept and shown, without effect.
    ForceOption(String),
    /// Force sensor: DataType, 0–3.
    ForceDataType(u16),
    /// Force sensor: DataNum; every value is allowed.
    ForceDataNum(u16),
    /// Motion log: DataType, 0 only.
    MotionDataType(u16),
    /// Motion log: DataNum, 0–200.
    MotionDataNum(u16),
    /// Motion log: SamplingInterval, 0–4.
    MotionSamplingInterval(u16),
    /// An input bit, where the cell was built with virtual I/O.
    InputBit {
        /// Index into the I/O ports.
        port: usize,
        /// Bit from the port's first on.
        offset: u16,
        /// On.
        on: bool,
    },
    /// An input byte, where the cell was built with virtual I/O.
    InputByte {
        /// Index into the I/O ports.
        port: usize,
        /// Byte from the port's first on.
        offset: u16,
        /// The new value.
        value: u8,
    },
}

/// Why a write is refused. Nothing was changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum SettingRefusal {
    /// OPC UA: BadOutOfRange.
    #[error("the value is out of range")]
    OutOfRange,
    /// OPC UA: BadNotWritable.
    #[error("the value cannot be written")]
    NotWritable,
}
