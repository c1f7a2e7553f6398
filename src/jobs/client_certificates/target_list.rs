/// The list of a controller that a certificate or CRL of a file goes into.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum TargetList {
    Trusted,
    Issuers,
    Crls,
}
