//! Where the work is done that a frame may not wait for.

mod authority;
mod recorder;
mod tokio_backend;
mod trust_files;
mod unfinished;
mod vault;

use std::collections::VecDeque;

use async_trait::async_trait;
use secrecy::SecretString;

use crate::model::Problem;
use crate::workspace::ControllerEntry;

pub use tokio_backend::{BackendOptions, TokioBackend};

pub use super::model::{AuthorityResult, AuthorityWork, BackendCommand, BackendEvent, FileContents, VaultWork};

/// Does [`BackendCommand`]s in the background. Neither call may block.
pub trait Backend {
    /// Begins the work of a command. Its results come as events.
    fn send(&mut self, command: BackendCommand);
    /// The next event, if there is one.
    fn poll(&mut self) -> Option<BackendEvent>;
    /// Whether work goes on that would leave a controller or a file half changed if the program ended now.
    fn has_unfinished_work(&self) -> bool;
}

/// A virtual controller to be added to the list.
#[derive(Debug, Clone)]
pub struct NewVirtualController {
    /// Its entry in the list, with its pinned identity.
    pub entry: ControllerEntry,
    /// Its connection password.
    pub password: SecretString,
}

/// Starts the simulated controllers the welcome page offers.
#[async_trait]
pub trait VirtualFleetStarter: Send + Sync {
    /// Starts them, or returns those that run already. An error: none was started.
    async fn start(&self) -> Result<Vec<NewVirtualController>, Problem>;
}

/// For tests: keeps what was sent and plays back what it is given.
#[derive(Debug, Default)]
pub struct RecordingBackend {
    /// The commands, in the order in which they were sent.
    pub sent: Vec<BackendCommand>,
    /// The events that [`Backend::poll`] gives, the first one first.
    pub events: VecDeque<BackendEvent>,
    /// What [`Backend::has_unfinished_work`] answers.
    pub unfinished_work: bool,
}

impl Backend for RecordingBackend {
    fn send(&mut self, command: BackendCommand) {
        self.sent.push(command);
    }

    fn poll(&mut self) -> Option<BackendEvent> {
        self.events.pop_front()
    }

    fn has_unfinished_work(&self) -> bool {
        self.unfinished_work
    }
}
