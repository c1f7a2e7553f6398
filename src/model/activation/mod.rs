//! Activation of legacy controllers: the two keys of a licence, the activation file, and what it means for the
//! controllers that are ticked (manual 2.6.3, appendix A).
//!
//! | file | contents |
//! |---|---|
//! | `keys` | [`LicenceKey`] and [`ActivationKey`]: text from a mail or a sheet becomes a key, or says what is wrong |
//! | `file` | [`ActivationFile`]: bytes become lines, each mistake with its line number |
//! | `plan` | [`ActivationPlan`]: which controller gets which line, before anything is sent |

mod file;
mod keys;
mod plan;

pub use file::{
    ActivationEntry, ActivationFile, ActivationFileError, ActivationLine, ActivationMistake, FIRST_LINE, LineMistake,
    MAX_ACTIVATION_FILE_BYTES, begins, parse,
};
pub use keys::{ActivationKey, ActivationKeys, KeyError, LicenceKey};
pub use plan::{ActivationDecision, ActivationPlan, PlannedActivation, plan};
