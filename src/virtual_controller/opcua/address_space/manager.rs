use std::sync::Arc;
use std::time::Duration;

use async_trait::async_trait;
use opcua::nodes::DefaultTypeTree;
use opcua::server::CreateMonitoredItem;
use opcua::server::diagnostics::NamespaceMetadata;
use opcua::server::node_manager::{
    BrowseNode, BrowsePathItem, ExternalReferenceRequest, MethodCall, MonitoredItemRef, MonitoredItemUpdateRef,
    NodeManager, ParsedReadValueId, ReadNode, RequestContext, ServerContext, WriteNode,
};
use opcua::types::{
    AttributeId, DataEncoding, DataValue, DateTime, MonitoringMode, NodeId, NumericRange, StatusCode,
    TimestampsToReturn,
};

use super::budget::LongestResponse;
use super::id::{DI, Id, OWN, ROBOTICS};
use super::nodesets::{DI_NAMESPACE, ROBOTICS_NAMESPACE};
use super::reading::{Queues, Reading};
use super::sampler::{Sample, Sampler};
use super::table::Space;
use super::types::{self, Types};
use super::value::Source;
use super::{budget, system, writing};
use crate::virtual_controller::cell::CellHandle;

/// Serves the nodes of one controller and of the information models they build on.
pub(in super::super) struct ControllerNodes {
    nodes: Arc<Nodes>,
    sampler: Sampler,
    namespaces: Vec<NamespaceMetadata>,
    longest_response: Box<LongestResponse>,
}

/// The nodes with their values.
struct Nodes {
    space: Space,
    cell: CellHandle,
    started: DateTime,
}

impl ControllerNodes {
    /// Makes the nodes of `cell` after `types`. Must be the first node manager of a server: it takes the namespace indexes
    /// from 1 on, and the ApplicationUri must be none of the URIs of the information models.
    pub(in super::super) fn new(
        context: &ServerContext,
        types: Types,
        cell: CellHandle,
        longest_response: Box<LongestResponse>,
    ) -> Self {
        let own_uri = context.info.application_uri.to_string();
        let mut tree = context.type_tree.write();
        let mut metadata = |uri: &str, index: u16| {
            let given = tree.namespaces_mut().add_namespace(uri);
            debug_assert_eq!(given, index, "{uri}");
            NamespaceMetadata {
                namespace_uri: uri.to_owned(),
                namespace_index: index,
                is_namespace_subset: Some(false),
                ..Default::default()
            }
        };
        let namespaces =
            vec![metadata(&own_uri, OWN), metadata(DI_NAMESPACE, DI), metadata(ROBOTICS_NAMESPACE, ROBOTICS)];
        drop(tree);
        let space = system::space(types, &cell.description());
        let nodes = Arc::new(Nodes { space, cell, started: DateTime::now() });
        Self { nodes, sampler: Sampler::new(), namespaces, longest_response }
    }

    fn reading(&self) -> Reading<'_> {
        self.nodes.reading(DateTime::now())
    }
}

impl Nodes {
    fn reading(&self, now: DateTime) -> Reading<'_> {
        Reading::new(&self.space, &self.cell, self.started, now)
    }
}

impl Sample for Nodes {
    fn sample(&self, nodes: &[Id], now: DateTime) -> Vec<Option<DataValue>> {
        let reading = self.reading(now);
        let value = |id: &Id| {
            let (value, time) = reading.value(self.space.node(*id)?.variable()?);
            Some(DataValue::new_at(value, time))
        };
        nodes.iter().map(value).collect()
    }
}

#[async_trait]
impl NodeManager for ControllerNodes {
    fn owns_node(&self, id: &NodeId) -> bool {
        matches!(id.namespace, OWN | DI | ROBOTICS)
    }

    fn name(&self) -> &str {
        "controller"
    }

    fn namespaces_for_user(&self, _context: &RequestContext) -> Vec<NamespaceMetadata> {
        self.namespaces.clone()
    }

    async fn init(&self, tree: &mut DefaultTypeTree, context: ServerContext) {
        types::register(&self.nodes.space.types, tree);
        let nodes: Arc<dyn Sample> = self.nodes.clone();
        self.sampler.run(Arc::downgrade(&nodes), context.subscriptions);
    }

    async fn resolve_external_references(
        &self,
        _context: &RequestContext,
        items: &mut [&mut ExternalReferenceRequest],
    ) {
        for item in items {
            let space = &self.nodes.space;
            if let Some(id) = Id::of(item.node_id())
                && let Some(node) = space.node(id)
            {
                item.set(space.metadata(id, node));
            }
        }
    }

    async fn read(
        &self,
        context: &RequestContext,
        _max_age: f64,
        timestamps: TimestampsToReturn,
        requests: &mut [&mut ReadNode],
    ) -> Result<(), StatusCode> {
        let mut queues =
            Queues::Take { budget: budget::of_response(context, &*self.longest_response, requests.len())? };
        let reading = self.reading();
        for request in requests {
            let result = reading.read(request.node(), timestamps, &mut queues);
            request.set_result(result);
        }
        Ok(())
    }

    async fn write(&self, context: &RequestContext, requests: &mut [&mut WriteNode]) -> Result<(), StatusCode> {
        for request in requests {
            let result = writing::write(&self.nodes.space, &self.nodes.cell, request.value());
            request.set_status(result.err().unwrap_or(StatusCode::Good));
            if result.is_ok() {
                let id = &request.value().node_id;
                let value = self.reading().read(&value_of(id), TimestampsToReturn::Both, &mut Queues::Leave);
                context.subscriptions.notify_data_change([(value, id, AttributeId::Value)].into_iter());
            }
        }
        Ok(())
    }

    async fn call(&self, _context: &RequestContext, calls: &mut [&mut MethodCall]) -> Result<(), StatusCode> {
        for call in calls {
            let exists = Id::of(call.object_id()).is_some_and(|id| self.nodes.space.node(id).is_some());
            call.set_status(if exists { StatusCode::BadMethodInvalid } else { StatusCode::BadNodeIdUnknown });
        }
        Ok(())
    }

    async fn browse(&self, context: &RequestContext, requests: &mut [BrowseNode]) -> Result<(), StatusCode> {
        let tree = context.type_tree.read();
        for request in requests {
            self.nodes.space.browse(&*tree, request);
        }
        Ok(())
    }

    async fn translate_browse_paths_to_node_ids(
        &self,
        context: &RequestContext,
        items: &mut [&mut BrowsePathItem],
    ) -> Result<(), StatusCode> {
        let tree = context.type_tree.read();
        for item in items {
            self.nodes.space.translate(&*tree, context.current_node_manager_index, item);
        }
        Ok(())
    }

    async fn create_monitored_items(
        &self,
        _context: &RequestContext,
        items: &mut [&mut CreateMonitoredItem],
    ) -> Result<(), StatusCode> {
        let reading = self.reading();
        for item in items {
            let monitored = item.item_to_monitor();
            let value = reading.read(monitored, item.timestamps_to_return(), &mut Queues::Leave);
            if value.status().is_bad() {
                item.set_status(value.status());
                continue;
            }
            if let Some(id) = self.sampled(monitored) {
                self.sampler.add(id, item.handle(), interval(item.sampling_interval()), item.monitoring_mode());
            }
            item.set_initial_value(value);
            item.set_status(StatusCode::Good);
        }
        Ok(())
    }

    async fn modify_monitored_items(&self, _context: &RequestContext, items: &[&MonitoredItemUpdateRef]) {
        for item in items {
            if let Some(id) = Id::of(item.node_id()) {
                self.sampler.set_interval(id, item.handle(), interval(item.update().revised_sampling_interval));
            }
        }
    }

    async fn set_monitoring_mode(&self, _context: &RequestContext, mode: MonitoringMode, items: &[&MonitoredItemRef]) {
        for item in items {
            if let Some(id) = Id::of(item.node_id()) {
                self.sampler.set_mode(id, item.handle(), mode);
            }
        }
    }

    async fn delete_monitored_items(&self, _context: &RequestContext, items: &[&MonitoredItemRef]) {
        for item in items {
            if let Some(id) = Id::of(item.node_id()) {
                self.sampler.remove(id, item.handle());
            }
        }
    }
}

impl ControllerNodes {
    /// The node of a monitored item whose value changes by itself.
    fn sampled(&self, monitored: &ParsedReadValueId) -> Option<Id> {
        let id = Id::of(&monitored.node_id).filter(|_| monitored.attribute_id == AttributeId::Value)?;
        let variable = self.nodes.space.node(id)?.variable()?;
        matches!(variable.source, Source::Live(_) | Source::Setting(_)).then_some(id)
    }
}

fn value_of(id: &NodeId) -> ParsedReadValueId {
    ParsedReadValueId {
        node_id: id.clone(),
        attribute_id: AttributeId::Value,
        index_range: NumericRange::None,
        data_encoding: DataEncoding::Binary,
    }
}

fn interval(millis: f64) -> Duration {
    Duration::try_from_secs_f64(millis / 1000.0).unwrap_or_default()
}
