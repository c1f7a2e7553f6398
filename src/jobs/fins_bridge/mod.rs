//! Opening a bridge between a PLC and a robot from its map.

mod remote_item;
mod remote_robot;
#[cfg(test)]
mod tests;

use std::path::Path;

use secrecy::{ExposeSecret as _, SecretString};

use crate::fins::bridge::Bridge;
use crate::fins::bridge::map::{BridgeMap, MAX_MAP_BYTES, MapError, RobotTarget, RowMistake};
use crate::fins::bridge::robot::{PlcRobot, RobotSide};
use crate::model::{ErrorCode, Problem};
use crate::remote::Password;
use crate::remote::client::RemoteTarget;
use remote_robot::RemoteRobot;

/// Reads a map and makes the bridge of it, which does not run yet and has connected to nothing. `read_password` reads the
/// file with the password of the robot controller, if the map names one.
///
/// # Errors
/// A file cannot be read or is no map; a row names something that the robot does not have; the password is none that a
/// controller can have.
pub fn open_fins_bridge(
    file: &Path,
    read_password: impl FnOnce(&Path) -> Result<SecretString, Problem>,
) -> Result<Bridge, Problem> {
    let text = read(file)?;
    let told = |error: MapError| {
        let Problem { code, detail } = error.into();
        Problem::with_detail(code, format!("{}: {}", file.display(), detail.unwrap_or_default()))
    };
    let map = BridgeMap::parse(&text).map_err(told)?;
    let robot: Box<dyn RobotSide> = match &map.robot {
        RobotTarget::Plc(settings) => Box::new(PlcRobot::new((**settings).clone())),
        RobotTarget::Remote { to, password_file } => {
            let target: RemoteTarget = to.parse()?;
            let password = match password_file {
                None => Password::default(),
                Some(name) => {
                    let name = file.parent().unwrap_or(Path::new("")).join(name);
                    let secret = read_password(&name)?;
                    let bad = || Problem::with_detail(ErrorCode::BadCredential, name.display());
                    Password::new(secret.expose_secret()).ok_or_else(bad)?
                }
            };
            Box::new(RemoteRobot::new(target, password))
        }
    };
    Bridge::new(map, robot)
        .map_err(|(row, error)| told(MapError::Row { number: row + 1, source: RowMistake::Item(error) }))
}

fn read(file: &Path) -> Result<String, Problem> {
    use std::io::Read as _;
    let unreadable = |error: std::io::Error| {
        let code = match error.kind() {
            std::io::ErrorKind::NotFound => ErrorCode::FileNotFound,
            std::io::ErrorKind::InvalidData => ErrorCode::BadBridgeMap,
            _ => ErrorCode::FileUnreadable,
        };
        Problem::with_detail(code, format!("{}: {error}", file.display()))
    };
    let mut text = String::new();
    let opened = std::fs::File::open(file).map_err(unreadable)?;
    opened.take(MAX_MAP_BYTES as u64 + 1).read_to_string(&mut text).map_err(unreadable)?;
    if text.len() > MAX_MAP_BYTES {
        return Err(Problem::with_detail(ErrorCode::FileTooLarge, file.display()));
    }
    Ok(text)
}
