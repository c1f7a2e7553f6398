use std::fmt;

use secrecy::{ExposeSecret, SecretString};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Base64Bytes;
use crate::model::{CertificateType, ErrorCode, Problem, SelfSignedRequest, ServerSettings, ServerStatus, UserName};

/// A secret inside a message: serialised as a plain string (the channel is encrypted), never shown by `Debug`.
#[derive(Clone)]
pub struct WireSecret(pub SecretString);

impl WireSecret {
    pub fn expose(&self) -> &str {
        self.0.expose_secret()
    }
}

impl fmt::Debug for WireSecret {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("WireSecret(…)")
    }
}

impl Serialize for WireSecret {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.expose())
    }
}

impl<'de> Deserialize<'de> for WireSecret {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        SecretString::deserialize(deserializer).map(Self)
    }
}

/// Who answers. The only thing a controller tells without a session.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Hello {
    /// Always [`super::PRODUCT`].
    pub product: String,
    /// The protocol versions the controller speaks.
    pub versions: Vec<u32>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Login {
    /// The connection password; may be empty.
    pub password: WireSecret,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Session {
    /// To be sent as `Authorization: Bearer`.
    pub token: WireSecret,
    /// How long the session lives without a request.
    pub idle_secs: u64,
}

/// A value with the revision of the configuration it was read at.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Revisioned<T> {
    pub revision: u64,
    pub value: T,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SetSettings {
    pub revision: u64,
    pub settings: ServerSettings,
    /// Delete the server log as well.
    #[serde(default)]
    pub delete_log: bool,
    /// Needed when the server log goes from off to on ([`ServerSettings::LOG_PASSWORD`]).
    #[serde(default)]
    pub log_password: Option<String>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AddUser {
    pub revision: u64,
    pub name: UserName,
    /// Never comes back from a controller.
    pub password: WireSecret,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RemoveUsers {
    pub revision: u64,
    pub names: Vec<UserName>,
}

/// Current firmware: the controller makes key and certificate itself; the key never leaves it.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MakeSelfSigned {
    pub revision: u64,
    pub request: SelfSignedRequest,
}

/// Legacy firmware: key and certificate made on the PC, sent as PKCS#12. Not for [`CertificateType::CaSigned`], which
/// is for the key of a CSR ([`super::ImportCaSigned`]).
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ImportCertificate {
    pub revision: u64,
    pub kind: CertificateType,
    pub pkcs12: Base64Bytes,
    /// The password of `pkcs12`, made up for this one transfer.
    pub password: WireSecret,
}

/// A change was applied.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Changed {
    /// The revision after the change.
    pub revision: u64,
    /// The server's state after the change.
    pub status: ServerStatus,
}

/// A server certificate was installed and selected.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Installed {
    pub changed: Changed,
    /// DER.
    pub certificate: Base64Bytes,
}

/// The body of every failed request.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Failure {
    pub code: ErrorCode,
    /// English, for logs; a client shows its own text for the code.
    pub message: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<String>,
}

impl From<Problem> for Failure {
    fn from(problem: Problem) -> Self {
        let message = problem.code.explain(crate::model::Language::En).message.to_owned();
        Self { code: problem.code, message, detail: problem.detail }
    }
}

/// A failure of the PC's own, such as a cancel, is not a controller's to report: it is taken for a refusal.
impl From<Failure> for Problem {
    fn from(failure: Failure) -> Self {
        if !failure.code.is_a_controllers() {
            return Self::with_detail(ErrorCode::Refused, format!("{}: {}", failure.code.as_str(), failure.message));
        }
        match failure.detail {
            Some(detail) => Self::with_detail(failure.code, detail),
            None => failure.code.into(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn secrets_travel_but_are_not_shown() {
        let login = Login { password: WireSecret("hunter22".into()) };
        assert_eq!(serde_json::to_string(&login).expect("json"), r#"{"password":"hunter22"}"#);
        assert!(!format!("{login:?}").contains("hunter22"));
    }

    #[test]
    fn a_failure_names_its_code_and_keeps_its_detail() {
        let problem = Problem::with_detail(ErrorCode::PortConflict, "4840");
        let failure = Failure::from(problem.clone());
        let json = serde_json::to_value(&failure).expect("json");
        assert_eq!(json["code"], "7933");
        assert_eq!(json["detail"], "4840");
        assert_eq!(Problem::from(failure), problem);
    }

    #[test]
    fn a_controller_cannot_report_what_only_the_pc_can_know() {
        for code in [ErrorCode::Cancelled, ErrorCode::Timeout, ErrorCode::FingerprintChanged] {
            let failure = Failure { code, message: "so there".into(), detail: None };
            let problem = Problem::from(failure);
            assert_eq!(problem.code, ErrorCode::Refused);
            assert_eq!(problem.detail, Some(format!("{}: so there", code.as_str())));
        }
    }

    #[test]
    fn unknown_members_of_a_request_are_refused() {
        assert!(serde_json::from_str::<RemoveUsers>(r#"{"revision":1,"names":[],"force":true}"#).is_err());
    }
}
