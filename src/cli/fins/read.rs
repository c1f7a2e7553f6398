use clap::Args;

use super::super::{CommandContext, CommandOutcome, runtime};
use super::elements::{Form, TypeArgs, first_elements, with_count};
use super::target::TargetArgs;
use super::{as_json, as_text, print_failure};
use crate::fins::address::AddressRange;
use crate::fins::bridge::robot::{ReadError, read_values};
use crate::fins::client::ClientError;
use crate::fins::data_type::ValueError;
use crate::model::Problem;

#[derive(Debug, Args)]
pub struct ReadArgs {
    /// What to read: an address such as D300, D300.04, CIO0.15, W10, E1_200, T5 or T5.F (completion flag), or a range
    /// such as D300-304; area and address may stand apart (DM 300). Then how many values; for text, how many words
    #[arg(required = true, value_name = "ADDRESS [COUNT]", num_args = 1..=3)]
    elements: Vec<String>,

    #[command(flatten)]
    form: TypeArgs,

    #[command(flatten)]
    target: TargetArgs,
}

impl ReadArgs {
    /// What is to be read, and how.
    pub fn range(&self) -> Result<(AddressRange, Form), Problem> {
        let (range, rest) = first_elements(&self.elements)?;
        let form = self.form.form(range.start)?;
        let count = match rest {
            [] => None,
            [count] => Some(count.parse().map_err(|_| ValueError::NotOfType(count.clone(), form.data_type))?),
            [_, more, ..] => return Err(ValueError::NotOfType(more.clone(), form.data_type).into()),
        };
        Ok((with_count(range, count, form)?, form))
    }

    pub const fn target(&self) -> &TargetArgs {
        &self.target
    }
}

pub fn run(cli: &CommandContext, args: &ReadArgs) -> Result<CommandOutcome, Problem> {
    let (range, form) = args.range()?;
    let (mut client, plc) = args.target.client()?;
    let runtime = runtime()?;
    match runtime.block_on(read_values(&mut client, range, form.data_type, form.order)) {
        Ok(values) => {
            cli.output.cli("plc", &plc, &Ok((as_json(range, &values), as_text(range, &values))));
            Ok(CommandOutcome::AllDone)
        }
        Err(error) => {
            print_read_failure(cli, &plc, error);
            Ok(CommandOutcome::SomeFailed)
        }
    }
}

pub fn print_read_failure(cli: &CommandContext, plc: &str, error: ReadError) {
    let of_client: Option<ClientError> = match &error {
        ReadError::Client(error) => Some(error.clone()),
        ReadError::Value(_) => None,
    };
    print_failure(cli, plc, error.into(), of_client.as_ref(), None);
}
