//! The SPEL project (manual 3.2.3.3, 4.2).

use opcua::types::Variant;

use super::id::{Id, OWN, standard};
use super::instances::{Instance, Instances};
use super::node::BrowseName;
use super::value::Source;
use super::vendor_types;
use crate::virtual_controller::cell::{CellDescription, SpelType, SpelValue};

/// Adds the project with its backup variables.
pub(super) fn add(space: &mut Instances, components: &Instance, cell: &CellDescription) {
    let project = space.object(components, BrowseName::new(OWN, "SpelProject"), vendor_types::SPEL_PROJECT);
    space.set_fixed(&project, "SpelProjectName", &*cell.project);
    let folder = space.object(&project, BrowseName::new(OWN, "BackupVariables"), vendor_types::SPEL_VARIABLE);
    for (at, variable) in cell.variables.iter().enumerate() {
        let value = Source::live(move |cell| cell.variables.get(at).map_or(Variant::Empty, variant));
        space.variable(&folder, BrowseName::new(OWN, &*variable.name), data_type(variable.kind), value);
    }
}

/// The manual's table of types (3.2.3.3).
const fn data_type(kind: SpelType) -> Id {
    match kind {
        SpelType::Boolean => standard::BOOLEAN,
        SpelType::Byte => standard::SBYTE,
        SpelType::Short | SpelType::Integer => standard::INT16,
        SpelType::Long | SpelType::Int32 => standard::INT32,
        SpelType::Int64 => standard::INT64,
        SpelType::UByte => standard::BYTE,
        SpelType::UShort => standard::UINT16,
        SpelType::UInt32 => standard::UINT32,
        SpelType::UInt64 => standard::UINT64,
        SpelType::Real => standard::FLOAT,
        SpelType::Double => standard::DOUBLE,
        SpelType::String => standard::STRING,
    }
}

fn variant(value: &SpelValue) -> Variant {
    match value {
        SpelValue::Boolean(value) => (*value).into(),
        SpelValue::Int8(value) => (*value).into(),
        SpelValue::Int16(value) => (*value).into(),
        SpelValue::Int32(value) => (*value).into(),
        SpelValue::Int64(value) => (*value).into(),
        SpelValue::UInt8(value) => (*value).into(),
        SpelValue::UInt16(value) => (*value).into(),
        SpelValue::UInt32(value) => (*value).into(),
        SpelValue::UInt64(value) => (*value).into(),
        SpelValue::Float(value) => (*value).into(),
        SpelValue::Double(value) => (*value).into(),
        SpelValue::String(value) => (&**value).into(),
    }
}
