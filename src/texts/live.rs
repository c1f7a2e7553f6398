//! What is said of live values, and how values are written for people.

use super::{TextKey as T, Zone};
use crate::model::Language;
use crate::model::opcua::Value;
use crate::model::untrusted_text::one_line;

in_every_language! {
    live:
    /// A bit of an I/O node; `None`: there is no value.
    fn live_bit(number: u32, is_on: Option<bool>) -> String;
    /// A duration, in its two largest units.
    fn live_duration(days: u64, hours: u64, minutes: u64, seconds: u64) -> String;
    /// What was typed is no value of this OPC UA type.
    fn live_not_of_type(data_type: &str) -> String;
    /// Why a write was refused, by the name of its OPC UA status.
    fn live_write_refused(status: &str) -> String;
    /// How much time a plot shows.
    fn live_span(seconds: u32) -> String;
    /// Who is logged in.
    fn live_logged_in(user: &str) -> String;
}

/// A value in a table: numbers with two decimals if they have any, times in the zone, durations in words. A dash for no
/// value.
pub fn live_value(language: Language, value: &Value, zone: Zone) -> String {
    match value {
        Value::Null | Value::DateTime(None) => "–".to_owned(),
        Value::Boolean(is_on) => if *is_on { T::LiveOn } else { T::LiveOff }.text(language).to_owned(),
        Value::Float(number) => decimal(f64::from(*number)),
        Value::Double(number) => decimal(*number),
        Value::DateTime(Some(at)) => zone.date_time(*at),
        Value::String(text) => match iso_duration(text) {
            Some(seconds) => {
                let minutes = seconds / 60;
                live_duration(language, minutes / 1440, minutes / 60 % 24, minutes % 60, seconds % 60)
            }
            None => one_line(text, MAX_CHARS),
        },
        other => one_line(&other.to_string(), MAX_CHARS),
    }
}

fn decimal(number: f64) -> String {
    match number.abs() {
        ..0.005 => "0.00".to_owned(),
        0.005..1e9 => format!("{number:.2}"),
        _ => format!("{number:.3e}"),
    }
}

/// The seconds of a DurationString such as `P12DT4H30M` (OPC 10000-5 §12.2, ISO 8601). `None` for another text, and for
/// one with years or months, which have no fixed length.
fn iso_duration(text: &str) -> Option<u64> {
    let rest = text.strip_prefix('P').filter(|rest| !rest.is_empty() && !rest.ends_with('T'))?;
    let (days, time) = rest.split_once('T').unwrap_or((rest, ""));
    let date = parts(days, &[('W', 604_800.0), ('D', 86_400.0)])?;
    let time = parts(time, &[('H', 3_600.0), ('M', 60.0), ('S', 1.0)])?;
    Some((date + time) as u64)
}

/// The sum of numbers that are each followed by one of these units.
fn parts(text: &str, units: &[(char, f64)]) -> Option<f64> {
    let mut seconds = 0.0;
    let mut rest = text;
    while !rest.is_empty() {
        let end = rest.find(|char: char| !char.is_ascii_digit() && char != '.')?;
        let unit = rest[end..].chars().next()?;
        let (_, factor) = units.iter().find(|(known, _)| *known == unit)?;
        seconds += rest[..end].parse::<f64>().ok()? * factor;
        rest = &rest[end + unit.len_utf8()..];
    }
    Some(seconds)
}

const MAX_CHARS: usize = 200;

#[cfg(test)]
mod tests {
    use super::*;

    fn shown(value: Value) -> String {
        live_value(Language::En, &value, Zone::default())
    }

    #[test]
    fn values_are_written_for_people() {
        assert_eq!(shown(Value::Null), "–");
        assert_eq!(shown(Value::Boolean(true)), "On");
        assert_eq!(shown(Value::Double(-12.345)), "-12.35");
        assert_eq!(shown(Value::Float(0.0)), "0.00");
        assert_eq!([-0.001, 1e12, f64::NAN].map(|value| shown(Value::Double(value))), ["0.00", "1.000e12", "NaN"]);
        assert_eq!(shown(Value::UInt16(7)), "7");
        assert_eq!(shown(Value::String("a\u{1b}[2J\nb".into())), "a\u{fffd}[2J b");
        assert_eq!(shown(Value::String("P12DT4H30M".into())), "12 d 4 h");
        assert_eq!(shown(Value::String("PT65M".into())), "1 h 5 min");
        assert_eq!(shown(Value::String("PT12.5S".into())), "0 min 12 s");
    }

    #[test]
    fn what_only_begins_like_a_duration_stays_a_text() {
        for text in ["P", "PT", "P1Y", "Program", "P1", "PX1D", "P1D2", "P..D"] {
            assert_eq!(iso_duration(text), None, "{text}");
        }
    }

    #[test]
    fn every_language_says_what_happened_to_a_write() {
        for language in Language::ALL {
            for status in ["BadOutOfRange", "BadTypeMismatch", "BadNotWritable", "BadInternalError"] {
                assert!(live_write_refused(language, status).chars().count() > 8);
            }
            assert!(live_write_refused(language, "BadInternalError").contains("BadInternalError"));
        }
    }
}
