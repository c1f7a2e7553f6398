use chrono::{DateTime, Datelike as _, FixedOffset, Local, Offset as _, Utc};

/// Where times are shown as of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Zone {
    /// This computer's time zone.
    #[default]
    Local,
    /// This distance from UTC; for tests, whose pictures must not depend on the computer.
    Fixed(FixedOffset),
}

impl Zone {
    /// `2026-11-28`.
    pub fn date(self, at: DateTime<Utc>) -> String {
        self.format(at, "%Y-%m-%d")
    }

    /// `2026-11-28 13:05`.
    pub fn date_time(self, at: DateTime<Utc>) -> String {
        self.format(at, "%Y-%m-%d %H:%M")
    }

    /// `13:05:07.250`.
    pub fn time_ms(self, at: DateTime<Utc>) -> String {
        self.format(at, "%H:%M:%S%.3f")
    }

    /// `2026-11-28 13:05:07.250`.
    pub fn date_time_ms(self, at: DateTime<Utc>) -> String {
        self.format(at, "%Y-%m-%d %H:%M:%S%.3f")
    }

    fn format(self, at: DateTime<Utc>, pattern: &str) -> String {
        // At the ends of what can be written, another zone has no such time.
        let zone = if (0..=9999).contains(&at.year()) { self } else { Self::Fixed(Utc.fix()) };
        match zone {
            Self::Local => at.with_timezone(&Local).format(pattern).to_string(),
            Self::Fixed(offset) => at.with_timezone(&offset).format(pattern).to_string(),
        }
    }
}
