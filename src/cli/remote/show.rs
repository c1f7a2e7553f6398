//! What is printed of an answer: as JSON, and as text.

use serde_json::{Value, json};

use crate::model::{Language, SpelValue, StatusFlag, untrusted_text};
use crate::remote::client::{ControllerIdentity, RobotIdentity, WearingPart};
use crate::remote::{RemoteStatus, Reply, Request, value_text};
use crate::texts::{self, TextKey};

use super::super::table::table;

/// The answer to a request.
pub fn reply(request: &Request, reply: &Reply, language: Language) -> (Value, String) {
    match reply {
        Reply::Done => {
            let name = request.command().name();
            (json!({ "done": name }), texts::remote_done(language, name))
        }
        Reply::Robot(number) => (json!({ "robot": number }), number.to_string()),
        Reply::Bit(on) => (json!({ "value": on }), u8::from(*on).to_string()),
        Reply::Byte(byte) => (json!({ "value": byte }), format!("{byte} (0x{byte:02X})")),
        Reply::Word(word) => (json!({ "value": word }), format!("{word} (0x{word:04X})")),
        Reply::Values(values) => variable(request, values),
        Reply::Status(status) => of_status(*status, language),
        Reply::Output(None) => (json!({ "result": null }), TextKey::RemoteNoResult.text(language).to_owned()),
        Reply::Output(Some(result)) => (json!({ "result": result }), untrusted_text::lines(result)),
        Reply::Alarms(alarms) => {
            let numbers: Vec<String> = alarms.iter().map(ToString::to_string).collect();
            let text = if alarms.is_empty() {
                TextKey::RemoteNoAlarm.text(language).to_owned()
            } else {
                texts::remote_alarms(language, &numbers.join(", "))
            };
            (json!({ "alarms": alarms }), text)
        }
        Reply::Text(text) => (json!({ "text": text }), one_line(text)),
        Reply::List(values) => (json!({ "values": values }), one_line(&values.join(", "))),
    }
}

fn one_line(text: &str) -> String {
    untrusted_text::one_line(text, usize::MAX)
}

fn of_status(status: RemoteStatus, language: Language) -> (Value, String) {
    let flags = StatusFlag::ALL.into_iter().filter(|flag| status.flags.contains(*flag));
    let flags: Vec<&str> = flags.map(StatusFlag::name).collect();
    (json!({ "flags": flags, "code": status.code }), texts::remote_status(language, &flags, status.code))
}

/// One value, or the elements of an array.
fn variable(request: &Request, values: &[SpelValue]) -> (Value, String) {
    let text: Vec<String> = values.iter().map(|value| one_line(&value_text(value))).collect();
    let is_array = matches!(request, Request::GetVariable { variable } if variable.range().is_some());
    let json: Vec<Value> = values.iter().map(json_value).collect();
    let json = match json.into_iter().collect::<Vec<_>>() {
        mut one if !is_array && one.len() == 1 => json!({ "value": one.remove(0) }),
        several => json!({ "values": several }),
    };
    (json, text.join(", "))
}

/// A number that JSON cannot hold is written as text: 64-bit integers beyond 2⁵³, and what is no number.
fn json_value(value: &SpelValue) -> Value {
    match value {
        SpelValue::Boolean(on) => json!(on),
        SpelValue::Int8(number) => json!(number),
        SpelValue::Int16(number) => json!(number),
        SpelValue::Int32(number) => json!(number),
        SpelValue::Int64(number) if number.unsigned_abs() <= EXACT_IN_JSON => json!(number),
        SpelValue::UInt8(number) => json!(number),
        SpelValue::UInt16(number) => json!(number),
        SpelValue::UInt32(number) => json!(number),
        SpelValue::UInt64(number) if *number <= EXACT_IN_JSON => json!(number),
        // As a Double the digits of a Real would go on behind the ones that it has.
        SpelValue::Float(number) if number.is_finite() => {
            value_text(value).parse::<f64>().map_or(Value::Null, Value::from)
        }
        SpelValue::Double(number) if number.is_finite() => json!(number),
        SpelValue::String(text) => json!(text),
        other => json!(value_text(other)),
    }
}

/// The largest integer up to which every one is exact in the numbers of JavaScript.
const EXACT_IN_JSON: u64 = 1 << 53;

/// What a controller says about itself, one line each.
pub fn identity(identity: &ControllerIdentity, language: Language) -> (Value, String) {
    if identity.is_empty() {
        return (json!(identity), TextKey::RemoteNothingTold.text(language).to_owned());
    }
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut add = |label: String, value: Option<String>| {
        if let Some(value) = value {
            rows.push(vec![label, value]);
        }
    };
    let text = |key: TextKey| key.text(language).to_owned();
    add(text(TextKey::RemoteName), identity.name.clone());
    add(text(TextKey::RemoteSerial), identity.serial.clone());
    add(text(TextKey::RemoteModel), identity.model.clone());
    add(text(TextKey::RemoteFirmware), identity.firmware.clone());
    add(text(TextKey::RemoteControlDevice), identity.control_device.clone());
    add(text(TextKey::RemoteSubnetMask), identity.subnet_mask.clone());
    add(text(TextKey::RemoteGateway), identity.gateway.clone());
    add(text(TextKey::RemoteMac), identity.mac_address.clone());
    add(text(TextKey::RemoteProject), identity.project.clone());
    add(text(TextKey::RemoteCpuLoad), identity.cpu_load.clone());
    let battery = identity.battery.as_ref();
    let battery = battery.map(|b| format!("{}; {} %; {}", b.installed, b.consumption, b.months_left));
    add(text(TextKey::RemoteBattery), battery);
    for robot in &identity.robots {
        add(format!("{} {}", text(TextKey::RemoteRobot), robot.number), Some(of_robot(robot, language)));
    }
    (json!(identity), table(&["", ""], &rows).trim_start_matches('\n').to_owned())
}

fn of_robot(robot: &RobotIdentity, language: Language) -> String {
    let named = [&robot.kind, &robot.model, &robot.name, &robot.serial];
    let mut words: Vec<String> = named.into_iter().flatten().cloned().collect();
    if let Some(on) = robot.motors_on {
        let state = if on { TextKey::On } else { TextKey::Off };
        words.push(format!("{}: {}", TextKey::RemoteMotors.text(language), state.text(language)));
    }
    if let Some(high) = robot.power_high {
        let state = if high { TextKey::RemoteHigh } else { TextKey::RemoteLow };
        words.push(format!("{}: {}", TextKey::RemotePower.text(language), state.text(language)));
    }
    if let Some(parts) = robot.parts_due.as_ref().filter(|parts| !parts.is_empty()) {
        let names: Vec<&str> = parts.iter().map(|part| part_name(*part).text(language)).collect();
        words.push(format!("{}: {}", TextKey::RemotePartsDue.text(language), names.join(", ")));
    }
    words.join("; ")
}

const fn part_name(part: WearingPart) -> TextKey {
    match part {
        WearingPart::Battery => TextKey::RemotePartBattery,
        WearingPart::Belt => TextKey::RemotePartBelt,
        WearingPart::Grease => TextKey::RemotePartGrease,
        WearingPart::Motor => TextKey::RemotePartMotor,
        WearingPart::Gear => TextKey::RemotePartGear,
        WearingPart::BallScrew => TextKey::RemotePartBallScrew,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_json_are_those_of_the_controller() {
        assert_eq!(json_value(&SpelValue::Float(0.1)).to_string(), "0.1");
        assert_eq!(json_value(&SpelValue::Double(-182.632)).to_string(), "-182.632");
        assert_eq!(json_value(&SpelValue::UInt64(u64::MAX)), json!("18446744073709551615"));
        assert_eq!(json_value(&SpelValue::Int64(-5)), json!(-5));
        assert_eq!(json_value(&SpelValue::Double(f64::NAN)), json!("NaN"));
    }
}
