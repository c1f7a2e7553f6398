use super::*;

fn battery(cell: &mut Cell) -> ConsumableValues {
    cell.snapshot().robots[0].battery
}

#[test]
fn a_worn_part_raises_its_alarm_until_it_is_reset() {
    let mut cell = cell(&BOTH);
    cell.command(CellCommand::Stop).unwrap();
    assert_eq!(cell.alarms(), [0; 0]);
    for alarm in [5, 1, 2] {
        cell.command(CellCommand::WearOut(alarm)).unwrap();
    }
    assert_eq!(cell.alarms(), [1, 2, 5]);
    assert!(battery(&mut cell).consumption_rate >= 100.0);
    let grease =
        |cell: &mut Cell| cell.snapshot().robots[1].axes.iter().map(|axis| axis.part(Part::Grease)).collect::<Vec<_>>();
    assert!(grease(&mut cell).iter().all(|part| part.consumption_rate >= 100.0 && part.months_remaining < 0.001));

    pass(&mut cell, 60_000);
    cell.command(CellCommand::ResetAlarm(2)).unwrap();
    let replaced = battery(&mut cell);
    assert_eq!(replaced.installed, Some(cell.snapshot().clock));
    assert!(replaced.consumption_rate < 0.01, "{replaced:?}");
    cell.command(CellCommand::ResetAlarm(5)).unwrap();
    assert!(grease(&mut cell).iter().all(|part| part.consumption_rate < 0.01));
    assert_eq!(cell.alarms(), [1]);
}

#[test]
fn an_alarm_is_reset_in_auto_and_ready_and_must_be_of_a_part_that_there_is() {
    let mut cell = cell(&[RobotModel::C4A601S]);
    for alarm in [0, 4, 5, 9, 255] {
        assert_eq!(cell.command(CellCommand::WearOut(alarm)), Err(CommandRefusal::UnknownAlarm), "{alarm}");
        assert_eq!(cell.command(CellCommand::ResetAlarm(alarm)), Err(CommandRefusal::UnknownAlarm), "{alarm}");
    }
    pass(&mut cell, 3000);
    cell.command(CellCommand::WearOut(3)).unwrap();
    assert_eq!(cell.command(CellCommand::ResetAlarm(3)), Err(CommandRefusal::NotReady));
    cell.command(CellCommand::Mode(OperatingMode::Teach)).unwrap();
    assert_eq!(cell.command(CellCommand::ResetAlarm(3)), Err(CommandRefusal::NotAuto));
    assert_eq!(cell.alarms(), [3]);
}

#[test]
fn the_battery_keeps_variables_and_replaced_parts_over_a_power_off() {
    let mut config = config(&BOTH, 7);
    config.variables.push(SpelDeclaration { bounds: vec![2], ..SpelDeclaration::scalar("g_Counts", SpelType::UInt64) });
    let mut cell = Cell::new(config.clone());
    cell.command(CellCommand::Stop).unwrap();
    let set = |name: &str, element: &[u16], value| CellCommand::SetVariable {
        name: name.to_owned(),
        kind: None,
        element: element.to_vec(),
        value,
    };
    cell.command(set("OPCUA_Recipe", &[], SpelValue::String("a \"b\" 日".to_owned()))).unwrap();
    cell.command(set("OPCUA_CycleSeconds", &[], SpelValue::Double(f64::NAN))).unwrap();
    cell.command(set("g_counts", &[2], SpelValue::UInt64(u64::MAX))).unwrap();
    cell.command(CellCommand::WearOut(2)).unwrap();
    cell.command(CellCommand::ResetAlarm(2)).unwrap();
    let installed = battery(&mut cell).installed;

    let kept = serde_json::to_string(&cell.backup()).unwrap();
    config.backup = serde_json::from_str(&kept).unwrap();
    config.started += chrono::TimeDelta::days(1);
    let mut again = Cell::new(config);
    let values = |name: &str, element: &[u16], count| again.variable(name, None, element, count).unwrap().to_vec();
    assert_eq!(values("OPCUA_Recipe", &[], 1), [SpelValue::String("a \"b\" 日".to_owned())]);
    assert_eq!(values("g_Counts", &[0], 3), [0, 0, u64::MAX].map(SpelValue::UInt64));
    assert!(matches!(values("OPCUA_CycleSeconds", &[], 1)[..], [SpelValue::Double(number)] if number.is_nan()));
    assert_eq!(battery(&mut again).installed, installed);
    assert_eq!(serde_json::to_string(&again.backup()).unwrap(), kept);
}
