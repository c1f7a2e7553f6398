//! The help of the command line in English is that of clap, with the doc comments of the arguments.

use crate::texts::HelpTexts;

pub const fn texts() -> Option<HelpTexts> {
    None
}
