//! The table of all commands. Everything that is known about a command is a row of it; the encoders and decoders of both
//! forms and both sides are made from it.

use super::acceptance::Condition;
use super::decode_error::{DecodeError, EncodeError};
use super::field::{
    AlarmNumber, BitNumber, ErrorNumber, Field, FunctionNumber, JointNumber, MessageLanguage, PartNumber, Password,
    PortNumber, RobotNumber, SpelCommand,
};
use super::reader::Reader;
use super::reply_kind::ReplyKind;
use super::variable::{VariableRead, VariableWrite};
use crate::model::StatusFlags;

/// What a command does to the controller.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Effect {
    /// Begins or ends the session.
    Session,
    /// Reads only: it may be sent again if its answer was damaged.
    Reads,
    /// Changes something or moves something: it must not be sent again unless a person decides so.
    Acts,
}

macro_rules! letter {
    (-) => {
        None
    };
    ($letter:literal) => {
        Some($letter)
    };
}

macro_rules! commands {
    ($(
        $(#[$doc:meta])*
        $name:ident $letter:tt $effect:ident
            $({ $($(#[$field_doc:meta])* $field:ident: $type:ty,)* })?
            -> $reply:ident when [$($condition:ident)*];
    )*) => {
        /// A command, without its parameters.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
        pub enum Command { $($(#[$doc])* $name,)* }

        /// A command with its parameters.
        #[derive(Debug, Clone, PartialEq)]
        pub enum Request {
            $($(#[$doc])* $name $({ $($(#[$field_doc])* $field: $type,)* })?,)*
        }

        impl Command {
            /// Every command, in the order of the manual, then the monitoring commands.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// The name, as the text form spells it.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$name => stringify!($name)),* }
            }

            /// The letter in frames; `None` for the monitoring commands, which exist as text only.
            pub const fn letter(self) -> Option<u8> {
                match self { $(Self::$name => letter!($letter)),* }
            }

            /// Whether it reads or acts.
            pub const fn effect(self) -> Effect {
                match self { $(Self::$name => Effect::$effect),* }
            }

            /// Under which conditions it is accepted; all of them must be met.
            pub const fn conditions(self) -> &'static [Condition] {
                match self { $(Self::$name => &[$(Condition::$condition),*]),* }
            }

            /// What a good answer holds.
            pub(super) const fn reply_kind(self) -> ReplyKind {
                match self { $(Self::$name => ReplyKind::$reply),* }
            }

            /// The length of the parameters in frames; `None` if they have no fixed one.
            pub(super) fn data_width(self) -> Option<usize> {
                let widths: &[Option<usize>] = match self {
                    $(Self::$name => &[$($(<$type as Field>::WIDTH,)*)?],)*
                };
                widths.iter().copied().sum()
            }
        }

        impl Request {
            /// Which command it is.
            pub const fn command(&self) -> Command {
                match self { $(Self::$name { .. } => Command::$name,)* }
            }

            /// The data between the letter and ETX.
            pub(super) fn put_frame_data(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
                match self {
                    $(Self::$name $({ $($field,)* })? => {
                        $($($field.put_frame(out)?;)*)?
                    })*
                }
                Ok(())
            }

            /// Everything that follows the name, each parameter with its comma.
            pub(super) fn put_text_parameters(&self, out: &mut Vec<u8>) -> Result<(), EncodeError> {
                match self {
                    $(Self::$name $({ $($field,)* })? => {
                        $($($field.put_text(out)?;)*)?
                    })*
                }
                Ok(())
            }

            /// Reads [`Request::put_frame_data`] to its end.
            pub(super) fn take_frame_data(command: Command, reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
                let request = match command {
                    $(Command::$name => {
                        $($(
                            reader.field(stringify!($field));
                            let $field = <$type as Field>::take_frame(reader)?;
                        )*)?
                        Self::$name $({ $($field,)* })?
                    })*
                };
                reader.finish().map(|()| request)
            }

            /// Reads [`Request::put_text_parameters`] to its end.
            pub(super) fn take_text_parameters(command: Command, reader: &mut Reader<'_>) -> Result<Self, DecodeError> {
                let request = match command {
                    $(Command::$name => {
                        $($(
                            reader.field(stringify!($field));
                            let $field = <$type as Field>::take_text(reader)?;
                        )*)?
                        Self::$name $({ $($field,)* })?
                    })*
                };
                reader.finish().map(|()| request)
            }
        }
    };
}

// Name, letter, effect, parameters, answer, acceptance conditions (SPEL+ guide, remote RS232 and remote Ethernet).
commands! {
    /// Logs in.
    Login b'L' Session {
        /// Empty if none is set.
        password: Password,
    } -> Nothing when [];
    /// Logs out; refused while tasks run.
    Logout b'l' Session -> Nothing when [];
    /// Runs the function `main` or `main1`–`main63`.
    Start b'G' Acts {
        /// Which.
        function: FunctionNumber,
    } -> Nothing when [Auto Ready NoError NoEStop NoSafeguard];
    /// Stops all tasks and commands.
    Stop b'Q' Acts -> Nothing when [Auto];
    /// Pauses all tasks.
    Pause b'P' Acts -> Nothing when [Auto Running];
    /// Continues paused tasks.
    Continue b'C' Acts -> Nothing when [Auto Paused];
    /// Resets emergency stop and error; outputs go off.
    Reset b'R' Acts -> Nothing when [Auto Ready];
    /// Switches motors on.
    SetMotorsOn b'M' Acts {
        /// 0: of all robots.
        robot: RobotNumber,
    } -> Nothing when [Auto Ready NoEStop NoSafeguard];
    /// Switches motors off.
    SetMotorsOff b'N' Acts {
        /// 0: of all robots.
        robot: RobotNumber,
    } -> Nothing when [Auto Ready];
    /// Selects the robot that Execute acts on.
    SetCurRobot b'Y' Acts {
        /// From 1 on.
        robot: RobotNumber,
    } -> Nothing when [Auto Ready];
    /// Gets the selected robot.
    GetCurRobot b'y' Reads -> Robot when [];
    /// Moves a robot to its home position.
    Home b'H' Acts {
        /// From 1 on.
        robot: RobotNumber,
    } -> Nothing when [Auto Ready NoError NoEStop NoSafeguard];
    /// Gets a bit of I/O.
    GetIO b'i' Reads {
        /// Which.
        bit: BitNumber,
    } -> Bit when [];
    /// Sets an output bit.
    SetIO b'I' Acts {
        /// Which.
        bit: BitNumber,
        /// On.
        on: bool,
    } -> Nothing when [Auto Ready];
    /// Gets eight bits of I/O.
    GetIOByte b'b' Reads {
        /// Bits 8 n to 8 n + 7.
        port: PortNumber,
    } -> Byte when [];
    /// Sets eight output bits.
    SetIOByte b'B' Acts {
        /// Bits 8 n to 8 n + 7.
        port: PortNumber,
        /// Bit 0 is the lowest of them.
        value: u8,
    } -> Nothing when [Auto Ready];
    /// Gets sixteen bits of I/O.
    GetIOWord b'w' Reads {
        /// Bits 16 n to 16 n + 15.
        port: PortNumber,
    } -> Word when [];
    /// Sets sixteen output bits.
    SetIOWord b'W' Acts {
        /// Bits 16 n to 16 n + 15.
        port: PortNumber,
        /// Bit 0 is the lowest of them.
        value: u16,
    } -> Nothing when [Auto Ready];
    /// Gets a bit of memory I/O.
    GetMemIO b'o' Reads {
        /// Which.
        bit: BitNumber,
    } -> Bit when [];
    /// Sets a bit of memory I/O.
    SetMemIO b'O' Acts {
        /// Which.
        bit: BitNumber,
        /// On.
        on: bool,
    } -> Nothing when [Auto Ready];
    /// Gets eight bits of memory I/O.
    GetMemIOByte b't' Reads {
        /// Bits 8 n to 8 n + 7.
        port: PortNumber,
    } -> Byte when [];
    /// Sets eight bits of memory I/O.
    SetMemIOByte b'T' Acts {
        /// Bits 8 n to 8 n + 7.
        port: PortNumber,
        /// Bit 0 is the lowest of them.
        value: u8,
    } -> Nothing when [Auto Ready];
    /// Gets sixteen bits of memory I/O.
    GetMemIOWord b'u' Reads {
        /// Bits 16 n to 16 n + 15.
        port: PortNumber,
    } -> Word when [];
    /// Sets sixteen bits of memory I/O. One table of the manual says one byte for the value; its example has two.
    SetMemIOWord b'U' Acts {
        /// Bits 16 n to 16 n + 15.
        port: PortNumber,
        /// Bit 0 is the lowest of them.
        value: u16,
    } -> Nothing when [Auto Ready];
    /// Gets a variable, or elements of an array.
    GetVariable b'v' Reads {
        /// Which.
        variable: VariableRead,
    } -> Values when [];
    /// Sets a variable.
    SetVariable b'V' Acts {
        /// Which, and to what.
        variable: VariableWrite,
    } -> Nothing when [Auto Ready];
    /// Gets the state of the controller.
    GetStatus b'S' Reads -> Status when [];
    /// Executes a command of SPEL+.
    Execute b'X' Acts {
        /// Which, with its parameters.
        spel: SpelCommand,
    } -> Output when [Auto Ready NoError NoEStop NoSafeguard];
    /// Aborts the command that Execute runs.
    Abort b'A' Acts -> Nothing when [Auto];
    /// Gets the alarms of parts that wear.
    GetAlm b'z' Reads -> Alarms when [];
    /// Resets an alarm.
    ResetAlm b'Z' Acts {
        /// Which.
        alarm: AlarmNumber,
    } -> Nothing when [Auto Ready];

    /// Monitoring: the controller's name; `0` if none is set.
    GetContName - Reads -> Text when [];
    /// Monitoring: the controller's serial number.
    GetContNo - Reads -> Text when [];
    /// Monitoring: the controller's model.
    GetContType - Reads -> Text when [];
    /// Monitoring: the firmware's version.
    GetContVer - Reads -> Text when [];
    /// Monitoring: the control device.
    GetContDev - Reads -> Text when [];
    /// Monitoring: the subnet mask.
    GetSubnetMask - Reads -> Text when [];
    /// Monitoring: the default gateway.
    GetDefaultGateway - Reads -> Text when [];
    /// Monitoring: the MAC address.
    GetContMacAdd - Reads -> Text when [];
    /// Monitoring: the controller's settings, one binary digit each.
    GetContSettings - Reads -> Text when [];
    /// Monitoring: how many robots, then type and model of each.
    GetRobotInfo - Reads -> List when [];
    /// Monitoring: how many robots, then the name of each.
    GetRobotName - Reads {
        /// 0: of all robots.
        robot: RobotNumber,
    } -> List when [];
    /// Monitoring: how many robots, then the serial number of each.
    GetRobotSerial - Reads {
        /// 0: of all robots.
        robot: RobotNumber,
    } -> List when [];
    /// Monitoring: how many robots, then of each whether the motors are on and the power is high.
    GetMotor - Reads {
        /// 0: of all robots.
        robot: RobotNumber,
    } -> List when [];
    /// Monitoring: the pulses of the home offsets, one a joint; the list may be longer than there are joints.
    GetHofs - Reads {
        /// From 1 on.
        robot: RobotNumber,
    } -> List when [];
    /// Monitoring: of the controller's battery the date of installation, the consumption and the months left; or `-1`.
    GetHealthCont - Reads -> List when [];
    /// Monitoring: the same of a part of a robot.
    GetHealthRB - Reads {
        /// From 1 on.
        robot: RobotNumber,
        /// Which kind of part.
        part: PartNumber,
        /// From 1 on.
        joint: JointNumber,
    } -> List when [];
    /// Monitoring: whether battery, belt, grease, motor, gear and ball screw of a robot are to be replaced.
    GetPartWarning - Reads {
        /// From 1 on.
        robot: RobotNumber,
    } -> List when [];
    /// Monitoring: the load of the CPU in per cent.
    GetCpuLoad - Reads -> Text when [];
    /// Monitoring: the name of the project.
    GetPrjName - Reads -> Text when [];
    /// Monitoring: the text of an error or warning.
    GetErrMsg - Reads {
        /// Its number.
        code: ErrorNumber,
        /// In which language, and with it in which encoding.
        language: MessageLanguage,
    } -> Text when [];
    /// Monitoring: function, line, task, robot and time of an error; or `0`.
    GetErrFunc - Reads {
        /// Its number.
        code: ErrorNumber,
    } -> List when [];
}

impl Command {
    /// The command with this letter.
    pub fn from_letter(letter: u8) -> Option<Self> {
        Self::ALL.iter().copied().find(|command| command.letter() == Some(letter))
    }

    /// The command with this name; the case does not matter.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|command| command.name().eq_ignore_ascii_case(name))
    }

    /// The conditions that are not met in this state, in the order of the manual. Empty: the command is accepted.
    pub fn unmet(self, flags: StatusFlags) -> impl Iterator<Item = Condition> {
        self.conditions().iter().copied().filter(move |condition| !condition.is_met(flags))
    }

    /// Whether the controller accepts it while an Execute runs; every other command is refused with 21.
    pub const fn is_accepted_during_execute(self) -> bool {
        matches!(
            self,
            Self::Abort
                | Self::GetStatus
                | Self::SetIO
                | Self::SetIOByte
                | Self::SetIOWord
                | Self::SetMemIO
                | Self::SetMemIOByte
                | Self::SetMemIOWord
        )
    }

    /// Whether the controller accepts it where remote Ethernet is set for monitoring and is not the control device.
    pub const fn is_accepted_for_monitoring(self) -> bool {
        matches!(self.effect(), Effect::Session)
            || matches!(
                self,
                Self::GetIO
                    | Self::GetIOByte
                    | Self::GetIOWord
                    | Self::GetMemIO
                    | Self::GetMemIOByte
                    | Self::GetMemIOWord
                    | Self::GetVariable
                    | Self::GetStatus
            )
            || self.is_of_monitoring_client()
    }

    /// Whether it is one of the commands of the vendor's own monitoring client, which the manual does not have. Firmware
    /// before 7.4.7.2 and 7.4.57.5 answers them with 11.
    pub const fn is_of_monitoring_client(self) -> bool {
        self.letter().is_none()
    }
}

impl std::fmt::Display for Command {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::StatusFlag;

    #[test]
    fn letters_and_names_are_unique() {
        for command in Command::ALL.iter().copied() {
            assert_eq!(Command::from_name(&command.name().to_uppercase()), Some(command));
            if let Some(letter) = command.letter() {
                assert_eq!(Command::from_letter(letter), Some(command));
            }
        }
        let with_letter = Command::ALL.iter().filter(|command| command.letter().is_some()).count();
        assert_eq!((with_letter, Command::ALL.len()), (31, 52));
    }

    #[test]
    fn the_conditions_are_those_of_the_manual() {
        let flags = |on: &[StatusFlag]| {
            let mut flags = StatusFlags::default();
            on.iter().for_each(|flag| flags.set(*flag, true));
            flags
        };
        let unmet = |command: Command, on: &[StatusFlag]| -> Vec<String> {
            command.unmet(flags(on)).map(|condition| condition.to_string()).collect()
        };
        use StatusFlag::*;
        assert_eq!(unmet(Command::Start, &[Auto, Ready]), [""; 0]);
        assert_eq!(unmet(Command::Start, &[Teach, Ready]), ["Auto on"]);
        assert_eq!(
            unmet(Command::Home, &[Auto, Running, Error, EStop, Safeguard]),
            ["Ready on", "Error off", "EStop off", "Safeguard off"]
        );
        assert_eq!(unmet(Command::SetMotorsOn, &[Auto, Ready, Error]), [""; 0]);
        assert_eq!(unmet(Command::Pause, &[Auto, Paused]), ["Running on"]);
        assert_eq!(unmet(Command::Continue, &[Auto, Running]), ["Paused on"]);
        assert_eq!(unmet(Command::Stop, &[Auto, Running, Error]), [""; 0]);
        // What reads is accepted in every state.
        for command in Command::ALL.iter().copied() {
            assert_eq!(command.effect() == Effect::Acts, command.unmet(StatusFlags::default()).next().is_some());
        }
    }

    #[test]
    fn what_is_accepted_during_execute_and_for_monitoring_is_as_the_manual_lists_it() {
        let during = Command::ALL.iter().filter(|command| command.is_accepted_during_execute()).count();
        assert_eq!(during, 8);
        assert!(Command::ALL.iter().all(|c| !c.is_accepted_for_monitoring() || c.effect() != Effect::Acts));
        let not_for_monitoring = [Command::GetCurRobot, Command::GetAlm];
        for command in Command::ALL.iter().filter(|command| command.effect() == Effect::Reads) {
            assert_eq!(command.is_accepted_for_monitoring(), !not_for_monitoring.contains(command), "{command}");
        }
    }

    #[test]
    fn a_password_is_not_shown() {
        let request = Request::Login { password: Password::new("secret").unwrap() };
        assert!(!format!("{request:?}").contains("secret"));
    }
}
