//! The whole address space, walked by the clients of other projects, and judged against its own types and the published
//! NodeSets.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use opcua_xml::schema::ua_node_set::{UANode, load_nodeset2_file};
use serde::Deserialize;

use super::cell::Cell;
use super::peers::{Node as NodePeer, Python, answer, skip};

/// What a walker wrote of one node; see `walk.py`.
#[derive(Deserialize)]
struct Node {
    id: String,
    #[serde(default)]
    class: String,
    #[serde(default)]
    name: String,
    error: Option<String>,
    data_type: Option<String>,
    rank: Option<i32>,
    value: Option<String>,
    references: Vec<(String, bool, String)>,
}

struct Walk(BTreeMap<String, Node>);

const HAS_MODELLING_RULE: &str = "i=37";
const HAS_TYPE_DEFINITION: &str = "i=40";
const HAS_SUBTYPE: &str = "i=45";
const MANDATORY: &str = "i=78";

#[test]
fn asyncua_finds_every_type_member_and_reference_of_both_firmware_generations() {
    let Some(python) = Python::find() else { return };
    for (firmware, more) in [("current", &[][..]), ("legacy", &[]), ("current", &["--virtual-io"])] {
        let cell = running_cell(firmware, more);
        let output = cell.folder().join("walk.jsonl");
        let mut walker = python.script("walk.py");
        walker.args(["--url", cell.opcua(), "--output"]).arg(&output);
        let walked = answer(&mut walker);
        assert_eq!(walked["ok"], true, "{walked}");
        Walk::load(&output).judge();
    }
}

#[test]
fn node_opcua_finds_every_type_member_and_reference_and_the_published_node_sets() {
    let Some(peer) = NodePeer::find() else { return };
    let node_sets = node_sets();
    for firmware in ["current", "legacy"] {
        let cell = running_cell(firmware, &[]);
        let output = cell.folder().join("walk.jsonl");
        let walked = answer(peer.script("walk.mjs").arg(cell.opcua()).arg(&output));
        assert_eq!(walked["ok"], true, "{walked}");
        let walk = Walk::load(&output);
        walk.judge();
        if let Some(folder) = &node_sets {
            walk.compare("ns=2", &folder.join("Opc.Ua.Di.NodeSet2.xml"), &["", "2"]);
            walk.compare("ns=3", &folder.join("Opc.Ua.Robotics.NodeSet2.xml"), &["", "3", "2"]);
        }
    }
}

/// A controller with robots of both kinds, whose server is open to everybody.
fn running_cell(firmware: &str, more: &[&str]) -> Cell {
    let cell = Cell::start_with(firmware, &[&["--robots", "C4-A601S,GX4-A251S"], more].concat());
    cell.make_certificate("2048", 1);
    cell.set("None", "anonymous");
    cell.run(&["start"]);
    cell
}

/// The folder of the published NodeSets, in the version the program is made from; see `assets/nodesets/README.md`.
fn node_sets() -> Option<PathBuf> {
    let modules = std::env::var_os("OPCUA_INTEROP_NODE_MODULES")?;
    let folder = PathBuf::from(modules).join("node-opcua-nodesets/nodesets");
    if folder.is_dir() {
        return Some(folder);
    }
    skip("node-opcua-nodesets", "`npm install node-opcua-nodesets@2.157.0` beside node-opcua-client");
    None
}

impl Walk {
    fn load(file: &Path) -> Self {
        let text = fs::read_to_string(file).expect("the walker's file");
        let nodes = text.lines().map(|line| serde_json::from_str::<Node>(line).expect("a line of the walker"));
        Self(nodes.map(|node| (node.id.clone(), node)).collect())
    }

    fn judge(&self) {
        let instances: Vec<&Node> = self.0.values().filter(|node| node.is_instance()).collect();
        assert!(instances.len() > 300, "only {} instances", instances.len());
        for node in self.0.values().filter(|node| !node.is_standard()) {
            self.judge_references(node);
        }
        for node in instances {
            self.judge_type(node);
        }
    }

    /// Every reference leads to a node that exists, and back where it is hierarchical.
    fn judge_references(&self, node: &Node) {
        assert_eq!(node.error, None, "{}", node.id);
        for (kind, is_forward, other) in &node.references {
            let other = self.existing(other, node);
            assert_eq!(self.existing(kind, node).class, "ReferenceType", "{}", node.id);
            if kind != HAS_TYPE_DEFINITION && kind != HAS_MODELLING_RULE {
                let back = (kind.clone(), !is_forward, node.id.clone());
                assert!(other.references.contains(&back), "{} does not refer back: {back:?}", other.id);
            }
        }
    }

    fn existing(&self, id: &str, from: &Node) -> &Node {
        let node = self.0.get(id).unwrap_or_else(|| panic!("{} refers to {id}, which was not walked", from.id));
        assert_eq!(node.error, None, "{} refers to {id}", from.id);
        node
    }

    /// The type is one, and the node has every mandatory member that it and its supertypes declare.
    fn judge_type(&self, node: &Node) {
        let definitions: Vec<&str> = node.targets(HAS_TYPE_DEFINITION).collect();
        let [definition] = definitions[..] else { panic!("{} has the types {definitions:?}", node.id) };
        let mut definition = self.existing(definition, node);
        assert_eq!(definition.class, format!("{}Type", node.class), "{}", node.id);
        if node.class == "Variable" {
            let value = node.value.as_deref().unwrap_or_default();
            assert!(!value.starts_with("Bad") && node.data_type.is_some(), "{}: {value}", node.id);
        }
        let mut seen = 0;
        loop {
            self.judge_members(node, definition);
            let Some(supertype) = definition.sources(HAS_SUBTYPE).next() else { break };
            definition = self.existing(supertype, node);
            seen += 1;
            assert!(seen < 20, "the supertypes of {} do not end", node.id);
        }
    }

    fn judge_members(&self, node: &Node, declaring: &Node) {
        for (kind, is_forward, id) in &declaring.references {
            let declaration = self.existing(id, declaring);
            if !is_forward || !declaration.targets(HAS_MODELLING_RULE).any(|rule| rule == MANDATORY) {
                continue;
            }
            let members = node.references.iter().filter(|(k, forward, _)| *forward && k == kind);
            let member = members
                .map(|(_, _, id)| self.existing(id, node))
                .find(|member| member.name == declaration.name)
                .unwrap_or_else(|| panic!("{} {} has no {}", node.id, node.name, declaration.name));
            assert_eq!(member.class, declaration.class, "{}", member.id);
            assert_eq!((&member.data_type, member.rank), (&declaration.data_type, declaration.rank), "{}", member.id);
            self.judge_members(member, declaration);
        }
    }

    /// The nodes of a namespace are those of its NodeSet, with their classes, BrowseNames and references. `indexes` are the
    /// server's for the NodeSet's. The deprecated type dictionaries are not served.
    fn compare(&self, namespace: &str, file: &Path, indexes: &[&str]) {
        let published = NodeSet::load(file, indexes);
        let served: BTreeSet<&str> =
            self.0.keys().filter(|id| id.starts_with(&format!("{namespace};"))).map(String::as_str).collect();
        let ids: BTreeSet<&str> = published.nodes.keys().map(String::as_str).collect();
        assert_eq!(served, ids, "{}", file.display());
        for (id, (class, name)) in &published.nodes {
            let node = &self.0[id];
            assert_eq!((&node.class, &node.name), (class, name), "{id}");
        }
        for (from, kind, to) in &published.references {
            let reference = (kind.clone(), true, to.clone());
            assert!(self.0[from].references.contains(&reference), "{from} lacks {reference:?}");
        }
    }
}

impl Node {
    fn is_standard(&self) -> bool {
        !self.id.starts_with("ns=")
    }

    /// An object or variable of the controller, which declares nothing.
    fn is_instance(&self) -> bool {
        let declares = self.targets(HAS_MODELLING_RULE).next().is_some();
        self.id.starts_with("ns=1;") && ["Object", "Variable"].contains(&&*self.class) && !declares
    }

    fn targets<'a>(&'a self, kind: &'a str) -> impl Iterator<Item = &'a str> {
        self.references.iter().filter(move |(k, forward, _)| *forward && k == kind).map(|(_, _, id)| id.as_str())
    }

    fn sources<'a>(&'a self, kind: &'a str) -> impl Iterator<Item = &'a str> {
        self.references.iter().filter(move |(k, forward, _)| !forward && k == kind).map(|(_, _, id)| id.as_str())
    }
}

/// A published NodeSet without its type dictionaries, in the server's namespace indexes.
struct NodeSet {
    /// Class and BrowseName by id.
    nodes: BTreeMap<String, (String, String)>,
    references: BTreeSet<(String, String, String)>,
}

impl NodeSet {
    fn load(file: &Path, indexes: &[&str]) -> Self {
        let text = fs::read_to_string(file).expect("a NodeSet");
        let document = load_nodeset2_file(text.trim_start_matches('\u{feff}')).expect("a NodeSet");
        let published = document.node_set.expect("a UANodeSet");
        let aliases: BTreeMap<String, String> = published
            .aliases
            .into_iter()
            .flat_map(|table| table.aliases)
            .map(|alias| (alias.alias, alias.id.0))
            .collect();
        let id = |text: &str| served_id(aliases.get(text).map_or(text, String::as_str), indexes);
        let mut nodes = BTreeMap::new();
        let mut references = BTreeSet::new();
        for node in &published.nodes {
            let base = node.base();
            let from = id(&base.node_id.0);
            nodes.insert(from.clone(), (class(node).to_owned(), served_name(&base.browse_name.0, indexes)));
            for reference in base.references.iter().flat_map(|list| &list.references) {
                let (kind, other) = (id(&reference.reference_type.0), id(&reference.node_id.0));
                let ends = if reference.is_forward { (from.clone(), kind, other) } else { (other, kind, from.clone()) };
                references.insert(ends);
            }
        }
        Self { nodes, references }.without_dictionaries()
    }

    fn without_dictionaries(mut self) -> Self {
        let is_dictionary = |(from, kind, to): &(String, String, String)| {
            (kind == HAS_TYPE_DEFINITION && DICTIONARY_TYPES.contains(&&**to)).then(|| from.clone())
        };
        let mut dropped: BTreeSet<String> = self.references.iter().filter_map(is_dictionary).collect();
        loop {
            let below = self.references.iter().filter(|(from, kind, to)| {
                dropped.contains(from) && PARENTS.contains(&&**kind) && !dropped.contains(to)
            });
            let below: Vec<String> = below.map(|(_, _, to)| to.clone()).collect();
            if below.is_empty() {
                break;
            }
            dropped.extend(below);
        }
        self.nodes.retain(|id, _| !dropped.contains(id));
        self.references.retain(|(from, kind, to)| {
            // What only leads to a dictionary, and what OPC UA's own nodes refer to.
            kind != HAS_DESCRIPTION && self.nodes.contains_key(from) && !dropped.contains(to)
        });
        self
    }
}

/// DataTypeDescriptionType and DataTypeDictionaryType.
const DICTIONARY_TYPES: [&str; 2] = ["i=69", "i=72"];
const HAS_DESCRIPTION: &str = "i=39";
/// HasProperty and HasComponent.
const PARENTS: [&str; 2] = ["i=46", "i=47"];

fn class(node: &UANode) -> &'static str {
    match node {
        UANode::Object(_) => "Object",
        UANode::Variable(_) => "Variable",
        UANode::Method(_) => "Method",
        UANode::View(_) => "View",
        UANode::ObjectType(_) => "ObjectType",
        UANode::VariableType(_) => "VariableType",
        UANode::DataType(_) => "DataType",
        UANode::ReferenceType(_) => "ReferenceType",
    }
}

/// `ns=1;i=5` of a NodeSet with the server's index of the namespace.
fn served_id(id: &str, indexes: &[&str]) -> String {
    match id.strip_prefix("ns=").and_then(|rest| rest.split_once(';')) {
        Some((index, rest)) => format!("ns={};{rest}", indexes[index.parse::<usize>().expect("an index")]),
        None => id.to_owned(),
    }
}

/// `1:Name` of a NodeSet with the server's index of the namespace.
fn served_name(name: &str, indexes: &[&str]) -> String {
    match name.split_once(':') {
        Some((index, rest)) if index.len() == 1 => {
            format!("{}:{rest}", indexes[index.parse::<usize>().expect("an index")])
        }
        _ => format!("0:{name}"),
    }
}
