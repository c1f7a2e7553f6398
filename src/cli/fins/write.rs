use clap::Args;

use super::super::{CommandContext, CommandOutcome, runtime};
use super::elements::{TypeArgs, first_elements, with_count};
use super::target::TargetArgs;
use super::{as_json, print_failure};
use crate::fins::address::AddressRange;
use crate::fins::bridge::robot::{ValuesNotWritten, write_values};
use crate::fins::client::{ClientSettings, FinsClient, WriteError};
use crate::fins::data_type::{DataType, Value, ValueError};
use crate::model::{ErrorCode, Problem};
use crate::texts;

#[derive(Debug, Args)]
pub struct WriteArgs {
    /// Where to write, as for "fins read", and then the values. Numbers are decimal, or hexadecimal after 0x; bits are on,
    /// off, 1 or 0. Text fills the words of a range with NUL
    #[arg(required = true, value_name = "ADDRESS VALUE", num_args = 2.., allow_negative_numbers = true)]
    elements: Vec<String>,

    /// Write again when the answer was lost, which may overwrite what the PLC has changed meanwhile
    #[arg(long)]
    repeat: bool,

    #[command(flatten)]
    form: TypeArgs,

    #[command(flatten)]
    target: TargetArgs,
}

pub fn run(cli: &CommandContext, args: &WriteArgs) -> Result<CommandOutcome, Problem> {
    let (range, rest) = first_elements(&args.elements)?;
    let form = args.form.form(range.start)?;
    if rest.is_empty() {
        return Err(Problem::with_detail(
            ErrorCode::BadPlcValue,
            texts::cli::no_value_after(cli.output.language(), &range.to_string()),
        ));
    }
    let values = rest.iter().map(|value| form.data_type.parse(value)).collect::<Result<Vec<Value>, ValueError>>()?;
    let range = if form.data_type == DataType::Text {
        text_range(range, &values)?
    } else {
        let needed = with_count(range.start.into(), Some(values.len()), form)?;
        if range.count > 1 && range.count != needed.count {
            let error = ValueError::OddWords { words: needed.count.into(), data_type: form.data_type };
            return Err(error.into());
        }
        needed
    };
    // What does not fit is found before anything is sent.
    form.data_type.encode(&values, form.order, range.count.into())?;
    let settings = ClientSettings { repeats_uncertain_writes: args.repeat, ..args.target.settings()? };
    let plc = settings.to.authority();
    let mut client = FinsClient::new(settings);
    let written = runtime()?.block_on(write_values(&mut client, range, &values, form.data_type, form.order));
    match written {
        Ok(()) => {
            let text = texts::plc_written(cli.output.language(), &range.to_string());
            cli.output.cli("plc", &plc, &Ok((as_json(range, &values), text)));
            Ok(CommandOutcome::AllDone)
        }
        Err(error) => {
            let (of_client, done) = match &error {
                ValuesNotWritten::Value(_) => (None, None),
                ValuesNotWritten::Write(write) => (Some(write.client_error().clone()), progress(cli, write)),
            };
            print_failure(cli, &plc, error.into(), of_client.as_ref(), done.as_deref());
            Ok(CommandOutcome::SomeFailed)
        }
    }
}

/// How far a long write came.
fn progress(cli: &CommandContext, error: &WriteError) -> Option<String> {
    let (done, uncertain) = match error {
        WriteError::NotDone { done: 0, .. } | WriteError::Unknown { done: 0, .. } => return None,
        WriteError::NotDone { done, .. } => (*done, 0),
        WriteError::Unknown { done, uncertain, .. } => (*done, *uncertain),
    };
    Some(texts::plc_partly_written(cli.output.language(), done, uncertain))
}

/// The words of a range, or as many as the text needs.
fn text_range(range: AddressRange, values: &[Value]) -> Result<AddressRange, Problem> {
    let [Value::Text(text)] = values else {
        let second = values.get(1).map(ToString::to_string).unwrap_or_default();
        return Err(ValueError::NotOfType(second, DataType::Text).into());
    };
    if range.count > 1 {
        return Ok(range);
    }
    Ok(AddressRange::new(range.start, text.len().div_ceil(2).max(1))?)
}
