use crate::model::SpelType;

/// A backup variable, declared by `Global Preserve` (manual 4.2.1): a scalar, or an array of one to three dimensions.
///
/// Remote commands reach every backup variable. The address space shows the scalars whose names begin with
/// [`SPEL_PREFIX`].
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct SpelDeclaration {
    /// The name. SPEL+ compares names without case.
    pub name: String,
    /// The declared type.
    pub kind: SpelType,
    /// The highest element number of each dimension of an array; empty for a scalar. Elements are counted from 0 (RC+ User's
    /// Guide, "Arrays").
    pub bounds: Vec<u16>,
}

/// What the names of the variables begin with that the address space shows (manual 4.2.1). Compared without case.
pub const SPEL_PREFIX: &str = "OPCUA_";

/// The most variables that the address space shows (manual 4.2.1).
pub const MAX_SPEL_VARIABLES: usize = 256;

/// The most dimensions of an array.
pub const MAX_DIMENSIONS: usize = 3;

/// The most elements of a backup array: of any type but String, and of String (RC+ User's Guide, "Arrays").
const MAX_ELEMENTS: usize = 4000;
const MAX_STRING_ELEMENTS: usize = 400;

impl SpelDeclaration {
    /// A variable that is no array.
    pub fn scalar(name: impl Into<String>, kind: SpelType) -> Self {
        Self { name: name.into(), kind, bounds: Vec::new() }
    }

    /// Whether the address space may show the variable: it is a scalar, and its name has the prefix.
    pub fn is_shown(&self) -> bool {
        self.bounds.is_empty() && has_prefix(&self.name)
    }

    /// How many values the variable has: 1 for a scalar.
    pub fn elements(&self) -> usize {
        self.bounds.iter().map(|bound| usize::from(*bound) + 1).product()
    }

    /// Whether an array has at most three dimensions, and no more elements than SPEL+ allows a backup variable.
    pub fn is_within_limits(&self) -> bool {
        let most = if self.kind == SpelType::String { MAX_STRING_ELEMENTS } else { MAX_ELEMENTS };
        self.bounds.len() <= MAX_DIMENSIONS && self.elements() <= most
    }

    /// The place of an element: the last dimension counts fastest. `None` unless there is one number for each dimension, and
    /// none of them beyond its bound.
    pub fn place(&self, element: &[u16]) -> Option<usize> {
        if element.len() != self.bounds.len() || element.iter().zip(&self.bounds).any(|(at, bound)| at > bound) {
            return None;
        }
        let counted = element.iter().zip(&self.bounds);
        Some(counted.fold(0, |place, (at, bound)| place * (usize::from(*bound) + 1) + usize::from(*at)))
    }
}

/// Whether a name begins with [`SPEL_PREFIX`].
pub(super) fn has_prefix(name: &str) -> bool {
    name.get(..SPEL_PREFIX.len()).is_some_and(|prefix| prefix.eq_ignore_ascii_case(SPEL_PREFIX))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn array(kind: SpelType, bounds: &[u16]) -> SpelDeclaration {
        SpelDeclaration { bounds: bounds.to_vec(), ..SpelDeclaration::scalar("g_array", kind) }
    }

    #[test]
    fn the_last_dimension_counts_fastest() {
        let three = array(SpelType::Integer, &[10, 10, 10]);
        assert_eq!(three.elements(), 1331);
        assert_eq!(three.place(&[0, 0, 0]), Some(0));
        assert_eq!(three.place(&[3, 5, 0]), Some(3 * 121 + 5 * 11));
        assert_eq!(three.place(&[10, 10, 10]), Some(1330));
        for wrong in [&[3, 5][..], &[], &[0, 11, 0], &[0, 0, 0, 0]] {
            assert_eq!(three.place(wrong), None, "{wrong:?}");
        }
        let scalar = SpelDeclaration::scalar("g_Status", SpelType::Integer);
        assert_eq!((scalar.place(&[]), scalar.place(&[0]), scalar.elements()), (Some(0), None, 1));
    }

    #[test]
    fn scalars_with_the_prefix_are_shown() {
        assert!(SpelDeclaration::scalar("opcua_A", SpelType::Byte).is_shown());
        assert!(!SpelDeclaration::scalar("g_A", SpelType::Byte).is_shown());
        assert!(!SpelDeclaration::scalar("OPCU", SpelType::Byte).is_shown());
        let listed = SpelDeclaration { name: "OPCUA_List".to_owned(), ..array(SpelType::Byte, &[3]) };
        assert!(!listed.is_shown());
    }

    #[test]
    fn arrays_have_the_limits_of_backup_variables() {
        assert!(array(SpelType::Long, &[3999]).is_within_limits());
        assert!(!array(SpelType::Long, &[4000]).is_within_limits());
        assert!(array(SpelType::String, &[19, 19]).is_within_limits());
        assert!(!array(SpelType::String, &[20, 19]).is_within_limits());
        assert!(!array(SpelType::Byte, &[1, 1, 1, 1]).is_within_limits());
        assert!(!array(SpelType::Byte, &[u16::MAX, u16::MAX, u16::MAX]).is_within_limits());
    }
}
