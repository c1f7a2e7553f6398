use std::sync::Arc;

use crate::model::FirmwareGeneration;

/// A kind of I/O of the controller (manual 3.2.3.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum IoGroup {
    /// Standard I/O: 24 inputs, 16 outputs.
    Standard,
    /// I/O of a drive unit; current firmware only.
    DriveUnit,
    /// Extended I/O: one expansion board.
    Extended,
    /// Fieldbus slave I/O; current firmware only.
    FieldbusSlave,
    /// Fieldbus master I/O; current firmware only.
    FieldbusMaster,
    /// Memory I/O, neither input nor output. Legacy firmware has it too, but does not show it to OPC UA clients.
    Memory,
}

impl IoGroup {
    /// Whether the address space of this firmware shows the group (manual 3.2.3.1).
    pub const fn is_shown(self, generation: FirmwareGeneration) -> bool {
        match (generation, self) {
            (FirmwareGeneration::Legacy, group) => matches!(group, Self::Standard | Self::Extended),
            (FirmwareGeneration::Current, _) => true,
        }
    }
}

/// The direction of an I/O port.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum IoDirection {
    /// Read by the controller.
    Input,
    /// Driven by the controller.
    Output,
    /// Memory I/O.
    Memory,
}

/// Signals of one group and direction with consecutive bit numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct IoPort {
    /// The kind of I/O.
    pub group: IoGroup,
    /// Input, output or memory.
    pub direction: IoDirection,
    /// The number of the first bit, as SPEL+ and the remote commands count it; a multiple of 8.
    pub first_bit: u16,
    /// How many bits; a multiple of 8.
    pub bits: u16,
}

impl IoPort {
    /// How many bytes.
    pub const fn bytes(self) -> u16 {
        self.bits / 8
    }

    /// Whether the bit with this number belongs to the port.
    pub const fn contains(self, bit: u16) -> bool {
        bit >= self.first_bit && bit - self.first_bit < self.bits
    }
}

/// The I/O ports of a controller, in the order of the values in [`IoValues`].
///
/// The manual states the numbers of the standard I/O (inputs 0–23, outputs 0–15). The numbers of the other groups are those
/// of the vendor's controllers: expansion from 64, drive unit from 256, fieldbus slave from 512, fieldbus master from 1024,
/// memory from 0.
pub const fn io_ports(generation: FirmwareGeneration) -> &'static [IoPort] {
    match generation {
        FirmwareGeneration::Legacy => &LEGACY_PORTS,
        FirmwareGeneration::Current => &CURRENT_PORTS,
    }
}

const fn port(group: IoGroup, direction: IoDirection, first_bit: u16, bits: u16) -> IoPort {
    IoPort { group, direction, first_bit, bits }
}

const STANDARD_IN: IoPort = port(IoGroup::Standard, IoDirection::Input, 0, 24);
const STANDARD_OUT: IoPort = port(IoGroup::Standard, IoDirection::Output, 0, 16);
const EXTENDED_IN: IoPort = port(IoGroup::Extended, IoDirection::Input, 64, 24);
const EXTENDED_OUT: IoPort = port(IoGroup::Extended, IoDirection::Output, 64, 16);

const MEMORY: IoPort = port(IoGroup::Memory, IoDirection::Memory, 0, 1024);

const LEGACY_PORTS: [IoPort; 5] = [STANDARD_IN, STANDARD_OUT, EXTENDED_IN, EXTENDED_OUT, MEMORY];
const CURRENT_PORTS: [IoPort; 11] = [
    STANDARD_IN,
    STANDARD_OUT,
    EXTENDED_IN,
    EXTENDED_OUT,
    port(IoGroup::DriveUnit, IoDirection::Input, 256, 24),
    port(IoGroup::DriveUnit, IoDirection::Output, 256, 16),
    port(IoGroup::FieldbusSlave, IoDirection::Input, 512, 256),
    port(IoGroup::FieldbusSlave, IoDirection::Output, 512, 256),
    port(IoGroup::FieldbusMaster, IoDirection::Input, 1024, 256),
    port(IoGroup::FieldbusMaster, IoDirection::Output, 1024, 256),
    MEMORY,
];

/// Where a bit is, by the number that SPEL+ and the remote commands give it: the index of its port, and the bit's place from
/// the port's first bit on. Byte n begins with bit 8 n, word n with bit 16 n. `None` if no port of this direction has it.
pub fn find_bit(ports: &[IoPort], direction: IoDirection, number: u32) -> Option<(usize, u16)> {
    let number = u16::try_from(number).ok()?;
    let index = ports.iter().position(|port| port.direction == direction && port.contains(number))?;
    Some((index, number - ports[index].first_bit))
}

/// The state of all I/O, one entry a port of [`io_ports`]. Bit n of byte m is bit 8 m + n of the port; 1 = on. Cloning is
/// cheap.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IoValues(Vec<Arc<[u8]>>);

impl IoValues {
    /// Everything off.
    pub fn off(ports: &[IoPort]) -> Self {
        Self(ports.iter().map(|port| vec![0; usize::from(port.bytes())].into()).collect())
    }

    /// The bytes of the port with this index; empty if there is none.
    pub fn bytes(&self, port: usize) -> &[u8] {
        self.0.get(port).map_or(&[], |bytes| bytes)
    }

    /// Bit `offset` of the port, counted from the port's first bit; `false` beyond its end.
    pub fn bit(&self, port: usize, offset: u16) -> bool {
        self.bytes(port).get(usize::from(offset / 8)).is_some_and(|byte| byte >> (offset % 8) & 1 == 1)
    }

    /// Byte `offset` of the port; 0 beyond its end.
    pub fn byte(&self, port: usize, offset: u16) -> u8 {
        self.bytes(port).get(usize::from(offset)).copied().unwrap_or(0)
    }

    /// Word `offset` of the port, lower byte first; 0 beyond its end.
    pub fn word(&self, port: usize, offset: u16) -> u16 {
        let offset = offset.saturating_mul(2);
        u16::from_le_bytes([self.byte(port, offset), self.byte(port, offset.saturating_add(1))])
    }

    /// Sets one byte; beyond the port's end nothing happens.
    pub fn set_byte(&mut self, port: usize, offset: u16, value: u8) {
        let Some(bytes) = self.0.get_mut(port) else { return };
        if bytes.get(usize::from(offset)).is_some_and(|old| *old != value) {
            let mut changed = bytes.to_vec();
            changed[usize::from(offset)] = value;
            *bytes = changed.into();
        }
    }

    /// Sets one bit; beyond the port's end nothing happens.
    pub fn set_bit(&mut self, port: usize, offset: u16, on: bool) {
        let old = self.byte(port, offset / 8);
        let mask = 1 << (offset % 8);
        self.set_byte(port, offset / 8, if on { old | mask } else { old & !mask });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legacy_firmware_has_standard_and_extended_io_only() {
        let groups = |generation| io_ports(generation).iter().map(|port| port.group).collect::<Vec<_>>();
        let legacy = FirmwareGeneration::Legacy;
        let shown = groups(legacy).into_iter().filter(|group| group.is_shown(legacy));
        assert!(shown.eq([IoGroup::Standard, IoGroup::Standard, IoGroup::Extended, IoGroup::Extended]));
        let current = groups(FirmwareGeneration::Current);
        assert!(current.iter().all(|group| group.is_shown(FirmwareGeneration::Current)));
        for group in [IoGroup::DriveUnit, IoGroup::FieldbusSlave, IoGroup::FieldbusMaster, IoGroup::Memory] {
            assert!(current.contains(&group), "{group:?}");
        }
        for generation in [FirmwareGeneration::Legacy, FirmwareGeneration::Current] {
            for (at, port) in io_ports(generation).iter().enumerate() {
                assert!(port.bits % 8 == 0 && port.first_bit % 8 == 0);
                let clash = io_ports(generation)[at + 1..]
                    .iter()
                    .any(|other| other.direction == port.direction && port.contains(other.first_bit));
                assert!(!clash, "{port:?}");
            }
        }
    }

    #[test]
    fn bits_are_found_by_the_numbers_of_spel() {
        let ports = io_ports(FirmwareGeneration::Current);
        assert_eq!(find_bit(ports, IoDirection::Input, 23), Some((0, 23)));
        assert_eq!(find_bit(ports, IoDirection::Input, 24), None);
        assert_eq!(find_bit(ports, IoDirection::Output, 65), Some((3, 1)));
        assert_eq!(find_bit(ports, IoDirection::Output, 1024), Some((9, 0)));
        assert_eq!(find_bit(ports, IoDirection::Memory, 1023), Some((10, 1023)));
        assert_eq!(find_bit(ports, IoDirection::Memory, 1024), None);
        assert_eq!(find_bit(ports, IoDirection::Input, 65_536), None);
    }

    #[test]
    fn bits_bytes_and_words_agree() {
        let ports = io_ports(FirmwareGeneration::Current);
        let mut values = IoValues::off(ports);
        let before = values.clone();
        values.set_bit(0, 17, true);
        values.set_byte(0, 0, 0x81);
        assert_eq!((values.byte(0, 2), values.word(0, 0), values.word(0, 1)), (2, 0x81, 2));
        assert!(values.bit(0, 17) && values.bit(0, 7) && !values.bit(0, 24) && !before.bit(0, 17));
        values.set_bit(0, 24, true);
        values.set_byte(99, 0, 1);
        assert_eq!(values.bytes(0), [0x81, 0, 2]);
        values.set_bit(0, 17, false);
        assert_eq!(values.byte(0, 2), 0);
    }
}
