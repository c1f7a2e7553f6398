//! The help of the command line in the languages that have texts for it.

use clap::{Arg, ArgAction, Command};

use crate::model::Language;
use crate::texts::{HelpTexts, help};

/// The command line with its help in a language. English is in the doc comments of the arguments.
pub fn localised(command: Command, language: Language) -> Command {
    match help(language) {
        None => command,
        Some(texts) => translated(command, "", &texts),
    }
}

/// Whether clap's own words are used, with its colours.
pub fn is_of_clap(language: Language) -> bool {
    help(language).is_none()
}

fn translated(command: Command, path: &str, texts: &HelpTexts) -> Command {
    let command = match texts.of_command(path) {
        Some(about) => command.about(about).long_about(about),
        None => command,
    };
    let names: Vec<String> = command.get_subcommands().map(|below| below.get_name().to_owned()).collect();
    let help = Arg::new("help").short('h').long("help").action(ArgAction::Help);
    let mut command = command.disable_help_flag(true).arg(help);
    if path.is_empty() {
        let version = Arg::new("version").short('V').long("version").action(ArgAction::Version);
        command = command.disable_version_flag(true).arg(version);
    }
    let command = command
        .subcommand_help_heading(texts.commands_heading)
        .help_template(format!(
            "{{about-with-newline}}\n{}{{usage}}\n\n{{all-args}}{{after-help}}",
            texts.usage_heading
        ))
        .disable_help_subcommand(true)
        .mut_args(|arg| argument(arg, path, texts));
    names.into_iter().fold(command, |command, name| {
        let below = if path.is_empty() { name.clone() } else { format!("{path} {name}") };
        command.mut_subcommand(name, |subcommand| translated(subcommand, &below, texts))
    })
}

fn argument(arg: Arg, path: &str, texts: &HelpTexts) -> Arg {
    let heading = if arg.is_positional() { texts.arguments_heading } else { texts.options_heading };
    let text = texts.of_argument(path, arg.get_id().as_str()).map(|text| format!("{text}{}", choices(&arg, texts)));
    let takes_values = arg.get_action().takes_values();
    let arg = arg.help_heading(heading);
    let Some(text) = text else { return arg };
    // One text for -h and --help; clap's own remarks are English.
    let arg = arg.help(text.clone()).long_help(text);
    if takes_values { arg.hide_possible_values(true).hide_default_value(true).hide_env(true) } else { arg }
}

/// The values to choose from, the default and the environment variable, as clap would add them.
fn choices(arg: &Arg, texts: &HelpTexts) -> String {
    if !arg.get_action().takes_values() {
        return String::new();
    }
    let mut text = String::new();
    let possible: Vec<String> = arg.get_possible_values().iter().map(|value| value.get_name().to_owned()).collect();
    if !possible.is_empty() {
        text.push_str(&texts.possible_values.replace("{}", &possible.join(texts.list_separator)));
    }
    let default: Vec<_> = arg.get_default_values().iter().map(|value| value.to_string_lossy()).collect();
    if default.iter().any(|value| !value.is_empty()) {
        text.push_str(&texts.default_value.replace("{}", &default.join(texts.list_separator)));
    }
    if let Some(variable) = arg.get_env() {
        text.push_str(&texts.environment_variable.replace("{}", &variable.to_string_lossy()));
    }
    text
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;
    use crate::cli::Cli;

    /// Paths of all commands, and of each the ids of its own arguments.
    fn all(command: &Command, path: &str, found: &mut Vec<(String, Vec<String>)>) {
        let ids = command.get_arguments().map(|arg| arg.get_id().to_string()).collect();
        found.push((path.to_owned(), ids));
        for below in command.get_subcommands() {
            let path =
                if path.is_empty() { below.get_name().to_owned() } else { format!("{path} {}", below.get_name()) };
            all(below, &path, found);
        }
    }

    #[test]
    fn every_command_and_argument_has_a_text_and_no_text_is_left_over() {
        let mut found = Vec::new();
        all(&Cli::command(), "", &mut found);
        for texts in Language::ALL.into_iter().filter_map(help) {
            assert_complete(&found, &texts);
        }
    }

    fn assert_complete(found: &[(String, Vec<String>)], texts: &HelpTexts) {
        let missing_commands: Vec<_> = found.iter().filter(|(path, _)| texts.of_command(path).is_none()).collect();
        let missing_arguments: Vec<_> = found
            .iter()
            .flat_map(|(path, ids)| ids.iter().map(move |id| (path, id)))
            .filter(|(path, id)| texts.of_argument(path, id).is_none())
            .collect();
        assert!(
            missing_commands.is_empty() && missing_arguments.is_empty(),
            "{missing_commands:?} {missing_arguments:?}"
        );
        for (path, _) in texts.commands {
            assert!(found.iter().any(|(known, _)| known == path), "no command is called {path:?}");
        }
        for (path, id, _) in texts.arguments.iter().filter(|(path, ..)| !path.is_empty()) {
            let known = found.iter().any(|(command, ids)| command == path && ids.iter().any(|known| known == id));
            assert!(known, "{path:?} has no argument {id:?}");
        }
    }

    #[test]
    fn the_help_is_in_the_language_that_was_chosen() {
        let help = |language, path: &[&str]| {
            let mut command = localised(Cli::command(), language);
            command.build();
            let found = path.iter().fold(&mut command, |command, name| command.find_subcommand_mut(name).unwrap());
            found.render_long_help().to_string()
        };
        let chinese = help(Language::Zh, &["cert", "self-signed"]);
        for text in ["创建并安装自签名服务器证书", "用法：", "选项", "--country <CC>", "国家，ISO 3166-1", "显示帮助"]
        {
            assert!(chinese.contains(text), "no {text} in\n{chinese}");
        }
        for text in ["Options:", "Usage:", "Print help", "Country"] {
            assert!(!chinese.contains(text), "{text} in\n{chinese}");
        }
        let japanese = help(Language::Ja, &["cert", "self-signed"]);
        for text in ["自己署名のサーバー証明書を作成", "使用方法：", "オプション", "--country <CC>", "ヘルプを表示"]
        {
            assert!(japanese.contains(text), "no {text} in\n{japanese}");
        }
        assert!(help(Language::En, &["cert", "self-signed"]).contains("Make and install a self-signed"));
        let root = help(Language::Zh, &[]);
        assert!(root.contains("命令") && root.contains("启动 OPC UA 服务器") && !root.contains("Commands:"), "{root}");
    }
}
