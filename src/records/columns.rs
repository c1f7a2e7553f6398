//! Columns as the files and the plots read them: a name, a unit, values of one type.

/// Values of one type.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Values<'a> {
    /// Unsigned, 8 bits.
    U8(&'a [u8]),
    /// Signed, 8 bits.
    I8(&'a [i8]),
    /// Unsigned, 16 bits.
    U16(&'a [u16]),
    /// Signed, 16 bits.
    I16(&'a [i16]),
    /// Unsigned, 32 bits.
    U32(&'a [u32]),
    /// Signed, 32 bits.
    I32(&'a [i32]),
    /// Unsigned, 64 bits.
    U64(&'a [u64]),
    /// Signed, 64 bits.
    I64(&'a [i64]),
    /// IEEE 754, 32 bits.
    F32(&'a [f32]),
    /// IEEE 754, 64 bits.
    F64(&'a [f64]),
    /// Milliseconds since 1970 by the controller's clock; [`NO_TIME`] where it was not set.
    Time(&'a [i64]),
}

/// The unset time of [`Values::Time`].
pub const NO_TIME: i64 = i64::MIN;

impl Values<'_> {
    /// How many values there are.
    pub const fn len(&self) -> usize {
        match self {
            Self::U8(values) => values.len(),
            Self::I8(values) => values.len(),
            Self::U16(values) => values.len(),
            Self::I16(values) => values.len(),
            Self::U32(values) => values.len(),
            Self::I32(values) => values.len(),
            Self::U64(values) => values.len(),
            Self::I64(values) | Self::Time(values) => values.len(),
            Self::F32(values) => values.len(),
            Self::F64(values) => values.len(),
        }
    }

    /// Whether there are none.
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// A value as a floating point number, for plots. Whole numbers from 2⁵³ on are rounded.
    pub fn number(&self, index: usize) -> Option<f64> {
        Some(match self {
            Self::U8(values) => (*values.get(index)?).into(),
            Self::I8(values) => (*values.get(index)?).into(),
            Self::U16(values) => (*values.get(index)?).into(),
            Self::I16(values) => (*values.get(index)?).into(),
            Self::U32(values) => (*values.get(index)?).into(),
            Self::I32(values) => (*values.get(index)?).into(),
            Self::U64(values) => *values.get(index)? as f64,
            Self::I64(values) | Self::Time(values) => *values.get(index)? as f64,
            Self::F32(values) => (*values.get(index)?).into(),
            Self::F64(values) => *values.get(index)?,
        })
    }
}

/// One column of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct Column<'a> {
    /// The name in the manual, with the axis or item before it: `ENC_1.ENC_POS`.
    pub name: String,
    /// `mm`, `N`, `ticks`; empty for plain numbers.
    pub unit: &'static str,
    /// One value a record, in the order of the records.
    pub values: Values<'a>,
    /// The time stamps of the item. Where one is 0 there is no value. `None`: there is always a value.
    pub timestamps: Option<&'a [u64]>,
    /// Rows of the recording to one value of this column: 1, or 8 for what a motion log block holds once.
    pub rows_per_value: usize,
}

impl Column<'_> {
    /// Whether the value at `index` (of this column, not of the rows) is there.
    pub fn is_there(&self, index: usize) -> bool {
        index < self.values.len() && self.timestamps.is_none_or(|stamps| stamps.get(index).is_some_and(|at| *at != 0))
    }
}
