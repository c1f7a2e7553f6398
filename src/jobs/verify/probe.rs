use std::collections::BTreeSet;

use chrono::{DateTime, TimeDelta, Utc};

use super::report::{
    ConnectRefusal, EndpointVerdict, NotTried, RefusalDetails, TokenOutcome, TokenVerdict, VerifyFinding,
};
use crate::jobs::{JobStep, OperationRun};
use crate::model::{CertificateStatus, Problem, SecurityPolicy, ServerSettings, UserCredential, UserTokenPolicy};
use crate::pki::{Certificate, RejectedClient};
use crate::session::opcua_client::{
    ConnectFailure, ConnectFailureCause, ConnectStage, Endpoint, MessageSecurity, OpcUaClient, ServerLocation,
    TokenKind, UserLogin, is_about_a_certificate, is_about_a_user, printable,
};

/// What is tried at one server, and with what.
pub(super) struct Probe<'a> {
    pub client: &'a OpcUaClient,
    pub target: &'a ServerLocation,
    pub own: &'a Certificate,
    /// What the server must show.
    pub selected: Option<&'a Certificate>,
    pub login: Option<&'a UserCredential>,
    /// The controller's clock when this began.
    pub since: DateTime<Utc>,
    /// A password that was refused is not sent a second time.
    pub password_refused: bool,
    /// How this program's certificate was refused at another endpoint.
    pub certificate_refused: Option<ConnectRefusal>,
}

impl Probe<'_> {
    /// Every token of one endpoint, one after the other.
    pub async fn endpoint(
        &mut self,
        run: &mut OperationRun<'_>,
        endpoint: &Endpoint,
    ) -> Result<EndpointVerdict, Problem> {
        let mut tokens = Vec::new();
        // A failure before the login keeps the other tokens out as well.
        let mut shut: Option<ConnectRefusal> = None;
        for token in &endpoint.tokens {
            run.begin(JobStep::Verify)?;
            let login = self.login_for(endpoint, token.kind, token.protected);
            let verdict = match (login, &shut) {
                (Err(why), _) => TokenOutcome::NotTried(why),
                (Ok(_), Some(refusal)) => TokenOutcome::Fails(refusal.clone()),
                (Ok((expected, login)), None) => {
                    match self.client.attempt(self.target, endpoint, expected, &login).await {
                        Ok(welcome) if welcome.state == RUNNING => TokenOutcome::Works,
                        Ok(welcome) => TokenOutcome::Fails(ConnectRefusal::State(welcome.state)),
                        Err(failure) => {
                            let refusal = self.refusal(run, endpoint, token.kind, &failure).await;
                            if failure.stage < ConnectStage::Login {
                                shut = Some(refusal.clone());
                            }
                            self.password_refused |= refusal == ConnectRefusal::Password;
                            if matches!(refusal, ConnectRefusal::OwnCertificate(Some(_))) {
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
    ) -> Result<(&Certificate, UserLogin), NotTried> {
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
            (TokenKind::Anonymous, _) => Ok((selected, UserLogin::Anonymous)),
            (TokenKind::Certificate | TokenKind::Issued, _) => Err(NotTried::OtherToken),
            (TokenKind::UserName, None) => Err(NotTried::NoPassword),
            (TokenKind::UserName, Some(_)) if !protected => Err(NotTried::PasswordInTheClear),
            (TokenKind::UserName, Some(_)) if self.password_refused => Err(NotTried::PasswordRefused),
            (TokenKind::UserName, user @ Some(_)) => Ok((selected, UserLogin::of(user))),
        }
    }

    /// What a failure means, with the true reason where the controller tells it.
    async fn refusal(
        &self,
        run: &mut OperationRun<'_>,
        endpoint: &Endpoint,
        kind: TokenKind,
        failure: &ConnectFailure,
    ) -> ConnectRefusal {
        let secured = endpoint.policy != Ok(SecurityPolicy::None);
        let early = matches!(failure.stage, ConnectStage::Channel | ConnectStage::CreateSession);
        let closed = failure.cause == ConnectFailureCause::Closed;
        if secured && early && (closed || failure.status().is_some_and(is_about_a_certificate)) {
            let why = self.ask_for_reason(run).await;
            if why.is_some() || !closed {
                return ConnectRefusal::OwnCertificate(why.or_else(|| stated_reason(failure)));
            }
            // A server says no more to an address it has refused too often.
            if let Some(before) = &self.certificate_refused {
                return before.clone();
            }
        }
        match (refusal_of(failure), failure.stage, kind) {
            (ConnectRefusal::Status { name, .. }, ConnectStage::Login, TokenKind::UserName)
                if is_about_a_user(&name) =>
            {
                ConnectRefusal::Password
            }
            (ConnectRefusal::Status { name, .. }, ConnectStage::Login, TokenKind::Anonymous)
                if is_about_a_user(&name) =>
            {
                ConnectRefusal::Anonymous
            }
            (refusal, ..) => refusal,
        }
    }

    /// Why the controller refused this program's certificate just now, if it did and says so.
    async fn ask_for_reason(&self, run: &mut OperationRun<'_>) -> Option<RefusalDetails> {
        let rejected = run.session.rejected_clients().await.inspect_err(|problem| {
            tracing::info!(%problem, "the controller does not tell whom it refused");
        });
        let own = |client: &RejectedClient| client.certificate.0 == self.own.der() && client.last_seen >= self.since;
        let client = rejected.ok()?.value.into_iter().find(own)?;
        Some(RefusalDetails { status: client.status, reason: printable(&client.reason), cause: client.cause })
    }
}

/// The reason of a failure that does not depend on the user token.
pub(super) fn refusal_of(failure: &ConnectFailure) -> ConnectRefusal {
    match &failure.cause {
        ConnectFailureCause::NotReachable(why) => ConnectRefusal::NotReachable(why.clone()),
        ConnectFailureCause::TimedOut => ConnectRefusal::TimedOut,
        ConnectFailureCause::NotOpcUa(why) => ConnectRefusal::NotOpcUa(why.clone()),
        ConnectFailureCause::Closed => ConnectRefusal::Closed,
        ConnectFailureCause::OtherCertificate => ConnectRefusal::OtherCertificate,
        ConnectFailureCause::Status { name, .. } if BUSY.contains(&name.as_str()) => ConnectRefusal::Busy(name.clone()),
        ConnectFailureCause::Status { name, reason, .. } => {
            ConnectRefusal::Status { name: name.clone(), reason: reason.clone() }
        }
        ConnectFailureCause::Internal(why) => {
            ConnectRefusal::Status { name: "BadInternalError".to_owned(), reason: why.clone() }
        }
    }
}

/// A server that tells the client itself, which the standard advises against.
fn stated_reason(failure: &ConnectFailure) -> Option<RefusalDetails> {
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

    fn status(stage: ConnectStage, name: &str) -> ConnectFailure {
        ConnectFailure {
            stage,
            cause: ConnectFailureCause::Status { code: 0, name: name.into(), reason: String::new() },
        }
    }

    #[test]
    fn a_server_without_room_is_told_from_one_that_refuses() {
        assert_eq!(
            refusal_of(&status(ConnectStage::Channel, "BadTcpServerTooBusy")),
            ConnectRefusal::Busy("BadTcpServerTooBusy".into())
        );
        assert!(matches!(
            refusal_of(&status(ConnectStage::Channel, "BadSecurityPolicyRejected")),
            ConnectRefusal::Status { .. }
        ));
        assert!(is_about_a_certificate("BadSecurityChecksFailed") && !is_about_a_certificate("BadTimeout"));
    }

    #[test]
    fn a_status_that_tells_nothing_is_no_reason() {
        assert_eq!(stated_reason(&status(ConnectStage::Channel, "BadSecurityChecksFailed")), None);
        let told = stated_reason(&status(ConnectStage::Channel, "BadCertificateRevoked"));
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
