use super::PkiError;

/// # Errors
/// [`PkiError::Empty`] for no bytes, [`PkiError::TooLarge`] for more than `max`.
pub(super) fn check_size(bytes: &[u8], max: usize) -> Result<(), PkiError> {
    match bytes.len() {
        0 => Err(PkiError::Empty),
        bytes if bytes > max => Err(PkiError::TooLarge { bytes, max }),
        _ => Ok(()),
    }
}
