use chrono::{DateTime, SecondsFormat, Utc};

use crate::pki::OutOfScope;

/// Why a revocation list does not say whether a certificate was revoked. Those that come nearer to saying it are
/// greater.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CrlFlaw {
    /// There is no list of the issuer.
    Missing,
    /// It is signed with a key that no certificate of that name holds, or signed wrongly.
    NotSigned,
    /// Its signature cannot be checked; why.
    CannotSay(String),
    /// It is signed with another key of the issuer than the one that signed the certificate; why that key is not
    /// accepted (RFC 5280 §6.3.3 (f)).
    AnotherKey(String),
    /// The certificate of its signer does not allow the signing of lists.
    MayNotSign,
    /// It is signed with an algorithm that is too weak; which.
    TooWeak(String),
    /// It is a delta or indirect list, or something in it is not understood; what.
    Unusable(String),
    /// It is about other certificates.
    OutOfScope(OutOfScope),
    NotYetValid(DateTime<Utc>),
    /// It does not say until when it is valid.
    NoEnd,
    Expired(DateTime<Utc>),
    /// It is only about some reasons, and there is no list about the others.
    SomeReasons,
}

impl CrlFlaw {
    /// A sentence about the list of that issuer, in English.
    pub(super) fn explain(&self, issuer: &str) -> String {
        let text = |time: &DateTime<Utc>| time.to_rfc3339_opts(SecondsFormat::Secs, true);
        let list = format!("the revocation list of {issuer}");
        match self {
            Self::Missing => format!("there is no revocation list of {issuer}"),
            Self::NotSigned => format!("the signature of {list} is wrong"),
            Self::CannotSay(why) => format!("{list} cannot be believed: {why}"),
            Self::AnotherKey(why) => format!("{list} is signed with another of its keys: {why}"),
            Self::MayNotSign => format!("{issuer} may not sign revocation lists, but there is one"),
            Self::TooWeak(algorithm) => format!("{list} is signed with {algorithm}, which is too weak"),
            Self::Unusable(why) => format!("{list} cannot be used: {why}"),
            Self::OutOfScope(why) => format!("{list} does not cover this certificate: {why}"),
            Self::NotYetValid(from) => format!("{list} is valid only from {} on", text(from)),
            Self::NoEnd => format!("{list} does not say until when it is valid"),
            Self::Expired(until) => format!("{list} was valid until {}", text(until)),
            Self::SomeReasons => {
                format!("{list} cannot be used: it is a partitioned list, only about some reasons, without the others")
            }
        }
    }

    /// The one to tell of two lists.
    pub(super) fn or_nearer(self, other: Self) -> Self {
        if other.rank() > self.rank() { other } else { self }
    }

    fn rank(&self) -> u8 {
        match self {
            Self::Missing => 0,
            Self::NotSigned => 1,
            Self::CannotSay(_) => 2,
            Self::AnotherKey(_) => 3,
            Self::MayNotSign => 4,
            Self::TooWeak(_) => 5,
            Self::Unusable(_) => 6,
            Self::OutOfScope(_) => 7,
            Self::NotYetValid(_) => 8,
            Self::NoEnd => 9,
            Self::Expired(_) => 10,
            Self::SomeReasons => 11,
        }
    }
}
