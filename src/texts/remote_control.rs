//! What is said in the window for remote control.

use std::path::Path;

use super::TextKey as T;
use crate::jobs::IoKind;
use crate::model::{Language, StatusFlag};
use crate::remote::client::{RobotIdentity, WearingPart};

in_every_language! {
    remote_control:
    /// The answer to a command is outstanding.
    fn remote_waiting(command: &str) -> String;
    /// The number of an error or warning. `message`: its text, where the firmware has one.
    fn remote_error(code: u16, message: Option<&str>) -> String;
    /// A robot by its number.
    fn remote_robot(number: u8) -> String;
    /// A bit of I/O with its label; `None`: its state is not known.
    fn remote_bit(number: u16, label: Option<&str>, is_on: Option<bool>) -> String;
    /// Why some I/O could not be read.
    fn remote_io_unread(why: &str) -> String;
    /// How many labels of I/O were read, and how many lines of the file hold none.
    fn remote_labels(count: usize, skipped: usize) -> String;
    /// How many messages of the log are shown, and how many older ones were dropped.
    fn remote_log_size(shown: usize, all: usize, dropped: u64) -> String;
    /// A text file was written.
    fn text_saved(path: &Path) -> String;
}

/// What a controller says about one of its robots, in a line.
pub fn remote_robot_line(language: Language, robot: &RobotIdentity) -> String {
    let text = |key: T| key.text(language);
    let on_off = |key: T, on: bool, words: [T; 2]| format!("{} {}", text(key), text(words[usize::from(on)]));
    let due = robot.parts_due.as_ref().filter(|parts| !parts.is_empty()).map(|parts| {
        let parts: Vec<&str> = parts.iter().map(|part| text(part.text_key())).collect();
        format!("{}: {}", text(T::RemotePartsDue), parts.join(", "))
    });
    let facts = [
        robot.name.clone(),
        robot.kind.clone(),
        robot.model.clone(),
        robot.serial.clone(),
        robot.motors_on.map(|on| on_off(T::RemoteMotors, on, [T::LiveOff, T::LiveOn])),
        robot.power_high.map(|high| on_off(T::RemotePower, high, [T::RemoteLow, T::RemoteHigh])),
        due,
    ];
    let facts: Vec<String> = facts.into_iter().flatten().filter(|fact| !fact.is_empty()).collect();
    format!("{}: {}", remote_robot(language, robot.number), facts.join(", "))
}

impl WearingPart {
    /// What the part is called.
    pub const fn text_key(self) -> T {
        match self {
            Self::Battery => T::RemotePartBattery,
            Self::Belt => T::RemotePartBelt,
            Self::Grease => T::RemotePartGrease,
            Self::Motor => T::RemotePartMotor,
            Self::Gear => T::RemotePartGear,
            Self::BallScrew => T::RemotePartBallScrew,
        }
    }
}

/// What a state of the controller means.
pub const fn status_flag(flag: StatusFlag) -> T {
    match flag {
        StatusFlag::Test => T::RemoteFlagTest,
        StatusFlag::Teach => T::RemoteFlagTeach,
        StatusFlag::Auto => T::RemoteFlagAuto,
        StatusFlag::Warning => T::RemoteFlagWarning,
        StatusFlag::SError => T::RemoteFlagSError,
        StatusFlag::Safeguard => T::RemoteFlagSafeguard,
        StatusFlag::EStop => T::RemoteFlagEStop,
        StatusFlag::Error => T::RemoteFlagError,
        StatusFlag::Paused => T::RemoteFlagPaused,
        StatusFlag::Running => T::RemoteFlagRunning,
        StatusFlag::Ready => T::RemoteFlagReady,
    }
}

/// What a kind of I/O is called.
pub const fn io_kind(kind: IoKind) -> T {
    match kind {
        IoKind::Input => T::RemoteInputs,
        IoKind::Output => T::RemoteOutputs,
        IoKind::Memory => T::RemoteMemory,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_robot_is_described_by_what_is_known_of_it() {
        let robot = RobotIdentity {
            number: 1,
            name: Some("Arm".into()),
            motors_on: Some(true),
            parts_due: Some(vec![WearingPart::Belt]),
            ..RobotIdentity::default()
        };
        let line = remote_robot_line(Language::En, &robot);
        assert_eq!(line, "Robot 1: Arm, Motors On, Parts to be replaced: belt");
        for language in Language::ALL {
            assert!(remote_robot_line(language, &robot).contains("Arm"));
        }
    }

    #[test]
    fn a_bit_tells_its_label_and_state() {
        assert_eq!(remote_bit(Language::En, 7, Some("Door"), Some(true)), "Bit 7 Door: on");
        assert_eq!(remote_bit(Language::En, 7, None, None), "Bit 7: not known");
    }
}
