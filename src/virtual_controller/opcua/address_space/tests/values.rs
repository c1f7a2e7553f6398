use opcua::types::{AttributeId, DateTime, NodeClass, NodeId, StatusCode, Variant};

use super::{Controller, ROBOT, SCARA, SYSTEM, every_controller};
use crate::virtual_controller::opcua::address_space::id::{Id, STANDARD, standard};
use crate::virtual_controller::opcua::address_space::node::Class;
use crate::virtual_controller::opcua::address_space::reading::Reading;

#[test]
fn every_value_has_its_data_type_or_is_null_where_the_manual_says_so() {
    for controller in every_controller() {
        for (id, node) in controller.space.instances.nodes() {
            let Class::Variable(variable) = &node.class else { continue };
            let read = controller.read_id(id, AttributeId::Value);
            assert_eq!(read.status, Some(StatusCode::Good), "{node:?}");
            assert!(read.source_timestamp.is_some() && read.server_timestamp.is_some());
            let value = read.value.unwrap();
            if matches!(value, Variant::Empty) {
                let null = ["SerialNumber", "Manufacturer", "Model", "ProductCode", "MotorTemperature", "Level"];
                let empty = ["Data", "InstallationDate"];
                assert!(null.contains(&&*node.name.text) || empty.contains(&&*node.name.text), "{node:?}");
                continue;
            }
            let expected = match variable.data_type {
                // Enumerations, and structures.
                id if id.namespace != STANDARD => 6,
                Id { number: 884 | 887, .. } => 22,
                standard::DURATION_STRING => 12,
                id => id.number,
            };
            assert_eq!(value.scalar_type_id().map(|kind| kind as u32), Some(expected), "{node:?}: {value:?}");
        }
        let motor = format!("{ROBOT}/PowerTrains/PowerTrain_1/Motor_1");
        for name in ["SerialNumber", "Manufacturer", "Model", "ProductCode", "ParameterSet/MotorTemperature"] {
            assert_eq!(controller.value(&format!("{motor}/{name}")), Variant::Empty, "{name}");
        }
        let level = controller.value(&format!("{SYSTEM}/Controllers/Controller_0/CurrentUser/Level"));
        assert_eq!(level, Variant::Empty);
    }
}

#[test]
fn the_robots_say_what_they_are() {
    let controller = Controller::current();
    assert_eq!(controller.value(&format!("{ROBOT}/MotionDeviceCategory")), Variant::from(1_i32));
    assert_eq!(controller.value(&format!("{SCARA}/MotionDeviceCategory")), Variant::from(2_i32));
    assert_eq!(controller.value(&format!("{ROBOT}/ProductCode")), Variant::from("C4-A601S"));
    assert_eq!(controller.value(&format!("{SCARA}/RobotNumber")), Variant::from(2_u16));
    let profiles: Vec<Variant> =
        (1..=4).map(|axis| controller.value(&format!("{SCARA}/Axes/Axis_{axis}/MotionProfile"))).collect();
    assert_eq!(profiles, [1, 1, 3, 1].map(Variant::from));
    assert!(controller.find(&format!("{ROBOT}/Axes/Axis_6")).is_some());
    assert!(controller.find(&format!("{SCARA}/Axes/Axis_5")).is_none());
}

#[test]
fn attributes_are_those_of_the_node_class() {
    let controller = Controller::current();
    let robot = controller.id(ROBOT);
    let read = |id, attribute| controller.read_id(id, attribute).value;
    assert_eq!(read(robot, AttributeId::NodeClass), Some(Variant::from(NodeClass::Object as i32)));
    assert_eq!(read(robot, AttributeId::EventNotifier), Some(Variant::from(0_u8)));
    let missing = controller.read_id(robot, AttributeId::Value);
    assert_eq!((missing.status, missing.value), (Some(StatusCode::BadAttributeIdInvalid), None));
    let unknown = controller.read_id(Id::own(1), AttributeId::Value);
    assert_eq!(unknown.status, Some(StatusCode::BadNodeIdUnknown));
    let position = controller.id(&format!("{ROBOT}/Axes/Axis_1/ParameterSet/ActualPosition"));
    assert_eq!(read(position, AttributeId::DataType), Some(NodeId::from(standard::DOUBLE).into()));
    assert_eq!(read(position, AttributeId::ValueRank), Some(Variant::from(-1_i32)));
    assert_eq!(read(position, AttributeId::MinimumSamplingInterval), Some(Variant::from(100.0)));
    let range = controller.value(&format!("{ROBOT}/Axes/Axis_1/ParameterSet/ActualPosition/EURange"));
    let Variant::ExtensionObject(range) = range else { panic!("{range:?}") };
    let range = range.inner_as::<opcua::types::Range>().unwrap();
    assert_eq!((range.low, range.high), (-170.0, 170.0));
}

#[test]
fn values_of_one_read_are_of_one_moment_and_move_with_the_clock() {
    let controller = Controller::current();
    let on_time = format!("{SYSTEM}/Controllers/Controller_0/ParameterSet/TotalPowerOnTime");
    let before = controller.value(&on_time);
    controller.clock.advance(std::time::Duration::from_secs(90));
    assert_ne!(controller.value(&on_time), before);
    let reading = Reading::new(&controller.space, &controller.cell, DateTime::now(), DateTime::now());
    let read = || {
        let variable = controller.space.node(controller.id(&on_time)).unwrap().variable().unwrap();
        reading.value(variable).0
    };
    let first = read();
    controller.clock.advance(std::time::Duration::from_secs(90));
    assert_eq!(read(), first);
}
