//! Chinese.

pub mod authority;
pub mod certificates;
pub mod cli;
pub mod common;
pub mod controllers;
pub mod countries;
pub mod errors;
pub mod files;
pub mod fins;
pub mod help;
pub mod live;
pub mod recorder;
pub mod remote;
pub mod remote_control;
pub mod revocation_lists;
pub mod sentences;
pub mod server;
pub mod server_certificates;
pub mod signatures;
pub mod trust;
pub mod vault;
pub mod verify;
pub mod window;

use crate::model::Language;

const LANGUAGE: Language = Language::Zh;
