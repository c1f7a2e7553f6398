use std::collections::HashMap;

use crate::jobs::{IoGroupPoints, LivePoint};
use crate::model::opcua::{DataValue, NodeId, Value};

/// A lamp.
#[derive(Debug, Clone, PartialEq)]
pub struct IoBit<'a> {
    /// Number within the group: of bit nodes as they are numbered, of byte and word nodes counted from their number.
    pub number: u32,
    /// `None`: there is no value.
    pub is_on: Option<bool>,
    /// The node that it is part of.
    pub point: &'a LivePoint,
}

/// The bits of a group of signals. A byte has eight, a word sixteen; bit 0 is the lowest (manual 3.2.3.1).
pub fn bits<'a>(group: &'a IoGroupPoints, values: &HashMap<NodeId, DataValue>) -> Vec<IoBit<'a>> {
    let mut bits = Vec::new();
    for signal in &group.signals {
        let value = values.get(&signal.point.node);
        let (width, pattern) = match value.map(|value| &value.value) {
            Some(Value::Boolean(is_on)) => (1, Some(u32::from(*is_on))),
            Some(Value::Byte(byte)) => (8, Some(u32::from(*byte))),
            Some(Value::UInt16(word)) => (16, Some(u32::from(*word))),
            _ => (1, None),
        };
        let first = signal.number.saturating_mul(width);
        bits.extend((0..width).map(|bit| IoBit {
            number: first.saturating_add(bit),
            is_on: pattern.map(|pattern| pattern >> bit & 1 == 1),
            point: &signal.point,
        }));
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::jobs::IoSignalPoint;

    #[test]
    fn bytes_and_words_are_taken_apart() {
        let signal = |number: u32| IoSignalPoint {
            point: LivePoint { node: NodeId::numeric(1, number), name: String::new(), unit: None, range: None },
            number,
        };
        let group =
            IoGroupPoints { signals: vec![signal(2), signal(3), signal(4), signal(5)], ..IoGroupPoints::default() };
        let value = |value: Value| DataValue { value, ..DataValue::default() };
        let values = HashMap::from([
            (NodeId::numeric(1, 2), value(Value::Boolean(true))),
            (NodeId::numeric(1, 3), value(Value::Byte(0b1000_0001))),
            (NodeId::numeric(1, 4), value(Value::UInt16(0x8000))),
        ]);
        let bits = bits(&group, &values);
        let on: Vec<u32> = bits.iter().filter(|bit| bit.is_on == Some(true)).map(|bit| bit.number).collect();
        assert_eq!(on, [2, 24, 31, 79]);
        assert_eq!(bits.len(), 1 + 8 + 16 + 1);
        assert_eq!((bits[25].number, bits[25].is_on), (5, None));
    }
}
