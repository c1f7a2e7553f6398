use chrono::TimeDelta;

use crate::model::{CertificateStatus, CertificateSummary, ErrorCode, SecurityPolicy, ServerStatus, UserTokenPolicy};
use crate::pki::{CertificateFinding, CertificateRejection, RefusalCause, Severity};
use crate::session::opcua_client::{MessageSecurity, TokenKind};
use crate::workspace::ConfiguratorIdentity;

/// What came of connecting to one controller's OPC UA server as a client does.
#[derive(Debug, Clone, PartialEq)]
pub struct VerifyReport {
    /// What was connected to: the address in the engineer's list, and the port of the basic settings.
    pub url: String,
    /// What this program showed to the server.
    pub own: ConfiguratorIdentity,
    /// Errors first.
    pub findings: Vec<VerifyFinding>,
    /// `None`: the server showed none.
    pub certificate: Option<CertificateVerdict>,
    /// By policy and mode.
    pub endpoints: Vec<EndpointVerdict>,
}

/// How this computer, as a client, judges the certificate the server shows.
#[derive(Debug, Clone, PartialEq)]
pub struct CertificateVerdict {
    /// Names and dates of the certificate.
    pub summary: CertificateSummary,
    /// Why it is refused (OPC 10000-4 §6.1.3); `None`: it is accepted.
    pub refused: Option<CertificateRejection>,
    /// Everything clients may say about it, errors first.
    pub findings: Vec<CertificateFinding>,
}

/// One endpoint: a security policy with a mode.
#[derive(Debug, Clone, PartialEq)]
pub struct EndpointVerdict {
    /// Or the URI of one that is not known here.
    pub policy: Result<SecurityPolicy, String>,
    /// Message security mode; `None` if it is none that is known here.
    pub mode: Option<MessageSecurity>,
    /// What came of each token the endpoint offers.
    pub tokens: Vec<TokenVerdict>,
}

/// What came of one token at one endpoint.
#[derive(Debug, Clone, PartialEq)]
pub struct TokenVerdict {
    /// The kind of token.
    pub kind: TokenKind,
    /// What came of it.
    pub verdict: TokenOutcome,
}

/// What came of a login with one token.
#[derive(Debug, Clone, PartialEq)]
pub enum TokenOutcome {
    /// A session was activated, and values were read.
    Works,
    /// A login that should succeed does not.
    Fails(ConnectRefusal),
    /// The login was left out.
    NotTried(NotTried),
}

/// Why a client does not get in.
#[derive(Debug, Clone, PartialEq)]
pub enum ConnectRefusal {
    /// No TCP connection; the operating system's words.
    NotReachable(String),
    /// The server does not answer in time.
    TimedOut,
    /// What answers is no OPC UA server, or a broken one.
    NotOpcUa(String),
    /// The connection was closed without a word.
    Closed,
    /// The server refuses this program's certificate. The true reason is that of the controller's rejected list, `None`
    /// where that does not tell it.
    OwnCertificate(Option<RefusalDetails>),
    /// The certificate in the answer is another than the one of the endpoint.
    OtherCertificate,
    /// User name or password.
    Password,
    /// Login without a user name is offered, and refused.
    Anonymous,
    /// No room for another client.
    Busy(String),
    /// A client gets in, but the server does not run as it should; `ServerState` (OPC 10000-5 §12.6).
    State(i32),
    /// Any other OPC UA status, with the server's own words if it gave any.
    Status {
        /// Name of the status code in OPC 10000-6, annex A.
        name: String,
        /// What the server says about it; may be empty.
        reason: String,
    },
}

/// Why a certificate was refused, as far as the controller tells.
#[derive(Debug, Clone, PartialEq)]
pub struct RefusalDetails {
    /// The status code that the certificate was refused with.
    pub status: CertificateStatus,
    /// What is wrong, and with which certificate; `None` if the controller does not tell.
    pub cause: Option<RefusalCause>,
    /// In English.
    pub reason: String,
}

/// Why something that is offered was left out. None of it is a fault.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotTried {
    /// No user and password were given.
    NoPassword,
    /// The same password was refused at another endpoint; trying on would lock the user out.
    PasswordRefused,
    /// The server takes the password without encryption.
    PasswordInTheClear,
    /// No certificate or ticket of a user is at hand.
    OtherToken,
    /// A policy or a mode that is not known here.
    UnknownSecurity,
    /// The server shows another certificate than the one selected in the controller: it may be another server.
    OtherCertificate,
    /// The server sends a chain of certificates, which this client cannot use.
    Chain,
}

/// Something about the server as a whole.
#[derive(Debug, Clone, PartialEq)]
pub enum VerifyFinding {
    /// Nothing was connected to.
    NotRunning {
        /// What the controller reports of its server.
        status: ServerStatus,
        /// Why the server does not run, if the controller tells.
        error: Option<ErrorCode>,
    },
    /// The server could not be asked for its endpoints.
    NoAnswer(ConnectRefusal),
    /// The server offers no endpoint.
    NoEndpoints,
    /// Ticked in the basic settings, but not offered.
    PolicyMissing(SecurityPolicy),
    /// Offered, but not ticked.
    PolicyNotTicked(SecurityPolicy),
    /// A ticked user token policy is not offered by any endpoint.
    TokenMissing(UserTokenPolicy),
    /// A user token policy is offered although it is not ticked.
    TokenNotTicked(UserTokenPolicy),
    /// The server names another address than the one it was reached at. Clients that ask for endpoints follow it.
    OtherAddress {
        /// The URL that the server gives.
        url: String,
        /// From this computer.
        reachable: bool,
    },
    /// Not encrypted, or deprecated.
    WeakPolicy(SecurityPolicy),
    /// Only users with passwords are let in, and there is none.
    NoUsers,
    /// How far the controller's clock is ahead of this computer's: certificates may seem expired to one of them.
    Clock(TimeDelta),
}

impl VerifyReport {
    /// Nothing that is offered fails.
    pub fn all_works(&self) -> bool {
        self.findings.iter().all(|finding| finding.severity() == Severity::Warning)
            && self.certificate.as_ref().is_none_or(|certificate| certificate.refused.is_none())
            && !self.verdicts().any(|verdict| matches!(verdict, TokenOutcome::Fails(_)))
    }

    /// What was offered: how much of it works, fails, was not tried.
    pub fn counts(&self) -> VerifyCounts {
        let mut counts = VerifyCounts::default();
        for verdict in self.verdicts() {
            match verdict {
                TokenOutcome::Works => counts.work += 1,
                TokenOutcome::Fails(_) => counts.fail += 1,
                TokenOutcome::NotTried(_) => counts.not_tried += 1,
            }
        }
        counts
    }

    /// The server refuses this program because its certificate is not trusted yet, or for an unknown reason.
    pub fn lacks_trust(&self) -> bool {
        self.verdicts().any(|verdict| match verdict {
            TokenOutcome::Fails(ConnectRefusal::OwnCertificate(why)) => {
                why.as_ref().is_none_or(|told| told.status == CertificateStatus::Untrusted)
            }
            _ => false,
        })
    }

    /// Something was left out that a user and a password would let try.
    pub fn lacks_password(&self) -> bool {
        self.verdicts().any(|verdict| *verdict == TokenOutcome::NotTried(NotTried::NoPassword))
    }

    fn verdicts(&self) -> impl Iterator<Item = &TokenOutcome> {
        self.endpoints.iter().flat_map(|endpoint| &endpoint.tokens).map(|token| &token.verdict)
    }
}

impl CertificateVerdict {
    /// Without what is the reason of the refusal.
    pub fn further_findings(&self) -> impl Iterator<Item = &CertificateFinding> {
        let told = self.refused.as_ref().map(|rejection| &rejection.flaw);
        self.findings.iter().filter(move |finding| Some(&finding.flaw) != told)
    }
}

/// See [`VerifyReport::counts`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct VerifyCounts {
    /// Logins that work.
    pub work: usize,
    /// Logins that fail.
    pub fail: usize,
    /// Logins that were left out.
    pub not_tried: usize,
}

impl EndpointVerdict {
    /// `Basic256Sha256 – Sign`; of `None` there is one mode only.
    pub fn name(&self) -> String {
        let policy = self.policy.as_ref().map_or_else(String::as_str, |policy| policy.as_str());
        match self.mode {
            Some(MessageSecurity::None) if self.policy == Ok(SecurityPolicy::None) => policy.to_owned(),
            mode => format!("{policy} – {}", mode.map_or("?", MessageSecurity::as_str)),
        }
    }
}

impl VerifyFinding {
    /// Whether it keeps clients out or is a warning.
    pub fn severity(&self) -> Severity {
        match self {
            Self::NotRunning { .. }
            | Self::NoAnswer(_)
            | Self::NoEndpoints
            | Self::PolicyMissing(_)
            | Self::PolicyNotTicked(_)
            | Self::TokenMissing(_)
            | Self::TokenNotTicked(_)
            | Self::OtherAddress { reachable: false, .. }
            | Self::NoUsers => Severity::Error,
            Self::OtherAddress { reachable: true, .. } | Self::WeakPolicy(_) | Self::Clock(_) => Severity::Warning,
        }
    }

    /// As `--json` writes it.
    pub const fn code(&self) -> &'static str {
        match self {
            Self::NotRunning { .. } => "not-running",
            Self::NoAnswer(_) => "no-answer",
            Self::NoEndpoints => "no-endpoints",
            Self::PolicyMissing(_) => "policy-missing",
            Self::PolicyNotTicked(_) => "policy-not-ticked",
            Self::TokenMissing(_) => "token-missing",
            Self::TokenNotTicked(_) => "token-not-ticked",
            Self::OtherAddress { .. } => "other-address",
            Self::WeakPolicy(_) => "weak-policy",
            Self::NoUsers => "no-users",
            Self::Clock(_) => "clock",
        }
    }
}

impl TokenOutcome {
    /// As `--json` writes it.
    pub const fn code(&self) -> &'static str {
        match self {
            Self::Works => "works",
            Self::Fails(_) => "fails",
            Self::NotTried(_) => "not-tried",
        }
    }
}
