use std::path::PathBuf;

use clap::Subcommand;
use serde_json::json;

use super::connection_passwords::read_password_list;
use super::passwords::passphrase;
use super::{CommandContext, CommandOutcome};
use crate::model::{ErrorCode, Problem};
use crate::pki::Fingerprint;
use crate::texts::{TextKey, cli as texts};
use crate::workspace::{Configuration, PasswordPlace, PasswordStore, VaultState};

#[derive(Debug, Subcommand)]
pub enum VaultCommand {
    /// Create the vault and use it from now on; passwords that the keyring has are taken over
    ///
    /// Its passphrase has at least 8 characters and is read from --vault-passphrase-file, or asked for. Nobody can open
    /// the vault without it.
    Init,
    /// Say whether there is a vault and whether it is used; with --vault-passphrase-file, whose passwords are in it
    Status,
    /// Put the connection passwords of a list into the vault
    Import {
        /// CSV with the columns Name,Password; an empty password says that the controller has none
        #[arg(value_name = "FILE.csv")]
        file: PathBuf,
    },
    /// Take passwords out of the vault; the controllers stay in the list
    Forget {
        /// Names of controllers, or fingerprints of controllers that are not in the list any more
        #[arg(required = true, value_name = "NAME")]
        names: Vec<String>,
    },
    /// Change the passphrase of the vault; copies of its file still open with the old one
    Passphrase {
        /// File with the new passphrase, "-" for standard input; without it the passphrase is asked for
        #[arg(long, value_name = "FILE")]
        new_passphrase_file: Option<PathBuf>,
    },
    /// Keep connection passwords in the vault
    On,
    /// Keep connection passwords in the operating system's keyring; the vault stays as it is
    Off,
}

pub fn run(cli: &CommandContext, command: VaultCommand) -> Result<CommandOutcome, Problem> {
    match command {
        VaultCommand::Init => init(cli),
        VaultCommand::Status => status(cli),
        VaultCommand::Import { file } => import(cli, &file),
        VaultCommand::Forget { names } => forget(cli, &names),
        VaultCommand::Passphrase { new_passphrase_file } => change_passphrase(cli, new_passphrase_file),
        VaultCommand::On => use_place(cli, PasswordPlace::Vault),
        VaultCommand::Off => use_place(cli, PasswordPlace::Keyring),
    }
}

fn init(cli: &CommandContext) -> Result<CommandOutcome, Problem> {
    let lock = cli.lock()?;
    let mut configuration = cli.configuration()?;
    let store = cli.store(&configuration);
    if store.status().vault != VaultState::None {
        return Err(Problem::with_detail(ErrorCode::VaultExists, path(cli)));
    }
    let passphrase = cli.vault_passphrase(true)?;
    let known: Vec<Fingerprint> = configuration.controllers.iter().filter_map(|entry| entry.fingerprint).collect();
    let passwords = store.create_vault(&passphrase, &known)?;
    configuration.options.passwords = PasswordPlace::Vault;
    cli.workspace.save(&configuration, &lock)?;
    let text = texts::vault_created(cli.output.language(), &path(cli), passwords);
    cli.output.finished(&json!({ "vault": path(cli), "passwords": passwords }), &text);
    Ok(CommandOutcome::AllDone)
}

fn status(cli: &CommandContext) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    let store = cli.store(&configuration);
    if cli.vault_passphrase_file.is_some() {
        store.open_vault(&cli.vault_passphrase(false)?)?;
    }
    let status = store.status();
    let place = status.place;
    let exists = status.vault != VaultState::None;
    let mut result = json!({ "vault": path(cli), "exists": exists, "passwords_in": place });
    let (language, path) = (cli.output.language(), path(cli));
    let mut text = match (exists, place) {
        (false, _) => texts::vault_missing(language, &path),
        (true, PasswordPlace::Vault) => texts::vault_used(language, &path),
        (true, PasswordPlace::Keyring) => texts::vault_used_without_keyring(language, &path),
    };
    if let Some(controllers) = store.in_vault() {
        let (names, unlisted) = named(&configuration, &controllers);
        let all = names.iter().chain(&unlisted).map(|name| format!("\n  {name}"));
        text.push_str(&format!("\n{}{}", texts::vault_passwords(language, controllers.len()), all.collect::<String>()));
        result["controllers"] = json!(names);
        result["unlisted"] = json!(unlisted);
    }
    cli.output.finished(&result, &text);
    Ok(CommandOutcome::AllDone)
}

/// The names of controllers in the list, and the fingerprints of the others.
fn named(configuration: &Configuration, controllers: &[Fingerprint]) -> (Vec<String>, Vec<String>) {
    let entry = |fingerprint| configuration.controllers.iter().find(|entry| entry.fingerprint == Some(fingerprint));
    let (mut names, mut unlisted) = (Vec::new(), Vec::new());
    for controller in controllers {
        match entry(*controller) {
            Some(entry) => names.push(entry.name.to_string()),
            None => unlisted.push(controller.to_string()),
        }
    }
    names.sort();
    (names, unlisted)
}

fn import(cli: &CommandContext, file: &std::path::Path) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    let list = read_password_list(file)?;
    let found: Vec<_> = list
        .iter()
        .map(|(name, password)| Ok((fingerprint(&configuration, name)?, password.clone())))
        .collect::<Result<_, Problem>>()?;
    let count = found.len();
    opened(cli, &configuration)?.put_into_vault(found)?;
    cli.output.finished(&json!({ "passwords": count }), &texts::vault_imported(cli.output.language(), count));
    Ok(CommandOutcome::AllDone)
}

fn forget(cli: &CommandContext, names: &[String]) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    let wanted: Vec<Fingerprint> = names
        .iter()
        .map(|name| match name.parse() {
            Ok(unlisted) if configuration.find(name).is_none() => Ok(unlisted),
            _ => fingerprint(&configuration, name),
        })
        .collect::<Result<_, _>>()?;
    let store = opened(cli, &configuration)?;
    let known = store.in_vault().unwrap_or_default();
    store.forget_in_vault(&wanted)?;
    for (name, controller) in names.iter().zip(&wanted) {
        let forgotten = known.contains(controller);
        if cli.output.is_json() {
            cli.output.done(name, &json!({ "forgotten": forgotten }));
        } else {
            let text = if forgotten { texts::vault_forgot } else { texts::vault_has_none };
            cli.output.text(&text(cli.output.language(), name));
        }
    }
    Ok(CommandOutcome::AllDone)
}

fn change_passphrase(cli: &CommandContext, file: Option<PathBuf>) -> Result<CommandOutcome, Problem> {
    let store = cli.store(&cli.configuration()?);
    let present = cli.vault_passphrase(false)?;
    // Not after the new one was entered twice.
    store.open_vault(&present)?;
    let new = passphrase(TextKey::CliAskNewVaultPassphrase, file.as_deref(), true, cli.output.language())?;
    store.change_passphrase(&present, &new)?;
    cli.output.finished(&json!({ "vault": path(cli) }), TextKey::VaultPassphraseChanged.text(cli.output.language()));
    Ok(CommandOutcome::AllDone)
}

fn use_place(cli: &CommandContext, place: PasswordPlace) -> Result<CommandOutcome, Problem> {
    if place == PasswordPlace::Vault && !cli.workspace.vault().exists() {
        return Err(Problem::with_detail(ErrorCode::VaultMissing, path(cli)));
    }
    let lock = cli.lock()?;
    let mut configuration = cli.configuration()?;
    configuration.options.passwords = place;
    cli.workspace.save(&configuration, &lock)?;
    status(cli)
}

fn opened(cli: &CommandContext, configuration: &Configuration) -> Result<PasswordStore, Problem> {
    let store = cli.store(configuration);
    if store.status().vault == VaultState::None {
        return Err(Problem::with_detail(ErrorCode::VaultMissing, path(cli)));
    }
    store.open_vault(&cli.vault_passphrase(false)?)?;
    Ok(store)
}

fn fingerprint(configuration: &Configuration, name: &str) -> Result<Fingerprint, Problem> {
    let entry = configuration.find(name).ok_or_else(|| Problem::with_detail(ErrorCode::UnknownController, name))?;
    entry.fingerprint.ok_or_else(|| Problem::with_detail(ErrorCode::FingerprintUnknown, name))
}

fn path(cli: &CommandContext) -> String {
    cli.workspace.vault().path().display().to_string()
}
