//! Stories about whole controllers, told over their management protocol.

mod bench;
mod certificates;
mod changes;
mod crowd;
mod http;
mod keys_log_and_settings;
mod persistence;
mod sessions;
mod starting;
mod starvation;
mod trust;
mod whole_or_nothing;
