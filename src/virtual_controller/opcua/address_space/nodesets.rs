//! The published information models, read from the bundled facts in `assets/nodesets`.

use std::collections::HashMap;
use std::sync::Arc;

use opcua::types::{
    Argument, DataTypeDefinition, DateTime, EnumDefinition, EnumField, ExtensionObject, LocalizedText, NodeId,
    QualifiedName, StructureDefinition, StructureField, StructureType, Variant, VariantScalarTypeId,
};
use serde::{Deserialize, Deserializer, de};
use thiserror::Error;

use super::id::{DI, Id, ROBOTICS, STANDARD, standard};
use super::node::{BrowseName, Class, Node, SCALAR, Variable};
use super::table::Table;
use super::value::Source;

const STANDARD_NAMESPACE: &str = "http://opcfoundation.org/UA/";
/// The namespace of Devices, OPC 10000-100.
pub(super) const DI_NAMESPACE: &str = "http://opcfoundation.org/UA/DI/";
/// The namespace of Robotics Part 1, OPC 40010-1.
pub(super) const ROBOTICS_NAMESPACE: &str = "http://opcfoundation.org/UA/Robotics/";

const DI_FACTS: &str = include_str!("../../../../assets/nodesets/di.json");
const ROBOTICS_FACTS: &str = include_str!("../../../../assets/nodesets/robotics.json");
/// The BrowseName of the encoding that the definition of a structure names (OPC 10000-3 §8.48).
const DEFAULT_BINARY: &str = "Default Binary";

/// Whether a URI is that of one of the information models of the address space.
pub(in super::super) fn is_model_namespace(uri: &str) -> bool {
    [STANDARD_NAMESPACE, DI_NAMESPACE, ROBOTICS_NAMESPACE].contains(&uri)
}

/// A bundled information model that this program cannot read.
#[derive(Debug, Error)]
#[error("the bundled information model {namespace} cannot be read: {source}")]
pub(in super::super) struct NodeSetError {
    namespace: &'static str,
    source: serde_json::Error,
}

/// Adds Devices and Robotics to `table`.
pub(super) fn load(table: &mut Table) -> Result<(), NodeSetError> {
    for (namespace, facts) in [(DI_NAMESPACE, DI_FACTS), (ROBOTICS_NAMESPACE, ROBOTICS_FACTS)] {
        let facts: NodeSet = serde_json::from_str(facts).map_err(|source| NodeSetError { namespace, source })?;
        facts.add_to(table);
    }
    Ok(())
}

#[derive(Deserialize)]
struct NodeSet<'a> {
    #[serde(borrow)]
    nodes: Vec<NodeFacts<'a>>,
    references: Vec<(Key, Key, Key)>,
}

#[derive(Deserialize)]
struct NodeFacts<'a> {
    id: Key,
    class: ClassName,
    #[serde(borrow)]
    name: Name<'a>,
    #[serde(default)]
    display: Option<&'a str>,
    #[serde(default, rename = "abstract")]
    is_abstract: bool,
    #[serde(default)]
    symmetric: bool,
    #[serde(default)]
    inverse: Option<&'a str>,
    #[serde(default)]
    data_type: Option<Key>,
    #[serde(default)]
    rank: Option<i32>,
    #[serde(default)]
    dimensions: Option<Box<[u32]>>,
    #[serde(default, borrow)]
    value: Option<Value<'a>>,
    #[serde(default, borrow)]
    definition: Option<Vec<Field<'a>>>,
}

#[derive(Deserialize, Clone, Copy)]
enum ClassName {
    Object,
    Variable,
    Method,
    ObjectType,
    VariableType,
    ReferenceType,
    DataType,
}

/// A node as `MODEL:NUMBER`.
#[derive(Clone, Copy)]
struct Key(Id);

/// A BrowseName as `MODEL:TEXT`.
struct Name<'a> {
    namespace: u16,
    text: &'a str,
}

/// A field of a structure, or a value of an enumeration.
#[derive(Deserialize)]
struct Field<'a> {
    name: &'a str,
    #[serde(default)]
    value: Option<i64>,
    #[serde(default)]
    data_type: Option<Key>,
    #[serde(default)]
    rank: Option<i32>,
}

#[derive(Deserialize)]
struct Value<'a> {
    #[serde(rename = "type")]
    kind: ValueType,
    #[serde(default, borrow)]
    scalar: Option<Scalar<'a>>,
    #[serde(default, borrow)]
    list: Option<Vec<Scalar<'a>>>,
}

#[derive(Deserialize, Clone, Copy)]
enum ValueType {
    Boolean,
    Int32,
    UInt32,
    String,
    DateTime,
    LocalizedText,
    QualifiedName,
    ExtensionObject,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Scalar<'a> {
    Boolean(bool),
    Number(i64),
    Text(&'a str),
    Argument { name: &'a str, data_type: Key, rank: i32 },
}

impl NodeSet<'_> {
    fn add_to(self, table: &mut Table) {
        for (from, kind, to) in self.references {
            table.refer(from.0, kind.0, to.0);
        }
        let is_encoding = |node: &&NodeFacts| node.name.text == DEFAULT_BINARY;
        let encodings: Vec<Id> = self.nodes.iter().filter(is_encoding).map(|node| node.id.0).collect();
        // Most texts occur more than once.
        let mut texts = HashMap::new();
        for facts in self.nodes {
            let text = texts.entry(facts.name.text).or_insert_with_key(|text| Arc::from(*text));
            let name = BrowseName { namespace: facts.name.namespace, text: Arc::clone(text) };
            let display = facts.display.map(Arc::from);
            let class = facts.class(table, &encodings);
            table.insert(facts.id.0, Node { name, display, class });
        }
    }
}

impl NodeFacts<'_> {
    /// The class with its attributes. `table` has the references of this node already; `encodings` are the binary ones.
    fn class(&self, table: &Table, encodings: &[Id]) -> Class {
        let is_abstract = self.is_abstract;
        let data_type = self.data_type.map_or(Id::standard(24), |key| key.0);
        let rank = self.rank.unwrap_or(SCALAR);
        match self.class {
            ClassName::Object => Class::Object,
            ClassName::Method => Class::Method,
            ClassName::Variable => Class::Variable(Variable {
                data_type,
                rank,
                dimensions: self.dimensions.clone(),
                source: Source::Fixed(self.value.as_ref().map_or(Variant::Empty, Value::variant)),
            }),
            ClassName::ObjectType => Class::ObjectType { is_abstract },
            ClassName::VariableType => Class::VariableType { data_type, rank, is_abstract },
            ClassName::ReferenceType => {
                Class::ReferenceType { is_abstract, symmetric: self.symmetric, inverse: self.inverse.map(Arc::from) }
            }
            ClassName::DataType => Class::DataType {
                is_abstract,
                definition: self
                    .definition
                    .as_ref()
                    .map(|fields| Box::new(definition(self.id.0, fields, table, encodings))),
            },
        }
    }
}

/// The definition of an enumeration or option set, or of a structure.
fn definition(id: Id, fields: &[Field], table: &Table, encodings: &[Id]) -> DataTypeDefinition {
    if fields.iter().any(|field| field.value.is_some()) {
        let fields = fields.iter().map(|field| EnumField {
            value: field.value.unwrap_or_default(),
            display_name: LocalizedText::from(field.name),
            description: LocalizedText::null(),
            name: field.name.into(),
        });
        return DataTypeDefinition::Enum(EnumDefinition { fields: Some(fields.collect()) });
    }
    let encoding = table.targets(id, standard::HAS_ENCODING).find(|id| encodings.contains(id));
    let fields = fields.iter().map(|field| StructureField {
        name: field.name.into(),
        data_type: field.data_type.map_or_else(NodeId::null, |key| key.0.into()),
        value_rank: field.rank.unwrap_or(SCALAR),
        ..Default::default()
    });
    DataTypeDefinition::Structure(StructureDefinition {
        default_encoding_id: encoding.map_or_else(NodeId::null, NodeId::from),
        base_data_type: table.supertype(id).unwrap_or(standard::STRUCTURE).into(),
        structure_type: StructureType::Structure,
        fields: Some(fields.collect()),
    })
}

impl Value<'_> {
    fn variant(&self) -> Variant {
        match (&self.scalar, &self.list) {
            (Some(scalar), _) => scalar.variant(self.kind),
            (None, Some(list)) => {
                let values: Vec<Variant> = list.iter().map(|scalar| scalar.variant(self.kind)).collect();
                Variant::from((self.kind.scalar_type(), values))
            }
            (None, None) => Variant::Empty,
        }
    }
}

impl ValueType {
    fn scalar_type(self) -> VariantScalarTypeId {
        match self {
            Self::Boolean => VariantScalarTypeId::Boolean,
            Self::Int32 => VariantScalarTypeId::Int32,
            Self::UInt32 => VariantScalarTypeId::UInt32,
            Self::String => VariantScalarTypeId::String,
            Self::DateTime => VariantScalarTypeId::DateTime,
            Self::LocalizedText => VariantScalarTypeId::LocalizedText,
            Self::QualifiedName => VariantScalarTypeId::QualifiedName,
            Self::ExtensionObject => VariantScalarTypeId::ExtensionObject,
        }
    }
}

impl Scalar<'_> {
    /// Null where the fact does not fit the type.
    fn variant(&self, kind: ValueType) -> Variant {
        match (kind, self) {
            (ValueType::Boolean, Self::Boolean(value)) => (*value).into(),
            (ValueType::Int32, Self::Number(value)) => i32::try_from(*value).map_or(Variant::Empty, Variant::from),
            (ValueType::UInt32, Self::Number(value)) => u32::try_from(*value).map_or(Variant::Empty, Variant::from),
            (ValueType::String, Self::Text(text)) => (*text).into(),
            (ValueType::DateTime, Self::Text(text)) => {
                DateTime::parse_from_rfc3339(text).map_or(Variant::Empty, Variant::from)
            }
            (ValueType::LocalizedText, Self::Text(text)) => LocalizedText::from(*text).into(),
            (ValueType::QualifiedName, Self::Text(text)) => match split(text) {
                Ok((namespace, text)) => QualifiedName::new(namespace, text).into(),
                Err(_) => Variant::Empty,
            },
            (ValueType::ExtensionObject, Self::Argument { name, data_type, rank }) => {
                let argument = Argument {
                    name: (*name).into(),
                    data_type: data_type.0.into(),
                    value_rank: *rank,
                    // Of any length in each dimension.
                    array_dimensions: usize::try_from(*rank).ok().filter(|rank| *rank > 0).map(|rank| vec![0; rank]),
                    ..Default::default()
                };
                Variant::ExtensionObject(ExtensionObject::from_message(argument))
            }
            _ => Variant::Empty,
        }
    }
}

/// `MODEL:REST` as namespace index and rest.
fn split(text: &str) -> Result<(u16, &str), String> {
    let (model, rest) = text.split_once(':').ok_or_else(|| format!("no model in {text:?}"))?;
    let namespace = match model {
        "ua" => STANDARD,
        "di" => DI,
        "robotics" => ROBOTICS,
        _ => return Err(format!("no model is called {model:?}")),
    };
    Ok((namespace, rest))
}

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = <&str>::deserialize(deserializer)?;
        let (namespace, number) = split(text).map_err(de::Error::custom)?;
        let number = number.parse().map_err(de::Error::custom)?;
        Ok(Self(Id { namespace, number }))
    }
}

impl<'de: 'a, 'a> Deserialize<'de> for Name<'a> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (namespace, text) = split(<&str>::deserialize(deserializer)?).map_err(de::Error::custom)?;
        Ok(Self { namespace, text })
    }
}
