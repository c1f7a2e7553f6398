use crate::jobs::NodeDetails;
use crate::model::Problem;
use crate::model::opcua::{NodeClass, NodeId, NodeReference};

/// The address space as a tree, as far as it was unfolded.
#[derive(Debug)]
pub struct NodeBrowser {
    nodes: Vec<BrowsedNode>,
    /// Indices of the nodes in sight when nothing is scrolled, in their order.
    lines: Vec<usize>,
    selected: Option<usize>,
    /// The attributes of the selected node; `None` while they are read.
    pub details: Option<Result<Box<NodeDetails>, Problem>>,
    /// The tree should scroll to the selected node.
    pub reveal: bool,
}

/// A node at one place of the tree. The same node may be at several places.
#[derive(Debug)]
pub struct BrowsedNode {
    /// Its id.
    pub node: NodeId,
    /// Display name, or else the browse name.
    pub name: String,
    /// What kind of node it is.
    pub class: NodeClass,
    /// Nodes above it.
    pub depth: usize,
    /// What is below it is shown, or is read to be shown.
    pub is_unfolded: bool,
    /// What is below it.
    pub below: ChildrenState,
}

/// What is below a node.
#[derive(Debug, PartialEq)]
pub enum ChildrenState {
    /// It was not asked for.
    Unread,
    /// It was asked for.
    Reading,
    /// Indices of the nodes below, in the order of the server.
    Read(Vec<usize>),
    /// Why it could not be read.
    Failed(Problem),
}

impl Default for NodeBrowser {
    fn default() -> Self {
        let root = BrowsedNode {
            node: NodeId::ROOT_FOLDER,
            name: "Root".to_owned(),
            class: NodeClass::Object,
            depth: 0,
            is_unfolded: false,
            below: ChildrenState::Unread,
        };
        Self { nodes: vec![root], lines: vec![0], selected: None, details: None, reveal: false }
    }
}

impl NodeBrowser {
    /// How many lines the tree has.
    pub fn line_count(&self) -> usize {
        self.lines.len()
    }

    /// The node on a line.
    pub fn line(&self, line: usize) -> Option<&BrowsedNode> {
        self.lines.get(line).map(|index| &self.nodes[*index])
    }

    /// Whether nothing was unfolded yet.
    pub fn is_unread(&self) -> bool {
        self.nodes[0].below == ChildrenState::Unread
    }

    /// The line of the selected node.
    pub fn selected_line(&self) -> Option<usize> {
        let selected = self.selected?;
        self.lines.iter().position(|index| *index == selected)
    }

    /// The selected node.
    pub fn selected(&self) -> Option<&BrowsedNode> {
        self.selected.map(|index| &self.nodes[index])
    }

    /// Selects the node on a line. Returns it if its attributes are to be read.
    pub fn select(&mut self, line: usize) -> Option<NodeId> {
        let index = *self.lines.get(line)?;
        if self.selected == Some(index) {
            return None;
        }
        self.selected = Some(index);
        self.details = None;
        Some(self.nodes[index].node.clone())
    }

    /// Moves the selection by lines; clamped.
    pub fn move_selection(&mut self, by: isize) -> Option<NodeId> {
        let last = self.lines.len().checked_sub(1)?;
        let line = self.selected_line().map_or(0, |line| line.saturating_add_signed(by).min(last));
        self.reveal = true;
        self.select(line)
    }

    /// Unfolds or folds the node on a line. Returns it if what is below is to be read.
    pub fn fold(&mut self, line: usize, unfold: bool) -> Option<NodeId> {
        let index = *self.lines.get(line)?;
        let node = &mut self.nodes[index];
        node.is_unfolded = unfold;
        let is_to_be_read = unfold && matches!(node.below, ChildrenState::Unread | ChildrenState::Failed(_));
        if is_to_be_read {
            node.below = ChildrenState::Reading;
        }
        let id = is_to_be_read.then(|| node.node.clone());
        self.rebuild();
        id
    }

    /// Unfolds the selected node, or moves to its first child.
    pub fn right(&mut self) -> Option<BrowserMove> {
        let line = self.selected_line()?;
        let node = self.line(line)?;
        if node.is_unfolded {
            return self.move_selection(1).map(BrowserMove::Selected);
        }
        self.fold(line, true).map(BrowserMove::Unfolded)
    }

    /// Folds the selected node, or moves to its parent.
    pub fn left(&mut self) -> Option<BrowserMove> {
        let line = self.selected_line()?;
        let node = self.line(line)?;
        if node.is_unfolded {
            self.fold(line, false);
            return None;
        }
        let depth = node.depth;
        let parent = (0..line).rev().find(|above| self.line(*above).is_some_and(|above| above.depth < depth))?;
        self.reveal = true;
        self.select(parent).map(BrowserMove::Selected)
    }

    /// What is below a node was read, or could not be.
    pub fn fill(&mut self, of: &NodeId, children: Result<Vec<NodeReference>, Problem>) {
        let waiting = |node: &BrowsedNode| node.node == *of && node.below == ChildrenState::Reading;
        let places: Vec<usize> = (0..self.nodes.len()).filter(|index| waiting(&self.nodes[*index])).collect();
        for place in places {
            let depth = self.nodes[place].depth + 1;
            self.nodes[place].below = match &children {
                Err(problem) => ChildrenState::Failed(problem.clone()),
                Ok(children) => {
                    let first = self.nodes.len();
                    self.nodes.extend(children.iter().map(|child| BrowsedNode {
                        node: child.node.clone(),
                        name: match child.display_name.is_empty() {
                            true => child.browse_name.name.clone(),
                            false => child.display_name.clone(),
                        },
                        class: child.node_class,
                        depth,
                        is_unfolded: false,
                        below: ChildrenState::Unread,
                    }));
                    ChildrenState::Read((first..self.nodes.len()).collect())
                }
            };
        }
        self.rebuild();
    }

    /// What was being read when the connection was lost is to be read again.
    pub fn forget_reading(&mut self) {
        for node in self.nodes.iter_mut().filter(|node| node.below == ChildrenState::Reading) {
            node.below = ChildrenState::Unread;
            node.is_unfolded = false;
        }
        self.rebuild();
    }

    fn rebuild(&mut self) {
        let mut lines = Vec::new();
        let mut next = vec![0];
        while let Some(index) = next.pop() {
            lines.push(index);
            let node = &self.nodes[index];
            if let ChildrenState::Read(children) = &node.below
                && node.is_unfolded
            {
                next.extend(children.iter().rev());
            }
        }
        self.lines = lines;
    }
}

/// What moving in the tree with the arrow keys asks for.
#[derive(Debug, Clone, PartialEq)]
pub enum BrowserMove {
    /// The attributes of this node are to be read.
    Selected(NodeId),
    /// What is below this node is to be read.
    Unfolded(NodeId),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ErrorCode;
    use crate::model::opcua::QualifiedName;

    fn child(number: u32, name: &str) -> NodeReference {
        NodeReference {
            reference_type: NodeId::numeric(0, 35),
            is_forward: true,
            node: NodeId::numeric(1, number),
            browse_name: QualifiedName::new(1, name),
            display_name: String::new(),
            node_class: NodeClass::Object,
            type_definition: None,
        }
    }

    fn names(browser: &NodeBrowser) -> Vec<String> {
        let line = |at: usize| browser.line(at).map(|node| format!("{}{}", " ".repeat(node.depth), node.name));
        (0..browser.line_count()).filter_map(line).collect()
    }

    #[test]
    fn what_is_below_a_node_is_read_once_when_it_is_unfolded() {
        let mut browser = NodeBrowser::default();
        assert_eq!(browser.fold(0, true), Some(NodeId::ROOT_FOLDER));
        browser.fill(&NodeId::ROOT_FOLDER, Ok(vec![child(1, "a"), child(2, "b")]));
        assert_eq!(names(&browser), ["Root", " a", " b"]);
        assert_eq!(browser.fold(1, true), Some(NodeId::numeric(1, 1)));
        browser.fill(&NodeId::numeric(1, 1), Ok(vec![child(3, "c")]));
        assert_eq!(names(&browser), ["Root", " a", "  c", " b"]);
        assert_eq!(browser.fold(0, false), None);
        assert_eq!(names(&browser), ["Root"]);
        assert_eq!(browser.fold(0, true), None, "read before");
        assert_eq!(names(&browser), ["Root", " a", "  c", " b"]);
    }

    #[test]
    fn a_failed_node_is_read_again_when_it_is_unfolded_again() {
        let mut browser = NodeBrowser::default();
        browser.fold(0, true);
        browser.fill(&NodeId::ROOT_FOLDER, Err(ErrorCode::Timeout.into()));
        assert!(matches!(browser.line(0).unwrap().below, ChildrenState::Failed(_)));
        assert_eq!(browser.fold(0, true), Some(NodeId::ROOT_FOLDER));
        browser.forget_reading();
        assert!(browser.is_unread());
    }

    #[test]
    fn the_arrow_keys_move_through_the_tree() {
        let mut browser = NodeBrowser::default();
        assert_eq!(browser.move_selection(1), Some(NodeId::ROOT_FOLDER), "the first line first");
        assert_eq!(browser.right(), Some(BrowserMove::Unfolded(NodeId::ROOT_FOLDER)));
        browser.fill(&NodeId::ROOT_FOLDER, Ok(vec![child(1, "a"), child(2, "b")]));
        assert_eq!(browser.right(), Some(BrowserMove::Selected(NodeId::numeric(1, 1))));
        assert_eq!(browser.move_selection(isize::MAX), Some(NodeId::numeric(1, 2)));
        assert_eq!(browser.left(), Some(BrowserMove::Selected(NodeId::ROOT_FOLDER)));
        assert_eq!(browser.left(), None);
        assert_eq!(names(&browser), ["Root"]);
    }
}
