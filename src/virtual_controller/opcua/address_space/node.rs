use std::sync::Arc;

use opcua::nodes::AccessLevel;
use opcua::types::{
    AttributeId, DataTypeDefinition, ExtensionObject, LocalizedText, NodeClass, NodeId, QualifiedName, StatusCode,
    Variant,
};

use super::id::Id;
use super::value::Source;

/// One node: its attributes (OPC 10000-3 §5), without its references.
#[derive(Debug)]
pub(super) struct Node {
    pub(super) name: BrowseName,
    /// The DisplayName where it is not the text of the BrowseName.
    pub(super) display: Option<Arc<str>>,
    pub(super) class: Class,
}

/// A BrowseName. Instances share the text with the type they are made of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct BrowseName {
    pub(super) namespace: u16,
    pub(super) text: Arc<str>,
}

impl BrowseName {
    pub(super) fn new(namespace: u16, text: impl Into<Arc<str>>) -> Self {
        Self { namespace, text: text.into() }
    }

    pub(super) fn qualified(&self) -> QualifiedName {
        QualifiedName::new(self.namespace, &*self.text)
    }

    pub(super) fn is(&self, name: &QualifiedName) -> bool {
        self.namespace == name.namespace_index && name.name.as_ref() == &*self.text
    }
}

/// The NodeClass with the attributes only nodes of this class have.
#[derive(Debug)]
pub(super) enum Class {
    Object,
    Variable(Variable),
    Method,
    ObjectType { is_abstract: bool },
    VariableType { data_type: Id, rank: i32, is_abstract: bool },
    ReferenceType { is_abstract: bool, symmetric: bool, inverse: Option<Arc<str>> },
    DataType { is_abstract: bool, definition: Option<Box<DataTypeDefinition>> },
}

/// The attributes of a variable.
#[derive(Debug)]
pub(super) struct Variable {
    pub(super) data_type: Id,
    /// -1 for a scalar, 1 for a list.
    pub(super) rank: i32,
    pub(super) dimensions: Option<Box<[u32]>>,
    pub(super) source: Source,
}

impl Variable {
    pub(super) fn scalar(data_type: Id, source: Source) -> Self {
        Self { data_type, rank: SCALAR, dimensions: None, source }
    }

    pub(super) fn access_level(&self) -> AccessLevel {
        if self.source.is_writable() {
            AccessLevel::CURRENT_READ | AccessLevel::CURRENT_WRITE
        } else {
            AccessLevel::CURRENT_READ
        }
    }
}

/// The ValueRank of a value that is no array.
pub(super) const SCALAR: i32 = -1;

impl Node {
    pub(super) fn new(name: BrowseName, class: Class) -> Self {
        Self { name, display: None, class }
    }

    pub(super) fn node_class(&self) -> NodeClass {
        match self.class {
            Class::Object => NodeClass::Object,
            Class::Variable(_) => NodeClass::Variable,
            Class::Method => NodeClass::Method,
            Class::ObjectType { .. } => NodeClass::ObjectType,
            Class::VariableType { .. } => NodeClass::VariableType,
            Class::ReferenceType { .. } => NodeClass::ReferenceType,
            Class::DataType { .. } => NodeClass::DataType,
        }
    }

    pub(super) fn variable(&self) -> Option<&Variable> {
        match &self.class {
            Class::Variable(variable) => Some(variable),
            _ => None,
        }
    }

    /// The DisplayName, which is the same in every locale.
    pub(super) fn display_name(&self) -> LocalizedText {
        LocalizedText::from(&**self.display.as_ref().unwrap_or(&self.name.text))
    }

    /// Every attribute but Value. `BadAttributeIdInvalid` if the node does not have it.
    pub(super) fn attribute(&self, id: Id, attribute: AttributeId) -> Result<Variant, StatusCode> {
        Ok(match (attribute, &self.class) {
            (AttributeId::NodeId, _) => NodeId::from(id).into(),
            (AttributeId::NodeClass, _) => (self.node_class() as i32).into(),
            (AttributeId::BrowseName, _) => self.name.qualified().into(),
            (AttributeId::DisplayName, _) => self.display_name().into(),
            (AttributeId::WriteMask | AttributeId::UserWriteMask, _) => 0_u32.into(),
            (AttributeId::EventNotifier, Class::Object) => 0_u8.into(),
            (AttributeId::Executable | AttributeId::UserExecutable, Class::Method) => true.into(),
            (
                AttributeId::IsAbstract,
                Class::ObjectType { is_abstract }
                | Class::VariableType { is_abstract, .. }
                | Class::ReferenceType { is_abstract, .. }
                | Class::DataType { is_abstract, .. },
            ) => (*is_abstract).into(),
            (AttributeId::Symmetric, Class::ReferenceType { symmetric, .. }) => (*symmetric).into(),
            (AttributeId::InverseName, Class::ReferenceType { inverse: Some(inverse), .. }) => {
                LocalizedText::from(&**inverse).into()
            }
            (AttributeId::DataTypeDefinition, Class::DataType { definition: Some(definition), .. }) => {
                match &**definition {
                    DataTypeDefinition::Structure(definition) => {
                        Variant::ExtensionObject(ExtensionObject::from_message(definition.clone()))
                    }
                    DataTypeDefinition::Enum(definition) => {
                        Variant::ExtensionObject(ExtensionObject::from_message(definition.clone()))
                    }
                }
            }
            (AttributeId::DataType, Class::Variable(Variable { data_type, .. }))
            | (AttributeId::DataType, Class::VariableType { data_type, .. }) => NodeId::from(*data_type).into(),
            (AttributeId::ValueRank, Class::Variable(Variable { rank, .. }) | Class::VariableType { rank, .. }) => {
                (*rank).into()
            }
            (AttributeId::ArrayDimensions, Class::Variable(Variable { dimensions: Some(dimensions), .. })) => {
                dimensions.to_vec().into()
            }
            (AttributeId::AccessLevel | AttributeId::UserAccessLevel, Class::Variable(variable)) => {
                variable.access_level().bits().into()
            }
            (AttributeId::MinimumSamplingInterval, Class::Variable(variable)) => {
                variable.source.minimum_sampling_interval().into()
            }
            (AttributeId::Historizing, Class::Variable(_)) => false.into(),
            _ => return Err(StatusCode::BadAttributeIdInvalid),
        })
    }
}
