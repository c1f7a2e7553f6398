//! What the tests share: virtual controllers, processes, the window, certificates of test authorities.

pub mod authority;
pub mod ca;
pub mod clients;
pub mod command_line_test;
pub mod harness;
pub mod https;
pub mod opcua_client;
pub mod process;
pub mod remote_peer;
pub mod samples;
pub mod soft_renderer;
pub mod test_fleet;
pub mod window;
pub mod window_test;
