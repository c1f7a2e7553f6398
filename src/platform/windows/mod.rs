//! Calls of Windows that the standard library does not offer.

pub mod access;
pub mod holders;
pub mod protect;
pub mod session_end;

use std::ffi::OsStr;
use std::io;
use std::os::windows::ffi::OsStrExt as _;
use std::path::Path;

/// A text as Windows wants it: UTF-16 with a zero at the end. The part after a zero inside is cut off by Windows.
pub(super) fn wide(text: impl AsRef<OsStr>) -> Vec<u16> {
    text.as_ref().encode_wide().chain([0]).collect()
}

/// A path as Windows wants it, absolute and in the form that may be longer than 260 characters.
fn wide_path(path: &Path) -> io::Result<Vec<u16>> {
    const SEPARATOR: u16 = b'\\' as u16;
    const QUESTION_MARK: u16 = b'?' as u16;
    const DOT: u16 = b'.' as u16;
    let path = std::path::absolute(path)?;
    let units: Vec<u16> = path.as_os_str().encode_wide().collect();
    if units.contains(&0) {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "the path has a zero character"));
    }
    let (prefix, rest) = match &*units {
        // A device or a path that is long already.
        [SEPARATOR, SEPARATOR, QUESTION_MARK | DOT, SEPARATOR, ..] => ("", &*units),
        [SEPARATOR, SEPARATOR, share @ ..] => (r"\\?\UNC\", share),
        local => (r"\\?\", local),
    };
    Ok(prefix.encode_utf16().chain(rest.iter().copied()).chain([0]).collect())
}

/// The result of a call that returns 0 on failure.
fn succeeded(result: i32) -> io::Result<()> {
    if result == 0 { Err(io::Error::last_os_error()) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_get_the_form_that_may_be_long() {
        let long = |path: &str| {
            let units = wide_path(Path::new(path)).unwrap();
            String::from_utf16(units.strip_suffix(&[0]).unwrap()).unwrap()
        };
        assert_eq!(long(r"C:/a\..\空 间"), r"\\?\C:\空 间");
        assert_eq!(long(r"\\server\share\a"), r"\\?\UNC\server\share\a");
        assert_eq!(long(r"\\?\C:\a"), r"\\?\C:\a");
        assert!(wide_path(Path::new("a\0b")).is_err());
    }
}
