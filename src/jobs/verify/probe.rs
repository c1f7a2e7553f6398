use std::collections::BTreeSet;

use chrono::{DateTime, TimeDelta, Utc};

use super::report::{EndpointVerdict, NotTried, Refusal, RefusalDetails, TokenOutcome, TokenVerdict, VerifyFinding};
use crate::jobs::{Run, Step};
use crate::model::{CertificateStatus, Credential, Problem, SecurityPolicy, ServerSettings, UserTokenPolicy};
use crate::pki::{Certificate, RejectedClient};
use crate::session::opcua_client::{
    Cause, Endpoint, Failure, Login, MessageSecurity, OpcUaClient, Stage, Target, TokenKind, is_about_a_certificate,
    is_about_a_user, printable,
};

/// What is tried at one server, and with what.
pub(super) struct Probe<'a> {
    pub client: &'a OpcUaClient,
    pub target: &'a Target,
    pub own: &'a Certificate,
    /// What the server must show.
    pub selected: Option<&'a Certificate>,
    pub login: Option<&'a Credential>,
    /// The controller's clock when this began.
    pub since: DateTime<Utc>,
    /// A password that was refused is not sent a second time.
    pub password_refused: bool,
    /// How this program's certificate was refused at another endpoint.
    pub certificate_refused: Option<Refusal>,
}

impl Probe<'_> {
    /// Every token of one endpoint, one after the other.
    pub async fn endpoint(&mut self, run: &mut Run<'_>, endpoint: &Endpoint) -> Result<EndpointVerdict, Problem> {
        let mut tokens = Vec::new();
        // What keeps one token out before anybody logs in keeps out the others as well.
        let mut shut: Option<Refusal> = None;
        for token in &endpoint.tokens {
            run.begin(Step::Verify)?;
            let login = self.login_for(endpoint, token.kind, token.protected);
            let verdict = match (login, &shut) {
                (Err(why), _) => TokenOutcome::NotTried(why),
                (Ok(_), Some(refusal)) => TokenOutcome::Fails(refusal.clone()),
                (Ok((expected, login)), None) => {
                    match self.client.attempt(self.target, endpoint, expected, &login).await {
                        Ok(welcome) if welcome.state == RUNNING => TokenOutcome::Works,
                        Ok(welcome) => TokenOutcome::Fails(Refusal::State(welcome.state)),
                        Err(failure) => {
                            let refusal = self.refusal(run, endpoint, token.kind, &failure).await;
                            if failure.stage < Stage::Login {
                                shut = Some(refusal.clone());
                            }
                            self.password_refused |= refusal == Refusal::Password;
                            if matches!(refusal, Refusal::OwnCertificate(Some(_))) {
                                self.certificate_refused = Some(refusal.clone());
                            }
                            TokenOutcome::Fails(refusal)
                        }
                    }
                }
            };
            tokens.push(TokenVerdict { kind: token.kind, verdict });
        }
        Ok(EndpointVerdict { policy: endpoint.policy.clone(), mode: endpoint.mode, tokens })
    }

    fn login_for(
        &self,
        endpoint: &Endpoint,
        kind: TokenKind,
        protected: bool,
    ) -> Result<(&Certificate, Login), NotTried> {
        let Ok(policy) = endpoint.policy else { return Err(NotTried::UnknownSecurity) };
        let secured = match (policy, endpoint.mode) {
            (SecurityPolicy::None, Some(MessageSecurity::None)) => false,
            (SecurityPolicy::None, _) | (_, None | Some(MessageSecurity::None)) => {
                return Err(NotTried::UnknownSecurity);
            }
            _ => true,
        };
        let with_password = kind == TokenKind::UserName;
        let selected = self.selected.ok_or(NotTried::OtherCertificate)?;
        if secured || with_password {
            match endpoint.certificates() {
                Ok((shown, _)) if shown != *selected => return Err(NotTried::OtherCertificate),
                Ok((_, chain)) if !chain.is_empty() => return Err(NotTried::Chain),
                Ok(_) => {}
                Err(_) => return Err(NotTried::OtherCertificate),
            }
        }
        match (kind, self.login) {
            (TokenKind::Anonymous, _) => Ok((selected, Login::Anonymous)),
            (TokenKind::Certificate | TokenKind::Issued, _) => Err(NotTried::OtherToken),
            (TokenKind::UserName, None) => Err(NotTried::NoPassword),
            (TokenKind::UserName, Some(_)) if !protected => Err(NotTried::PasswordInTheClear),
            (TokenKind::UserName, Some(_)) if self.password_refused => Err(NotTried::PasswordRefused),
            (TokenKind::UserName, Some(Credential { name, password })) => {
                Ok((selected, Login::User { name: name.as_str().to_owned(), password: password.secret().clone() }))
            }
        }
    }

    /// What a failure means, with the true reason where the controller tells it.
    async fn refusal(&self, run: &mut Run<'_>, endpoint: &Endpoint, kind: TokenKind, failure: &Failure) -> Refusal {
        let secured = endpoint.policy != Ok(SecurityPolicy::None);
        let early = matches!(failure.stage, Stage::Channel | Stage::CreateSession);
        let closed = failure.cause == Cause::Closed;
        if secured && early && (closed || failure.status().is_some_and(is_about_a_certificate)) {
            let why = self.told_why(run).await;
            if why.is_some() || !closed {
                return Refusal::OwnCertificate(why.or_else(|| told_plainly(failure)));
            }
            // A server says no more to an address it has refused too often.
            if let Some(before) = &self.certificate_refused {
                return before.clone();
            }
        }
        match (refusal_of(failure), failure.stage, kind) {
            (Refusal::Status { name, .. }, Stage::Login, TokenKind::UserName) if is_about_a_user(&name) => {
                Refusal::Password
            }
            (Refusal::Status { name, .. }, Stage::Login, TokenKind::Anonymous) if is_about_a_user(&name) => {
                Refusal::Anonymous
            }
            (refusal, ..) => refusal,
        }
    }

    /// Why the controller refused this program's certificate just now, if it did and says so.
    async fn told_why(&self, run: &mut Run<'_>) -> Option<RefusalDetails> {
        let rejected = run.session.rejected_clients().await.inspect_err(|problem| {
            tracing::info!(%problem, "the controller does not tell whom it refused");
        });
        let own = |client: &RejectedClient| client.certificate.0 == self.own.der() && client.last_seen >= self.since;
        let client = rejected.ok()?.value.into_iter().find(own)?;
        Some(RefusalDetails { status: client.status, reason: printable(&client.reason), cause: client.cause })
    }
}

/// The reason of a failure that does not depend on the user token.
pub(super) fn refusal_of(failure: &Failure) -> Refusal {
    match &failure.cause {
        Cause::NotReachable(why) => Refusal::NotReachable(why.clone()),
        Cause::TimedOut => Refusal::TimedOut,
        Cause::NotOpcUa(why) => Refusal::NotOpcUa(why.clone()),
        Cause::Closed => Refusal::Closed,
        Cause::OtherCertificate => Refusal::OtherCertificate,
        Cause::Status { name, .. } if BUSY.contains(&name.as_str()) => Refusal::Busy(name.clone()),
        Cause::Status { name, reason, .. } => Refusal::Status { name: name.clone(), reason: reason.clone() },
        Cause::Internal(why) => Refusal::Status { name: "BadInternalError".to_owned(), reason: why.clone() },
    }
}

/// A server that tells the client itself, which the standard advises against.
fn told_plainly(failure: &Failure) -> Option<RefusalDetails> {
    let status = failure.status()?.parse().ok().filter(|status| *status != CertificateStatus::SecurityChecksFailed)?;
    Some(RefusalDetails { status, cause: None, reason: failure.cause.to_string() })
}

/// What the endpoints lack, and have too much, compared with the basic settings.
pub(super) fn compare(endpoints: &[Endpoint], settings: &ServerSettings) -> Vec<VerifyFinding> {
    let mut findings = Vec::new();
    if endpoints.is_empty() {
        return vec![VerifyFinding::NoEndpoints];
    }
    let policies = offered_policies(endpoints);
    for policy in settings.security_policies.difference(&policies) {
        findings.push(VerifyFinding::PolicyMissing(*policy));
    }
    for policy in policies.difference(&settings.security_policies) {
        findings.push(VerifyFinding::PolicyNotTicked(*policy));
    }
    let tokens: BTreeSet<UserTokenPolicy> =
        endpoints.iter().flat_map(|endpoint| &endpoint.tokens).filter_map(|token| token.kind.policy()).collect();
    for token in settings.user_tokens.difference(&tokens) {
        findings.push(VerifyFinding::TokenMissing(*token));
    }
    for token in tokens.difference(&settings.user_tokens) {
        findings.push(VerifyFinding::TokenNotTicked(*token));
    }
    findings.extend(policies.into_iter().filter(|policy| policy.is_weak()).map(VerifyFinding::WeakPolicy));
    findings
}

pub(super) fn offered_policies(endpoints: &[Endpoint]) -> BTreeSet<SecurityPolicy> {
    endpoints.iter().filter_map(|endpoint| endpoint.policy.clone().ok()).collect()
}

/// The clocks of a controller and this computer, if they are so far apart that it matters.
pub(super) fn clock(controller: DateTime<Utc>, here: DateTime<Utc>) -> Option<VerifyFinding> {
    let ahead = controller - here;
    (ahead.abs() > CLOCK_TOLERANCE).then_some(VerifyFinding::Clock(ahead))
}

/// `ServerState.Running`.
const RUNNING: i32 = 0;
const CLOCK_TOLERANCE: TimeDelta = TimeDelta::minutes(10);
const BUSY: [&str; 5] = [
    "BadTcpServerTooBusy",
    "BadTooManySessions",
    "BadTooManyOperations",
    "BadMaxConnectionsReached",
    "BadResourceUnavailable",
];

#[cfg(test)]
mod tests {
    use super::*;

    fn status(stage: Stage, name: &str) -> Failure {
        Failure { stage, cause: Cause::Status { code: 0, name: name.into(), reason: String::new() } }
    }

    #[test]
    fn a_server_without_room_is_told_from_one_that_refuses() {
        assert_eq!(
            refusal_of(&status(Stage::Channel, "BadTcpServerTooBusy")),
            Refusal::Busy("BadTcpServerTooBusy".into())
        );
        assert!(matches!(refusal_of(&status(Stage::Channel, "BadSecurityPolicyRejected")), Refusal::Status { .. }));
        assert!(is_about_a_certificate("BadSecurityChecksFailed") && !is_about_a_certificate("BadTimeout"));
    }

    #[test]
    fn a_status_that_tells_nothing_is_no_reason() {
        assert_eq!(told_plainly(&status(Stage::Channel, "BadSecurityChecksFailed")), None);
        let told = told_plainly(&status(Stage::Channel, "BadCertificateRevoked"));
        assert_eq!(told.map(|told| told.status), Some(CertificateStatus::Revoked));
    }

    #[test]
    fn clocks_a_few_minutes_apart_are_nothing_to_talk_about() {
        let here = Utc::now();
        assert_eq!(clock(here + TimeDelta::minutes(9), here), None);
        assert_eq!(clock(here - TimeDelta::minutes(11), here), Some(VerifyFinding::Clock(TimeDelta::minutes(-11))));
    }

    #[test]
    fn a_server_without_endpoints_is_not_compared() {
        assert_eq!(compare(&[], &ServerSettings::default()), [VerifyFinding::NoEndpoints]);
    }
}
