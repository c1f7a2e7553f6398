use std::sync::Arc;
use std::time::{Duration, Instant};

use serde_json::json;

use super::virtual_fleet_host::VirtualFleetHost;
use super::{CommandContext, CommandOutcome, system_language};
use crate::model::{Language, Problem};
use crate::platform::console;
use crate::session::Connectors;
use crate::texts::TextKey;
use crate::ui::{self, WindowOptions};
use crate::workspace::{
    Configuration, Passwords, ShowWindowOutcome, Workspace, WorkspaceError, WorkspaceLock, show_running_window,
};

/// The window on the workspace.
pub fn run(cli: &CommandContext, language: Option<Language>) -> Result<CommandOutcome, Problem> {
    let Some(lock) = lock_or_show(&cli.workspace)? else {
        let text = TextKey::CliWindowBroughtToFront.text(cli.output.language());
        cli.output.finished(&json!({ "window": "shown" }), text);
        return Ok(CommandOutcome::AllDone);
    };
    let loaded = cli.workspace.load()?;
    let mut notice = loaded.notice();
    let mut configuration = loaded.configuration;
    let store = cli.store(&configuration);
    if cli.vault_passphrase_file.is_some() {
        store.open_vault(&cli.vault_passphrase(false)?)?;
    }
    let passwords: Arc<dyn Passwords> = Arc::new(store);
    let fleet = VirtualFleetHost::in_workspace(cli.workspace.root())?;
    if fleet.has_controllers()
        && let Err(problem) = fleet.enter(&mut configuration, passwords.as_ref())
    {
        notice.get_or_insert(problem);
    }
    open(cli, language, configuration, lock, passwords, notice, fleet)
}

/// The lock of the workspace; `None` if another window has it and was brought to the front.
///
/// A command of the command line has the workspace for a moment only, and is waited for.
fn lock_or_show(workspace: &Workspace) -> Result<Option<WorkspaceLock>, Problem> {
    let until = Instant::now() + A_COMMAND;
    loop {
        let busy = match workspace.lock() {
            Err(busy @ WorkspaceError::Busy(_)) => busy,
            result => return Ok(Some(result?)),
        };
        match show_running_window(workspace.root()) {
            Ok(ShowWindowOutcome::InFront) => return Ok(None),
            Err(_) if Instant::now() < until => std::thread::sleep(PAUSE),
            Ok(ShowWindowOutcome::Marked) | Err(_) => return Err(busy.into()),
        }
    }
}

const A_COMMAND: Duration = Duration::from_secs(2);
const PAUSE: Duration = Duration::from_millis(100);

/// Opens the window and waits until it is closed.
pub fn open(
    cli: &CommandContext,
    language: Option<Language>,
    mut configuration: Configuration,
    lock: WorkspaceLock,
    passwords: Arc<dyn Passwords>,
    notice: Option<Problem>,
    fleet: VirtualFleetHost,
) -> Result<CommandOutcome, Problem> {
    if language.is_some() {
        configuration.options.language = language;
    }
    let options = WindowOptions {
        workspace: cli.workspace.clone(),
        lock,
        configuration,
        passwords,
        connectors: Connectors::standard(),
        starter: Some(fleet.starter()),
        language: system_language(),
        notice,
    };
    console::detach();
    let closed = ui::run(options);
    fleet.shutdown();
    closed.map(|()| CommandOutcome::AllDone)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ErrorCode;

    #[test]
    fn a_window_waits_for_a_command_and_not_for_another_computer() {
        let folder = tempfile::tempdir().unwrap();
        let workspace = Workspace::new(folder.path());
        let command = workspace.lock().unwrap();
        std::thread::scope(|scope| {
            scope.spawn(move || {
                std::thread::sleep(Duration::from_millis(300));
                drop(command);
            });
            assert!(lock_or_show(&workspace).unwrap().is_some());
        });
        let _held = workspace.lock().unwrap();
        assert_eq!(lock_or_show(&workspace).unwrap_err().code, ErrorCode::WorkspaceBusy);
    }
}
