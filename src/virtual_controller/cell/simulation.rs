use std::sync::Arc;

use chrono::{DateTime, TimeDelta, Utc};

use super::command::{Setting, SettingRefusal};
use super::config::{CellConfig, MAX_ROBOTS};
use super::io::{IoDirection, IoValues, io_ports};
use super::robot_model::RobotModel;
use super::settings::AcquisitionSettings;
use super::snapshot::{
    AxisValues, CellDescription, CellSnapshot, ChannelValues, ConsumableValues, ControllerDescription,
    ControllerValues, ForceSensorValues, MotionLogValues, Pose, RobotDescription, RobotValues, SafetyValues,
    TaskDescription, TaskValues,
};
use super::spel_value::{MAX_SPEL_VARIABLES, SpelDeclaration, SpelValue};
use super::status::{ExecutionMode, OperatingMode, StatusFlag, StatusFlags, TaskKind, TaskState};
use super::time::CellTime;

/// One simulated cell: the robots of a controller and what is around them.
///
/// Values are functions of the configuration, of simulated time, and of what was asked of the cell at which simulated time.
/// Reading them does not change them, however often it is done.
#[derive(Debug)]
pub struct Cell {
    description: Arc<CellDescription>,
    started: DateTime<Utc>,
    now: CellTime,
    io: IoValues,
    variables: Arc<[SpelValue]>,
    settings: AcquisitionSettings,
}

impl Cell {
    /// A cell at the moment its controller is switched on: motors off, no task started.
    pub fn new(config: CellConfig) -> Self {
        let CellConfig { name, serial, series, firmware, started, variables, options } = config;
        let mut robots = options.robots;
        if robots.is_empty() {
            robots.push(RobotModel::C4A601S);
        }
        robots.truncate(MAX_ROBOTS);
        let numbered = (1..).zip(robots).map(|(number, model)| RobotDescription {
            number,
            model,
            name: format!("Robot{number}"),
            serial: format!("{}{number:02}", serial.as_str()),
            manufacturer: MANUFACTURER,
        });
        let io = io_ports(firmware.generation());
        let description = CellDescription {
            robots: numbered.collect(),
            controller: ControllerDescription {
                name: name.to_string(),
                serial,
                manufacturer: MANUFACTURER,
                model: series.as_str(),
                software_model: SOFTWARE,
                firmware,
            },
            tasks: TASKS.to_vec(),
            io,
            project: PROJECT.to_owned(),
            variables: [].into(),
            virtual_io: options.virtual_io,
        };
        let mut cell = Self {
            description: Arc::new(description),
            started,
            now: CellTime::ZERO,
            io: IoValues::off(io),
            variables: [].into(),
            settings: AcquisitionSettings::default(),
        };
        cell.declare_variables(variables);
        cell
    }

    /// What the cell consists of.
    pub fn description(&self) -> &Arc<CellDescription> {
        &self.description
    }

    /// Replaces the declared SPEL variables, as at a start of the OPC UA server (manual 4.2.2). A variable with the same
    /// name and type keeps its value, as a backup variable does. Those beyond 256 are not taken.
    pub fn declare_variables(&mut self, mut declarations: Vec<SpelDeclaration>) {
        declarations.truncate(MAX_SPEL_VARIABLES);
        let kept = |wanted: &SpelDeclaration| {
            let known = self.description.variables.iter().position(|known| known == wanted);
            known.and_then(|at| self.variables.get(at).cloned()).unwrap_or_else(|| wanted.kind.zero())
        };
        self.variables = declarations.iter().map(kept).collect();
        self.description =
            Arc::new(CellDescription { variables: declarations.into(), ..CellDescription::clone(&self.description) });
    }

    /// Moves simulated time forward. A time in the past changes nothing.
    pub fn advance_to(&mut self, time: CellTime) {
        self.now = self.now.max(time);
    }

    /// Simulated time.
    pub const fn now(&self) -> CellTime {
        self.now
    }

    /// The value of every node now.
    pub fn snapshot(&self) -> CellSnapshot {
        let mut flags = StatusFlags::default();
        flags.set(StatusFlag::Auto, true);
        flags.set(StatusFlag::Ready, true);
        let axis = AxisValues {
            position: 0.0,
            speed: 0.0,
            acceleration: 0.0,
            torque: 0.0,
            overload_rate: 0.0,
            home_offset: 0,
            parts: [ConsumableValues::NONE; 6],
        };
        let robot = |robot: &RobotDescription| RobotValues {
            motors_on: false,
            power_high: false,
            at_home: false,
            speed_override: 100.0,
            target: Pose::default(),
            actual: Pose::default(),
            motors_on_time: std::time::Duration::ZERO,
            motors_on_count: 0,
            battery: ConsumableValues::NONE,
            axes: vec![axis; robot.model.axes().len()],
        };
        let task =
            TaskValues { function: "", program: "", execution: ExecutionMode::Cycle, state: TaskState::Finished };
        let settings = &self.settings;
        CellSnapshot {
            time: self.now,
            clock: self.clock(),
            controller: ControllerValues {
                total_power_on: self.now.since_start(),
                started: self.started,
                temperature: 25.0,
                cpu_load: 3.0,
                flags,
                status_code: 0,
                battery: ConsumableValues::NONE,
            },
            robots: self.description.robots.iter().map(robot).collect(),
            tasks: vec![task; self.description.tasks.len()],
            safety: SafetyValues { mode: OperatingMode::Auto, emergency_stop: false, protective_stop: false },
            io: self.io.clone(),
            variables: Arc::clone(&self.variables),
            force_sensor: ForceSensorValues {
                port: settings.force_port,
                option: Arc::clone(&settings.force_option),
                data_type: settings.force_data_type,
                data_num: settings.force_data_num,
                monitors: [ChannelValues::default(); 2],
            },
            motion_log: MotionLogValues {
                data_type: settings.motion_data_type,
                data_num: settings.motion_data_num,
                sampling_interval: settings.motion_interval,
                channel: ChannelValues::default(),
            },
        }
    }

    /// Takes a client's write, whole or not at all.
    pub fn write(&mut self, setting: Setting) -> Result<(), SettingRefusal> {
        match setting {
            Setting::InputBit { port, offset, on } => {
                self.check_input(port, offset / 8)?;
                self.io.set_bit(port, offset, on);
            }
            Setting::InputByte { port, offset, value } => {
                self.check_input(port, offset)?;
                self.io.set_byte(port, offset, value);
            }
            setting => self.settings.set(setting)?,
        }
        Ok(())
    }

    /// See [`super::CellHandle::read_force_data`].
    pub fn read_force_data(&mut self, _monitor: u8, _max_bytes: usize) -> Option<Vec<u8>> {
        None
    }

    /// See [`super::CellHandle::read_motion_log`].
    pub fn read_motion_log(&mut self, _max_bytes: usize) -> Option<Vec<u8>> {
        None
    }

    fn check_input(&self, port: usize, byte: u16) -> Result<(), SettingRefusal> {
        let port = self.description.io.get(port).ok_or(SettingRefusal::NotWritable)?;
        if self.description.virtual_io && port.direction == IoDirection::Input && byte < port.bytes() {
            Ok(())
        } else {
            Err(SettingRefusal::NotWritable)
        }
    }

    fn clock(&self) -> DateTime<Utc> {
        let since = TimeDelta::from_std(self.now.since_start()).unwrap_or(TimeDelta::MAX);
        self.started.checked_add_signed(since).unwrap_or(DateTime::<Utc>::MAX_UTC)
    }
}

const MANUFACTURER: &str = "Seiko Epson Corporation";
const SOFTWARE: &str = "Controller firmware";
const PROJECT: &str = "VirtualCell";

/// Task 1 runs the main function, tasks 2 and 3 are started by it, task 65 is a background task.
const TASKS: [TaskDescription; 4] = [
    TaskDescription { number: 1, kind: TaskKind::Normal },
    TaskDescription { number: 2, kind: TaskKind::Normal },
    TaskDescription { number: 3, kind: TaskKind::Normal },
    TaskDescription { number: 65, kind: TaskKind::Background },
];
