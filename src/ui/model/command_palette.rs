//! The command palette: every command of the window, found by a part of its name.

use egui::{Key, Modifiers};

use super::UiCommand;
use crate::model::Language;
use crate::texts::TextKey as T;

/// What is typed into the palette, and which of the commands found is selected.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CommandPalette {
    /// What was typed.
    pub query: String,
    /// Position among the commands found; may lie beyond them after typing.
    selected: usize,
}

/// What is done in the palette.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum PaletteAction {
    /// The query is this now.
    Type(String),
    /// Move the selection by so many commands, clamped.
    Select(isize),
    /// Closes the palette.
    Close,
}

impl UiCommand {
    /// Opens the command palette.
    pub const COMMAND_PALETTE: Self = Self::new(T::CommandPalette, T::CommandPaletteTip, |model, _| {
        model.command_palette = Some(CommandPalette::default());
        vec![]
    })
    .in_menu(T::MenuHelp)
    .key(Modifiers::COMMAND, Key::K);
}

impl CommandPalette {
    /// Those of the commands that have every word of the query in their name or their menu's, in this language or in
    /// English. Names that begin with the query come first; else they stay in their order.
    pub fn found(&self, language: Language, commands: &[UiCommand]) -> Vec<UiCommand> {
        let query = self.query.trim().to_lowercase();
        let names = |command: UiCommand| [language, Language::En].map(|l| command.full_name(l).to_lowercase());
        let has_all_words =
            |command: &UiCommand| names(*command).iter().any(|name| query.split_whitespace().all(|w| name.contains(w)));
        let offered = |command: &UiCommand| *command != UiCommand::COMMAND_PALETTE;
        let mut found: Vec<_> = commands.iter().copied().filter(offered).filter(has_all_words).collect();
        let begins = |command: UiCommand| {
            [language, Language::En].iter().any(|l| command.text().text(*l).to_lowercase().starts_with(&query))
        };
        found.sort_by_key(|command| !begins(*command));
        found
    }

    /// Position of the selection among `count` commands.
    pub fn selected(&self, count: usize) -> usize {
        self.selected.min(count.saturating_sub(1))
    }

    /// Applies everything but [`PaletteAction::Close`].
    pub(in crate::ui) fn apply(&mut self, action: PaletteAction, language: Language, commands: &[UiCommand]) {
        match action {
            PaletteAction::Type(query) => *self = Self { query, selected: 0 },
            PaletteAction::Select(by) => {
                let count = self.found(language, commands).len();
                self.selected = self.selected(count).saturating_add_signed(by).min(count.saturating_sub(1));
            }
            PaletteAction::Close => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ui::features::COMMANDS;

    fn found(query: &str, language: Language) -> Vec<UiCommand> {
        CommandPalette { query: query.into(), selected: 0 }.found(language, COMMANDS)
    }

    #[test]
    fn a_command_is_found_by_parts_of_its_name_in_both_languages() {
        assert_eq!(found("log serv", Language::En), [UiCommand::SERVER_LOG]);
        assert_eq!(found("日志", Language::Zh), [UiCommand::SERVER_LOG]);
        assert_eq!(found("server LOG", Language::Zh), [UiCommand::SERVER_LOG]);
        assert_eq!(found("日志", Language::En), []);
        assert_eq!(found("no such command", Language::En), []);
    }

    #[test]
    fn names_that_begin_with_the_query_come_first() {
        assert_eq!(found("user", Language::En)[..2], [UiCommand::USERS, UiCommand::USER_SPECIFIED]);
        let all = found("", Language::En);
        assert_eq!(all.len(), COMMANDS.len() - 1, "all but the palette itself");
        assert_eq!(all[0], COMMANDS[0]);
    }

    #[test]
    fn the_selection_stays_among_the_commands_found() {
        let mut palette = CommandPalette::default();
        palette.apply(PaletteAction::Select(-1), Language::En, COMMANDS);
        assert_eq!(palette.selected(palette.found(Language::En, COMMANDS).len()), 0);
        palette.apply(PaletteAction::Select(1000), Language::En, COMMANDS);
        assert_eq!(palette.selected, COMMANDS.len() - 2);
        palette.apply(PaletteAction::Type("log".into()), Language::En, COMMANDS);
        assert_eq!(palette.selected, 0);
    }
}
