//! Forward and inverse kinematics of the robots, by their Denavit–Hartenberg parameters in the form of Craig (Introduction
//! to Robotics, 3rd edition, 3.4): each link turns by α about X and moves by a along X, then turns by θ about Z and moves by
//! d along Z.
//!
//! C4-A601S (C4 series manual, outer dimensions): shoulder 320 mm above the base and 100 mm in front of joint 1, upper arm
//! 250 mm, forearm 250 mm, flange 65 mm in front of the wrist's centre. At 0° in every joint the arm looks along +Y, the
//! upper arm stands upright and the forearm is level. GX4-A251S (GX series manual, standard work envelope): arms of 120 mm
//! and 130 mm; at 0° both look along +X.

use std::fmt;

use super::robot_model::{RobotKind, RobotModel};
use super::snapshot::Pose;

/// Joint positions, joint 1 first: degrees, or millimetres for a linear joint. Unused joints are 0.
pub(super) type Joints = [f64; 6];

/// One link.
#[derive(Debug, Clone, Copy)]
struct Link {
    alpha_deg: f64,
    a: f64,
    d: f64,
    theta_deg: f64,
    /// The direction of the joint's motion.
    joint: Motion,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Motion {
    /// θ grows with the joint.
    Turns,
    /// θ falls as the joint grows.
    TurnsBack,
    /// d grows with the joint.
    Slides,
}

const fn link(alpha_deg: f64, a: f64, d: f64, theta_deg: f64, joint: Motion) -> Link {
    Link { alpha_deg, a, d, theta_deg, joint }
}

const SHOULDER_HEIGHT: f64 = 320.0;
const SHOULDER_OFFSET: f64 = 100.0;
const UPPER_ARM: f64 = 250.0;
const FOREARM: f64 = 250.0;
const FLANGE: f64 = 65.0;

const C4_A601S: [Link; 6] = [
    link(0.0, 0.0, SHOULDER_HEIGHT, 90.0, Motion::Turns),
    link(-90.0, SHOULDER_OFFSET, 0.0, -90.0, Motion::TurnsBack),
    link(0.0, UPPER_ARM, 0.0, 0.0, Motion::TurnsBack),
    link(-90.0, 0.0, FOREARM, 0.0, Motion::TurnsBack),
    link(90.0, 0.0, 0.0, 0.0, Motion::TurnsBack),
    link(-90.0, 0.0, FLANGE, 0.0, Motion::TurnsBack),
];

const ARM_1: f64 = 120.0;
const ARM_2: f64 = 130.0;

const GX4_A251S: [Link; 4] = [
    link(0.0, 0.0, 0.0, 0.0, Motion::Turns),
    link(0.0, ARM_1, 0.0, 0.0, Motion::Turns),
    link(0.0, ARM_2, 0.0, 0.0, Motion::Slides),
    link(0.0, 0.0, 0.0, 0.0, Motion::Turns),
];

const fn links(model: RobotModel) -> &'static [Link] {
    match model {
        RobotModel::C4A601S => &C4_A601S,
        RobotModel::Gx4A251S => &GX4_A251S,
    }
}

/// A rotation, by rows.
type Rotation = [[f64; 3]; 3];

const IDENTITY: Rotation = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A coordinate system in that of the base.
#[derive(Debug, Clone, Copy)]
pub(super) struct Frame {
    pub rotation: Rotation,
    /// In millimetres.
    pub position: [f64; 3],
}

impl Frame {
    const BASE: Self = Self { rotation: IDENTITY, position: [0.0; 3] };

    fn then(self, Link { alpha_deg, a, d, theta_deg, joint }: Link, value: f64) -> Self {
        let (theta, d) = match joint {
            Motion::Turns => (theta_deg + value, d),
            Motion::TurnsBack => (theta_deg - value, d),
            Motion::Slides => (theta_deg, d + value),
        };
        let (sa, ca) = alpha_deg.to_radians().sin_cos();
        let (st, ct) = theta.to_radians().sin_cos();
        let rotation = multiply(self.rotation, [[ct, -st, 0.0], [st * ca, ct * ca, -sa], [st * sa, ct * sa, ca]]);
        let along = apply(self.rotation, [a, -sa * d, ca * d]);
        Self { rotation, position: add(self.position, along) }
    }

    /// Rotations about Z by U, then Y by V, then X by W.
    pub fn pose(self) -> Pose {
        let [[xx, xy, _], [yx, yy, _], [zx, zy, zz]] = self.rotation;
        let across = xx.hypot(yx);
        let (u, v, w) = if across > 1e-9 {
            (yx.atan2(xx), (-zx).atan2(across), zy.atan2(zz))
        } else {
            // V is ±90°: U and W turn about the same axis, and W takes all of it.
            (0.0, (-zx).atan2(across), (zx.signum() * -xy).atan2(yy))
        };
        let [x, y, z] = self.position;
        Pose { x, y, z, u: u.to_degrees(), v: v.to_degrees(), w: w.to_degrees() }
    }

    fn of(pose: Pose) -> Self {
        let (su, cu) = pose.u.to_radians().sin_cos();
        let (sv, cv) = pose.v.to_radians().sin_cos();
        let (sw, cw) = pose.w.to_radians().sin_cos();
        let about_z = [[cu, -su, 0.0], [su, cu, 0.0], [0.0, 0.0, 1.0]];
        let about_y = [[cv, 0.0, sv], [0.0, 1.0, 0.0], [-sv, 0.0, cv]];
        let about_x = [[1.0, 0.0, 0.0], [0.0, cw, -sw], [0.0, sw, cw]];
        let rotation = multiply(multiply(about_z, about_y), about_x);
        Self { rotation, position: [pose.x, pose.y, pose.z] }
    }
}

/// The frame of the flange, or of the shaft's end, at these joint positions.
pub(super) fn flange(model: RobotModel, joints: &Joints) -> Frame {
    links(model).iter().zip(joints).fold(Frame::BASE, |frame, (link, value)| frame.then(*link, *value))
}

/// Where the tool (tool 0: the flange or the shaft's end) is at these joint positions.
pub(super) fn forward(model: RobotModel, joints: &Joints) -> Pose {
    flange(model, joints).pose()
}

/// Joint positions for a pose, of those within the joints' ranges the nearest to `near`. `None` if the pose cannot be
/// reached.
pub(super) fn inverse(model: RobotModel, pose: Pose, near: &Joints) -> Option<Joints> {
    let solutions = match model {
        RobotModel::C4A601S => six_axis(pose, near),
        RobotModel::Gx4A251S => scara(pose),
    };
    let ranges = model.axes();
    let distance = |joints: &Joints| joints.iter().zip(near).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    solutions
        .into_iter()
        .filter_map(|mut joints| {
            for ((joint, axis), near) in joints.iter_mut().zip(ranges).zip(near) {
                if axis.profile == super::robot_model::MotionProfile::Rotary {
                    *joint = turn_near(*joint, *near, axis.min, axis.max);
                }
                if !(axis.min - 1e-9..=axis.max + 1e-9).contains(joint) {
                    return None;
                }
            }
            Some(joints)
        })
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// How an arm reaches a point, where several postures do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Posture {
    kind: RobotKind,
    /// The elbow of a SCARA, or the shoulder of a six-axis robot, is to the right.
    is_right: bool,
    /// The elbow of a six-axis robot is above.
    is_above: bool,
    /// The wrist of a six-axis robot is turned over.
    is_flipped: bool,
}

/// As SPEL+ writes it: `/R` or `/L`; for six axes also `/A` or `/B`, and `/NF` or `/F`.
impl fmt::Display for Posture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(if self.is_right { "/R" } else { "/L" })?;
        if self.kind == RobotKind::SixAxis {
            f.write_str(if self.is_above { " /A" } else { " /B" })?;
            f.write_str(if self.is_flipped { " /F" } else { " /NF" })?;
        }
        Ok(())
    }
}

/// The posture at these joint positions.
pub(super) fn posture(model: RobotModel, joints: &Joints) -> Posture {
    let [_, second, third, _, fifth, _] = *joints;
    let kind = model.kind();
    match kind {
        RobotKind::Scara => Posture { kind, is_right: second >= 0.0, is_above: true, is_flipped: false },
        RobotKind::SixAxis => {
            // At 0° the upper arm stands upright and the forearm is level.
            let upper_arm = (second + 90.0).to_radians().cos() * UPPER_ARM;
            let forearm = (second + third).to_radians().cos() * FOREARM;
            let is_right = SHOULDER_OFFSET + upper_arm + forearm >= 0.0;
            Posture { kind, is_right, is_above: third <= 90.0, is_flipped: fifth > 0.0 }
        }
    }
}

/// The same direction, by whole turns as near to `near` as the range allows.
fn turn_near(angle: f64, near: f64, min: f64, max: f64) -> f64 {
    let nearest = angle + ((near - angle) / 360.0).round() * 360.0;
    [nearest, nearest - 360.0, nearest + 360.0]
        .into_iter()
        .filter(|angle| (min - 1e-9..=max + 1e-9).contains(angle))
        .min_by(|a, b| (a - near).abs().total_cmp(&(b - near).abs()))
        .unwrap_or(nearest)
}

fn scara(pose: Pose) -> Vec<Joints> {
    let squared = pose.x.powi(2) + pose.y.powi(2);
    let bend = (squared - ARM_1.powi(2) - ARM_2.powi(2)) / (2.0 * ARM_1 * ARM_2);
    if bend.abs() > 1.0 + 1e-12 {
        return Vec::new();
    }
    let elbow = bend.clamp(-1.0, 1.0).acos();
    [elbow, -elbow]
        .into_iter()
        .map(|second| {
            let first = pose.y.atan2(pose.x) - (ARM_2 * second.sin()).atan2(ARM_1 + ARM_2 * second.cos());
            let (first, second) = (first.to_degrees(), second.to_degrees());
            [first, second, pose.z, pose.u - first - second, 0.0, 0.0]
        })
        .collect()
}

/// The axes of joints 4, 5 and 6 meet in the centre of the wrist, so position and orientation are solved apart.
fn six_axis(pose: Pose, near: &Joints) -> Vec<Joints> {
    let wanted = Frame::of(pose);
    let ahead = apply(wanted.rotation, [0.0, 0.0, FLANGE]);
    let wrist = [0, 1, 2].map(|axis| wanted.position[axis] - ahead[axis]);
    let direction = wrist[1].atan2(wrist[0]).to_degrees() - 90.0;
    let radius = wrist[0].hypot(wrist[1]);
    let mut solutions = Vec::new();
    for (first, reach) in [(direction, radius - SHOULDER_OFFSET), (direction + 180.0, -radius - SHOULDER_OFFSET)] {
        let height = wrist[2] - SHOULDER_HEIGHT;
        let distance = reach.hypot(height);
        let bend = (UPPER_ARM.powi(2) + FOREARM.powi(2) - distance.powi(2)) / (2.0 * UPPER_ARM * FOREARM);
        if bend.abs() > 1.0 {
            continue;
        }
        let elbow = bend.acos();
        let at_shoulder =
            ((UPPER_ARM.powi(2) + distance.powi(2) - FOREARM.powi(2)) / (2.0 * UPPER_ARM * distance)).clamp(-1.0, 1.0);
        for (up, raised) in [(1.0, at_shoulder.acos()), (-1.0, -at_shoulder.acos())] {
            // Elevation of the upper arm over the horizontal; joint 2 leans it back from upright.
            let elevation = height.atan2(reach) + raised;
            let second = elevation.to_degrees() - 90.0;
            // The elbow's inner angle is 90° where the forearm is level and the upper arm upright.
            let third = if up > 0.0 { elbow.to_degrees() - 90.0 } else { 270.0 - elbow.to_degrees() };
            let arm = [first, second, third, 0.0, 0.0, 0.0];
            solutions.extend(wrist_angles(&arm, wanted.rotation, near));
        }
    }
    solutions
}

/// Joints 4 to 6 for an arm whose joints 1 to 3 are known: two solutions.
fn wrist_angles(arm: &Joints, wanted: Rotation, near: &Joints) -> [Joints; 2] {
    let forearm = C4_A601S.iter().zip(arm).take(3).fold(Frame::BASE, |frame, (link, value)| frame.then(*link, *value));
    // What is left is a rotation about Y by θ4, Z by θ5 and Y by θ6, then −90° about X.
    let left = multiply(transpose(forearm.rotation), wanted);
    let m = multiply(left, [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]);
    let bend = m[0][1].hypot(m[2][1]);
    [1.0, -1.0].map(|sign| {
        let fifth = (sign * bend).atan2(m[1][1]);
        let (fourth, sixth) = if bend > 1e-9 {
            ((sign * m[2][1]).atan2(-sign * m[0][1]), (sign * m[1][2]).atan2(sign * m[1][0]))
        } else {
            // Joints 4 and 6 turn about the same axis: joint 4 stays, joint 6 takes the rest.
            let fourth = -near[3].to_radians();
            let turned = m[0][2].atan2(m[0][0]);
            (fourth, if m[1][1] > 0.0 { turned - fourth } else { turned + fourth })
        };
        let [a, b, c, ..] = *arm;
        [a, b, c, -fourth.to_degrees(), -fifth.to_degrees(), -sixth.to_degrees()]
    })
}

fn multiply(a: Rotation, b: Rotation) -> Rotation {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| (0..3).map(|k| a[row][k] * b[k][column]).sum()))
}

fn transpose(a: Rotation) -> Rotation {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| a[column][row]))
}

/// The vector `v`, turned.
pub(super) fn apply(a: Rotation, v: [f64; 3]) -> [f64; 3] {
    a.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// The vector `v` of the base, as the frame with this rotation sees it.
pub(super) fn apply_back(a: Rotation, v: [f64; 3]) -> [f64; 3] {
    apply(transpose(a), v)
}

fn add(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn close(pose: Pose, expected: [f64; 6]) {
        let got = pose.to_array();
        assert!(got.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{got:?} instead of {expected:?}");
    }

    /// By the outer dimensions of the C4-A601S.
    #[test]
    fn known_poses_of_the_six_axis_robot() {
        let at = |joints| forward(RobotModel::C4A601S, &joints);
        // Forearm and flange level, along +Y: 100 + 250 + 65 in front, 320 + 250 high.
        close(at([0.0; 6]), [0.0, 415.0, 570.0, 0.0, -90.0, -90.0].map(|v| v));
        // Stretched out to the front: J2 90° forward, J3 90° up.
        let stretched = at([0.0, -90.0, 90.0, 0.0, 0.0, 0.0]);
        assert!((stretched.y - 665.0).abs() < 1e-9 && (stretched.z - 320.0).abs() < 1e-9, "{stretched:?}");
        // Upright.
        let upright = at([0.0, 0.0, 90.0, 0.0, 0.0, 0.0]);
        assert!((upright.y - 100.0).abs() < 1e-9 && (upright.z - 885.0).abs() < 1e-9, "{upright:?}");
        // Hand pointing down; joint 1 turned to the left by 90° looks along −X.
        let down = at([90.0, 0.0, 0.0, 0.0, -90.0, 0.0]);
        assert!((down.x + 350.0).abs() < 1e-9 && down.y.abs() < 1e-9 && (down.z - 505.0).abs() < 1e-9, "{down:?}");
        assert!((down.v.abs() < 1e-9) && (down.w.abs() - 180.0).abs() < 1e-9, "{down:?}");
    }

    /// By the work envelope of the GX4-A251S.
    #[test]
    fn known_poses_of_the_scara() {
        let at = |joints| forward(RobotModel::Gx4A251S, &joints);
        close(at([0.0; 6]), [250.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        close(at([90.0, 0.0, -150.0, 0.0, 0.0, 0.0]), [0.0, 250.0, -150.0, 90.0, 0.0, 0.0]);
        close(at([0.0, 90.0, -20.0, -90.0, 0.0, 0.0]), [120.0, 130.0, -20.0, 0.0, 0.0, 0.0]);
        let folded = at([0.0, 141.0, 0.0, 0.0, 0.0, 0.0]);
        assert!((folded.x.hypot(folded.y) - 84.0).abs() < 4.0, "near the inner limit of 87 mm: {folded:?}");
    }

    #[test]
    fn postures_are_written_as_in_spel() {
        let written = |model, joints| posture(model, &joints).to_string();
        let scara = |second| written(RobotModel::Gx4A251S, [10.0, second, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!((scara(60.0).as_str(), scara(-60.0).as_str()), ("/R", "/L"));
        let six = |second, third, fifth| written(RobotModel::C4A601S, [0.0, second, third, 0.0, fifth, 0.0]);
        assert_eq!(six(0.0, 0.0, -90.0), "/R /A /NF");
        assert_eq!(six(0.0, 0.0, 10.0), "/R /A /F");
        assert_eq!(six(0.0, 100.0, -90.0), "/R /B /NF");
        assert_eq!(six(60.0, 120.0, -90.0), "/L /B /NF");
    }

    #[test]
    fn what_cannot_be_reached_has_no_solution() {
        for model in RobotModel::ALL {
            let far = Pose { x: 2000.0, ..Pose::default() };
            assert_eq!(inverse(model, far, &[0.0; 6]), None);
        }
        let above = Pose { x: 200.0, z: 10.0, ..Pose::default() };
        assert_eq!(inverse(RobotModel::Gx4A251S, above, &[0.0; 6]), None);
    }

    fn joints(model: RobotModel) -> impl Strategy<Value = Joints> {
        proptest::array::uniform6(0.0..1.0).prop_map(move |part: [f64; 6]| {
            let mut joints = [0.0; 6];
            for ((joint, axis), part) in joints.iter_mut().zip(model.axes()).zip(part) {
                *joint = axis.min + (axis.max - axis.min) * part;
            }
            joints
        })
    }

    fn assert_same(a: Pose, b: Pose) {
        let (a, b) = (Frame::of(a), Frame::of(b));
        let apart = (0..3).map(|axis| (a.position[axis] - b.position[axis]).abs()).fold(0.0, f64::max);
        let turned = (0..3)
            .flat_map(|row| (0..3).map(move |column| (row, column)))
            .map(|(row, column)| (a.rotation[row][column] - b.rotation[row][column]).abs())
            .fold(0.0, f64::max);
        assert!(apart < 1e-6 && turned < 1e-6, "{apart} mm, {turned}: {a:?} and {b:?}");
    }

    proptest! {
        #[test]
        fn the_inverse_reaches_what_the_six_axis_robot_reaches(joints in joints(RobotModel::C4A601S)) {
            let pose = forward(RobotModel::C4A601S, &joints);
            let found = inverse(RobotModel::C4A601S, pose, &joints).expect("a pose that the joints give");
            assert_same(forward(RobotModel::C4A601S, &found), pose);
        }

        #[test]
        fn the_inverse_gives_the_scaras_joints_back(joints in joints(RobotModel::Gx4A251S)) {
            let pose = forward(RobotModel::Gx4A251S, &joints);
            let found = inverse(RobotModel::Gx4A251S, pose, &joints).expect("a pose that the joints give");
            assert_same(forward(RobotModel::Gx4A251S, &found), pose);
        }

        #[test]
        fn a_pose_survives_its_rotation_matrix(joints in joints(RobotModel::C4A601S)) {
            let frame = flange(RobotModel::C4A601S, &joints);
            assert_same(frame.pose(), Frame { ..frame }.pose());
            let again = Frame::of(frame.pose());
            for row in 0..3 {
                for column in 0..3 {
                    prop_assert!((again.rotation[row][column] - frame.rotation[row][column]).abs() < 1e-6);
                }
            }
        }
    }
}
