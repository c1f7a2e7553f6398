//! Reads a password or passphrase from a file or from standard input.

use std::borrow::Cow;
use std::fmt::Display;
use std::io::{self, Read as _};
use std::path::Path;

use secrecy::SecretString;
use zeroize::Zeroizing;

use crate::model::{ErrorCode, Problem, text};

/// The longest password, in bytes of UTF-8. A larger file is a wrong one.
const MAX_PASSWORD_BYTES: usize = 1024;
/// That many bytes in UTF-16, with a byte order mark and a line end.
const MAX_FILE_BYTES: usize = 2 * MAX_PASSWORD_BYTES + 8;

/// Reads a secret from a file, or from standard input for `-`.
///
/// The text may be UTF-8 or UTF-16, see [`text::decode`]. One line end at the end is dropped, and nothing else: blanks
/// are part of the secret. Everything that was read is wiped. Errors: [`ErrorCode::FileUnreadable`], and
/// [`ErrorCode::FileFormat`] for what is too long, has several lines, or is no text.
pub fn read_secret(path: &Path) -> Result<SecretString, Problem> {
    if path == Path::new("-") {
        read(io::stdin().lock()).map_err(|error| error.of("standard input"))
    } else {
        let open = std::fs::File::open(path).map_err(SecretError::Unreadable);
        open.and_then(read).map_err(|error| error.of(path.display()))
    }
}

/// Why there is no secret in a file. Quotes nothing of it.
#[derive(Debug, thiserror::Error)]
enum SecretError {
    #[error(transparent)]
    Unreadable(#[from] io::Error),
    #[error(transparent)]
    Text(#[from] text::TextError),
    #[error("more than {MAX_PASSWORD_BYTES} bytes are too long for a password")]
    TooLong,
    #[error("it has several lines; a password is one line")]
    SeveralLines,
}

impl SecretError {
    fn of(self, source: impl Display) -> Problem {
        let code = match self {
            Self::Unreadable(_) => ErrorCode::FileUnreadable,
            Self::Text(_) | Self::TooLong | Self::SeveralLines => ErrorCode::FileFormat,
        };
        Problem::with_detail(code, format!("{source}: {self}"))
    }
}

fn read(source: impl io::Read) -> Result<SecretString, SecretError> {
    // Never grows, so that nothing is left behind in memory that was given back.
    let mut bytes = Zeroizing::new(Vec::with_capacity(MAX_FILE_BYTES + 1));
    source.take(MAX_FILE_BYTES as u64 + 1).read_to_end(&mut bytes)?;
    if bytes.len() > MAX_FILE_BYTES {
        return Err(SecretError::TooLong);
    }
    match text::decode(&bytes)? {
        Cow::Borrowed(text) => secret(text),
        Cow::Owned(text) => secret(&Zeroizing::new(text)),
    }
}

fn secret(text: &str) -> Result<SecretString, SecretError> {
    let line = ["\r\n", "\n", "\r"].iter().find_map(|end| text.strip_suffix(end)).unwrap_or(text);
    if line.contains(['\r', '\n']) {
        return Err(SecretError::SeveralLines);
    }
    if line.len() > MAX_PASSWORD_BYTES {
        return Err(SecretError::TooLong);
    }
    Ok(SecretString::from(line))
}

#[cfg(test)]
mod tests {
    use secrecy::ExposeSecret as _;

    use super::*;

    fn of(bytes: &[u8]) -> Result<String, String> {
        match read(bytes) {
            Ok(secret) => Ok(secret.expose_secret().to_owned()),
            Err(error) => Err(error.of("pass").to_string()),
        }
    }

    /// Case 04: what PowerShell 5.1 and Notepad write.
    #[test]
    fn a_byte_order_mark_is_not_part_of_a_secret() {
        let case = |name: &str| {
            let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/04-secret-files");
            read_secret(&folder.join(name)).map(|secret| secret.expose_secret().to_owned())
        };
        for name in ["pass", "pass-bom", "pass-utf16"] {
            assert_eq!(case(name), Ok("secret".to_owned()), "{name}");
        }
        assert_eq!(case("none").unwrap_err().code, ErrorCode::FileUnreadable);
        assert_eq!(of(b"\xfe\xff\0g\0e\0h\xd8\x3e\xdd\x16"), Ok("geh🤖".to_owned()));
    }

    #[test]
    fn one_line_end_is_dropped_and_nothing_else() {
        for (bytes, secret) in [
            (&b"secret\n"[..], "secret"),
            (b"secret\r\n", "secret"),
            (b"secret\r", "secret"),
            (b"secret", "secret"),
            (b" secret \t\n", " secret \t"),
            (b"\xef\xbb\xbf\n", ""),
            (b"", ""),
        ] {
            assert_eq!(of(bytes).as_deref(), Ok(secret), "{bytes:?}");
        }
    }

    #[test]
    fn a_file_that_is_no_password_says_why() {
        for (bytes, why) in [
            (b"two\nlines\n".to_vec(), "several lines"),
            (b"secret\n\n".to_vec(), "several lines"),
            (b"M\xfcller".to_vec(), "line 1 is not UTF-8 text"),
            (b"\xff\xfe\0\0s\0\0\0".to_vec(), "UTF-32"),
            (vec![b'x'; MAX_PASSWORD_BYTES + 1], "too long"),
            (vec![b'x'; MAX_FILE_BYTES + 1], "too long"),
        ] {
            let told = of(&bytes).unwrap_err();
            assert!(told.contains("pass: ") && told.contains(why), "{told}");
        }
        assert!(of(&[b'x'; MAX_PASSWORD_BYTES]).is_ok());
        assert!(
            of(&"x".repeat(MAX_PASSWORD_BYTES).encode_utf16().flat_map(u16::to_le_bytes).collect::<Vec<_>>()).is_ok()
        );
    }
}
