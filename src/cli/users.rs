use std::path::PathBuf;

use clap::Subcommand;
use secrecy::ExposeSecret as _;
use serde_json::json;

use super::batch::{Presentation, PrintedResult, STATE};
use super::controller_selection::{ControllerSelection, ItemsThenControllers};
use super::secret_file::read_secret;
use super::{CommandContext, CommandOutcome};
use crate::jobs::{AddUser, ListUsers, RemoveUsers};
use crate::model::{ErrorCode, Problem, Revisioned, UserCredential, UserCredentialError, UserName, UserPassword};
use crate::texts::TextKey;

#[derive(Debug, Subcommand)]
pub enum UsersCommand {
    /// List users; passwords never come back from a controller
    List(ControllerSelection),
    /// Add a user: 8 to 32 letters and digits each for name and password
    Add {
        user: String,
        /// File with the user's password, "-" for standard input
        #[arg(long, value_name = "FILE")]
        password_file: PathBuf,
        #[command(flatten)]
        select: ControllerSelection,
    },
    /// Remove users: USER… CONTROLLER…
    Remove(ItemsThenControllers),
}

const USERS: Presentation<Revisioned<Vec<UserName>>> = Presentation {
    header: &[TextKey::HeadingUsers],
    show: |users, _| {
        let names: Vec<&str> = users.value.iter().map(UserName::as_str).collect();
        PrintedResult { json: json!({ "users": names }), cells: vec![names.join(",").into()] }
    },
};

fn bad(error: UserCredentialError) -> Problem {
    Problem::with_detail(ErrorCode::BadCredential, error)
}

pub fn run(cli: &CommandContext, command: UsersCommand) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    match command {
        UsersCommand::List(select) => {
            cli.batch(&configuration, &select.resolve(&configuration, cli.output.language())?, ListUsers, &USERS)
        }
        UsersCommand::Add { user, password_file, select } => {
            let chosen = select.resolve(&configuration, cli.output.language())?;
            let name = user.parse::<UserName>().map_err(bad)?;
            let password = UserPassword::new(read_secret(&password_file)?.expose_secret()).map_err(bad)?;
            let operation = AddUser { credential: UserCredential { name, password }, based_on: None };
            cli.batch(&configuration, &chosen, operation, &STATE)
        }
        UsersCommand::Remove(arguments) => {
            let (users, chosen) = arguments.resolve(&configuration, cli.output.language())?;
            let names = users.iter().map(|u| u.parse()).collect::<Result<Vec<UserName>, _>>().map_err(bad)?;
            cli.batch(&configuration, &chosen, RemoveUsers { names, based_on: None }, &STATE)
        }
    }
}
