use std::time::Duration;

use super::super::codec::MAX_MESSAGE_BYTES;
use super::super::codec::command::WIRE_ADDRESS_BYTES;
use super::super::codec::header::HEADER_BYTES;
use crate::model;

/// The port of FINS over TCP and UDP when an address names none.
pub const DEFAULT_FINS_PORT: u16 = 9_600;

/// How messages travel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Transport {
    /// FINS/TCP: nodes are agreed on, nothing is lost while the connection stands.
    #[default]
    Tcp,
    /// FINS/UDP: a message a datagram. A lost one is noticed when the answer does not come.
    Udp,
}

/// How a client reaches a PLC and how long it waits. No call of a client takes longer than these times allow.
#[derive(Debug, Clone)]
pub struct ClientSettings {
    /// The PLC: host and port.
    pub to: model::Address,
    /// TCP or UDP.
    pub transport: Transport,
    /// The client's own node, 1 to 254. `None`: over TCP the PLC gives one, over UDP it is the last number of this
    /// computer's IPv4 address.
    pub client_node: Option<u8>,
    /// The PLC's node, 1 to 254. `None`: over TCP the PLC says it, over UDP it is the last number of its IPv4 address.
    /// Over TCP, a PLC that says another node is refused.
    pub server_node: Option<u8>,
    /// The network of the PLC that is asked; 0 for the one that is connected. Others need routing tables in the PLC.
    pub network: u8,
    /// The unit that is asked; 0 for the CPU.
    pub unit: u8,
    /// How long resolving a name, connecting and agreeing on nodes may take together. Default 3 s.
    pub connect: Duration,
    /// How long one answer may take. Default 2 s.
    pub answer: Duration,
    /// How long after a failed attempt to connect the next one is made: this, doubled with each failure. Until then calls
    /// fail at once. Default 200 ms.
    pub first_retry: Duration,
    /// The longest time between attempts to connect. Default 10 s.
    pub last_retry: Duration,
    /// How long a connection may be idle until [`super::FinsClient::keep_alive`] asks for the status. Default 10 s.
    pub idle: Duration,
    /// The longest message that all networks on the way carry. Default: Ethernet.
    pub limit: MessageLimit,
    /// Whether a write is sent a second time when its answer was lost. Default: no, it is reported as unknown. A
    /// repetition may overwrite a value that the PLC has changed meanwhile.
    pub repeats_uncertain_writes: bool,
    /// Whether a write connects when there is no connection. Default: yes. A caller that must read before it writes on a
    /// new connection says no.
    pub connects_for_writes: bool,
}

impl ClientSettings {
    /// The defaults, for a PLC.
    pub const fn new(to: model::Address, transport: Transport) -> Self {
        Self {
            to,
            transport,
            client_node: None,
            server_node: None,
            network: 0,
            unit: 0,
            connect: Duration::from_secs(3),
            answer: Duration::from_secs(2),
            first_retry: Duration::from_millis(200),
            last_retry: Duration::from_secs(10),
            idle: Duration::from_secs(10),
            limit: MessageLimit::ETHERNET,
            repeats_uncertain_writes: false,
            connects_for_writes: true,
        }
    }
}

/// The longest message in bytes, header included, and what follows from it for one command.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct MessageLimit(usize);

/// Command code and end code.
const RESPONSE_BYTES: usize = HEADER_BYTES + 4;
/// Command code, address, number of elements.
const WRITE_BYTES: usize = HEADER_BYTES + 2 + WIRE_ADDRESS_BYTES + 2;
/// CJ2 and its units take one word less than the message has room for.
const MOST_WORDS_WRITTEN: usize = 996;
/// The manual's limit, below what the message has room for.
const MOST_ELEMENTS: usize = 167;

impl MessageLimit {
    /// Ethernet and Controller Link: 2,012 bytes; 999 words are read at once, 996 written.
    pub const ETHERNET: Self = Self(MAX_MESSAGE_BYTES);
    /// SYSMAC LINK and DeviceNet: 552 bytes; 269 words are read at once, 267 written.
    pub const SYSMAC_LINK: Self = Self(552);

    /// Words of one read.
    pub const fn words_read(self) -> usize {
        (self.0 - RESPONSE_BYTES) / 2
    }

    /// Words of one write.
    pub const fn words_written(self) -> usize {
        let room = (self.0 - WRITE_BYTES) / 2;
        if room < MOST_WORDS_WRITTEN { room } else { MOST_WORDS_WRITTEN }
    }

    /// Bits of one read.
    pub const fn bits_read(self) -> usize {
        self.0 - RESPONSE_BYTES
    }

    /// Bits of one write.
    pub const fn bits_written(self) -> usize {
        self.0 - WRITE_BYTES
    }

    /// Elements of one multiple read.
    pub const fn elements_read(self) -> usize {
        let room = (self.0 - RESPONSE_BYTES) / 6;
        if room < MOST_ELEMENTS { room } else { MOST_ELEMENTS }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limits_are_those_of_the_manual() {
        let limits = |limit: MessageLimit| (limit.words_read(), limit.words_written(), limit.elements_read());
        assert_eq!(limits(MessageLimit::ETHERNET), (999, 996, 167));
        assert_eq!(limits(MessageLimit::SYSMAC_LINK), (269, 267, 89));
    }
}
