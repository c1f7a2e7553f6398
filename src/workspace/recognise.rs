//! What a file that somebody hands over is, by its content.

use std::path::Path;

use serde_json::Value;

use super::{ConnectionList, MAX_CONNECTION_LIST_BYTES, read_import_file};
use crate::model::activation::{self, MAX_ACTIVATION_FILE_BYTES};
use crate::model::{ErrorCode, Problem};
use crate::pki::{self, PkiKind};
use crate::protocol::{EXPORT_FORMAT, MAX_EXPORT_BYTES};

/// No file this program reads is larger; revocation lists of large authorities come closest.
pub const MAX_RECOGNISED_BYTES: usize = 8 * 1024 * 1024;

/// Everything the configurator can read. Whether it is good shows when it is read.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Recognised {
    /// Keys of many controllers (manual appendix A).
    Activation,
    /// Controllers to register (manual 2.5.3).
    ConnectionList,
    /// Settings of one controller (manual 2.6.4).
    SettingsExport,
    Pki(PkiKind),
}

/// What the bytes are. The name of the file is not asked for.
pub fn recognise(bytes: &[u8]) -> Option<Recognised> {
    let text = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let first_line = text.split(|byte| matches!(byte, b'\n' | b'\r')).next().unwrap_or_default().trim_ascii();
    // A file of another version is one as well: what is wrong with it is for its reader to say.
    if first_line.starts_with(ACTIVATION) && bytes.len() <= MAX_ACTIVATION_FILE_BYTES {
        return Some(Recognised::Activation);
    }
    if first_line.len() < MAX_COLUMNS_BYTES
        && ConnectionList::parse(first_line).is_ok()
        && bytes.len() <= MAX_CONNECTION_LIST_BYTES
    {
        return Some(Recognised::ConnectionList);
    }
    if is_export(text) {
        return Some(Recognised::SettingsExport);
    }
    pki::recognise(bytes).map(Recognised::Pki)
}

/// Reads a file of at most [`MAX_RECOGNISED_BYTES`] and says what it is. Blocks.
pub fn recognise_file(path: &Path) -> Result<Recognised, Problem> {
    let bytes = read_import_file(path, MAX_RECOGNISED_BYTES).map_err(|problem| match problem.code {
        ErrorCode::FileFormat => Problem { code: ErrorCode::FileTooLarge, ..problem },
        ErrorCode::FileNotFound => Problem { code: ErrorCode::FileUnreadable, ..problem },
        _ => problem,
    })?;
    recognise(&bytes).ok_or_else(|| Problem::with_detail(ErrorCode::FileNotRecognised, path.display()))
}

fn is_export(text: &[u8]) -> bool {
    text.len() <= MAX_EXPORT_BYTES
        && text.trim_ascii_start().starts_with(b"{")
        && serde_json::from_slice::<Value>(text).is_ok_and(|json| json.get("format") == Some(&EXPORT_FORMAT.into()))
}

/// What the first line says before the version.
const ACTIVATION: &[u8] = activation::FIRST_LINE_START.as_bytes();
/// The first line of a connection list is not longer.
const MAX_COLUMNS_BYTES: usize = 200;
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_is_recognised_by_its_content() {
        let certificate = "-----BEGIN CERTIFICATE-----\nMA==\n-----END CERTIFICATE-----\n";
        for (text, kind) in [
            ("OPCUA.Activation.Ver.1.0\r\nSN1,a,b\r\n", Recognised::Activation),
            ("\u{feff}OPCUA.Activation.Ver.9.0\n", Recognised::Activation),
            ("Name,Type,Address\nweld,Ethernet,10.0.0.1\n", Recognised::ConnectionList),
            ("\u{feff}name, type, address", Recognised::ConnectionList),
            ("{\"format\": \"opcua-controller-settings\", \"version\": 7}", Recognised::SettingsExport),
            (certificate, Recognised::Pki(PkiKind::Certificate)),
        ] {
            assert_eq!(recognise(text.as_bytes()), Some(kind), "{text}");
        }
        for text in ["", "{}", "{\"format\": \"x\"}", "[1]", "Name,Address\n", "hello", "\u{feff}"] {
            assert_eq!(recognise(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn a_file_that_cannot_be_used_is_told_apart() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.csv");
        let code = || recognise_file(&path).map_err(|problem| problem.code);
        assert_eq!(code(), Err(ErrorCode::FileUnreadable), "it is not there");
        std::fs::write(&path, "hello").unwrap();
        assert_eq!(code(), Err(ErrorCode::FileNotRecognised));
        std::fs::write(&path, vec![b'x'; MAX_RECOGNISED_BYTES + 1]).unwrap();
        assert_eq!(code(), Err(ErrorCode::FileTooLarge));
        std::fs::write(&path, "Name,Type,Address\n").unwrap();
        assert_eq!(code(), Ok(Recognised::ConnectionList));
        assert_eq!(recognise_file(folder.path()).unwrap_err().code, ErrorCode::FileUnreadable, "a folder");
    }
}
