use std::sync::Arc;
use std::time::Duration;

use async_trait::async_trait;
use opcua::nodes::DefaultTypeTree;
use opcua::server::CreateMonitoredItem;
use opcua::server::diagnostics::NamespaceMetadata;
use opcua::server::node_manager::{
    AddNodeItem, AddReferenceItem, BrowseNode, BrowsePathItem, DeleteNodeItem, DeleteReferenceItem, DynNodeManager,
    ExternalReferenceRequest, HistoryNode, HistoryUpdateNode, MethodCall, MonitoredItemRef, MonitoredItemUpdateRef,
    NodeManager, NodeManagerBuilder, QueryRequest, ReadNode, RegisterNodeItem, RequestContext, ServerContext,
    WriteNode,
};
use opcua::types::{
    ExpandedNodeId, MonitoringMode, NodeId, ReadAnnotationDataDetails, ReadAtTimeDetails, ReadEventDetails,
    ReadProcessedDetails, ReadRawModifiedDetails, StatusCode, TimestampsToReturn,
};

use super::gate::Gate;

/// A node manager that serves only sessions that the gate has checked.
///
/// The OPC UA crate does not compare the certificate of CreateSession with that of the secure channel, nor the client's
/// ApplicationUri with its certificate (OPC 10000-4 §5.6.2). Here every service that reaches a node does, and so does
/// the activation of a session, which asks every node manager for its namespaces. A client that finds the port
/// behind the gate has no channel that the gate knows, and is refused as well.
pub(in super::super) struct GuardedNodeManager {
    inner: Arc<DynNodeManager>,
    gate: Arc<Gate>,
}

impl GuardedNodeManager {
    /// Gives a function that builds what `builder` builds, guarded.
    pub(in super::super) fn builder(
        builder: impl NodeManagerBuilder + 'static,
        gate: Arc<Gate>,
    ) -> impl FnOnce(ServerContext) -> Self + 'static {
        move |context| Self { inner: Box::new(builder).build(context), gate }
    }

    fn check(&self, context: &RequestContext) -> Result<(), StatusCode> {
        // It is never held for long; the crate does not hold it where it calls a node manager.
        let session = context.session().try_read_for(WAIT_LIMIT).ok_or(StatusCode::BadTooManyOperations)?;
        self.gate.vouch(session.session_id_numeric(), session.secure_channel_id(), || {
            let certificate = session.client_certificate().and_then(|certificate| certificate.to_der().ok());
            (certificate, session.application_description().application_uri.to_string())
        })
    }
}

const WAIT_LIMIT: Duration = Duration::from_secs(1);

/// Methods that pass a request on once its session was checked.
macro_rules! checked {
    ($($method:ident($($name:ident: $type:ty),*);)*) => {
        #[async_trait]
        impl NodeManager for GuardedNodeManager {
            fn owns_node(&self, id: &NodeId) -> bool {
                self.inner.owns_node(id)
            }

            fn name(&self) -> &str {
                self.inner.name()
            }

            fn owns_server_events(&self) -> bool {
                self.inner.owns_server_events()
            }

            fn handle_new_node(&self, parent_id: &ExpandedNodeId) -> bool {
                self.inner.handle_new_node(parent_id)
            }

            fn namespaces_for_user(&self, context: &RequestContext) -> Vec<NamespaceMetadata> {
                match self.check(context) {
                    Ok(()) => self.inner.namespaces_for_user(context),
                    Err(_) => Vec::new(),
                }
            }

            async fn init(&self, type_tree: &mut DefaultTypeTree, context: ServerContext) {
                self.inner.init(type_tree, context).await;
            }

            async fn resolve_external_references(
                &self,
                context: &RequestContext,
                items: &mut [&mut ExternalReferenceRequest],
            ) {
                if self.check(context).is_ok() {
                    self.inner.resolve_external_references(context, items).await;
                }
            }

            async fn modify_monitored_items(&self, context: &RequestContext, items: &[&MonitoredItemUpdateRef]) {
                if self.check(context).is_ok() {
                    self.inner.modify_monitored_items(context, items).await;
                }
            }

            async fn set_monitoring_mode(
                &self,
                context: &RequestContext,
                mode: MonitoringMode,
                items: &[&MonitoredItemRef],
            ) {
                if self.check(context).is_ok() {
                    self.inner.set_monitoring_mode(context, mode, items).await;
                }
            }

            /// Always: a connection that ends takes its items with it.
            async fn delete_monitored_items(&self, context: &RequestContext, items: &[&MonitoredItemRef]) {
                self.inner.delete_monitored_items(context, items).await;
            }

            async fn delete_node_references(&self, context: &RequestContext, to_delete: &[&DeleteNodeItem]) {
                if self.check(context).is_ok() {
                    self.inner.delete_node_references(context, to_delete).await;
                }
            }

            $(async fn $method(&self, context: &RequestContext, $($name: $type),*) -> Result<(), StatusCode> {
                self.check(context)?;
                self.inner.$method(context, $($name),*).await
            })*
        }
    };
}

checked! {
    read(max_age: f64, timestamps_to_return: TimestampsToReturn, nodes_to_read: &mut [&mut ReadNode]);
    history_read_raw_modified(
        details: &ReadRawModifiedDetails,
        nodes: &mut [&mut HistoryNode],
        timestamps_to_return: TimestampsToReturn
    );
    history_read_processed(
        details: &ReadProcessedDetails,
        nodes: &mut [&mut HistoryNode],
        timestamps_to_return: TimestampsToReturn
    );
    history_read_at_time(
        details: &ReadAtTimeDetails,
        nodes: &mut [&mut HistoryNode],
        timestamps_to_return: TimestampsToReturn
    );
    history_read_events(
        details: &ReadEventDetails,
        nodes: &mut [&mut HistoryNode],
        timestamps_to_return: TimestampsToReturn
    );
    history_read_annotations(
        details: &ReadAnnotationDataDetails,
        nodes: &mut [&mut HistoryNode],
        timestamps_to_return: TimestampsToReturn
    );
    write(nodes_to_write: &mut [&mut WriteNode]);
    history_update(nodes: &mut [&mut HistoryUpdateNode]);
    browse(nodes_to_browse: &mut [BrowseNode]);
    translate_browse_paths_to_node_ids(nodes: &mut [&mut BrowsePathItem]);
    register_nodes(nodes: &mut [&mut RegisterNodeItem]);
    unregister_nodes(nodes: &[&NodeId]);
    create_monitored_items(items: &mut [&mut CreateMonitoredItem]);
    query(request: &mut QueryRequest);
    call(methods_to_call: &mut [&mut MethodCall]);
    add_nodes(nodes_to_add: &mut [&mut AddNodeItem]);
    add_references(references_to_add: &mut [&mut AddReferenceItem]);
    delete_nodes(nodes_to_delete: &mut [&mut DeleteNodeItem]);
    delete_references(references_to_delete: &mut [&mut DeleteReferenceItem]);
}
