use clap::Args;

use crate::model::{ErrorCode, Language, Problem};
use crate::texts::cli as texts;
use crate::workspace::{Configuration, ControllerEntry};

/// Which controllers a command works on.
#[derive(Debug, Clone, Args)]
pub struct ControllerSelection {
    /// Names of controllers
    #[arg(value_name = "CONTROLLER", required_unless_present = "all", conflicts_with = "all")]
    names: Vec<String>,

    /// Every controller in the list
    #[arg(long)]
    all: bool,
}

impl ControllerSelection {
    /// As if named on the command line. No name at all chooses nothing.
    pub fn new(names: Vec<String>, all: bool) -> Self {
        Self { names, all }
    }

    /// The chosen entries, in the order they were named.
    pub fn resolve(&self, configuration: &Configuration, language: Language) -> Result<Vec<ControllerEntry>, Problem> {
        if self.all { all(configuration, language) } else { named(&self.names, configuration) }
    }
}

/// Arguments of commands that take things and then controllers: `THING… CONTROLLER…`, or `THING… --all`.
///
/// The controllers are as many names of the list as stand at the end, leaving at least one thing.
#[derive(Debug, Clone, Args)]
pub struct ItemsThenControllers {
    /// First what the command is about, then the names of controllers
    #[arg(value_name = "ARGUMENT", required = true)]
    arguments: Vec<String>,

    /// Every controller in the list; all arguments are then what the command is about
    #[arg(long)]
    all: bool,
}

impl ItemsThenControllers {
    pub fn resolve(
        &self,
        configuration: &Configuration,
        language: Language,
    ) -> Result<(Vec<String>, Vec<ControllerEntry>), Problem> {
        if self.all {
            return Ok((self.arguments.clone(), all(configuration, language)?));
        }
        let controllers =
            self.arguments.iter().skip(1).rev().take_while(|name| configuration.find(name).is_some()).count();
        let (things, names) = self.arguments.split_at(self.arguments.len() - controllers);
        if names.is_empty() {
            let detail = match self.arguments.as_slice() {
                [only] => texts::no_controller_after(language, only),
                several => several.last().cloned().unwrap_or_default(),
            };
            return Err(Problem::with_detail(ErrorCode::UnknownController, detail));
        }
        Ok((things.to_vec(), named(names, configuration)?))
    }
}

fn all(configuration: &Configuration, language: Language) -> Result<Vec<ControllerEntry>, Problem> {
    if configuration.controllers.is_empty() {
        return Err(Problem::with_detail(ErrorCode::UnknownController, texts::no_controllers(language)));
    }
    Ok(configuration.controllers.clone())
}

fn named(names: &[String], configuration: &Configuration) -> Result<Vec<ControllerEntry>, Problem> {
    let mut chosen: Vec<ControllerEntry> = Vec::new();
    for name in names {
        let entry = configuration.find(name).ok_or_else(|| Problem::with_detail(ErrorCode::UnknownController, name))?;
        if !chosen.iter().any(|c| c.name == entry.name) {
            chosen.push(entry.clone());
        }
    }
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn list(names: &[&str]) -> Configuration {
        let mut configuration = Configuration::default();
        for (i, name) in names.iter().enumerate() {
            configuration.controllers.push(ControllerEntry {
                name: name.parse().unwrap(),
                address: format!("10.0.0.{}", i + 1).parse().unwrap(),
                series: crate::model::ControllerSeries::Rc800,
                connection: crate::model::ConnectionKind::Management,
                fingerprint: None,
                last: None,
            });
        }
        configuration
    }

    fn split(arguments: &[&str], all: bool) -> Result<(Vec<String>, Vec<String>), ErrorCode> {
        let arguments = arguments.iter().map(ToString::to_string).collect();
        let (things, chosen) = ItemsThenControllers { arguments, all }
            .resolve(&list(&["weld", "paint", "operator1"]), Language::En)
            .map_err(|p| p.code)?;
        Ok((things, chosen.iter().map(|c| c.name.to_string()).collect()))
    }

    #[test]
    fn controllers_stand_after_the_things() {
        assert_eq!(split(&["a.der", "b.der", "weld", "paint"], false).unwrap().0, ["a.der", "b.der"]);
        assert_eq!(split(&["a.der", "weld"], false).unwrap().1, ["weld"]);
        assert_eq!(split(&["a.der", "b.der"], true).unwrap().1.len(), 3);
        assert_eq!(split(&["a.der", "wled"], false), Err(ErrorCode::UnknownController));
    }

    #[test]
    fn the_first_argument_is_always_a_thing() {
        assert_eq!(split(&["operator1", "weld"], false).unwrap(), (vec!["operator1".into()], vec!["weld".into()]));
        assert_eq!(split(&["operator1"], false), Err(ErrorCode::UnknownController));
    }
}
