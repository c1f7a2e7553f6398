use std::collections::BTreeSet;

use opcua::types::{AttributeId, StatusCode, Variant};

use super::{COMPONENTS, Controller, ROBOT};
use crate::virtual_controller::opcua::address_space::value::Source;

#[test]
fn signals_are_bits_or_bytes_and_with_virtual_io_both_below_words() {
    let children = |controller: &Controller, path: &str| -> BTreeSet<String> {
        let below = controller.space.references(controller.id(path)).filter(|r| r.is_forward);
        let variables = below.filter_map(|r| controller.space.node(r.other)).filter(|n| n.variable().is_some());
        variables.map(|node| node.name.text.to_string()).collect()
    };
    let kind = |names: &BTreeSet<String>| -> BTreeSet<String> {
        names.iter().map(|name| name.split('_').next().unwrap().to_owned()).collect()
    };
    let real = Controller::current();
    let standard_inputs = children(&real, &format!("{COMPONENTS}/StandardIO/Inputs"));
    assert_eq!((standard_inputs.len(), kind(&standard_inputs)), (24, BTreeSet::from(["Bit".to_owned()])));
    let memory = children(&real, &format!("{COMPONENTS}/MemoryIO/Memory"));
    assert_eq!((memory.len(), kind(&memory)), (128, BTreeSet::from(["Byte".to_owned()])));
    assert_eq!(real.write(&format!("{COMPONENTS}/StandardIO/Inputs/Bit_0"), true), Err(StatusCode::BadNotWritable));

    let simulated = Controller::new("8.0.2", true);
    let inputs = format!("{COMPONENTS}/StandardIO/Inputs");
    assert_eq!(children(&simulated, &inputs), BTreeSet::from(["Byte_2", "Word_0"].map(str::to_owned)));
    assert!(simulated.find(&format!("{inputs}/Word_0/Byte_1/Bit_15")).is_some());
    simulated.write(&format!("{inputs}/Word_0/Byte_1/Bit_9"), true).unwrap();
    assert_eq!(simulated.value(&format!("{inputs}/Word_0")), Variant::from(0x200_u16));
    simulated.write(&format!("{inputs}/Word_0"), 0x8001_u16).unwrap();
    assert_eq!(simulated.value(&format!("{inputs}/Word_0/Byte_1")), Variant::from(0x80_u8));
    let outputs = format!("{COMPONENTS}/StandardIO/Outputs/Word_0");
    assert_eq!(simulated.write(&outputs, 1_u16), Err(StatusCode::BadNotWritable));
}

#[test]
fn settings_take_values_of_their_type_and_range_only() {
    let controller = Controller::current();
    let force = |name: &str| format!("{COMPONENTS}/ForceSensorMonitorSystem/{name}");
    let motion = |name: &str| format!("{COMPONENTS}/MotionLogSystem/{name}");
    for (path, good, bad) in [
        (force("DataType"), 3_u16, Some(4_u16)),
        (force("DataNum"), 65_535, None),
        (motion("DataType"), 0, Some(1)),
        (motion("DataNum"), 200, Some(201)),
        (motion("SamplingInterval"), 4, Some(5)),
    ] {
        controller.write(&path, good).unwrap();
        assert_eq!(controller.value(&path), Variant::from(good), "{path}");
        if let Some(bad) = bad {
            assert_eq!(controller.write(&path, bad), Err(StatusCode::BadOutOfRange), "{path}");
        }
        for wrong in [Variant::from(1_i32), Variant::from(1_u8), Variant::from(vec![1_u16]), Variant::Empty] {
            assert_eq!(controller.write(&path, wrong), Err(StatusCode::BadTypeMismatch), "{path}");
        }
        assert_eq!(controller.value(&path), Variant::from(good), "{path}: nothing changed");
    }
    controller.write(&force("Port"), true).unwrap();
    assert_eq!(controller.value(&force("Port")), Variant::from(true));
    assert_eq!(controller.write(&force("Port"), 1_u16), Err(StatusCode::BadTypeMismatch));
}

#[test]
fn everything_else_cannot_be_written() {
    let controller = Controller::current();
    let settings = controller
        .space
        .instances
        .nodes()
        .filter(|(_, node)| node.variable().is_some_and(|variable| matches!(variable.source, Source::Setting(_))));
    assert_eq!(settings.count(), 7);
    for path in [
        format!("{ROBOT}/ParameterSet/SpeedOverride"),
        format!("{ROBOT}/SerialNumber"),
        format!("{COMPONENTS}/SpelProject/BackupVariables/OPCUA_Double"),
        format!("{COMPONENTS}/ForceSensorMonitorSystem/ForceSensorMonitor_1/Data"),
    ] {
        let value = controller.value(&path);
        assert_eq!(controller.write(&path, 1.0), Err(StatusCode::BadNotWritable), "{path}");
        assert_eq!(controller.value(&path), value);
        let level = controller.read_id(controller.id(&path), AttributeId::AccessLevel).value;
        assert_eq!(level, Some(Variant::from(1_u8)), "{path}");
    }
    let port = format!("{COMPONENTS}/ForceSensorMonitorSystem/Port");
    let name = controller.write_attribute(&port, AttributeId::DisplayName, Variant::from("X"));
    assert_eq!(name, Err(StatusCode::BadNotWritable));
    let executable = controller.write_attribute(&port, AttributeId::Executable, Variant::from(true));
    assert_eq!(executable, Err(StatusCode::BadAttributeIdInvalid));
    assert_eq!(controller.write(ROBOT, 1.0), Err(StatusCode::BadAttributeIdInvalid));
    let level = controller.read_id(controller.id(&port), AttributeId::AccessLevel).value;
    assert_eq!(level, Some(Variant::from(3_u8)));
}
