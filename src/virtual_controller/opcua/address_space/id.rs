use opcua::types::{Identifier, NodeId};

/// A numeric node id. Every node of the controller has one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Id {
    pub(super) namespace: u16,
    pub(super) number: u32,
}

/// Namespace index of OPC UA itself.
pub(super) const STANDARD: u16 = 0;
/// Namespace index of the controller's own nodes; its URI is the ApplicationUri (OPC 10000-5 §7.2).
pub(super) const OWN: u16 = 1;
/// Namespace index of Devices (OPC 10000-100).
pub(super) const DI: u16 = 2;
/// Namespace index of Robotics Part 1 (OPC 40010-1).
pub(super) const ROBOTICS: u16 = 3;

impl Id {
    /// A node of OPC UA itself.
    pub(super) const fn standard(number: u32) -> Self {
        Self { namespace: STANDARD, number }
    }

    /// A node of the controller.
    pub(super) const fn own(number: u32) -> Self {
        Self { namespace: OWN, number }
    }

    /// A node of Devices.
    pub(super) const fn di(number: u32) -> Self {
        Self { namespace: DI, number }
    }

    /// A node of Robotics Part 1.
    pub(super) const fn robotics(number: u32) -> Self {
        Self { namespace: ROBOTICS, number }
    }

    /// `None` for a string, GUID or opaque node id.
    pub(super) fn of(id: &NodeId) -> Option<Self> {
        match id.identifier {
            Identifier::Numeric(number) => Some(Self { namespace: id.namespace, number }),
            _ => None,
        }
    }
}

impl From<Id> for NodeId {
    fn from(id: Id) -> Self {
        Self::new(id.namespace, id.number)
    }
}

/// The nodes of OPC UA itself that the address space refers to (OPC 10000-6, NodeIds).
pub(super) mod standard {
    use super::Id;

    pub(in super::super) const BOOLEAN: Id = Id::standard(1);
    pub(in super::super) const SBYTE: Id = Id::standard(2);
    pub(in super::super) const BYTE: Id = Id::standard(3);
    pub(in super::super) const INT16: Id = Id::standard(4);
    pub(in super::super) const UINT16: Id = Id::standard(5);
    pub(in super::super) const INT32: Id = Id::standard(6);
    pub(in super::super) const UINT32: Id = Id::standard(7);
    pub(in super::super) const INT64: Id = Id::standard(8);
    pub(in super::super) const UINT64: Id = Id::standard(9);
    pub(in super::super) const FLOAT: Id = Id::standard(10);
    pub(in super::super) const DOUBLE: Id = Id::standard(11);
    pub(in super::super) const STRING: Id = Id::standard(12);
    pub(in super::super) const DATE_TIME: Id = Id::standard(13);
    pub(in super::super) const BYTE_STRING: Id = Id::standard(15);
    pub(in super::super) const STRUCTURE: Id = Id::standard(22);
    pub(in super::super) const HAS_MODELLING_RULE: Id = Id::standard(37);
    pub(in super::super) const HAS_ENCODING: Id = Id::standard(38);
    pub(in super::super) const HAS_TYPE_DEFINITION: Id = Id::standard(40);
    pub(in super::super) const HAS_SUBTYPE: Id = Id::standard(45);
    pub(in super::super) const HAS_PROPERTY: Id = Id::standard(46);
    pub(in super::super) const HAS_COMPONENT: Id = Id::standard(47);
    pub(in super::super) const BASE_OBJECT_TYPE: Id = Id::standard(58);
    pub(in super::super) const FOLDER_TYPE: Id = Id::standard(61);
    pub(in super::super) const BASE_DATA_VARIABLE_TYPE: Id = Id::standard(63);
    pub(in super::super) const PROPERTY_TYPE: Id = Id::standard(68);
    pub(in super::super) const MANDATORY: Id = Id::standard(78);
    pub(in super::super) const OPTIONAL_PLACEHOLDER: Id = Id::standard(11_508);
    pub(in super::super) const MANDATORY_PLACEHOLDER: Id = Id::standard(11_510);
    pub(in super::super) const RANGE: Id = Id::standard(884);
    pub(in super::super) const DURATION_STRING: Id = Id::standard(12_879);
}
