/// The list of a controller that a certificate or CRL of a file goes into.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TargetList {
    /// The trusted list: clients, and CAs whose clients are accepted.
    Trusted,
    /// The issuers list: CAs that complete chains. Current firmware only.
    Issuers,
    /// The CRLs.
    Crls,
}
