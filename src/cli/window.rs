use std::sync::Arc;

use super::virtual_plant::VirtualPlant;
use super::{Ending, Settled, system_language};
use crate::model::{ErrorCode, Language, Problem};
use crate::session::ManagementConnector;
use crate::ui::{self, WindowOptions};
use crate::workspace::{Configuration, KeyringPasswords, Passwords, WorkspaceLock};

/// The window on the workspace.
pub fn run(settled: &Settled, language: Option<Language>) -> Result<Ending, Problem> {
    let lock = settled.workspace.lock()?;
    let loaded = settled.workspace.load()?;
    let mut notice = loaded.notice();
    let mut configuration = loaded.configuration;
    let passwords: Arc<dyn Passwords> = Arc::new(KeyringPasswords::default());
    let plant = VirtualPlant::in_workspace(settled.workspace.root())?;
    if plant.is_inhabited()
        && let Err(problem) = plant.enter(&mut configuration, passwords.as_ref())
    {
        notice.get_or_insert(problem);
    }
    open(settled, language, configuration, lock, passwords, notice, plant)
}

/// Opens the window and waits until it is closed.
pub fn open(
    settled: &Settled,
    language: Option<Language>,
    mut configuration: Configuration,
    lock: WorkspaceLock,
    passwords: Arc<dyn Passwords>,
    notice: Option<Problem>,
    plant: VirtualPlant,
) -> Result<Ending, Problem> {
    if language.is_some() {
        configuration.options.language = language;
    }
    let options = WindowOptions {
        workspace: settled.workspace.clone(),
        lock,
        configuration,
        passwords,
        connector: Arc::new(ManagementConnector::default()),
        starter: Some(plant.starter()),
        language: system_language(),
        notice,
    };
    let closed = ui::run(options).map_err(|e| Problem::with_detail(ErrorCode::NoDisplay, e));
    plant.shutdown();
    closed.map(|()| Ending::AllDone)
}
