//! The values of remote commands as they are typed.

use clap::ValueEnum;

use crate::cli::CommandContext;
use crate::model::{ErrorCode, Problem, SpelType};
use crate::remote::{
    BitNumber, Element, ElementRange, Fault, MAX_ELEMENTS, PortNumber, Request, VariableName, VariableRead,
    VariableWrite, value_from_text,
};
use crate::texts;

/// How many bits of I/O a number stands for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum IoUnit {
    /// One bit, by its number.
    Bit,
    /// Eight bits: port n has bits 8 n to 8 n + 7.
    Byte,
    /// Sixteen bits: port n has bits 16 n to 16 n + 15.
    Word,
}

/// I/O, or memory I/O.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum IoArea {
    Io,
    Memory,
}

/// A value of an argument that is not possible. `possible`: what is.
fn bad(cli: &CommandContext, argument: &str, value: &str, possible: &str) -> Problem {
    let text = texts::remote_bad_argument(cli.output.language(), argument, value, possible);
    Problem::with_detail(ErrorCode::RemoteRequestInvalid, text)
}

/// The request to read I/O.
pub fn get_io(cli: &CommandContext, area: IoArea, unit: IoUnit, number: u16) -> Result<Request, Problem> {
    Ok(match (area, unit) {
        (IoArea::Io, IoUnit::Bit) => Request::GetIO { bit: bit(cli, number)? },
        (IoArea::Io, IoUnit::Byte) => Request::GetIOByte { port: port(cli, number)? },
        (IoArea::Io, IoUnit::Word) => Request::GetIOWord { port: port(cli, number)? },
        (IoArea::Memory, IoUnit::Bit) => Request::GetMemIO { bit: bit(cli, number)? },
        (IoArea::Memory, IoUnit::Byte) => Request::GetMemIOByte { port: port(cli, number)? },
        (IoArea::Memory, IoUnit::Word) => Request::GetMemIOWord { port: port(cli, number)? },
    })
}

/// The request to set I/O.
pub fn set_io(cli: &CommandContext, area: IoArea, unit: IoUnit, number: u16, value: &str) -> Result<Request, Problem> {
    let on = || match value {
        "on" | "1" => Ok(true),
        "off" | "0" => Ok(false),
        _ => Err(bad(cli, "VALUE", value, "on, off, 1, 0")),
    };
    let byte = || {
        let number = integer(value).and_then(|number| u8::try_from(number).ok());
        number.ok_or_else(|| bad(cli, "VALUE", value, "0–255, 0x00–0xFF"))
    };
    let word = || integer(value).ok_or_else(|| bad(cli, "VALUE", value, "0–65535, 0x0000–0xFFFF"));
    Ok(match (area, unit) {
        (IoArea::Io, IoUnit::Bit) => Request::SetIO { bit: bit(cli, number)?, on: on()? },
        (IoArea::Io, IoUnit::Byte) => Request::SetIOByte { port: port(cli, number)?, value: byte()? },
        (IoArea::Io, IoUnit::Word) => Request::SetIOWord { port: port(cli, number)?, value: word()? },
        (IoArea::Memory, IoUnit::Bit) => Request::SetMemIO { bit: bit(cli, number)?, on: on()? },
        (IoArea::Memory, IoUnit::Byte) => Request::SetMemIOByte { port: port(cli, number)?, value: byte()? },
        (IoArea::Memory, IoUnit::Word) => Request::SetMemIOWord { port: port(cli, number)?, value: word()? },
    })
}

fn bit(cli: &CommandContext, number: u16) -> Result<BitNumber, Problem> {
    BitNumber::new(number).ok_or_else(|| bad(cli, "NUMBER", &number.to_string(), "0–65535"))
}

fn port(cli: &CommandContext, number: u16) -> Result<PortNumber, Problem> {
    let port = u8::try_from(number).ok().and_then(PortNumber::new);
    port.ok_or_else(|| bad(cli, "NUMBER", &number.to_string(), "0–255"))
}

/// Decimal, or hexadecimal after `0x`.
fn integer(text: &str) -> Option<u16> {
    match text.strip_prefix("0x").or_else(|| text.strip_prefix("0X")) {
        Some(digits) => u16::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    }
}

/// The request to read a variable: `name`, or elements of an array from `name(1,2)` on.
pub fn get_variable(
    cli: &CommandContext,
    variable: &str,
    kind: SpelType,
    count: Option<u16>,
) -> Result<Request, Problem> {
    let (name, first) = match variable.split_once('(') {
        None => (variable, None),
        Some((name, rest)) => {
            let element = rest.strip_suffix(')').and_then(element);
            (name, Some(element.ok_or_else(|| bad(cli, "NAME", variable, "name(1), name(1,2), name(1,2,3)"))?))
        }
    };
    let name = self::name(cli, name)?;
    let read = match (first, count) {
        (None, None) => Some(VariableRead::scalar(name, kind)),
        (None, Some(_)) => return Err(bad(cli, "NAME", variable, "name(0), name(0,0), name(0,0,0)")),
        (Some(first), count) => {
            let count = count.unwrap_or(1);
            let range = ElementRange::new(first, count);
            let range = range.ok_or_else(|| bad(cli, "--count", &count.to_string(), &format!("1–{MAX_ELEMENTS}")))?;
            VariableRead::elements(name, kind, range)
        }
    };
    let variable = read.ok_or_else(|| bad(cli, "--type", kind.keyword(), &numeric_types()))?;
    Ok(Request::GetVariable { variable })
}

fn element(indices: &str) -> Option<Element> {
    let indices: Option<Vec<u16>> = indices.split(',').map(|index| index.trim().parse::<u16>().ok()).collect();
    Element::new(&indices?)
}

/// Every type but String, arrays of which cannot be read.
fn numeric_types() -> String {
    let types = SpelType::ALL.into_iter().filter(|kind| *kind != SpelType::String);
    types.map(SpelType::keyword).collect::<Vec<_>>().join(", ")
}

/// The request to set a variable that is no array.
pub fn set_variable(cli: &CommandContext, variable: &str, kind: SpelType, value: &str) -> Result<Request, Problem> {
    let name = name(cli, variable)?;
    let wrong = || bad(cli, "VALUE", value, kind.keyword());
    let value = value_from_text(kind, value).map_err(|_: Fault| wrong())?;
    let variable = VariableWrite::new(name, kind, value).ok_or_else(wrong)?;
    Ok(Request::SetVariable { variable })
}

fn name(cli: &CommandContext, name: &str) -> Result<VariableName, Problem> {
    name.parse().map_err(|_: Fault| bad(cli, "NAME", name, "A–Z, a–z, 0–9, _, $"))
}
