use super::super::kinematics::forward;
use super::*;

#[test]
fn the_program_starts_by_itself_and_the_robots_work() {
    let mut cell = cell(&BOTH);
    let first = cell.snapshot();
    assert_eq!(flags(&first), ["Auto", "Ready"]);
    assert!(first.robots.iter().all(|robot| !robot.motors_on && robot.at_home && !robot.power_high));
    assert!(!first.tasks[0].state.is_loaded() && first.tasks[3].state.is_loaded());
    let started = pass(&mut cell, 2_000);
    assert_eq!(flags(&started), ["Auto", "Running"]);
    assert_eq!((started.tasks[0].function, started.tasks[0].program), ("main", "Main.prg"));
    assert_eq!(started.tasks[1].function, "Robot1Cycle");
    let later = pass(&mut cell, 60_000);
    for (robot, before) in later.robots.iter().zip(&first.robots) {
        assert!(robot.motors_on && robot.power_high);
        assert_eq!(robot.motors_on_count, before.motors_on_count + 1);
        assert_eq!((robot.motors_on_time - before.motors_on_time).as_millis(), 60_000);
    }
    let SpelValue::UInt32(made) = later.variables[0] else { panic!("{:?}", later.variables) };
    assert!((10..60).contains(&made), "{made} parts a minute");
    assert_eq!(later.variables[2], SpelValue::UInt16(1 << 8 | 1 << 1), "Auto and Running, Ready being bit 0");
    assert!(matches!(&later.variables[3], SpelValue::String(recipe) if recipe == "Insert-1"));
}

#[test]
fn everything_that_should_move_moves_and_stays_within_its_range() {
    let mut cell = cell(&BOTH);
    let mut seen: Vec<CellSnapshot> = Vec::new();
    for _ in 0..3000 {
        seen.push(pass(&mut cell, 20));
    }
    let varies = |what: &str, of: &dyn Fn(&CellSnapshot) -> f64, min: f64, max: f64| {
        let values: Vec<f64> = seen.iter().map(of).collect();
        let (least, most) = values.iter().fold((f64::MAX, f64::MIN), |(a, b), v| (a.min(*v), b.max(*v)));
        assert!(least < most && least >= min && most <= max, "{what}: {least} to {most}");
    };
    for (robot, model) in BOTH.into_iter().enumerate() {
        for (axis, limits) in model.axes().iter().enumerate() {
            let name = format!("{model} J{}", axis + 1);
            if !(model == RobotModel::C4A601S && axis == 3) {
                varies(&name, &|s| s.robots[robot].axes[axis].position, limits.min, limits.max);
                varies(&name, &|s| s.robots[robot].axes[axis].speed, -limits.max_speed, limits.max_speed);
            }
            varies(&name, &|s| s.robots[robot].axes[axis].torque.abs(), 0.0, 300.0);
            varies(&name, &|s| s.robots[robot].axes[axis].overload_rate, 0.0, 1.5);
            for part in Part::OF_AXIS {
                if seen[0].robots[robot].axes[axis].part(part).available {
                    varies(part.name(), &|s| s.robots[robot].axes[axis].part(part).consumption_rate, 1.0, 90.0);
                }
            }
        }
        varies("home", &|s| f64::from(u8::from(s.robots[robot].at_home)), 0.0, 1.0);
    }
    varies("temperature", &|s| s.controller.temperature, 20.0, 60.0);
    varies("CPU load", &|s| s.controller.cpu_load, 1.0, 60.0);
    for (index, port) in io_ports(cell.description().controller.generation()).iter().enumerate() {
        varies(&format!("{port:?}"), &|s| s.io.bytes(index).iter().map(|byte| f64::from(*byte)).sum(), 0.0, 1e4);
    }
    // Each standard signal of the program was on at some time.
    for (port, bits) in [(0, 8..10), (0, 12..14), (1, 9..11), (1, 13..15)] {
        for bit in bits {
            assert!(seen.iter().any(|s| s.io.bit(port, bit)) && seen.iter().any(|s| !s.io.bit(port, bit)), "{bit}");
        }
    }
}

#[test]
fn positions_of_joints_and_tool_agree_exactly() {
    let mut cell = cell(&BOTH);
    for _ in 0..2000 {
        let snapshot = pass(&mut cell, 13);
        for (robot, model) in snapshot.robots.iter().zip(BOTH) {
            let mut joints = [0.0; 6];
            for (joint, axis) in joints.iter_mut().zip(&robot.axes) {
                *joint = axis.position;
            }
            assert_eq!(forward(model, &joints), robot.actual);
            let apart = robot.actual.to_array().into_iter().zip(robot.target.to_array()).take(3);
            let apart = apart.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 10.0, "{apart} mm behind");
        }
    }
}

#[test]
fn the_speed_is_that_of_the_position() {
    let mut cell = cell(&[RobotModel::C4A601S]);
    let mut before = pass(&mut cell, 2_500);
    for _ in 0..20_000 {
        let now = pass(&mut cell, 1);
        for (axis, (a, b)) in before.robots[0].axes.iter().zip(&now.robots[0].axes).enumerate() {
            let moved = (b.position - a.position) * 1000.0;
            let speed = (a.speed + b.speed) / 2.0;
            assert!((moved - speed).abs() < 2.5, "J{}: {moved} at {speed} degrees a second", axis + 1);
        }
        before = now;
    }
}

/// The same seed and clock give the same values, however time is cut into steps and whoever looks.
#[test]
fn values_do_not_depend_on_the_steps_of_time() {
    let run = |steps: &[u64]| {
        let mut cell = cell(&BOTH);
        cell.write(Setting::ForcePort(true)).unwrap();
        let mut steps = steps.iter().cycle();
        let mut now = 0;
        let mut shown = Vec::new();
        for stop in [700, 2_345, 9_999, 31_000, 61_001] {
            while now < stop {
                now = (now + steps.next().unwrap()).min(stop);
                cell.advance_to(CellTime::from_nanos(now * 1_000_000 + 123));
                if now % 7 == 0 {
                    cell.snapshot();
                }
            }
            shown.push(cell.snapshot());
        }
        let force = std::iter::from_fn(|| cell.read_force_data(1, 100_000)).collect::<Vec<_>>();
        let motion = std::iter::from_fn(|| cell.read_motion_log(100_000)).collect::<Vec<_>>();
        (shown, force, motion)
    };
    let whole = run(&[1_000_000]);
    assert!(whole.1.len() > 1 && whole.2.len() > 3, "there is something to compare");
    for steps in [&[1][..], &[13, 1, 5000], &[999]] {
        assert!(run(steps) == whole, "{steps:?}");
    }
    let other = {
        let mut cell = Cell::new(config(&BOTH, 8));
        pass(&mut cell, 61_001)
    };
    assert_ne!(whole.0.last(), Some(&other), "another seed is another cell");
}

#[test]
fn parts_that_a_robot_lacks_are_not_available() {
    let mut cell = cell(&BOTH);
    let snapshot = pass(&mut cell, 5000);
    let shaft = snapshot.robots[1].axes[2];
    assert_eq!(shaft.part(Part::Gear), ConsumableValues::NONE);
    assert!(shaft.part(Part::BallScrewSpline).available && snapshot.controller.battery.available);
    assert_eq!(ConsumableValues::NONE.months_remaining, -1.0);
    assert_eq!(snapshot.robots[0].axes[3].part(Part::Battery), snapshot.robots[0].battery);
}

#[test]
fn a_cell_has_one_to_four_robots_and_legacy_firmware_has_no_motion_log() {
    assert_eq!(cell(&[]).description().robots.len(), 1);
    let mut many = cell(&[RobotModel::Gx4A251S; 9]);
    assert_eq!(many.description().robots.len(), MAX_ROBOTS);
    assert_eq!(pass(&mut many, 30_000).tasks.len(), MAX_ROBOTS + 2);
    let firmware = FirmwareVersion::new(7, 5, 58);
    let mut legacy = Cell::new(CellConfig { series: ControllerSeries::Rc700, firmware, ..config(&BOTH, 1) });
    pass(&mut legacy, 30_000);
    assert_eq!(legacy.read_motion_log(100_000), None);
    assert_eq!(legacy.write(Setting::MotionDataNum(1)), Err(SettingRefusal::NotWritable));
    assert_eq!(legacy.snapshot().motion_log.channel, ChannelValues::default());
}

#[test]
fn a_handle_follows_its_clock_and_a_snapshot_is_one_moment() {
    let clock = CellClock::manual();
    let handle = CellHandle::new(cell(&BOTH), clock.clone());
    let first = handle.snapshot();
    assert!(std::sync::Arc::ptr_eq(&first, &handle.snapshot()));
    clock.advance(std::time::Duration::from_millis(4000));
    let later = handle.snapshot();
    assert_eq!((first.time, later.time), (at(0), at(4000)));
    assert_eq!((later.clock - first.clock).num_milliseconds(), 4000);
    handle.command(CellCommand::Pause).unwrap();
    assert_eq!(flags(&handle.snapshot()), ["Auto", "Paused"]);
    let declared = vec![SpelDeclaration::scalar("OPCUA_New", SpelType::Byte)];
    handle.declare_variables(declared.clone());
    assert_eq!(*handle.description().variables, declared);
    assert_eq!(*handle.snapshot().variables, [SpelValue::Int8(0)]);
}
