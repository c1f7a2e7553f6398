use std::path::PathBuf;

use clap::{Args, Subcommand};
use secrecy::SecretString;
use serde_json::json;

use super::output::say;
use super::table::table;
use super::{CommandContext, CommandOutcome, runtime};
use crate::jobs::{self, Enrolled};
use crate::model::{Address, ConnectionKind, ControllerName, ControllerSeries, ErrorCode, Problem, clock};
use crate::pki::Fingerprint;
use crate::texts::{TextKey, cli as texts};
use crate::workspace::{
    ConnectionList, ControllerEntry, MAX_CONNECTION_LIST_BYTES, PlannedConnection, RetrievedInfo, VaultState,
};

#[derive(Debug, Subcommand)]
pub enum ControllersCommand {
    /// List the registered controllers
    List,
    /// Register a controller
    Add(AddArgs),
    /// Remove controllers from the list; nothing changes in the controllers
    Remove {
        #[arg(required = true, value_name = "NAME")]
        names: Vec<String>,
    },
    /// Add the controllers of a connection list; each has to be trusted before anything is sent to it
    Import {
        /// CSV with the columns Name, Type and Address, as a spreadsheet saves it [default: connections.csv in the
        /// workspace]
        #[arg(value_name = "FILE.csv")]
        file: Option<PathBuf>,
        /// Series to show until a controller was reached: RC90, RC700, T/VT or RC800
        #[arg(long, default_value = ControllerSeries::ASSUMED.as_str())]
        series: String,
    },
    /// Accept the fingerprint of a controller that was imported or added without confirming it
    Trust(TrustArgs),
}

#[derive(Debug, Args)]
pub struct AddArgs {
    /// 1 to 32 characters
    name: String,
    /// IP address or host name, with the port of the management protocol where it is not the usual one
    #[arg(value_name = "HOST[:PORT]")]
    address: String,
    /// RC90, RC700, T/VT or RC800
    #[arg(long)]
    series: String,
    /// SHA-256 of the controller's management identity, as the controller shows it
    #[arg(long, value_name = "HEX", required_unless_present_any = ["trust_on_first_use", "unconfirmed"])]
    fingerprint: Option<String>,
    /// Accept the fingerprint that the controller presents now, unchecked: safe only on a network without impostors
    #[arg(long, conflicts_with = "fingerprint")]
    trust_on_first_use: bool,
    /// Add it without confirming its identity, as while it is switched off: nothing is sent to it, now or later, before
    /// "controllers trust NAME"
    #[arg(long, conflicts_with_all = ["fingerprint", "trust_on_first_use", "password_file"])]
    unconfirmed: bool,
    /// File with the connection password, "-" for standard input; kept in the operating system's keyring, or in the
    /// vault of the workspace
    #[arg(long, value_name = "FILE")]
    password_file: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct TrustArgs {
    /// As it stands in the list
    name: String,
    /// SHA-256 of the controller's management identity, as the controller shows it
    #[arg(long, value_name = "HEX", required_unless_present = "trust_on_first_use")]
    fingerprint: Option<String>,
    /// Accept the fingerprint that the controller presents now, unchecked: safe only on a network without impostors
    #[arg(long, conflicts_with = "fingerprint")]
    trust_on_first_use: bool,
    /// File with the connection password, "-" for standard input; kept in the operating system's keyring, or in the
    /// vault of the workspace
    #[arg(long, value_name = "FILE")]
    password_file: Option<PathBuf>,
}

pub fn run(cli: &CommandContext, command: ControllersCommand) -> Result<CommandOutcome, Problem> {
    match command {
        ControllersCommand::List => list(cli),
        ControllersCommand::Add(args) => add(cli, &args),
        ControllersCommand::Remove { names } => remove(cli, &names),
        ControllersCommand::Import { file, series } => import(cli, file, &series),
        ControllersCommand::Trust(args) => trust(cli, &args),
    }
}

fn list(cli: &CommandContext) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    if cli.output.is_json() {
        for entry in &configuration.controllers {
            cli.output.done(
                entry.name.as_str(),
                &json!({ "address": entry.address, "series": entry.series, "fingerprint": entry.fingerprint }),
            );
        }
    } else {
        let rows: Vec<Vec<String>> = configuration
            .controllers
            .iter()
            .map(|c| {
                let seen = c.last.as_ref().map_or("-".into(), |l| l.at.format("%Y-%m-%d %H:%M UTC").to_string());
                let identity = if c.fingerprint.is_some() { TextKey::Confirmed } else { TextKey::NotConfirmed };
                let identity = identity.text(cli.output.language()).to_owned();
                vec![c.name.to_string(), c.series.to_string(), c.address.to_string(), identity, seen]
            })
            .collect();
        let headings = [
            TextKey::HeadingName,
            TextKey::HeadingType,
            TextKey::HeadingAddress,
            TextKey::HeadingIdentity,
            TextKey::HeadingRetrieved,
        ];
        cli.output.text(&table(&headings.map(|heading| heading.text(cli.output.language())), &rows));
    }
    Ok(CommandOutcome::AllDone)
}

fn add(cli: &CommandContext, args: &AddArgs) -> Result<CommandOutcome, Problem> {
    let bad = |code: ErrorCode, e: &dyn std::fmt::Display| Problem::with_detail(code, e);
    let name: ControllerName = args.name.parse().map_err(|e| bad(ErrorCode::BadName, &e))?;
    let address: Address = args.address.parse().map_err(|e| bad(ErrorCode::BadAddress, &e))?;
    let series: ControllerSeries = args.series.parse().map_err(|e| bad(ErrorCode::UnknownSeries, &e))?;
    let language = cli.output.language();
    let given = args.fingerprint.as_deref().map(str::parse::<Fingerprint>).transpose()?;
    // Held from the check to the save, so that two commands cannot add the same name.
    let lock = cli.lock()?;
    let mut configuration = cli.configuration()?;
    configuration.check_new(&name, &address)?;
    let (entry, shown, text) = if args.unconfirmed {
        let text = texts::added_unconfirmed(language, &name, &address);
        let entry = ControllerEntry::unconfirmed(name.clone(), address, series);
        (entry, json!({ "fingerprint": null }), text)
    } else {
        let password = cli.first_password(&name, args.password_file.as_deref())?;
        let (fingerprint, info) = match meet(cli, &name, &address, given, password)? {
            Ok(Enrolled { fingerprint, info, .. }) => (fingerprint, info),
            Err(code) => {
                if code.is_unreached() && !cli.output.is_json() {
                    say(&format!("    {}", TextKey::CliAddUnconfirmed.text(language)));
                }
                return Ok(CommandOutcome::SomeFailed);
            }
        };
        if info.series != series {
            say(&texts::other_series(language, &name, format!("{} {}", info.series, info.serial)));
        }
        let text = texts::added(language, &name, format!("{} {} {fingerprint}", info.series, info.serial));
        let shown = json!({ "fingerprint": fingerprint, "info": info });
        let connection = ConnectionKind::default();
        let (series, last) = (info.series, Some(RetrievedInfo { at: clock::now(), info }));
        (
            ControllerEntry { name: name.clone(), address, series, connection, fingerprint: Some(fingerprint), last },
            shown,
            text,
        )
    };
    configuration.controllers.push(entry);
    cli.workspace.save(&configuration, &lock)?;
    if cli.output.is_json() {
        cli.output.done(name.as_str(), &shown);
    } else {
        cli.output.text(&text);
    }
    Ok(CommandOutcome::AllDone)
}

/// Logs in for the first time, under the fingerprint given or else the one that is found. An inner error is the
/// controller's, and is printed already.
fn meet(
    cli: &CommandContext,
    name: &ControllerName,
    address: &Address,
    given: Option<Fingerprint>,
    password: SecretString,
) -> Result<Result<Enrolled, ErrorCode>, Problem> {
    let (context, connection) = (cli.context(1)?, ConnectionKind::default());
    let enrolled = runtime()?.block_on(async {
        let fingerprint = match given {
            Some(fingerprint) => fingerprint,
            None => jobs::probe(connection, address, &context).await?,
        };
        jobs::enroll(connection, address, fingerprint, password.into(), &context).await
    });
    match enrolled {
        Ok(enrolled) => {
            if let Some(problem) = &enrolled.password_not_kept {
                let said = problem.code.explain(cli.output.language());
                eprintln!("{name}: {}. {}", said.message, said.remedy);
            }
            Ok(Ok(enrolled))
        }
        Err(problem) => {
            failed(cli, name.as_str(), &problem);
            Ok(Err(problem.code))
        }
    }
}

fn failed(cli: &CommandContext, name: &str, problem: &Problem) {
    if cli.output.is_json() {
        cli.output.failed(name, problem);
    } else {
        cli.output.explain(Some(name), problem);
    }
}

fn import(cli: &CommandContext, file: Option<PathBuf>, series: &str) -> Result<CommandOutcome, Problem> {
    let series: ControllerSeries = series.parse().map_err(|e| Problem::with_detail(ErrorCode::UnknownSeries, e))?;
    let language = cli.output.language();
    let path = file.unwrap_or_else(|| cli.workspace.connection_list_path());
    let list = ConnectionList::parse(&super::read_bounded(&path, MAX_CONNECTION_LIST_BYTES)?)?;
    let lock = cli.lock()?;
    let mut configuration = cli.configuration()?;
    let plan = list.plan(&configuration);
    let new = plan.iter().filter_map(|planned| planned.verdict.clone().ok());
    configuration.controllers.extend(new.map(|new| new.entry(series)));
    cli.workspace.save(&configuration, &lock)?;

    let mut ending = CommandOutcome::AllDone;
    for PlannedConnection { line, name, verdict, .. } in &plan {
        let said = match verdict {
            Ok(new) => (json!({ "line": line, "address": new.address }), texts::added(language, name, &new.address)),
            Err(skipped) => match skipped.problem(*line) {
                None => (
                    json!({ "line": line, "skipped": skipped.to_string() }),
                    texts::left_out(language, name, *line, crate::texts::skipped(language, skipped)),
                ),
                Some(problem) => {
                    failed(cli, name, &problem);
                    ending = CommandOutcome::SomeFailed;
                    continue;
                }
            },
        };
        if cli.output.is_json() {
            cli.output.done(name, &said.0);
        } else {
            cli.output.text(&said.1);
        }
    }
    Ok(ending)
}

/// An entry whose fingerprint was accepted already keeps it: a controller that comes with another one has to be
/// removed and added again, on purpose.
fn trust(cli: &CommandContext, args: &TrustArgs) -> Result<CommandOutcome, Problem> {
    let given = args.fingerprint.as_deref().map(str::parse::<Fingerprint>).transpose()?;
    let lock = cli.lock()?;
    let mut configuration = cli.configuration()?;
    let unknown = || Problem::with_detail(ErrorCode::UnknownController, &args.name);
    let entry = configuration.controllers.iter_mut().find(|c| c.name.as_str() == args.name).ok_or_else(unknown)?;
    if let (Some(known), Some(given)) = (entry.fingerprint, given)
        && known != given
    {
        let detail = format!("expected {}, given {}", known.grouped(), given.grouped());
        return Err(Problem::with_detail(ErrorCode::FingerprintChanged, detail));
    }
    let password = cli.first_password(&entry.name, args.password_file.as_deref())?;
    let Ok(enrolled) = meet(cli, &entry.name, &entry.address, given.or(entry.fingerprint), password)? else {
        return Ok(CommandOutcome::SomeFailed);
    };
    let shown = json!({ "fingerprint": enrolled.fingerprint, "info": enrolled.info });
    let Enrolled { fingerprint, info, .. } = enrolled;
    let what = format!("{} {} {fingerprint}", info.series, info.serial);
    let text = texts::trusted(cli.output.language(), &entry.name, what);
    entry.series = info.series;
    entry.fingerprint = Some(fingerprint);
    entry.last = Some(RetrievedInfo { at: clock::now(), info });
    cli.workspace.save(&configuration, &lock)?;
    if cli.output.is_json() {
        cli.output.done(&args.name, &shown);
    } else {
        cli.output.text(&text);
    }
    Ok(CommandOutcome::AllDone)
}

fn remove(cli: &CommandContext, names: &[String]) -> Result<CommandOutcome, Problem> {
    let lock = cli.lock()?;
    let mut configuration = cli.configuration()?;
    if let Some(unknown) = names.iter().find(|n| configuration.find(n).is_none()) {
        return Err(Problem::with_detail(ErrorCode::UnknownController, unknown));
    }
    let passwords = cli.passwords()?;
    let (removed, kept): (Vec<_>, Vec<_>) =
        configuration.controllers.into_iter().partition(|c| names.iter().any(|n| n == c.name.as_str()));
    configuration.controllers = kept;
    cli.workspace.save(&configuration, &lock)?;
    for entry in &removed {
        if let Some(fingerprint) = entry.fingerprint {
            passwords.forget(fingerprint);
        }
        if cli.output.is_json() {
            cli.output.done(entry.name.as_str(), &json!({}));
        } else {
            cli.output.text(&texts::removed(cli.output.language(), &entry.name));
        }
    }
    let vault = passwords.store().map(|store| store.status().vault);
    if matches!(vault, Some(VaultState::Closed | VaultState::Declined)) {
        say(TextKey::CliVaultKeeps.text(cli.output.language()));
    }
    Ok(CommandOutcome::AllDone)
}
