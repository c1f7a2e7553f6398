use std::collections::VecDeque;

use crate::records::force::{ForceData, ForceFooter, ForceHeader};
use crate::records::motion::MotionBlock;

/// What a cell gave its readers, as values: a test compares them with what a client has decoded. The oldest packets are
/// dropped beyond a limit.
#[derive(Debug, Clone, PartialEq)]
pub struct CellRecord {
    packets: VecDeque<RecordedPacket>,
    limit: usize,
}

/// One packet before it was encoded.
#[derive(Debug, Clone, PartialEq)]
pub enum RecordedPacket {
    /// Of the force sensor monitor with this number, 1 or 2.
    ForceHeader(u8, Box<ForceHeader>),
    /// Of the force sensor monitor with this number, 1 or 2.
    ForceData(u8, Box<ForceData>),
    /// Of the force sensor monitor with this number, 1 or 2.
    ForceFooter(u8, Box<ForceFooter>),
    /// Of the motion log.
    MotionBlock(Box<MotionBlock>),
}

impl CellRecord {
    /// Nothing yet; at most `limit` packets.
    pub fn new(limit: usize) -> Self {
        Self { packets: VecDeque::new(), limit }
    }

    /// The packets, in the order in which they were read.
    pub fn packets(&self) -> impl ExactSizeIterator<Item = &RecordedPacket> {
        self.packets.iter()
    }

    pub(super) fn push(&mut self, packet: RecordedPacket) {
        if self.packets.len() >= self.limit {
            self.packets.pop_front();
        }
        if self.limit > 0 {
            self.packets.push_back(packet);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_newest_packets_are_kept() {
        let mut record = CellRecord::new(3);
        let packet = |monitor| RecordedPacket::ForceHeader(monitor, Box::default());
        (0..5).for_each(|monitor| record.push(packet(monitor)));
        assert_eq!(record.packets().cloned().collect::<Vec<_>>(), [2, 3, 4].map(packet));
        let mut none = CellRecord::new(0);
        none.push(packet(1));
        assert_eq!(none.packets().len(), 0);
    }
}
