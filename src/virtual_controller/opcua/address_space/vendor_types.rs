//! The vendor's types (manual 3.2.3), in namespace 1.
//!
//! The manual defines RobotStatus, ConsumableStatus and the like as objects with a supertype and mandatory members; here
//! each has a type of that definition, named after it.

use crate::model::FirmwareGeneration;

use super::id::{Id, OWN, standard};
use super::node::{BrowseName, Class, Node, Variable};
use super::table::Table;
use super::value::Source;

pub(super) const IO_SYSTEM: Id = Id::own(1001);
pub(super) const IO_SIGNALS: Id = Id::own(1002);
pub(super) const FORCE_SENSOR_MONITOR_SYSTEM: Id = Id::own(1003);
pub(super) const FORCE_SENSOR_MONITOR: Id = Id::own(1004);
pub(super) const SPEL_PROJECT: Id = Id::own(1005);
pub(super) const SPEL_VARIABLE: Id = Id::own(1006);
pub(super) const MOTION_LOG_SYSTEM: Id = Id::own(1007);
pub(super) const MOTION_LOG: Id = Id::own(1008);
pub(super) const ROBOT_STATUS: Id = Id::own(1009);
pub(super) const CONSUMABLE_STATUS: Id = Id::own(1010);
pub(super) const CONSUMABLE_PART: Id = Id::own(1011);
pub(super) const ROBOT_ADDITIONAL_INFO: Id = Id::own(1012);
pub(super) const AXIS_ADDITIONAL_INFO: Id = Id::own(1013);
pub(super) const CONTROLLER_STATUS: Id = Id::own(1014);

/// ComponentType of Devices.
const COMPONENT: Id = Id::di(15_063);

/// Adds the vendor's types of a firmware generation to `table`. `words`: I/O signals may have word nodes (appendix A-3 of
/// the manual's newer edition, which is about virtual controllers).
pub(super) fn add(table: &mut Table, generation: FirmwareGeneration, words: bool) {
    for definition in TYPES {
        if definition.current_only && generation == FirmwareGeneration::Legacy {
            continue;
        }
        let name = BrowseName::new(OWN, definition.name);
        table.insert(definition.id, Node::new(name, Class::ObjectType { is_abstract: false }));
        table.refer(definition.supertype, standard::HAS_SUBTYPE, definition.id);
        for (member, at) in definition.members.iter().zip(1..) {
            if member.is_word && !words {
                continue;
            }
            let id = Id::own(definition.id.number * MEMBERS_OF_A_TYPE + at);
            let (class, type_definition) = match member.kind {
                Kind::Object(type_definition) => (Class::Object, type_definition),
                Kind::Variable(data_type) => {
                    (Class::Variable(Variable::scalar(data_type, Source::NULL)), standard::BASE_DATA_VARIABLE_TYPE)
                }
            };
            table.insert(id, Node::new(BrowseName::new(OWN, member.name), class));
            table.refer(definition.id, standard::HAS_COMPONENT, id);
            table.refer(id, standard::HAS_TYPE_DEFINITION, type_definition);
            table.refer(id, standard::HAS_MODELLING_RULE, member.rule);
        }
    }
}

struct Definition {
    id: Id,
    name: &'static str,
    supertype: Id,
    members: &'static [Member],
    current_only: bool,
}

struct Member {
    name: &'static str,
    kind: Kind,
    rule: Id,
    is_word: bool,
}

enum Kind {
    /// Of this type.
    Object(Id),
    /// A scalar of this data type.
    Variable(Id),
}

const fn mandatory(name: &'static str, data_type: Id) -> Member {
    Member { name, kind: Kind::Variable(data_type), rule: standard::MANDATORY, is_word: false }
}

const fn variables(name: &'static str, data_type: Id, rule: Id) -> Member {
    Member { name, kind: Kind::Variable(data_type), rule, is_word: false }
}

const fn optional(name: &'static str, data_type: Id) -> Member {
    variables(name, data_type, standard::OPTIONAL_PLACEHOLDER)
}

const fn objects(name: &'static str, type_definition: Id) -> Member {
    Member { name, kind: Kind::Object(type_definition), rule: standard::MANDATORY_PLACEHOLDER, is_word: false }
}

const fn object_type(id: Id, name: &'static str, supertype: Id, members: &'static [Member]) -> Definition {
    Definition { id, name, supertype, members, current_only: false }
}

const fn current(definition: Definition) -> Definition {
    Definition { current_only: true, ..definition }
}

/// Type numbers are multiplied by this for the ids of their members.
const MEMBERS_OF_A_TYPE: u32 = 100;

const TYPES: &[Definition] = &[
    // 3.2.3.1
    object_type(IO_SYSTEM, "IOSystemType", COMPONENT, &[objects("<IOSignalsIdentifier>", IO_SIGNALS)]),
    object_type(
        IO_SIGNALS,
        "IOSignalsType",
        standard::FOLDER_TYPE,
        &[
            optional("<IOBitIdentifier>", standard::BOOLEAN),
            optional("<IOByteIdentifier>", standard::BYTE),
            Member { is_word: true, ..optional("<IOWordIdentifier>", standard::UINT16) },
        ],
    ),
    // 3.2.3.2
    object_type(
        FORCE_SENSOR_MONITOR_SYSTEM,
        "ForceSensorMonitorSystemType",
        COMPONENT,
        &[
            mandatory("Port", standard::BOOLEAN),
            mandatory("Option", standard::STRING),
            mandatory("DataType", standard::UINT16),
            mandatory("DataNum", standard::UINT16),
            objects("<ForceSensorMonitorIdentifier>", FORCE_SENSOR_MONITOR),
        ],
    ),
    object_type(
        FORCE_SENSOR_MONITOR,
        "ForceSensorMonitorType",
        COMPONENT,
        &[
            mandatory("Data", standard::BYTE_STRING),
            mandatory("MonitorStatus", standard::STRING),
            mandatory("DataExistsStatus", standard::STRING),
            mandatory("ErrorStatus", standard::STRING),
        ],
    ),
    // 3.2.3.3: the container is the only one, so that its placeholder is mandatory.
    object_type(
        SPEL_PROJECT,
        "SpelProjectType",
        COMPONENT,
        &[mandatory("SpelProjectName", standard::STRING), objects("<SpelVariablesIdentifier>", SPEL_VARIABLE)],
    ),
    object_type(
        SPEL_VARIABLE,
        "SpelVariableType",
        COMPONENT,
        &[
            optional("<SpelVariablesIdentifier>", standard::BOOLEAN),
            optional("<SpelVariablesIdentifier>", standard::SBYTE),
            optional("<SpelVariablesIdentifier>", standard::INT16),
            optional("<SpelVariablesIdentifier>", standard::INT32),
            optional("<SpelVariablesIdentifier>", standard::INT64),
            optional("<SpelVariablesIdentifier>", standard::BYTE),
            optional("<SpelVariablesIdentifier>", standard::UINT16),
            optional("<SpelVariablesIdentifier>", standard::UINT32),
            optional("<SpelVariablesIdentifier>", standard::UINT64),
            optional("<SpelVariablesIdentifier>", standard::FLOAT),
            optional("<SpelVariablesIdentifier>", standard::DOUBLE),
            optional("<SpelVariablesIdentifier>", standard::STRING),
        ],
    ),
    // 3.2.3.4
    current(object_type(
        MOTION_LOG_SYSTEM,
        "MotionLogSystemType",
        COMPONENT,
        &[
            mandatory("DataType", standard::UINT16),
            mandatory("DataNum", standard::UINT16),
            mandatory("SamplingInterval", standard::UINT16),
            objects("<MotionLogIdentifier>", MOTION_LOG),
        ],
    )),
    current(object_type(
        MOTION_LOG,
        "MotionLogType",
        COMPONENT,
        &[
            mandatory("Data", standard::BYTE_STRING),
            mandatory("LoggingStatus", standard::STRING),
            mandatory("DataExistsStatus", standard::STRING),
            mandatory("ErrorStatus", standard::STRING),
        ],
    )),
    // 3.2.3.6
    current(object_type(
        ROBOT_STATUS,
        "RobotStatusType",
        COMPONENT,
        &[
            mandatory("Power", standard::BOOLEAN),
            mandatory("Home", standard::BOOLEAN),
            mandatory("IntegrationMotorOnTime", standard::DURATION_STRING),
            mandatory("MotorOnCount", standard::UINT32),
        ],
    )),
    // 3.2.3.7
    current(object_type(
        CONSUMABLE_STATUS,
        "ConsumableStatusType",
        standard::FOLDER_TYPE,
        &[objects("<PartsIdentifier>", standard::BASE_OBJECT_TYPE)],
    )),
    current(object_type(
        CONSUMABLE_PART,
        "ConsumablePartType",
        COMPONENT,
        &[
            mandatory("Available", standard::BOOLEAN),
            mandatory("InstallationDate", standard::DATE_TIME),
            mandatory("MonthRemaining", standard::DOUBLE),
            mandatory("ConsumptionRate", standard::DOUBLE),
        ],
    )),
    // 3.2.3.8
    current(object_type(
        ROBOT_ADDITIONAL_INFO,
        "RobotAdditionalInfoType",
        COMPONENT,
        &[mandatory("CurPos", standard::STRING), mandatory("RealPos", standard::STRING)],
    )),
    // 3.2.3.9
    current(object_type(
        AXIS_ADDITIONAL_INFO,
        "AxisAdditionalInfoType",
        COMPONENT,
        &[mandatory("Torque", standard::DOUBLE), mandatory("Hofs", standard::DOUBLE)],
    )),
    // 3.2.3.10
    current(object_type(
        CONTROLLER_STATUS,
        "ControllerStatusType",
        COMPONENT,
        &[
            variables("<StatusIdentifier>", standard::BOOLEAN, standard::MANDATORY_PLACEHOLDER),
            mandatory("StatusCode", standard::UINT16),
            mandatory("CPULoad", standard::DOUBLE),
        ],
    )),
];
