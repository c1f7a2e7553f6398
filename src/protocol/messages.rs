//! Parts that several messages have in common.

use std::fmt;

use secrecy::{ExposeSecret, SecretString};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Response;
use crate::model::{Changed, ErrorCode, Problem, Revisioned};

/// A secret inside a message: serialised as a plain string (the channel is encrypted), not shown by `Debug`.
#[derive(Clone)]
pub struct WireSecret(pub SecretString);

impl WireSecret {
    /// The secret in plain text.
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

impl<T: Response> Response for Revisioned<T> {
    fn check(&mut self) -> Result<(), &'static str> {
        self.value.check()
    }
}

impl Response for Changed {}

/// The body of every failed request.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FailureBody {
    /// What went wrong.
    pub code: ErrorCode,
    /// English, for logs; a client shows its own text for the code.
    pub message: String,
    /// A technical detail in English; never a secret.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub detail: Option<String>,
}

impl From<Problem> for FailureBody {
    fn from(problem: Problem) -> Self {
        let message = problem.code.explain(crate::model::Language::En).message.to_owned();
        Self { code: problem.code, message, detail: problem.detail }
    }
}

/// A code that only the PC can give, such as that of a cancelled job, becomes [`ErrorCode::Refused`].
impl From<FailureBody> for Problem {
    fn from(failure: FailureBody) -> Self {
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
    use crate::protocol::Login;

    #[test]
    fn secrets_travel_but_are_not_shown() {
        let login = Login { password: WireSecret("hunter22".into()) };
        assert_eq!(serde_json::to_string(&login).expect("json"), r#"{"password":"hunter22"}"#);
        assert!(!format!("{login:?}").contains("hunter22"));
    }

    #[test]
    fn a_failure_names_its_code_and_keeps_its_detail() {
        let problem = Problem::with_detail(ErrorCode::PortConflict, "4840");
        let failure = FailureBody::from(problem.clone());
        let json = serde_json::to_value(&failure).expect("json");
        assert_eq!(json["code"], "7933");
        assert_eq!(json["detail"], "4840");
        assert_eq!(Problem::from(failure), problem);
    }

    #[test]
    fn a_controller_cannot_report_what_only_the_pc_can_know() {
        for code in [ErrorCode::Cancelled, ErrorCode::Timeout, ErrorCode::FingerprintChanged] {
            let failure = FailureBody { code, message: "so there".into(), detail: None };
            let problem = Problem::from(failure);
            assert_eq!(problem.code, ErrorCode::Refused);
            assert_eq!(problem.detail, Some(format!("{}: so there", code.as_str())));
        }
    }
}
