//! As much of the virtual controller as reads files.

#[path = "../../../src/virtual_controller/faults.rs"]
mod faults;
#[path = "../../../src/virtual_controller/secret_bytes.rs"]
mod secret_bytes;
#[path = "../../../src/virtual_controller/state.rs"]
mod state;
#[path = "../../../src/virtual_controller/store.rs"]
mod store;

pub use faults::Faults;
pub use state::{ControllerState, OperatingContext};
pub use store::{Store, StoreError};
