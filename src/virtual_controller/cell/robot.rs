use std::collections::VecDeque;

use super::dynamics::{JointState, torques};
use super::kinematics::Joints;
use super::motion::{LoadMemory, Motion};
use super::profile::Profile;
use super::robot_model::RobotModel;
use super::time::CellTime;

/// One robot over time: a row of segments, each with one motion or standstill, from which the state at any moment of the
/// kept past is calculated.
///
/// What fills slowly (overload rates, temperatures, running time) is settled at the end of each segment only, so it does not
/// depend on how often or at which moments anybody looks.
#[derive(Debug)]
pub(super) struct Robot {
    model: RobotModel,
    /// In the order of time; never empty. The last one goes on.
    segments: VecDeque<Segment>,
    moving_until: Option<CellTime>,
    loads: LoadMemory,
}

/// What is the same until something begins: a motion, a standstill, motors on or off, another load.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Segment {
    start: CellTime,
    motion: Motion,
    state: RobotState,
    /// As it was at the start.
    settled: Settled,
    /// The mean of the squared torque of each joint during the segment, in (100 %)².
    load: Joints,
}

/// What a robot is set to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct RobotState {
    pub motors_on: bool,
    pub power_high: bool,
    /// Payload in kg.
    pub payload: f64,
    /// The height of what lies under the tool and can be pressed on, in mm.
    pub surface: Option<f64>,
    /// The value of the property StepID of the program.
    pub step_id: u32,
}

/// What fills slowly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Settled {
    /// Squared torque, in (100 %)², smoothed over [`OVERLOAD_SECS`].
    squared_torque: Joints,
    /// Of the encoders, in °C.
    pub temperature: Joints,
    pub motors_on_nanos: u64,
    pub motors_on_count: u32,
}

impl Settled {
    /// OLRate of each joint: 1.0 at rated torque for good, at most 2.0.
    pub fn overload_rates(&self) -> Joints {
        self.squared_torque.map(|squared| squared.sqrt().min(2.0))
    }
}

/// Time constant of the overload rate.
const OVERLOAD_SECS: f64 = 60.0;
/// Time constant of the encoders' temperatures.
const HEATING_SECS: f64 = 1500.0;
/// Temperature of the room, in °C.
pub(super) const ROOM_TEMPERATURE: f64 = 24.0;
/// An encoder over the room's temperature: with motors on, and at rated torque for good.
const STANDBY_HEAT: f64 = 6.0;
const FULL_HEAT: f64 = 34.0;

/// How far the robot is behind the motion control.
const LAG_NANOS: u64 = 4_000_000;

/// Segments kept at most; beyond them the oldest is dropped even if a queue has not been read.
pub(super) const MAX_SEGMENTS: usize = 2048;

impl Robot {
    /// At rest at `position`, motors off, as at power-on. `motors_on` is what the motors had done before.
    pub fn new(model: RobotModel, position: Joints, motors_on_nanos: u64, motors_on_count: u32) -> Self {
        let state = RobotState { motors_on: false, power_high: false, payload: 0.0, surface: None, step_id: 0 };
        let settled =
            Settled { squared_torque: [0.0; 6], temperature: [ROOM_TEMPERATURE; 6], motors_on_nanos, motors_on_count };
        let start = CellTime::ZERO;
        let motion = Motion { start, from: position, delta: [0.0; 6], profile: Profile::REST };
        let first = Segment { start, motion, state, settled, load: [0.0; 6] };
        Self { model, segments: VecDeque::from([first]), moving_until: None, loads: LoadMemory::default() }
    }

    pub const fn model(&self) -> RobotModel {
        self.model
    }

    /// What the robot is set to now.
    pub fn state(&self) -> RobotState {
        self.last().state
    }

    /// Changes what the robot is set to. A motion in progress goes on.
    pub fn set(&mut self, now: CellTime, change: impl FnOnce(&mut RobotState)) {
        let mut state = self.state();
        change(&mut state);
        if state != self.state() {
            let Segment { motion, .. } = *self.last();
            self.begin(now, motion, state);
        }
    }

    /// Starts a motion in which every joint moves by its own share of the path and all arrive together (PTP). Returns when it
    /// ends. `speed` is the part of the highest speeds and accelerations that is used: above 0, at most 1.
    pub fn go(&mut self, now: CellTime, goal: &Joints, speed: f64) -> CellTime {
        let from = self.command(now).position;
        let mut delta = [0.0; 6];
        let (mut max_speed, mut max_acceleration) = (f64::INFINITY, f64::INFINITY);
        for (joint, axis) in self.model.axes().iter().enumerate() {
            delta[joint] = goal[joint] - from[joint];
            let way = delta[joint].abs();
            if way > 1e-9 {
                max_speed = max_speed.min(axis.max_speed * speed / way);
                max_acceleration = max_acceleration.min(axis.acceleration * speed / way);
            }
        }
        if max_speed.is_infinite() {
            return now;
        }
        let profile = Profile::rest_to_rest(max_speed, max_acceleration);
        self.start(Motion { start: now, from, delta, profile })
    }

    /// Slows the robot down to a stop on its path, `hardness` times as hard as it may accelerate. Returns when it stands.
    pub fn brake(&mut self, now: CellTime, hardness: f64) -> CellTime {
        let Motion { from, delta, .. } = self.last().motion;
        let progress = self.last().motion.progress(now);
        if progress.speed <= 0.0 {
            // A motion that begins now is not begun.
            if self.moving_until.take().is_some() {
                self.rest(now);
            }
            return now;
        }
        let axes = self.model.axes().iter().zip(delta).filter(|(_, way)| way.abs() > 1e-9);
        let deceleration =
            axes.map(|(axis, way)| axis.acceleration * hardness / way.abs()).fold(f64::INFINITY, f64::min);
        self.start(Motion { start: now, from, delta, profile: Profile::brake(progress, deceleration) })
    }

    fn start(&mut self, motion: Motion) -> CellTime {
        let end = motion.start.plus_nanos(motion.profile.millis() * 1_000_000);
        self.begin(motion.start, motion, self.state());
        self.moving_until = Some(end);
        end
    }

    /// When the motion in progress ends.
    pub const fn moving_until(&self) -> Option<CellTime> {
        self.moving_until
    }

    /// Ends the motion that is over `now`.
    pub fn arrive(&mut self, now: CellTime) {
        if self.moving_until.is_some_and(|end| end <= now) {
            self.moving_until = None;
            self.rest(now);
        }
    }

    fn rest(&mut self, now: CellTime) {
        let from = self.command(now).position;
        self.begin(now, Motion { start: now, from, delta: [0.0; 6], profile: Profile::REST }, self.state());
    }

    fn begin(&mut self, now: CellTime, motion: Motion, state: RobotState) {
        let mut settled = self.settled(now);
        if state.motors_on && !self.state().motors_on {
            settled.motors_on_count = settled.motors_on_count.saturating_add(1);
        }
        let load = if state.motors_on { self.loads.mean_squared(self.model, &motion, state.payload) } else { [0.0; 6] };
        if self.last().start == now {
            self.segments.pop_back();
        }
        self.segments.push_back(Segment { start: now, motion, state, settled, load });
    }

    /// Where the motion control wants the robot to be.
    pub fn command(&self, time: CellTime) -> JointState {
        self.segment(time).motion.joints(time)
    }

    /// Where the robot is: behind the motion control, and on whole pulses of the encoders.
    pub fn actual(&self, time: CellTime) -> JointState {
        let mut state = self.command(CellTime::from_nanos(time.nanos().saturating_sub(LAG_NANOS)));
        for (position, axis) in state.position.iter_mut().zip(self.model.axes()) {
            *position = (*position * axis.pulses_per_unit).round() / axis.pulses_per_unit;
        }
        state
    }

    /// The torque of each joint in per cent; 0 with the motors off, when the brakes hold the robot.
    pub fn torques(&self, time: CellTime) -> Joints {
        let segment = self.segment(time);
        if segment.state.motors_on {
            torques(self.model, &segment.motion.joints(time), segment.state.payload)
        } else {
            [0.0; 6]
        }
    }

    /// What the robot was set to.
    pub fn state_at(&self, time: CellTime) -> RobotState {
        self.segment(time).state
    }

    /// What fills slowly, at this moment.
    pub fn settled(&self, time: CellTime) -> Settled {
        let segment = self.segment(time);
        let nanos = time.nanos_since(segment.start);
        let secs = nanos as f64 * 1e-9;
        let Settled { mut squared_torque, mut temperature, mut motors_on_nanos, motors_on_count } = segment.settled;
        let (overload_left, heat_left) = ((-secs / OVERLOAD_SECS).exp(), (-secs / HEATING_SECS).exp());
        for joint in 0..self.model.axes().len() {
            let load = segment.load[joint];
            squared_torque[joint] = load + (squared_torque[joint] - load) * overload_left;
            let standby = if segment.state.motors_on { STANDBY_HEAT } else { 0.0 };
            let end = ROOM_TEMPERATURE + standby + FULL_HEAT * load.min(1.5);
            temperature[joint] = end + (temperature[joint] - end) * heat_left;
        }
        if segment.state.motors_on {
            motors_on_nanos += nanos;
        }
        Settled { squared_torque, temperature, motors_on_nanos, motors_on_count }
    }

    /// Whether the motion control is at this moment within a motion.
    pub fn moves(&self, time: CellTime) -> bool {
        self.segment(time).motion.progress(time).speed > 0.0
    }

    /// Drops what is not needed for moments from `time` on, and more where that is too much. Returns the earliest moment that
    /// is left.
    pub fn forget_before(&mut self, time: CellTime) -> CellTime {
        let needed = CellTime::from_nanos(time.nanos().saturating_sub(2 * LAG_NANOS));
        while self.segments.len() > MAX_SEGMENTS || self.segments.get(1).is_some_and(|next| next.start <= needed) {
            self.segments.pop_front();
        }
        self.segments[0].start.plus_nanos(LAG_NANOS)
    }

    /// How many segments are kept.
    #[cfg(test)]
    pub fn held(&self) -> usize {
        self.segments.len()
    }

    fn segment(&self, time: CellTime) -> &Segment {
        let after = self.segments.partition_point(|segment| segment.start <= time);
        &self.segments[after.saturating_sub(1)]
    }

    fn last(&self) -> &Segment {
        &self.segments[self.segments.len() - 1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn robot(model: RobotModel) -> Robot {
        let mut robot = Robot::new(model, [0.0; 6], 0, 5);
        robot.set(CellTime::ZERO, |state| state.motors_on = true);
        robot
    }

    #[test]
    fn all_joints_arrive_together_within_their_limits() {
        for model in RobotModel::ALL {
            let mut robot = robot(model);
            let goal = [30.0, -40.0, -20.0, 100.0, 0.0, 0.0];
            let end = robot.go(CellTime::from_millis(10), &goal, 0.8);
            let halfway = robot.command(CellTime::from_nanos(end.nanos() / 2 + 5_000_000));
            for (joint, axis) in model.axes().iter().enumerate() {
                assert!((halfway.position[joint] - goal[joint] / 2.0).abs() < goal[joint].abs() / 20.0 + 1e-9);
                let mut at = CellTime::ZERO;
                while at < end {
                    let state = robot.command(at);
                    assert!(state.speed[joint].abs() <= axis.max_speed * 0.8 + 1e-9);
                    assert!(state.acceleration[joint].abs() <= axis.acceleration * 0.8 + 1e-9);
                    at = at.plus_nanos(1_000_000);
                }
            }
            robot.arrive(end);
            assert_eq!(robot.command(end).position[..4], goal[..4]);
            assert!(!robot.moves(end));
        }
    }

    #[test]
    fn a_braked_robot_stays_on_its_path_and_goes_on_to_its_goal() {
        let mut robot = robot(RobotModel::C4A601S);
        let goal = [90.0, -45.0, 0.0, 0.0, 0.0, 0.0];
        robot.go(CellTime::ZERO, &goal, 0.5);
        let stopped = robot.brake(CellTime::from_millis(200), 1.0);
        assert!(stopped > CellTime::from_millis(200));
        robot.arrive(stopped);
        let at = robot.command(stopped).position;
        assert!((at[0] + at[1] * 2.0).abs() < 1e-9 && at[0] > 0.0 && at[0] < 90.0, "{at:?}");
        assert_eq!(robot.brake(stopped, 1.0), stopped);
        robot.go(CellTime::from_secs(4), &goal, 0.5);
        robot.brake(CellTime::from_secs(4), 1.0);
        assert_eq!((robot.moving_until(), robot.command(CellTime::from_secs(5)).position), (None, at));
        let end = robot.go(CellTime::from_secs(5), &goal, 0.5);
        robot.arrive(end);
        assert_eq!(robot.command(end).position, goal);
    }

    #[test]
    fn the_robot_follows_the_motion_control_on_whole_pulses() {
        let mut robot = robot(RobotModel::Gx4A251S);
        let end = robot.go(CellTime::ZERO, &[50.0, 50.0, -10.0, 90.0, 0.0, 0.0], 1.0);
        let middle = CellTime::from_nanos(end.nanos() / 2);
        assert!(robot.actual(middle).position[0] < robot.command(middle).position[0]);
        for (joint, axis) in RobotModel::Gx4A251S.axes().iter().enumerate() {
            let pulses = robot.actual(middle).position[joint] * axis.pulses_per_unit;
            assert!((pulses - pulses.round()).abs() < 1e-6, "{pulses}");
        }
    }

    #[test]
    fn what_fills_slowly_does_not_depend_on_who_looks() {
        let run = |looks: u64| {
            let mut robot = robot(RobotModel::C4A601S);
            let mut at = CellTime::ZERO;
            for _ in 0..200 {
                for goal in [[60.0, -60.0, 30.0, 0.0, -90.0, 0.0], [-60.0, -20.0, 0.0, 90.0, -90.0, 0.0]] {
                    let end = robot.go(at, &goal, 1.0);
                    for look in 0..looks {
                        let moment = at.nanos() + (end.nanos() - at.nanos()) / looks * look;
                        robot.settled(CellTime::from_nanos(moment));
                    }
                    robot.arrive(end);
                    at = end.plus_nanos(50_000_000);
                    robot.forget_before(at);
                }
            }
            (robot.settled(at), at)
        };
        let (settled, at) = run(0);
        assert_eq!(run(7), (settled, at));
        assert!(settled.overload_rates()[0] > 0.2 && settled.overload_rates()[0] < 2.0, "{settled:?}");
        assert!(settled.temperature[0] > ROOM_TEMPERATURE && settled.temperature[0] < 80.0, "{settled:?}");
        assert_eq!((settled.motors_on_nanos, settled.motors_on_count), (at.nanos(), 6));
    }

    #[test]
    fn a_robot_without_motors_needs_no_torque_and_its_load_fades() {
        let mut robot = robot(RobotModel::C4A601S);
        robot.set(CellTime::from_secs(600), |state| state.motors_on = false);
        let loaded = robot.settled(CellTime::from_secs(600)).overload_rates()[1];
        let faded = robot.settled(CellTime::from_secs(1800)).overload_rates()[1];
        assert!(loaded > 0.05 && faded < loaded / 100.0, "{loaded}, {faded}");
        assert_eq!(robot.torques(CellTime::from_secs(601)), [0.0; 6]);
        assert_eq!(robot.settled(CellTime::from_secs(1800)).motors_on_nanos, 600_000_000_000);
    }

    #[test]
    fn the_past_is_bounded() {
        let mut robot = robot(RobotModel::Gx4A251S);
        for ms in 0..5000 {
            robot.set(CellTime::from_millis(ms), |state| state.step_id = ms as u32);
            robot.forget_before(CellTime::ZERO);
        }
        assert_eq!(robot.segments.len(), MAX_SEGMENTS);
        let left = robot.forget_before(CellTime::from_millis(4990));
        assert_eq!(left, CellTime::from_millis(4986));
        assert!(robot.segments.len() <= 20);
    }
}
