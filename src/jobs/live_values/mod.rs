//! The values of a controller's OPC UA server as they change: robots, safety, tasks, I/O, variables, consumables,
//! status.
//!
//! | file | contents |
//! |---|---|
//! | `tree` | [`NodeTree`]: the nodes below DeviceSet as they were browsed |
//! | `explore` | browses a server into a [`NodeTree`], bounded |
//! | `layout` | [`LiveLayout`]: which node is which value of a robot, task, signal … |
//! | `arrange` | finds the parts of a [`LiveLayout`] in a [`NodeTree`] |
//! | `consumed` | the nodes that reading changes, which are never read here |
//! | `request` | [`LiveRequest`] and [`LiveEvent`]: what the watch is asked, and what it reports |
//! | `serve` | answers requests in an open session, and reports values |
//! | `watch` | [`watch_values`]: finds the server, connects, connects again |

mod arrange;
mod consumed;
mod explore;
mod layout;
mod request;
#[cfg(test)]
mod samples;
mod serve;
mod tree;
mod watch;

pub use consumed::is_consumed_by_reading;
pub use layout::{
    AxisPoints, ConsumablePoints, ControllerPoints, IoGroupPoints, IoSignalPoint, LiveLayout, LivePoint, QueueKind,
    QueuePoints, QueueSystemPoints, RobotPoints, SafetyPoints, SpelProjectPoints, StatusPoints, TaskPoints,
};
pub use request::{LiveEvent, LiveRequest, NodeDetails};
pub use watch::{LiveLogin, watch_values};
