//! Joint torques of a robot by lumped masses: gravity, inertia, friction. An approximation that is right in sign, order of
//! magnitude and dependence on posture, speed and payload; the masses are estimates from the weights in the data sheets.

use super::kinematics::Joints;
use super::robot_model::RobotModel;

/// Positions, speeds and accelerations of all joints at one moment: degrees or mm, by second and second squared.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct JointState {
    pub position: Joints,
    pub speed: Joints,
    pub acceleration: Joints,
}

/// Earth's acceleration, in m/s².
pub(super) const GRAVITY: f64 = 9.80665;

/// The torque of each joint in per cent of its rated torque, with a payload in kg at the flange. Limited to the ±300 % that
/// the motors give for a short time.
pub(super) fn torques(model: RobotModel, state: &JointState, payload: f64) -> Joints {
    let needed = match model {
        RobotModel::C4A601S => six_axis(state, payload),
        RobotModel::Gx4A251S => scara(state, payload),
    };
    let mut percent = [0.0; 6];
    for (joint, axis) in model.axes().iter().enumerate() {
        let part_of_speed = state.speed[joint] / axis.max_speed;
        // Coulomb friction changes its sign smoothly about standstill.
        let friction = 6.0 * part_of_speed + 4.0 * (part_of_speed * 200.0).tanh();
        percent[joint] = (needed[joint] / axis.rated_torque * 100.0 + friction).clamp(-300.0, 300.0);
    }
    percent
}

/// Upper arm, forearm and hand as point masses, in kg, with their distance from the joint before them, in m.
const UPPER_ARM: (f64, f64) = (6.5, 0.125);
const FOREARM: (f64, f64) = (5.0, 0.100);
const HAND: (f64, f64) = (1.2, 0.300);
const UPPER_ARM_LENGTH: f64 = 0.250;
const SHOULDER_OFFSET: f64 = 0.100;

fn six_axis(state: &JointState, payload: f64) -> Joints {
    let accelerations = state.acceleration.map(f64::to_radians);
    let upper = (90.0 + state.position[1]).to_radians();
    let fore = (state.position[1] + state.position[2]).to_radians();
    let hand_mass = HAND.0 + payload;

    // Horizontal and vertical distances from the shoulder.
    let upper_arm = (UPPER_ARM.1 * upper.cos(), UPPER_ARM.1 * upper.sin());
    let elbow = (UPPER_ARM_LENGTH * upper.cos(), UPPER_ARM_LENGTH * upper.sin());
    let forearm = (elbow.0 + FOREARM.1 * fore.cos(), elbow.1 + FOREARM.1 * fore.sin());
    let hand = (elbow.0 + HAND.1 * fore.cos(), elbow.1 + HAND.1 * fore.sin());
    let squared = |(x, y): (f64, f64)| x * x + y * y;
    let about_base = |(x, _): (f64, f64)| (x + SHOULDER_OFFSET).powi(2);

    let inertia_1 =
        0.1 + UPPER_ARM.0 * about_base(upper_arm) + FOREARM.0 * about_base(forearm) + hand_mass * about_base(hand);
    let inertia_2 = UPPER_ARM.0 * squared(upper_arm) + FOREARM.0 * squared(forearm) + hand_mass * squared(hand);
    let inertia_3 = FOREARM.0 * FOREARM.1.powi(2) + hand_mass * HAND.1.powi(2);
    let inertia_hand = 0.02 + payload * 0.01;

    let gravity_2 = GRAVITY * (UPPER_ARM.0 * upper_arm.0 + FOREARM.0 * forearm.0 + hand_mass * hand.0);
    let gravity_3 = GRAVITY * (FOREARM.0 * FOREARM.1 + hand_mass * HAND.1) * fore.cos();
    let hand_elevation = fore + state.position[4].to_radians() * state.position[3].to_radians().cos();
    let gravity_5 = GRAVITY * hand_mass * 0.08 * hand_elevation.cos();

    [
        inertia_1 * accelerations[0],
        inertia_2 * accelerations[1] + inertia_3 * accelerations[2] + gravity_2,
        inertia_3 * (accelerations[1] + accelerations[2]) + gravity_3,
        inertia_hand * accelerations[3],
        inertia_hand * accelerations[4] + gravity_5,
        0.5 * inertia_hand * accelerations[5],
    ]
}

/// Arms of the SCARA as point masses in kg, with their lengths in m, and its shaft.
const ARM_1: (f64, f64) = (3.0, 0.120);
const ARM_2: (f64, f64) = (4.0, 0.130);
const SHAFT: f64 = 1.0;

fn scara(state: &JointState, payload: f64) -> Joints {
    let [first, second, _, fourth, ..] = state.acceleration.map(f64::to_radians);
    let load = SHAFT + payload;
    let bend = state.position[1].to_radians();
    let at_elbow = ARM_2.0 + load;
    let own_2 = ARM_2.0 * (ARM_2.1 / 2.0).powi(2) + load * ARM_2.1.powi(2);
    let coupling = (ARM_2.0 * ARM_2.1 / 2.0 + load * ARM_2.1) * ARM_1.1 * bend.cos();
    let own_1 = ARM_1.0 * (ARM_1.1 / 2.0).powi(2) + at_elbow * ARM_1.1.powi(2);
    let speeds = state.speed.map(f64::to_radians);
    let centrifugal = (ARM_2.0 * ARM_2.1 / 2.0 + load * ARM_2.1) * ARM_1.1 * bend.sin();
    let lift = state.acceleration[2] / 1000.0;
    [
        (own_1 + own_2 + 2.0 * coupling) * first + (own_2 + coupling) * second
            - centrifugal * (2.0 * speeds[0] * speeds[1] + speeds[1].powi(2)),
        (own_2 + coupling) * first + own_2 * second + centrifugal * speeds[0].powi(2),
        load * (GRAVITY + lift),
        (0.002 + payload * 0.0005) * (fourth + first + second),
        0.0,
        0.0,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(model: RobotModel, position: Joints, payload: f64) -> Joints {
        torques(model, &JointState { position, ..JointState::default() }, payload)
    }

    #[test]
    fn the_arm_holds_itself_up() {
        let stretched = at(RobotModel::C4A601S, [0.0, -90.0, 90.0, 0.0, 0.0, 0.0], 0.0);
        assert!((20.0..60.0).contains(&stretched[1]), "{stretched:?}");
        assert!((10.0..60.0).contains(&stretched[2]), "{stretched:?}");
        assert_eq!(stretched[0], 0.0);
        let loaded = at(RobotModel::C4A601S, [0.0, -90.0, 90.0, 0.0, 0.0, 0.0], 4.0);
        assert!(loaded[1] > stretched[1] + 10.0, "{loaded:?}");
        let upright = at(RobotModel::C4A601S, [0.0, 0.0, 90.0, 0.0, 0.0, 0.0], 0.0);
        assert!(upright[1].abs() < 1e-9 && upright[2].abs() < 1e-9, "{upright:?}");
    }

    #[test]
    fn the_shaft_of_the_scara_holds_its_load_in_every_posture() {
        for elbow in [0.0, 90.0, -120.0] {
            let held = at(RobotModel::Gx4A251S, [10.0, elbow, -30.0, 0.0, 0.0, 0.0], 2.0);
            assert!((held[2] - 3.0 * GRAVITY / 165.0 * 100.0).abs() < 1e-9, "{held:?}");
            assert_eq!((held[0], held[1]), (0.0, 0.0));
        }
    }

    #[test]
    fn full_acceleration_needs_about_the_rated_torque() {
        for (model, joint) in [(RobotModel::C4A601S, 0), (RobotModel::Gx4A251S, 0), (RobotModel::Gx4A251S, 1)] {
            let mut state = JointState { position: [0.0, -60.0, 60.0, 0.0, 0.0, 0.0], ..JointState::default() };
            if model == RobotModel::Gx4A251S {
                state.position = [0.0; 6];
            }
            state.acceleration[joint] = model.axes()[joint].acceleration;
            let torque = torques(model, &state, 1.0)[joint];
            assert!((20.0..250.0).contains(&torque), "{model} joint {joint}: {torque}");
            state.acceleration[joint] *= -1.0;
            assert!((torques(model, &state, 1.0)[joint] + torque).abs() < 1e-9);
        }
    }
}
