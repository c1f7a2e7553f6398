use chrono::{DateTime, Utc};

use super::kinematics::Joints;
use super::noise;
use super::robot::Robot;
use super::robot_model::RobotModel;
use super::status::Part;
use super::time::CellTime;
use super::wear::{Wear, has_part};

/// A robot with what belongs to it.
#[derive(Debug)]
pub(super) struct RobotUnit {
    pub robot: Robot,
    /// The home position.
    pub home: Joints,
    /// Hofs, in pulses.
    pub home_offsets: [i64; 6],
    pub battery: Wear,
    /// Of each axis, in the order of [`Part::OF_AXIS`].
    pub parts: Vec<[Option<Wear>; 6]>,
    /// SpeedFactor, in per cent.
    pub speed_factor: u8,
    /// Speed of what Execute moves, in per cent: the statement Speed.
    pub speed: u8,
    /// The motors go off as soon as the robot stands.
    pub motors_off_at_rest: bool,
    /// The motors were on when the safeguard or the mode took them away; Continue switches them on again.
    pub resumes_motors: bool,
    /// How long the motors had been on before this power-on, in nanoseconds.
    motors_on_before: u64,
    pub seed: u64,
}

/// Speed after power-on, Reset and Motor On, in per cent.
pub(super) const DEFAULT_SPEED: u8 = 5;

impl RobotUnit {
    pub fn new(model: RobotModel, home: Joints, seed: u64, started: DateTime<Utc>) -> Self {
        let hours = 200 + noise::bits(seed, 0) % 15_000;
        let count = 50 + noise::bits(seed, 1) % 3000;
        let axes = 0..model.axes().len();
        let part = |axis: usize, at: usize, part: Part| {
            let place = if part == Part::Battery { 0 } else { (axis * 8 + at + 1) as u64 };
            has_part(model, axis, part).then(|| Wear::new(part, noise::branch(seed, place), started))
        };
        let mut home_offsets = [0; 6];
        for (axis, offset) in home_offsets.iter_mut().enumerate().take(model.axes().len()) {
            *offset = (noise::signed(seed, 20 + axis as u64) * 65_536.0) as i64;
        }
        let motors_on_before = hours * 3_600_000_000_000;
        Self {
            // The count is below 3050.
            robot: Robot::new(model, home, motors_on_before, count as u32),
            motors_on_before,
            home,
            home_offsets,
            battery: Wear::new(Part::Battery, noise::branch(seed, 0), started),
            parts: axes
                .map(|axis| {
                    let mut parts = [None; 6];
                    for (at, (slot, kind)) in parts.iter_mut().zip(Part::OF_AXIS).enumerate() {
                        *slot = part(axis, at, kind);
                    }
                    parts
                })
                .collect(),
            speed_factor: 100,
            speed: DEFAULT_SPEED,
            motors_off_at_rest: false,
            resumes_motors: false,
            seed,
        }
    }

    /// How long the motors have been on since power-on.
    pub fn running_hours(&self, now: CellTime) -> f64 {
        (self.robot.settled(now).motors_on_nanos - self.motors_on_before) as f64 / 3.6e12
    }

    /// The motion in progress is over.
    pub fn arrive(&mut self, now: CellTime) {
        self.robot.arrive(now);
        if self.motors_off_at_rest {
            self.motors_off_at_rest = false;
            self.robot.set(now, |state| state.motors_on = false);
        }
    }

    /// Switches the motors off, at once or as soon as the robot stands.
    pub fn switch_off(&mut self, now: CellTime) {
        if self.robot.moving_until().is_some() {
            self.motors_off_at_rest = true;
        } else {
            self.robot.set(now, |state| state.motors_on = false);
        }
    }

    /// Switches the motors on, with power high or low. The speed is set back.
    pub fn switch_on(&mut self, now: CellTime, power_high: bool) {
        self.motors_off_at_rest = false;
        self.speed = DEFAULT_SPEED;
        self.robot.set(now, |state| {
            state.motors_on = true;
            state.power_high = power_high;
        });
    }
}
