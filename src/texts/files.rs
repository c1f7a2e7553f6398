//! What files are, and what is wrong with their lines.

use std::path::Path;

use super::TextKey as T;
use crate::model::activation::{KeyError, LineMistake};
use crate::pki::PkiKind;
use crate::workspace::{Recognised, SkippedLine};

/// What a file is, by its content.
pub const fn recognised(kind: Recognised) -> T {
    match kind {
        Recognised::Activation => T::KindActivation,
        Recognised::ConnectionList => T::KindConnectionList,
        Recognised::SettingsExport => T::KindSettingsExport,
        Recognised::Recording => T::KindRecording,
        Recognised::Pki(PkiKind::Certificate) => T::KindCertificate,
        Recognised::Pki(PkiKind::Chain) => T::KindChain,
        Recognised::Pki(PkiKind::Bundle) => T::KindBundle,
        Recognised::Pki(PkiKind::Crl) => T::DropCrl,
        Recognised::Pki(PkiKind::Csr) => T::KindCsr,
        Recognised::Pki(PkiKind::Key) => T::KindKey,
        Recognised::Pki(PkiKind::KeyAndCertificate) => T::KindKeyAndCertificate,
        Recognised::Pki(PkiKind::Pkcs12) => T::KindPkcs12,
    }
}

in_every_language! {
    files:
    /// A file of a controller that had to make room for a new one.
    fn moved_aside(name: &str, file: &Path) -> String;
    /// The number of a line, counted from 1.
    fn line(line: impl std::fmt::Display) -> String;
    /// What is wrong with a licence or activation key.
    fn key_error(error: KeyError) -> String;
    /// Under a key that is being typed.
    fn key_progress(found: usize, expected: usize) -> String;
    /// For how many of the ticked controllers the file has keys.
    fn keys_found(ready: usize, all: usize) -> String;
    /// What is wrong with a line of an activation file.
    fn line_mistake(mistake: &LineMistake) -> String;
    /// The tick box over the lines that can be imported.
    fn to_import(ticked: usize, all: usize) -> String;
    /// How many controllers were imported.
    fn imported(count: usize) -> String;
    /// Why a line of a connection list is left out.
    fn skipped(why: &SkippedLine) -> String;
    /// Over files that are held over the window.
    fn drop_title(count: usize) -> String;
    /// The dialog that opens when the files are dropped.
    fn drop_opens(dialog: &str) -> String;
    /// Where a file would go, and why it cannot.
    fn drop_disabled(dialog: &str, why: &str) -> String;
    /// How many further files there are.
    fn more(count: usize) -> String;
    /// Which of several files a dialog takes.
    fn only_these(names: &[String]) -> String;
}
