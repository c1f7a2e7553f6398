use std::path::{Path, PathBuf};

/// What the packets of a recording are written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Comma-separated values: text, readable while it is written.
    Csv,
    /// Apache Parquet: columns, readable once it is finished.
    Parquet,
}

impl Format {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Csv, Self::Parquet];

    /// `csv` or `parquet`.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Parquet => "parquet",
        }
    }

    /// The format of a file with this extension, in upper or lower case.
    pub fn of(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        Self::ALL.into_iter().find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }
}

/// The sidecar of a file: `x.csv` → `x.csv.json`.
pub fn sidecar_path(file: &Path) -> PathBuf {
    with_suffix(file, ".json")
}

/// Where a file is until it is complete: `x.parquet` → `x.parquet.part`.
pub fn unfinished_path(file: &Path) -> PathBuf {
    with_suffix(file, ".part")
}

fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}
