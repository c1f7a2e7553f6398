//! Stories about whole controllers, told over their management protocol.

mod certificates;
mod changes;
mod http;
mod keys_log_and_settings;
mod many_connections;
mod persistence;
mod remote;
mod sessions;
mod starting;
mod starvation;
mod test_controller;
mod trust;
mod whole_or_nothing;

pub(super) use test_controller::cell_handle;
