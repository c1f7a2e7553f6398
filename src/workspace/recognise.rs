//! Recognises files by their content.

use std::path::{Path, PathBuf};

use serde_json::Value;
use thiserror::Error;

use super::{ConnectionList, FileError, MAX_CONNECTION_LIST_BYTES, read_head, read_import_file};
use crate::model::activation::{self, MAX_ACTIVATION_FILE_BYTES};
use crate::model::text;
use crate::pki::{self, PkiKind};
use crate::protocol::{EXPORT_FORMAT, MAX_EXPORT_BYTES};
use crate::records;

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
    /// Data of the force sensor or the motion log (manual 4.1, 4.3): packets, CSV or Parquet.
    Recording,
    /// Certificates, CRLs, a signing request or a key.
    Pki(PkiKind),
}

/// What the bytes are. The name of the file is not asked for.
pub fn recognise(bytes: &[u8]) -> Option<Recognised> {
    if let Ok(text) = text::decode(bytes) {
        // What is wrong with a file is for its reader to say.
        let head = &text[..text.floor_char_boundary(MAX_HEAD_BYTES)];
        if activation::begins(head) && bytes.len() <= MAX_ACTIVATION_FILE_BYTES {
            return Some(Recognised::Activation);
        }
        if ConnectionList::begins(head) && bytes.len() <= MAX_CONNECTION_LIST_BYTES {
            return Some(Recognised::ConnectionList);
        }
        if is_export(&text) {
            return Some(Recognised::SettingsExport);
        }
    }
    pki::recognise(bytes).map(Recognised::Pki)
}

/// Why a file is not recognised.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum RecogniseError {
    /// The file cannot be read, or is larger than [`MAX_RECOGNISED_BYTES`].
    #[error(transparent)]
    File(#[from] FileError),
    /// The content is nothing that this program reads.
    #[error("{}", .0.display())]
    Unknown(PathBuf),
}

/// Reads a file of at most [`MAX_RECOGNISED_BYTES`] and says what it is. A recording, which is known by its beginning, may
/// have any size. Blocks.
pub fn recognise_file(path: &Path) -> Result<Recognised, RecogniseError> {
    let head = read_head(path, RECORDING_HEAD_BYTES).map_err(|source| FileError::reading(path, source))?;
    if records::begins_recording(&head) {
        return Ok(Recognised::Recording);
    }
    let bytes = read_import_file(path, MAX_RECOGNISED_BYTES)?;
    recognise(&bytes).ok_or_else(|| RecogniseError::Unknown(path.to_owned()))
}

fn is_export(text: &str) -> bool {
    text.len() <= MAX_EXPORT_BYTES
        && text.trim_ascii_start().starts_with('{')
        && serde_json::from_str::<Value>(text).is_ok_and(|json| json.get("format") == Some(&EXPORT_FORMAT.into()))
}

/// By these it shows whether a file is a recording.
const RECORDING_HEAD_BYTES: u64 = 64;
/// The first line of a list, and what stands before it, is not longer.
const MAX_HEAD_BYTES: usize = 1024;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ErrorCode, Problem};

    #[test]
    fn every_kind_is_recognised_by_its_content() {
        let certificate = "-----BEGIN CERTIFICATE-----\nMA==\n-----END CERTIFICATE-----\n";
        for (text, kind) in [
            ("OPCUA.Activation.Ver.1.0\r\nSN1,a,b\r\n", Recognised::Activation),
            ("\u{feff}OPCUA.Activation.Ver.9.0\n", Recognised::Activation),
            ("Name,Type,Address\nweld,Ethernet,10.0.0.1\n", Recognised::ConnectionList),
            ("\u{feff}name, type, address", Recognised::ConnectionList),
            ("sep=;\r\n\"Type\";\"Address\";\"Name\"\r\n", Recognised::ConnectionList),
            ("\n\"OPCUA.Activation.Ver.1.0\",,\r\n", Recognised::Activation),
            ("{\"format\": \"opcua-controller-settings\", \"version\": 7}", Recognised::SettingsExport),
            (certificate, Recognised::Pki(PkiKind::Certificate)),
        ] {
            assert_eq!(recognise(text.as_bytes()), Some(kind), "{text}");
            let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
            assert_eq!(recognise(&wide), Some(kind), "{text} in UTF-16");
        }
        for text in ["", "{}", "{\"format\": \"x\"}", "[1]", "Name,Address\n", "hello", "\u{feff}"] {
            assert_eq!(recognise(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn a_file_that_cannot_be_used_is_told_apart() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("x.csv");
        let code = || recognise_file(&path).map_err(|error| Problem::from(error).code);
        assert_eq!(code(), Err(ErrorCode::FileUnreadable), "it is not there");
        std::fs::write(&path, "hello").unwrap();
        assert_eq!(code(), Err(ErrorCode::FileNotRecognised));
        std::fs::write(&path, vec![b'x'; MAX_RECOGNISED_BYTES + 1]).unwrap();
        assert_eq!(code(), Err(ErrorCode::FileTooLarge));
        let recording =
            [&b"OPCUACommonID,Count,ElapsedTime [ms],Fx [N]\r\n"[..], &[b'1'; MAX_RECOGNISED_BYTES]].concat();
        std::fs::write(&path, recording).unwrap();
        assert_eq!(code(), Ok(Recognised::Recording), "of any size");
        std::fs::write(&path, "Name,Type,Address\n").unwrap();
        assert_eq!(code(), Ok(Recognised::ConnectionList));
        assert_eq!(
            Problem::from(recognise_file(folder.path()).unwrap_err()).code,
            ErrorCode::FileUnreadable,
            "a folder"
        );
    }
}
