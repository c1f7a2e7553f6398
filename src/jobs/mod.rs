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
//! | `overview` | settings and the length of the lists, for a look at one controller |
//! | `users` | list, add, remove users |
//! | `self_signed` | make and install a self-signed certificate |
//! | `create_csr` | make a key and its certificate signing request |
//! | `import_ca` | check and import what a CA issued for that |
//! | `sign_csrs` | have the small CA sign what controllers ask for, and import it |
//! | `push_authority` | give controllers the CRL and certificate of the small CA |
//! | `import_user` | check and import key and certificate made with another tool |
//! | `restore_certificate` | check and put back a backup of a key |
//! | `preflight` | what is looked at before such an import |
//! | `select_certificate` | list the server certificates held, select one |
//! | `export_self_signed` | save the self-signed certificate on the PC |
//! | `trust` | client certificate lists and CRLs: list, watch, add, move, remove, undo |
//! | `activate` | activate legacy controllers by their keys |
//! | `server_log` | read the server log, save it on the PC |
//! | `settings_transfer` | export settings to the PC and import them again |
//! | `verify` | connect to the OPC UA server as a client does |
//! | `enroll` | meet a new controller: fingerprint, password, first information |

mod activate;
mod controller;
mod create_csr;
mod enroll;
mod export_self_signed;
mod get_info;
mod import_ca;
mod import_user;
mod operation;
mod overview;
mod preflight;
mod push_authority;
mod restore_certificate;
mod runner;
mod select_certificate;
mod self_signed;
mod server_control;
mod server_log;
mod settings;
mod settings_transfer;
mod sign_csrs;
mod trust;
mod users;
mod verify;

pub use activate::{Activate, KeySource};
pub use controller::JobController;
pub use create_csr::{CreateCsr, CsrFields, CsrSaved};
pub use enroll::{Enrolled, enroll, probe};
pub use export_self_signed::{CertificateExported, ExportSelfSigned};
pub use get_info::GetInfo;
pub use import_ca::{CaCertificateSource, CheckCaCertificate, ImportCaCertificate};
pub use import_user::{CheckUserCertificate, ImportUserCertificate, UserCertificateFiles};
pub use operation::{Confirmation, Done, Operation, OperationOutput, OutputFacts, Run, ServerEffect, Step};
pub use overview::{Overview, ReadOverview};
pub use preflight::{CertificateChecked, CertificateImported};
pub use push_authority::PushAuthority;
pub use restore_certificate::{CertificateRestored, CheckCertificateBackup, RestoreCertificate};
pub use runner::{JobContext, JobEvent, Report, Summary, run};
pub use select_certificate::{ListCertificates, SelectCertificateType};
pub use self_signed::{CertificateMade, SelfSigned, SelfSignedFields};
pub use server_control::{StartServer, StopServer};
pub use server_log::{LogPart, LogSaved, ReadLog, SaveLog};
pub use settings::{ReadSettings, SetSettings, SettingsChange};
pub use settings_transfer::{ExportSettings, ImportSettings, SettingsExported, SettingsImported};
pub use sign_csrs::{SharedAuthority, SignCsrs};
pub use trust::{
    AddTrust, Destination, ItemContent, ListTrust, MoveClients, Note, PlannedAction, PlannedItem, RemoveClients,
    RemoveCrls, SkipReason, Target, TrustChange, TrustFile, TrustPlan, TrustSnapshot, TrustUndo, UndoTrust,
    WATCH_INTERVAL, WatchEvent, watch_trust,
};
pub use users::{AddUser, ListUsers, RemoveUsers};
pub use verify::{
    CertificateVerdict, Counts, EndpointVerdict, NotTried, Refusal, RefusalDetails, TokenOutcome, TokenVerdict,
    TrustConfigurator, Verify, VerifyFinding, VerifyReport,
};
