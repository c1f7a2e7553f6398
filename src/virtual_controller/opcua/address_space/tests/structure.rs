use std::collections::{HashMap, HashSet};

use opcua::types::{AttributeId, BinaryEncodable as _, ContextOwned};

use super::{COMPONENTS, Controller, ROBOT, SYSTEM, every_controller};
use crate::model::FirmwareGeneration;
use crate::virtual_controller::opcua::address_space::id::{Id, OWN, STANDARD, standard};
use crate::virtual_controller::opcua::address_space::node::Class;
use crate::virtual_controller::opcua::address_space::system;
use crate::virtual_controller::opcua::address_space::table::{Space, Table};
use crate::virtual_controller::opcua::address_space::types::Types;

#[test]
fn no_reference_leads_nowhere() {
    for controller in every_controller() {
        let Space { types, instances } = &controller.space;
        for table in [&**types, instances] {
            for (id, _) in table.nodes() {
                for reference in table.references(id) {
                    for end in [reference.kind, reference.other].into_iter().filter(|end| end.namespace != STANDARD) {
                        assert!(controller.space.node(end).is_some(), "{id:?} {reference:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn every_instance_has_a_type_and_one_parent_and_its_own_name() {
    for controller in every_controller() {
        for id in controller.instances() {
            assert!(controller.space.type_definition(id).is_some(), "{id:?}");
            let contains = [standard::HAS_COMPONENT, standard::HAS_PROPERTY];
            let parents = controller.space.references(id).filter(|r| !r.is_forward && contains.contains(&r.kind));
            assert_eq!(parents.count(), 1, "{id:?}");
            let mut names = HashSet::new();
            for child in controller.space.references(id).filter(|r| r.is_forward && contains.contains(&r.kind)) {
                let name = controller.space.node(child.other).unwrap().name.clone();
                let text = name.text.clone();
                assert!(names.insert((name.namespace, name.text)), "{id:?} has {text} twice");
            }
        }
    }
}

/// Every mandatory member of a type and of its supertypes, down through the declarations of members.
#[test]
fn every_instance_has_the_mandatory_members_of_its_type() {
    for controller in every_controller() {
        let types = &controller.space.types;
        let mut checked = 0;
        for id in controller.instances() {
            let mut declaring = controller.space.type_definition(id);
            while let Some(definition) = declaring {
                check_members(&controller.space, types, definition, id, &mut checked);
                declaring = types.supertype(definition);
            }
        }
        assert!(checked > 150, "{checked}");
    }
}

fn check_members(space: &Space, types: &Table, declaring: Id, instance: Id, checked: &mut usize) {
    for reference in types.references(declaring).iter().filter(|r| r.is_forward) {
        let declaration = reference.other;
        let Some(node) = types.node(declaration) else { continue };
        if types.targets(declaration, standard::HAS_MODELLING_RULE).next() != Some(standard::MANDATORY) {
            continue;
        }
        let member = space
            .references(instance)
            .find(|r| r.is_forward && r.kind == reference.kind && space.node(r.other).unwrap().name == node.name)
            .unwrap_or_else(|| panic!("{instance:?} has no {:?}", node.name))
            .other;
        *checked += 1;
        assert_eq!(space.type_definition(member), types.targets(declaration, standard::HAS_TYPE_DEFINITION).next());
        if let (Some(declared), Some(made)) = (node.variable(), space.node(member).unwrap().variable()) {
            assert_eq!((declared.data_type, declared.rank), (made.data_type, made.rank), "{:?}", node.name);
        }
        check_members(space, types, declaration, member, checked);
    }
}

/// The bundled facts have every node that the NodeSets publish, but for those of the deprecated type dictionaries.
#[test]
fn the_published_models_are_complete() {
    let types = Types::of(FirmwareGeneration::Current, false).unwrap();
    let count = |namespace| types.0.nodes().filter(|(id, _)| id.namespace == namespace).count();
    assert_eq!((count(2), count(3)), (398, 242));
    let device_set = types.0.node(Id::di(5001)).unwrap();
    assert_eq!((&*device_set.name.text, device_set.name.namespace), ("DeviceSet", 2));
    let mode = types.0.node(Id::robotics(3006)).unwrap();
    assert!(matches!(&mode.class, Class::DataType { definition: Some(_), .. }));
}

/// The OPC UA crate refuses to send some values, and with them the whole response.
#[test]
fn every_attribute_can_be_sent() {
    let context = ContextOwned::default();
    for controller in every_controller() {
        let nodes = controller.space.types.nodes().chain(controller.space.instances.nodes());
        let ids: Vec<Id> = nodes.map(|(id, _)| id).collect();
        for id in ids {
            for attribute in (1..=27).filter_map(|number| AttributeId::from_u32(number).ok()) {
                let value = controller.read_id(id, attribute);
                let sent = value.encode(&mut Vec::new(), &context.context());
                assert!(sent.is_ok(), "{id:?} {attribute:?}: {sent:?}");
            }
        }
    }
}

#[test]
fn legacy_firmware_lacks_the_newer_nodes() {
    let (legacy, current) = (Controller::legacy(), Controller::current());
    let newer = [
        format!("{COMPONENTS}/MotionLogSystem"),
        format!("{COMPONENTS}/ControllerStatus"),
        format!("{COMPONENTS}/DriveUnitIO"),
        format!("{COMPONENTS}/FieldbusSlaveIO"),
        format!("{COMPONENTS}/FieldbusMasterIO"),
        format!("{COMPONENTS}/MemoryIO"),
        format!("{SYSTEM}/Controllers/Controller_0/ConsumableStatus"),
        format!("{ROBOT}/RobotNumber"),
        format!("{ROBOT}/RobotStatus"),
        format!("{ROBOT}/AdditionalInfo"),
        format!("{ROBOT}/ConsumableStatus"),
        format!("{ROBOT}/Axes/Axis_1/AdditionalInfo"),
        format!("{ROBOT}/Axes/Axis_1/ConsumableStatus"),
    ];
    for path in &newer {
        assert!(current.find(path).is_some(), "{path}");
        assert!(legacy.find(path).is_none(), "{path}");
    }
    for path in ["StandardIO", "ExtendedIO", "ForceSensorMonitorSystem", "SpelProject/BackupVariables/OPCUA_Real"] {
        assert!(legacy.find(&format!("{COMPONENTS}/{path}")).is_some(), "{path}");
    }
    let has_type = |controller: &Controller, name: &str| {
        controller.space.types.nodes().any(|(id, node)| id.namespace == OWN && &*node.name.text == name)
    };
    assert!(has_type(&current, "MotionLogType") && !has_type(&legacy, "MotionLogType"));
    assert!(has_type(&legacy, "ForceSensorMonitorType"));
}

#[test]
fn ids_are_the_same_after_every_start_and_the_literal_ones_as_the_manual_has_them() {
    let ids = |controller: &Controller| -> HashMap<Id, String> {
        controller.space.instances.nodes().map(|(id, node)| (id, node.name.text.to_string())).collect()
    };
    let controller = Controller::current();
    assert_eq!(ids(&controller), ids(&Controller::current()));
    let literal = [
        ("ForceSensorMonitorSystem/Port", 196_609),
        ("ForceSensorMonitorSystem/DataType", 196_611),
        ("ForceSensorMonitorSystem/DataNum", 196_612),
        ("ForceSensorMonitorSystem/ForceSensorMonitor_1/Data", 196_865),
        ("ForceSensorMonitorSystem/ForceSensorMonitor_1/MonitorStatus", 196_866),
        ("ForceSensorMonitorSystem/ForceSensorMonitor_1/DataExistsStatus", 196_867),
        ("MotionLogSystem/DataNum", 20_313),
        ("MotionLogSystem/SamplingInterval", 20_314),
        ("MotionLogSystem/MotionLog_1/Data", 20_316),
        ("MotionLogSystem/MotionLog_1/LoggingStatus", 20_317),
        ("MotionLogSystem/MotionLog_1/DataExistsStatus", 20_318),
    ];
    for (path, number) in literal {
        assert_eq!(controller.id(&format!("{COMPONENTS}/{path}")), Id::own(number), "{path}");
    }
    // An id changes only with the node's own path: a robot more changes none.
    let one_robot = {
        let mut description = (*controller.cell.description()).clone();
        description.robots.truncate(1);
        system::space(Types::of(FirmwareGeneration::Current, false).unwrap(), &description)
    };
    let all = ids(&controller);
    assert!(one_robot.instances.nodes().all(|(id, node)| all.get(&id).is_some_and(|name| **name == *node.name.text)));
}
