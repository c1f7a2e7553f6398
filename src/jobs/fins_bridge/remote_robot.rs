//! A robot controller with remote commands, as the robot's side of a bridge.

use std::time::Duration;

use async_trait::async_trait;

use super::remote_item::{IoUnit, RemoteItem, RemoteItemError};
use crate::fins::bridge::robot::{Direction, ItemError, RobotError, RobotItem, RobotSide};
use crate::fins::data_type::{DataType, Value};
use crate::model::{Cause, SpelType, SpelValue};
use crate::remote::client::{RemoteClient, RemoteError, RemoteTarget, RemoteTimeouts};
use crate::remote::{
    BitNumber, ElementRange, Password, PortNumber, Reply, Request, VariableName, VariableRead, VariableWrite,
};

/// How long one cycle waits for a connection. The client goes on waiting in the next cycle.
const CONNECT_IN_CYCLE: Duration = Duration::from_secs(2);

const TIMEOUTS: RemoteTimeouts = RemoteTimeouts {
    connect: Duration::from_secs(2),
    answer: Duration::from_secs(3),
    // A bridge moves nothing.
    motion: Duration::from_secs(3),
};

/// A controller with remote Ethernet or remote RS232.
#[derive(Debug)]
pub struct RemoteRobot {
    client: RemoteClient,
    connections: u64,
}

impl RemoteRobot {
    /// Connects and logs in with the first cycle.
    pub fn new(target: RemoteTarget, password: Password) -> Self {
        Self { client: RemoteClient::new(target, password, TIMEOUTS), connections: 0 }
    }

    async fn request(&mut self, request: &Request) -> Result<Reply, RobotError> {
        self.client.request(request).await.map_err(|error| match error {
            RemoteError::OutcomeUnknown { .. } => RobotError::Unknown(Cause::new(error)),
            RemoteError::Refused { .. } | RemoteError::NotReady { .. } | RemoteError::NotSent { .. } => {
                RobotError::Refused(Cause::new(error))
            }
            error => RobotError::NotReached(Cause::new(error)),
        })
    }
}

/// The requests for the values of an item, in the order of the values.
#[derive(Debug)]
enum Access {
    Io { is_memory: bool, unit: IoUnit, numbers: std::ops::Range<u16> },
    Read(VariableRead),
    Write(VariableName, SpelType),
}

fn access(item: &RobotItem, direction: Direction) -> Result<Access, RemoteItemError> {
    let (text, count) = (item.text.clone(), item.count);
    let wrong_type = || RemoteItemError::Type { item: item.text.clone(), data_type: item.data_type };
    match item.text.parse::<RemoteItem>()? {
        RemoteItem::Io { is_memory, unit, first } => {
            let fits = match unit {
                IoUnit::Bit => item.data_type == DataType::Bit,
                IoUnit::Byte | IoUnit::Word => item.data_type.range().is_some() && item.data_type.words() == 1,
            };
            if !fits {
                return Err(wrong_type());
            }
            let most = if unit == IoUnit::Bit { u16::MAX } else { u8::MAX.into() };
            let end = u16::try_from(count).ok().and_then(|count| first.checked_add(count));
            let end = end.filter(|end| *end - 1 <= most).ok_or(RemoteItemError::Count(text))?;
            Ok(Access::Io { is_memory, unit, numbers: first..end })
        }
        RemoteItem::Variable { name, element, kind } => {
            let kind = kind.unwrap_or_else(|| declared(item.data_type));
            if (kind == SpelType::String) != (item.data_type == DataType::Text) {
                return Err(wrong_type());
            }
            // The count of a text is that of its words.
            let values = if item.data_type == DataType::Text { 1 } else { count };
            match (direction, element) {
                (Direction::ToRobot, None) if values == 1 => Ok(Access::Write(name, kind)),
                // SetVariable sets variables that are no arrays.
                (Direction::ToRobot, _) => Err(RemoteItemError::Count(text)),
                (Direction::ToPlc, None) if values == 1 => Ok(Access::Read(VariableRead::scalar(name, kind))),
                (Direction::ToPlc, None) => Err(RemoteItemError::Count(text)),
                (Direction::ToPlc, Some(first)) => {
                    let range = u16::try_from(values).ok().and_then(|count| ElementRange::new(first, count));
                    let read = range.and_then(|range| VariableRead::elements(name, kind, range));
                    read.map(Access::Read).ok_or(RemoteItemError::Count(text))
                }
            }
        }
    }
}

/// The type of a variable that holds values of a row's type.
const fn declared(data_type: DataType) -> SpelType {
    match data_type {
        DataType::Bit => SpelType::Boolean,
        DataType::U16 | DataType::Bcd16 => SpelType::UShort,
        DataType::I16 => SpelType::Integer,
        DataType::U32 | DataType::Bcd32 => SpelType::UInt32,
        DataType::I32 => SpelType::Long,
        DataType::F32 => SpelType::Real,
        DataType::Text => SpelType::String,
    }
}

fn refused(text: &'static str) -> RobotError {
    RobotError::Refused(Cause::finding(text))
}

#[async_trait]
impl RobotSide for RemoteRobot {
    fn check(&self, item: &RobotItem, direction: Direction) -> Result<(), ItemError> {
        access(item, direction).map(drop).map_err(|error| ItemError::Unsuitable(error.to_string()))
    }

    async fn connect(&mut self) -> Result<(), RobotError> {
        if self.client.is_connected() {
            return Ok(());
        }
        let connected = tokio::time::timeout(CONNECT_IN_CYCLE, self.client.connect()).await;
        let late = |_| RobotError::NotReached(Cause::finding("not connected yet"));
        connected.map_err(late)?.map_err(|error| RobotError::NotReached(Cause::new(error)))?;
        self.connections += 1;
        Ok(())
    }

    fn connections(&self) -> u64 {
        self.connections
    }

    async fn read(&mut self, item: &RobotItem) -> Result<Vec<Value>, RobotError> {
        let access = access(item, Direction::ToPlc).map_err(|error| RobotError::Refused(Cause::new(error)))?;
        match access {
            Access::Io { is_memory, unit, numbers } => {
                let mut values = Vec::with_capacity(numbers.len());
                for number in numbers {
                    let request = get_io(is_memory, unit, number).ok_or_else(|| refused("no such port"))?;
                    values.push(match self.request(&request).await? {
                        Reply::Bit(on) => Value::Bit(on),
                        Reply::Byte(byte) => Value::Integer(byte.into()),
                        Reply::Word(word) => Value::Integer(word.into()),
                        _ => return Err(refused("the answer is that of another command")),
                    });
                }
                Ok(values)
            }
            Access::Read(variable) => match self.request(&Request::GetVariable { variable }).await? {
                Reply::Values(values) => values.iter().map(to_value).collect(),
                _ => Err(refused("the answer is that of another command")),
            },
            Access::Write(..) => Err(refused("the item is written only")),
        }
    }

    async fn write(&mut self, item: &RobotItem, values: &[Value]) -> Result<(), RobotError> {
        // Over a new connection nothing is written that was read before it.
        if !self.client.is_connected() {
            return Err(RobotError::NotReached(Cause::finding("the connection was lost after the values were read")));
        }
        let access = access(item, Direction::ToRobot).map_err(|error| RobotError::Refused(Cause::new(error)))?;
        match access {
            Access::Io { is_memory, unit, numbers } => {
                for (number, value) in numbers.zip(values) {
                    let request = set_io(is_memory, unit, number, value);
                    let request = request.ok_or_else(|| refused("the value does not fit into the port"))?;
                    self.request(&request).await?;
                }
                Ok(())
            }
            Access::Write(name, kind) => {
                let value = values.first().and_then(|value| to_spel(value, kind));
                let variable = value.and_then(|value| VariableWrite::new(name, kind, value));
                let variable = variable.ok_or_else(|| refused("the value does not fit into the variable"))?;
                self.request(&Request::SetVariable { variable }).await.map(drop)
            }
            Access::Read(_) => Err(refused("the item is read only")),
        }
    }
}

fn get_io(is_memory: bool, unit: IoUnit, number: u16) -> Option<Request> {
    let port = || PortNumber::new(u8::try_from(number).ok()?);
    Some(match (is_memory, unit) {
        (false, IoUnit::Bit) => Request::GetIO { bit: BitNumber::new(number)? },
        (true, IoUnit::Bit) => Request::GetMemIO { bit: BitNumber::new(number)? },
        (false, IoUnit::Byte) => Request::GetIOByte { port: port()? },
        (true, IoUnit::Byte) => Request::GetMemIOByte { port: port()? },
        (false, IoUnit::Word) => Request::GetIOWord { port: port()? },
        (true, IoUnit::Word) => Request::GetMemIOWord { port: port()? },
    })
}

/// `None` for a value that the unit cannot hold. A negative word has the bits of its two's complement.
fn set_io(is_memory: bool, unit: IoUnit, number: u16, value: &Value) -> Option<Request> {
    let port = || PortNumber::new(u8::try_from(number).ok()?);
    Some(match (unit, value) {
        (IoUnit::Bit, Value::Bit(on)) => {
            let bit = BitNumber::new(number)?;
            if is_memory { Request::SetMemIO { bit, on: *on } } else { Request::SetIO { bit, on: *on } }
        }
        (IoUnit::Byte, Value::Integer(value)) => {
            let (port, value) = (port()?, u8::try_from(*value).ok()?);
            if is_memory { Request::SetMemIOByte { port, value } } else { Request::SetIOByte { port, value } }
        }
        (IoUnit::Word, Value::Integer(value)) => {
            let bits = u16::try_from(*value).ok().or_else(|| i16::try_from(*value).ok().map(i16::cast_unsigned))?;
            let port = port()?;
            if is_memory {
                Request::SetMemIOWord { port, value: bits }
            } else {
                Request::SetIOWord { port, value: bits }
            }
        }
        _ => return None,
    })
}

fn to_value(value: &SpelValue) -> Result<Value, RobotError> {
    Ok(match value {
        SpelValue::Boolean(on) => Value::Bit(*on),
        SpelValue::Int8(number) => Value::Integer((*number).into()),
        SpelValue::Int16(number) => Value::Integer((*number).into()),
        SpelValue::Int32(number) => Value::Integer((*number).into()),
        SpelValue::Int64(number) => Value::Integer(*number),
        SpelValue::UInt8(number) => Value::Integer((*number).into()),
        SpelValue::UInt16(number) => Value::Integer((*number).into()),
        SpelValue::UInt32(number) => Value::Integer((*number).into()),
        SpelValue::UInt64(number) => {
            Value::Integer(i64::try_from(*number).map_err(|_| refused("the value is too large"))?)
        }
        SpelValue::Float(number) => Value::Float(*number),
        SpelValue::Double(number) => Value::Float(*number as f32),
        SpelValue::String(text) => Value::Text(text.clone()),
    })
}

/// `None` for a value that a variable of the type cannot hold.
fn to_spel(value: &Value, kind: SpelType) -> Option<SpelValue> {
    if let Value::Text(text) = value {
        return (kind == SpelType::String).then(|| SpelValue::String(text.clone()));
    }
    let number = match value {
        Value::Float(number) => {
            match kind {
                SpelType::Real => return Some(SpelValue::Float(*number)),
                SpelType::Double => return Some(SpelValue::Double((*number).into())),
                _ => {}
            }
            // Only whole numbers become integers.
            if number.fract() == 0.0 { *number as i64 } else { return None }
        }
        Value::Integer(number) => *number,
        Value::Bit(on) => i64::from(*on),
        Value::Text(_) => return None,
    };
    Some(match kind {
        SpelType::Boolean => SpelValue::Boolean(number != 0),
        SpelType::Byte => SpelValue::Int8(number.try_into().ok()?),
        SpelType::Short | SpelType::Integer => SpelValue::Int16(number.try_into().ok()?),
        SpelType::Long | SpelType::Int32 => SpelValue::Int32(number.try_into().ok()?),
        SpelType::Int64 => SpelValue::Int64(number),
        SpelType::UByte => SpelValue::UInt8(number.try_into().ok()?),
        SpelType::UShort => SpelValue::UInt16(number.try_into().ok()?),
        SpelType::UInt32 => SpelValue::UInt32(number.try_into().ok()?),
        SpelType::UInt64 => SpelValue::UInt64(number.try_into().ok()?),
        SpelType::Real => SpelValue::Float(number as f32),
        SpelType::Double => SpelValue::Double(number as f64),
        SpelType::String => return None,
    })
}
