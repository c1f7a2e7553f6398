//! Commands to the cell, and when they are accepted: under the conditions of the table of remote commands
//! ([`Command::conditions`]). Continue besides wants the safeguard closed and no emergency stop, motors on no error.

use super::command::{CellCommand, CommandRefusal, RobotChoice};
use super::io::IoDirection;
use super::program::Function;
use super::robot_unit::DEFAULT_SPEED;
use super::simulation::Cell;
use super::status::OperatingMode;
use super::task::Task;
use super::time::CellTime;
use crate::records::force::EndCondition;
use crate::remote::Command;

/// How hard a robot brakes: on Pause and Stop, and in emergencies.
const NORMAL_BRAKE: f64 = 1.0;
const HARD_BRAKE: f64 = 3.0;

const ERROR_NUMBERS: std::ops::RangeInclusive<u16> = 1..=9999;

impl Cell {
    /// Does what is asked now, or nothing if it is refused.
    pub fn command(&mut self, command: CellCommand) -> Result<(), CommandRefusal> {
        self.act(command)?;
        self.show_status();
        Ok(())
    }

    fn act(&mut self, command: CellCommand) -> Result<(), CommandRefusal> {
        match command {
            CellCommand::Start { function } => {
                self.check(Command::Start)?;
                let entry = self.program.entries.get(usize::from(function));
                let entry = entry.cloned().ok_or(CommandRefusal::UnknownFunction)?;
                self.start(entry);
            }
            CellCommand::Home(robot) => {
                self.check(Command::Home)?;
                let robot = self.one(robot)?;
                let function = self.program.home(robot).ok_or(CommandRefusal::UnknownRobot)?;
                self.start(function);
            }
            CellCommand::Stop => {
                self.check(Command::Stop)?;
                self.stop_all(NORMAL_BRAKE, EndCondition::StopRequested, Task::finish);
            }
            CellCommand::Pause => {
                self.check(Command::Pause)?;
                self.pause(NORMAL_BRAKE);
            }
            CellCommand::Continue => {
                self.check(Command::Continue)?;
                self.check_safe()?;
                self.resume();
            }
            CellCommand::Reset => {
                self.check(Command::Reset)?;
                if self.safety.switch_pressed {
                    return Err(CommandRefusal::EmergencyStop);
                }
                self.safety.emergency_stop = false;
                self.safety.error = 0;
                self.safety.warning = 0;
                self.reset_outputs_and_robots();
            }
            CellCommand::MotorsOn(choice) => {
                self.check(Command::SetMotorsOn)?;
                if self.safety.error != 0 {
                    return Err(CommandRefusal::InError);
                }
                self.switch_motors(choice, true)?;
            }
            CellCommand::MotorsOff(choice) => {
                self.check(Command::SetMotorsOff)?;
                self.switch_motors(choice, false)?;
            }
            CellCommand::CurrentRobot(number) => {
                self.check(Command::SetCurRobot)?;
                let robot = self.one(number)?;
                self.select_robot(robot);
            }
            CellCommand::SetVariable { name, kind, element, value } => {
                self.check(Command::SetVariable)?;
                self.variables.write(&name, kind, &element, value)?;
            }
            CellCommand::ResetAlarm(alarm) => {
                self.check(Command::ResetAlm)?;
                self.replace_parts(alarm)?;
            }
            CellCommand::WearOut(alarm) => self.wear_out(alarm)?,
            CellCommand::Abort => {
                self.check(Command::Abort)?;
                if self.is_executing() {
                    self.brake(NORMAL_BRAKE);
                }
            }
            CellCommand::Power { robots, high } => {
                let now = self.now;
                self.each(robots, |_, _| {})?;
                self.each(robots, |cell, robot| cell.robots[robot].robot.set(now, |state| state.power_high = high))?;
            }
            CellCommand::SpeedFactor(percent) => {
                if !(1..=100).contains(&percent) {
                    return Err(CommandRefusal::OutOfRange);
                }
                self.robots.iter_mut().for_each(|unit| unit.speed_factor = percent);
            }
            CellCommand::StepMode(on) => {
                self.step_mode = on;
                if !on {
                    self.wake_halted();
                }
            }
            CellCommand::StepOn => {
                if !self.normal_tasks().any(Task::is_halted) {
                    return Err(CommandRefusal::NotStepping);
                }
                self.wake_halted();
            }
            CellCommand::EmergencyStop(pressed) => {
                self.safety.switch_pressed = pressed;
                if pressed && !self.safety.emergency_stop {
                    self.safety.emergency_stop = true;
                    self.stop_all(HARD_BRAKE, EndCondition::StopRequested, Task::finish);
                    self.switch_motors_off();
                }
            }
            CellCommand::SafetyDoor { open } => {
                let was_open = std::mem::replace(&mut self.safety.door_open, open);
                // In manual operation the enabling switch, not the door, decides.
                if open && !was_open && self.safety.mode == OperatingMode::Auto {
                    self.pause(HARD_BRAKE);
                    self.suspend_motors();
                }
            }
            CellCommand::Mode(mode) => {
                if mode != self.safety.mode {
                    self.safety.mode = mode;
                    self.pause(HARD_BRAKE);
                    self.suspend_motors();
                }
            }
            CellCommand::RaiseError(number) => {
                let number = error_number(number)?;
                self.safety.error = number;
                self.stop_all(HARD_BRAKE, EndCondition::Error, Task::fail);
                self.switch_motors_off();
            }
            CellCommand::RaiseWarning(number) => self.safety.warning = error_number(number)?,
            CellCommand::SetBit { port, offset, on } => {
                self.check_port(port, offset / 8)?;
                self.io.set_bit(port, offset, on);
            }
            CellCommand::SetByte { port, offset, value } => {
                self.check_port(port, offset)?;
                self.io.set_byte(port, offset, value);
            }
            CellCommand::SetWord { port, offset, value } => {
                let first = offset.checked_mul(2).ok_or(CommandRefusal::UnknownPort)?;
                self.check_port(port, first.saturating_add(1))?;
                let [low, high] = value.to_le_bytes();
                self.io.set_byte(port, first, low);
                self.io.set_byte(port, first + 1, high);
            }
            CellCommand::RecordStart(recording) => {
                self.record_start(recording)?;
            }
            CellCommand::RecordEnd(monitor) => {
                let monitor = self.monitor(monitor)?;
                self.record_end(monitor, EndCondition::RecordEnd);
            }
            CellCommand::BreakForceRecording(monitor) => {
                let monitor = self.monitor(monitor)?;
                self.monitors[monitor].break_off();
            }
            CellCommand::MotionLogging(on) => self.set_motion_logging(on)?,
            CellCommand::BreakMotionLogging => {
                let now = self.now;
                self.motion.as_mut().ok_or(CommandRefusal::NotSupported)?.break_off(now);
            }
        }
        Ok(())
    }

    /// Whether a remote command is accepted now.
    pub(super) fn check(&self, command: Command) -> Result<(), CommandRefusal> {
        if self.is_executing() && !command.is_accepted_during_execute() {
            return Err(CommandRefusal::ExecuteRunning);
        }
        command.unmet(self.flags()).next().map_or(Ok(()), |condition| Err(condition.into()))
    }

    fn check_safe(&self) -> Result<(), CommandRefusal> {
        match (self.safety.emergency_stop, self.safety.door_open) {
            (true, _) => Err(CommandRefusal::EmergencyStop),
            (false, true) => Err(CommandRefusal::SafeguardOpen),
            (false, false) => Ok(()),
        }
    }

    fn one(&self, number: u8) -> Result<usize, CommandRefusal> {
        let robot = usize::from(number).checked_sub(1).filter(|robot| *robot < self.robots.len());
        robot.ok_or(CommandRefusal::UnknownRobot)
    }

    fn monitor(&self, number: u8) -> Result<usize, CommandRefusal> {
        let monitor = usize::from(number).checked_sub(1).filter(|monitor| *monitor < self.monitors.len());
        monitor.ok_or(CommandRefusal::NoMonitor)
    }

    fn check_port(&self, port: usize, byte: u16) -> Result<(), CommandRefusal> {
        let port = self.description.io.get(port).filter(|port| byte < port.bytes());
        match port.ok_or(CommandRefusal::UnknownPort)?.direction {
            // The plant drives inputs at any time; outputs and memory are those of the remote commands.
            IoDirection::Input => Ok(()),
            IoDirection::Output => self.check(Command::SetIO),
            IoDirection::Memory => self.check(Command::SetMemIO),
        }
    }

    fn each(&mut self, choice: RobotChoice, mut act: impl FnMut(&mut Self, usize)) -> Result<(), CommandRefusal> {
        match choice {
            RobotChoice::All => (0..self.robots.len()).for_each(|robot| act(self, robot)),
            RobotChoice::One(number) => {
                let robot = self.one(number)?;
                act(self, robot);
            }
        }
        Ok(())
    }

    /// Motors of one robot or all on, with power low, or off.
    pub(super) fn switch_motors(&mut self, choice: RobotChoice, on: bool) -> Result<(), CommandRefusal> {
        let now = self.now;
        self.each(choice, |cell, robot| {
            let unit = &mut cell.robots[robot];
            if on { unit.switch_on(now, false) } else { unit.switch_off(now) }
        })
    }

    /// Outputs off, except for those that show the status, and the speeds and powers of the robots set back (*5 of the remote
    /// commands).
    fn reset_outputs_and_robots(&mut self) {
        let ports = self.description.io;
        for (index, port) in ports.iter().enumerate().filter(|(_, port)| port.direction == IoDirection::Output) {
            (0..port.bytes()).for_each(|byte| self.io.set_byte(index, byte, 0));
        }
        self.shown = None;
        let now = self.now;
        for unit in &mut self.robots {
            unit.speed = DEFAULT_SPEED;
            unit.robot.set(now, |state| state.power_high = false);
        }
    }

    fn start(&mut self, function: Function) {
        self.autostart = None;
        let now = self.now;
        // A robot that still slows down after a stop comes to rest first.
        let earliest = self.robots.iter().filter_map(|unit| unit.robot.moving_until()).fold(now, CellTime::max);
        for unit in &mut self.robots {
            unit.resumes_motors = false;
        }
        if let Some(task) = self.tasks.first_mut() {
            task.start(function, earliest);
        }
        self.run_due();
    }

    /// Ends all normal tasks; the robots slow down to a stop.
    fn stop_all(&mut self, hardness: f64, condition: EndCondition, end: fn(&mut Task)) {
        self.autostart = None;
        self.brake(hardness);
        self.end_recordings(condition);
        let last = self.tasks.len().saturating_sub(1);
        self.tasks[..last].iter_mut().filter(|task| task.is_loaded()).for_each(end);
    }

    fn pause(&mut self, hardness: f64) {
        self.brake(hardness);
        let (now, last) = (self.now, self.tasks.len().saturating_sub(1));
        self.tasks[..last].iter_mut().for_each(|task| task.pause(now));
    }

    fn resume(&mut self) {
        let (now, last) = (self.now, self.tasks.len().saturating_sub(1));
        for unit in &mut self.robots {
            if std::mem::take(&mut unit.resumes_motors) {
                unit.switch_on(now, true);
            }
        }
        let earliest = self.robots.iter().filter_map(|unit| unit.robot.moving_until()).fold(now, CellTime::max);
        self.tasks[..last].iter_mut().for_each(|task| task.resume(now, earliest));
        self.run_due();
    }

    /// Slows everything down to a stop, and ends what Execute runs.
    fn brake(&mut self, hardness: f64) {
        self.abort_immediate();
        let now = self.now;
        for unit in &mut self.robots {
            unit.robot.brake(now, hardness);
        }
    }

    fn switch_motors_off(&mut self) {
        let now = self.now;
        for unit in &mut self.robots {
            unit.resumes_motors = false;
            unit.switch_off(now);
        }
    }

    /// Motors off until Continue.
    fn suspend_motors(&mut self) {
        let now = self.now;
        for unit in &mut self.robots {
            unit.resumes_motors |= unit.robot.state().motors_on && !unit.motors_off_at_rest;
            unit.switch_off(now);
        }
    }

    fn wake_halted(&mut self) {
        let (now, last) = (self.now, self.tasks.len().saturating_sub(1));
        self.tasks[..last].iter_mut().filter(|task| task.is_halted()).for_each(|task| task.wait(now));
        self.run_due();
    }
}

fn error_number(number: u16) -> Result<u16, CommandRefusal> {
    if ERROR_NUMBERS.contains(&number) { Ok(number) } else { Err(CommandRefusal::OutOfRange) }
}
