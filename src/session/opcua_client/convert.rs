use chrono::{DateTime, Utc};
use opcua::types::{
    Array, ByteString, DataValue as UaDataValue, EUInformation, ExpandedNodeId, ExtensionObject, Guid,
    Identifier as UaIdentifier, LocalizedText, NodeClass as UaNodeClass, NodeId as UaNodeId,
    QualifiedName as UaQualifiedName, Range, ReferenceDescription, StatusCode, Variant,
};

use crate::model::opcua::{DataValue, Identifier, NodeClass, NodeId, NodeReference, QualifiedName, Quality, Value};

pub(super) fn data_value(from: UaDataValue) -> DataValue {
    DataValue {
        value: from.value.map_or(Value::Null, value),
        quality: quality(from.status.unwrap_or(StatusCode::Good)),
        source_time: from.source_timestamp.and_then(time),
        server_time: from.server_timestamp.and_then(time),
    }
}

pub(super) fn quality(status: StatusCode) -> Quality {
    let name = || status.sub_code().to_string();
    if status.is_bad() {
        Quality::Bad { name: name() }
    } else if status.is_uncertain() {
        Quality::Uncertain { name: name() }
    } else {
        Quality::Good
    }
}

pub(super) fn node_id(from: &UaNodeId) -> NodeId {
    let identifier = match &from.identifier {
        UaIdentifier::Numeric(number) => Identifier::Numeric(*number),
        UaIdentifier::String(text) => Identifier::String(text.as_ref().to_owned()),
        UaIdentifier::Guid(guid) => Identifier::Guid(guid.to_bytes()),
        UaIdentifier::ByteString(bytes) => Identifier::Opaque(bytes.value.clone().unwrap_or_default()),
    };
    NodeId { namespace: from.namespace, identifier }
}

pub(super) fn ua_node_id(from: &NodeId) -> UaNodeId {
    let identifier = match &from.identifier {
        Identifier::Numeric(number) => UaIdentifier::Numeric(*number),
        Identifier::String(text) => UaIdentifier::String(text.as_str().into()),
        Identifier::Guid(guid) => UaIdentifier::Guid(Guid::from_bytes(*guid)),
        Identifier::Opaque(bytes) => UaIdentifier::ByteString(ByteString::from(bytes.clone())),
    };
    UaNodeId { namespace: from.namespace, identifier }
}

pub(super) fn reference(from: ReferenceDescription) -> NodeReference {
    let type_definition = |id: &ExpandedNodeId| (!id.node_id.is_null()).then(|| node_id(&id.node_id));
    NodeReference {
        reference_type: node_id(&from.reference_type_id),
        is_forward: from.is_forward,
        node: node_id(&from.node_id.node_id),
        browse_name: qualified_name(&from.browse_name),
        display_name: from.display_name.text.as_ref().to_owned(),
        node_class: match from.node_class {
            UaNodeClass::Unspecified => NodeClass::Unspecified,
            UaNodeClass::Object => NodeClass::Object,
            UaNodeClass::Variable => NodeClass::Variable,
            UaNodeClass::Method => NodeClass::Method,
            UaNodeClass::ObjectType => NodeClass::ObjectType,
            UaNodeClass::VariableType => NodeClass::VariableType,
            UaNodeClass::ReferenceType => NodeClass::ReferenceType,
            UaNodeClass::DataType => NodeClass::DataType,
            UaNodeClass::View => NodeClass::View,
        },
        type_definition: type_definition(&from.type_definition),
    }
}

fn qualified_name(from: &UaQualifiedName) -> QualifiedName {
    QualifiedName::new(from.namespace_index, from.name.as_ref())
}

fn time(from: opcua::types::DateTime) -> Option<DateTime<Utc>> {
    (!from.is_null()).then(|| from.as_chrono())
}

fn value(from: Variant) -> Value {
    match from {
        Variant::Empty => Value::Null,
        Variant::Boolean(value) => Value::Boolean(value),
        Variant::SByte(value) => Value::SByte(value),
        Variant::Byte(value) => Value::Byte(value),
        Variant::Int16(value) => Value::Int16(value),
        Variant::UInt16(value) => Value::UInt16(value),
        Variant::Int32(value) => Value::Int32(value),
        Variant::UInt32(value) => Value::UInt32(value),
        Variant::Int64(value) => Value::Int64(value),
        Variant::UInt64(value) => Value::UInt64(value),
        Variant::Float(value) => Value::Float(value),
        Variant::Double(value) => Value::Double(value),
        Variant::String(text) if text.is_null() => Value::Null,
        Variant::String(text) => Value::String(text.as_ref().to_owned()),
        Variant::XmlElement(text) => Value::String(text.to_string()),
        Variant::DateTime(at) => Value::DateTime(time(*at)),
        Variant::Guid(guid) => Value::Guid(guid.to_string()),
        Variant::StatusCode(code) => Value::StatusCode(code.sub_code().to_string()),
        Variant::ByteString(bytes) => bytes.value.map_or(Value::Null, Value::ByteString),
        Variant::QualifiedName(name) => Value::QualifiedName(qualified_name(&name)),
        Variant::LocalizedText(text) => {
            Value::LocalizedText { locale: text.locale.as_ref().to_owned(), text: text.text.as_ref().to_owned() }
        }
        Variant::NodeId(id) => Value::NodeId(node_id(&id)),
        Variant::ExpandedNodeId(id) => Value::NodeId(node_id(&id.node_id)),
        Variant::ExtensionObject(object) => structure(&object),
        Variant::Variant(inner) => value(*inner),
        Variant::DataValue(inner) => inner.value.map_or(Value::Null, value),
        Variant::DiagnosticInfo(_) => Value::Structure("DiagnosticInfo".to_owned()),
        Variant::Array(array) => Value::Array(array.values.into_iter().map(value).collect()),
    }
}

fn structure(object: &ExtensionObject) -> Value {
    if let Some(range) = object.inner_as::<Range>() {
        return Value::Range { low: range.low, high: range.high };
    }
    if let Some(unit) = object.inner_as::<EUInformation>() {
        return Value::EngineeringUnits { unit_id: unit.unit_id, symbol: unit.display_name.text.as_ref().to_owned() };
    }
    if object.is_null() {
        return Value::Null;
    }
    let name = object.type_name().and_then(|path| path.rsplit("::").next()).map(str::to_owned);
    Value::Structure(name.unwrap_or_else(|| object.binary_type_id().to_string()))
}

/// The value as the library's; `None` for what this program does not write.
pub(super) fn ua_variant(from: &Value) -> Option<Variant> {
    Some(match from {
        Value::Null => Variant::Empty,
        Value::Boolean(value) => Variant::Boolean(*value),
        Value::SByte(value) => Variant::SByte(*value),
        Value::Byte(value) => Variant::Byte(*value),
        Value::Int16(value) => Variant::Int16(*value),
        Value::UInt16(value) => Variant::UInt16(*value),
        Value::Int32(value) => Variant::Int32(*value),
        Value::UInt32(value) => Variant::UInt32(*value),
        Value::Int64(value) => Variant::Int64(*value),
        Value::UInt64(value) => Variant::UInt64(*value),
        Value::Float(value) => Variant::Float(*value),
        Value::Double(value) => Variant::Double(*value),
        Value::String(text) => Variant::String(text.as_str().into()),
        Value::DateTime(at) => {
            let at = at.map_or_else(opcua::types::DateTime::null, opcua::types::DateTime::from);
            Variant::DateTime(Box::new(at))
        }
        Value::ByteString(bytes) => Variant::ByteString(ByteString::from(bytes.clone())),
        Value::NodeId(id) => Variant::NodeId(Box::new(ua_node_id(id))),
        Value::QualifiedName(name) => {
            Variant::QualifiedName(Box::new(UaQualifiedName::new(name.namespace, name.name.as_str())))
        }
        Value::LocalizedText { locale, text } => Variant::LocalizedText(Box::new(LocalizedText::new(locale, text))),
        Value::Array(elements) => {
            let elements: Vec<Variant> = elements.iter().map(ua_variant).collect::<Option<_>>()?;
            let kind = elements.first()?.scalar_type_id()?;
            Variant::Array(Box::new(Array::new(kind, elements).ok()?))
        }
        Value::Guid(_)
        | Value::StatusCode(_)
        | Value::Range { .. }
        | Value::EngineeringUnits { .. }
        | Value::Structure(_) => return None,
    })
}
