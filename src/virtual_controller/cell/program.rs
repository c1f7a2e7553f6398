//! The program of a cell: each robot takes a part, presses it into a fixture under force measurement, and comes back; the
//! main function starts the robots' tasks and looks after conveyor and lamp; a background task exchanges signals with a PLC.
//! Points, times and payloads follow from the seed.

use std::sync::Arc;

use super::io::{IoDirection, IoGroup};
use super::kinematics::{Joints, forward, inverse};
use super::noise;
use super::robot_model::{RobotKind, RobotModel};
use super::snapshot::Pose;

/// One statement of a task.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Statement {
    /// Motors of a robot on, and power high.
    Motor { robot: usize },
    /// PTP motion of a robot to joint positions, at a part of the highest speed.
    Go { robot: usize, to: Joints, speed: f64 },
    /// Waits.
    Wait { millis: u64 },
    /// Switches a bit. An input is switched by the plant, for a sensor that sees what the robot does.
    Bit { signal: Signal, on: bool },
    /// Inverts a bit.
    Toggle { signal: Signal },
    /// Adds one to a byte.
    Count { signal: Signal },
    /// The robot carries so many kilograms.
    Carry { robot: usize, kilograms: f64 },
    /// Something lies under the tool at this height, or nothing.
    Surface { robot: usize, height: Option<f64> },
    /// The property StepID.
    StepId { robot: usize, id: u32 },
    /// RecordStart of the force sensor: length and interval in seconds.
    RecordStart { robot: usize, duration: f32, interval: f32 },
    /// RecordEnd of the recording this task started.
    RecordEnd,
    /// A cycle of a robot is complete; one part was made.
    CycleDone { robot: usize },
    /// Goes on at a statement unless the count of complete cycles can be divided by `every`.
    UnlessCycle { every: u32, jump: usize },
    /// Starts the task with this index.
    Start { task: usize },
    /// Goes on at a statement.
    Jump { to: usize },
}

/// A bit by its group and direction. It counts from the first bit of the port; a byte from its first byte.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Signal {
    pub group: IoGroup,
    pub direction: IoDirection,
    pub offset: u16,
}

impl Signal {
    const fn new(group: IoGroup, direction: IoDirection, offset: u16) -> Self {
        Self { group, direction, offset }
    }
}

/// A function that a task can run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Function {
    pub name: &'static str,
    pub file: &'static str,
    pub code: Arc<[Statement]>,
}

/// The functions of a cell.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Program {
    /// What Start runs: main, main1.
    pub entries: Vec<Function>,
    /// One function a robot, in tasks 2, 3, …
    pub cycles: Vec<Function>,
    /// The function of the background task.
    pub background: Function,
    /// Home of each robot.
    pub homes: Vec<Joints>,
    /// P0 to P4 of each robot: home, above and at the place where the robot takes a part, above and at where it puts it.
    pub points: Vec<[Joints; 5]>,
}

/// Standard outputs of the program: grippers of up to four robots, conveyor, lamp. Those before show the controller's status.
const GRIPPER: u16 = 9;
const CONVEYOR: u16 = 13;
const LAMP: u16 = 14;
/// Standard inputs: a part lies ready for robot 1–4; the gripper of robot 1–4 holds a part. Those before are remote inputs.
const PART_READY: u16 = 8;
const GRIPPER_CLOSED: u16 = 12;

const CYCLE_NAMES: [&str; 4] = ["Robot1Cycle", "Robot2Cycle", "Robot3Cycle", "Robot4Cycle"];
const CYCLE_FILES: [&str; 4] = ["Robot1.prg", "Robot2.prg", "Robot3.prg", "Robot4.prg"];

impl Program {
    /// The program for these robots.
    pub fn new(robots: &[RobotModel], seed: u64) -> Self {
        let homes: Vec<Joints> = robots.iter().map(|model| home(*model)).collect();
        let named = (0..).zip(robots).map(|(robot, model)| {
            let Points { above_pick, pick, above_place, place, .. } = points(*model, seed_of_points(seed, robot));
            [home(*model), above_pick, pick, above_place, place]
        });
        let named = named.collect();
        let cycles = (0..).zip(robots).zip(CYCLE_NAMES.into_iter().zip(CYCLE_FILES)).map(|((robot, model), names)| {
            let code = cycle(robot, *model, seed).into();
            Function { name: names.0, file: names.1, code }
        });
        let go_home = homes
            .iter()
            .enumerate()
            .flat_map(|(robot, to)| [Statement::Motor { robot }, Statement::Go { robot, to: *to, speed: 0.3 }]);
        let entries = vec![
            Function { name: "main", file: "Main.prg", code: main(robots.len()).into() },
            Function { name: "main1", file: "Main.prg", code: go_home.collect() },
        ];
        Self {
            entries,
            cycles: cycles.collect(),
            background: Function { name: "bgMonitor", file: "Monitor.prg", code: background().into() },
            homes,
            points: named,
        }
    }

    /// What the remote command Home runs.
    pub fn home(&self, robot: usize) -> Option<Function> {
        let to = *self.homes.get(robot)?;
        let code = [Statement::Motor { robot }, Statement::Go { robot, to, speed: 0.3 }];
        Some(Function { name: "Home", file: "Main.prg", code: code.into() })
    }
}

/// The home position: a six-axis robot with its hand pointing down, a SCARA with its elbow bent.
fn home(model: RobotModel) -> Joints {
    match model.kind() {
        RobotKind::SixAxis => [0.0, 0.0, 0.0, 0.0, -90.0, 0.0],
        RobotKind::Scara => [60.0, 60.0, 0.0, 0.0, 0.0, 0.0],
    }
}

fn main(robots: usize) -> Vec<Statement> {
    let output = |offset| Signal::new(IoGroup::Standard, IoDirection::Output, offset);
    let mut code: Vec<_> = (0..robots).map(|robot| Statement::Start { task: robot + 1 }).collect();
    let again = code.len();
    code.extend([
        Statement::Bit { signal: output(CONVEYOR), on: true },
        Statement::Bit { signal: output(LAMP), on: true },
        Statement::Wait { millis: 4000 },
        Statement::Bit { signal: output(CONVEYOR), on: false },
        Statement::Bit { signal: output(LAMP), on: false },
        Statement::Wait { millis: 1000 },
        Statement::Jump { to: again },
    ]);
    code
}

/// The exchange of signals with a PLC: a heartbeat each way and a counter. Firmware without these ports ignores it.
fn background() -> Vec<Statement> {
    let slave = |direction, offset| Signal::new(IoGroup::FieldbusSlave, direction, offset);
    let master = |direction, offset| Signal::new(IoGroup::FieldbusMaster, direction, offset);
    let memory = |offset| Signal::new(IoGroup::Memory, IoDirection::Memory, offset);
    let drive_unit = |direction, offset| Signal::new(IoGroup::DriveUnit, direction, offset);
    let extended = |direction, offset| Signal::new(IoGroup::Extended, direction, offset);
    vec![
        Statement::Toggle { signal: slave(IoDirection::Output, 0) },
        Statement::Count { signal: slave(IoDirection::Input, 2) },
        Statement::Toggle { signal: memory(0) },
        Statement::Wait { millis: 500 },
        Statement::Toggle { signal: slave(IoDirection::Input, 0) },
        Statement::Toggle { signal: master(IoDirection::Output, 0) },
        Statement::Count { signal: memory(4) },
        Statement::Toggle { signal: extended(IoDirection::Output, 0) },
        Statement::Wait { millis: 500 },
        Statement::Toggle { signal: master(IoDirection::Input, 0) },
        Statement::Toggle { signal: extended(IoDirection::Input, 0) },
        Statement::Toggle { signal: drive_unit(IoDirection::Input, 0) },
        Statement::Toggle { signal: drive_unit(IoDirection::Output, 0) },
        Statement::Jump { to: 0 },
    ]
}

/// The places of a robot's cycle, in joint positions.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Points {
    above_pick: Joints,
    pick: Joints,
    above_place: Joints,
    place: Joints,
    /// The height at which the part meets the fixture, in mm.
    fixture: f64,
}

/// How far above a place the robot comes and goes, and how far it presses a part in, in mm.
const CLEARANCE: f64 = 60.0;
const PRESSED: f64 = 2.0;

/// The seed of a robot in a program.
fn seed_of_robot(seed: u64, robot: usize) -> u64 {
    noise::branch(seed, robot as u64)
}

/// The seed of a robot's points.
fn seed_of_points(seed: u64, robot: usize) -> u64 {
    noise::branch(seed_of_robot(seed, robot), 1)
}

fn points(model: RobotModel, seed: u64) -> Points {
    let home = home(model);
    let around = |place: u64, size: f64| noise::signed(seed, place) * size;
    let (pick, place) = match model.kind() {
        RobotKind::SixAxis => ((-150.0, 330.0, 250.0), (170.0, 320.0, 240.0)),
        RobotKind::Scara => ((130.0, 140.0, -100.0), (-110.0, 150.0, -105.0)),
    };
    let hand = forward(model, &home);
    let pose = |(x, y, z): (f64, f64, f64), first: u64| Pose {
        x: x + around(first, 12.0),
        y: y + around(first + 1, 12.0),
        z: z + around(first + 2, 8.0),
        u: hand.u + around(first + 3, 30.0),
        ..hand
    };
    let reach = |pose: Pose, near: &Joints| inverse(model, pose, near).unwrap_or(*near);
    let above = |pose: Pose| Pose { z: pose.z + CLEARANCE, ..pose };
    let (pick, place) = (pose(pick, 0), pose(place, 10));
    let above_pick = reach(above(pick), &home);
    let above_place = reach(above(place), &above_pick);
    Points {
        above_pick,
        pick: reach(pick, &above_pick),
        above_place,
        place: reach(place, &above_place),
        fixture: place.z + PRESSED,
    }
}

fn cycle(robot: usize, model: RobotModel, seed: u64) -> Vec<Statement> {
    // At most four robots, so nothing is cut off.
    let own = |first: u16| first + robot as u16;
    let input = |first| Signal::new(IoGroup::Standard, IoDirection::Input, own(first));
    let gripper = Signal::new(IoGroup::Standard, IoDirection::Output, own(GRIPPER));
    let Points { above_pick, pick, above_place, place, fixture } = points(model, seed_of_points(seed, robot));
    let seed = seed_of_robot(seed, robot);
    let millis = |place: u64, least: u64, more: f64| least + (noise::unit(seed, place) * more) as u64;
    let go = |to: Joints, speed: f64| Statement::Go { robot, to, speed };
    let most = if model.kind() == RobotKind::SixAxis { 2.0 } else { 1.5 };
    let part = 0.3 + most * noise::unit(seed, 30);
    let start = vec![Statement::Motor { robot }, go(home(model), 0.3)];
    let again = start.len();
    let mut code = start;
    code.extend([
        go(above_pick, 0.6),
        Statement::Bit { signal: input(PART_READY), on: true },
        go(pick, 0.15),
        Statement::Bit { signal: gripper, on: true },
        Statement::Wait { millis: millis(20, 120, 120.0) },
        Statement::Bit { signal: input(GRIPPER_CLOSED), on: true },
        Statement::Carry { robot, kilograms: part },
        Statement::Bit { signal: input(PART_READY), on: false },
        go(above_pick, 0.2),
        go(above_place, 0.6),
        Statement::StepId { robot, id: 1 },
        Statement::RecordStart { robot, duration: 10.0, interval: 0.004 },
        Statement::Surface { robot, height: Some(fixture) },
        go(place, 0.05),
        Statement::StepId { robot, id: 2 },
        Statement::Wait { millis: millis(21, 350, 200.0) },
        Statement::Bit { signal: gripper, on: false },
        Statement::Wait { millis: millis(22, 100, 100.0) },
        Statement::Bit { signal: input(GRIPPER_CLOSED), on: false },
        Statement::Carry { robot, kilograms: 0.0 },
        go(above_place, 0.2),
        Statement::Surface { robot, height: None },
        Statement::StepId { robot, id: 0 },
        Statement::RecordEnd,
        Statement::CycleDone { robot },
        Statement::Wait { millis: millis(23, 150, 300.0) },
    ]);
    let after_home = code.len() + 3;
    code.extend([
        Statement::UnlessCycle { every: 5, jump: after_home },
        go(home(model), 0.5),
        Statement::Wait { millis: 800 },
        Statement::Jump { to: again },
    ]);
    code
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_seed_gives_places_within_reach() {
        for model in RobotModel::ALL {
            for seed in 0..300 {
                let Points { above_pick, pick, above_place, place, fixture } = points(model, seed);
                for joints in [above_pick, pick, above_place, place] {
                    for (value, axis) in joints.iter().zip(model.axes()) {
                        assert!((axis.min..=axis.max).contains(value), "{model} {seed}: {joints:?}");
                    }
                }
                let height = |joints| forward(model, &joints).z;
                assert!((height(above_pick) - height(pick) - CLEARANCE).abs() < 1e-6, "{model} {seed}");
                assert!((height(above_place) - height(place) - CLEARANCE).abs() < 1e-6, "{model} {seed}");
                assert!((fixture - height(place) - PRESSED).abs() < 1e-6);
                assert!(forward(model, &above_pick).u.abs() <= 180.0 && above_pick != above_place);
            }
        }
    }

    /// A task that never waits would hold the cell up.
    #[test]
    fn every_jump_leads_to_a_statement_and_over_a_wait() {
        let program = Program::new(&[RobotModel::C4A601S, RobotModel::Gx4A251S], 3);
        let functions = program.entries.iter().chain(&program.cycles).chain([&program.background]);
        for Function { name, code, .. } in functions {
            for (at, statement) in code.iter().enumerate() {
                if let Statement::Jump { to } | Statement::UnlessCycle { jump: to, .. } = statement {
                    assert!(*to < code.len(), "{name} {at}");
                    let between = code.get(*to..at).unwrap_or_default();
                    let waits = between.iter().any(|s| matches!(s, Statement::Wait { millis } if *millis > 0));
                    assert!(*to > at || waits, "{name} {at}");
                }
            }
        }
        assert_eq!(program.home(2), None);
        assert_eq!(program.cycles.len(), 2);
    }

    #[test]
    fn the_same_seed_makes_the_same_program() {
        let robots = [RobotModel::C4A601S, RobotModel::Gx4A251S];
        assert_eq!(Program::new(&robots, 3), Program::new(&robots, 3));
        assert_ne!(Program::new(&robots, 3), Program::new(&robots, 4));
    }
}
