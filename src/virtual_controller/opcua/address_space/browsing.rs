use std::collections::VecDeque;

use opcua::nodes::{ReferenceDirection, TypeTree};
use opcua::server::node_manager::{AddReferenceResult, BrowseNode, BrowsePathItem, ExternalReference, NodeMetadata};
use opcua::types::{ExpandedNodeId, NodeId, ReferenceDescription, RelativePathElement, StatusCode};

use super::id::{Id, STANDARD};
use super::node::Node;
use super::table::{Reference, Space};

/// References that did not fit into one response.
struct Rest(VecDeque<ReferenceDescription>);

impl Space {
    /// Adds the references of one node to the answer, from where the last answer ended.
    pub(super) fn browse(&self, tree: &dyn TypeTree, request: &mut BrowseNode) {
        if let Some(mut rest) = request.take_continuation_point::<Rest>() {
            request.set_status(StatusCode::Good);
            while request.remaining() > 0
                && let Some(reference) = rest.0.pop_front()
            {
                // Filtered when it was put there.
                request.add_unchecked(reference);
            }
            if !rest.0.is_empty() {
                request.set_next_continuation_point(rest);
            }
            return;
        }
        let Some(id) = Id::of(request.node_id()) else { return };
        if self.node(id).is_none() && self.references(id).next().is_none() {
            return;
        }
        request.set_status(StatusCode::Good);
        let mut rest = VecDeque::new();
        for reference in self.references(id) {
            let is_wanted = if reference.is_forward { request.allows_forward() } else { request.allows_inverse() };
            if !is_wanted || !request.allows_reference_type(&reference.kind.into(), tree) {
                continue;
            }
            let Some(node) = self.node(reference.other) else {
                let direction =
                    if reference.is_forward { ReferenceDirection::Forward } else { ReferenceDirection::Inverse };
                let target = ExpandedNodeId::new(NodeId::from(reference.other));
                request.push_external_reference(ExternalReference::new(target, reference.kind.into(), direction));
                continue;
            };
            let metadata = self.metadata(reference.other, node);
            let description = metadata.into_ref_desc(reference.is_forward, NodeId::from(reference.kind));
            if let AddReferenceResult::Full(description) = request.add(tree, description) {
                rest.push_back(description);
            }
        }
        if !rest.is_empty() {
            request.set_next_continuation_point(Box::new(Rest(rest)));
        }
    }

    /// What a reference to this node says of it.
    pub(super) fn metadata(&self, id: Id, node: &Node) -> NodeMetadata {
        NodeMetadata {
            node_id: ExpandedNodeId::new(NodeId::from(id)),
            type_definition: self
                .type_definition(id)
                .map_or_else(ExpandedNodeId::null, |definition| ExpandedNodeId::new(NodeId::from(definition))),
            browse_name: node.name.qualified(),
            display_name: node.display_name(),
            node_class: node.node_class(),
        }
    }

    /// Follows a browse path as far as it leads through the nodes of this space.
    pub(super) fn translate(&self, tree: &dyn TypeTree, manager: usize, item: &mut BrowsePathItem) {
        let Some(start) = Id::of(item.node_id()) else { return };
        if let Some(name) = item.unmatched_browse_name() {
            let matches = |node: &Node| name.is_null() || node.name.is(name);
            if !self.node(start).is_some_and(matches) {
                return;
            }
            item.set_browse_name_matched(manager);
        }
        let mut found = Vec::new();
        let mut here = vec![start];
        for (element, depth) in item.path().iter().zip(1..) {
            let mut next = Vec::new();
            let references = here.iter().flat_map(|id| self.references(*id));
            for reference in references.filter(|reference| follows(reference, element, tree)) {
                match self.node(reference.other) {
                    Some(node) => {
                        let is_named = element.target_name.is_null() || node.name.is(&element.target_name);
                        if is_named && !next.contains(&reference.other) {
                            next.push(reference.other);
                            found.push((reference.other, depth, None));
                        }
                    }
                    // Its name is known elsewhere.
                    None if reference.other.namespace == STANDARD => {
                        found.push((reference.other, depth, Some(element.target_name.clone())));
                    }
                    None => {}
                }
            }
            here = next;
        }
        for (id, depth, unmatched) in found {
            item.add_element(id.into(), depth, unmatched);
        }
    }
}

fn follows(reference: &Reference, element: &RelativePathElement, tree: &dyn TypeTree) -> bool {
    if reference.is_forward == element.is_inverse {
        return false;
    }
    if element.reference_type_id.is_null() {
        return true;
    }
    let kind = NodeId::from(reference.kind);
    kind == element.reference_type_id
        || element.include_subtypes && tree.is_subtype_of(&kind, &element.reference_type_id)
}
