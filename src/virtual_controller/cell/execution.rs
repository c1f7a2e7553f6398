//! The execution of tasks: one statement after the other, each at its simulated time.

use super::command::ForceRecording;
use super::noise;
use super::program::{Signal, Statement};
use super::simulation::Cell;
use crate::records::force::EndCondition;

/// What comes after a statement.
enum Next {
    Statement,
    Jump(usize),
    Wait { millis: u64 },
    Motion { robot: usize },
}

/// Statements that a task executes at one moment; then it waits for the next millisecond.
const MAX_AT_ONCE: usize = 1000;

/// Part of the highest speed with power low.
const LOW_POWER_SPEED: f64 = 0.1;

/// Seconds that a part should take.
const TARGET_SECS: f64 = 3.0;

/// Part of what is made that is bad.
const BAD_PARTS: f64 = 0.025;

impl Cell {
    /// Lets a task go on that has waited or moved.
    pub(super) fn run_task(&mut self, index: usize) {
        let was_moving = self.tasks[index].moving_robot().is_some();
        self.tasks[index].arrive();
        let is_normal = index + 1 < self.tasks.len();
        if was_moving && self.step_mode && is_normal {
            self.tasks[index].halt();
            return;
        }
        for _ in 0..MAX_AT_ONCE {
            if !self.execute_next(index) {
                return;
            }
            if self.step_mode && is_normal {
                self.tasks[index].halt();
                return;
            }
        }
        let later = self.now.plus_nanos(1_000_000);
        self.tasks[index].wait(later);
    }

    /// Executes one statement of a task. `false`: the task waits, moves or has ended.
    fn execute_next(&mut self, index: usize) -> bool {
        let Some(statement) = self.tasks[index].statement() else {
            self.end_recording_of(index, EndCondition::TaskEnded);
            self.tasks[index].finish();
            return false;
        };
        match self.execute(index, statement) {
            Next::Statement => {
                self.tasks[index].next();
                true
            }
            Next::Jump(to) => {
                self.tasks[index].jump(to);
                true
            }
            Next::Wait { millis } => {
                self.tasks[index].next();
                let until = self.now.plus_nanos(millis * 1_000_000);
                self.tasks[index].wait(until);
                false
            }
            Next::Motion { robot } => {
                let until = self.robots[robot].robot.moving_until().unwrap_or(self.now);
                self.tasks[index].follow_motion(robot, until);
                false
            }
        }
    }

    fn execute(&mut self, index: usize, statement: Statement) -> Next {
        let now = self.now;
        match statement {
            Statement::Motor { robot } => self.robots[robot].switch_on(now, true),
            Statement::Go { robot, to, speed } => {
                let unit = &mut self.robots[robot];
                let power = if unit.robot.state().power_high { 1.0 } else { LOW_POWER_SPEED };
                let end = unit.robot.go(now, &to, speed * power * f64::from(unit.speed_factor) / 100.0);
                if end > now {
                    return Next::Motion { robot };
                }
            }
            Statement::Wait { millis } => return Next::Wait { millis },
            Statement::Bit { signal, on } => self.signal(signal, |_| on),
            Statement::Toggle { signal } => self.signal(signal, |on| !on),
            Statement::Count { signal } => {
                if let Some(port) = self.port(signal.group, signal.direction) {
                    let count = self.io.byte(port, signal.offset).wrapping_add(1);
                    self.io.set_byte(port, signal.offset, count);
                }
            }
            Statement::Carry { robot, kilograms } => {
                self.robots[robot].robot.set(now, |state| state.payload = kilograms);
            }
            Statement::Surface { robot, height } => {
                self.robots[robot].robot.set(now, |state| state.surface = height);
            }
            Statement::StepId { robot, id } => self.robots[robot].robot.set(now, |state| state.step_id = id),
            Statement::RecordStart { robot, duration, interval } => {
                // At most four robots.
                let recording = ForceRecording { robot: robot as u8 + 1, duration, interval };
                // While both monitors are in use, the data is not recorded.
                self.tasks[index].monitor = self.record_start(recording).ok();
            }
            Statement::RecordEnd => self.end_recording_of(index, EndCondition::RecordEnd),
            Statement::CycleDone { robot } => self.cycle_done(index, robot),
            Statement::UnlessCycle { every, jump } => {
                if !self.tasks[index].cycles.is_multiple_of(every) {
                    return Next::Jump(jump);
                }
            }
            Statement::Start { task } => {
                if let Some(function) = self.program.cycles.get(task - 1) {
                    self.tasks[task].start(function.clone(), now);
                }
            }
            Statement::Jump { to } => return Next::Jump(to),
        }
        Next::Statement
    }

    fn signal(&mut self, signal: Signal, change: impl FnOnce(bool) -> bool) {
        if let Some(port) = self.port(signal.group, signal.direction) {
            let on = self.io.bit(port, signal.offset);
            self.io.set_bit(port, signal.offset, change(on));
        }
    }

    /// Ends the recording that a task has started.
    pub(super) fn end_recording_of(&mut self, task: usize, condition: EndCondition) {
        if let Some(monitor) = self.tasks[task].monitor.take() {
            self.record_end(monitor, condition);
        }
    }

    /// One part is made: what the project tells OPC UA clients (the variables of the manual's example, 4.2.2).
    fn cycle_done(&mut self, index: usize, robot: usize) {
        let now = self.now;
        let task = &mut self.tasks[index];
        task.cycles = task.cycles.wrapping_add(1);
        let cycle_secs = now.nanos_since(task.cycle_start) as f64 * 1e-9;
        task.cycle_start = now;
        self.made = self.made.wrapping_add(1);
        let made = self.made;
        let is_bad = noise::unit(noise::branch(self.seed, 3), made.into()) < BAD_PARTS;
        self.bad = self.bad.wrapping_add(is_bad.into());
        let unit = &self.robots[robot];
        let load: f64 = unit.robot.settled(now).overload_rates().iter().sum();
        let (clock, hours) = (self.clock(now), unit.running_hours(now));
        let worn = unit.parts.iter().flatten().flatten();
        let worn = worn.map(|wear| wear.values(clock, hours).consumption_rate).fold(0.0, f64::max);
        // In kilowatt-hours.
        let energy = now.secs() / 3600.0 * 0.45 * self.robots.len() as f64;
        // In micrometres.
        let deviation = |axis: u64| noise::signed(noise::branch(self.seed, 5 + axis), made.into()) * 40.0;
        let deviations = [deviation(0), deviation(1)];
        let variables = &mut self.variables;
        for (name, number) in [
            ("OPCUA_ItemCode", f64::from(1000 + made / 100 % 8)),
            ("OPCUA_ElectricPower", energy),
            ("OPCUA_NumOfProduced", f64::from(made)),
            ("OPCUA_NumOfNonDefective", f64::from(made.wrapping_sub(self.bad))),
            // In hundredths of a second.
            ("OPCUA_CycleTime", cycle_secs * 100.0),
            ("OPCUA_ConsumedStatus", worn),
            ("OPCUA_Load", load),
            ("OPCUA_CycleSeconds", cycle_secs),
            ("OPCUA_Shift", f64::from(made / 500 % 3) - 1.0),
            ("OPCUA_DeviationX", deviations[0]),
            ("OPCUA_DeviationY", deviations[1]),
            ("OPCUA_Pallet", f64::from(made / 48 % 1000)),
            ("OPCUA_PalletPlace", f64::from(made % 48)),
            ("OPCUA_TargetDifference", f64::from(made) - now.secs() / TARGET_SECS),
            ("OPCUA_UptimeSeconds", now.secs().floor()),
            ("OPCUA_UptimeMilliseconds", (now.nanos() / 1_000_000) as f64),
            ("OPCUA_PartSerial", 4_000_000_000_000.0 + f64::from(made)),
            ("OPCUA_PartIsGood", f64::from(u8::from(!is_bad))),
        ] {
            variables.set_number(name, number);
        }
        variables.set_text("OPCUA_Recipe", || format!("Insert-{}", made / 100 % 8 + 1));
    }
}
