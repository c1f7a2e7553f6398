//! How the simulated PLC executes and answers commands.

use std::collections::VecDeque;

use chrono::{Local, NaiveDateTime};

use super::super::address::{AddressRange, WireAddress};
use super::super::codec::command::{Command, CommandCode, CommandError, ControllerDataPart};
use super::super::codec::cpu::{ControllerData, CpuStatus, OperatingMode, encode_clock};
use super::super::codec::end_code::{EndCode, KnownEndCode};
use super::super::codec::header::Endpoint;
use super::super::codec::response::Response;
use super::super::codec::{MAX_MESSAGE_BYTES, header::HEADER_BYTES};
use super::memory::Memory;
use crate::model::clock;

/// A write that a client had executed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WriteRecord {
    /// The client's node.
    pub client: u8,
    /// What was written.
    pub range: AddressRange,
    /// The data as it was sent.
    pub data: Vec<u8>,
}

/// The state behind all connections of a simulated PLC.
#[derive(Debug)]
pub struct PlcState {
    /// The memory areas.
    pub memory: Memory,
    /// Mode, errors and message.
    pub status: CpuStatus,
    pub(super) data: ControllerData,
    /// The clock; `None` follows that of this computer.
    pub clock: Option<NaiveDateTime>,
    pub(super) refuses_writes_in_run: bool,
    journal: VecDeque<WriteRecord>,
    /// Commands that were executed or refused.
    pub commands: u64,
    /// Writes that were executed: 0102, 0103 and 0105.
    pub writes: u64,
}

/// Writes that are remembered.
const JOURNAL_RECORDS: usize = 10_000;

/// RUN and STOP (W342 5-3-12, 5-3-13).
const RUN: CommandCode = CommandCode(0x0401);
const STOP: CommandCode = CommandCode(0x0402);

/// Command code, end code and header of a response.
const RESPONSE_BYTES: usize = HEADER_BYTES + 4;

impl PlcState {
    pub(super) fn new(data: ControllerData, mode: OperatingMode, refuses_writes_in_run: bool) -> Self {
        Self {
            memory: Memory::new(data.extended_memory_banks),
            status: CpuStatus::without_errors(mode),
            data,
            clock: None,
            refuses_writes_in_run,
            journal: VecDeque::new(),
            commands: 0,
            writes: 0,
        }
    }

    /// The latest writes (0102), at most 10,000, the oldest first.
    pub fn journal(&self) -> impl Iterator<Item = &WriteRecord> {
        self.journal.iter()
    }

    /// Changes the operating mode, as the switch of a programming tool does.
    pub fn set_mode(&mut self, mode: OperatingMode) {
        self.status.mode = mode;
        self.status.is_running = CpuStatus::without_errors(mode).is_running;
    }

    /// Executes a command as it came, and gives the response. Errors of the PLC are flags of each end code.
    pub(super) fn answer(&mut self, bytes: &[u8], client: Endpoint) -> Response {
        self.commands += 1;
        let code = CommandCode(u16::from_be_bytes([
            bytes.first().copied().unwrap_or_default(),
            bytes.get(1).copied().unwrap_or_default(),
        ]));
        let executed = Command::decode(bytes).map_err(CommandError::end_code).and_then(|command| {
            let data = self.execute(&command, client)?;
            // What does not fit into a message is not sent (110B).
            if data.len() + RESPONSE_BYTES > MAX_MESSAGE_BYTES {
                return Err(KnownEndCode::ResponseTooLong.into());
            }
            Ok(data)
        });
        let mut response = match executed {
            Ok(data) => Response::with_data(code, data),
            Err(end) => Response::ended(code, end),
        };
        response.end.plc_has_fatal_error |= self.status.fatal_errors != 0;
        response.end.plc_has_non_fatal_error |= self.status.non_fatal_errors != 0;
        response
    }

    fn execute(&mut self, command: &Command, client: Endpoint) -> Result<Vec<u8>, EndCode> {
        let memory_error = |error: super::memory::MemoryError| error.end_code();
        if command.changes_memory() && !matches!(command, Command::Other { .. }) {
            self.admit_write()?;
        }
        match command {
            Command::Read { start, count } => self.memory.read(*start, *count).map_err(memory_error),
            Command::Write { start, count, data } => {
                self.memory.write(*start, *count, data).map_err(memory_error)?;
                self.remember(*start, *count, data, client);
                Ok(Vec::new())
            }
            Command::Fill { start, count, value } => {
                self.memory.fill(*start, *count, *value).map_err(memory_error)?;
                self.writes += 1;
                Ok(Vec::new())
            }
            Command::Transfer { from, to, count } => {
                self.memory.transfer(*from, *to, *count).map_err(memory_error)?;
                self.writes += 1;
                Ok(Vec::new())
            }
            Command::ReadMultiple(addresses) => {
                let mut data = Vec::with_capacity(addresses.len() * 3);
                for address in addresses {
                    data.push(address.code);
                    data.extend(self.memory.read(*address, 1).map_err(memory_error)?);
                }
                Ok(data)
            }
            Command::ControllerData(part) => Ok(match part {
                ControllerDataPart::CpuUnit => self.data.encode(),
                ControllerDataPart::CpuBusUnits => ControllerData::encode_bus_units(),
                ControllerDataPart::All => [self.data.encode(), ControllerData::encode_bus_units()].concat(),
            }),
            Command::Status => Ok(self.status.encode()),
            Command::Clock => {
                let time = self.clock.unwrap_or_else(|| clock::now().with_timezone(&Local).naive_local());
                Ok(encode_clock(time).to_vec())
            }
            Command::Other { code: RUN, parameters } => {
                // Program number, mode; without a mode the PLC goes to MONITOR.
                let mode = match parameters.get(2) {
                    None | Some(0x02) => OperatingMode::Monitor,
                    Some(0x04) => OperatingMode::Run,
                    Some(_) => return Err(KnownEndCode::ParameterError.into()),
                };
                self.set_mode(mode);
                Ok(Vec::new())
            }
            Command::Other { code: STOP, .. } => {
                self.set_mode(OperatingMode::Program);
                Ok(Vec::new())
            }
            Command::Other { .. } => Err(KnownEndCode::UndefinedCommand.into()),
        }
    }

    fn admit_write(&self) -> Result<(), EndCode> {
        let is_refused = self.refuses_writes_in_run && self.status.mode == OperatingMode::Run;
        if is_refused { Err(KnownEndCode::NotWhileRunning.into()) } else { Ok(()) }
    }

    fn remember(&mut self, start: WireAddress, count: u16, data: &[u8], client: Endpoint) {
        self.writes += 1;
        let range = start.address().and_then(|start| AddressRange::new(start, count.into()));
        let Ok(range) = range else { return };
        if self.journal.len() == JOURNAL_RECORDS {
            self.journal.pop_front();
        }
        self.journal.push_back(WriteRecord { client: client.node, range, data: data.to_vec() });
    }
}
