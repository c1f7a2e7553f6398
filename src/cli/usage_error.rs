//! Why a command line cannot be understood, in the languages that have texts for it.

use std::error::Error as _;

use clap::error::{ContextKind, ContextValue, ErrorKind};

use super::value_error::ValueError;
use crate::model::Language;
use crate::texts::{HelpTexts, help};

/// What is wrong, what clap suggests, and the usage. English, and kinds without a text of their own, are in clap's words.
pub fn explain(error: &clap::Error, language: Language) -> String {
    help(language).and_then(|texts| translated(error, &texts, language)).unwrap_or_else(|| error.to_string())
}

fn translated(error: &clap::Error, texts: &HelpTexts, language: Language) -> Option<String> {
    let errors = &texts.usage_errors;
    let context = |kind| error.get(kind).map(|value| listed(value, texts.list_separator));
    let argument = || context(ContextKind::InvalidArg);
    let value = context(ContextKind::InvalidValue).unwrap_or_default();
    let what = match error.kind() {
        ErrorKind::UnknownArgument => errors.unknown_argument.replace("{}", &argument()?),
        ErrorKind::InvalidSubcommand => errors.unknown_command.replace("{}", &context(ContextKind::InvalidSubcommand)?),
        ErrorKind::MissingSubcommand => errors.missing_command.to_owned(),
        ErrorKind::MissingRequiredArgument => errors.missing_arguments.replace("{}", &argument()?),
        ErrorKind::InvalidValue if value.is_empty() => errors.missing_value.replace("{}", &argument()?),
        ErrorKind::InvalidValue | ErrorKind::ValueValidation => {
            errors.wrong_value.replace("{argument}", &argument()?).replace("{value}", &value)
        }
        ErrorKind::TooManyValues => errors.too_many_values.replace("{}", &argument()?),
        ErrorKind::ArgumentConflict => match context(ContextKind::PriorArg) {
            Some(other) if Some(&other) != argument().as_ref() => {
                errors.conflict.replace("{argument}", &argument()?).replace("{other}", &other)
            }
            _ => errors.used_twice.replace("{}", &argument()?),
        },
        _ => return None,
    };
    let mut text = format!("{}{what}", errors.error_heading);
    if let Some(why) = error.source() {
        // The others are clap's own, in English.
        let why = why.downcast_ref::<ValueError>().map_or_else(|| why.to_string(), |why| why.reason(language));
        text.push_str(&format!(" ({why})"));
    }
    if let Some(possible) = context(ContextKind::ValidValue).filter(|values| !values.is_empty()) {
        text.push_str(&texts.possible_values.replace("{}", &possible));
    }
    let suggested = [ContextKind::SuggestedArg, ContextKind::SuggestedSubcommand, ContextKind::SuggestedValue];
    if let Some(suggestion) = suggested.into_iter().find_map(context) {
        text.push_str(&format!("\n{}", errors.did_you_mean.replace("{}", &suggestion)));
    }
    if let Some(ContextValue::StyledStr(usage)) = error.get(ContextKind::Usage) {
        let usage = usage.to_string();
        let usage = usage.strip_prefix("Usage: ").unwrap_or(&usage);
        text.push_str(&format!("\n\n{}{}", texts.usage_heading, usage.trim_end()));
    }
    Some(format!("{text}\n\n{}\n", errors.more_help))
}

fn listed(value: &ContextValue, separator: &str) -> String {
    match value {
        ContextValue::Strings(several) => several.join(separator),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory as _;

    use super::*;
    use crate::cli::{Cli, help::localised};

    fn said(language: Language, arguments: &[&str]) -> String {
        let arguments = ["opcua-configurator"].iter().chain(arguments);
        explain(&localised(Cli::command(), language).try_get_matches_from(arguments).unwrap_err(), language)
    }

    #[test]
    fn what_is_wrong_with_a_command_line_is_said_in_every_language() {
        let wrong: [&[&str]; 7] = [
            &["--no-such-option"],
            &["no-such-command"],
            &["cert"],
            &["cert", "export", "--format", "doc", "weld"],
            &["settings", "set", "--port"],
            &["settings", "set", "--server-log", "perhaps", "weld"],
            &["--json", "--json", "info"],
        ];
        for arguments in wrong {
            let english = said(Language::En, arguments);
            assert!(english.starts_with("error: ") || english.starts_with("Make, request"), "{english}");
            for language in Language::ALL.into_iter().filter(|language| help(*language).is_some()) {
                let said = said(language, arguments);
                for word in ["error:", "Usage:", "unexpected", "required", "For more"] {
                    assert!(!said.contains(word), "{arguments:?} {said}");
                }
            }
        }
        let chinese = said(Language::Zh, &["cert", "export", "--format", "doc", "weld"]);
        assert!(chinese.starts_with("错误：参数 --format <FORMAT> 的值“doc”无效 [可选值："), "{chinese}");
        assert!(chinese.ends_with("请使用 --help 查看帮助。\n"), "{chinese}");
    }

    #[test]
    fn a_value_that_this_program_refuses_is_explained_in_every_language() {
        let wrong: [(&[&str], &str, &str); 4] = [
            (&["settings", "set", "--server-log", "perhaps", "weld"], "neither on nor off", "只能为 on 或 off"),
            (&["ca", "revoke", "01", "--reason", "boredom"], "known are ", "可用的值为 "),
            (&["pki", "verify", "a.der", "--at", "noon"], "RFC 3339", "RFC 3339 格式的时间"),
            (&["pki", "verify", "a.der", "--policy", "Basic"], "known are ", "可用的值为 "),
        ];
        for (arguments, english, chinese) in wrong {
            let told = said(Language::En, arguments);
            assert!(told.contains(english), "{told}");
            let told = said(Language::Zh, arguments);
            assert!(told.contains(chinese), "{told}");
            let told = said(Language::Ja, arguments);
            assert!(!told.contains("known") && !told.contains("neither") && !told.contains("not a time"), "{told}");
        }
    }
}
