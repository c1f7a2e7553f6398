use std::collections::{BTreeSet, HashMap, HashSet};

use opcua::server::node_manager::{ParsedReadValueId, ParsedWriteValue};
use opcua::types::{
    AttributeId, BinaryEncodable as _, ContextOwned, DataEncoding, DataValue, DateTime, NodeClass, NodeId,
    NumericRange, StatusCode, TimestampsToReturn, Variant,
};

use super::id::{Id, OWN, STANDARD, standard};
use super::node::Class;
use super::reading::{Queues, Reading};
use super::system;
use super::table::{Space, Table};
use super::types::Types;
use super::value::Source;
use super::writing;
use crate::model::FirmwareGeneration;
use crate::virtual_controller::cell::{
    Cell, CellClock, CellConfig, CellHandle, CellOptions, RobotModel, SpelDeclaration, SpelType,
};

/// A controller with a six-axis robot and a SCARA.
struct Controller {
    cell: CellHandle,
    clock: CellClock,
    space: Space,
}

impl Controller {
    fn current() -> Self {
        Self::new("8.0.2", false)
    }

    fn legacy() -> Self {
        Self::new("7.5.4", false)
    }

    fn new(firmware: &str, virtual_io: bool) -> Self {
        let options = CellOptions {
            robots: vec![RobotModel::C4A601S, RobotModel::Gx4A251S],
            virtual_io,
            ..CellOptions::default()
        };
        let variables = SpelType::ALL.map(|kind| SpelDeclaration { name: format!("OPCUA_{kind}"), kind });
        let config = CellConfig {
            name: "Cell 1".parse().unwrap(),
            serial: "SN0000123".parse().unwrap(),
            series: "RC800".parse().unwrap(),
            firmware: firmware.parse().unwrap(),
            started: "2026-03-01T08:00:00Z".parse().unwrap(),
            variables: variables.to_vec(),
            options,
        };
        let clock = CellClock::manual();
        let cell = CellHandle::new(Cell::new(config), clock.clone());
        let description = cell.description();
        let types = Types::of(description.controller.generation(), virtual_io).unwrap();
        let space = system::space(types, &description);
        Self { cell, clock, space }
    }

    /// The node at a path of BrowseNames below DeviceSet.
    fn find(&self, path: &str) -> Option<Id> {
        path.split('/').try_fold(Id::di(5001), |at, name| {
            let mut below = self.space.references(at).filter(|r| r.is_forward).map(|r| r.other);
            below.find(|id| self.space.node(*id).is_some_and(|node| &*node.name.text == name))
        })
    }

    fn id(&self, path: &str) -> Id {
        self.find(path).unwrap_or_else(|| panic!("no {path}"))
    }

    fn read_id(&self, id: Id, attribute: AttributeId) -> DataValue {
        let reading = Reading::new(&self.space, &self.cell, DateTime::now(), DateTime::now());
        let request = ParsedReadValueId {
            node_id: id.into(),
            attribute_id: attribute,
            index_range: NumericRange::None,
            data_encoding: DataEncoding::Binary,
        };
        reading.read(&request, TimestampsToReturn::Both, &mut Queues::Take { budget: 1 << 20 })
    }

    fn value(&self, path: &str) -> Variant {
        self.read_id(self.id(path), AttributeId::Value).value.unwrap()
    }

    fn write(&self, path: &str, value: impl Into<Variant>) -> Result<(), StatusCode> {
        self.write_attribute(path, AttributeId::Value, value.into())
    }

    fn write_attribute(&self, path: &str, attribute_id: AttributeId, value: Variant) -> Result<(), StatusCode> {
        let node_id = NodeId::from(self.id(path));
        let value = DataValue::value_only(value);
        let request = ParsedWriteValue { node_id, attribute_id, index_range: NumericRange::None, value };
        writing::write(&self.space, &self.cell, &request)
    }

    fn instances(&self) -> impl Iterator<Item = Id> {
        self.space.instances.nodes().map(|(id, _)| id)
    }
}

const SYSTEM: &str = "MotionDeviceSystem_0";
const COMPONENTS: &str = "MotionDeviceSystem_0/Controllers/Controller_0/Components";
const ROBOT: &str = "MotionDeviceSystem_0/MotionDevices/MotionDevice_1";
const SCARA: &str = "MotionDeviceSystem_0/MotionDevices/MotionDevice_2";

fn every_controller() -> [Controller; 3] {
    [Controller::current(), Controller::legacy(), Controller::new("8.0.2", true)]
}

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
