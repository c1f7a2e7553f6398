pub use crate::model::{SpelType, SpelValue};

/// A variable declared by `Global Preserve` (manual 4.2.1).
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct SpelDeclaration {
    /// The name; begins with [`SPEL_PREFIX`].
    pub name: String,
    /// The declared type.
    pub kind: SpelType,
}

/// What the names of the variables begin with that the address space shows (manual 4.2.1). Compared without case, as
/// SPEL+ compares names.
pub const SPEL_PREFIX: &str = "OPCUA_";

/// The most variables that the address space shows (manual 4.2.1).
pub const MAX_SPEL_VARIABLES: usize = 256;
