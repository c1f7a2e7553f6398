//! The program itself, started as a process, as from a shell.

mod activation;
mod admission;
mod backup;
mod certificate_authority;
mod client_certificates;
mod connection_list;
mod fins;
mod lying_controller;
mod main_job;
mod odd_paths;
mod pki;
mod record;
mod remote;
mod remote_answers;
mod server_settings;
mod terminal;
mod vault;
mod verify;
mod virtual_controllers;
