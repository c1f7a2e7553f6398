//! What an engineer does to many controllers at once.
//!
//! An [`Operation`] says what to do to one controller; [`run`] does it to many, side by side, reporting
//! [`JobEvent`]s. Window and command line build the same operations and read the same events.
//!
//! | file | operation |
//! |---|---|
//! | `get_info` | read everything a row shows |
//! | `server_control` | start and stop the OPC UA server |
//! | `settings` | read and change the basic settings |
//! | `users` | list, add, remove users |
//! | `self_signed` | make and install a self-signed certificate |
//! | `clients` | list and add trusted client certificates |
//! | `activate` | activate legacy controllers by their keys |
//! | `server_log` | read the server log |
//! | `settings_transfer` | export settings to the PC and import them again |
//! | `enroll` | meet a new controller: fingerprint, password, first information |

mod activate;
mod clients;
mod enroll;
mod get_info;
mod operation;
mod runner;
mod self_signed;
mod server_control;
mod server_log;
mod settings;
mod settings_transfer;
mod users;

pub use activate::{Activate, KeySource};
pub use clients::{AddClientCertificates, ClientCertificateFile, ListClients};
pub use enroll::{Enrolled, enroll, probe};
pub use get_info::GetInfo;
pub use operation::{Confirmation, Operation, Outcome, Run, Step};
pub use runner::{JobContext, JobController, JobEvent, Report, Summary, run};
pub use self_signed::{SelfSigned, SelfSignedFields};
pub use server_control::{StartServer, StopServer};
pub use server_log::{LogPart, ReadLog};
pub use settings::{ReadSettings, SetSettings, SettingsChange};
pub use settings_transfer::{ExportSettings, ImportSettings, MIN_PASSPHRASE_CHARS};
pub use users::{AddUser, ListUsers, RemoveUsers};
