use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;

use super::batch::{Presentation, PrintedResult};
use super::controller_selection::ControllerSelection;
use super::output::say;
use super::{CommandContext, CommandOutcome};
use crate::jobs::{Activate, KeySource, NoOutput};
use crate::model::activation::{self, ActivationFile, ActivationKeys, KeyError, MAX_ACTIVATION_FILE_BYTES};
use crate::model::{ErrorCode, Problem};
use crate::texts::{TextKey, cli as texts};

#[derive(Debug, Args)]
pub struct ActivateArgs {
    /// Activation file: CSV, first line OPCUA.Activation.Ver.1.0, then SERIAL,LICENCE,ACTIVATION a line
    #[arg(long, value_name = "FILE", required_unless_present = "license", conflicts_with_all = ["license", "activation"])]
    file: Option<PathBuf>,
    /// Licence key, xxxx-xxxx-xxxx-xxxx, for one controller
    #[arg(long, visible_alias = "licence", value_name = "KEY", requires = "activation")]
    license: Option<String>,
    /// Activation key, XXXX-XXXX-XXXX-XXXX-XXXX-XXXX, for one controller
    #[arg(long, value_name = "KEY", requires = "license")]
    activation: Option<String>,
    #[command(flatten)]
    select: ControllerSelection,
}

const ACTIVATED: Presentation<NoOutput> = Presentation {
    header: &[TextKey::HeadingSerial, TextKey::HeadingActivated, TextKey::HeadingStatus],
    show: |_, info| PrintedResult {
        json: serde_json::json!({
            "serial": info.serial,
            "activated": info.activated,
            "status": info.status,
            "revision": info.revision,
        }),
        cells: vec![info.serial.to_string().into(), info.activated.into(), info.status.into()],
    },
};

pub fn run(cli: &CommandContext, args: &ActivateArgs) -> Result<CommandOutcome, Problem> {
    let configuration = cli.configuration()?;
    let chosen = args.select.resolve(&configuration, cli.output.language())?;
    let keys = match (&args.file, &args.license, &args.activation) {
        (Some(file), ..) => KeySource::File(Arc::new(read(file)?)),
        (None, Some(licence), Some(activation)) => {
            if chosen.len() > 1 {
                return Err(Problem::with_detail(
                    ErrorCode::OneControllerOnly,
                    texts::keys_of_one(cli.output.language()),
                ));
            }
            let bad = |which: &str, error: KeyError| {
                Problem::with_detail(ErrorCode::BadActivationKey, format!("{which} key: {error}"))
            };
            KeySource::Typed(ActivationKeys {
                licence: licence.parse().map_err(|error| bad("licence", error))?,
                activation: activation.parse().map_err(|error| bad("activation", error))?,
            })
        }
        _ => return Err(ErrorCode::BadActivationKey.into()),
    };
    if let KeySource::File(file) = &keys {
        for mistake in file.mistakes() {
            say(&crate::texts::line_mistake(cli.output.language(), mistake));
        }
    }
    cli.batch(&configuration, &chosen, Activate { keys }, &ACTIVATED)
}

fn read(path: &Path) -> Result<ActivationFile, Problem> {
    let bytes = super::read_bounded(path, MAX_ACTIVATION_FILE_BYTES)?;
    activation::parse(&bytes)
        .map_err(|e| Problem::with_detail(ErrorCode::BadActivationFile, format!("{}: {e}", path.display())))
}
