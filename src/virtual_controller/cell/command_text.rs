//! Commands as text, for the plant API and the command line: a word, then values, separated by blanks.

use std::str::FromStr;

use thiserror::Error;

use super::command::{CellCommand, ForceRecording, RobotChoice};
use super::status::OperatingMode;

/// A text that is no command. The message lists what there is.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{0:?} is not a command; the commands are: {COMMANDS}")]
pub struct UnknownCommand(pub String);

/// Every command with its values. Robot 0 stands for all robots.
pub const COMMANDS: &str = "start N, stop, pause, continue, reset, motors-on ROBOT, motors-off ROBOT, home ROBOT, \
     power ROBOT high|low, speed PERCENT, step-mode on|off, step, emergency-stop on|off, door open|closed, \
     mode auto|teach|test, error NUMBER, warning NUMBER, bit PORT OFFSET on|off, byte PORT OFFSET VALUE, \
     record-start ROBOT SECONDS INTERVAL, record-end MONITOR, record-break MONITOR, motion-log on|off|break, \
     wear-out ALARM, reset-alarm ALARM, abort";

impl FromStr for CellCommand {
    type Err = UnknownCommand;

    fn from_str(text: &str) -> Result<Self, UnknownCommand> {
        let words: Vec<&str> = text.split_whitespace().collect();
        parse(&words).ok_or_else(|| UnknownCommand(text.chars().take(80).collect()))
    }
}

fn parse(words: &[&str]) -> Option<CellCommand> {
    Some(match words {
        ["start", function] => CellCommand::Start { function: number(function)? },
        ["stop"] => CellCommand::Stop,
        ["pause"] => CellCommand::Pause,
        ["continue"] => CellCommand::Continue,
        ["reset"] => CellCommand::Reset,
        ["motors-on", robots] => CellCommand::MotorsOn(choice(robots)?),
        ["motors-off", robots] => CellCommand::MotorsOff(choice(robots)?),
        ["home", robot] => CellCommand::Home(number(robot)?),
        ["power", robots, level] => {
            CellCommand::Power { robots: choice(robots)?, high: one_of(level, [("high", true), ("low", false)])? }
        }
        ["speed", percent] => CellCommand::SpeedFactor(number(percent)?),
        ["step-mode", on] => CellCommand::StepMode(switch(on)?),
        ["step"] => CellCommand::StepOn,
        ["emergency-stop", on] => CellCommand::EmergencyStop(switch(on)?),
        ["door", state] => CellCommand::SafetyDoor { open: one_of(state, [("open", true), ("closed", false)])? },
        ["mode", mode] => CellCommand::Mode(one_of(
            mode,
            [("auto", OperatingMode::Auto), ("teach", OperatingMode::Teach), ("test", OperatingMode::Test)],
        )?),
        ["error", code] => CellCommand::RaiseError(number(code)?),
        ["warning", code] => CellCommand::RaiseWarning(number(code)?),
        ["bit", port, offset, on] => {
            CellCommand::SetBit { port: number(port)?, offset: number(offset)?, on: switch(on)? }
        }
        ["byte", port, offset, value] => {
            CellCommand::SetByte { port: number(port)?, offset: number(offset)?, value: number(value)? }
        }
        ["record-start", robot, duration, interval] => CellCommand::RecordStart(ForceRecording {
            robot: number(robot)?,
            duration: number(duration)?,
            interval: number(interval)?,
        }),
        ["record-end", monitor] => CellCommand::RecordEnd(number(monitor)?),
        ["record-break", monitor] => CellCommand::BreakForceRecording(number(monitor)?),
        ["motion-log", "break"] => CellCommand::BreakMotionLogging,
        ["motion-log", on] => CellCommand::MotionLogging(switch(on)?),
        ["wear-out", alarm] => CellCommand::WearOut(number(alarm)?),
        ["reset-alarm", alarm] => CellCommand::ResetAlarm(number(alarm)?),
        ["abort"] => CellCommand::Abort,
        _ => return None,
    })
}

fn number<T: FromStr>(word: &str) -> Option<T> {
    word.parse().ok()
}

fn switch(word: &str) -> Option<bool> {
    one_of(word, [("on", true), ("off", false)])
}

fn choice(word: &str) -> Option<RobotChoice> {
    Some(match number(word)? {
        0 => RobotChoice::All,
        robot => RobotChoice::One(robot),
    })
}

fn one_of<T, const N: usize>(word: &str, choices: [(&str, T); N]) -> Option<T> {
    choices.into_iter().find(|(name, _)| *name == word).map(|(_, value)| value)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every command of the list, with its first choice of words and 1 for numbers.
    fn samples() -> Vec<String> {
        let sample = |word: &str| {
            let is_number = word.chars().all(|character| character.is_ascii_uppercase());
            if is_number { "1".to_owned() } else { word.split('|').next().unwrap().to_owned() }
        };
        COMMANDS
            .split(", ")
            .map(|command| command.split_whitespace().map(sample).collect::<Vec<_>>().join(" "))
            .collect()
    }

    #[test]
    fn every_command_of_the_list_is_understood() {
        let samples = samples();
        assert_eq!(samples.len(), 26);
        for sample in samples {
            let command: CellCommand = sample.parse().unwrap_or_else(|error| panic!("{error}"));
            assert!(format!("{sample} 1").parse::<CellCommand>().is_err(), "{command:?} takes no more");
        }
    }

    #[test]
    fn words_and_numbers_are_checked() {
        assert_eq!("  motors-on   0 ".parse(), Ok(CellCommand::MotorsOn(RobotChoice::All)));
        assert_eq!("power 2 low".parse(), Ok(CellCommand::Power { robots: RobotChoice::One(2), high: false }));
        let recording = ForceRecording { robot: 1, duration: 2.5, interval: 0.002 };
        assert_eq!("record-start 1 2.5 0.002".parse(), Ok(CellCommand::RecordStart(recording)));
        assert_eq!("motion-log break".parse(), Ok(CellCommand::BreakMotionLogging));
        for wrong in
            ["", "Start 0", "start", "start 256", "start -1", "door shut", "mode manual", "error x", "bit 0 0 1"]
        {
            assert_eq!(wrong.parse::<CellCommand>(), Err(UnknownCommand(wrong.to_owned())));
        }
        let long = "x".repeat(500);
        assert_eq!(long.parse::<CellCommand>().unwrap_err().0.len(), 80);
    }
}
