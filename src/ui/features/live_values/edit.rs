//! Writing a value on purpose.

use crate::model::Problem;
use crate::model::opcua::{NodeId, Quality, Value};
use crate::ui::model::JobId;

/// A value that is to be written into a node.
#[derive(Debug)]
pub struct EditValue {
    pub(super) watch: JobId,
    /// The node.
    pub node: NodeId,
    /// The name of the node.
    pub name: String,
    /// BrowseName of the data type.
    pub data_type: String,
    /// What the node has now.
    pub before: Value,
    /// As it is typed.
    pub text: String,
    /// It was sent and is not answered yet.
    pub is_writing: bool,
    /// Why the last write did not succeed.
    pub refusal: Option<Result<Quality, Problem>>,
}

impl EditValue {
    /// The value that is typed; `None` if it is none of the type.
    pub fn typed(&self) -> Option<Value> {
        let kind = of_type(&self.data_type).unwrap_or_else(|| self.before.clone());
        kind.parse_as(&self.text).filter(|_| !self.text.trim().is_empty())
    }

    /// Whether values of this type can be typed.
    pub fn takes(data_type: &str, before: &Value) -> bool {
        of_type(data_type).is_some_and(|kind| kind.parse_as("1").is_some()) || before.parse_as("1").is_some()
    }
}

/// Any value of a built-in type (OPC 10000-6 §5.1.2); `None` for a type whose values cannot be typed.
fn of_type(data_type: &str) -> Option<Value> {
    Some(match data_type {
        "Boolean" => Value::Boolean(false),
        "SByte" => Value::SByte(0),
        "Byte" => Value::Byte(0),
        "Int16" => Value::Int16(0),
        "UInt16" => Value::UInt16(0),
        "Int32" => Value::Int32(0),
        "UInt32" => Value::UInt32(0),
        "Int64" => Value::Int64(0),
        "UInt64" => Value::UInt64(0),
        "Float" => Value::Float(0.0),
        "Double" => Value::Double(0.0),
        "String" => Value::String(String::new()),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::model::JobId;

    fn typed(data_type: &str, before: Value, text: &str) -> Option<Value> {
        let edit = EditValue {
            watch: JobId(1),
            node: NodeId::numeric(1, 20_313),
            name: "DataNum".into(),
            data_type: data_type.into(),
            before,
            text: text.into(),
            is_writing: false,
            refusal: None,
        };
        edit.typed()
    }

    #[test]
    fn a_value_is_of_the_type_of_its_node_also_when_the_node_has_none() {
        assert_eq!(typed("UInt16", Value::Null, "200"), Some(Value::UInt16(200)));
        assert_eq!(typed("UInt16", Value::UInt16(1), "70000"), None);
        assert_eq!(typed("Boolean", Value::Boolean(false), "true"), Some(Value::Boolean(true)));
        assert_eq!(typed("Double", Value::Null, " "), None);
        assert_eq!(typed("VendorsNumber", Value::Int32(1), "-7"), Some(Value::Int32(-7)), "a subtype");
    }

    #[test]
    fn what_cannot_be_typed_is_not_offered() {
        assert!(EditValue::takes("UInt16", &Value::Null) && EditValue::takes("VendorsNumber", &Value::Int32(1)));
        assert!(!EditValue::takes("ByteString", &Value::Null) && !EditValue::takes("EUInformation", &Value::Null));
    }
}
