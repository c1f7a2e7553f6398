use std::sync::{Arc, OnceLock};

use opcua::nodes::{ImportedItem, NodeSet2Import, NodeSetImport, NodeSetNamespaceMapper};

/// Devices, OPC 10000-100.
pub(super) const DI_NAMESPACE: &str = "http://opcfoundation.org/UA/DI/";

/// A bundled information model, read once in the life of the process.
pub(super) struct NodeSet {
    import: NodeSet2Import,
    namespace: &'static str,
}

impl NodeSet {
    /// The Devices model. Reading it takes a while, so not for an async task.
    pub(super) fn devices() -> Result<Arc<Self>, String> {
        static DEVICES: OnceLock<Result<Arc<NodeSet>, String>> = OnceLock::new();
        DEVICES
            .get_or_init(|| {
                let xml = include_str!("../../../assets/nodesets/Opc.Ua.Di.NodeSet2.xml");
                let import = NodeSet2Import::new_str("en", xml, Vec::new()).map_err(|e| e.to_string())?;
                Ok(Arc::new(Self { import, namespace: DI_NAMESPACE }))
            })
            .clone()
    }
}

impl NodeSetImport for NodeSet {
    /// Not the crate's own version, which prints to standard output.
    fn register_namespaces(&self, namespaces: &mut NodeSetNamespaceMapper) {
        namespaces.add_namespace(self.namespace, 1);
    }

    fn get_own_namespaces(&self) -> Vec<String> {
        vec![self.namespace.to_owned()]
    }

    fn load<'a>(&'a self, namespaces: &'a NodeSetNamespaceMapper) -> Box<dyn Iterator<Item = ImportedItem> + 'a> {
        self.import.load(namespaces)
    }
}
