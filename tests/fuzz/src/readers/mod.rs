//! What every reader of bytes from outside has to hold for all bytes: one function a reader.
//!
//! The fuzzer calls one of [`TARGETS`] with bytes of its own making; the test `fuzz_seeds` of the main package, which
//! compiles this very file, calls all of them with the seeds of `corpus/` and damaged copies of them.

mod certificates;
mod controller_state;
mod describe;
mod fins;
mod keys;
mod lists;
mod messages;
mod names;
mod recordings;
mod records;
mod remote;
mod trust;
mod workspace;

pub use certificates::{certificate, certificate_request};
pub use controller_state::controller_state;
pub use describe::description;
pub use fins::{fins_message, fins_stream, fins_text};
pub use keys::{key_and_certificate, pkcs12, private_key};
pub use lists::{activation_file, connection_list};
pub use messages::{management_message, settings_export};
pub use names::names;
pub use recordings::{recording_csv, recording_packets, recording_sidecar};
pub use records::{force_packet, motion_packet};
pub use remote::{remote_answer, remote_request};
pub use trust::{bundle, revocation_list, trust};
pub use workspace::configuration;

/// Panics if the reader does what it must not.
pub type Target = fn(&[u8]);

/// Every target, by the name of its fuzz target and of its folder in `corpus/`.
pub const TARGETS: &[(&str, Target)] = &[
    ("activation_file", activation_file),
    ("bundle", bundle),
    ("certificate", certificate),
    ("certificate_request", certificate_request),
    ("configuration", configuration),
    ("connection_list", connection_list),
    ("controller_state", controller_state),
    ("description", description),
    ("fins_message", fins_message),
    ("fins_stream", fins_stream),
    ("fins_text", fins_text),
    ("force_packet", force_packet),
    ("key_and_certificate", key_and_certificate),
    ("management_message", management_message),
    ("motion_packet", motion_packet),
    ("names", names),
    ("pkcs12", pkcs12),
    ("private_key", private_key),
    ("recording_csv", recording_csv),
    ("recording_packets", recording_packets),
    ("recording_sidecar", recording_sidecar),
    ("remote_answer", remote_answer),
    ("remote_request", remote_request),
    ("revocation_list", revocation_list),
    ("settings_export", settings_export),
    ("trust", trust),
];

/// What the encrypted seeds are encrypted with.
pub const PASSWORD: &str = "fuzz";

/// Text from a file or a peer ends up in lists, logs and terminals, and must not command them.
fn assert_printable(text: &str) {
    assert!(!text.chars().any(char::is_control), "{text:?}");
}
