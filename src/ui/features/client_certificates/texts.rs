use super::{ChainState, LastTrustChange, PaneKind, TrustColumn};
use crate::model::Language;
use crate::texts::{self, TextKey as T};

impl PaneKind {
    pub const fn title(self) -> T {
        match self {
            Self::Trusted => T::TrustTrusted,
            Self::Rejected => T::TrustRejected,
            Self::Issuers => T::TrustIssuers,
            Self::Crls => T::TrustCrls,
        }
    }

    /// What to do when the list is empty.
    pub const fn empty_text(self) -> T {
        match self {
            Self::Trusted => T::TrustTrustedEmpty,
            Self::Rejected => T::TrustRejectedEmpty,
            Self::Issuers => T::TrustIssuersEmpty,
            Self::Crls => T::CrlEmpty,
        }
    }
}

impl TrustColumn {
    pub const fn heading(self) -> T {
        match self {
            Self::IssuedTo => T::TrustIssuedTo,
            Self::IssuedBy => T::TrustIssuedBy,
            Self::FileName => T::TrustFileName,
            Self::SerialNumber => T::ColumnSerial,
            Self::ValidFrom => T::TrustValidFrom,
            Self::ValidUntil => T::TrustValidUntil,
            Self::Thumbprint => T::TrustThumbprint,
            Self::Reason => T::TrustReason,
            Self::Address => T::TrustAddress,
            Self::Count => T::TrustCount,
            Self::FirstSeen => T::TrustFirstSeen,
            Self::LastSeen => T::TrustLastSeen,
            Self::Issuer => T::CrlIssuer,
            Self::ThisUpdate => T::CrlThisUpdate,
            Self::NextUpdate => T::CrlNextUpdate,
            Self::Entries => T::CrlEntries,
            Self::Number => T::CrlNumber,
            Self::Health => T::CrlHealth,
        }
    }
}

impl ChainState {
    pub const fn text_key(self) -> T {
        match self {
            Self::Missing => T::TrustChainMissing,
            Self::Revoked => T::TrustChainRevoked,
            Self::Expired => T::TrustChainExpired,
            Self::NotYetValid => T::TrustNotYetValid,
            Self::NotAnAuthority => T::TrustChainNotCa,
            Self::WithoutCrl => T::TrustChainNoCrl,
            Self::OnlySent => T::TrustChainSent,
        }
    }
}

impl LastTrustChange {
    /// What was done last.
    pub fn text(&self, language: Language) -> String {
        match self {
            Self::Added(count) => texts::trust_added(language, *count),
            Self::Deleted { from: PaneKind::Crls, count } => texts::crls_deleted(language, *count),
            Self::Deleted { from, count } => texts::certificates_deleted(language, from.title(), *count),
            Self::Moved { from, to, count } => texts::certificates_moved(language, from.title(), to.title(), *count),
            Self::TakenBack => T::TrustTakenBack.text(language).to_owned(),
        }
    }
}
