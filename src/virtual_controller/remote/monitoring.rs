//! The commands of the vendor's monitoring client, which exist as text only and are not in the manual.

use chrono::{DateTime, Utc};

use super::options::RemoteRole;
use crate::model::FirmwareVersion;
use crate::remote::{Reply, Request, RobotNumber};
use crate::virtual_controller::cell::{
    CellDescription, CellSnapshot, ConsumableValues, Part, RobotKind, RobotValues, error_message,
};

/// Whether the firmware knows these commands: from 7.4.7 on, and of the line 7.4.50 and following from 7.4.57 on.
pub(super) fn is_answered_by(firmware: FirmwareVersion) -> bool {
    let second_line = FirmwareVersion::new(7, 4, 50);
    let first = if firmware < second_line { FirmwareVersion::new(7, 4, 7) } else { FirmwareVersion::new(7, 4, 57) };
    firmware >= first
}

/// The answer; `None` for another command, and for a robot or part that there is none of.
pub(super) fn reply(request: &Request, about: &CellDescription, now: &CellSnapshot, role: RemoteRole) -> Option<Reply> {
    let text = |text: &dyn std::fmt::Display| Some(Reply::Text(text.to_string()));
    match request {
        Request::GetContName => text(&about.controller.name),
        Request::GetContNo => text(&about.controller.serial),
        Request::GetContType => text(&about.controller.model),
        Request::GetContVer => text(&about.controller.firmware),
        Request::GetContDev => text(&match role {
            RemoteRole::Control => "Remote Ethernet",
            RemoteRole::Monitor => "PC",
        }),
        Request::GetSubnetMask => text(&"255.255.255.0"),
        Request::GetDefaultGateway => text(&"0.0.0.0"),
        Request::GetContMacAdd => text(&mac_address(about.controller.serial.as_str())),
        Request::GetContSettings => text(&settings(about)),
        Request::GetRobotInfo => {
            let robots = about.robots.iter();
            Some(counted(about.robots.len(), robots.flat_map(|it| [kind(it.kind()), it.model.name().to_owned()])))
        }
        Request::GetRobotName { robot } => {
            let robots = chosen(&about.robots, *robot)?;
            Some(counted(robots.len(), robots.iter().map(|it| it.name.clone())))
        }
        Request::GetRobotSerial { robot } => {
            let robots = chosen(&about.robots, *robot)?;
            Some(counted(robots.len(), robots.iter().map(|it| it.serial.clone())))
        }
        Request::GetMotor { robot } => {
            let robots = chosen(&now.robots, *robot)?;
            Some(counted(robots.len(), robots.iter().flat_map(|it| [it.motors_on, it.power_high].map(digit))))
        }
        Request::GetHofs { robot } => {
            let axes = one(now, *robot)?.axes.iter();
            Some(Reply::List(axes.map(|axis| axis.home_offset.to_string()).collect()))
        }
        Request::GetHealthCont => Some(health(now.controller.battery)),
        Request::GetHealthRB { robot, part, joint } => {
            let robot = one(now, *robot)?;
            let axis = usize::from(joint.get()).checked_sub(1).and_then(|joint| robot.axes.get(joint));
            let part = usize::from(part.get()).checked_sub(1).and_then(|part| Part::OF_AXIS.get(part))?;
            Some(health(axis.map_or(ConsumableValues::NONE, |axis| axis.part(*part))))
        }
        Request::GetPartWarning { robot } => {
            let robot = one(now, *robot)?;
            let is_worn = |part: &Part| robot.axes.iter().any(|axis| axis.part(*part).consumption_rate >= 100.0);
            Some(Reply::List(Part::OF_AXIS.iter().map(|part| digit(is_worn(part))).collect()))
        }
        // At most 100.
        Request::GetCpuLoad => text(&(now.controller.cpu_load.round() as u8)),
        Request::GetPrjName => text(&about.project),
        // The virtual controller has the texts in English only.
        Request::GetErrMsg { code, .. } => text(&error_message(code.get())),
        // The simulated program does not know which line raised an error.
        Request::GetErrFunc { .. } => Some(Reply::List(vec!["0".to_owned()])),
        _ => None,
    }
}

fn counted(count: usize, values: impl Iterator<Item = String>) -> Reply {
    Reply::List([count.to_string()].into_iter().chain(values).collect())
}

/// All robots, or the one with this number.
fn chosen<T>(robots: &[T], robot: RobotNumber) -> Option<&[T]> {
    match usize::from(robot.get()) {
        0 => Some(robots),
        number => robots.get(number - 1..number),
    }
}

fn one(now: &CellSnapshot, robot: RobotNumber) -> Option<&RobotValues> {
    chosen(&now.robots, robot)?.first().filter(|_| robot.get() != 0)
}

fn digit(on: bool) -> String {
    u8::from(on).to_string()
}

/// The vendor's number of a kind of robot.
fn kind(kind: RobotKind) -> String {
    match kind {
        RobotKind::Scara => "3",
        RobotKind::SixAxis => "5",
    }
    .to_owned()
}

/// Date of installation, consumption in per cent, months left; or −1.
fn health(part: ConsumableValues) -> Reply {
    Reply::List(match part.installed.filter(|_| part.available) {
        Some(installed) => {
            vec![written(installed), format!("{:.3}", part.consumption_rate), format!("{:.3}", part.months_remaining)]
        }
        None => vec!["-1".to_owned()],
    })
}

fn written(date: DateTime<Utc>) -> String {
    date.format("%Y/%m/%d %H:%M:%S").to_string()
}

/// The settings of the controller, one binary digit each, the highest bit first: 1 not in independent mode, 6 maintenance
/// data, 13 global variables are kept, 16 virtual I/O, 22 Reset switches outputs off. The others are off.
fn settings(about: &CellDescription) -> String {
    const BITS: usize = 23;
    let bits: u32 = 1 << 1 | 1 << 6 | 1 << 13 | u32::from(about.virtual_io) << 16 | 1 << 22;
    format!("{bits:0BITS$b}")
}

/// An address of the range for local use that follows from the serial number.
fn mac_address(serial: &str) -> String {
    // FNV-1a.
    let hash = serial
        .bytes()
        .fold(0xCBF2_9CE4_8422_2325_u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01B3));
    let [.., a, b, c, d, e] = hash.to_be_bytes();
    format!("02-{a:02X}-{b:02X}-{c:02X}-{d:02X}-{e:02X}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn old_firmware_does_not_know_these_commands() {
        for (firmware, known) in [
            ((7, 4, 6), false),
            ((7, 4, 7), true),
            ((7, 4, 49), true),
            ((7, 4, 50), false),
            ((7, 4, 56), false),
            ((7, 4, 57), true),
            ((7, 5, 4), true),
            ((8, 0, 0), true),
        ] {
            let (major, minor, patch) = firmware;
            assert_eq!(is_answered_by(FirmwareVersion::new(major, minor, patch)), known, "{firmware:?}");
        }
    }

    #[test]
    fn addresses_are_for_local_use_and_differ() {
        let first = mac_address("SN0000123");
        assert!(first.starts_with("02-") && first.len() == 17, "{first}");
        assert_ne!(first, mac_address("SN0000124"));
    }
}
