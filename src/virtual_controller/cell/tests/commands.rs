use super::*;

fn refused(cell: &mut Cell, command: CellCommand) -> CommandRefusal {
    let before = cell.snapshot();
    let refusal = cell.command(command).unwrap_err();
    assert_eq!(cell.snapshot(), before, "a refused command changes nothing");
    refusal
}

fn motors(snapshot: &CellSnapshot) -> Vec<bool> {
    snapshot.robots.iter().map(|robot| robot.motors_on).collect()
}

fn is_at_rest(snapshot: &CellSnapshot) -> bool {
    snapshot.robots.iter().flat_map(|robot| &robot.axes).all(|axis| axis.speed == 0.0)
}

/// Somewhere in the middle of a cycle, with a robot in motion.
fn in_motion() -> Cell {
    let mut cell = cell(&BOTH);
    pass(&mut cell, 15_000);
    until(&mut cell, |s| s.robots[0].axes[0].speed.abs() > 50.0);
    cell
}

#[test]
fn commands_are_accepted_by_the_conditions_of_the_remote_commands() {
    let mut cell = cell(&BOTH);
    pass(&mut cell, 3_000);
    // Running.
    for command in [
        CellCommand::Start { function: 0 },
        CellCommand::Reset,
        CellCommand::MotorsOn(RobotChoice::All),
        CellCommand::MotorsOff(RobotChoice::One(1)),
        CellCommand::Home(1),
        CellCommand::SetBit { port: 1, offset: 9, on: true },
    ] {
        assert_eq!(refused(&mut cell, command), CommandRefusal::NotReady);
    }
    assert_eq!(refused(&mut cell, CellCommand::Continue), CommandRefusal::NotPaused);
    cell.command(CellCommand::Stop).unwrap();
    pass(&mut cell, 2_000);
    // Ready.
    assert_eq!(refused(&mut cell, CellCommand::Pause), CommandRefusal::NotRunning);
    assert_eq!(refused(&mut cell, CellCommand::Start { function: 2 }), CommandRefusal::UnknownFunction);
    assert_eq!(refused(&mut cell, CellCommand::Home(3)), CommandRefusal::UnknownRobot);
    assert_eq!(refused(&mut cell, CellCommand::MotorsOn(RobotChoice::One(0))), CommandRefusal::UnknownRobot);
    assert_eq!(refused(&mut cell, CellCommand::SpeedFactor(0)), CommandRefusal::OutOfRange);
    assert_eq!(refused(&mut cell, CellCommand::RaiseError(10_000)), CommandRefusal::OutOfRange);
    assert_eq!(refused(&mut cell, CellCommand::SetByte { port: 0, offset: 3, value: 1 }), CommandRefusal::UnknownPort);
    assert_eq!(refused(&mut cell, CellCommand::SetBit { port: 99, offset: 0, on: true }), CommandRefusal::UnknownPort);
    assert_eq!(refused(&mut cell, CellCommand::StepOn), CommandRefusal::NotStepping);
    cell.command(CellCommand::SetBit { port: 1, offset: 9, on: true }).unwrap();
    assert!(cell.snapshot().io.bit(1, 9) && cell.snapshot().io.bit(1, 0), "the signal, and Ready");
    cell.command(CellCommand::MotorsOff(RobotChoice::One(2))).unwrap();
    assert_eq!(motors(&cell.snapshot()), [true, false]);
    cell.command(CellCommand::MotorsOn(RobotChoice::All)).unwrap();
    let on = cell.snapshot();
    assert_eq!((motors(&on), on.robots[1].power_high), (vec![true, true], false));
    // Not Auto.
    cell.command(CellCommand::Mode(OperatingMode::Teach)).unwrap();
    for command in [
        CellCommand::Start { function: 0 },
        CellCommand::Stop,
        CellCommand::Pause,
        CellCommand::Continue,
        CellCommand::Reset,
        CellCommand::MotorsOn(RobotChoice::All),
        CellCommand::Home(1),
    ] {
        assert_eq!(refused(&mut cell, command), CommandRefusal::NotAuto);
    }
    let teach = cell.snapshot();
    assert_eq!((flags(&teach), teach.safety.mode.operational_mode()), (vec!["Teach", "Ready"], 1));
}

#[test]
fn pause_slows_down_and_continue_brings_the_cycle_to_its_end() {
    let mut cell = in_motion();
    let mut undisturbed = in_motion();
    cell.command(CellCommand::Pause).unwrap();
    assert_eq!(flags(&cell.snapshot()), ["Auto", "Paused"]);
    let at_rest = until(&mut cell, is_at_rest);
    assert!(motors(&at_rest).iter().all(|on| *on));
    let long_after = pass(&mut cell, 30_000);
    assert_eq!(long_after.robots[0].actual, at_rest.robots[0].actual);
    assert_eq!(long_after.tasks[1].state, TaskState::Paused);
    assert!(long_after.tasks[1].state.is_loaded());
    cell.command(CellCommand::Continue).unwrap();
    assert_eq!(flags(&cell.snapshot()), ["Auto", "Running"]);
    let made = |snapshot: &CellSnapshot| snapshot.variables[0].clone();
    let before = made(&cell.snapshot());
    until(&mut cell, |s| made(s) != before);
    // The same places are reached as without the pause.
    let home =
        |cell: &mut Cell| until(cell, |s| s.robots[0].at_home && s.robots[0].axes[0].speed == 0.0).robots[0].actual;
    assert_eq!(home(&mut cell), home(&mut undisturbed));
}

#[test]
fn the_safeguard_pauses_takes_the_motors_and_has_to_be_closed() {
    let mut cell = in_motion();
    cell.command(CellCommand::SafetyDoor { open: true }).unwrap();
    let open = cell.snapshot();
    assert!(open.safety.protective_stop && !open.safety.emergency_stop);
    assert_eq!(flags(&open), ["Auto", "Safeguard", "Paused"]);
    let stopped = until(&mut cell, |s| motors(s) == [false, false]);
    assert!(is_at_rest(&stopped) || pass(&mut cell, 10).robots[0].axes[0].speed == 0.0);
    assert_eq!(refused(&mut cell, CellCommand::Continue), CommandRefusal::SafeguardOpen);
    cell.command(CellCommand::SafetyDoor { open: false }).unwrap();
    assert_eq!(flags(&pass(&mut cell, 1000)), ["Auto", "Paused"]);
    cell.command(CellCommand::Continue).unwrap();
    until(&mut cell, |s| s.robots[0].axes[0].speed.abs() > 50.0 && motors(s) == [true, true]);
    // Closed before the start: a start with the door open is refused.
    cell.command(CellCommand::Stop).unwrap();
    cell.command(CellCommand::SafetyDoor { open: true }).unwrap();
    assert_eq!(refused(&mut cell, CellCommand::Start { function: 0 }), CommandRefusal::SafeguardOpen);
    assert_eq!(refused(&mut cell, CellCommand::MotorsOn(RobotChoice::All)), CommandRefusal::SafeguardOpen);
}

#[test]
fn an_emergency_stop_lasts_until_the_switch_is_released_and_reset() {
    let mut cell = in_motion();
    cell.command(CellCommand::EmergencyStop(true)).unwrap();
    assert_eq!(flags(&cell.snapshot()), ["Auto", "EStop", "Ready"]);
    let hard = cell.now();
    let stopped = until(&mut cell, |s| motors(s) == [false, false]);
    assert!(stopped.time.nanos_since(hard) < 200_000_000, "within 0.2 s");
    assert!(stopped.io.bit(1, 4) && stopped.safety.emergency_stop);
    assert_eq!(refused(&mut cell, CellCommand::Start { function: 0 }), CommandRefusal::EmergencyStop);
    assert_eq!(refused(&mut cell, CellCommand::Reset), CommandRefusal::EmergencyStop);
    cell.command(CellCommand::EmergencyStop(false)).unwrap();
    assert!(cell.snapshot().safety.emergency_stop, "until Reset");
    cell.command(CellCommand::Reset).unwrap();
    assert_eq!(flags(&cell.snapshot()), ["Auto", "Ready"]);
    cell.command(CellCommand::Start { function: 1 }).unwrap();
    let home = until(&mut cell, |s| flags(s) == ["Auto", "Ready"]);
    assert!(pass(&mut cell, 10).robots.iter().all(|robot| robot.at_home), "{home:?}");
}

#[test]
fn an_error_stops_the_tasks_and_shows_its_number_until_reset() {
    let mut cell = in_motion();
    cell.command(CellCommand::RaiseWarning(517)).unwrap();
    let warned = pass(&mut cell, 500);
    assert_eq!((flags(&warned), warned.controller.status_code), (vec!["Auto", "Warning", "Running"], 517));
    cell.command(CellCommand::RaiseError(5040)).unwrap();
    let failed = pass(&mut cell, 500);
    assert_eq!(flags(&failed), ["Auto", "Warning", "Error", "Ready"]);
    assert_eq!((failed.controller.status_code, motors(&failed)), (5040, vec![false, false]));
    assert_eq!(failed.tasks[1].state, TaskState::Error);
    assert!(failed.tasks[3].state.is_loaded(), "the background task runs on");
    assert_eq!(refused(&mut cell, CellCommand::Start { function: 0 }), CommandRefusal::InError);
    assert_eq!(refused(&mut cell, CellCommand::MotorsOn(RobotChoice::All)), CommandRefusal::InError);
    cell.command(CellCommand::Reset).unwrap();
    assert_eq!((flags(&cell.snapshot()), cell.snapshot().controller.status_code), (vec!["Auto", "Ready"], 0));
    cell.command(CellCommand::Start { function: 0 }).unwrap();
    until(&mut cell, |s| s.robots[0].axes[0].speed.abs() > 50.0);
}

#[test]
fn in_step_mode_each_statement_waits_for_the_next_step() {
    let mut cell = cell(&[RobotModel::C4A601S]);
    cell.command(CellCommand::StepMode(true)).unwrap();
    let halted = pass(&mut cell, 5_000);
    assert_eq!((halted.tasks[0].state, halted.tasks[0].execution), (TaskState::Halted, ExecutionMode::Step));
    assert_eq!(halted.tasks[2].execution, ExecutionMode::Cycle, "background tasks are not stepped");
    assert_eq!(flags(&halted), ["Auto", "Running"]);
    let mut moved = 0;
    for _ in 0..12 {
        let before = cell.snapshot().robots[0].target;
        cell.command(CellCommand::StepOn).unwrap();
        let after = pass(&mut cell, 10_000);
        assert!(after.tasks.iter().take(2).all(|task| task.state == TaskState::Halted), "{:?}", after.tasks);
        moved += usize::from(after.robots[0].target != before);
        assert_eq!(pass(&mut cell, 10_000).robots[0].target, after.robots[0].target);
    }
    assert!((2..12).contains(&moved), "{moved} motions");
    cell.command(CellCommand::StepMode(false)).unwrap();
    let running = pass(&mut cell, 100);
    assert_eq!(running.tasks[0].execution, ExecutionMode::Cycle);
    until(&mut cell, |s| s.robots[0].axes[0].speed.abs() > 50.0);
}

#[test]
fn power_and_speed_factor_limit_the_speed() {
    let fastest = |command: Option<CellCommand>| {
        let mut cell = cell(&[RobotModel::Gx4A251S]);
        pass(&mut cell, 2_000);
        if let Some(command) = command {
            cell.command(command).unwrap();
        }
        // The motion in progress keeps its speed.
        pass(&mut cell, 2_000);
        let speeds = (0..4000).map(|_| pass(&mut cell, 5).robots[0].axes[0].speed.abs());
        (speeds.fold(0.0, f64::max), cell.snapshot())
    };
    let (full, _) = fastest(None);
    let (half, shown) = fastest(Some(CellCommand::SpeedFactor(50)));
    assert_eq!(shown.robots[0].speed_override, 50.0);
    assert!(half < full * 0.75, "{half} of {full}");
    let (low, shown) = fastest(Some(CellCommand::Power { robots: RobotChoice::All, high: false }));
    assert!(low < full * 0.4 && !shown.robots[0].power_high, "{low} of {full}");
}

#[test]
fn leaving_auto_pauses_and_coming_back_allows_to_continue() {
    let mut cell = in_motion();
    cell.command(CellCommand::Mode(OperatingMode::Test)).unwrap();
    let test = until(&mut cell, |s| motors(s) == [false, false]);
    assert_eq!((flags(&test), test.safety.mode.operational_mode()), (vec!["Test", "Paused"], 2));
    // The door is open in manual operation; nothing more happens.
    cell.command(CellCommand::SafetyDoor { open: true }).unwrap();
    cell.command(CellCommand::SafetyDoor { open: false }).unwrap();
    cell.command(CellCommand::Mode(OperatingMode::Auto)).unwrap();
    cell.command(CellCommand::Continue).unwrap();
    until(&mut cell, |s| s.robots[0].axes[0].speed.abs() > 50.0);
}

#[test]
fn inputs_are_written_by_the_plant_and_by_clients_of_virtual_io_only() {
    let mut usual = cell(&BOTH);
    let input = Setting::InputBit { port: 0, offset: 20, on: true };
    assert_eq!(usual.write(input.clone()), Err(SettingRefusal::NotWritable));
    usual.command(CellCommand::SetBit { port: 0, offset: 20, on: true }).unwrap();
    assert!(usual.snapshot().io.bit(0, 20));
    let mut config = config(&BOTH, 7);
    config.options.virtual_io = true;
    let mut open = Cell::new(config);
    open.write(input).unwrap();
    open.write(Setting::InputByte { port: 2, offset: 1, value: 0x5A }).unwrap();
    assert!(open.snapshot().io.bit(0, 20) && open.snapshot().io.byte(2, 1) == 0x5A);
    for wrong in [
        Setting::InputBit { port: 1, offset: 0, on: true },
        Setting::InputBit { port: 0, offset: 24, on: true },
        Setting::InputByte { port: 99, offset: 0, value: 1 },
    ] {
        assert_eq!(open.write(wrong), Err(SettingRefusal::NotWritable));
    }
}
