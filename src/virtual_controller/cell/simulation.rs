use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use chrono::{DateTime, TimeDelta, Utc};

use super::command::CellCommand;
use super::config::{CellConfig, MAX_ROBOTS};
use super::force_channel::ForceChannel;
use super::immediate::Immediate;
use super::io::{IoDirection, IoGroup, IoValues, io_ports};
use super::io_history::IoHistory;
use super::motion_channel::MotionChannel;
use super::noise;
use super::program::Program;
use super::record::CellRecord;
use super::robot_model::RobotModel;
use super::robot_unit::RobotUnit;
use super::settings::AcquisitionSettings;
use super::snapshot::{CellDescription, ControllerDescription, RobotDescription, TaskDescription};
use super::spel_declaration::SpelDeclaration;
use super::status::{OperatingMode, Part, StatusFlag, StatusFlags, TaskKind};
use super::task::Task;
use super::time::CellTime;
use super::variables::{VariableError, Variables};
use super::wear::Wear;
use crate::model::{FirmwareGeneration, SpelType, SpelValue};

/// One simulated cell: the robots of a controller and what is around them.
///
/// Values are functions of the configuration, of simulated time, and of what was asked of the cell at which simulated time.
/// They change every millisecond of simulated time. Looking at them changes nothing, however often it is done.
#[derive(Debug)]
pub struct Cell {
    pub(super) description: Arc<CellDescription>,
    pub(super) started: DateTime<Utc>,
    pub(super) seed: u64,
    pub(super) now: CellTime,
    pub(super) program: Program,
    pub(super) robots: Vec<RobotUnit>,
    /// In the order of the description: main, one a robot, background.
    pub(super) tasks: Vec<Task>,
    pub(super) io: IoValues,
    pub(super) io_history: IoHistory,
    pub(super) variables: Variables,
    pub(super) settings: AcquisitionSettings,
    pub(super) monitors: [ForceChannel; 2],
    /// Current firmware only.
    pub(super) motion: Option<MotionChannel>,
    /// OPCUACommonID of the last recording.
    pub(super) recording_id: u16,
    pub(super) safety: Safety,
    /// What outputs and variables show: flags, status code, motors.
    pub(super) shown: Option<(StatusFlags, u16, bool)>,
    pub(super) step_mode: bool,
    /// Parts made since power-on, and how many of them are bad.
    pub(super) made: u32,
    pub(super) bad: u32,
    /// When main starts by itself.
    pub(super) autostart: Option<CellTime>,
    /// On time before this power-on.
    pub(super) power_on_before: Duration,
    pub(super) battery: Wear,
    /// When the parts behind an alarm were replaced, by the number of the alarm.
    pub(super) replaced: BTreeMap<u8, DateTime<Utc>>,
    /// The index of the robot that remote commands without a robot number are about.
    pub(super) current_robot: usize,
    /// What Execute runs, or ran last.
    pub(super) immediate: Option<Immediate>,
    /// The number of the error of the last Execute that ended with one, or 0.
    pub(super) last_error: u16,
    pub(super) record: Option<CellRecord>,
}

/// Modes, safety and errors.
#[derive(Debug, Clone, Copy)]
pub(super) struct Safety {
    pub mode: OperatingMode,
    /// The emergency stop switch is pressed.
    pub switch_pressed: bool,
    /// Emergency stop, until Reset.
    pub emergency_stop: bool,
    pub door_open: bool,
    /// Number of the error that is shown, or 0.
    pub error: u16,
    /// Number of the warning that is shown, or 0.
    pub warning: u16,
}

impl Cell {
    /// A cell at the moment its controller is switched on: motors off, the background task running. The program starts by
    /// itself two seconds later.
    pub fn new(config: CellConfig) -> Self {
        let CellConfig { name, serial, series, firmware, started, variables, backup, options } = config;
        let mut models = options.robots;
        if models.is_empty() {
            models.push(RobotModel::C4A601S);
        }
        models.truncate(MAX_ROBOTS);
        let seed = options.seed;
        let program = Program::new(&models, noise::branch(seed, 1));
        let numbered = (1..).zip(&models).map(|(number, model)| RobotDescription {
            number,
            model: *model,
            name: format!("Robot{number}"),
            serial: format!("{}{number:02}", serial.as_str()),
            manufacturer: MANUFACTURER,
        });
        let io = io_ports(firmware.generation());
        let main = TaskDescription { number: 1, kind: TaskKind::Normal };
        let background = TaskDescription { number: 65, kind: TaskKind::Background };
        let cycles = (2..).take(models.len()).map(|number| TaskDescription { number, ..main });
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
            tasks: [main].into_iter().chain(cycles).chain([background]).collect(),
            io,
            project: PROJECT.to_owned(),
            variables: [].into(),
            virtual_io: options.virtual_io,
        };
        let has_motion_log = firmware.generation() == FirmwareGeneration::Current;
        let robots = models.iter().enumerate().map(|(robot, model)| {
            RobotUnit::new(*model, program.homes[robot], noise::branch(seed, 100 + robot as u64), started)
        });
        let mut cell = Self {
            robots: robots.collect(),
            tasks: description.tasks.iter().map(|_| Task::default()).collect(),
            description: Arc::new(description),
            started,
            seed,
            now: CellTime::ZERO,
            program,
            io: IoValues::off(io),
            io_history: IoHistory::new(),
            variables: Variables::new(),
            settings: AcquisitionSettings::default(),
            monitors: Default::default(),
            motion: has_motion_log.then(|| MotionChannel::new(CellTime::ZERO, 0)),
            recording_id: 0,
            safety: Safety {
                mode: OperatingMode::Auto,
                switch_pressed: false,
                emergency_stop: false,
                door_open: false,
                error: 0,
                warning: 0,
            },
            shown: None,
            step_mode: false,
            made: 0,
            bad: 0,
            autostart: Some(START_DELAY),
            power_on_before: Duration::from_secs(3600 * (500 + noise::bits(seed, 2) % 20_000)),
            battery: Wear::new(Part::Battery, noise::branch(seed, 2), started),
            replaced: BTreeMap::new(),
            current_robot: 0,
            immediate: None,
            last_error: 0,
            record: None,
        };
        cell.declare_variables(variables);
        cell.restore(backup);
        if let Some(task) = cell.tasks.last_mut() {
            task.start(cell.program.background.clone(), CellTime::ZERO);
        }
        cell.run_due();
        cell
    }

    /// What the cell consists of.
    pub fn description(&self) -> &Arc<CellDescription> {
        &self.description
    }

    /// Simulated time, in whole milliseconds.
    pub const fn now(&self) -> CellTime {
        self.now
    }

    /// Replaces the declared SPEL variables, as at a start of the OPC UA server (manual 4.2.2). A variable with the same
    /// name, type and dimensions keeps its values, as a backup variable does.
    pub fn declare_variables(&mut self, declarations: Vec<SpelDeclaration>) {
        self.variables.declare(declarations);
        self.shown = None;
        let variables = self.variables.declarations();
        self.description = Arc::new(CellDescription { variables, ..CellDescription::clone(&self.description) });
        self.show_status();
    }

    /// Values of a backup variable, see [`super::CellHandle::variable`].
    pub fn variable(
        &self,
        name: &str,
        kind: Option<SpelType>,
        element: &[u16],
        count: usize,
    ) -> Result<&[SpelValue], VariableError> {
        self.variables.read(name, kind, element, count)
    }

    /// The type that a backup variable was declared with.
    pub fn variable_kind(&self, name: &str) -> Result<SpelType, VariableError> {
        self.variables.kind(name)
    }

    /// The number of the robot that remote commands without a robot number are about, from 1 on.
    pub const fn current_robot(&self) -> u8 {
        // At most four robots.
        self.current_robot as u8 + 1
    }

    /// Moves simulated time forward, to the last whole millisecond of `time`. A time in the past changes nothing.
    ///
    /// The time this takes grows with the number of statements that the program executes in between: a day takes some tens of
    /// milliseconds.
    pub fn advance_to(&mut self, time: CellTime) {
        let time = CellTime::from_millis(time.nanos() / 1_000_000);
        while let Some(next) = self.next_event().filter(|next| *next <= time) {
            self.now = self.now.max(next);
            self.run_due();
        }
        self.now = self.now.max(time);
    }

    /// When something happens next by itself.
    pub(super) fn next_event(&self) -> Option<CellTime> {
        let robots = self.robots.iter().filter_map(|unit| unit.robot.moving_until());
        let tasks = self.tasks.iter().filter_map(Task::wakes_at);
        robots.chain(tasks).chain(self.autostart).min()
    }

    /// Everything that happens now: motions that end, then tasks that go on.
    pub(super) fn run_due(&mut self) {
        let now = self.now;
        let mut arrived = false;
        for robot in 0..self.robots.len() {
            if self.robots[robot].robot.moving_until().is_some_and(|end| end <= now) {
                self.robots[robot].arrive(now);
                arrived = true;
            }
        }
        if self.autostart.is_some_and(|start| start <= now) {
            self.autostart = None;
            // An emergency stop or an open door since power-on keeps the program from starting.
            let _refused = self.command(CellCommand::Start { function: 0 });
        }
        for task in 0..self.tasks.len() {
            if self.tasks[task].wakes_at().is_some_and(|wake| wake <= now) {
                self.run_task(task);
            }
        }
        self.run_immediate();
        if arrived {
            self.forget();
        }
        self.show_status();
    }

    /// Drops the past that nothing can ask for any more.
    fn forget(&mut self) {
        let now = self.now;
        let monitors = self.monitors.iter().filter_map(|monitor| monitor.needed_from(now));
        let motion = self.motion.as_ref().and_then(|motion| motion.needed_from(now));
        let needed = monitors.chain(motion).min().unwrap_or(now).min(now);
        let robots = self.robots.iter_mut().map(|unit| unit.robot.forget_before(needed));
        let left = robots.max().unwrap_or(needed).max(self.io_history.forget_before(needed));
        if left > needed {
            // Too much was kept for a slow reader: it loses the oldest.
            self.monitors.iter_mut().for_each(|monitor| monitor.skip_before(left));
            if let Some(motion) = &mut self.motion {
                motion.skip_before(left);
            }
        }
    }

    /// The state flags (manual 3.2.3.10).
    pub(super) fn flags(&self) -> StatusFlags {
        let Safety { mode, emergency_stop, door_open, error, warning, .. } = self.safety;
        let is_paused = self.normal_tasks().any(Task::is_paused);
        let is_loaded = self.normal_tasks().any(Task::is_loaded);
        let mut flags = StatusFlags::default();
        for (flag, on) in [
            (StatusFlag::Test, mode == OperatingMode::Test),
            (StatusFlag::Teach, mode == OperatingMode::Teach),
            (StatusFlag::Auto, mode == OperatingMode::Auto),
            (StatusFlag::Warning, warning != 0),
            (StatusFlag::Safeguard, door_open),
            (StatusFlag::EStop, emergency_stop),
            (StatusFlag::Error, error != 0),
            (StatusFlag::Paused, is_paused),
            (StatusFlag::Running, is_loaded && !is_paused),
            (StatusFlag::Ready, !is_loaded),
        ] {
            flags.set(flag, on);
        }
        flags
    }

    /// The number that the controller shows: of the error, else of the warning, else 0.
    pub(super) const fn status_code(&self) -> u16 {
        if self.safety.error != 0 { self.safety.error } else { self.safety.warning }
    }

    /// The tasks that Stop ends.
    pub(super) fn normal_tasks(&self) -> impl Iterator<Item = &Task> {
        let last = self.tasks.len().saturating_sub(1);
        self.tasks[..last].iter()
    }

    /// Shows the state on the remote outputs 0–8 and in the project's variables, and notes the standard I/O for the motion
    /// log.
    pub(super) fn show_status(&mut self) {
        let motors_on = self.robots.iter().any(|unit| unit.robot.state().motors_on);
        let status = (self.flags(), self.status_code(), motors_on);
        let inputs = self.port(IoGroup::Standard, IoDirection::Input);
        let outputs = self.port(IoGroup::Standard, IoDirection::Output);
        let (Some(inputs), Some(outputs)) = (inputs, outputs) else { return };
        if self.shown != Some(status) {
            self.shown = Some(status);
            let (flags, code, motors_on) = status;
            let remote = [
                StatusFlag::Ready,
                StatusFlag::Running,
                StatusFlag::Paused,
                StatusFlag::Error,
                StatusFlag::EStop,
                StatusFlag::Safeguard,
                StatusFlag::SError,
                StatusFlag::Warning,
            ];
            for (bit, on) in (0..).zip(remote.map(|flag| flags.contains(flag)).into_iter().chain([motors_on])) {
                self.io.set_bit(outputs, bit, on);
            }
            self.variables.set_number("OPCUA_ErrorCode", code.into());
            self.variables.set_number("OPCUA_OperatingStatus", flags.bits().into());
        }
        let word = |port: usize| {
            let mut bytes = [0; 4];
            bytes.iter_mut().zip(self.io.bytes(port)).for_each(|(to, from)| *to = *from);
            u32::from_le_bytes(bytes)
        };
        self.io_history.note(self.now, word(inputs), word(outputs));
    }

    /// The index of a port.
    pub(super) fn port(&self, group: IoGroup, direction: IoDirection) -> Option<usize> {
        self.description.io.iter().position(|port| port.group == group && port.direction == direction)
    }

    /// The controller's clock at a moment.
    pub(super) fn clock(&self, time: CellTime) -> DateTime<Utc> {
        let since = TimeDelta::from_std(time.since_start()).unwrap_or(TimeDelta::MAX);
        self.started.checked_add_signed(since).unwrap_or(DateTime::<Utc>::MAX_UTC)
    }
}

const MANUFACTURER: &str = "Seiko Epson Corporation";
const SOFTWARE: &str = "Controller firmware";
const PROJECT: &str = "VirtualCell";

/// From power-on to the start of main.
const START_DELAY: CellTime = CellTime::from_secs(2);
