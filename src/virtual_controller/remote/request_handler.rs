use std::sync::Arc;

use subtle::ConstantTimeEq as _;

use super::monitoring;
use super::options::{RemoteOptions, RemoteRole};
use super::refusals;
use crate::model::FirmwareVersion;
use crate::remote::{Answer, BitNumber, Password, PortNumber, RefusalCode, RemoteStatus, Reply, Request, RobotNumber};
use crate::virtual_controller::cell::{
    CellCommand, CellHandle, CommandRefusal, Execution, IoDirection, RobotChoice, StatusFlag, find_bit,
};

/// Does what the requests of clients ask of one cell. Knows nothing of connections, logins and forms.
#[derive(Debug, Clone)]
pub(super) struct RequestHandler {
    cell: CellHandle,
    options: Arc<RemoteOptions>,
}

/// What comes of a request.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Outcome {
    /// The answer.
    Answer(Answer),
    /// An Execute runs; [`RequestHandler::execution`] has the answer later.
    Executing(u64),
}

/// Bits of a byte and a word.
const BYTE: u32 = 8;
const WORD: u32 = 16;

impl RequestHandler {
    pub fn new(cell: CellHandle, options: Arc<RemoteOptions>) -> Self {
        Self { cell, options }
    }

    pub fn options(&self) -> &RemoteOptions {
        &self.options
    }

    /// Whether the password opens a session.
    pub fn is_password(&self, password: &Password) -> bool {
        let known = self.options.password.expose().as_bytes();
        known.is_empty() || bool::from(known.ct_eq(password.expose().as_bytes()))
    }

    /// Whether a session may end now: of the control device not while tasks run or are paused.
    pub fn may_log_out(&self) -> bool {
        let flags = self.cell.snapshot().controller.flags;
        let is_idle = !flags.contains(StatusFlag::Running) && !flags.contains(StatusFlag::Paused);
        self.options.role == RemoteRole::Monitor || is_idle
    }

    /// Does what a request of a client that has logged in asks. Login and Logout are none of these.
    pub fn act(&self, request: &Request) -> Outcome {
        let command = request.command();
        let is_too_much = self.options.role == RemoteRole::Monitor && !command.is_accepted_for_monitoring();
        if is_too_much {
            return Outcome::Answer(Answer::Refused(RefusalCode::NotReady));
        }
        if self.cell.is_executing() && !command.is_accepted_during_execute() {
            return Outcome::Answer(Answer::Refused(RefusalCode::ExecuteRunning));
        }
        let is_unknown = command.is_of_monitoring_client() && !monitoring::is_answered_by(self.firmware());
        if is_unknown {
            return Outcome::Answer(Answer::Refused(RefusalCode::UnknownCommand));
        }
        if let Request::Execute { spel } = request {
            return match self.cell.execute(spel.as_str()) {
                Ok(number) => self.execution(number).map_or(Outcome::Executing(number), Outcome::Answer),
                Err(refusal) => Outcome::Answer(Answer::Refused(refusals::of_command(refusal))),
            };
        }
        Outcome::Answer(match self.reply(request) {
            Ok(reply) => Answer::Good(reply),
            Err(code) => Answer::Refused(code),
        })
    }

    /// The answer to an Execute, once it has ended.
    pub fn execution(&self, number: u64) -> Option<Answer> {
        match self.cell.execution(number) {
            Execution::Running { .. } => None,
            Execution::Ended(Ok(text)) => Some(Answer::Good(Reply::Output((!text.is_empty()).then_some(text)))),
            Execution::Ended(Err(error)) => Some(Answer::Refused(refusals::of_execute(&error))),
            Execution::Superseded => Some(Answer::Refused(RefusalCode::SystemError)),
        }
    }

    /// How long nothing changes by itself in an Execute.
    pub fn ask_again(&self, number: u64) -> std::time::Duration {
        match self.cell.execution(number) {
            Execution::Running { ask_again } => ask_again,
            Execution::Ended(_) | Execution::Superseded => std::time::Duration::ZERO,
        }
    }

    /// Ends an Execute whose client is gone.
    pub fn abandon(&self, number: u64) {
        if matches!(self.cell.execution(number), Execution::Running { .. }) {
            // Out of Auto it has ended by itself.
            let _refused = self.cell.command(CellCommand::Abort);
        }
    }

    fn firmware(&self) -> FirmwareVersion {
        self.cell.description().controller.firmware
    }

    fn reply(&self, request: &Request) -> Result<Reply, RefusalCode> {
        let command = match request {
            Request::Start { function } => CellCommand::Start { function: function.get() },
            Request::Stop => CellCommand::Stop,
            Request::Pause => CellCommand::Pause,
            Request::Continue => CellCommand::Continue,
            Request::Reset => CellCommand::Reset,
            Request::SetMotorsOn { robot } => CellCommand::MotorsOn(choice(*robot)),
            Request::SetMotorsOff { robot } => CellCommand::MotorsOff(choice(*robot)),
            Request::SetCurRobot { robot } => CellCommand::CurrentRobot(robot.get()),
            Request::Home { robot } => CellCommand::Home(robot.get()),
            Request::SetIO { bit, on } => self.set_bit(IoDirection::Output, *bit, *on)?,
            Request::SetIOByte { port, value } => self.set_byte(IoDirection::Output, *port, *value)?,
            Request::SetIOWord { port, value } => self.set_word(IoDirection::Output, *port, *value)?,
            Request::SetMemIO { bit, on } => self.set_bit(IoDirection::Memory, *bit, *on)?,
            Request::SetMemIOByte { port, value } => self.set_byte(IoDirection::Memory, *port, *value)?,
            Request::SetMemIOWord { port, value } => self.set_word(IoDirection::Memory, *port, *value)?,
            Request::SetVariable { variable } => CellCommand::SetVariable {
                name: variable.name.as_str().to_owned(),
                kind: Some(variable.kind()),
                element: Vec::new(),
                value: variable.value().clone(),
            },
            Request::Abort => CellCommand::Abort,
            Request::ResetAlm { alarm } => CellCommand::ResetAlarm(alarm.get()),
            other => return self.read(other),
        };
        self.cell.command(command).map(|()| Reply::Done).map_err(refusals::of_command)
    }

    fn read(&self, request: &Request) -> Result<Reply, RefusalCode> {
        Ok(match request {
            Request::GetCurRobot => Reply::Robot(self.cell.current_robot()),
            Request::GetIO { bit } => self.bit(IoDirection::Input, *bit)?,
            Request::GetIOByte { port } => self.byte(IoDirection::Input, *port)?,
            Request::GetIOWord { port } => self.word(IoDirection::Input, *port)?,
            Request::GetMemIO { bit } => self.bit(IoDirection::Memory, *bit)?,
            Request::GetMemIOByte { port } => self.byte(IoDirection::Memory, *port)?,
            Request::GetMemIOWord { port } => self.word(IoDirection::Memory, *port)?,
            Request::GetVariable { variable } => {
                let range = variable.range();
                let element = range.as_ref().map_or(&[][..], |range| range.first.indices());
                let values =
                    self.cell.variable(variable.name.as_str(), Some(variable.kind()), element, variable.count());
                Reply::Values(values.map_err(refusals::of_variable)?)
            }
            Request::GetStatus => {
                let values = self.cell.snapshot().controller;
                Reply::Status(RemoteStatus { flags: values.flags, code: values.status_code })
            }
            Request::GetAlm => Reply::Alarms(self.cell.alarms()),
            other => {
                let known =
                    monitoring::reply(other, &self.cell.description(), &self.cell.snapshot(), self.options.role);
                known.ok_or(RefusalCode::SystemError)?
            }
        })
    }

    fn bit(&self, direction: IoDirection, bit: BitNumber) -> Result<Reply, RefusalCode> {
        let (port, offset) = self.place(direction, bit.get().into())?;
        Ok(Reply::Bit(self.cell.snapshot().io.bit(port, offset)))
    }

    fn byte(&self, direction: IoDirection, byte: PortNumber) -> Result<Reply, RefusalCode> {
        let (port, bit) = self.place(direction, u32::from(byte.get()) * BYTE)?;
        Ok(Reply::Byte(self.cell.snapshot().io.byte(port, bit / 8)))
    }

    /// Bits beyond the port's end are 0.
    fn word(&self, direction: IoDirection, word: PortNumber) -> Result<Reply, RefusalCode> {
        let (port, bit) = self.place(direction, u32::from(word.get()) * WORD)?;
        Ok(Reply::Word(self.cell.snapshot().io.word(port, bit / 16)))
    }

    fn set_bit(&self, direction: IoDirection, bit: BitNumber, on: bool) -> Result<CellCommand, RefusalCode> {
        let (port, offset) = self.place(direction, bit.get().into())?;
        Ok(CellCommand::SetBit { port, offset, on })
    }

    fn set_byte(&self, direction: IoDirection, byte: PortNumber, value: u8) -> Result<CellCommand, RefusalCode> {
        let (port, bit) = self.place(direction, u32::from(byte.get()) * BYTE)?;
        Ok(CellCommand::SetByte { port, offset: bit / 8, value })
    }

    fn set_word(&self, direction: IoDirection, word: PortNumber, value: u16) -> Result<CellCommand, RefusalCode> {
        let (port, bit) = self.place(direction, u32::from(word.get()) * WORD)?;
        Ok(CellCommand::SetWord { port, offset: bit / 16, value })
    }

    fn place(&self, direction: IoDirection, bit: u32) -> Result<(usize, u16), RefusalCode> {
        let found = find_bit(self.cell.description().io, direction, bit);
        found.ok_or(refusals::of_command(CommandRefusal::UnknownPort))
    }
}

fn choice(robot: RobotNumber) -> RobotChoice {
    match robot.get() {
        0 => RobotChoice::All,
        number => RobotChoice::One(number),
    }
}
