//! What a person agrees to is what happens: every operation on controllers of both firmware generations, with a server
//! that runs and a client that is connected.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use chrono::Utc;
use opcua_configurator::jobs::{
    Activate, AddTrust, AddUser, BasicSettingsChange, CaSignedSource, CheckBackup, CheckCaSigned, Confirmation,
    CreateCsr, CsrFields, Destination, ExportSelfSigned, ExportSettings, GetInfo, ImportCaSigned, ImportSettings,
    ImportUserSpecified, KeySource, ListCertificates, ListTrust, ListUsers, LogPart, MoveClients, Operation,
    OperationOutput, PushAuthority, ReadBasicSettings, ReadLog, RemoveClients, RemoveCrls, RemoveUsers, RestoreBackup,
    SelectCertificateType, SelfSigned, SelfSignedFields, ServerEffect, SetBasicSettings, SharedAuthority, SignCsrs,
    StartServer, StopServer, TrustConfigurator, TrustFile, UndoTrust, UserSpecifiedFiles, Verify,
};
use opcua_configurator::model::{
    AuthorityRequest, AuthorityValidity, CertificateType, ClientList, FileFormat, KeyLength, ServerPort,
    ServerSettings, ServerStatus, Subject, UserCredential, UserPassword, UserTokenPolicy, Validity,
};
use opcua_configurator::pki::{Bundle, Certificate, Crl, Csr};
use opcua_configurator::session::opcua_client::ConnectTimeouts;
use opcua_configurator::virtual_controller::{ControllerState, FleetFirmware, demo_keys};
use opcua_configurator::workspace::authority::{DEFAULT_CRL_DAYS, NewAuthority};
use opcua_configurator::workspace::{BackupKind, CertificateFiles, KeyBackupSource, Workspace};

/// What became of the server that ran, and of the client that was connected.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Seen {
    Undisturbed,
    Restarted,
    Stopped,
    /// The server went on running, and ended the connection.
    CutOff,
}
use Seen::{CutOff, Restarted, Stopped, Undisturbed};

use crate::common::ca::Ca;
use crate::common::clients::{Authority, Client, TestApplication};
use crate::common::test_fleet::{PASSWORD, TestFleet};

/// One controller, its client, and the files on the PC.
struct Watch {
    fleet: TestFleet,
    folder: tempfile::TempDir,
    trusted: TestApplication,
    client: Option<Client>,
    /// What happened at least once and was said.
    happened: BTreeSet<&'static str>,
}

fn subject() -> CsrFields {
    CsrFields {
        common_name: None,
        country: "JP".into(),
        state: "Nagano".into(),
        locality: "Suwa".into(),
        organisation: "Example".into(),
        key_length: KeyLength::Rsa2048,
    }
}

fn added(name: &str, certificates: &[&Certificate], crls: &[&Crl]) -> AddTrust {
    let certificates = certificates.iter().copied().cloned().collect();
    let crls = crls.iter().copied().cloned().collect();
    let file = TrustFile { file_name: name.to_owned(), bundle: Bundle { certificates, crls } };
    AddTrust { files: vec![file].into(), destination: Destination::Trusted, based_on: None }
}

impl Watch {
    async fn new(firmware: FleetFirmware) -> Self {
        let watch = Self {
            fleet: TestFleet::start(1, firmware).await,
            folder: tempfile::tempdir().unwrap(),
            trusted: TestApplication::new("watcher"),
            client: None,
            happened: BTreeSet::new(),
        };
        watch.run(watch.self_signed(false)).await;
        let tokens = BTreeSet::from([UserTokenPolicy::Anonymous, UserTokenPolicy::UserName]);
        let change = BasicSettingsChange { user_tokens: Some(tokens), ..BasicSettingsChange::default() };
        watch.run(SetBasicSettings { change, ..SetBasicSettings::default() }).await;
        watch.run(added("watcher.der", &[&watch.trusted.certificate], &[])).await;
        watch
    }

    fn workspace(&self) -> Workspace {
        Workspace::new(self.folder.path())
    }

    fn files(&self) -> CertificateFiles {
        self.workspace().certificate_files()
    }

    fn state(&self) -> Arc<ControllerState> {
        self.fleet.controller(0).state()
    }

    /// Another engineer's work, of which nothing is asked but that it succeeds.
    async fn run<O: OperationOutput>(&self, operation: impl Operation<Output = O> + 'static) -> O {
        self.fleet.run(operation).await.remove(0).result.unwrap()
    }

    fn self_signed(&self, backup: bool) -> SelfSigned {
        let CsrFields { common_name, country, state, locality, organisation, key_length } = subject();
        let validity = Validity::try_from(5).unwrap();
        SelfSigned {
            fields: SelfSignedFields { common_name, country, state, locality, organisation, key_length, validity },
            backup: backup.then(|| self.files()),
        }
    }

    fn csr(&self, backup: bool) -> CreateCsr {
        CreateCsr { fields: subject(), format: FileFormat::Der, files: self.files(), backup }
    }

    fn cert(&self, name: &str) -> PathBuf {
        self.folder.path().join(self.fleet.controller(0).serial().as_str()).join("Cert").join(name)
    }

    /// What a CA makes of the controller's request, put where the import looks for it.
    fn issue(&self, ca: &Ca) -> CaSignedSource {
        let csr = Csr::from_der(&self.state().csr.as_ref().unwrap().csr.0).unwrap();
        fs::create_dir_all(self.cert("CASigned")).unwrap();
        fs::write(self.cert("CASigned/from_ca.der"), ca.sign(&csr)).unwrap();
        CaSignedSource::Folder(self.files())
    }

    async fn import(&self, ca: &Ca) {
        let source = self.issue(ca);
        self.run(ImportCaSigned { source, accept_warnings: false }).await;
    }

    async fn log_size(&self) -> u64 {
        self.run(ReadLog { part: LogPart::End }).await.size
    }

    /// The files of the workspace with their contents, but for locks.
    fn on_disk(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        fn walk(folder: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    walk(&path, found);
                } else if !path.ends_with(".lock") {
                    found.insert(path.clone(), fs::read(path).unwrap());
                }
            }
        }
        let mut found = BTreeMap::new();
        walk(self.folder.path(), &mut found);
        found
    }

    /// The server runs, and a client is connected.
    async fn connect(&mut self, identity: Option<&TestApplication>) {
        if let Some(client) = self.client.take() {
            client.close().await;
        }
        if self.fleet.controller(0).info().status != ServerStatus::Run {
            self.run(StartServer).await;
        }
        let endpoint = self.fleet.controller(0).info().endpoint;
        let client = Client::connect(&endpoint, identity.unwrap_or(&self.trusted)).await.unwrap();
        assert!(client.is_answered().await);
        self.client = Some(client);
    }

    /// Runs an operation, sees what comes of it, and compares that with what was agreed to.
    async fn check<O: OperationOutput>(
        &mut self,
        name: &str,
        operation: impl Operation<Output = O> + 'static,
        expected: Seen,
    ) -> O {
        let is_connected = match &self.client {
            Some(client) => client.is_answered().await,
            None => false,
        };
        if !is_connected {
            self.connect(None).await;
        }
        let said = operation.confirmation().unwrap_or_default();
        let (before, log, disk) = (self.state(), self.log_size().await, self.on_disk());
        let outcome = self.run(operation).await;
        let (after, log_after, disk_after) = (self.state(), self.log_size().await, self.on_disk());
        let status = self.fleet.controller(0).info().status;
        let client = self.client.take().unwrap();
        let seen = match (status, client.is_answered().await) {
            (ServerStatus::Run, true) => Undisturbed,
            (ServerStatus::Run, false) if said.server == ServerEffect::Restarts => Restarted,
            (ServerStatus::Run, false) => CutOff,
            (ServerStatus::Stop, false) => Stopped,
            other => panic!("{name}: {other:?}"),
        };
        assert_eq!(seen, expected, "{name}");
        if seen == Undisturbed {
            self.client = Some(client);
        } else if seen == Restarted {
            // Not waited for: a client that finds the server running again may be connected anew.
            client.abandon();
        } else {
            client.ended().await;
        }

        let Confirmation {
            server,
            replaces_certificate,
            changes_certificate,
            invalidates_ca_signed,
            replaces_request,
            changes_endpoints,
            starts_log,
            deletes_log,
            replaces_settings,
            moves_files_aside,
            overwrites_export,
            disconnects_clients,
        } = said;
        let mut must = |happened: bool, said: &[(bool, &'static str)]| {
            if happened {
                let said: Vec<_> = said.iter().filter(|(said, _)| *said).map(|(_, name)| *name).collect();
                assert!(!said.is_empty(), "{name}: what happened was not agreed to");
                self.happened.extend(said);
            }
        };
        assert_eq!(server == ServerEffect::Restarts, matches!(seen, Restarted), "{name}: {server:?}");
        let stops = server == ServerEffect::Stops;
        must(
            seen == Stopped,
            &[(stops, "stops"), (invalidates_ca_signed, "invalidates"), (replaces_request, "replaces request")],
        );
        must(seen == CutOff, &[(disconnects_clients, "disconnects")]);
        let in_use = |state: &ControllerState| state.selected_certificate().map(|pair| pair.certificate.0.clone());
        must(
            in_use(&after).is_some() && in_use(&before) != in_use(&after),
            &[(replaces_certificate, "replaces certificate"), (changes_certificate, "changes certificate")],
        );
        must(
            before.csr.is_some() && before.csr != after.csr,
            &[(invalidates_ca_signed, "replaces csr"), (replaces_request, "restores csr")],
        );
        let reached = |state: &ControllerState| {
            let ServerSettings { port, security_policies, user_tokens, .. } = &state.settings;
            (*port, security_policies.clone(), user_tokens.clone())
        };
        must(
            reached(&before) != reached(&after),
            &[(changes_endpoints, "changes endpoints"), (replaces_settings, "replaces settings")],
        );
        must(after.settings.server_log && !before.settings.server_log, &[(starts_log, "starts log")]);
        must(log_after < log, &[(deletes_log, "deletes log")]);
        let gone = |(path, content): (&PathBuf, &Vec<u8>)| {
            !disk_after.contains_key(path)
                || (disk_after[path] != *content && disk_after.values().any(|c| c == content))
        };
        must(disk.iter().any(gone), &[(moves_files_aside, "moves files aside")]);
        let lost = disk.values().any(|content| !disk_after.values().any(|now| now == content));
        must(lost, &[(overwrites_export, "overwrites export")]);
        outcome
    }

    /// What reads only.
    async fn questions(&mut self) {
        self.check("get info", GetInfo, Undisturbed).await;
        self.check("read settings", ReadBasicSettings, Undisturbed).await;
        self.check("list users", ListUsers, Undisturbed).await;
        self.check("list certificates", ListCertificates, Undisturbed).await;
        self.check("list trust", ListTrust, Undisturbed).await;
        self.check("read log", ReadLog { part: LogPart::From(0) }, Undisturbed).await;
        let identity = self.workspace().own_identity();
        let timeouts = ConnectTimeouts::default();
        self.check("verify", Verify { identity, login: None, trust_first: false, timeouts }, Undisturbed).await;
        self.check("start", StartServer, Undisturbed).await;
    }

    async fn settings_and_users(&mut self) {
        let set = |change| SetBasicSettings {
            change,
            log_password: Some(ServerSettings::LOG_PASSWORD.to_owned()),
            ..SetBasicSettings::default()
        };
        let free = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let port = Some(ServerPort::try_from(free).unwrap());
        self.check("port", set(BasicSettingsChange { port, ..BasicSettingsChange::default() }), Restarted).await;
        let log = |on| set(BasicSettingsChange { server_log: Some(on), ..BasicSettingsChange::default() });
        self.check("log on", log(true), Restarted).await;
        self.run(log(false)).await;
        self.check(
            "delete log",
            set(BasicSettingsChange { delete_log: true, ..BasicSettingsChange::default() }),
            Restarted,
        )
        .await;
        let name: opcua_configurator::model::UserName = "operator1".parse().unwrap();
        let credential = UserCredential { name: name.clone(), password: UserPassword::new("Passw0rd1").unwrap() };
        self.check("add user", AddUser { credential, based_on: None }, Restarted).await;
        self.check("remove user", RemoveUsers { names: vec![name], based_on: None }, Restarted).await;
        self.check("stop", StopServer, Stopped).await;
    }

    async fn certificates(&mut self, legacy: bool) {
        let ca = Ca::new();
        self.check("self-signed", self.self_signed(true), Restarted).await;
        self.run(self.self_signed(false)).await;
        let export = ExportSelfSigned { format: FileFormat::Der, files: self.files() };
        self.check("export self-signed", export, Undisturbed).await;
        self.check("self-signed again", self.self_signed(true), Restarted).await;

        self.check("first csr", self.csr(false), Undisturbed).await;
        let source = self.issue(&ca);
        self.check("check ca", CheckCaSigned(source.clone()), Undisturbed).await;
        self.check("import ca", ImportCaSigned { source, accept_warnings: false }, Restarted).await;
        self.check("select", SelectCertificateType(CertificateType::SelfSigned), Restarted).await;
        self.check("csr beside another in use", self.csr(false), Undisturbed).await;
        self.import(&ca).await;
        self.check("csr of the one in use", self.csr(false), if legacy { Stopped } else { Undisturbed }).await;
        self.import(&ca).await;

        let plant_ca = AuthorityRequest {
            subject: Subject {
                common_name: "Small CA".into(),
                country: String::new(),
                state: String::new(),
                locality: String::new(),
                organisation: String::new(),
            },
            key_length: KeyLength::Rsa2048,
            validity: AuthorityValidity::default(),
        };
        let new = NewAuthority { root: plant_ca, intermediate: None, crl_days: DEFAULT_CRL_DAYS };
        let (authority, passphrase) = (self.workspace().authority(), "correct horse".into());
        drop(authority.create(&new, &passphrase, Utc::now()).unwrap());
        let push = PushAuthority::new(&authority.overview().unwrap(), false);
        let sign = SignCsrs {
            authority: Arc::new(SharedAuthority::new(authority, passphrase)),
            request: self.csr(false),
            new_key: true,
            renew: false,
            validity: Validity::try_from(1).unwrap(),
            allow_short_keys: false,
            accept_warnings: false,
        };
        self.connect(None).await;
        // Not by `check`: the CA writes its own record in the workspace as well.
        let (said, before) = (sign.confirmation().unwrap(), self.state());
        let client = self.client.take().unwrap();
        assert!(!self.run(sign).await.moved_aside.is_empty());
        client.ended().await;
        assert!(self.state().csr != before.csr);
        assert_eq!(self.fleet.controller(0).info().status, ServerStatus::Run, "started again on every firmware");
        assert_eq!(said.server, ServerEffect::Restarts);
        assert!(said.replaces_certificate && said.invalidates_ca_signed && said.moves_files_aside);
        self.check("push authority", push, Undisturbed).await;
    }

    /// What only legacy firmware has.
    async fn legacy(&mut self) {
        let ca = Ca::new();
        let keys = demo_keys(&self.fleet.controller(0).serial());
        self.check("activate", Activate { keys: KeySource::Typed(keys) }, Restarted).await;
        self.run(self.self_signed(true)).await;
        let user = ImportUserSpecified {
            files: UserSpecifiedFiles::Pfx(self.cert("SelfSigned/1_key.pfx")),
            password: Some(PASSWORD.into()),
            accept_warnings: true,
        };
        self.run(SelectCertificateType(CertificateType::CaSigned)).await;
        self.check("import user", user, Restarted).await;

        let export = ExportSettings { files: self.workspace().settings_files(), passphrase: None };
        self.check("export", export.clone(), Undisturbed).await;
        self.check("export again", export, Undisturbed).await;
        let free = std::net::TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let port = Some(ServerPort::try_from(free).unwrap());
        let change = BasicSettingsChange { port, ..BasicSettingsChange::default() };
        self.run(SetBasicSettings { change, ..SetBasicSettings::default() }).await;
        self.connect(None).await;
        let import = ImportSettings { files: self.workspace().settings_files(), passphrase: None };
        self.check("import", import, Restarted).await;

        let source = |kind| KeyBackupSource { files: self.files(), kind, chosen: None };
        let (own, request) = (source(BackupKind::SelfSigned), source(BackupKind::CaSigned));
        let restore =
            |source: &KeyBackupSource| RestoreBackup { source: source.clone(), password: None, accept_warnings: false };
        self.check("check backup", CheckBackup { source: own.clone(), password: None }, Undisturbed).await;
        self.check("restore self-signed", restore(&own), Restarted).await;
        self.run(self.csr(true)).await;
        self.import(&ca).await;
        // Another key and certificate come into use, made elsewhere.
        let elsewhere = tempfile::tempdir().unwrap();
        let files = Workspace::new(elsewhere.path()).certificate_files();
        let other = CreateCsr { files: files.clone(), ..self.csr(false) };
        self.run(other.clone()).await;
        self.run(SelectCertificateType(CertificateType::SelfSigned)).await;
        self.check("restore csr and certificate", restore(&request), Restarted).await;

        self.run(other).await;
        fs::remove_file(self.cert("CASigned/from_ca.der")).unwrap();
        self.import(&ca).await;
        fs::remove_file(self.cert("CASigned/from_ca.der")).unwrap();
        let said = restore(&request).confirmation().unwrap();
        self.connect(None).await;
        let client = self.client.take().unwrap();
        self.run(restore(&request)).await;
        client.ended().await;
        assert_eq!(self.fleet.controller(0).info().status, ServerStatus::Stop);
        assert!(said.replaces_request, "that a server may stop for want of a certificate");
        self.run(SelectCertificateType(CertificateType::SelfSigned)).await;
    }

    async fn trust(&mut self) {
        let identity = self.workspace().own_identity();
        self.check("trust the configurator", TrustConfigurator { identity }, Undisturbed).await;
        let (other, own) = (TestApplication::new("other"), self.trusted.thumbprint());
        self.check("add", added("other.der", &[&other.certificate], &[]), Undisturbed).await;
        let relist = |from, to, thumbprint| MoveClients {
            from,
            to,
            thumbprints: vec![thumbprint],
            based_on: None,
            accept_notes: true,
        };
        let (trusted, rejected) = (ClientList::Trusted, ClientList::Rejected);
        self.check("reject another", relist(trusted, rejected, other.thumbprint()), Undisturbed).await;
        self.check("trust another", relist(rejected, trusted, other.thumbprint()), Undisturbed).await;
        self.check("reject", relist(trusted, rejected, own.clone()), CutOff).await;
        self.run(relist(rejected, trusted, own.clone())).await;
        let remove = RemoveClients { list: Some(trusted), thumbprints: vec![own], based_on: None };
        self.check("remove", remove, CutOff).await;
        let change = self.run(added("watcher.der", &[&self.trusted.certificate], &[])).await;
        let undo = UndoTrust([(self.fleet.listed()[0].name.clone(), change.undo.unwrap())].into());
        self.check("undo", undo, CutOff).await;
        self.run(added("watcher.der", &[&self.trusted.certificate], &[])).await;

        let authority = Authority::new("Client CA");
        let (first, second) = (authority.client("first", 2), authority.client("second", 3));
        self.run(added("ca.der", &[&authority.certificate], &[&authority.crl(1, &[])])).await;
        self.connect(Some(&first)).await;
        self.check("revoke", added("ca.crl", &[], &[&authority.crl(2, &[&first])]), CutOff).await;
        self.connect(Some(&second)).await;
        let held: Vec<String> = self.state().crls.iter().map(|held| held.summary.id.clone()).collect();
        self.check("remove crl", RemoveCrls { ids: held, based_on: None }, CutOff).await;
    }
}

/// Everything that can be said.
const SAID: [&str; 12] = [
    "stops",
    "invalidates",
    "disconnects",
    "replaces certificate",
    "changes certificate",
    "replaces csr",
    "restores csr",
    "changes endpoints",
    "replaces settings",
    "starts log",
    "deletes log",
    "moves files aside",
];

#[tokio::test(flavor = "multi_thread")]
async fn what_is_agreed_to_is_what_happens_on_legacy_firmware() {
    let mut watch = Watch::new(FleetFirmware::Legacy).await;
    watch.questions().await;
    watch.settings_and_users().await;
    watch.certificates(true).await;
    watch.legacy().await;
    watch.trust().await;
    assert!(watch.happened.remove("overwrites export"));
    assert_eq!(watch.happened, SAID.into(), "nothing is said that never happens");
}

#[tokio::test(flavor = "multi_thread")]
async fn what_is_agreed_to_is_what_happens_on_current_firmware() {
    let mut watch = Watch::new(FleetFirmware::Current).await;
    watch.questions().await;
    watch.settings_and_users().await;
    watch.certificates(false).await;
    watch.trust().await;
}
