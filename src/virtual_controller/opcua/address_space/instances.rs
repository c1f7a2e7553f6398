use std::sync::Arc;

use opcua::types::Variant;

use super::id::{Id, STANDARD, standard};
use super::ids::Ids;
use super::node::{BrowseName, Class, Node, Variable};
use super::table::Table;
use super::value::Source;

/// Makes nodes after types: each with its type's mandatory members, and with the optional ones it is asked for.
pub(super) struct Instances<'a> {
    types: &'a Table,
    table: Table,
    ids: Ids,
}

/// A node of the controller.
#[derive(Debug, Clone)]
pub(super) struct Instance {
    pub(super) id: Id,
    /// The BrowseNames from the motion device system down to this node, with slashes between them.
    path: String,
    /// The nodes that declare the members: the type with its supertypes, or the declarations of this node in them.
    declared: Vec<Id>,
}

impl<'a> Instances<'a> {
    pub(super) fn new(types: &'a Table) -> Self {
        Self { types, table: Table::default(), ids: Ids::default() }
    }

    pub(super) fn finish(mut self) -> Table {
        self.table.shrink();
        self.table
    }

    /// Adds an object below a node of another table.
    pub(super) fn root(&mut self, parent: Id, name: BrowseName, type_definition: Id) -> Instance {
        let path = name.text.to_string();
        self.make(parent, standard::HAS_COMPONENT, path, name, Class::Object, type_definition)
    }

    /// Adds an object of `type_definition` as a component of `parent`.
    pub(super) fn object(&mut self, parent: &Instance, name: BrowseName, type_definition: Id) -> Instance {
        let path = format!("{}/{}", parent.path, name.text);
        self.make(parent.id, standard::HAS_COMPONENT, path, name, Class::Object, type_definition)
    }

    /// Adds a scalar variable as a component of `parent`.
    pub(super) fn variable(&mut self, parent: &Instance, name: BrowseName, data_type: Id, source: Source) -> Instance {
        let path = format!("{}/{}", parent.path, name.text);
        let class = Class::Variable(Variable::scalar(data_type, source));
        self.make(parent.id, standard::HAS_COMPONENT, path, name, class, standard::BASE_DATA_VARIABLE_TYPE)
    }

    /// The member at `path`, BrowseNames with slashes between them; an optional one that is not there yet is made. `None`
    /// if the type declares no such member.
    pub(super) fn member(&mut self, of: &Instance, path: &str) -> Option<Instance> {
        let mut node = of.clone();
        for name in path.split('/') {
            node = self.child(&node, name)?;
        }
        Some(node)
    }

    /// Gives the variable at `path` below `of` its value, as [`Instances::member`] finds it.
    pub(super) fn set(&mut self, of: &Instance, path: &str, source: Source) {
        let member = self.member(of, path);
        debug_assert!(member.is_some(), "{}/{path} is not declared", of.path);
        if let Some(member) = member
            && let Some(Class::Variable(variable)) = self.table.node_mut(member.id).map(|node| &mut node.class)
        {
            variable.source = source;
        }
    }

    /// As [`Instances::set`], for a value that does not change.
    pub(super) fn set_fixed(&mut self, of: &Instance, path: &str, value: impl Into<Variant>) {
        self.set(of, path, Source::Fixed(value.into()));
    }

    /// Adds a property of OPC UA itself that no type declares for this variable.
    pub(super) fn property(&mut self, of: &Instance, name: &'static str, data_type: Id, value: Variant) {
        let path = format!("{}/{name}", of.path);
        let class = Class::Variable(Variable::scalar(data_type, Source::Fixed(value)));
        let name = BrowseName::new(STANDARD, name);
        self.make(of.id, standard::HAS_PROPERTY, path, name, class, standard::PROPERTY_TYPE);
    }

    /// Adds a reference from one node of the controller to another.
    pub(super) fn refer(&mut self, from: &Instance, kind: Id, to: &Instance) {
        self.table.refer(from.id, kind, to.id);
    }

    fn make(
        &mut self,
        parent: Id,
        reference: Id,
        path: String,
        name: BrowseName,
        class: Class,
        type_definition: Id,
    ) -> Instance {
        let id = self.ids.of(&path);
        self.table.insert(id, Node::new(name, class));
        self.table.refer(parent, reference, id);
        self.table.refer(id, standard::HAS_TYPE_DEFINITION, type_definition);
        let instance = Instance { id, path, declared: self.lineage(type_definition) };
        self.add_mandatory_members(&instance);
        instance
    }

    /// The type and its supertypes as far as the table of types has them.
    fn lineage(&self, type_definition: Id) -> Vec<Id> {
        std::iter::successors(Some(type_definition), |id| self.types.supertype(*id))
            .filter(|id| self.types.contains(*id))
            .collect()
    }

    fn add_mandatory_members(&mut self, instance: &Instance) {
        let types = self.types;
        for declaring in &instance.declared {
            for (_, declaration) in members(types, *declaring) {
                let rule = types.targets(declaration, standard::HAS_MODELLING_RULE).next();
                if rule == Some(standard::MANDATORY)
                    && let Some(node) = types.node(declaration)
                {
                    self.child(instance, &node.name.text);
                }
            }
        }
    }

    /// The member with this BrowseName, made if it is declared and not there.
    fn child(&mut self, of: &Instance, name: &str) -> Option<Instance> {
        let types = self.types;
        let declarations: Vec<(Id, Id)> = of
            .declared
            .iter()
            .flat_map(|declaring| members(types, *declaring))
            .filter(|(_, declaration)| types.node(*declaration).is_some_and(|node| &*node.name.text == name))
            .collect();
        let (reference, declaration) = *declarations.first()?;
        let type_definition = types.targets(declaration, standard::HAS_TYPE_DEFINITION).next();
        let mut declared: Vec<Id> = declarations.iter().map(|(_, declaration)| *declaration).collect();
        declared.extend(type_definition.into_iter().flat_map(|definition| self.lineage(definition)));
        let path = format!("{}/{name}", of.path);
        let existing = self
            .table
            .references(of.id)
            .iter()
            .find(|r| r.is_forward && self.table.node(r.other).is_some_and(|node| &*node.name.text == name))
            .map(|r| r.other);
        if let Some(id) = existing {
            return Some(Instance { id, path, declared });
        }
        let node = types.node(declaration)?;
        let class = match &node.class {
            Class::Object => Class::Object,
            Class::Variable(declared) => Class::Variable(Variable {
                data_type: declared.data_type,
                rank: declared.rank,
                dimensions: declared.dimensions.clone(),
                source: Source::NULL,
            }),
            _ => return None,
        };
        let id = self.ids.of(&path);
        let name = BrowseName { namespace: node.name.namespace, text: Arc::clone(&node.name.text) };
        self.table.insert(id, Node::new(name, class));
        self.table.refer(of.id, reference, id);
        if let Some(definition) = type_definition {
            self.table.refer(id, standard::HAS_TYPE_DEFINITION, definition);
        }
        let instance = Instance { id, path, declared };
        self.add_mandatory_members(&instance);
        Some(instance)
    }
}

/// The members a type or a declaration declares, with the references to them.
fn members(types: &Table, declaring: Id) -> impl Iterator<Item = (Id, Id)> {
    types
        .references(declaring)
        .iter()
        .filter(|r| r.is_forward && (r.kind == standard::HAS_COMPONENT || r.kind == standard::HAS_PROPERTY))
        .map(|r| (r.kind, r.other))
}
