//! What is said of PLCs and bridges.

use crate::fins::codec::cpu::PlcErrorKind;
use crate::fins::codec::end_code::{EndCode, EndCodeRemedy, KnownEndCode};

in_every_language! {
    fins:
    /// What an end code means, and what to do.
    fn plc_advice(end: EndCode) -> String;
    /// Elements of a PLC were written.
    fn plc_written(range: &str) -> String;
    /// How far a write came that failed.
    fn plc_partly_written(done: usize, uncertain: usize) -> String;
    /// A simulated PLC is ready.
    fn plc_simulated(address: &str, node: u8) -> String;
    /// Elements of a PLC are followed until the program ends.
    fn plc_watched(what: &str) -> String;
    /// A bridge has begun.
    fn bridge_started(rows: usize) -> String;
    /// A row of a bridge is copied, the first time or again after an error.
    fn bridge_row_copied(row: &str) -> String;
    /// A bridge has ended.
    fn bridge_ended(cycles: u64, complete: u64, longest_ms: u128) -> String;
}

impl KnownEndCode {
    /// What the end code means, as a sentence without a stop.
    pub const fn text(self, language: crate::model::Language) -> &'static str {
        in_language!(language, fins::end_code(self))
    }
}

impl EndCodeRemedy {
    /// What to do, in sentences.
    pub const fn text(self, language: crate::model::Language) -> &'static str {
        in_language!(language, fins::remedy(self))
    }
}

impl PlcErrorKind {
    /// What kind of error a PLC reports.
    pub const fn text(self, language: crate::model::Language) -> &'static str {
        in_language!(language, fins::plc_error(self))
    }
}
