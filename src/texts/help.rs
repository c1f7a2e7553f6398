use crate::model::Language;

/// The help of the command line in a language.
#[derive(Debug, Clone, Copy)]
pub struct HelpTexts {
    /// Heading of the list of commands.
    pub commands_heading: &'static str,
    /// Heading of the list of arguments.
    pub arguments_heading: &'static str,
    /// Heading of the list of options.
    pub options_heading: &'static str,
    /// With what stands between it and the usage.
    pub usage_heading: &'static str,
    /// What is added to an argument's text; `{}` stands for the values.
    pub possible_values: &'static str,
    /// What is added to an argument's text; `{}` stands for the default value.
    pub default_value: &'static str,
    /// What is added to an argument's text; `{}` stands for the environment variable.
    pub environment_variable: &'static str,
    /// What separates the words of a list.
    pub list_separator: &'static str,
    /// Why a command line cannot be understood.
    pub usage_errors: UsageErrorTexts,
    /// Path of a command, such as `cert export`, and its text. The program itself has the empty path.
    pub commands: &'static [(&'static str, &'static str)],
    /// Path of a command, id of an argument, text. Those with the empty path are shared by several commands.
    pub arguments: &'static [(&'static str, &'static str, &'static str)],
}

/// Why a command line cannot be understood. `{}` stands for an argument, a command or their list.
#[derive(Debug, Clone, Copy)]
pub struct UsageErrorTexts {
    /// What begins an error.
    pub error_heading: &'static str,
    /// The argument is not known.
    pub unknown_argument: &'static str,
    /// The command is not known.
    pub unknown_command: &'static str,
    /// A command is missing; `{}` stands for those there are.
    pub missing_command: &'static str,
    /// Arguments are missing.
    pub missing_arguments: &'static str,
    /// An argument has no value.
    pub missing_value: &'static str,
    /// `{argument}` and `{value}` stand for those.
    pub wrong_value: &'static str,
    /// An argument has too many values.
    pub too_many_values: &'static str,
    /// An argument stands twice.
    pub used_twice: &'static str,
    /// `{argument}` and `{other}` stand for two that exclude each other.
    pub conflict: &'static str,
    /// Another word is near to the one that was typed.
    pub did_you_mean: &'static str,
    /// How more help is called.
    pub more_help: &'static str,
}

/// `None`: clap's own words and the doc comments of the arguments, which are English.
pub const fn help(language: Language) -> Option<HelpTexts> {
    in_language!(language, help::texts())
}

impl HelpTexts {
    /// The text of a command, by its path.
    pub fn of_command(&self, path: &str) -> Option<&'static str> {
        self.commands.iter().find(|(command, _)| *command == path).map(|(_, text)| *text)
    }

    /// The text of an argument of this command, or else of the argument that several commands share.
    pub fn of_argument(&self, path: &str, id: &str) -> Option<&'static str> {
        let of = |wanted: &str| {
            self.arguments.iter().find(|(command, argument, _)| *command == wanted && *argument == id).map(|row| row.2)
        };
        of(path).or_else(|| of(""))
    }
}
