//! The snapshot of a cell.

use std::sync::Arc;
use std::time::Duration;

use super::kinematics::forward;
use super::noise;
use super::robot::ROOM_TEMPERATURE;
use super::robot_unit::RobotUnit;
use super::simulation::Cell;
use super::snapshot::{
    AxisValues, CellSnapshot, ConsumableValues, ControllerValues, ForceSensorValues, MotionLogValues, RobotValues,
    SafetyValues, TaskValues,
};
use super::status::{ExecutionMode, RecordingStatus, TaskKind};

impl Cell {
    /// The value of every node now.
    pub fn snapshot(&mut self) -> CellSnapshot {
        let now = self.now;
        let monitors = [0, 1].map(|monitor: usize| self.monitors[monitor].values(now));
        let channel = self.motion.as_ref().map(|motion| motion.values(now)).unwrap_or_default();
        let recordings = monitors.iter().filter(|monitor| monitor.recording == RecordingStatus::Run).count();
        let variables = self.variables.values();
        let settings = &self.settings;
        CellSnapshot {
            time: now,
            clock: self.clock(now),
            controller: self.controller_values(recordings),
            robots: self.robots.iter().map(|unit| self.robot_values(unit)).collect(),
            tasks: self.task_values(),
            safety: SafetyValues {
                mode: self.safety.mode,
                emergency_stop: self.safety.emergency_stop,
                protective_stop: self.safety.door_open,
            },
            io: self.io.clone(),
            variables,
            force_sensor: ForceSensorValues {
                port: settings.force_port,
                option: Arc::clone(&settings.force_option),
                data_type: settings.force_data_type,
                data_num: settings.force_data_num,
                monitors,
            },
            motion_log: MotionLogValues {
                data_type: settings.motion_data_type,
                data_num: settings.motion_data_num,
                sampling_interval: settings.motion_interval,
                channel,
            },
        }
    }

    fn controller_values(&self, recordings: usize) -> ControllerValues {
        let now = self.now;
        let secs = now.secs();
        let encoders = self.robots.iter().map(|unit| {
            let axes = unit.robot.model().axes().len();
            unit.robot.settled(now).temperature[..axes].iter().sum::<f64>() / axes as f64
        });
        let robots = encoders.sum::<f64>() / self.robots.len() as f64 - ROOM_TEMPERATURE;
        // The cabinet warms up in forty minutes, and with what the drives give off.
        let temperature = ROOM_TEMPERATURE + 11.0 * (1.0 - (-secs / 2400.0).exp()) + 0.2 * robots;
        let tasks = self.tasks.iter().filter(|task| task.is_loaded() && !task.is_paused()).count();
        let moving = self.robots.iter().filter(|unit| unit.robot.moves(now)).count();
        let jitter = noise::unit(noise::branch(self.seed, 4), secs as u64);
        let cpu_load = 6.0 + 4.0 * tasks as f64 + 5.0 * moving as f64 + 3.0 * recordings as f64 + 4.0 * jitter;
        ControllerValues {
            total_power_on: self.power_on_before + now.since_start(),
            started: self.started,
            temperature,
            cpu_load: cpu_load.min(100.0),
            flags: self.flags(),
            status_code: self.status_code(),
            battery: self.battery.values(self.clock(now), 0.0),
        }
    }

    fn robot_values(&self, unit: &RobotUnit) -> RobotValues {
        let now = self.now;
        let (robot, state) = (&unit.robot, unit.robot.state());
        let model = robot.model();
        // Without motors the motion control wants the robot where it is.
        let actual = robot.actual(now);
        let wanted = if state.motors_on { robot.command(now).position } else { actual.position };
        let settled = robot.settled(now);
        let (overload, torques) = (settled.overload_rates(), robot.torques(now));
        let (clock, hours) = (self.clock(now), unit.running_hours(now));
        let axes = model.axes().iter().enumerate().map(|(axis, _)| AxisValues {
            position: actual.position[axis],
            speed: actual.speed[axis],
            acceleration: actual.acceleration[axis],
            torque: torques[axis],
            overload_rate: overload[axis],
            home_offset: unit.home_offsets[axis],
            parts: unit.parts[axis].map(|part| part.map_or(ConsumableValues::NONE, |wear| wear.values(clock, hours))),
        });
        RobotValues {
            motors_on: state.motors_on,
            power_high: state.motors_on && state.power_high,
            at_home: self.is_at_home(unit),
            speed_override: unit.speed_factor.into(),
            target: forward(model, &wanted),
            actual: forward(model, &actual.position),
            motors_on_time: Duration::from_nanos(settled.motors_on_nanos),
            motors_on_count: settled.motors_on_count,
            battery: unit.battery.values(clock, hours),
            axes: axes.collect(),
        }
    }

    fn is_at_home(&self, unit: &RobotUnit) -> bool {
        let actual = unit.robot.actual(self.now).position;
        let axes = unit.robot.model().axes().iter().zip(unit.home.iter().zip(actual));
        // Within two pulses of every encoder.
        axes.into_iter().all(|(axis, (home, actual))| (home - actual).abs() * axis.pulses_per_unit < 2.0)
    }

    fn task_values(&self) -> Vec<TaskValues> {
        let values = |(task, about): (&super::task::Task, &super::snapshot::TaskDescription)| {
            let (function, program) = task.names();
            let is_stepped = self.step_mode && about.kind == TaskKind::Normal;
            TaskValues {
                function,
                program,
                execution: if is_stepped { ExecutionMode::Step } else { ExecutionMode::Cycle },
                state: task.state(self.now),
            }
        };
        self.tasks.iter().zip(&self.description.tasks).map(values).collect()
    }
}
