//! What an engineer does to many controllers at once.
//!
//! An [`Operation`] says what to do to one controller; [`run`] does it to many, side by side, reporting
//! [`JobEvent`]s. Window and command line build the same operations and read the same events.
//!
//! | file | operation |
//! |---|---|
//! | `get_info` | read everything a row shows |
//! | `server_control` | start and stop the OPC UA server |
//! | `basic_settings` | read and change the basic settings |
//! | `overview` | settings and the length of the lists, for a look at one controller |
//! | `users` | list, add, remove users |
//! | `self_signed` | make and install a self-signed certificate |
//! | `create_csr` | make a key and its certificate signing request |
//! | `import_ca_signed` | check and import the certificate that a CA issued for the controller's signing request |
//! | `sign_csrs` | sign the controllers' signing requests with the small CA, import the certificates |
//! | `push_authority` | give controllers the CRL and certificate of the small CA |
//! | `user_specified` | check and import key and certificate made with another tool |
//! | `restore_backup` | check and put back a backup of a key |
//! | `preflight` | what is looked at before such an import |
//! | `type_select` | list the server certificates held, select one |
//! | `export_self_signed` | save the self-signed certificate on the PC |
//! | `client_certificates` | client certificate lists and CRLs: list, watch, add, move, remove, undo |
//! | `activation` | activate legacy controllers by their keys |
//! | `server_log` | read the server log, save it on the PC |
//! | `settings_transfer` | export settings to the PC, import exports |
//! | `live_values` | watch the values of one OPC UA server as they change |
//! | `remote_control` | watch and control one controller with remote commands |
//! | `verify` | connect to the OPC UA server as a client does |
//! | `find_server` | find the OPC UA server of a controller, for a session that stays open |
//! | `record` | record force sensor or motion log data of one controller |
//! | `fins_bridge` | open a bridge between a PLC and a robot from its map |
//! | `enroll` | meet a new controller: fingerprint, password, first information |

mod activation;
mod basic_settings;
mod client_certificates;
mod controller;
mod create_csr;
mod enroll;
mod export_self_signed;
mod find_server;
mod fins_bridge;
mod get_info;
mod import_ca_signed;
mod live_values;
mod operation;
mod overview;
mod preflight;
mod push_authority;
mod record;
mod remote_control;
mod restore_backup;
mod runner;
mod self_signed;
mod server_control;
mod server_log;
mod settings_transfer;
mod sign_csrs;
mod type_select;
mod user_specified;
mod users;
mod verify;

pub use activation::{Activate, KeySource};
pub use basic_settings::{BasicSettingsChange, ReadBasicSettings, SetBasicSettings};
pub use client_certificates::{
    AddTrust, Destination, ItemContent, ListTrust, MoveClients, PlannedAction, PlannedItem, RemoveClients, RemoveCrls,
    SkipReason, TargetList, TrustChange, TrustFile, TrustNote, TrustPlan, TrustSnapshot, TrustUndo, UndoTrust,
    WATCH_INTERVAL, WatchEvent, watch_trust,
};
pub use controller::JobController;
pub use create_csr::{CreateCsr, CsrFields, CsrSaved};
pub use enroll::{Enrolled, enroll, probe};
pub use export_self_signed::{CertificateExported, ExportSelfSigned};
pub use find_server::{FindServer, FoundServer};
pub use fins_bridge::open_fins_bridge;
pub use get_info::GetInfo;
pub use import_ca_signed::{CaSignedSource, CheckCaSigned, ImportCaSigned};
pub use live_values::{
    AxisPoints, ConsumablePoints, ControllerPoints, IoGroupPoints, IoSignalPoint, LiveEvent, LiveLayout, LiveLogin,
    LivePoint, LiveRequest, NodeDetails, QueueKind, QueuePoints, QueueSystemPoints, RobotPoints, SafetyPoints,
    SpelProjectPoints, StatusPoints, TaskPoints, is_consumed_by_reading, watch_values,
};
pub use operation::{
    Confirmation, JobStep, NoOutput, Operation, OperationOutput, OperationRun, OutputFacts, ServerEffect,
};
pub use overview::{Overview, ReadOverview};
pub use preflight::{CertificateChecked, CertificateImported};
pub use push_authority::PushAuthority;
pub use record::{RecordEnd, RecordEvent, RecordRequest, record};
pub use remote_control::{
    IoKind, IoLabels, LoggedExchange, MAX_LABEL_FILE_BYTES, RemoteConnection, RemoteControlEvent, RemoteControlRequest,
    control_remotely,
};
pub use restore_backup::{BackupRestored, CheckBackup, RestoreBackup};
pub use runner::{ControllerReport, JobContext, JobEvent, JobSummary, run};
pub use self_signed::{CertificateMade, SelfSigned, SelfSignedFields};
pub use server_control::{StartServer, StopServer};
pub use server_log::{LogPart, LogSaved, ReadLog, SaveLog};
pub use settings_transfer::{ExportSettings, ImportSettings, SettingsExported, SettingsImported};
pub use sign_csrs::{SharedAuthority, SignCsrs};
pub use type_select::{ListCertificates, SelectCertificateType};
pub use user_specified::{CheckUserSpecified, ImportUserSpecified, UserSpecifiedFiles};
pub use users::{AddUser, ListUsers, RemoveUsers};
pub use verify::{
    CertificateVerdict, ConnectRefusal, EndpointVerdict, NotTried, RefusalDetails, TokenOutcome, TokenVerdict,
    TrustConfigurator, Verify, VerifyCounts, VerifyFinding, VerifyReport,
};
