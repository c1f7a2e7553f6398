use super::{Certificate, Crl, PkiError};

/// The largest file that is read.
pub const MAX_BUNDLE_BYTES: usize = 4 * 1024 * 1024;

/// What a file with public trust material holds.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Bundle {
    pub certificates: Vec<Certificate>,
    pub crls: Vec<Crl>,
}

pub fn read_bundle(bytes: &[u8]) -> Result<Bundle, PkiError> {
    match Crl::from_der(bytes) {
        Ok(crl) => Ok(Bundle { certificates: Vec::new(), crls: vec![crl] }),
        Err(_) => Ok(Bundle { certificates: vec![Certificate::from_any(bytes)?], crls: Vec::new() }),
    }
}
