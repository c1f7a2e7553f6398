//! What is said of reports about connecting as a client.

use super::explain_refusal;
use crate::jobs::{ConnectRefusal, NotTried, RefusalDetails, TokenOutcome, VerifyCounts, VerifyFinding};
use crate::model::Language;
use crate::session::opcua_client::TokenKind;

in_every_language! {
    verify:
    /// What came of everything that is offered.
    fn verify_counts(counts: VerifyCounts) -> String;
    /// Where a sentence holds, when there are many places.
    fn endpoints_named(names: &[String]) -> String;
}

impl TokenOutcome {
    /// One sentence: what works, or why not and what helps.
    pub fn explain(&self, language: Language) -> String {
        match self {
            Self::Works => super::TextKey::VerdictWorks.text(language).to_owned(),
            Self::Fails(refusal) => refusal.explain(language),
            Self::NotTried(why) => why.explain(language).to_owned(),
        }
    }
}

impl RefusalDetails {
    /// Why the client does not get in, and what to do.
    pub fn explain(&self, language: Language) -> String {
        explain_refusal(self.status, self.cause.as_ref(), language)
    }
}

impl ConnectRefusal {
    /// What is wrong with the server, and what to do.
    pub fn explain(&self, language: Language) -> String {
        in_language!(language, verify::refusal(self))
    }
}

impl NotTried {
    /// Why it was not tried.
    pub const fn explain(self, language: Language) -> &'static str {
        in_language!(language, verify::not_tried(self))
    }
}

impl VerifyFinding {
    /// What it is, and what helps.
    pub fn explain(&self, language: Language) -> String {
        in_language!(language, verify::verify_finding(self))
    }
}

impl TokenKind {
    /// The word for the kind of token.
    pub const fn text(self, language: Language) -> &'static str {
        in_language!(language, verify::token_kind(self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{CertificateStatus, ErrorCode, SecurityPolicy, ServerStatus, UserTokenPolicy};
    use chrono::TimeDelta;

    fn told(status: CertificateStatus) -> RefusalDetails {
        RefusalDetails { status, cause: None, reason: "why".into() }
    }

    #[test]
    fn everything_is_said_in_every_language() {
        let refusals = [
            ConnectRefusal::NotReachable("why".into()),
            ConnectRefusal::TimedOut,
            ConnectRefusal::NotOpcUa("why".into()),
            ConnectRefusal::Closed,
            ConnectRefusal::OwnCertificate(None),
            ConnectRefusal::OwnCertificate(Some(told(CertificateStatus::Untrusted))),
            ConnectRefusal::OwnCertificate(Some(told(CertificateStatus::Revoked))),
            ConnectRefusal::OtherCertificate,
            ConnectRefusal::Password,
            ConnectRefusal::Anonymous,
            ConnectRefusal::Busy("why".into()),
            ConnectRefusal::State(3),
            ConnectRefusal::Status { name: "Bad".into(), reason: String::new() },
            ConnectRefusal::Status { name: "Bad".into(), reason: "why".into() },
        ];
        let findings = [
            VerifyFinding::NotRunning { status: ServerStatus::Error, error: Some(ErrorCode::PortConflict) },
            VerifyFinding::NotRunning { status: ServerStatus::Stop, error: None },
            VerifyFinding::NoAnswer(ConnectRefusal::TimedOut),
            VerifyFinding::NoEndpoints,
            VerifyFinding::PolicyMissing(SecurityPolicy::Basic256),
            VerifyFinding::PolicyNotTicked(SecurityPolicy::Basic256),
            VerifyFinding::TokenMissing(UserTokenPolicy::Anonymous),
            VerifyFinding::TokenNotTicked(UserTokenPolicy::UserName),
            VerifyFinding::OtherAddress { url: "opc.tcp://x".into(), reachable: true },
            VerifyFinding::OtherAddress { url: "opc.tcp://x".into(), reachable: false },
            VerifyFinding::WeakPolicy(SecurityPolicy::None),
            VerifyFinding::WeakPolicy(SecurityPolicy::Basic256),
            VerifyFinding::NoUsers,
            VerifyFinding::Clock(TimeDelta::days(-400)),
        ];
        let not_tried = [
            NotTried::NoPassword,
            NotTried::PasswordRefused,
            NotTried::PasswordInTheClear,
            NotTried::OtherToken,
            NotTried::UnknownSecurity,
            NotTried::OtherCertificate,
            NotTried::Chain,
        ];
        let of = |language: Language| -> Vec<String> {
            let said = refusals.iter().map(|refusal| refusal.explain(language));
            let said = said.chain(findings.iter().map(|finding| finding.explain(language)));
            said.chain(not_tried.iter().map(|why| why.explain(language).to_owned())).collect()
        };
        for en in of(Language::En) {
            assert!(en.is_ascii() && !en.ends_with('.') && en.len() > 10, "{en}");
        }
        for zh in of(Language::Zh) {
            assert!(!zh.is_ascii() && !zh.ends_with('。'), "{zh}");
        }
        for ja in of(Language::Ja) {
            assert!(!ja.is_ascii() && ja.contains('。') == ja.ends_with('。'), "{ja}");
        }
    }

    #[test]
    fn a_clock_is_told_in_words_a_person_uses() {
        let said = |minutes| VerifyFinding::Clock(TimeDelta::minutes(minutes)).explain(Language::En);
        assert!(said(-30).contains("30 minutes behind"));
        assert!(said(180).contains("3 hours ahead"));
        assert!(said(60 * 24 * 400).contains("400 days ahead"));
    }
}
