use crate::jobs::{
    IoGroupPoints, LiveLayout, LivePoint, RobotPoints, SafetyPoints, SpelProjectPoints, StatusPoints, TaskPoints,
};
use crate::model::opcua::NodeId;
use crate::texts::TextKey as T;

/// A tab of the dialog.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LiveSection {
    /// Robots with their axes.
    Robot,
    /// Safety states and tasks.
    Safety,
    /// I/O as lamps.
    Io,
    /// SPEL variables.
    Variables,
    /// Parts that wear.
    Consumables,
    /// Controllers, status flags, force sensor and motion log.
    Status,
    /// The address space.
    Nodes,
    /// Values over time.
    Plot,
}

impl LiveSection {
    /// In the order they are shown.
    pub const ALL: [Self; 8] = [
        Self::Robot,
        Self::Safety,
        Self::Io,
        Self::Variables,
        Self::Consumables,
        Self::Status,
        Self::Nodes,
        Self::Plot,
    ];

    /// What the tab says.
    pub const fn title(self) -> T {
        match self {
            Self::Robot => T::LiveRobot,
            Self::Safety => T::LiveSafety,
            Self::Io => T::LiveIo,
            Self::Variables => T::LiveVariables,
            Self::Consumables => T::LiveConsumables,
            Self::Status => T::LiveStatus,
            Self::Nodes => T::LiveNodes,
            Self::Plot => T::LivePlot,
        }
    }

    /// The tab so many tabs further, around the ends.
    pub fn turned(self, by: isize) -> Self {
        let at = Self::ALL.iter().position(|section| *section == self).unwrap_or_default();
        Self::ALL[(at as isize + by).rem_euclid(Self::ALL.len() as isize) as usize]
    }

    /// The variables that it shows. `io`: the group of signals that is chosen.
    pub fn nodes(self, layout: &LiveLayout, io: usize) -> Vec<NodeId> {
        let node = |point: &LivePoint| point.node.clone();
        match self {
            Self::Robot => layout.robots.iter().flat_map(RobotPoints::points).map(node).collect(),
            Self::Safety => {
                let safety = layout.safety.iter().flat_map(SafetyPoints::points);
                let tasks = layout.tasks.iter().flat_map(TaskPoints::points);
                safety.chain(tasks).map(node).collect()
            }
            Self::Io => layout.io.get(io).into_iter().flat_map(IoGroupPoints::points).map(node).collect(),
            Self::Variables => layout.projects.iter().flat_map(SpelProjectPoints::points).map(node).collect(),
            Self::Consumables => layout.consumables.iter().flat_map(|part| part.points()).map(node).collect(),
            Self::Status => {
                let controllers = layout.controllers.iter().flat_map(|controller| &controller.points);
                let status = layout.status.iter().flat_map(StatusPoints::points);
                let queues = layout.queues.iter().flat_map(|system| system.points());
                controllers.chain(status).chain(queues).map(node).collect()
            }
            Self::Nodes | Self::Plot => Vec::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabs_are_turned_around_the_ends() {
        assert_eq!(LiveSection::Plot.turned(1), LiveSection::Robot);
        assert_eq!(LiveSection::Robot.turned(-1), LiveSection::Plot);
        assert_eq!(LiveSection::Io.turned(1), LiveSection::Variables);
    }
}
