//! Values that are texts.

use std::time::Duration;

use crate::virtual_controller::cell::Pose;

/// A DurationString: ISO 8601, in days, hours, minutes and whole seconds (OPC 10000-5 §12.2.8).
pub(super) fn duration(duration: Duration) -> String {
    let seconds = duration.as_secs();
    let (days, hours, minutes, seconds) = (seconds / 86_400, seconds / 3600 % 24, seconds / 60 % 60, seconds % 60);
    format!("P{days}DT{hours}H{minutes}M{seconds}S")
}

/// CurPos and RealPos: a JSON object (manual 3.2.3.8). Rounded to micrometres and thousandths of a degree.
pub(super) fn pose(pose: &Pose) -> String {
    // Adding 0 turns a negative zero into zero.
    let [x, y, z, u, v, w] = pose.to_array().map(|value| (value * 1000.0).round() / 1000.0 + 0.0);
    format!(r#"{{"X":{x:?}, "Y":{y:?}, "Z":{z:?}, "U":{u:?}, "V":{v:?}, "W":{w:?}}}"#)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_are_iso_8601() {
        assert_eq!(duration(Duration::ZERO), "P0DT0H0M0S");
        assert_eq!(duration(Duration::from_millis(93_784_999)), "P1DT2H3M4S");
    }

    #[test]
    fn poses_are_the_manuals_json() {
        let shown = pose(&Pose::default());
        assert_eq!(shown, r#"{"X":0.0, "Y":0.0, "Z":0.0, "U":0.0, "V":0.0, "W":0.0}"#);
        let shown = pose(&Pose { x: 123.456_78, y: -0.000_1, z: -20.0, u: 1e5, ..Pose::default() });
        assert_eq!(shown, r#"{"X":123.457, "Y":0.0, "Z":-20.0, "U":100000.0, "V":0.0, "W":0.0}"#);
        assert!(serde_json::from_str::<serde_json::Value>(&shown).is_ok());
    }
}
