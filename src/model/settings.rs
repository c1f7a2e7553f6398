use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// The OPC UA security policies a controller offers (manual 2.6.1; OPC 10000-7).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub enum SecurityPolicy {
    /// `None`: messages are neither signed nor encrypted.
    None,
    /// `Basic128Rsa15`; SHA-1, deprecated by OPC 10000-7.
    Basic128Rsa15,
    /// `Basic256`; SHA-1, deprecated by OPC 10000-7.
    Basic256,
    /// `Basic256Sha256`.
    Basic256Sha256,
    /// `Aes128_Sha256_RsaOaep`.
    Aes128Sha256RsaOaep,
    /// `Aes256_Sha256_RsaPss`.
    Aes256Sha256RsaPss,
}

impl SecurityPolicy {
    /// All policies, the weakest first.
    pub const ALL: [Self; 6] = [
        Self::None,
        Self::Basic128Rsa15,
        Self::Basic256,
        Self::Basic256Sha256,
        Self::Aes128Sha256RsaOaep,
        Self::Aes256Sha256RsaPss,
    ];

    /// The name in the manual, in JSON and on the command line.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::None => "None",
            Self::Basic128Rsa15 => "Basic128Rsa15",
            Self::Basic256 => "Basic256",
            Self::Basic256Sha256 => "Basic256Sha256",
            Self::Aes128Sha256RsaOaep => "Aes128Sha256RsaOaep",
            Self::Aes256Sha256RsaPss => "Aes256Sha256RsaPss",
        }
    }

    /// Not encrypted, or deprecated by OPC 10000-7 because SHA-1 and short keys are broken.
    pub const fn is_weak(self) -> bool {
        matches!(self, Self::None | Self::Basic128Rsa15 | Self::Basic256)
    }
}

impl fmt::Display for SecurityPolicy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

impl FromStr for SecurityPolicy {
    type Err = SettingsError;

    /// Case and underscores do not matter; the manual's misprint `Basic256Rsa15` is `Basic128Rsa15`.
    fn from_str(text: &str) -> Result<Self, SettingsError> {
        let plain = text.replace('_', "").to_ascii_lowercase();
        if plain == "basic256rsa15" {
            return Ok(Self::Basic128Rsa15);
        }
        Self::ALL
            .into_iter()
            .find(|p| p.as_str().to_ascii_lowercase() == plain)
            .ok_or_else(|| SettingsError::UnknownPolicy(text.to_owned()))
    }
}

/// How an OPC UA client may say who its user is (manual 2.6.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum UserTokenPolicy {
    /// Without a name.
    Anonymous,
    /// User name and password.
    UserName,
}

impl UserTokenPolicy {
    /// Both, in the order of the dialog.
    pub const ALL: [Self; 2] = [Self::Anonymous, Self::UserName];

    /// The name in the manual, in JSON and on the command line.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Anonymous => "anonymous",
            Self::UserName => "username",
        }
    }
}

impl FromStr for UserTokenPolicy {
    type Err = SettingsError;

    fn from_str(text: &str) -> Result<Self, SettingsError> {
        Self::ALL
            .into_iter()
            .find(|t| t.as_str().eq_ignore_ascii_case(text))
            .ok_or_else(|| SettingsError::UnknownToken(text.to_owned()))
    }
}

/// Who starts the OPC UA server (manual 2.6.1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum StartupMode {
    /// The server starts when the controller is switched on.
    Auto,
    /// The server starts by the command Start only.
    #[default]
    Manual,
}

impl StartupMode {
    /// Both, in the order of the dialog.
    pub const ALL: [Self; 2] = [Self::Auto, Self::Manual];

    /// The name in the manual, in JSON and on the command line.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Auto => "AUTO",
            Self::Manual => "MANUAL",
        }
    }
}

impl FromStr for StartupMode {
    type Err = SettingsError;

    fn from_str(text: &str) -> Result<Self, SettingsError> {
        Self::ALL
            .into_iter()
            .find(|m| m.as_str().eq_ignore_ascii_case(text))
            .ok_or_else(|| SettingsError::UnknownStartup(text.to_owned()))
    }
}

/// The TCP port of the OPC UA server: 1024–65535.
///
/// Ports in use elsewhere on the controller are the controller's to know ([`super::ControllerInfo::used_ports`]).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(try_from = "u16", into = "u16")]
pub struct ServerPort(u16);

/// Why a number is no [`ServerPort`].
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum PortError {
    /// The manual's own message (6.2).
    #[error("\"{0}\" is not a port between 0 and 65535")]
    NotAPort(String),
    /// The port belongs to the system (0–1023).
    #[error("port {0} belongs to the system; choose one from {min} to 65535", min = ServerPort::MIN)]
    System(u16),
}

impl ServerPort {
    /// Smallest port that a server may use.
    pub const MIN: u16 = 1024;
    /// The port IANA registered for `opc.tcp`.
    pub const DEFAULT: Self = Self(4840);

    /// The port number.
    pub const fn get(self) -> u16 {
        self.0
    }
}

impl TryFrom<u16> for ServerPort {
    type Error = PortError;
    fn try_from(port: u16) -> Result<Self, PortError> {
        if port < Self::MIN { Err(PortError::System(port)) } else { Ok(Self(port)) }
    }
}

impl From<ServerPort> for u16 {
    fn from(port: ServerPort) -> Self {
        port.0
    }
}

impl FromStr for ServerPort {
    type Err = PortError;
    fn from_str(text: &str) -> Result<Self, PortError> {
        let text = text.trim();
        text.parse::<u16>().map_err(|_| PortError::NotAPort(text.to_owned()))?.try_into()
    }
}

impl fmt::Display for ServerPort {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The basic settings of a controller's OPC UA server (manual 2.6.1).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ServerSettings {
    /// TCP port of the OPC UA server.
    pub port: ServerPort,
    /// Whether the server starts with the controller.
    pub startup: StartupMode,
    /// At least one.
    pub security_policies: BTreeSet<SecurityPolicy>,
    /// At least one.
    pub user_tokens: BTreeSet<UserTokenPolicy>,
    /// Off by default; switching it on asks for [`ServerSettings::LOG_PASSWORD`].
    pub server_log: bool,
}

/// Why settings cannot be applied (manual 2.6.1).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum SettingsError {
    /// No security policy is ticked.
    #[error("no security policy is ticked")]
    NoPolicy,
    /// No user token policy is ticked.
    #[error("no user token policy is ticked")]
    NoToken,
    /// No security policy has this name; holds the text.
    #[error("\"{0}\" is not a security policy")]
    UnknownPolicy(String),
    /// No user token policy has this name; holds the text.
    #[error("\"{0}\" is not a user token policy; known are anonymous and username")]
    UnknownToken(String),
    /// No startup mode has this name; holds the text.
    #[error("\"{0}\" is not a startup mode; known are auto and manual")]
    UnknownStartup(String),
}

/// What is allowed but deserves a word before it is applied.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SettingsWarning {
    /// A ticked policy is deprecated by OPC 10000-7 or gives no security.
    WeakPolicy(SecurityPolicy),
    /// No client can log in: user names are required and no user exists.
    NoUsers,
}

impl ServerSettings {
    /// What the manual makes a person type before the server log is switched on (2.6.1): a guard against switching
    /// it on by accident, not a secret.
    pub const LOG_PASSWORD: &'static str = "199532";

    /// The rules that do not depend on the controller.
    pub fn check(&self) -> Result<(), SettingsError> {
        if self.security_policies.is_empty() {
            return Err(SettingsError::NoPolicy);
        }
        if self.user_tokens.is_empty() {
            return Err(SettingsError::NoToken);
        }
        Ok(())
    }

    /// `users`: how many the controller has, when known.
    pub fn warnings(&self, users: Option<usize>) -> Vec<SettingsWarning> {
        let weak = self.security_policies.iter().copied().filter(|p| p.is_weak()).map(SettingsWarning::WeakPolicy);
        let nobody = users == Some(0) && !self.user_tokens.contains(&UserTokenPolicy::Anonymous);
        weak.chain(nobody.then_some(SettingsWarning::NoUsers)).collect()
    }
}

impl Default for ServerSettings {
    /// Only the strong policies, named users, started by hand.
    fn default() -> Self {
        Self {
            port: ServerPort::DEFAULT,
            startup: StartupMode::Manual,
            security_policies: SecurityPolicy::ALL.into_iter().filter(|p| !p.is_weak()).collect(),
            user_tokens: BTreeSet::from([UserTokenPolicy::UserName]),
            server_log: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_port_is_1024_to_65535() {
        assert_eq!("4840".parse::<ServerPort>().map(ServerPort::get), Ok(4840));
        assert_eq!("80".parse::<ServerPort>(), Err(PortError::System(80)));
        assert_eq!("65536".parse::<ServerPort>(), Err(PortError::NotAPort("65536".into())));
        assert_eq!("４８４０".parse::<ServerPort>(), Err(PortError::NotAPort("４８４０".into())));
        assert_eq!("".parse::<ServerPort>(), Err(PortError::NotAPort("".into())));
    }

    #[test]
    fn at_least_one_policy_and_one_token() {
        let settings = ServerSettings::default();
        assert_eq!(settings.check(), Ok(()));
        assert_eq!(
            ServerSettings { security_policies: BTreeSet::new(), ..settings.clone() }.check(),
            Err(SettingsError::NoPolicy)
        );
        assert_eq!(ServerSettings { user_tokens: BTreeSet::new(), ..settings }.check(), Err(SettingsError::NoToken));
    }

    #[test]
    fn weak_policies_and_missing_users_are_warned_about() {
        let mut settings = ServerSettings::default();
        assert_eq!(settings.warnings(Some(0)), [SettingsWarning::NoUsers]);
        assert_eq!(settings.warnings(Some(1)), []);
        assert_eq!(settings.warnings(None), []);
        settings.security_policies.insert(SecurityPolicy::None);
        assert_eq!(settings.warnings(Some(1)), [SettingsWarning::WeakPolicy(SecurityPolicy::None)]);
    }

    #[test]
    fn policies_are_known_by_every_name_the_manual_uses() {
        assert_eq!("Basic256Rsa15".parse(), Ok(SecurityPolicy::Basic128Rsa15));
        assert_eq!("aes128_sha256_rsaoaep".parse(), Ok(SecurityPolicy::Aes128Sha256RsaOaep));
        assert!("Basic512".parse::<SecurityPolicy>().is_err());
    }
}
