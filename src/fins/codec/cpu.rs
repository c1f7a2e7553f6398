//! What a CPU says about itself: controller data (0501), status (0601) and clock (0701).

use std::fmt;

use chrono::{Datelike as _, NaiveDate, NaiveDateTime, Timelike as _};

use super::reader::Reader;
use super::response::{Response, ResponseError};

/// The answer to CPU UNIT DATA READ with parameter 00 (W342 5-3-15).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ControllerData {
    /// Model of the CPU, such as `CJ2M-CPU35`; at most 20 ASCII characters.
    pub model: String,
    /// Version of its system; at most 20 ASCII characters.
    pub version: String,
    /// Program area, in K words.
    pub program_kilowords: u16,
    /// Words of the data memory.
    pub data_memory_words: u16,
    /// Banks of the extended data memory that hold no files.
    pub extended_memory_banks: u8,
}

const MODEL_BYTES: usize = 20;
const VERSION_BYTES: usize = 20;
const SYSTEM_BYTES: usize = 40;
/// Always 23: K bytes of the areas whose bits can be used.
const IO_MEMORY_KILOBYTES: u8 = 23;
/// Always 8: timers and counters, in 1,024.
const TIMERS_AND_COUNTERS: u8 = 8;
/// Model, version, system use, area data.
const CPU_UNIT_BYTES: usize = MODEL_BYTES + VERSION_BYTES + SYSTEM_BYTES + 12;
/// The same, and CPU bus units, remote I/O, racks.
const ALL_BYTES: usize = CPU_UNIT_BYTES + BUS_UNIT_BYTES;
const BUS_UNIT_BYTES: usize = 64 + 2;

impl ControllerData {
    /// The data of a response with parameter 00.
    pub fn encode(&self) -> Vec<u8> {
        let mut data = padded(&self.model, MODEL_BYTES);
        data.extend(padded(&self.version, VERSION_BYTES));
        data.extend([0; SYSTEM_BYTES]);
        data.extend(self.program_kilowords.to_be_bytes());
        data.push(IO_MEMORY_KILOBYTES);
        data.extend(self.data_memory_words.to_be_bytes());
        data.extend([TIMERS_AND_COUNTERS, self.extended_memory_banks, 0, 0, 0, 0, 0]);
        data
    }

    /// The data of a response with parameter 01: no CPU bus units, one rack.
    pub fn encode_bus_units() -> Vec<u8> {
        vec![0; BUS_UNIT_BYTES]
    }

    /// Reads a response with parameter 00 or without a parameter. Older CPUs send less area data.
    ///
    /// # Errors
    /// Model and version are missing, or more data than a CPU sends.
    pub fn decode(response: &Response) -> Result<Self, ResponseError> {
        let wrong =
            || ResponseError::WrongLength { code: response.code, found: response.data.len(), expected: CPU_UNIT_BYTES };
        if response.data.len() > ALL_BYTES {
            return Err(wrong());
        }
        let mut reader = Reader(&response.data);
        let model = text(reader.take(MODEL_BYTES).ok_or_else(wrong)?);
        let version = text(reader.take(VERSION_BYTES).ok_or_else(wrong)?);
        reader.take(SYSTEM_BYTES);
        Ok(Self {
            model,
            version,
            program_kilowords: reader.u16().unwrap_or_default(),
            data_memory_words: reader.take(1).and_then(|_| reader.u16()).unwrap_or_default(),
            extended_memory_banks: reader.take(1).and_then(|_| reader.u8()).unwrap_or_default(),
        })
    }
}

/// Blanks fill the field; what is too long or no printable ASCII is left out.
fn padded(text: &str, bytes: usize) -> Vec<u8> {
    let mut padded: Vec<u8> = text.bytes().filter(|byte| (b' '..=b'~').contains(byte)).take(bytes).collect();
    padded.resize(bytes, b' ');
    padded
}

fn text(bytes: &[u8]) -> String {
    let shown = bytes.iter().map(|byte| if (b' '..=b'~').contains(byte) { char::from(*byte) } else { ' ' });
    shown.collect::<String>().trim().to_owned()
}

/// The operating mode of a CPU.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum OperatingMode {
    /// PROGRAM: the user program does not run.
    Program,
    /// DEBUG, of CV series.
    Debug,
    /// MONITOR: the program runs and may be changed.
    Monitor,
    /// RUN: the program runs.
    Run,
    /// A number that the manual does not have.
    Other(u8),
}

impl OperatingMode {
    const fn code(self) -> u8 {
        match self {
            Self::Program => 0x00,
            Self::Debug => 0x01,
            Self::Monitor => 0x02,
            Self::Run => 0x04,
            Self::Other(code) => code,
        }
    }

    const fn from_code(code: u8) -> Self {
        match code {
            0x00 => Self::Program,
            0x01 => Self::Debug,
            0x02 => Self::Monitor,
            0x04 => Self::Run,
            other => Self::Other(other),
        }
    }
}

/// The manual's word, for programs and people alike.
impl fmt::Display for OperatingMode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Program => f.write_str("PROGRAM"),
            Self::Debug => f.write_str("DEBUG"),
            Self::Monitor => f.write_str("MONITOR"),
            Self::Run => f.write_str("RUN"),
            Self::Other(code) => write!(f, "{code:02X}"),
        }
    }
}

/// The answer to CPU UNIT STATUS READ (W342 5-3-17).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CpuStatus {
    /// Whether the user program is executed.
    pub is_running: bool,
    /// Whether the CPU waits for another device.
    pub is_on_standby: bool,
    /// The operating mode.
    pub mode: OperatingMode,
    /// Errors that stop the PLC, a bit each.
    pub fatal_errors: u16,
    /// Errors that let the PLC run, a bit each.
    pub non_fatal_errors: u16,
    /// Messages that wait, a bit each.
    pub messages: u16,
    /// The code of the most serious error; 0 without an error.
    pub error_code: u16,
    /// The text of an FAL or FALS error, at most 16 characters.
    pub error_message: String,
}

const MESSAGE_BYTES: usize = 16;
const STATUS_BYTES: usize = 10 + MESSAGE_BYTES;

/// Fatal errors by their bit (W342 5-3-17).
pub const FATAL_ERRORS: [(u8, PlcErrorKind); 10] = [
    (0, PlcErrorKind::Watchdog),
    (6, PlcErrorKind::Fals),
    (8, PlcErrorKind::CycleTimeOver),
    (9, PlcErrorKind::Program),
    (10, PlcErrorKind::IoSetting),
    (11, PlcErrorKind::TooManyIoPoints),
    (12, PlcErrorKind::InnerBoard),
    (13, PlcErrorKind::Duplication),
    (14, PlcErrorKind::IoBus),
    (15, PlcErrorKind::Memory),
];

/// Non-fatal errors by their bit (W342 5-3-17).
pub const NON_FATAL_ERRORS: [(u8, PlcErrorKind); 12] = [
    (2, PlcErrorKind::SpecialIoUnitSetting),
    (3, PlcErrorKind::CpuBusUnitSetting),
    (4, PlcErrorKind::Battery),
    (5, PlcErrorKind::SysmacBus),
    (6, PlcErrorKind::SpecialIoUnit),
    (7, PlcErrorKind::CpuBusUnit),
    (8, PlcErrorKind::InnerBoard),
    (9, PlcErrorKind::IoVerification),
    (10, PlcErrorKind::PlcSetup),
    (12, PlcErrorKind::BasicIoUnit),
    (13, PlcErrorKind::InterruptTask),
    (15, PlcErrorKind::Fal),
];

/// An error that a CPU reports.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names of the manual")]
pub enum PlcErrorKind {
    Watchdog,
    Fals,
    Fal,
    CycleTimeOver,
    Program,
    IoSetting,
    TooManyIoPoints,
    InnerBoard,
    Duplication,
    IoBus,
    Memory,
    SpecialIoUnitSetting,
    CpuBusUnitSetting,
    Battery,
    SysmacBus,
    SpecialIoUnit,
    CpuBusUnit,
    IoVerification,
    PlcSetup,
    BasicIoUnit,
    InterruptTask,
}

impl CpuStatus {
    /// A CPU without errors.
    pub const fn without_errors(mode: OperatingMode) -> Self {
        Self {
            is_running: matches!(mode, OperatingMode::Run | OperatingMode::Monitor | OperatingMode::Debug),
            is_on_standby: false,
            mode,
            fatal_errors: 0,
            non_fatal_errors: 0,
            messages: 0,
            error_code: 0,
            error_message: String::new(),
        }
    }

    /// The fatal errors that the manual names.
    pub fn fatal(&self) -> impl Iterator<Item = PlcErrorKind> {
        errors(&FATAL_ERRORS, self.fatal_errors)
    }

    /// The non-fatal errors that the manual names.
    pub fn non_fatal(&self) -> impl Iterator<Item = PlcErrorKind> {
        errors(&NON_FATAL_ERRORS, self.non_fatal_errors)
    }

    /// The data of a response.
    pub fn encode(&self) -> Vec<u8> {
        let mut data = vec![u8::from(self.is_running) | u8::from(self.is_on_standby) << 7, self.mode.code()];
        for number in [self.fatal_errors, self.non_fatal_errors, self.messages, self.error_code] {
            data.extend(number.to_be_bytes());
        }
        data.extend(padded(&self.error_message, MESSAGE_BYTES));
        data
    }

    /// Reads the data of a response.
    ///
    /// # Errors
    /// Another length.
    pub fn decode(response: &Response) -> Result<Self, ResponseError> {
        let wrong =
            ResponseError::WrongLength { code: response.code, found: response.data.len(), expected: STATUS_BYTES };
        let mut reader = Reader(&response.data);
        let mut read = || {
            let (status, mode) = (reader.u8()?, reader.u8()?);
            let status = Self {
                is_running: status & 0x01 != 0,
                is_on_standby: status & 0x80 != 0,
                mode: OperatingMode::from_code(mode),
                fatal_errors: reader.u16()?,
                non_fatal_errors: reader.u16()?,
                messages: reader.u16()?,
                error_code: reader.u16()?,
                error_message: text(reader.take(MESSAGE_BYTES)?),
            };
            reader.0.is_empty().then_some(status)
        };
        read().ok_or(wrong)
    }
}

fn errors(table: &'static [(u8, PlcErrorKind)], bits: u16) -> impl Iterator<Item = PlcErrorKind> {
    table.iter().filter(move |(bit, _)| bits & (1 << bit) != 0).map(|(_, kind)| *kind)
}

/// The bytes of a clock: year, month, day, hour, minute, second in BCD, and the day of the week from Sunday, 0
/// (W342 5-3-19).
pub fn encode_clock(time: NaiveDateTime) -> [u8; 7] {
    let year = time.year().rem_euclid(100);
    let parts = [
        u32::try_from(year).unwrap_or_default(),
        time.month(),
        time.day(),
        time.hour(),
        time.minute(),
        time.second(),
        time.weekday().num_days_from_sunday(),
    ];
    parts.map(|part| (((part / 10) << 4) | (part % 10)) as u8)
}

/// Reads a clock. Years 98 and 99 are 1998 and 1999, all others are in this century.
///
/// # Errors
/// Another length, or no date or time.
pub fn decode_clock(response: &Response) -> Result<NaiveDateTime, ResponseError> {
    let bytes: [u8; 7] = response.data.as_slice().try_into().map_err(|_| ResponseError::WrongLength {
        code: response.code,
        found: response.data.len(),
        expected: 7,
    })?;
    let decimal =
        |bcd: u8| (bcd >> 4 <= 9 && bcd & 0x0F <= 9).then(|| u32::from(bcd >> 4) * 10 + u32::from(bcd & 0x0F));
    let read = || {
        let [year, month, day, hour, minute, second, _] = bytes.map(decimal);
        let year = i32::try_from(year?).ok()?;
        let year = if year >= 98 { 1_900 + year } else { 2_000 + year };
        NaiveDate::from_ymd_opt(year, month?, day?)?.and_hms_opt(hour?, minute?, second?)
    };
    read().ok_or(ResponseError::BadValue("clock"))
}
