use std::fmt;

use chrono::{NaiveDate, NaiveDateTime};

use super::layout::Wire;

/// A time stamp of the controller: ticks since the controller was switched on or restarted (manual 4.3.3). 0 means that
/// there is no data.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Ticks(pub u64);

impl Ticks {
    /// Ticks of one second.
    pub const PER_SECOND: u64 = 80_000_000;
    /// No data in this slot.
    pub const NONE: Self = Self(0);
    /// 2⁵⁸ ticks are 114 years: a time stamp from there on was not made by a controller.
    pub const LIMIT: Self = Self(1 << 58);

    /// Whether the slot holds data.
    pub const fn is_some(self) -> bool {
        self.0 != 0
    }

    /// Seconds since the controller was switched on.
    pub fn seconds(self) -> f64 {
        // Whole seconds apart: after 17 minutes an f64 of the quotient alone would lose single ticks in the product.
        (self.0 / Self::PER_SECOND) as f64 + (self.0 % Self::PER_SECOND) as f64 / Self::PER_SECOND as f64
    }

    /// The tick at which this many nanoseconds have passed since the controller was switched on, rounded down.
    pub const fn from_nanoseconds(nanoseconds: u128) -> Self {
        Self((nanoseconds * Self::PER_SECOND as u128 / 1_000_000_000) as u64)
    }
}

impl Wire for Ticks {
    const SIZE: usize = 8;

    #[inline(always)]
    fn read(bytes: &[u8], at: usize) -> Self {
        Self(u64::read(bytes, at))
    }

    #[inline(always)]
    fn write(self, bytes: &mut [u8], at: usize) {
        self.0.write(bytes, at);
    }
}

/// Date and time of the controller's clock, without a time zone (manual 4.1.3). All fields 0: not set.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ControllerTime {
    /// The year, such as 2026.
    pub year: i16,
    /// 1 to 12.
    pub month: u8,
    /// 1 to 31.
    pub day: u8,
    /// 0 to 23.
    pub hour: u8,
    /// 0 to 59.
    pub minute: u8,
    /// 0 to 59.
    pub second: u8,
    /// 0 to 999.
    pub millisecond: i16,
}

impl ControllerTime {
    /// The date and time, `None` where it is not set or not a date.
    pub fn to_date_time(self) -> Option<NaiveDateTime> {
        let date = NaiveDate::from_ymd_opt(self.year.into(), self.month.into(), self.day.into())?;
        let millisecond = u32::try_from(self.millisecond).ok()?;
        date.and_hms_milli_opt(self.hour.into(), self.minute.into(), self.second.into(), millisecond)
    }

    /// Years outside 1970 to 9999 are no time of a controller and become the unset time.
    pub fn from_date_time(time: NaiveDateTime) -> Self {
        use chrono::{Datelike, Timelike};
        if !(1970..=9999).contains(&time.year()) {
            return Self::default();
        }
        Self {
            year: time.year() as i16,
            month: time.month() as u8,
            day: time.day() as u8,
            hour: time.hour() as u8,
            minute: time.minute() as u8,
            second: time.second() as u8,
            millisecond: (time.nanosecond() / 1_000_000 % 1000) as i16,
        }
    }

    /// Whether every field is in its range. Looks at nothing else: February 31 is in range, the unset time is not.
    #[inline(always)]
    pub(crate) fn is_in_range(self) -> bool {
        let Self { year, month, day, hour, minute, second, millisecond } = self;
        // Without branches: every record of a recording is looked at.
        (1970..10_000).contains(&year)
            & (month.wrapping_sub(1) < 12)
            & (day.wrapping_sub(1) < 31)
            & (hour < 24)
            & (minute < 60)
            & (second < 60)
            & (0..1000).contains(&millisecond)
    }

    /// The first of its fields that is out of range: its name, its offset in the nine bytes, its value, and the range.
    /// The unset time has none.
    pub(crate) fn mistake(self) -> Option<(&'static str, usize, u64, &'static str)> {
        if self.is_in_range() || self == Self::default() {
            return None;
        }
        let number = |value: i16| u64::from(value.cast_unsigned());
        let Self { year, month, day, hour, minute, second, millisecond } = self;
        Some(if !(1970..10_000).contains(&year) {
            ("Year", 0, number(year), "expected 1970 to 9999")
        } else if !(1..=12).contains(&month) {
            ("Month", 2, month.into(), "expected 1 to 12")
        } else if !(1..=31).contains(&day) {
            ("Day", 3, day.into(), "expected 1 to 31")
        } else if hour > 23 {
            ("Hour", 4, hour.into(), "expected 0 to 23")
        } else if minute > 59 {
            ("Minutes", 5, minute.into(), "expected 0 to 59")
        } else if second > 59 {
            ("Second", 6, second.into(), "expected 0 to 59")
        } else {
            ("MilliSecond", 7, number(millisecond), "expected 0 to 999")
        })
    }
}

impl fmt::Display for ControllerTime {
    /// `2026-06-01 08:30:00.250`, or `–` for the unset time.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.to_date_time() {
            Some(time) => write!(f, "{}", time.format("%Y-%m-%d %H:%M:%S%.3f")),
            None => f.write_str("–"),
        }
    }
}

impl Wire for ControllerTime {
    const SIZE: usize = 9;

    #[inline(always)]
    fn read(bytes: &[u8], at: usize) -> Self {
        Self {
            year: i16::read(bytes, at),
            month: bytes[at + 2],
            day: bytes[at + 3],
            hour: bytes[at + 4],
            minute: bytes[at + 5],
            second: bytes[at + 6],
            millisecond: i16::read(bytes, at + 7),
        }
    }

    #[inline(always)]
    fn write(self, bytes: &mut [u8], at: usize) {
        self.year.write(bytes, at);
        bytes[at + 2..at + 7].copy_from_slice(&[self.month, self.day, self.hour, self.minute, self.second]);
        self.millisecond.write(bytes, at + 7);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_seconds_to_the_last_tick() {
        assert_eq!(Ticks(40_000_000).seconds(), 0.5);
        assert_eq!(Ticks::from_nanoseconds(1_250_000_000), Ticks(100_000_000));
        let day = Ticks(86_400 * Ticks::PER_SECOND + 1);
        assert_eq!((day.seconds() * Ticks::PER_SECOND as f64).round() as u64, day.0);
    }

    #[test]
    fn a_time_is_a_date_and_back() {
        let time = ControllerTime { year: 2026, month: 2, day: 28, hour: 23, minute: 59, second: 58, millisecond: 7 };
        assert_eq!(time.to_string(), "2026-02-28 23:59:58.007");
        assert_eq!(ControllerTime::from_date_time(time.to_date_time().unwrap()), time);
        assert_eq!(time.mistake(), None);
        assert_eq!(ControllerTime { month: 13, ..time }.mistake(), Some(("Month", 2, 13, "expected 1 to 12")));
        assert_eq!(ControllerTime { day: 30, ..time }.to_date_time(), None);
        assert_eq!((ControllerTime::default().to_string().as_str(), ControllerTime::default().mistake()), ("–", None));
    }
}
