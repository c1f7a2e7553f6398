use chrono::{DateTime, TimeDelta, Utc};

use super::noise;
use super::robot_model::{RobotKind, RobotModel};
use super::snapshot::ConsumableValues;
use super::status::Part;

/// The wear of one part: how worn it was at power-on, and how long one lasts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Wear {
    installed: DateTime<Utc>,
    /// Months a new part lasts.
    life_months: f64,
    /// Part of its life that was over at power-on: 0 to 1.
    used: f64,
    /// A battery ages with the calendar, the other parts with running hours.
    by_calendar: bool,
}

/// Running hours of a month, by which months of life become hours: ten hours on twenty-four days.
const HOURS_A_MONTH: f64 = 240.0;
const DAYS_A_MONTH: f64 = 30.4375;

impl Wear {
    /// A part of a controller that was switched on at `started`. Age and life follow from the seed.
    pub fn new(part: Part, seed: u64, started: DateTime<Utc>) -> Self {
        let life_months = match part {
            Part::Battery => 54.0,
            Part::Belt => 96.0,
            Part::Grease => 30.0,
            Part::Motor => 240.0,
            Part::Gear => 180.0,
            Part::BallScrewSpline => 120.0,
        };
        let used = 0.05 + 0.75 * noise::unit(seed, 0);
        let days = used * life_months * DAYS_A_MONTH;
        let age = TimeDelta::seconds((days * 86_400.0) as i64);
        Self {
            installed: started.checked_sub_signed(age).unwrap_or(started),
            life_months,
            used,
            by_calendar: part == Part::Battery,
        }
    }

    /// The part is replaced by a new one, after so many running hours since power-on.
    pub fn renew(&mut self, now: DateTime<Utc>, running_hours: f64) {
        self.installed = now;
        self.used = -self.part_of_life(running_hours);
    }

    /// The part is worn to the recommended time of replacement, after so many running hours since power-on.
    pub fn wear_out(&mut self, now: DateTime<Utc>, running_hours: f64) {
        let days = self.life_months * DAYS_A_MONTH;
        // A second more, so that rounding does not leave it just before its end.
        let age = TimeDelta::seconds((days * 86_400.0) as i64 + 1);
        self.installed = now.checked_sub_signed(age).unwrap_or(now);
        self.used = 1.0 + 1e-9 - self.part_of_life(running_hours);
    }

    /// Part of its life that running hours take.
    fn part_of_life(&self, running_hours: f64) -> f64 {
        running_hours / (self.life_months * HOURS_A_MONTH)
    }

    /// The values at `now`, after so many running hours since power-on.
    pub fn values(&self, now: DateTime<Utc>, running_hours: f64) -> ConsumableValues {
        let used = if self.by_calendar {
            let days = (now - self.installed).num_seconds() as f64 / 86_400.0;
            days / DAYS_A_MONTH / self.life_months
        } else {
            self.used + self.part_of_life(running_hours)
        };
        ConsumableValues {
            available: true,
            installed: Some(self.installed),
            months_remaining: ((1.0 - used) * self.life_months).max(0.0),
            consumption_rate: used * 100.0,
        }
    }
}

/// Whether an axis of this model has the part: a six-axis robot has belt, grease, motor and gear in every joint, a SCARA too
/// except for joint 3, which has a ball screw spline instead of a gear. The battery is common to all joints.
pub(super) fn has_part(model: RobotModel, axis: usize, part: Part) -> bool {
    let is_ball_screw = model.kind() == RobotKind::Scara && axis == 2;
    match part {
        Part::Battery | Part::Belt | Part::Grease | Part::Motor => true,
        Part::Gear => !is_ball_screw,
        Part::BallScrewSpline => is_ball_screw,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_wear_with_their_hours_and_batteries_with_the_calendar() {
        let started = DateTime::from_timestamp(1_780_000_000, 0).unwrap();
        let later = started + TimeDelta::days(30);
        for seed in 0..50 {
            let belt = Wear::new(Part::Belt, seed, started);
            let [at_rest, worked] = [0.0, 240.0].map(|hours| belt.values(later, hours));
            assert_eq!(at_rest, belt.values(started, 0.0));
            assert!((at_rest.months_remaining - worked.months_remaining - 1.0).abs() < 1e-9);
            assert!((worked.consumption_rate - at_rest.consumption_rate - 100.0 / 96.0).abs() < 1e-9);
            let battery = Wear::new(Part::Battery, seed, started);
            let [before, after] = [started, later].map(|now| battery.values(now, 0.0));
            assert!((before.months_remaining - after.months_remaining - 30.0 / DAYS_A_MONTH).abs() < 1e-4);
            assert!(before.installed.is_some_and(|installed| installed < started));
            let rate = 100.0 - before.months_remaining / 54.0 * 100.0;
            assert!((before.consumption_rate - rate).abs() < 1e-6);
        }
        let worn = Wear::new(Part::Grease, 1, started).values(later, 1e5);
        assert!(worn.consumption_rate > 100.0 && worn.months_remaining == 0.0, "{worn:?}");
    }

    #[test]
    fn a_part_is_worn_out_and_replaced_at_any_age() {
        let started = DateTime::from_timestamp(1_780_000_000, 0).unwrap();
        for part in Part::OF_AXIS {
            for hours in [0.0, 1.0, 5000.0] {
                let now = started + TimeDelta::days(100);
                let mut wear = Wear::new(part, 3, started);
                wear.wear_out(now, hours);
                let worn = wear.values(now, hours);
                assert!((100.0..100.01).contains(&worn.consumption_rate), "{part:?}: {worn:?}");
                wear.renew(now, hours);
                let fresh = wear.values(now, hours);
                assert!(fresh.consumption_rate.abs() < 1e-6 && fresh.installed == Some(now), "{part:?}: {fresh:?}");
            }
        }
    }

    #[test]
    fn a_scaras_shaft_has_a_ball_screw_instead_of_a_gear() {
        let parts =
            |model, axis| Part::OF_AXIS.into_iter().filter(|part| has_part(model, axis, *part)).collect::<Vec<_>>();
        let usual = [Part::Battery, Part::Belt, Part::Grease, Part::Motor, Part::Gear];
        assert_eq!(parts(RobotModel::C4A601S, 2), usual);
        assert_eq!(parts(RobotModel::Gx4A251S, 1), usual);
        let shaft = [Part::Battery, Part::Belt, Part::Grease, Part::Motor, Part::BallScrewSpline];
        assert_eq!(parts(RobotModel::Gx4A251S, 2), shaft);
    }
}
