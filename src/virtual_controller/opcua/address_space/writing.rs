use opcua::server::node_manager::ParsedWriteValue;
use opcua::types::{AttributeId, StatusCode, Variant};

use super::id::Id;
use super::table::Space;
use super::value::Source;
use crate::virtual_controller::cell::{CellHandle, SettingRefusal};

/// Writes one attribute, whole or not at all. Only the values of settings can be written, and only with a value of exactly
/// their data type.
pub(super) fn write(space: &Space, cell: &CellHandle, request: &ParsedWriteValue) -> Result<(), StatusCode> {
    let id = Id::of(&request.node_id).ok_or(StatusCode::BadNodeIdUnknown)?;
    let node = space.node(id).ok_or(StatusCode::BadNodeIdUnknown)?;
    if request.attribute_id != AttributeId::Value {
        let exists = node.attribute(id, request.attribute_id).is_ok();
        return Err(if exists { StatusCode::BadNotWritable } else { StatusCode::BadAttributeIdInvalid });
    }
    let variable = node.variable().ok_or(StatusCode::BadAttributeIdInvalid)?;
    let Source::Setting(setting) = variable.source else { return Err(StatusCode::BadNotWritable) };
    // A setting has no parts, and its quality is not the client's to say.
    if request.index_range.has_range() || request.value.status.is_some_and(|status| status != StatusCode::Good) {
        return Err(StatusCode::BadWriteNotSupported);
    }
    let value = request.value.value.as_ref().unwrap_or(&Variant::Empty);
    let settings = setting.changes(value).ok_or(StatusCode::BadTypeMismatch)?;
    for setting in settings {
        cell.write(setting).map_err(|refusal| match refusal {
            SettingRefusal::OutOfRange => StatusCode::BadOutOfRange,
            SettingRefusal::NotWritable => StatusCode::BadNotWritable,
        })?;
    }
    Ok(())
}
