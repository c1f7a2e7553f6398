//! The real window without a display, driven by labels, over virtual controllers.

mod activation;
mod backup;
mod certificate_authority;
mod client_certificates;
mod closing;
mod drop;
mod files;
mod live_values;
mod main_job;
mod recorder;
mod remote_control;
mod server_certificates;
mod settings_transfer;
mod start;
mod table;
mod vault;
mod verify;
