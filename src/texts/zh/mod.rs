//! Chinese.

pub mod authority;
pub mod certificates;
pub mod cli;
pub mod countries;
pub mod errors;
pub mod files;
pub mod help;
pub mod keys;
pub mod revocation_lists;
pub mod sentences;
pub mod trust;
pub mod vault;
pub mod verify;

use crate::model::Language;

const LANGUAGE: Language = Language::Zh;
