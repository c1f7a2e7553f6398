//! Alarms: parts at the recommended time of replacement.
//!
//! The manual of the remote commands names no alarms. Their numbers are those of the remote outputs Alarm1 to Alarm9: 1 is the
//! battery of the controller; robot n, from 1 on, has 2 n for its battery and 2 n + 1 for its grease. An alarm lasts until
//! ResetAlm says that the part was replaced, which the nodes of the part show too.

use chrono::{DateTime, Utc};

use super::command::CommandRefusal;
use super::config::MAX_ROBOTS;
use super::simulation::Cell;
use super::status::Part;
use super::wear::Wear;

/// The highest number of an alarm.
const MAX_ALARM: u8 = 2 * MAX_ROBOTS as u8 + 1;

/// The consumption rate at which a part raises its alarm, in per cent.
const REPLACEMENT: f64 = 100.0;

/// The parts behind an alarm.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Worn {
    ControllerBattery,
    /// By the robot's index.
    RobotBattery(usize),
    /// Of all joints, by the robot's index.
    Grease(usize),
}

impl Cell {
    /// The numbers of the alarms that last, in ascending order.
    pub fn alarms(&self) -> Vec<u8> {
        (1..=MAX_ALARM).filter(|number| self.is_alarm(*number)).collect()
    }

    /// The parts behind an alarm are new from now on.
    pub(super) fn replace_parts(&mut self, alarm: u8) -> Result<(), CommandRefusal> {
        let now = self.clock(self.now);
        self.change_parts(alarm, |wear, hours| wear.renew(now, hours))?;
        self.replaced.insert(alarm, now);
        Ok(())
    }

    /// The parts behind an alarm were replaced at `at`, before this power-on. Without such an alarm nothing happens.
    pub(super) fn replaced_before(&mut self, alarm: u8, at: DateTime<Utc>) {
        if self.change_parts(alarm, |wear, hours| wear.renew(at, hours)).is_ok() {
            self.replaced.insert(alarm, at);
        }
    }

    /// The parts behind an alarm are worn out.
    pub(super) fn wear_out(&mut self, alarm: u8) -> Result<(), CommandRefusal> {
        let now = self.clock(self.now);
        self.change_parts(alarm, |wear, hours| wear.wear_out(now, hours))
    }

    fn is_alarm(&self, number: u8) -> bool {
        let clock = self.clock(self.now);
        let is_worn = |wear: &Wear, hours| wear.values(clock, hours).consumption_rate >= REPLACEMENT;
        match self.parts_of(number) {
            None => false,
            Some(Worn::ControllerBattery) => is_worn(&self.battery, 0.0),
            Some(Worn::RobotBattery(robot)) => is_worn(&self.robots[robot].battery, 0.0),
            Some(Worn::Grease(robot)) => {
                let unit = &self.robots[robot];
                let hours = unit.running_hours(self.now);
                let grease = unit.parts.iter().filter_map(|parts| parts[grease_place()].as_ref());
                grease.into_iter().any(|wear| is_worn(wear, hours))
            }
        }
    }

    fn change_parts(&mut self, alarm: u8, change: impl Fn(&mut Wear, f64)) -> Result<(), CommandRefusal> {
        let now = self.now;
        match self.parts_of(alarm).ok_or(CommandRefusal::UnknownAlarm)? {
            Worn::ControllerBattery => change(&mut self.battery, 0.0),
            Worn::RobotBattery(robot) => change(&mut self.robots[robot].battery, 0.0),
            Worn::Grease(robot) => {
                let unit = &mut self.robots[robot];
                let hours = unit.running_hours(now);
                unit.parts
                    .iter_mut()
                    .filter_map(|parts| parts[grease_place()].as_mut())
                    .for_each(|wear| change(wear, hours));
            }
        }
        Ok(())
    }

    /// `None` for numbers of no alarm, and of robots that the cell does not have.
    fn parts_of(&self, alarm: u8) -> Option<Worn> {
        let robot = usize::from(alarm / 2).checked_sub(1);
        match (alarm, robot) {
            (1, _) => Some(Worn::ControllerBattery),
            (_, Some(robot)) if robot < self.robots.len() => {
                Some(if alarm.is_multiple_of(2) { Worn::RobotBattery(robot) } else { Worn::Grease(robot) })
            }
            _ => None,
        }
    }
}

/// The place of the grease among the parts of an axis.
fn grease_place() -> usize {
    Part::OF_AXIS.iter().position(|part| *part == Part::Grease).unwrap_or_default()
}
