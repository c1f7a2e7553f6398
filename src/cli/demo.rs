use std::cell::OnceCell;
use std::sync::Arc;

use clap::Args;

use super::output::say;
use super::virtual_fleet_host::VirtualFleetHost;
use super::{CommandContext, CommandOutcome, window};
use crate::model::{ErrorCode, Language, Problem};
use crate::texts::cli as texts;
use crate::virtual_controller::DEMO_COUNT;
use crate::workspace::{Configuration, MemoryPasswords, Passwords, Workspace};

#[derive(Debug, Args)]
pub struct DemoArgs {
    /// How many controllers; the first eight differ from each other
    #[arg(long, value_name = "N", default_value_t = DEMO_COUNT)]
    controllers: usize,
    /// The same seed makes the same controllers
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
}

/// The window over virtual controllers, in a folder that is removed at the end.
pub fn run(cli: &CommandContext, args: &DemoArgs, language: Option<Language>) -> Result<CommandOutcome, Problem> {
    let folder = tempfile::tempdir().map_err(|e| Problem::with_detail(ErrorCode::WorkspaceReadOnly, e))?;
    let workspace = Workspace::new(folder.path().join("OPCUA"));
    let lock = workspace.lock()?;
    let fleet = VirtualFleetHost::new(folder.path().join("virtual"), args.controllers, args.seed)?;
    let passwords: Arc<dyn Passwords> = Arc::new(MemoryPasswords::default());
    let mut configuration = Configuration::default();
    say(&texts::starting_virtual(cli.output.language(), args.controllers));
    fleet.enter(&mut configuration, passwords.as_ref())?;
    let cli = CommandContext {
        workspace,
        output: cli.output,
        yes: cli.yes,
        connection_password_file: None,
        connection_password_list: None,
        vault_passphrase_file: None,
        passwords: OnceCell::new(),
    };
    window::open(&cli, language, configuration, lock, passwords, None, fleet)
}
