//! Operations on virtual controllers of this process, over loopback, without a window.

mod activation;
mod backup;
mod client_certificates;
mod confirmations;
mod lost_answers;
mod opcua_session;
mod runner;
mod server_certificates;
mod server_log;
mod settings_transfer;
mod verify;
mod wrong_hosts;
