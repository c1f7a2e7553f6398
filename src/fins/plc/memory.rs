//! The memory areas of the simulated PLC.

use thiserror::Error;

use super::super::address::{Address, AddressError, AddressRange, Area, EmBank, Part, WireAddress};
use super::super::codec::end_code::{EndCode, KnownEndCode};

/// The memory of a CPU: all words are 0 and all flags off at the beginning.
#[derive(Debug)]
pub struct Memory {
    cio: Vec<u16>,
    work: Vec<u16>,
    holding: Vec<u16>,
    auxiliary: Vec<u16>,
    data_memory: Vec<u16>,
    timers: Presets,
    counters: Presets,
    banks: Vec<Vec<u16>>,
}

/// Present values and completion flags of timers or counters.
#[derive(Debug)]
struct Presets {
    values: Vec<u16>,
    flags: Vec<bool>,
}

/// Why the memory cannot be read or written there.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MemoryError {
    /// This PLC does not have the area or bank.
    #[error("this PLC has no such memory area")]
    NoArea,
    /// The first element is beyond the end of the area.
    #[error("the first element is beyond the end of the area")]
    StartsBeyond,
    /// The last element is beyond the end of the area.
    #[error("the last element is beyond the end of the area")]
    EndsBeyond,
    /// The elements cannot be written.
    #[error("the elements are read-only")]
    ReadOnly,
    /// Bits where the command needs words.
    #[error("the command needs words")]
    NoWords,
}

impl MemoryError {
    /// What the PLC answers.
    pub fn end_code(&self) -> EndCode {
        match self {
            Self::NoArea | Self::NoWords => KnownEndCode::AreaMissing,
            Self::StartsBeyond => KnownEndCode::AddressRangeError,
            Self::EndsBeyond => KnownEndCode::AddressRangeExceeded,
            Self::ReadOnly => KnownEndCode::ReadOnly,
        }
        .into()
    }
}

/// Words of the auxiliary area: what is above belongs to larger CPUs.
const AUXILIARY_WORDS: usize = 960;
/// The first word of the auxiliary area that can be written.
const AUXILIARY_WRITABLE_FROM: u16 = 448;

impl Memory {
    /// A memory with so many banks of extended data memory, at most 25.
    pub fn new(banks: u8) -> Self {
        let words = |area: Area| vec![0; usize::from(area.last()) + 1];
        let presets =
            || Presets { values: words(Area::Timer), flags: vec![false; usize::from(Area::Timer.last()) + 1] };
        Self {
            cio: words(Area::Cio),
            work: words(Area::Work),
            holding: words(Area::Holding),
            auxiliary: vec![0; AUXILIARY_WORDS],
            data_memory: words(Area::DataMemory),
            timers: presets(),
            counters: presets(),
            banks: vec![words(Area::DataMemory); usize::from(banks.min(EmBank::LAST.number() + 1))],
        }
    }

    fn area(&self, area: Area) -> Result<&[u16], MemoryError> {
        Ok(match area {
            Area::Cio => &self.cio,
            Area::Work => &self.work,
            Area::Holding => &self.holding,
            Area::Auxiliary => &self.auxiliary,
            Area::DataMemory => &self.data_memory,
            Area::Timer => &self.timers.values,
            Area::Counter => &self.counters.values,
            Area::ExtendedMemory(bank) => self.banks.get(usize::from(bank.number())).ok_or(MemoryError::NoArea)?,
        })
    }

    fn area_mut(&mut self, area: Area) -> Result<&mut [u16], MemoryError> {
        Ok(match area {
            Area::Cio => &mut self.cio,
            Area::Work => &mut self.work,
            Area::Holding => &mut self.holding,
            Area::Auxiliary => &mut self.auxiliary,
            Area::DataMemory => &mut self.data_memory,
            Area::Timer => &mut self.timers.values,
            Area::Counter => &mut self.counters.values,
            Area::ExtendedMemory(bank) => self.banks.get_mut(usize::from(bank.number())).ok_or(MemoryError::NoArea)?,
        })
    }

    /// Words, or present values.
    ///
    /// # Errors
    /// Words that this PLC does not have.
    pub fn words(&self, range: AddressRange) -> Result<&[u16], MemoryError> {
        words_only(range.start)?;
        let words = self.area(range.start.area())?;
        words.get(span(range.start.number().into(), range.count.into(), words.len())?).ok_or(MemoryError::EndsBeyond)
    }

    /// Sets words, or present values; also those that no client can write.
    ///
    /// # Errors
    /// Words that this PLC does not have.
    pub fn set_words(&mut self, start: Address, values: &[u16]) -> Result<(), MemoryError> {
        words_only(start)?;
        let words = self.area_mut(start.area())?;
        let span = span(start.number().into(), values.len(), words.len())?;
        words.get_mut(span).ok_or(MemoryError::EndsBeyond)?.copy_from_slice(values);
        Ok(())
    }

    /// Bits, or completion flags.
    ///
    /// # Errors
    /// Bits that this PLC does not have.
    pub fn bits(&self, range: AddressRange) -> Result<Vec<bool>, MemoryError> {
        let (start, count) = (range.start, usize::from(range.count));
        let first = usize::from(start.number());
        match (start.part(), start.area()) {
            (Part::Flag, area) => {
                let flags = if area == Area::Timer { &self.timers.flags } else { &self.counters.flags };
                Ok(flags[span(first, count, flags.len())?].to_vec())
            }
            (Part::Bit(bit), area) => {
                let words = self.area(area)?;
                let bits = span(first * 16 + usize::from(bit), count, words.len() * 16)?;
                Ok(bits.map(|at| words[at / 16] & 1 << (at % 16) != 0).collect())
            }
            (Part::Word, _) => Err(MemoryError::NoArea),
        }
    }

    /// Sets bits or completion flags; also those that no client can write.
    ///
    /// # Errors
    /// Bits that this PLC does not have.
    pub fn set_bits(&mut self, start: Address, states: &[bool]) -> Result<(), MemoryError> {
        let first = usize::from(start.number());
        match (start.part(), start.area()) {
            (Part::Flag, area) => {
                let presets = if area == Area::Timer { &mut self.timers } else { &mut self.counters };
                let span = span(first, states.len(), presets.flags.len())?;
                presets.flags[span].copy_from_slice(states);
            }
            (Part::Bit(bit), area) => {
                let words = self.area_mut(area)?;
                let span = span(first * 16 + usize::from(bit), states.len(), words.len() * 16)?;
                for (at, state) in span.zip(states) {
                    let mask = 1 << (at % 16);
                    if *state { words[at / 16] |= mask } else { words[at / 16] &= !mask }
                }
            }
            (Part::Word, _) => return Err(MemoryError::NoArea),
        }
        Ok(())
    }

    /// The data of a memory area read.
    pub(super) fn read(&self, start: WireAddress, count: u16) -> Result<Vec<u8>, MemoryError> {
        let start = address(start)?;
        let Some(range) = range(start, count)? else { return Ok(Vec::new()) };
        if start.is_bit() {
            Ok(self.bits(range)?.into_iter().map(u8::from).collect())
        } else {
            Ok(self.words(range)?.iter().flat_map(|word| word.to_be_bytes()).collect())
        }
    }

    /// Executes a memory area write. The data has the length of the elements.
    pub(super) fn write(&mut self, start: WireAddress, count: u16, data: &[u8]) -> Result<(), MemoryError> {
        let start = address(start)?;
        let Some(range) = range(start, count)? else { return Ok(()) };
        writable(range)?;
        if start.is_bit() {
            let states: Vec<bool> = data.iter().map(|byte| byte & 1 != 0).collect();
            self.set_bits(start, &states)
        } else {
            let words: Vec<u16> = data.chunks_exact(2).map(|word| u16::from_be_bytes([word[0], word[1]])).collect();
            self.set_words(start, &words)
        }
    }

    /// Executes a memory area fill.
    pub(super) fn fill(&mut self, start: WireAddress, count: u16, value: u16) -> Result<(), MemoryError> {
        let start = address(start)?;
        words_only(start)?;
        let Some(range) = range(start, count)? else { return Ok(()) };
        writable(range)?;
        self.set_words(start, &vec![value; usize::from(count)])
    }

    /// Executes a memory area transfer.
    pub(super) fn transfer(&mut self, from: WireAddress, to: WireAddress, count: u16) -> Result<(), MemoryError> {
        let (from, to) = (address(from)?, address(to)?);
        words_only(from)?;
        words_only(to)?;
        let (Some(source), Some(target)) = (range(from, count)?, range(to, count)?) else { return Ok(()) };
        writable(target)?;
        let words = self.words(source)?.to_vec();
        self.set_words(to, &words)
    }
}

fn address(wire: WireAddress) -> Result<Address, MemoryError> {
    wire.address().map_err(|error| match error {
        AddressError::UnknownCode(_) => MemoryError::NoArea,
        _ => MemoryError::StartsBeyond,
    })
}

/// `None` for no elements, which every PLC answers with success (W342 5-3-2, 5-3-3).
fn range(start: Address, count: u16) -> Result<Option<AddressRange>, MemoryError> {
    if count == 0 {
        return Ok(None);
    }
    AddressRange::new(start, count.into()).map(Some).map_err(|_| MemoryError::EndsBeyond)
}

fn span(first: usize, count: usize, length: usize) -> Result<std::ops::Range<usize>, MemoryError> {
    match first + count {
        _ if first >= length => Err(MemoryError::StartsBeyond),
        end if end > length => Err(MemoryError::EndsBeyond),
        end => Ok(first..end),
    }
}

fn words_only(address: Address) -> Result<(), MemoryError> {
    if address.is_bit() { Err(MemoryError::NoWords) } else { Ok(()) }
}

/// Completion flags and the lower words of the auxiliary area are the CPU's own.
fn writable(range: AddressRange) -> Result<(), MemoryError> {
    let start = range.start;
    let is_read_only =
        start.part() == Part::Flag || start.area() == Area::Auxiliary && start.number() < AUXILIARY_WRITABLE_FROM;
    if is_read_only { Err(MemoryError::ReadOnly) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(text: &str) -> WireAddress {
        text.parse::<Address>().unwrap().to_wire()
    }

    #[test]
    fn words_bits_and_flags_are_kept() {
        let mut memory = Memory::new(2);
        memory.write(at("D300"), 2, &[0x01, 0x41, 0xFF, 0xFF]).unwrap();
        assert_eq!(memory.read(at("D300"), 2), Ok(vec![0x01, 0x41, 0xFF, 0xFF]));
        assert_eq!(memory.read(at("D300.06"), 3), Ok(vec![1, 0, 1]));
        memory.write(at("D300.15"), 3, &[1, 0, 0]).unwrap();
        assert_eq!(memory.read(at("D300"), 2), Ok(vec![0x81, 0x41, 0xFF, 0xFC]));
        memory.fill(at("E1_32766"), 2, 7).unwrap();
        memory.transfer(at("E1_32766"), at("CIO0"), 2).unwrap();
        assert_eq!(memory.read(at("CIO0"), 3), Ok(vec![0, 7, 0, 7, 0, 0]));
        memory.set_bits("C4.F".parse().unwrap(), &[true]).unwrap();
        memory.write(at("C4"), 1, &[0, 9]).unwrap();
        assert_eq!(memory.read(at("C3.F"), 3), Ok(vec![0, 1, 0]));
        assert_eq!(memory.read(at("T4"), 1), Ok(vec![0, 0]));
        assert_eq!(memory.read(at("D0"), 0), Ok(vec![]));
    }

    #[test]
    fn the_ends_of_areas_have_their_end_codes() {
        let mut memory = Memory::new(2);
        let end = |error: MemoryError| error.end_code().to_wire();
        assert_eq!(end(memory.read(WireAddress { code: 0x99, word: 0, bit: 0 }, 1).unwrap_err()), 0x1101);
        assert_eq!(end(memory.read(at("E2_0"), 1).unwrap_err()), 0x1101);
        assert_eq!(end(memory.read(at("A960"), 1).unwrap_err()), 0x1103);
        assert_eq!(end(memory.read(WireAddress { code: 0xB1, word: 512, bit: 0 }, 1).unwrap_err()), 0x1103);
        assert_eq!(end(memory.read(at("W511"), 2).unwrap_err()), 0x1104);
        assert_eq!(end(memory.read(at("W511.15"), 2).unwrap_err()), 0x1104);
        assert_eq!(end(memory.write(at("A447"), 1, &[0, 0]).unwrap_err()), 0x2101);
        assert_eq!(end(memory.write(at("T0.F"), 1, &[1]).unwrap_err()), 0x2101);
        assert_eq!(memory.write(at("A448"), 1, &[0, 1]), Ok(()));
        assert_eq!(end(memory.fill(at("D0.00"), 1, 1).unwrap_err()), 0x1101);
    }
}
