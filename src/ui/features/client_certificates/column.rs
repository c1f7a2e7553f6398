/// A column of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TrustColumn {
    IssuedTo,
    IssuedBy,
    FileName,
    SerialNumber,
    ValidFrom,
    ValidUntil,
    Thumbprint,
    // of refused clients
    Reason,
    Address,
    Count,
    FirstSeen,
    LastSeen,
    // of CRLs
    Issuer,
    ThisUpdate,
    NextUpdate,
    Entries,
    Number,
    Health,
}
