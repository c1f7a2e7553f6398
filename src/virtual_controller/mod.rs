//! The bundled virtual controller.

mod api;
mod changes;
mod controller;
mod faults;
mod listener;
mod login;
mod new_controller;
pub mod opcua;
mod password;
mod secret_bytes;
mod state;
mod store;
mod tls;

pub use controller::{ControllerSpec, SwitchOnError, VirtualController};
pub use faults::{DropPoint, Faults, Switches};
pub use new_controller::{NewCertificate, NewController, USUAL_PORTS};
pub use password::hash_connection_password;
pub use secret_bytes::SecretBytes;
pub use state::{Identity, KeyPair, Listed, State, Surroundings, User};
pub use store::{Staged, Store, StoreError};
