//! Commands to the cell, and when they are accepted: under the conditions of the table of remote commands
//! ([`Command::conditions`]). Continue besides wants the safeguard closed and no emergency stop, motors on no error.

use super::command::{CellCommand, CommandRefusal, RobotChoice};
use super::io::IoDirection;
use super::program::Function;
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
            }
            CellCommand::MotorsOn(choice) => {
                self.check(Command::SetMotorsOn)?;
                if self.safety.error != 0 {
                    return Err(CommandRefusal::InError);
                }
                let now = self.now;
                self.each(choice, |cell, robot| cell.robots[robot].switch_on(now, false))?;
            }
            CellCommand::MotorsOff(choice) => {
                self.check(Command::SetMotorsOff)?;
                let now = self.now;
                self.each(choice, |cell, robot| cell.robots[robot].switch_off(now))?;
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

    fn check(&self, command: Command) -> Result<(), CommandRefusal> {
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

    fn brake(&mut self, hardness: f64) {
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
