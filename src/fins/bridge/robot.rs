//! The robot's side of a bridge.

use std::fmt;

use async_trait::async_trait;
use thiserror::Error;

use super::super::address::{Address, AddressError, AddressRange};
use super::super::client::{ClientError, ClientSettings, FinsClient, WriteError};
use super::super::data_type::{DataType, Value, ValueError, WordOrder};
use crate::model::Cause;

/// Which way a row is copied.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Direction {
    /// From the PLC to the robot.
    ToRobot,
    /// From the robot to the PLC.
    ToPlc,
}

/// What of a robot a row reads or writes. The robot's side knows what the text means.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RobotItem {
    /// A variable, an I/O port, an address: in the words of the robot's side.
    pub text: String,
    /// The type of the values.
    pub data_type: DataType,
    /// How many values; for text, how many words it may have.
    pub count: usize,
    /// The order of words, where the robot's side has words.
    pub word_order: WordOrder,
}

/// Why a robot's side cannot have an item.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ItemError {
    /// The text is no address of a PLC.
    #[error(transparent)]
    Address(#[from] AddressError),
    /// The text is none of the robot's items, or has no values of the type.
    #[error("{0}")]
    Unsuitable(String),
}

/// Why a robot did not give or take values.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum RobotError {
    /// There is no connection, or it was lost before anything was changed.
    #[error("the robot is not reached")]
    NotReached(#[source] Cause),
    /// The robot refused, or its values cannot be used.
    #[error("the robot refuses")]
    Refused(#[source] Cause),
    /// The answer to a write was lost.
    #[error("it is not known whether the robot has the values")]
    Unknown(#[source] Cause),
}

/// A robot, as a bridge needs it. No call may wait without a limit.
#[async_trait]
pub trait RobotSide: fmt::Debug + Send {
    /// Whether the robot can have this item in this direction, as far as it can be said without a connection.
    ///
    /// # Errors
    /// It cannot.
    fn check(&self, item: &RobotItem, direction: Direction) -> Result<(), ItemError>;

    /// Connects if there is no connection.
    ///
    /// # Errors
    /// There is none.
    async fn connect(&mut self) -> Result<(), RobotError>;

    /// How many connections were made so far.
    fn connections(&self) -> u64;

    /// Reads the values of an item.
    ///
    /// # Errors
    /// See [`RobotError`].
    async fn read(&mut self, item: &RobotItem) -> Result<Vec<Value>, RobotError>;

    /// Writes the values of an item, over the connection that stands: it does not connect.
    ///
    /// # Errors
    /// See [`RobotError`].
    async fn write(&mut self, item: &RobotItem, values: &[Value]) -> Result<(), RobotError>;
}

/// A PLC in the place of a robot. Items are addresses: `D310`, `CIO0.00`.
#[derive(Debug)]
pub struct PlcRobot {
    client: FinsClient,
}

impl PlcRobot {
    /// Connects with the first cycle.
    pub fn new(settings: ClientSettings) -> Self {
        Self { client: FinsClient::new(ClientSettings { connects_for_writes: false, ..settings }) }
    }
}

/// The elements that hold `count` values from a word or bit on.
pub(super) fn elements(start: Address, data_type: DataType, count: usize) -> Result<AddressRange, ItemError> {
    if start.is_bit() != (data_type == DataType::Bit) {
        let what = if start.is_bit() { "a bit has the type bit" } else { "a word has no values of the type bit" };
        return Err(ItemError::Unsuitable(format!("{start}: {what}")));
    }
    Ok(AddressRange::new(start, count * data_type.words())?)
}

#[async_trait]
impl RobotSide for PlcRobot {
    fn check(&self, item: &RobotItem, _: Direction) -> Result<(), ItemError> {
        elements(item.text.parse()?, item.data_type, item.count).map(drop)
    }

    async fn connect(&mut self) -> Result<(), RobotError> {
        self.client.connect().await.map(drop).map_err(|error| RobotError::NotReached(Cause::new(error)))
    }

    fn connections(&self) -> u64 {
        self.client.connections()
    }

    async fn read(&mut self, item: &RobotItem) -> Result<Vec<Value>, RobotError> {
        let range = range_of(item)?;
        read_values(&mut self.client, range, item.data_type, item.word_order).await.map_err(|error| match error {
            ReadError::Client(error @ ClientError::EndCode { .. }) => RobotError::Refused(Cause::new(error)),
            ReadError::Client(error) => RobotError::NotReached(Cause::new(error)),
            ReadError::Value(error) => RobotError::Refused(Cause::new(error)),
        })
    }

    async fn write(&mut self, item: &RobotItem, values: &[Value]) -> Result<(), RobotError> {
        let range = range_of(item)?;
        write_values(&mut self.client, range, values, item.data_type, item.word_order).await.map_err(
            |error| match error {
                ValuesNotWritten::Value(error) => RobotError::Refused(Cause::new(error)),
                ValuesNotWritten::Write(error) if error.is_unknown() => RobotError::Unknown(Cause::new(error)),
                ValuesNotWritten::Write(WriteError::NotDone {
                    source: error @ ClientError::EndCode { .. }, ..
                }) => RobotError::Refused(Cause::new(error)),
                ValuesNotWritten::Write(error) => RobotError::NotReached(Cause::new(error)),
            },
        )
    }
}

fn range_of(item: &RobotItem) -> Result<AddressRange, RobotError> {
    let parsed = item.text.parse().map_err(ItemError::from);
    let range = parsed.and_then(|start| elements(start, item.data_type, item.count));
    range.map_err(|error| RobotError::Refused(Cause::new(error)))
}

/// Why values cannot be read.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ReadError {
    /// The PLC was not reached or refused.
    #[error(transparent)]
    Client(ClientError),
    /// Words hold no value of the type.
    #[error(transparent)]
    Value(ValueError),
}

/// Why values were not written.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ValuesNotWritten {
    /// They do not fit into the words; nothing was sent.
    #[error(transparent)]
    Value(ValueError),
    /// The PLC was not reached, refused, or did not answer.
    #[error(transparent)]
    Write(WriteError),
}

/// Reads the values of all elements of a range.
///
/// # Errors
/// See [`ReadError`].
pub async fn read_values(
    client: &mut FinsClient,
    range: AddressRange,
    data_type: DataType,
    order: WordOrder,
) -> Result<Vec<Value>, ReadError> {
    if range.start.is_bit() {
        let bits = client.read_bits(range).await.map_err(ReadError::Client)?;
        return Ok(bits.into_iter().map(Value::Bit).collect());
    }
    let words = client.read_words(range).await.map_err(ReadError::Client)?;
    data_type.decode(&words, order).map_err(ReadError::Value)
}

/// Writes values to the elements of a range.
///
/// # Errors
/// See [`ValuesNotWritten`].
pub async fn write_values(
    client: &mut FinsClient,
    range: AddressRange,
    values: &[Value],
    data_type: DataType,
    order: WordOrder,
) -> Result<(), ValuesNotWritten> {
    let words = data_type.encode(values, order, range.count.into()).map_err(ValuesNotWritten::Value)?;
    let written = if range.start.is_bit() {
        let bits: Vec<bool> = words.iter().map(|word| *word != 0).collect();
        client.write_bits(range.start, &bits).await
    } else {
        client.write_words(range.start, &words).await
    };
    written.map_err(ValuesNotWritten::Write)
}
