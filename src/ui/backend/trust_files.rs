//! Reading files with certificates and CRLs.

use std::path::PathBuf;

use crate::jobs::TrustFile;
use crate::model::{ErrorCode, Problem};
use crate::pki::{self, MAX_BUNDLE_BYTES};
use crate::ui::model::ReadTrustFile;
use crate::workspace;

/// Blocks.
pub fn read(path: PathBuf) -> ReadTrustFile {
    let result = workspace::read_import_file(&path, MAX_BUNDLE_BYTES).map_err(Problem::from).and_then(|bytes| {
        let bundle = pki::read_bundle(&bytes)
            .map_err(|e| Problem::with_detail(ErrorCode::BadCertificate, format!("{}: {e}", path.display())))?;
        let file_name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned();
        Ok(TrustFile { file_name, bundle })
    });
    // No import folder is meant here, and no file of one kind only.
    let result = result.map_err(|problem| match problem.code {
        ErrorCode::FileNotFound => Problem { code: ErrorCode::FileUnreadable, ..problem },
        ErrorCode::FileFormat => Problem { code: ErrorCode::BadCertificate, ..problem },
        _ => problem,
    });
    ReadTrustFile { path, result }
}
