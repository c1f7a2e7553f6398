//! The window as it looks, pixel by pixel, over a backend that only plays back what it is told.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test --test pictures` takes the pictures anew, all or those whose tests are named.

mod activation;
#[allow(dead_code, reason = "the stories need more of it")]
#[path = "../common/authority.rs"]
mod authority;
mod certificate_authority;
mod client_certificates;
mod drop;
#[path = "../common/harness.rs"]
mod harness;
mod live_values;
mod main_window;
mod pictures;
mod recorder;
mod remote_control;
#[path = "../common/samples.rs"]
mod samples;
mod server_certificates;
mod settings_transfer;
#[path = "../common/soft_renderer.rs"]
mod soft_renderer;
mod table;
mod trust_samples;
mod vault;
mod verify;
