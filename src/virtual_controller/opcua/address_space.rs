use std::sync::Arc;

use async_trait::async_trait;
use opcua::nodes::{ObjectBuilder, ObjectTypeBuilder, VariableBuilder};
use opcua::server::address_space::AddressSpace;
use opcua::server::diagnostics::NamespaceMetadata;
use opcua::server::node_manager::memory::InMemoryNodeManagerImpl;
use opcua::server::node_manager::{RequestContext, ServerContext, WriteNode};
use opcua::sync::RwLock;
use opcua::types::{
    DataTypeId, LocalizedText, NodeId, ObjectTypeId, QualifiedName, StatusCode, VariableTypeId, Variant,
};

use super::config::DeviceIdentity;
use super::nodesets::{DI_NAMESPACE, NodeSet};
use crate::model::ServerStatus;

/// The controller's own nodes, in namespace 1, and the information models they build on.
///
/// Namespace 1 is the server's, its URI the ApplicationUri (OPC 10000-5). Its node ids are the path below
/// `Objects/DeviceSet`, joined by dots, so they are the same after every start.
pub(super) struct ControllerNodes {
    namespaces: Vec<NamespaceMetadata>,
}

impl ControllerNodes {
    /// Fills `space`. Must be the first node manager of a server, so that it gets namespace 1.
    pub(super) fn build(
        context: &ServerContext,
        space: &mut AddressSpace,
        devices: &Arc<NodeSet>,
        identity: &DeviceIdentity,
    ) -> Self {
        let uri = context.info.application_uri.to_string();
        let mut types = context.type_tree.write();
        let own = types.namespaces_mut().add_namespace(&uri);
        space.add_namespace(&uri, own);
        space.import_node_set(&**devices, types.namespaces_mut());
        let di = types.namespaces_mut().add_namespace(DI_NAMESPACE);

        Nodes { space, own, di }.controller(identity);

        let namespace = |namespace_uri, namespace_index| NamespaceMetadata {
            namespace_uri,
            namespace_index,
            is_namespace_subset: Some(false),
            ..Default::default()
        };
        Self { namespaces: vec![namespace(uri, own), namespace(DI_NAMESPACE.to_owned(), di)] }
    }
}

#[async_trait]
impl InMemoryNodeManagerImpl for ControllerNodes {
    async fn init(&self, _space: &mut AddressSpace, _context: ServerContext) {}

    fn name(&self) -> &str {
        "controller"
    }

    fn namespaces(&self) -> Vec<NamespaceMetadata> {
        self.namespaces.clone()
    }

    /// Nothing here can be written.
    async fn write(
        &self,
        _context: &RequestContext,
        space: &RwLock<AddressSpace>,
        nodes: &mut [&mut WriteNode],
    ) -> Result<(), StatusCode> {
        let space = space.read();
        for node in nodes {
            let known = space.find_node(&node.value().node_id).is_some();
            node.set_status(if known { StatusCode::BadNotWritable } else { StatusCode::BadNodeIdUnknown });
        }
        Ok(())
    }
}

/// What new nodes are put into, and under which namespace indexes.
struct Nodes<'a> {
    space: &'a mut AddressSpace,
    own: u16,
    di: u16,
}

impl Nodes<'_> {
    fn controller(&mut self, identity: &DeviceIdentity) {
        let device_type = NodeId::new(self.own, "RobotControllerType");
        ObjectTypeBuilder::new(
            &device_type,
            QualifiedName::new(self.own, "RobotControllerType"),
            "RobotControllerType",
        )
        .subtype_of(NodeId::new(self.di, DEVICE_TYPE))
        .insert(self.space);

        let system = self.id(&[SYSTEM]);
        ObjectBuilder::new(&system, QualifiedName::new(self.own, SYSTEM), SYSTEM)
            .component_of(NodeId::new(self.di, DEVICE_SET))
            .has_type_definition(device_type)
            .insert(self.space);

        // Every property DeviceType makes mandatory (OPC 10000-100, 4.7).
        let text = |text: &str| LocalizedText::new("en", text);
        self.property("Manufacturer", DataTypeId::LocalizedText, text(MANUFACTURER));
        self.property("Model", DataTypeId::LocalizedText, text(identity.series.as_str()));
        self.property("SerialNumber", DataTypeId::String, identity.serial.as_str());
        self.property("SoftwareRevision", DataTypeId::String, identity.firmware.to_string());
        self.property("HardwareRevision", DataTypeId::String, "");
        self.property("DeviceRevision", DataTypeId::String, "");
        self.property("DeviceManual", DataTypeId::String, "");
        self.property("RevisionCounter", DataTypeId::Int32, -1);

        let status = self.id(&[SYSTEM, STATUS]);
        ObjectBuilder::new(&status, QualifiedName::new(self.own, STATUS), STATUS)
            .component_of(system)
            .has_type_definition(ObjectTypeId::BaseObjectType)
            .insert(self.space);
        self.status_variable("ControllerName", identity.name.as_str());
        self.status_variable("ServerStatus", ServerStatus::Run.as_str());
    }

    /// One of DI's identity properties of the controller.
    fn property(&mut self, name: &str, data_type: DataTypeId, value: impl Into<Variant>) {
        VariableBuilder::new(&self.id(&[SYSTEM, name]), QualifiedName::new(self.di, name), name)
            .property_of(self.id(&[SYSTEM]))
            .has_type_definition(VariableTypeId::PropertyType)
            .data_type(data_type)
            .value(value)
            .insert(self.space);
    }

    fn status_variable(&mut self, name: &str, value: &str) {
        VariableBuilder::new(&self.id(&[SYSTEM, STATUS, name]), QualifiedName::new(self.own, name), name)
            .component_of(self.id(&[SYSTEM, STATUS]))
            .has_type_definition(VariableTypeId::BaseDataVariableType)
            .data_type(DataTypeId::String)
            .value(value)
            .insert(self.space);
    }

    fn id(&self, path: &[&str]) -> NodeId {
        NodeId::new(self.own, path.join("."))
    }
}

const SYSTEM: &str = "MotionDeviceSystem_0";
const STATUS: &str = "ControllerStatus";

/// Whose controllers the virtual one stands in for.
const MANUFACTURER: &str = "Seiko Epson Corporation";

// Node ids in the Devices NodeSet.
const DEVICE_SET: u32 = 5001;
const DEVICE_TYPE: u32 = 1002;
