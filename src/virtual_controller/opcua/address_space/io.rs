//! I/O nodes (manual 3.2.3.1; appendix A-3 of its newer edition for virtual I/O).

use super::id::{OWN, standard};
use super::instances::{Instance, Instances};
use super::node::BrowseName;
use super::value::{SettingNode, Source};
use super::vendor_types;
use crate::virtual_controller::cell::{CellDescription, IoDirection, IoGroup, IoPort};

/// Adds an I/O system for each kind of I/O the controller has.
///
/// The signals of a port are bits, or bytes where there are many: the controller has either, never both. With virtual I/O
/// there are words, with their bytes below them, and the bits below those.
pub(super) fn add(space: &mut Instances, components: &Instance, cell: &CellDescription) {
    let generation = cell.controller.generation();
    for group in GROUPS.into_iter().filter(|group| group.is_shown(generation)) {
        let ports: Vec<(usize, IoPort)> =
            cell.io.iter().copied().enumerate().filter(|(_, port)| port.group == group).collect();
        if ports.is_empty() {
            continue;
        }
        let system = space.object(components, BrowseName::new(OWN, group_name(group)), vendor_types::IO_SYSTEM);
        for (index, port) in ports {
            let name = BrowseName::new(OWN, direction_name(port.direction));
            let folder = space.object(&system, name, vendor_types::IO_SIGNALS);
            let signals = Signals { index, port, is_writable: cell.virtual_io && port.direction == IoDirection::Input };
            if cell.virtual_io {
                signals.nested(space, &folder);
            } else if port.bits > MAX_BITS {
                (0..port.bytes()).for_each(|offset| drop(signals.byte(space, &folder, offset)));
            } else {
                (0..port.bits).for_each(|offset| signals.bit(space, &folder, offset));
            }
        }
    }
}

/// The signals of one port.
struct Signals {
    index: usize,
    port: IoPort,
    is_writable: bool,
}

impl Signals {
    /// Words with their bytes and these with their bits; the last byte of an odd number has no word.
    fn nested(&self, space: &mut Instances, folder: &Instance) {
        let mut word = None;
        for byte in 0..self.port.bytes() {
            if byte % 2 == 0 {
                word = (byte + 1 < self.port.bytes()).then(|| self.word(space, folder, byte / 2));
            }
            let byte_node = self.byte(space, word.as_ref().unwrap_or(folder), byte);
            (byte * 8..byte * 8 + 8).for_each(|bit| self.bit(space, &byte_node, bit));
        }
    }

    fn word(&self, space: &mut Instances, parent: &Instance, offset: u16) -> Instance {
        let port = self.index;
        let name = format!("Word_{}", self.port.first_bit / 16 + offset);
        let source = if self.is_writable {
            Source::Setting(SettingNode::InputWord { port, offset })
        } else {
            Source::live(move |cell| cell.io.word(port, offset))
        };
        space.variable(parent, BrowseName::new(OWN, name), standard::UINT16, source)
    }

    fn byte(&self, space: &mut Instances, parent: &Instance, offset: u16) -> Instance {
        let port = self.index;
        let name = format!("Byte_{}", self.port.first_bit / 8 + offset);
        let source = if self.is_writable {
            Source::Setting(SettingNode::InputByte { port, offset })
        } else {
            Source::live(move |cell| cell.io.byte(port, offset))
        };
        space.variable(parent, BrowseName::new(OWN, name), standard::BYTE, source)
    }

    fn bit(&self, space: &mut Instances, parent: &Instance, offset: u16) {
        let port = self.index;
        let name = format!("Bit_{}", self.port.first_bit + offset);
        let source = if self.is_writable {
            Source::Setting(SettingNode::InputBit { port, offset })
        } else {
            Source::live(move |cell| cell.io.bit(port, offset))
        };
        space.variable(parent, BrowseName::new(OWN, name), standard::BOOLEAN, source);
    }
}

/// Ports with more bits than this are shown by bytes.
const MAX_BITS: u16 = 64;

/// In the order of the manual's table; the Drive Unit stands there in the newer edition.
const GROUPS: [IoGroup; 6] = [
    IoGroup::Standard,
    IoGroup::DriveUnit,
    IoGroup::Extended,
    IoGroup::FieldbusSlave,
    IoGroup::FieldbusMaster,
    IoGroup::Memory,
];

const fn group_name(group: IoGroup) -> &'static str {
    match group {
        IoGroup::Standard => "StandardIO",
        IoGroup::DriveUnit => "DriveUnitIO",
        IoGroup::Extended => "ExtendedIO",
        IoGroup::FieldbusSlave => "FieldbusSlaveIO",
        IoGroup::FieldbusMaster => "FieldbusMasterIO",
        IoGroup::Memory => "MemoryIO",
    }
}

const fn direction_name(direction: IoDirection) -> &'static str {
    match direction {
        IoDirection::Input => "Inputs",
        IoDirection::Output => "Outputs",
        IoDirection::Memory => "Memory",
    }
}
