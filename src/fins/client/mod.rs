//! A client of one PLC over FINS/TCP or FINS/UDP.
//!
//! - No call waits longer than [`ClientSettings`] allows: connecting, and then one answer for each command that a
//!   request is cut into; over UDP, and where a connection was closed while it was idle, a reading command is sent twice.
//! - A lost connection is made again by the next call. After failed attempts calls fail at once until the next attempt is
//!   due, with growing times between attempts.
//! - A write whose answer was lost is reported as [`WriteError::Unknown`] and not repeated unless the settings say so.
//! - A call that is dropped before its end closes the connection, so that no late answer is taken for another one.

mod error;
mod link;
mod settings;
#[cfg(test)]
mod tests;

use std::time::{Duration, Instant};

use chrono::NaiveDateTime;

use super::address::{Address, AddressRange, WireAddress};
use super::codec::command::{Command, ControllerDataPart};
use super::codec::cpu::{ControllerData, CpuStatus, decode_clock};
use super::codec::response::{Element, Response};
pub use error::{ClientError, StrayAnswer, WriteError};
pub use link::Nodes;
use link::{ExchangeError, Link};
pub use settings::{ClientSettings, DEFAULT_FINS_PORT, MessageLimit, Transport};

/// A client of one PLC. See the module.
#[derive(Debug)]
pub struct FinsClient {
    settings: ClientSettings,
    link: Option<Link>,
    connections: u64,
    retry: Option<Retry>,
}

/// After attempts to connect that failed.
#[derive(Debug)]
struct Retry {
    at: Instant,
    wait: Duration,
    cause: ClientError,
}

/// Why a command that changes something did not succeed.
enum ChangeError {
    NotDone(ClientError),
    Unknown(ClientError),
}

impl FinsClient {
    /// Connects with the first request.
    pub const fn new(settings: ClientSettings) -> Self {
        Self { settings, link: None, connections: 0, retry: None }
    }

    /// The settings.
    pub const fn settings(&self) -> &ClientSettings {
        &self.settings
    }

    /// The nodes of the connection, while there is one.
    pub fn nodes(&self) -> Option<Nodes> {
        self.link.as_ref().map(Link::nodes)
    }

    /// How many connections were made. Two requests with the same number between them were made over one connection.
    pub const fn connections(&self) -> u64 {
        self.connections
    }

    /// Connects if there is no connection, or if the PLC has closed it.
    ///
    /// # Errors
    /// No connection, or the time for the next attempt has not come yet.
    pub async fn connect(&mut self) -> Result<Nodes, ClientError> {
        if self.link.as_mut().is_some_and(|link| !link.is_open()) {
            self.link = None;
        }
        let link = self.take_link().await?;
        Ok(self.link.insert(link).nodes())
    }

    /// Closes the connection. The next request connects again.
    pub fn close(&mut self) {
        self.link = None;
    }

    /// Asks for the status if the connection has been idle for the time of the settings, which keeps it alive and
    /// notices that it is lost. Does nothing without a connection.
    ///
    /// # Errors
    /// As [`FinsClient::status`].
    pub async fn keep_alive(&mut self) -> Result<(), ClientError> {
        let is_idle = self.link.as_ref().is_some_and(|link| link.last_used.elapsed() >= self.settings.idle);
        if is_idle {
            self.status().await?;
        }
        Ok(())
    }

    /// Reads words, or present values of timers and counters.
    ///
    /// # Errors
    /// See [`ClientError`]. What one frame does not hold is read by several commands: values may change between them.
    pub async fn read_words(&mut self, range: AddressRange) -> Result<Vec<u16>, ClientError> {
        words_only(range.start)?;
        let mut words = Vec::with_capacity(range.count.into());
        for (start, count) in pieces(range, self.settings.limit.words_read())? {
            let response = self.ask(&Command::Read { start, count }).await?;
            words.extend(response.words(count).map_err(ClientError::Response)?);
        }
        Ok(words)
    }

    /// Reads bits, or completion flags of timers and counters.
    ///
    /// # Errors
    /// As [`FinsClient::read_words`].
    pub async fn read_bits(&mut self, range: AddressRange) -> Result<Vec<bool>, ClientError> {
        bits_only(range.start)?;
        let mut bits = Vec::with_capacity(range.count.into());
        for (start, count) in pieces(range, self.settings.limit.bits_read())? {
            let response = self.ask(&Command::Read { start, count }).await?;
            bits.extend(response.bits(count).map_err(ClientError::Response)?);
        }
        Ok(bits)
    }

    /// Reads elements that need not follow each other.
    ///
    /// # Errors
    /// As [`FinsClient::read_words`].
    pub async fn read_multiple(&mut self, addresses: &[Address]) -> Result<Vec<Element>, ClientError> {
        let mut elements = Vec::with_capacity(addresses.len());
        for some in addresses.chunks(self.settings.limit.elements_read()) {
            let asked: Vec<WireAddress> = some.iter().map(|address| address.to_wire()).collect();
            let response = self.ask(&Command::ReadMultiple(asked.clone())).await?;
            elements.extend(response.elements(&asked).map_err(ClientError::Response)?);
        }
        Ok(elements)
    }

    /// Writes words, or present values of timers and counters.
    ///
    /// # Errors
    /// See [`WriteError`], which says what was written.
    pub async fn write_words(&mut self, start: Address, words: &[u16]) -> Result<(), WriteError> {
        words_only(start).map_err(nothing_done)?;
        let data: Vec<u8> = words.iter().flat_map(|word| word.to_be_bytes()).collect();
        self.write(start, words.len(), &data, self.settings.limit.words_written()).await
    }

    /// Writes bits.
    ///
    /// # Errors
    /// As [`FinsClient::write_words`].
    pub async fn write_bits(&mut self, start: Address, bits: &[bool]) -> Result<(), WriteError> {
        bits_only(start).map_err(nothing_done)?;
        let data: Vec<u8> = bits.iter().map(|bit| u8::from(*bit)).collect();
        self.write(start, bits.len(), &data, self.settings.limit.bits_written()).await
    }

    async fn write(&mut self, start: Address, count: usize, data: &[u8], most: usize) -> Result<(), WriteError> {
        if count == 0 {
            return Ok(());
        }
        let element_bytes = data.len() / count;
        let range = AddressRange::new(start, count).map_err(|error| nothing_done(ClientError::Address(error)))?;
        let mut done = 0;
        for (start, count) in pieces(range, most).map_err(nothing_done)? {
            let length = usize::from(count);
            let data = data[done * element_bytes..(done + length) * element_bytes].to_vec();
            let written = self.change(&Command::Write { start, count, data }).await;
            written.map_err(|error| error.of_write(done, length))?;
            done += length;
        }
        Ok(())
    }

    /// Writes the same value to all words of a range, in one command.
    ///
    /// # Errors
    /// As [`FinsClient::write_words`].
    pub async fn fill(&mut self, range: AddressRange, value: u16) -> Result<(), WriteError> {
        words_only(range.start).map_err(nothing_done)?;
        let command = Command::Fill { start: range.start.to_wire(), count: range.count, value };
        self.change(&command).await.map_err(|error| error.of_write(0, range.count.into()))
    }

    /// Copies words inside the PLC, in one command.
    ///
    /// # Errors
    /// As [`FinsClient::write_words`].
    pub async fn transfer(&mut self, from: AddressRange, to: Address) -> Result<(), WriteError> {
        words_only(from.start).and_then(|()| words_only(to)).map_err(nothing_done)?;
        let command = Command::Transfer { from: from.start.to_wire(), to: to.to_wire(), count: from.count };
        self.change(&command).await.map_err(|error| error.of_write(0, from.count.into()))
    }

    /// Reads model, version and the sizes of areas.
    ///
    /// # Errors
    /// See [`ClientError`].
    pub async fn controller_data(&mut self) -> Result<ControllerData, ClientError> {
        let response = self.ask(&Command::ControllerData(ControllerDataPart::CpuUnit)).await?;
        ControllerData::decode(&response).map_err(ClientError::Response)
    }

    /// Reads mode, errors and message.
    ///
    /// # Errors
    /// See [`ClientError`].
    pub async fn status(&mut self) -> Result<CpuStatus, ClientError> {
        let response = self.ask(&Command::Status).await?;
        CpuStatus::decode(&response).map_err(ClientError::Response)
    }

    /// Reads the PLC's clock, which has no time zone.
    ///
    /// # Errors
    /// See [`ClientError`].
    pub async fn clock(&mut self) -> Result<NaiveDateTime, ClientError> {
        let response = self.ask(&Command::Clock).await?;
        decode_clock(&response).map_err(ClientError::Response)
    }

    /// Sends a command that changes nothing. It is sent again where a connection turns out to be closed, and over UDP
    /// where no answer comes.
    async fn ask(&mut self, command: &Command) -> Result<Response, ClientError> {
        let was_connected = self.link.is_some();
        let link = self.take_link().await?;
        let response = match self.exchange(link, command).await {
            Err(ExchangeError { error: ClientError::Lost(_), .. }) if was_connected => self.once_more(command).await,
            Err(ExchangeError { error: ClientError::NoAnswer { .. }, .. })
                if self.settings.transport == Transport::Udp =>
            {
                self.once_more(command).await
            }
            Err(ExchangeError { error, .. }) => Err(error),
            Ok(response) => Ok(response),
        };
        let response = response?;
        if response.end.is_normal() { Ok(response) } else { Err(refused(&response)) }
    }

    async fn once_more(&mut self, command: &Command) -> Result<Response, ClientError> {
        let link = self.take_link().await?;
        self.exchange(link, command).await.map_err(|failed| failed.error)
    }

    /// Sends a command that changes something: once, unless the settings say otherwise.
    async fn change(&mut self, command: &Command) -> Result<(), ChangeError> {
        // A connection that the PLC has closed is not written to: the answer could not come.
        if self.link.as_mut().is_some_and(|link| !link.is_open()) {
            self.link = None;
        }
        if self.link.is_none() && !self.settings.connects_for_writes {
            return Err(ChangeError::NotDone(ClientError::NotConnected));
        }
        match self.change_once(command).await {
            Err(ChangeError::Unknown(_)) if self.settings.repeats_uncertain_writes => {
                if let Some(Retry { at, .. }) = &self.retry {
                    tokio::time::sleep_until((*at).into()).await;
                }
                // The first one may have been executed, also if the second one fails.
                self.change_once(command).await.map_err(|error| match error {
                    ChangeError::NotDone(error) | ChangeError::Unknown(error) => ChangeError::Unknown(error),
                })
            }
            result => result,
        }
    }

    async fn change_once(&mut self, command: &Command) -> Result<(), ChangeError> {
        let link = self.take_link().await.map_err(ChangeError::NotDone)?;
        match self.exchange(link, command).await {
            Ok(response) if response.end.is_normal() => Ok(()),
            Ok(response) if response.end.leaves_execution_open() => Err(ChangeError::Unknown(refused(&response))),
            Ok(response) => Err(ChangeError::NotDone(refused(&response))),
            Err(ExchangeError { was_sent: false, error }) => Err(ChangeError::NotDone(error)),
            Err(ExchangeError { was_sent: true, error }) => Err(ChangeError::Unknown(error)),
        }
    }

    /// The connection, made if there is none. It is taken out, so that a call that is dropped leaves none behind.
    async fn take_link(&mut self) -> Result<Link, ClientError> {
        if let Some(link) = self.link.take() {
            return Ok(link);
        }
        if let Some(Retry { at, cause, .. }) = &self.retry {
            let remaining = at.saturating_duration_since(Instant::now());
            if !remaining.is_zero() {
                return Err(ClientError::Waiting { remaining, cause: Box::new(cause.clone()) });
            }
        }
        match Link::open(&self.settings).await {
            Ok(link) => {
                self.connections += 1;
                Ok(link)
            }
            Err(error) => {
                self.put_off(&error);
                Err(error)
            }
        }
    }

    /// The next attempt to connect is made later.
    fn put_off(&mut self, cause: &ClientError) {
        let wait = self.retry.as_ref().map_or(self.settings.first_retry, |retry| retry.wait * 2);
        let wait = wait.min(self.settings.last_retry);
        self.retry = Some(Retry { at: Instant::now() + wait, wait, cause: cause.clone() });
    }

    async fn exchange(&mut self, mut link: Link, command: &Command) -> Result<Response, ExchangeError> {
        let result = link.exchange(command, self.settings.answer).await;
        match &result {
            Ok(_) => {
                self.retry = None;
                self.link = Some(link);
            }
            // A socket of UDP is as good as a new one.
            Err(ExchangeError { error: ClientError::NoAnswer { .. }, .. })
                if self.settings.transport == Transport::Udp =>
            {
                self.link = Some(link);
            }
            // A connection that never worked counts as a failed attempt, so that attempts do not follow at once.
            Err(ExchangeError { error, .. }) if !link.is_proven => self.put_off(error),
            Err(_) => {}
        }
        result
    }
}

impl ChangeError {
    fn of_write(self, done: usize, uncertain: usize) -> WriteError {
        match self {
            Self::NotDone(source) => WriteError::NotDone { done, source },
            Self::Unknown(source) => WriteError::Unknown { done, uncertain, source },
        }
    }
}

fn nothing_done(source: ClientError) -> WriteError {
    WriteError::NotDone { done: 0, source }
}

fn refused(response: &Response) -> ClientError {
    ClientError::EndCode { command: response.code, end: response.end, relay: response.relay_error_at() }
}

fn words_only(address: Address) -> Result<(), ClientError> {
    if address.is_bit() { Err(ClientError::OtherKind("words are needed, and a bit is named")) } else { Ok(()) }
}

fn bits_only(address: Address) -> Result<(), ClientError> {
    if address.is_bit() { Ok(()) } else { Err(ClientError::OtherKind("bits are needed, and a word is named")) }
}

/// A range cut into commands of at most so many elements.
fn pieces(range: AddressRange, most: usize) -> Result<Vec<(WireAddress, u16)>, ClientError> {
    let count = usize::from(range.count);
    let piece = |done: usize| {
        let start = range.start.plus(done).map_err(ClientError::Address)?;
        Ok((start.to_wire(), (count - done).min(most) as u16))
    };
    (0..count).step_by(most).map(piece).collect()
}
