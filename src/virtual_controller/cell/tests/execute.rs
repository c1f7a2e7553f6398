use super::*;

/// A cell whose program does not run, at a moment when it has come to rest.
fn ready(robots: &[RobotModel]) -> Cell {
    let mut config = config(robots, 7);
    config
        .variables
        .push(SpelDeclaration { bounds: vec![10, 1], ..SpelDeclaration::scalar("g_List", SpelType::Integer) });
    config.variables.push(SpelDeclaration::scalar("g_Name$", SpelType::String));
    let mut cell = Cell::new(config);
    cell.command(CellCommand::Stop).unwrap();
    pass(&mut cell, 100);
    cell
}

/// Runs a text to its end; at most a minute.
fn execute(cell: &mut Cell, text: &str) -> Result<String, SpelError> {
    let number = cell.execute_text(text).unwrap_or_else(|refusal| panic!("{text}: {refusal}"));
    for _ in 0..60_000 {
        if let Some(result) = cell.immediate_result(number) {
            return result.clone();
        }
        pass(cell, 1);
    }
    panic!("{text} did not end");
}

fn printed(cell: &mut Cell, text: &str) -> String {
    execute(cell, text).unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn failed(cell: &mut Cell, text: &str) -> SpelError {
    let before = cell.snapshot();
    let error = execute(cell, text).unwrap_err();
    assert_eq!(cell.snapshot(), before, "{text} changed something");
    assert_eq!(printed(cell, "Print Err"), error.number().to_string());
    error
}

#[test]
fn values_are_printed() {
    let mut cell = ready(&[RobotModel::C4A601S]);
    for (text, result) in [
        ("print 1, -2.5, &HFF", "1 -2.5 255"),
        ("Print \"a\" + \"b\"", "ab"),
        ("print 1 + 2 * 3 - (4 - 6) / 2", "8"),
        ("print 7 / 2", "3.5"),
        ("print 10000000000 * 3", "30000000000"),
        ("print 1; print \"mark", "1 mark"),
        ("print Err", "0"),
        ("Print ErrMsg$(7007, 0)", "Point not defined."),
        ("print ErrMsg$(9999)", ""),
        ("print Robot, Motor, Power, Speed, SpeedFactor", "1 0 0 5 100"),
        ("Speed 50", ""),
        ("print speed", "50"),
        ("SpeedFactor 80; print SpeedFactor", "80"),
    ] {
        assert_eq!(printed(&mut cell, text), result, "{text}");
    }
}

#[test]
fn outputs_and_memory_are_set_and_read() {
    let mut cell = ready(&[RobotModel::C4A601S]);
    printed(&mut cell, "On 9; On 10; Off 9; MemOn 1000; MemOut 2, &H81");
    cell.command(CellCommand::SetByte { port: 0, offset: 2, value: 0x18 }).unwrap();
    assert_eq!(printed(&mut cell, "print oport(9), Oport(10), MemSw(1000), MemIn(2), MemInW(1)"), "0 1 1 129 129");
    assert_eq!(printed(&mut cell, "print sw(19), sw(16), in(2), inw(1)"), "1 0 24 24");
    printed(&mut cell, "Out 9, 85");
    assert_eq!(printed(&mut cell, "print out(9), oport(72), oport(73), outw(4)"), "85 1 0 21760");
    let io = cell.snapshot().io;
    assert!(io.bit(1, 10) && io.byte(3, 1) == 85);
    for (text, error) in [
        ("On 16", SpelError::IoBit),
        ("On -1", SpelError::IoBit),
        ("Print In(3)", SpelError::IoByte),
        ("Print OutW(1)", SpelError::IoWord),
        ("MemOff 1024", SpelError::MemoryBit),
        ("MemOut 128, 1", SpelError::MemoryByte),
        ("print MemInW(64)", SpelError::MemoryWord),
        ("Out 0, 256", SpelError::OutOfRange),
    ] {
        assert_eq!(failed(&mut cell, text), error, "{text}");
    }
}

#[test]
fn variables_are_assigned_within_their_type() {
    let mut cell = ready(&[RobotModel::C4A601S]);
    printed(&mut cell, "g_List(3, 1) = 40 + 2; opcua_recipe = \"Insert\"; OPCUA_CycleSeconds = 1.25");
    assert_eq!(printed(&mut cell, "print g_list(3,1) * 2, OPCUA_Recipe, OPCUA_CycleSeconds"), "84 Insert 1.25");
    assert_eq!(cell.variable("g_List", Some(SpelType::Integer), &[3, 0], 2), Ok(&[0, 42].map(SpelValue::Int16)[..]));
    printed(&mut cell, "OPCUA_NumOfProduced = 2.6");
    assert_eq!(cell.snapshot().variables[0], SpelValue::UInt32(3));
    for (text, error) in [
        ("g_Missing = 1", SpelError::UnknownVariable),
        ("print g_Missing", SpelError::UnknownVariable),
        ("g_List = 1", SpelError::Element),
        ("g_List(11, 0) = 1", SpelError::Element),
        ("print g_List(-1, 0)", SpelError::Element),
        ("g_List(0, 0) = 32768", SpelError::OutOfRange),
        ("OPCUA_NumOfProduced = -1", SpelError::OutOfRange),
        ("OPCUA_Recipe = 5", SpelError::WrongType),
        ("g_List(0, 0) = \"5\"", SpelError::WrongType),
        ("print 1 / 0", SpelError::DivisionByZero),
        ("print 1 + \"a\"", SpelError::WrongType),
        ("Speed 101", SpelError::OutOfRange),
        ("Speed P1", SpelError::WrongType),
    ] {
        assert_eq!(failed(&mut cell, text), error, "{text}");
    }
}

#[test]
fn the_robot_goes_to_points_with_its_motors_on() {
    let mut cell = ready(&BOTH);
    assert_eq!(failed(&mut cell, "Go P1"), SpelError::MotorsOff);
    printed(&mut cell, "Motor On; Power High; Speed 100");
    let before = cell.now();
    printed(&mut cell, "Go P1");
    assert!(cell.now() > before, "a motion takes time");
    pass(&mut cell, 10);
    let target = |cell: &mut Cell| cell.snapshot().robots[0].target.to_array();
    let at = target(&mut cell);
    printed(&mut cell, "Go Here +Z(-20) :X(-140.0)");
    let moved = target(&mut cell);
    assert!((moved[2] - at[2] + 20.0).abs() < 1e-6 && (moved[0] + 140.0).abs() < 1e-6, "{moved:?}");
    assert!((moved[1] - at[1]).abs() < 1e-6);
    printed(&mut cell, "Home");
    pass(&mut cell, 10);
    assert!(cell.snapshot().robots[0].at_home);
    for (text, error) in [
        ("Go P5", SpelError::UndefinedPoint),
        ("Go P1000", SpelError::PointNumber),
        ("Go P(0 - 1)", SpelError::PointNumber),
        ("Go XY(2000, 0, 0, 0)", SpelError::OutOfReach),
        ("Go P1 +X(1e6)", SpelError::OutOfRange),
        ("Jump P1", SpelError::UnsupportedMotion),
        ("Robot 3", SpelError::UnknownRobot),
    ] {
        assert_eq!(failed(&mut cell, text), error, "{text}");
    }
    assert_eq!(flags(&cell.snapshot()), ["Auto", "Ready"], "Execute is no task");
}

#[test]
fn a_scara_jumps_over_the_top_of_its_range() {
    let mut cell = ready(&BOTH);
    printed(&mut cell, "Robot 2; Motor On; Power High; Speed 100; Go P2");
    assert_eq!((cell.current_robot(), printed(&mut cell, "print robot")), (2, "2".to_owned()));
    let number = cell.execute_text("Jump P4").unwrap();
    let top = until(&mut cell, |s| s.robots[1].target.z > -0.001);
    assert_eq!(top.robots[0].target, cell.snapshot().robots[0].target);
    let down =
        until(&mut cell, |s| s.robots[1].axes.iter().all(|axis| axis.speed == 0.0) && s.robots[1].target.z < -50.0);
    assert!((down.robots[1].target.z + 105.0).abs() < 10.0);
    pass(&mut cell, 20);
    assert_eq!(cell.immediate_result(number), Some(&Ok(String::new())));
}

/// The format of a real controller's answer: ` X: -182.632 Y:  240.114 Z:  -20.002 U:  -36.156 V:    0.000 W:    0.000 /R /0`.
#[test]
fn positions_are_printed_in_the_vendors_format() {
    let mut cell = ready(&BOTH);
    printed(&mut cell, "Robot 2; Motor On");
    let here = printed(&mut cell, "print realpos");
    let fields: Vec<&str> = here.split(':').collect();
    assert!(here.starts_with(" X:") && here.ends_with(" V:    0.000 W:    0.000 /R /0"), "{here:?}");
    assert_eq!(here.len(), " X: -182.632 Y:  240.114 Z:  -20.002 U:  -36.156 V:    0.000 W:    0.000 /R /0".len());
    assert_eq!(fields.len(), 7);
    let pose = cell.snapshot().robots[1].actual;
    assert!((fields[1][..9].trim().parse::<f64>().unwrap() - pose.x).abs() < 0.001);
    assert_eq!(printed(&mut cell, "print Here"), here);
    assert!(
        printed(&mut cell, "print XY(150, 100, -20, 0)")
            .starts_with(" X:  150.000 Y:  100.000 Z:  -20.000 U:    0.000")
    );
    let lines = printed(&mut cell, "where");
    let (world, rest) = lines.split_once(" JOINT:").unwrap();
    let (joints, pulses) = rest.split_once(" PULSE:").unwrap();
    assert!(world.starts_with("WORLD: X: ") && world.contains(" mm U: "), "{lines:?}");
    assert!(joints.starts_with(" 1:    60.000 deg 2:    60.000 deg 3:     0.000 mm 4: "), "{lines:?}");
    assert!(pulses.starts_with(" 1: ") && pulses.ends_with(" pls"), "{lines:?}");
    printed(&mut cell, "Robot 1");
    assert!(printed(&mut cell, "print P0").ends_with(" /R /A /NF /0"));
}

#[test]
fn a_text_is_understood_whole_before_it_is_run() {
    let mut cell = ready(&[RobotModel::C4A601S]);
    assert_eq!(failed(&mut cell, "On 9; Dance 3"), SpelError::Unsupported("Dance 3".to_owned()));
    assert_eq!(failed(&mut cell, &format!("Print \"{}\"", "x".repeat(300))), SpelError::TextTooLong);
    let long = SpelValue::String("x".repeat(255));
    let set = CellCommand::SetVariable { name: "g_Name$".to_owned(), kind: None, element: vec![], value: long };
    cell.command(set).unwrap();
    let much = format!("Print {}g_Name$", "g_Name$,".repeat(16));
    assert_eq!(failed(&mut cell, &much), SpelError::ResultTooLong);
    // What ran before an error has happened.
    assert_eq!(execute(&mut cell, "On 9; Go P1"), Err(SpelError::MotorsOff));
    assert!(cell.snapshot().io.bit(1, 9));
}

#[test]
fn while_it_runs_only_abort_and_outputs_are_accepted() {
    let mut cell = ready(&[RobotModel::C4A601S]);
    printed(&mut cell, "Motor On");
    let number = cell.execute_text("Go P1; On 9").unwrap();
    pass(&mut cell, 50);
    assert!(cell.is_executing());
    let set = CellCommand::SetVariable {
        name: "OPCUA_Recipe".to_owned(),
        kind: None,
        element: vec![],
        value: SpelValue::String(String::new()),
    };
    for command in [
        CellCommand::Start { function: 0 },
        CellCommand::Stop,
        CellCommand::Pause,
        CellCommand::Continue,
        CellCommand::Reset,
        CellCommand::MotorsOn(RobotChoice::All),
        CellCommand::MotorsOff(RobotChoice::All),
        CellCommand::Home(1),
        CellCommand::CurrentRobot(1),
        CellCommand::ResetAlarm(1),
        set,
    ] {
        assert_eq!(cell.command(command), Err(CommandRefusal::ExecuteRunning));
    }
    assert_eq!(cell.execute_text("print 1"), Err(CommandRefusal::ExecuteRunning));
    cell.command(CellCommand::SetBit { port: 1, offset: 10, on: true }).unwrap();
    cell.command(CellCommand::SetByte { port: 3, offset: 0, value: 7 }).unwrap();
    cell.command(CellCommand::SetWord { port: 10, offset: 3, value: 0x1234 }).unwrap();
    assert_eq!(cell.snapshot().io.word(10, 3), 0x1234);
    cell.command(CellCommand::Abort).unwrap();
    assert_eq!(cell.immediate_result(number), Some(&Err(SpelError::Aborted)));
    until(&mut cell, |s| s.robots[0].axes.iter().all(|axis| axis.speed == 0.0));
    assert!(!cell.snapshot().io.bit(1, 9), "what follows is not executed");
    cell.command(CellCommand::Abort).unwrap();
    // The robot comes to rest before the next motion begins.
    let number = cell.execute_text("Go P0").unwrap();
    cell.command(CellCommand::Abort).unwrap();
    printed(&mut cell, "Go P0");
    assert_eq!(cell.immediate_result(number), None, "another one followed");
}

#[test]
fn safety_and_errors_end_an_execute() {
    for event in [
        CellCommand::EmergencyStop(true),
        CellCommand::SafetyDoor { open: true },
        CellCommand::RaiseError(5040),
        CellCommand::Mode(OperatingMode::Teach),
    ] {
        let mut cell = ready(&[RobotModel::C4A601S]);
        printed(&mut cell, "Motor On");
        let number = cell.execute_text("Go P1").unwrap();
        pass(&mut cell, 50);
        cell.command(event.clone()).unwrap();
        assert_eq!(cell.immediate_result(number), Some(&Err(SpelError::Aborted)), "{event:?}");
        until(&mut cell, |s| !s.robots[0].motors_on);
        assert!(cell.execute_text("print 1").is_err(), "{event:?}");
    }
}

#[test]
fn it_is_accepted_as_start_is() {
    let mut running = cell(&[RobotModel::C4A601S]);
    pass(&mut running, 3000);
    assert_eq!(running.execute_text("print 1"), Err(CommandRefusal::NotReady));
    let mut teach = ready(&[RobotModel::C4A601S]);
    teach.command(CellCommand::Mode(OperatingMode::Teach)).unwrap();
    assert_eq!(teach.execute_text("print 1"), Err(CommandRefusal::NotAuto));
}

#[test]
fn reset_switches_outputs_off_and_sets_speeds_back() {
    let mut cell = ready(&[RobotModel::C4A601S]);
    printed(&mut cell, "On 9; MemOn 9; Out 8, 255; Motor On; Power High; Speed 77");
    cell.command(CellCommand::Reset).unwrap();
    assert_eq!(printed(&mut cell, "print oport(9), out(8), memsw(9), speed, power, motor"), "0 0 1 5 0 1");
    let io = cell.snapshot().io;
    assert!(io.bit(1, 0) && io.bit(1, 8), "Ready and motors on are shown");
}

#[test]
fn variables_are_set_in_auto_and_ready() {
    let set = |name: &str, kind, element: &[u16], value| CellCommand::SetVariable {
        name: name.to_owned(),
        kind: Some(kind),
        element: element.to_vec(),
        value,
    };
    let mut cell = ready(&[RobotModel::C4A601S]);
    cell.command(set("OPCUA_OperatingStatus", SpelType::UShort, &[], SpelValue::UInt16(7))).unwrap();
    assert_eq!(cell.snapshot().variables[2], SpelValue::UInt16(7));
    for (wrong, error) in [
        (set("OPCUA_OperatingStatus", SpelType::Short, &[], SpelValue::Int16(7)), VariableError::Unknown),
        (set("g_List", SpelType::Integer, &[], SpelValue::Int16(7)), VariableError::Dimensions),
        (set("g_List", SpelType::Integer, &[0, 2], SpelValue::Int16(7)), VariableError::Element),
        (set("g_List", SpelType::Integer, &[0, 1], SpelValue::Int32(7)), VariableError::Value),
    ] {
        assert_eq!(cell.command(wrong), Err(CommandRefusal::Variable(error)));
    }
    cell.command(CellCommand::Mode(OperatingMode::Teach)).unwrap();
    let refused = cell.command(set("OPCUA_OperatingStatus", SpelType::UShort, &[], SpelValue::UInt16(7)));
    assert_eq!(refused, Err(CommandRefusal::NotAuto));
}
