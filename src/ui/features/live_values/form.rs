use std::collections::HashMap;

use super::browser::NodeBrowser;
use super::plot::LivePlot;
use super::section::LiveSection;
use crate::jobs::{LiveLayout, LivePoint};
use crate::model::opcua::{DataValue, NodeClass, NodeId, Value};
use crate::model::{Problem, UserCredential, UserName, UserPassword};
use crate::texts::TextKey as T;
use crate::ui::model::{JobId, RowId, SecretInput};

/// Whether the values are those that the server has now.
#[derive(Debug, Clone, PartialEq)]
pub enum LiveConnection {
    /// Nothing has come yet.
    Connecting,
    /// The values are current.
    Live,
    /// It is connected again.
    Lost(Problem),
    /// It is not connected again by itself.
    Ended(Problem),
}

/// What the OPC UA server of one controller shows.
#[derive(Debug)]
pub struct LiveForm {
    /// The row of the controller.
    pub row: RowId,
    /// The name of the controller.
    pub name: String,
    /// Whether the values are current.
    pub link: LiveConnection,
    /// `None`: the server was not reached yet.
    pub layout: Option<Box<LiveLayout>>,
    /// The open tab.
    pub section: LiveSection,
    /// The group of signals that is shown: index into [`LiveLayout::io`].
    pub io_group: usize,
    /// The tree of the tab for all nodes.
    pub browser: NodeBrowser,
    /// The values of the tab for the plot.
    pub plot: LivePlot,
    /// As it is typed; empty: anonymous.
    pub user: String,
    /// As it is typed; wiped when it was used.
    pub password: SecretInput,
    /// The password is shown in clear.
    pub show_password: bool,
    /// The fields for the login are shown.
    pub asks_for_login: bool,
    /// Who is logged in; `None`: anonymous.
    pub(super) login: Option<UserCredential>,
    /// The running watch.
    pub(super) watch: Option<JobId>,
    /// The variables that the watch was asked for last.
    pub(super) asked: Vec<NodeId>,
    values: HashMap<NodeId, DataValue>,
}

impl LiveForm {
    /// The dialog before anything was read.
    pub fn new(row: RowId, name: String) -> Self {
        Self {
            row,
            name,
            link: LiveConnection::Connecting,
            layout: None,
            section: LiveSection::Robot,
            io_group: 0,
            browser: NodeBrowser::default(),
            plot: LivePlot::default(),
            user: String::new(),
            password: SecretInput::default(),
            show_password: false,
            asks_for_login: false,
            login: None,
            watch: None,
            asked: Vec::new(),
            values: HashMap::new(),
        }
    }

    /// Whether the values are those that the server has now.
    pub fn is_live(&self) -> bool {
        self.link == LiveConnection::Live
    }

    /// The last value of a variable.
    pub fn value(&self, node: &NodeId) -> Option<&DataValue> {
        self.values.get(node)
    }

    /// The last value of a variable, if it is usable.
    pub fn good(&self, point: &Option<LivePoint>) -> Option<&Value> {
        let value = self.values.get(&point.as_ref()?.node)?;
        (!value.quality.is_bad() && value.value != Value::Null).then_some(&value.value)
    }

    /// The last value of each variable that was reported.
    pub fn values(&self) -> &HashMap<NodeId, DataValue> {
        &self.values
    }

    pub(super) fn take_in(&mut self, node: NodeId, value: DataValue) {
        self.values.insert(node, value);
    }

    pub(super) fn forget_values(&mut self) {
        self.values.clear();
    }

    /// The user that is logged in; `None`: anonymous.
    pub fn logged_in(&self) -> Option<&UserName> {
        self.login.as_ref().map(|login| &login.name)
    }

    /// Who is to log in; why nobody can with what is typed.
    pub fn typed_login(&self) -> Result<Option<UserCredential>, T> {
        if self.user.is_empty() && self.password.0.is_empty() {
            return Ok(None);
        }
        // The password is wiped once it was used.
        let again = self.login.as_ref().filter(|login| login.name.as_str() == self.user && self.password.0.is_empty());
        if again.is_some() {
            return Ok(again.cloned());
        }
        let name = self.user.parse::<UserName>().map_err(|_| T::UserRule)?;
        let password = UserPassword::new(&self.password.0).map_err(|_| T::UserRule)?;
        Ok(Some(UserCredential { name, password }))
    }

    /// The variables whose values are needed now: what the tab shows, and what is plotted.
    pub fn wanted(&self) -> Vec<NodeId> {
        let shown = self.layout.as_ref().map(|layout| self.section.nodes(layout, self.io_group)).unwrap_or_default();
        let selected = self.inspected_variable().filter(|_| self.section == LiveSection::Nodes);
        let mut wanted: Vec<NodeId> = shown.into_iter().chain(selected).chain(self.plot.nodes().cloned()).collect();
        wanted.sort_unstable();
        wanted.dedup();
        wanted
    }

    /// The variable whose attributes are shown, unless each read takes away what it returns.
    fn inspected_variable(&self) -> Option<NodeId> {
        let selected = self.browser.selected().filter(|node| node.class == NodeClass::Variable)?;
        let details = self.browser.details.as_ref()?.as_ref().ok()?;
        (!details.is_consumed_by_reading).then(|| selected.node.clone())
    }

    /// The node whose attributes are shown as a variable to be plotted; why not.
    pub fn plottable(&self) -> Result<LivePoint, T> {
        let node = self.inspected_variable().ok_or(T::LiveNotNumeric)?;
        if !self.plot.holds(&node) && self.plot.is_full() {
            return Err(T::LivePlotFull);
        }
        let is_number = |value: &DataValue| value.value.as_f64().is_some();
        self.value(&node).filter(|value| is_number(value)).ok_or(T::LiveNotNumeric)?;
        let known = self.layout.as_ref().and_then(|layout| layout.points().find(|point| point.node == node));
        let name = self.browser.selected().map(|node| node.name.clone()).unwrap_or_default();
        Ok(known.cloned().unwrap_or(LivePoint { node, name, unit: None, range: None }))
    }
}
