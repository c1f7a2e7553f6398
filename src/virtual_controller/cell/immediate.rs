use std::collections::VecDeque;

use super::kinematics::Joints;
use super::spel::error::SpelError;
use super::spel::syntax::Statement;

/// The longest result of an Execute, in bytes (*10 of the remote commands).
const MAX_RESULT: usize = 4060;

/// What Execute runs, or ran last.
#[derive(Debug)]
pub(super) struct Immediate {
    /// Counts the texts that Execute has been given.
    pub number: u64,
    /// What is still to be executed, after `goals`.
    pub statements: VecDeque<Statement>,
    /// Where the robot is still to go, one motion after the other.
    pub goals: VecDeque<Joints>,
    /// The index of the robot that moves.
    pub robot: usize,
    /// What was printed, one line each `Print` or line of `Where`.
    lines: Vec<String>,
    result: Option<Result<String, SpelError>>,
}

impl Immediate {
    /// Nothing is executed yet.
    pub fn new(number: u64, statements: Vec<Statement>, robot: usize) -> Self {
        Self { number, statements: statements.into(), goals: VecDeque::new(), robot, lines: Vec::new(), result: None }
    }

    /// A text that was not understood.
    pub fn failed(number: u64, error: SpelError) -> Self {
        Self { result: Some(Err(error)), ..Self::new(number, Vec::new(), 0) }
    }

    pub const fn is_running(&self) -> bool {
        self.result.is_none()
    }

    /// What came of it; `None` while it runs. The text is empty if nothing was printed.
    pub const fn result(&self) -> Option<&Result<String, SpelError>> {
        self.result.as_ref()
    }

    pub fn print(&mut self, line: String) {
        self.lines.push(line);
    }

    /// Everything was executed.
    pub fn finish(&mut self) {
        let text = self.lines.join(LINE_END);
        self.end(if text.len() > MAX_RESULT { Err(SpelError::ResultTooLong) } else { Ok(text) });
    }

    /// Ends with an error. What ran to its end before keeps its result.
    pub fn fail(&mut self, error: SpelError) {
        self.end(Err(error));
    }

    fn end(&mut self, result: Result<String, SpelError>) {
        if self.is_running() {
            self.statements.clear();
            self.goals.clear();
            self.result = Some(result);
        }
    }
}

/// Between two lines of a result, which is one line in the text form.
const LINE_END: &str = " ";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_result_ends_once_and_has_a_limit() {
        let mut printed = Immediate::new(1, vec![Statement::Where], 0);
        printed.print("a".repeat(4058));
        printed.print("b".to_owned());
        assert!(printed.is_running());
        printed.finish();
        printed.fail(SpelError::Aborted);
        assert!(matches!(printed.result(), Some(Ok(text)) if text.len() == 4060 && text.ends_with("aa b")));

        let mut too_long = Immediate::new(2, Vec::new(), 0);
        too_long.print("a".repeat(4061));
        too_long.finish();
        assert_eq!(too_long.result(), Some(&Err(SpelError::ResultTooLong)));
    }
}
