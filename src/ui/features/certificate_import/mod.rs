//! What the imports of server certificates share: a certificate is looked at first ([`ImportSource`]), then what was found is
//! to be agreed to ([`ImportReview`]). The forms are features of their own: `import_ca_signed`, `user_specified`,
//! `restore_backup`.

mod review;
mod source;

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::jobs::CertificateChecked;
use crate::model::Problem;
use crate::ui::model::{BackendCommand, Dialog, Model, RowId};

pub use review::ImportReview;
pub use source::ImportSource;

/// The looking before an import.
#[derive(Debug, Default)]
pub struct ImportChecks {
    /// It is going on.
    pub running: bool,
    of: BTreeMap<RowId, Result<CertificateChecked, Problem>>,
}

/// A dialog that asks where certificates are.
pub trait ImportForm: Dialog {
    /// The controllers that get them.
    fn rows(&self) -> Vec<RowId>;

    /// What was found so far.
    fn checks(&mut self) -> &mut ImportChecks;
}

/// A path as people paste it: with blanks and quotes around it.
pub fn typed_path(text: &str) -> Option<PathBuf> {
    let path = text.trim().trim_matches('"');
    (!path.is_empty()).then(|| PathBuf::from(path))
}

impl Model {
    /// Looks at what `source` says, unless that is going on; `None`: something is missing in the form, which stays open.
    pub(in crate::ui) fn check_import<F: ImportForm>(
        &mut self,
        mut form: Box<F>,
        source: Option<ImportSource>,
    ) -> Vec<BackendCommand> {
        let source = source.filter(|_| !form.checks().running);
        form.checks().running |= source.is_some();
        let rows = form.rows();
        self.put_back(form);
        match source {
            Some(source) => {
                let task = source.check::<F>(&self.workspace);
                self.start(task, rows, None)
            }
            None => vec![],
        }
    }

    /// One controller's certificate was looked at, or could not be.
    fn checked<F: ImportForm>(
        &mut self,
        row: RowId,
        result: Result<CertificateChecked, Problem>,
    ) -> Vec<BackendCommand> {
        if let Some(form) = self.dialog::<F>() {
            form.checks().of.insert(row, result);
        }
        vec![]
    }

    /// All were.
    fn checks_ended<F: ImportForm>(&mut self, source: &ImportSource) -> Vec<BackendCommand> {
        self.job = None;
        let Some(form) = self.dialog::<F>() else { return vec![] };
        let rows = form.rows();
        form.checks().running = false;
        let mut of = std::mem::take(&mut form.checks().of);
        let found: Vec<_> = rows
            .iter()
            .filter_map(|row| {
                let name = self.rows.names(&[*row]).pop()?;
                Some((*row, name, of.remove(row)?))
            })
            .collect();
        match &found[..] {
            [] => {}
            [(_, _, Err(problem))] => {
                let problem = problem.clone();
                self.show_problem(problem);
            }
            _ => {
                let names = self.rows.names(&rows);
                self.open(ImportReview::new::<F>(source.clone(), names, found));
            }
        }
        vec![]
    }
}
