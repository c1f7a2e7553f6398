use clap::Args;
use serde_json::json;

use super::table::table;
use super::{CommandContext, CommandOutcome};
use crate::licences::{Component, Licences};
use crate::model::{ErrorCode, Problem};
use crate::texts::TextKey;

#[derive(Debug, Args)]
pub struct LicencesArgs {
    /// Components whose licence texts are shown, "all" for every one [default: the list without texts]
    #[arg(value_name = "NAME")]
    components: Vec<String>,
}

pub fn run(cli: &CommandContext, args: &LicencesArgs) -> Result<CommandOutcome, Problem> {
    let licences = Licences::get();
    let all = args.components.iter().any(|name| name.eq_ignore_ascii_case("all"));
    let is_asked =
        |component: &&Component| all || args.components.iter().any(|name| name.eq_ignore_ascii_case(&component.name));
    let chosen: Vec<&Component> = licences.components().iter().filter(is_asked).collect();
    if let Some(unknown) = args
        .components
        .iter()
        .find(|name| !all && !chosen.iter().any(|component| component.name.eq_ignore_ascii_case(name)))
    {
        return Err(Problem::with_detail(ErrorCode::UnknownComponent, unknown));
    }
    if args.components.is_empty() {
        list(cli, licences.components());
        return Ok(CommandOutcome::AllDone);
    }
    for component in chosen {
        let texts: Vec<&str> = licences.texts_of(component).collect();
        let Component { name, version, licence, .. } = component;
        if cli.output.is_json() {
            let line = json!({ "name": name, "version": version, "licence": licence, "texts": texts });
            cli.output.text(&line.to_string());
        } else {
            cli.output.text(&format!("==> {name} {version} ({licence}) <==\n\n{}\n", texts.join("\n\n")));
        }
    }
    Ok(CommandOutcome::AllDone)
}

fn list(cli: &CommandContext, components: &[Component]) {
    if cli.output.is_json() {
        for Component { name, version, licence, .. } in components {
            cli.output.text(&json!({ "name": name, "version": version, "licence": licence }).to_string());
        }
        return;
    }
    let rows: Vec<Vec<String>> = components
        .iter()
        .map(|component| vec![component.name.clone(), component.version.clone(), component.licence.clone()])
        .collect();
    let headings = [TextKey::HeadingName, TextKey::HeadingVersion, TextKey::HeadingLicence];
    cli.output.text(&table(&headings.map(|heading| heading.text(cli.output.language())), &rows));
}
