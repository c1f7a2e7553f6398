//! Execute: the statements of a text, one after the other, each at its simulated time.

use super::command::{CommandRefusal, RobotChoice};
use super::immediate::Immediate;
use super::kinematics::{Joints, forward, inverse};
use super::robot_model::{MotionProfile, RobotKind};
use super::simulation::Cell;
use super::snapshot::Pose;
use super::spel::error::SpelError;
use super::spel::parser::parse;
use super::spel::syntax::{Expression, Place, Point, Statement, Width};
use super::spel_evaluation::without_negative_zero;
use crate::remote::Command;

/// Part of the highest speed that power low allows.
const LOW_POWER_SPEED: f64 = 0.1;

/// How high a SCARA rises for Jump, in mm: the top of its working range.
const JUMP_HEIGHT: f64 = 0.0;

impl Cell {
    /// Remote command Execute: begins to run a text, of which [`Cell::immediate_result`] then gives the result. The number
    /// names this Execute. Accepted as Start is, and not while another one runs.
    pub fn execute_text(&mut self, text: &str) -> Result<u64, CommandRefusal> {
        self.check(Command::Execute)?;
        let number = self.immediate.as_ref().map_or(0, |last| last.number) + 1;
        self.immediate = Some(match parse(text) {
            Ok(statements) => Immediate::new(number, statements, self.current_robot),
            Err(error) => Immediate::failed(number, error),
        });
        self.run_immediate();
        self.note_error();
        self.show_status();
        Ok(number)
    }

    /// What came of an Execute: the text that was printed, empty for none, or why it ended. `None` while it runs, and for
    /// one that another followed.
    pub fn immediate_result(&self, number: u64) -> Option<&Result<String, SpelError>> {
        self.immediate.as_ref().filter(|last| last.number == number)?.result()
    }

    /// Whether the Execute with this number still runs.
    pub(super) fn is_executing_number(&self, number: u64) -> bool {
        self.immediate.as_ref().is_some_and(|last| last.number == number && last.is_running())
    }

    /// Whether what Execute has begun still runs.
    pub fn is_executing(&self) -> bool {
        self.immediate.as_ref().is_some_and(Immediate::is_running)
    }

    /// Ends what Execute runs; the robots are slowed down by the caller.
    pub(super) fn abort_immediate(&mut self) {
        if let Some(immediate) = &mut self.immediate {
            immediate.fail(SpelError::Aborted);
            self.note_error();
        }
    }

    /// Executes what can be executed now.
    pub(super) fn run_immediate(&mut self) {
        while let Some(immediate) = self.immediate.as_mut().filter(|immediate| immediate.is_running()) {
            let robot = immediate.robot;
            if self.robots[robot].robot.moving_until().is_some() {
                return;
            }
            if let Some(goal) = immediate.goals.pop_front() {
                let now = self.now;
                let unit = &mut self.robots[robot];
                let allowed = if unit.robot.state().power_high { 1.0 } else { LOW_POWER_SPEED };
                let speed = (f64::from(unit.speed) / 100.0).min(allowed) * f64::from(unit.speed_factor) / 100.0;
                unit.robot.go(now, &goal, speed);
                continue;
            }
            let Some(statement) = immediate.statements.pop_front() else {
                immediate.finish();
                self.note_error();
                return;
            };
            if let Err(error) = self.execute_statement(&statement)
                && let Some(immediate) = &mut self.immediate
            {
                immediate.fail(error);
                self.note_error();
            }
        }
    }

    /// The value of `Err`: the number of the error of the last Execute, which one without an error keeps.
    fn note_error(&mut self) {
        if let Some(Err(error)) = self.immediate.as_ref().and_then(Immediate::result) {
            self.last_error = error.number();
        }
    }

    fn execute_statement(&mut self, statement: &Statement) -> Result<(), SpelError> {
        match statement {
            Statement::Print(list) => {
                let values = list.iter().map(|value| self.evaluate(value).map(|value| value.to_string()));
                let line = values.collect::<Result<Vec<_>, _>>()?.join(" ");
                self.print(line);
            }
            Statement::Where => self.position_lines().into_iter().for_each(|line| self.print(line)),
            Statement::Bit { place, bit, on } => {
                let (port, offset) = self.io_place(*place, Width::Bit, self.whole(bit)?)?;
                self.io.set_bit(port, offset, *on);
            }
            Statement::Byte { place, port, value } => self.set_byte(*place, port, value)?,
            Statement::Motor { on } => self.switch_motor(*on)?,
            Statement::Power { high } => {
                let (now, robot) = (self.now, self.current_robot);
                self.robots[robot].robot.set(now, |state| state.power_high = *high);
            }
            Statement::Speed(percent) => {
                let (percent, robot) = (self.percent(percent)?, self.current_robot);
                self.robots[robot].speed = percent;
            }
            Statement::SpeedFactor(percent) => {
                let percent = self.percent(percent)?;
                self.robots.iter_mut().for_each(|unit| unit.speed_factor = percent);
            }
            Statement::Robot(number) => {
                let number = self.whole(number)?;
                let robot = usize::try_from(number - 1).ok().filter(|robot| *robot < self.robots.len());
                self.select_robot(robot.ok_or(SpelError::UnknownRobot)?);
            }
            Statement::Go(point) => {
                let goal = self.joints(point)?;
                self.move_to([goal])?;
            }
            Statement::Jump(point) => self.jump(point)?,
            Statement::Home => {
                let home = self.robots[self.current_robot].home;
                self.move_to([home])?;
            }
            Statement::Assign { variable, value } => {
                let element = self.element(&variable.element)?;
                let value = self.evaluate(value)?.for_variable(self.variables.kind(&variable.name)?)?;
                self.variables.write(&variable.name, None, &element, value)?;
            }
        }
        Ok(())
    }

    fn print(&mut self, line: String) {
        if let Some(immediate) = &mut self.immediate {
            immediate.print(line);
        }
    }

    fn set_byte(&mut self, place: Place, port: &Expression, value: &Expression) -> Result<(), SpelError> {
        let (port, offset) = self.io_place(place, Width::Byte, self.whole(port)?)?;
        let value = u8::try_from(self.whole(value)?).map_err(|_| SpelError::OutOfRange)?;
        self.io.set_byte(port, offset, value);
        Ok(())
    }

    fn switch_motor(&mut self, on: bool) -> Result<(), SpelError> {
        // The conditions of Execute are those of switching motors on. At most four robots.
        let robot = RobotChoice::One(self.current_robot as u8 + 1);
        self.switch_motors(robot, on).map_err(|_| SpelError::UnknownRobot)
    }

    fn percent(&self, percent: &Expression) -> Result<u8, SpelError> {
        let percent = u8::try_from(self.whole(percent)?).ok().filter(|percent| (1..=100).contains(percent));
        percent.ok_or(SpelError::OutOfRange)
    }

    /// The robot that the following commands are about.
    pub(super) fn select_robot(&mut self, robot: usize) {
        self.current_robot = robot;
        if let Some(immediate) = self.immediate.as_mut().filter(|immediate| immediate.is_running()) {
            immediate.robot = robot;
        }
    }

    /// Up, over the point, and down to it.
    fn jump(&mut self, point: &Point) -> Result<(), SpelError> {
        let robot = &self.robots[self.current_robot].robot;
        let model = robot.model();
        if model.kind() != RobotKind::Scara {
            return Err(SpelError::UnsupportedMotion);
        }
        let here = robot.command(self.now).position;
        let goal = self.joints(point)?;
        let raised = |joints| {
            let pose = Pose { z: JUMP_HEIGHT, ..forward(model, joints) };
            inverse(model, pose, joints).ok_or(SpelError::OutOfReach)
        };
        let (up, over) = (raised(&here)?, raised(&goal)?);
        self.move_to([up, over, goal])
    }

    fn move_to<const N: usize>(&mut self, goals: [Joints; N]) -> Result<(), SpelError> {
        let robot = &self.robots[self.current_robot].robot;
        if !robot.state().motors_on {
            return Err(SpelError::MotorsOff);
        }
        let within = |goal: &Joints| {
            let axes = robot.model().axes().iter().zip(goal);
            axes.into_iter().all(|(axis, joint)| (axis.min - 1e-6..=axis.max + 1e-6).contains(joint))
        };
        if !goals.iter().all(within) {
            return Err(SpelError::OutOfReach);
        }
        if let Some(immediate) = &mut self.immediate {
            immediate.goals.extend(goals);
        }
        Ok(())
    }

    /// What `Where` prints: the pose, the joints and the pulses of their encoders.
    fn position_lines(&self) -> [String; 3] {
        let robot = &self.robots[self.current_robot].robot;
        let joints = robot.actual(self.now).position;
        let pose = forward(robot.model(), &joints).to_array();
        let axes = || (1..).zip(robot.model().axes()).zip(joints);
        let world = ["X", "Y", "Z", "U", "V", "W"].iter().zip(pose).enumerate().map(|(at, (name, value))| {
            let unit = if at < 3 { "mm" } else { "deg" };
            format!(" {name}: {:9.3} {unit}", without_negative_zero(value))
        });
        let angles = axes().map(|((number, axis), value)| {
            let unit = if axis.profile == MotionProfile::Linear { "mm" } else { "deg" };
            format!(" {number}: {:9.3} {unit}", without_negative_zero(value))
        });
        let pulses = axes().map(|((number, axis), value)| {
            format!(" {number}: {:9.0} pls", without_negative_zero((value * axis.pulses_per_unit).round()))
        });
        [
            format!("WORLD:{}", world.collect::<String>()),
            format!("JOINT:{}", angles.collect::<String>()),
            format!("PULSE:{}", pulses.collect::<String>()),
        ]
    }
}
