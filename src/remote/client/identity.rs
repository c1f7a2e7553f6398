use serde::Serialize;

use super::connection::RemoteClient;
use super::error::RemoteError;
use crate::remote::codec::{RefusalCode, Reply, Request, RobotNumber};

/// What a controller says about itself to the vendor's monitoring commands. They exist in the text form only, from firmware
/// 7.4.7.2 and 7.4.57.5 on; what the firmware does not answer is `None`.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct ControllerIdentity {
    /// Its name; `None` also if none is set.
    pub name: Option<String>,
    /// Serial number.
    pub serial: Option<String>,
    /// Model.
    pub model: Option<String>,
    /// Version of the firmware.
    pub firmware: Option<String>,
    /// Which device controls it.
    pub control_device: Option<String>,
    /// Subnet mask.
    pub subnet_mask: Option<String>,
    /// Default gateway.
    pub gateway: Option<String>,
    /// MAC address.
    pub mac_address: Option<String>,
    /// Name of the project.
    pub project: Option<String>,
    /// Load of the CPU, in per cent.
    pub cpu_load: Option<String>,
    /// Battery of the controller.
    pub battery: Option<PartHealth>,
    /// The robots, in the order of their numbers.
    pub robots: Vec<RobotIdentity>,
}

/// A robot of a controller.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct RobotIdentity {
    /// From 1 on.
    pub number: u8,
    /// Name.
    pub name: Option<String>,
    /// Serial number.
    pub serial: Option<String>,
    /// Type, such as SCARA.
    pub kind: Option<String>,
    /// Model.
    pub model: Option<String>,
    /// Whether the motors are on.
    pub motors_on: Option<bool>,
    /// Whether the power is high.
    pub power_high: Option<bool>,
    /// Parts that are to be replaced soon; `None` if the firmware does not tell.
    pub parts_due: Option<Vec<WearingPart>>,
}

/// How far a part is used up.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct PartHealth {
    /// When it was installed, as the controller writes it: `YYYY/MM/DD hh:mm:ss`.
    pub installed: String,
    /// Consumption, in per cent.
    pub consumption: String,
    /// Months until it should be replaced.
    pub months_left: String,
}

/// A part of a robot that wears, in the order in which the controller lists them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum WearingPart {
    /// Battery of the encoders.
    Battery,
    /// Timing belt.
    Belt,
    /// Grease.
    Grease,
    /// Motor.
    Motor,
    /// Reduction gear.
    Gear,
    /// Ball screw spline.
    BallScrew,
}

impl WearingPart {
    const ALL: [Self; 6] = [Self::Battery, Self::Belt, Self::Grease, Self::Motor, Self::Gear, Self::BallScrew];
}

impl ControllerIdentity {
    /// Whether the firmware answered none of the commands.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Asks for everything, one command after the other. A command that the firmware does not know is left out.
    ///
    /// Errors: those of [`RemoteClient::request`], but for the refusal 11.
    pub async fn read(client: &mut RemoteClient) -> Result<Self, RemoteError> {
        let mut identity = Self {
            name: text(client, Request::GetContName).await?.filter(|name| name != "0"),
            serial: text(client, Request::GetContNo).await?,
            model: text(client, Request::GetContType).await?,
            firmware: text(client, Request::GetContVer).await?.map(|version| version.replace(' ', "")),
            control_device: text(client, Request::GetContDev).await?,
            subnet_mask: text(client, Request::GetSubnetMask).await?,
            gateway: text(client, Request::GetDefaultGateway).await?,
            mac_address: text(client, Request::GetContMacAdd).await?,
            project: text(client, Request::GetPrjName).await?,
            cpu_load: text(client, Request::GetCpuLoad).await?,
            battery: list(client, Request::GetHealthCont).await?.as_deref().and_then(health),
            robots: Vec::new(),
        };
        identity.robots = robots(client).await?;
        Ok(identity)
    }
}

async fn robots(client: &mut RemoteClient) -> Result<Vec<RobotIdentity>, RemoteError> {
    let all = RobotNumber::ALL;
    let info = list(client, Request::GetRobotInfo).await?.unwrap_or_default();
    let names = list(client, Request::GetRobotName { robot: all }).await?.unwrap_or_default();
    let serials = list(client, Request::GetRobotSerial { robot: all }).await?.unwrap_or_default();
    let motors = list(client, Request::GetMotor { robot: all }).await?.unwrap_or_default();
    let counts = [&info, &names, &serials, &motors].map(|values| count(values));
    let most = counts.into_iter().max().unwrap_or_default();
    let mut robots = Vec::new();
    for number in 1..=most {
        let at = usize::from(number);
        let Some(robot) = RobotNumber::new(number) else { break };
        let flag = |at: usize| motors.get(at).map(|value| value == "1");
        robots.push(RobotIdentity {
            number,
            name: names.get(at).cloned(),
            serial: serials.get(at).cloned(),
            kind: info.get(2 * at - 1).cloned(),
            model: info.get(2 * at).cloned(),
            motors_on: flag(2 * at - 1),
            power_high: flag(2 * at),
            parts_due: list(client, Request::GetPartWarning { robot }).await?.as_deref().map(parts_due),
        });
    }
    Ok(robots)
}

/// The first value of a list counts the robots in it.
fn count(values: &[String]) -> u8 {
    values.first().and_then(|count| count.parse().ok()).unwrap_or_default()
}

fn parts_due(values: &[String]) -> Vec<WearingPart> {
    let due = WearingPart::ALL.into_iter().zip(values).filter(|(_, value)| *value == "1");
    due.map(|(part, _)| part).collect()
}

fn health(values: &[String]) -> Option<PartHealth> {
    let [installed, consumption, months_left] = values else { return None };
    let [installed, consumption, months_left] = [installed, consumption, months_left].map(Clone::clone);
    Some(PartHealth { installed, consumption, months_left })
}

async fn text(client: &mut RemoteClient, request: Request) -> Result<Option<String>, RemoteError> {
    Ok(match known(client, request).await? {
        Some(Reply::Text(text)) => Some(text.trim().to_owned()).filter(|text| !text.is_empty()),
        _ => None,
    })
}

async fn list(client: &mut RemoteClient, request: Request) -> Result<Option<Vec<String>>, RemoteError> {
    Ok(match known(client, request).await? {
        Some(Reply::List(values)) => Some(values.into_iter().map(|value| value.trim().to_owned()).collect()),
        _ => None,
    })
}

/// `None`: the firmware does not know the command.
async fn known(client: &mut RemoteClient, request: Request) -> Result<Option<Reply>, RemoteError> {
    match client.request(&request).await {
        Ok(reply) => Ok(Some(reply)),
        Err(RemoteError::Refused { code: RefusalCode::UnknownCommand, .. } | RemoteError::NotSent { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}
