use std::collections::VecDeque;

use chrono::{DateTime, Utc};

use crate::remote::client::RemoteError;
use crate::remote::{Reply, SpelCommand};
use crate::texts::TextKey as T;

/// Commands of SPEL+ that are executed one by one.
#[derive(Debug, Default)]
pub struct ExecuteBox {
    /// The next command, as it is typed.
    pub text: String,
    /// The newest first.
    history: VecDeque<Executed>,
    /// The command of the history that was called back into the field.
    recalled: Option<usize>,
}

/// A command that was sent.
#[derive(Debug, Clone, PartialEq)]
pub struct Executed {
    /// When, by the clock of this PC.
    pub at: DateTime<Utc>,
    /// The command.
    pub text: String,
    /// Its result; `None`: the answer is outstanding.
    pub result: Option<Result<Option<String>, RemoteError>>,
}

const MAX_HISTORY: usize = 50;

impl ExecuteBox {
    /// The command that is typed; why it cannot be sent.
    pub fn typed(&self) -> Result<SpelCommand, T> {
        SpelCommand::new(self.text.trim()).map_err(|_| T::RemoteSpelRule)
    }

    /// The commands that were sent, the newest first.
    pub fn history(&self) -> impl Iterator<Item = &Executed> {
        self.history.iter()
    }

    /// Notes a command that is sent.
    pub fn sent(&mut self, command: &SpelCommand, at: DateTime<Utc>) {
        self.history.push_front(Executed { at, text: command.as_str().to_owned(), result: None });
        self.history.truncate(MAX_HISTORY);
        self.text.clear();
        self.recalled = None;
    }

    /// The answer to the command that was sent last.
    pub fn answered(&mut self, result: Result<Reply, RemoteError>) {
        if let Some(last) = self.history.front_mut().filter(|last| last.result.is_none()) {
            last.result = Some(result.map(|reply| match reply {
                Reply::Output(text) => text,
                _ => None,
            }));
        }
    }

    /// Puts an older command into the field, or a newer one for `by` below 0.
    pub fn recall(&mut self, by: isize) {
        let from = self.recalled.map_or(-1, usize::cast_signed);
        let wanted = from.saturating_add(by);
        match usize::try_from(wanted).ok().filter(|at| *at < self.history.len()) {
            Some(at) => {
                self.text.clone_from(&self.history[at].text);
                self.recalled = Some(at);
            }
            None if wanted < 0 => {
                self.text.clear();
                self.recalled = None;
            }
            None => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_history(commands: &[&str]) -> ExecuteBox {
        let mut execute = ExecuteBox::default();
        for command in commands {
            execute.sent(&SpelCommand::new(*command).unwrap(), DateTime::UNIX_EPOCH);
        }
        execute
    }

    #[test]
    fn older_commands_come_back_and_the_field_is_empty_after_the_newest() {
        let mut execute = with_history(&["Motor On", "Print Here"]);
        let mut after = |by| {
            execute.recall(by);
            execute.text.clone()
        };
        assert_eq!([1, 1, 1, -1, -1, -1].map(&mut after), ["Print Here", "Motor On", "Motor On", "Print Here", "", ""]);
    }

    #[test]
    fn an_answer_belongs_to_the_command_that_was_sent_last() {
        let mut execute = with_history(&["Print Here"]);
        execute.answered(Ok(Reply::Output(Some("X: 1".into()))));
        execute.answered(Ok(Reply::Output(None)));
        let results: Vec<_> = execute.history().map(|one| one.result.clone()).collect();
        assert_eq!(results, [Some(Ok(Some("X: 1".to_owned())))]);
    }

    #[test]
    fn a_command_has_to_be_sendable() {
        let mut execute = ExecuteBox { text: "  ".into(), ..ExecuteBox::default() };
        assert_eq!(execute.typed(), Err(T::RemoteSpelRule));
        execute.text = "x".repeat(257);
        assert_eq!(execute.typed(), Err(T::RemoteSpelRule));
        execute.text = " Print Here ".into();
        assert_eq!(execute.typed().unwrap().as_str(), "Print Here");
    }
}
