//! The force sensor's answer inside a motion log block (FSENS): values of 18 bits, whose bits 2 to 17 and bits 0 and 1
//! lie apart, in two's complement.

use crate::records::layout::{Wire, packet};
use crate::records::time::Ticks;

packet! {
    /// What the force sensor answered (FSENS).
    ForceSensorView / ForceSensor [72] {
        0 "TIMESTAMP" timestamp: Ticks,
        12 "FSENS_RESP_6D_DATA" axes: SixAxes,
        32 "FSENS_RESP_16D_DATA" elements: Elements,
    }
}

/// Values of the axes of the force coordinate system (FSENS_RESP_6D_DATA), in counts of the sensor.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SixAxes {
    /// Fx, Fy, Fz; 18 bits, -131072 to 131071.
    pub force: [i32; 3],
    /// Mx, My, Mz; 18 bits.
    pub moment: [i32; 3],
    /// °C.
    pub temperature: i16,
}

/// Output of the sensor's four elements a, b, c, d (FSENS_RESP_16D_DATA), in counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Elements {
    /// Of each element X, Y, Z, T; 18 bits. Z and T are always 0.
    pub outputs: [[i32; 4]; 4],
    /// °C.
    pub temperature: i16,
}

/// The 18 bits as a number: bits 2 to 17 from the two bytes at `high`, bits 0 and 1 from bit `low_bit` of a byte.
#[inline(always)]
const fn join(high: u16, low: u8, low_bit: u32) -> i32 {
    ((high.cast_signed() as i32) << 2) | ((low >> low_bit) & 3) as i32
}

/// Bits 2 to 17 of a number.
const fn high(value: i32) -> u16 {
    (value >> 2) as u16
}

/// Bits 0 and 1 of three or four numbers, the first in the lowest bits.
fn low(values: &[i32]) -> u8 {
    values.iter().enumerate().fold(0, |byte, (index, value)| byte | ((*value & 3) as u8) << (2 * index))
}

impl Wire for SixAxes {
    const SIZE: usize = 18;

    #[inline(always)]
    fn read(bytes: &[u8], at: usize) -> Self {
        let high = <[u16; 6]>::read(bytes, at);
        let (force, moment) = (bytes[at + 12], bytes[at + 13]);
        Self {
            force: [join(high[0], force, 0), join(high[1], force, 2), join(high[2], force, 4)],
            moment: [join(high[3], moment, 0), join(high[4], moment, 2), join(high[5], moment, 4)],
            temperature: i16::read(bytes, at + 14),
        }
    }

    fn write(self, bytes: &mut [u8], at: usize) {
        self.force.map(high).write(bytes, at);
        self.moment.map(high).write(bytes, at + 6);
        bytes[at + 12] = low(&self.force);
        bytes[at + 13] = low(&self.moment);
        self.temperature.write(bytes, at + 14);
    }
}

/// Bytes of one element: four times bits 2 to 17, then one byte with the bits 0 and 1.
const ELEMENT: usize = 9;

impl Wire for Elements {
    const SIZE: usize = 40;

    #[inline(always)]
    fn read(bytes: &[u8], at: usize) -> Self {
        let outputs = std::array::from_fn(|element| {
            let at = at + element * ELEMENT;
            let (high, low) = (<[u16; 4]>::read(bytes, at), bytes[at + 8]);
            [join(high[0], low, 0), join(high[1], low, 2), join(high[2], low, 4), join(high[3], low, 6)]
        });
        Self { outputs, temperature: i16::read(bytes, at + 4 * ELEMENT) }
    }

    fn write(self, bytes: &mut [u8], at: usize) {
        for (element, outputs) in self.outputs.into_iter().enumerate() {
            let at = at + element * ELEMENT;
            outputs.map(high).write(bytes, at);
            bytes[at + 8] = low(&outputs);
        }
        self.temperature.write(bytes, at + 4 * ELEMENT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eighteen_bits_are_joined_with_their_sign() {
        assert_eq!(join(0x7fff, 0b11, 0), 131_071);
        assert_eq!(join(0x8000, 0b00, 0), -131_072);
        assert_eq!(join(0xffff, 0b0011_0000, 4), -1);
        assert_eq!(join(0x0001, 0b1000_0000, 6), 6);
    }

    #[test]
    fn six_axes_by_the_table() {
        // Fx_2_17 = 1 and Fx_0_1 = 1 are 5; Mz is -2; bits 102, 103, 110, 111 are reserved.
        let mut bytes = [0; 18];
        bytes[0] = 1;
        bytes[10..12].copy_from_slice(&[0xff, 0xff]);
        bytes[12] = 0b1100_0001;
        bytes[13] = 0b1110_0000;
        bytes[14] = 0x19;
        let axes = SixAxes::read(&bytes, 0);
        assert_eq!(axes, SixAxes { force: [5, 0, 0], moment: [0, 0, -2], temperature: 25 });
    }

    #[test]
    fn elements_by_the_table() {
        // Yb_2_17 is at bit 88, Yb_0_1 at bit 138; Td_2_17 at bit 264, Td_0_1 at bit 286; the temperature at bit 288.
        let mut bytes = [0; 40];
        bytes[88 / 8] = 2;
        bytes[136 / 8] = 0b0000_1100;
        bytes[264 / 8 + 1] = 0x80;
        bytes[280 / 8] = 0b0100_0000;
        bytes[36] = 0xf6;
        bytes[37] = 0xff;
        let elements = Elements::read(&bytes, 0);
        assert_eq!(elements.outputs[1], [0, 11, 0, 0]);
        assert_eq!(elements.outputs[3], [0, 0, 0, -131_071]);
        assert_eq!(elements.temperature, -10);
        let mut again = [0; 40];
        elements.write(&mut again, 0);
        assert_eq!(again, bytes);
    }
}
