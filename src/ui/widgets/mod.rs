//! Small things the views and dialogs are made of.

mod button;
mod chip;
mod dialog;
mod field;
mod file;
mod heading;
mod list;

pub use button::{command_button, command_item, primary, row_command_item};
pub use chip::{chip, word};
pub use dialog::{Buttons, dialog, note};
pub use field::{choices, form, labelled, mistake, path_field, path_line, secret_field, small_note, text_field};
pub use file::file_field;
pub use heading::{column_heading, sort_heading};
pub use list::{cell, list, list_title};
