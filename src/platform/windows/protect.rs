//! Encrypts for this Windows account (Data Protection API): only programs of the same account on the same PC decrypt.

use std::io;
use std::ptr::{null, null_mut};
use std::slice;

use windows_sys::Win32::Foundation::LocalFree;
use windows_sys::Win32::Security::Cryptography::{
    CRYPT_INTEGER_BLOB, CRYPTPROTECT_UI_FORBIDDEN, CryptProtectData, CryptUnprotectData,
};
use zeroize::{Zeroize as _, Zeroizing};

use super::succeeded;

/// Encrypts under a key of this account.
pub fn protect(secret: &[u8]) -> io::Result<Vec<u8>> {
    let (input, mut output) = (blob(secret)?, CRYPT_INTEGER_BLOB::default());
    // SAFETY: the input is only read, and outlives the call; the output is taken over by `take`.
    unsafe {
        succeeded(CryptProtectData(
            &raw const input,
            null(),
            null(),
            null(),
            null(),
            CRYPTPROTECT_UI_FORBIDDEN,
            &raw mut output,
        ))?;
        Ok(take(output).to_vec())
    }
}

/// Decrypts what [`protect`] made; fails for bytes that were changed or come from another account or PC.
pub fn unprotect(protected: &[u8]) -> io::Result<Zeroizing<Vec<u8>>> {
    let (input, mut output) = (blob(protected)?, CRYPT_INTEGER_BLOB::default());
    // SAFETY: as in `protect`.
    unsafe {
        succeeded(CryptUnprotectData(
            &raw const input,
            null_mut(),
            null(),
            null(),
            null(),
            CRYPTPROTECT_UI_FORBIDDEN,
            &raw mut output,
        ))?;
        Ok(take(output))
    }
}

fn blob(bytes: &[u8]) -> io::Result<CRYPT_INTEGER_BLOB> {
    let length = u32::try_from(bytes.len()).map_err(|_| io::ErrorKind::FileTooLarge)?;
    Ok(CRYPT_INTEGER_BLOB { cbData: length, pbData: bytes.as_ptr().cast_mut() })
}

/// Copies an output of Windows, then wipes and frees it.
///
/// # Safety
/// `output` was filled by a call that allocates it with `LocalAlloc`.
unsafe fn take(output: CRYPT_INTEGER_BLOB) -> Zeroizing<Vec<u8>> {
    // SAFETY: Windows allocated as many bytes as it says; freed once, and not used after.
    unsafe {
        let bytes = slice::from_raw_parts_mut(output.pbData, output.cbData as usize);
        let copy = Zeroizing::new(bytes.to_vec());
        bytes.zeroize();
        LocalFree(output.pbData.cast());
        copy
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_was_protected_is_decrypted() {
        let protected = protect(b"a private key").unwrap();
        assert!(!protected.windows(7).any(|part| part == b"private"));
        assert_eq!(*unprotect(&protected).unwrap(), b"a private key");
        assert!(unprotect(b"a private key").is_err());
        assert!(unprotect(&protected[..protected.len() / 2]).is_err());
    }
}
