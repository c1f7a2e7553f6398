//! What is wrong with certificates and certificate revocation lists.

use std::fmt;

use chrono::{DateTime, SecondsFormat, Utc};

use crate::model::{CertificateStatus, Language, untrusted_text};
use crate::pki::{
    CertificateFinding, CertificateFlaw, CrlFlaw, CrlUnusable, KeyUsage, OutOfScope, RefusalCause, RejectedClient,
    UnverifiableSignature,
};

impl CertificateFlaw {
    /// What is wrong, as the end of a sentence about the certificate: "its key is not an RSA key".
    pub fn reason(&self, language: Language) -> String {
        printable(in_language!(language, certificates::flaw_reason(self)))
    }

    /// What to do, as the end of a sentence: "make a new one".
    pub fn remedy(&self, language: Language) -> String {
        printable(in_language!(language, certificates::flaw_remedy(self)))
    }

    /// What is wrong and what to do.
    pub fn explain(&self, language: Language) -> String {
        sentence(language, &self.reason(language), &self.remedy(language))
    }
}

impl RefusalCause {
    /// What is wrong and what to do.
    pub fn explain(&self, language: Language) -> String {
        let reason = self.flaw.reason(language);
        let reason = match &self.at_fault {
            None => reason,
            Some(issuer) => printable(in_language!(language, certificates::issuer_at_fault(issuer, &reason))),
        };
        sentence(language, &reason, &self.flaw.remedy(language))
    }
}

impl CertificateStatus {
    /// What it means, as a sentence without its full stop.
    pub const fn reason(self, language: Language) -> &'static str {
        in_language!(language, certificates::status(self)).0
    }

    /// What it means and what helps, in one sentence for a person.
    pub fn explain(self, language: Language) -> String {
        let (reason, remedy) = in_language!(language, certificates::status(self));
        in_language!(language, certificates::joined(reason, remedy))
    }
}

impl RejectedClient {
    /// What the refusal means and what to do about it.
    pub fn explain(&self, language: Language) -> String {
        explain_refusal(self.status, self.cause.as_ref(), language)
    }
}

impl CrlFlaw {
    /// What is wrong with the list of that authority and what to do.
    pub fn explain(&self, authority: &str, language: Language) -> String {
        CertificateFlaw::of_list(self.clone(), authority).explain(language)
    }
}

impl CrlUnusable {
    /// What is wrong, as the end of a sentence about the list.
    pub fn reason(&self, language: Language) -> String {
        in_language!(language, revocation_lists::unusable(self))
    }
}

impl CertificateFinding {
    /// What is wrong and what to do.
    pub fn explain(&self, language: Language) -> String {
        self.flaw.explain(language)
    }
}

/// English, for logs and programs.
impl fmt::Display for CrlUnusable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.reason(Language::En))
    }
}

/// English, for logs and programs.
impl fmt::Display for UnverifiableSignature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&super::en::signatures::unverifiable(self))
    }
}

/// English, for logs and programs.
impl fmt::Display for OutOfScope {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&super::en::revocation_lists::out_of_scope(self))
    }
}

/// What a refusal means and what to do: by its cause, or by its status where the cause is not told.
pub fn explain_refusal(status: CertificateStatus, cause: Option<&RefusalCause>, language: Language) -> String {
    cause.map_or_else(|| status.explain(language), |cause| cause.explain(language))
}

fn sentence(language: Language, reason: &str, remedy: &str) -> String {
    in_language!(language, certificates::sentence(reason, remedy))
}

/// A cause may come from a controller: its texts are not to be trusted more than a certificate's. Longer than what is said
/// of names that are quoted in a flaw, so that only what nothing here made is cut.
fn printable(text: String) -> String {
    const MOST: usize = 2500;
    untrusted_text::one_line(&text, usize::MAX).chars().take(MOST).collect()
}

/// As ISO 8601 in UTC, to the second.
pub(super) fn date(when: &DateTime<Utc>) -> String {
    when.to_rfc3339_opts(SecondsFormat::Secs, true)
}

/// By their names in RFC 5280.
pub(super) fn usages(usages: &[KeyUsage]) -> Vec<&'static str> {
    usages.iter().map(|usage| usage.as_str()).collect()
}

#[cfg(test)]
mod tests;
