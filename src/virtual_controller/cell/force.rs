//! What the force sensor on a robot's flange feels: the weight and inertia of hand and payload, what the tool is pressed
//! against, and noise.

use super::dynamics::GRAVITY;
use super::kinematics::{Frame, apply_back, flange};
use super::noise;
use super::robot::Robot;
use super::time::CellTime;

/// Force and torque in the sensor's coordinate system, and what force control does about them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Wrench {
    /// In N.
    pub force: [f64; 3],
    /// In N·m.
    pub torque: [f64; 3],
    /// How far force control has moved the tool from where position control wants it, X, Y, Z of the base in mm. Not 0 while
    /// the tool presses against something.
    pub correction: [f64; 3],
}

impl Wrench {
    /// Whether force control runs.
    pub fn controls(&self) -> bool {
        self.correction != [0.0; 3]
    }
}

/// Mass of the hand below the sensor, in kg, and the distance of its centre, in m.
const HAND: f64 = 0.35;
const LEVER: f64 = 0.04;
/// Stiffness of what the tool presses on, in N/mm, and the force that force control does not exceed, in N.
const STIFFNESS: f64 = 14.0;
const MAX_FORCE: f64 = 60.0;
/// How far force control gives way, in mm/N.
const COMPLIANCE: f64 = 0.01;
/// Amplitude of the noise, in N and N·m.
const NOISE: f64 = 0.12;
const TORQUE_NOISE: f64 = 0.004;

/// Half of the time over which speeds are measured.
const STEP_NANOS: u64 = 500_000;

/// The position and velocity of the tool by the motion control, in mm and mm/s.
pub(super) fn tool_motion(robot: &Robot, time: CellTime) -> (Frame, [f64; 3]) {
    let [before, now, after] = around(robot, time);
    let velocity = [0, 1, 2].map(|axis| (after.position[axis] - before.position[axis]) / (2.0 * STEP_SECS));
    (now, velocity)
}

const STEP_SECS: f64 = STEP_NANOS as f64 * 1e-9;

fn around(robot: &Robot, time: CellTime) -> [Frame; 3] {
    let at = |time| flange(robot.model(), &robot.command(time).position);
    let before = CellTime::from_nanos(time.nanos().saturating_sub(STEP_NANOS));
    [at(before), at(time), at(time.plus_nanos(STEP_NANOS))]
}

/// What the sensor feels.
pub(super) fn wrench(robot: &Robot, time: CellTime, seed: u64) -> Wrench {
    let [before, now, after] = around(robot, time);
    let state = robot.state_at(time);
    let mass = HAND + state.payload;
    let mut felt = [0, 1, 2].map(|axis| {
        let bend = after.position[axis] - 2.0 * now.position[axis] + before.position[axis];
        -mass * bend / 1000.0 / STEP_SECS.powi(2)
    });
    felt[2] -= mass * GRAVITY;
    let depth = state.surface.map_or(0.0, |height| (height - now.position[2]).max(0.0));
    let pressed = (depth * STIFFNESS).min(MAX_FORCE);
    felt[2] += pressed;
    let local = apply_back(now.rotation, felt);
    let noise = |channel: u64| noise::signed(seed, time.nanos().wrapping_mul(8).wrapping_add(channel));
    let force = [0, 1, 2].map(|axis| local[axis] + NOISE * noise(axis as u64));
    // The lever is along the sensor's Z axis; a pressed part touches a little beside it.
    let bare = [-LEVER * local[1], LEVER * local[0], 0.0];
    let torque = [
        bare[0] + 0.002 * pressed + TORQUE_NOISE * noise(3),
        bare[1] - 0.001 * pressed + TORQUE_NOISE * noise(4),
        bare[2] + TORQUE_NOISE * noise(5),
    ];
    Wrench { force, torque, correction: [0.0, 0.0, pressed * COMPLIANCE] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::virtual_controller::cell::robot_model::RobotModel;

    fn robot() -> Robot {
        let mut robot = Robot::new(RobotModel::C4A601S, [0.0, 0.0, 0.0, 0.0, -90.0, 0.0], 0, 0);
        robot.set(CellTime::ZERO, |state| state.motors_on = true);
        robot
    }

    #[test]
    fn a_hanging_hand_pulls_along_the_sensors_axis() {
        let mut robot = robot();
        robot.set(CellTime::ZERO, |state| state.payload = 2.0);
        let Wrench { force, torque, correction } = wrench(&robot, CellTime::from_secs(1), 1);
        // The sensor's Z axis points down.
        assert!((force[2] - 2.35 * GRAVITY).abs() < 0.2 && force[0].abs() < 0.2 && force[1].abs() < 0.2, "{force:?}");
        assert!(torque.iter().all(|torque| torque.abs() < 0.02), "{torque:?}");
        assert_eq!(correction, [0.0; 3]);
    }

    #[test]
    fn pressing_on_something_is_felt_and_force_control_gives_way() {
        let mut robot = robot();
        let (tool, velocity) = tool_motion(&robot, CellTime::from_secs(1));
        assert_eq!(velocity, [0.0; 3]);
        robot.set(CellTime::ZERO, |state| state.surface = Some(tool.position[2] + 1.0));
        let pressed = wrench(&robot, CellTime::from_secs(1), 1);
        assert!((pressed.force[2] - (HAND * GRAVITY - STIFFNESS)).abs() < 0.2, "{pressed:?}");
        assert!(pressed.controls() && (pressed.correction[2] - STIFFNESS * COMPLIANCE).abs() < 1e-9);
        robot.set(CellTime::ZERO, |state| state.surface = Some(tool.position[2] + 100.0));
        let limited = wrench(&robot, CellTime::from_secs(1), 1);
        assert!((limited.force[2] - (HAND * GRAVITY - MAX_FORCE)).abs() < 0.2, "{limited:?}");
    }

    #[test]
    fn speed_and_inertia_follow_the_motion() {
        let mut robot = robot();
        let end = robot.go(CellTime::ZERO, &[90.0, 0.0, 0.0, 0.0, -90.0, 0.0], 0.5);
        let (_, velocity) = tool_motion(&robot, CellTime::from_nanos(end.nanos() / 2));
        let speed = velocity[0].hypot(velocity[1]);
        let expected = robot.command(CellTime::from_nanos(end.nanos() / 2)).speed[0].to_radians() * 350.0;
        assert!((speed - expected).abs() < 1.0, "{speed} instead of {expected}");
        let starting = wrench(&robot, CellTime::from_millis(20), 1).force;
        assert!(starting[0].hypot(starting[1]) > 1.0, "{starting:?}");
    }
}
