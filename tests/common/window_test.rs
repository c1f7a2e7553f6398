//! An engineer's desk: a plant of virtual controllers, and the real window over it. Each story adds what it needs.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use egui_kittest::kittest::Queryable as _;
use opcua_configurator::jobs::{
    AddUser, BasicSettingsChange, Operation, SelfSigned, SelfSignedFields, SetBasicSettings, StartServer,
};
use opcua_configurator::model::{
    CertificateType, ConnectionKind, KeyLength, Problem, SecurityPolicy, SerialNumber, UserCredential, UserPassword,
    UserTokenPolicy, Validity,
};
use opcua_configurator::ui::backend::{BackendOptions, TokioBackend, VirtualFleetStarter};
use opcua_configurator::ui::picker::{FileKind, FilePicker, FixedPicker, Picked};
use opcua_configurator::virtual_controller::remote::RemoteOptions;
use opcua_configurator::virtual_controller::{FleetFirmware, demo_keys};
use opcua_configurator::workspace::{Configuration, ControllerEntry, RetrievedInfo, Workspace};

use super::test_fleet::TestFleet;
use super::window::{self, SIZE, agree, click, settle, shows, wait_until, window_in};

/// Long enough for a busy machine to make keys.
pub const WAIT_LIMIT: Duration = Duration::from_secs(60);

pub struct WindowTest {
    pub window: window::Window<TokioBackend>,
    pub fleet: TestFleet,
    pub runtime: tokio::runtime::Runtime,
    pub workspace: Workspace,
    /// The workspace is in it.
    pub folder: tempfile::TempDir,
}

/// A desktop whose file manager shows every folder, and which offers no files.
#[derive(Debug, Clone, Default)]
pub struct FileManager(Arc<Mutex<Vec<PathBuf>>>);

impl FilePicker for FileManager {
    fn pick(&self, _kind: FileKind, _title: String, done: Picked) {
        done(Ok(None));
    }

    fn open_folder(&self, folder: &Path) -> Result<(), Problem> {
        self.0.lock().unwrap().push(folder.to_owned());
        Ok(())
    }
}

/// A file as the desktop hands it over: its path.
#[derive(Debug)]
struct DroppedFile(PathBuf);

impl egui::DroppedFile for DroppedFile {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("the window must not read files itself".into())
    }
}

impl WindowTest {
    /// As [`WindowTest::with_controllers`], with a file manager.
    pub fn with_file_manager(count: usize, firmware: FleetFirmware) -> (Self, FileManager) {
        let manager = FileManager::default();
        let app = Self::start(|| TestFleet::start(count, firmware), listed, None, |_| manager.clone());
        (app, manager)
    }

    /// Presses "Open folder", and waits until the file manager has shown this one.
    pub fn open_folder(&mut self, manager: &FileManager, folder: &Path) {
        self.click("Open folder");
        wait_until(&mut self.window, WAIT_LIMIT, |_| {
            manager.0.lock().unwrap().last().is_some_and(|opened| opened == folder)
        });
        assert!(folder.is_dir());
    }

    /// A plant, and a window whose list is empty.
    pub fn empty(count: usize, firmware: FleetFirmware) -> Self {
        Self::start(|| TestFleet::start(count, firmware), |_| Configuration::default(), None, |_| FixedPicker(Ok(None)))
    }

    /// A plant, and a window that knows it: "cell 1", "cell 2", …
    pub fn with_controllers(count: usize, firmware: FleetFirmware) -> Self {
        Self::start(|| TestFleet::start(count, firmware), listed, None, |_| FixedPicker(Ok(None)))
    }

    /// Controllers that answer remote commands, and a window that knows them.
    pub fn with_remote(count: usize, remote: RemoteOptions) -> Self {
        let fleet = || TestFleet::with_remote(count, FleetFirmware::Current, remote);
        Self::start(fleet, listed, None, |_| FixedPicker(Ok(None)))
    }

    /// Controllers whose servers run, with a user.
    pub fn with_servers(count: usize, firmware: FleetFirmware, policies: &[SecurityPolicy]) -> Self {
        let app = Self::with_controllers(count, firmware);
        let change = BasicSettingsChange {
            security_policies: Some(policies.iter().copied().collect()),
            user_tokens: Some(UserTokenPolicy::ALL.into()),
            ..BasicSettingsChange::default()
        };
        app.run(SetBasicSettings { change, ..SetBasicSettings::default() });
        app.run(SelfSigned {
            fields: SelfSignedFields {
                common_name: None,
                country: "JP".into(),
                state: "Nagano".into(),
                locality: "Suwa".into(),
                organisation: "Example".into(),
                key_length: KeyLength::Rsa2048,
                validity: Validity::try_from(5).unwrap(),
            },
            backup: None,
        });
        let credential =
            UserCredential { name: "operator1".parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() };
        app.run(AddUser { credential, based_on: None });
        app.run(StartServer);
        app
    }

    /// `picker` gets the desk's folder.
    pub fn start<F: Future<Output = TestFleet>, P: FilePicker + 'static>(
        fleet: impl FnOnce() -> F,
        list: impl FnOnce(&TestFleet) -> Configuration,
        starter: Option<Arc<dyn VirtualFleetStarter>>,
        picker: impl FnOnce(&Path) -> P,
    ) -> Self {
        let runtime = tokio::runtime::Runtime::new().unwrap();
        let fleet = runtime.block_on(fleet());
        let folder = tempfile::tempdir().unwrap();
        let workspace = Workspace::new(folder.path().join("OPCUA"));
        let offers_virtual = starter.is_some();
        let backend = BackendOptions {
            workspace: workspace.clone(),
            lock: workspace.lock().unwrap(),
            passwords: fleet.passwords.clone(),
            connectors: Arc::new(fleet.connector).into(),
            starter,
            picker: Arc::new(picker(folder.path())),
        };
        let backend = TokioBackend::new(backend, || {}).unwrap();
        let mut window = window_in(workspace.clone(), backend, list(&fleet), SIZE);
        window.state_mut().model.virtual_available = offers_virtual;
        window.step();
        Self { window, fleet, runtime, workspace, folder }
    }

    pub fn wait_for(&mut self, text: &str) {
        wait_until(&mut self.window, WAIT_LIMIT, |window| shows(window, text));
    }

    pub fn click(&mut self, label: &str) {
        click(&mut self.window, label);
    }

    pub fn tick(&mut self, names: &[&str]) {
        for name in names {
            self.click(&format!("Tick {name}"));
        }
    }

    /// Waits until a field holds this.
    pub fn wait_for_value(&mut self, text: &str) {
        wait_until(&mut self.window, WAIT_LIMIT, |window| window.query_all_by_value(text).next().is_some());
    }

    /// Drops files of the desktop onto the window.
    pub fn drop_files(&mut self, paths: &[PathBuf]) {
        self.window.input_mut().hovered_files.clear();
        for path in paths {
            self.window.input_mut().dropped_files.push(Arc::new(DroppedFile(path.clone())));
        }
        settle(&mut self.window);
    }

    pub fn serial(&self, index: usize) -> SerialNumber {
        self.fleet.controller(index).serial()
    }

    /// The line of a controller in an activation file.
    pub fn activation_line(&self, index: usize) -> String {
        let serial = self.serial(index);
        let keys = demo_keys(&serial);
        format!("{serial},{},{}\n", keys.licence, keys.activation)
    }

    /// The type of the certificate that a controller uses.
    pub fn in_use(&self, index: usize) -> Option<CertificateType> {
        self.fleet.controller(index).info().certificate.map(|certificate| certificate.kind)
    }

    /// Waits for the summary, checks it and closes it.
    pub fn finish(&mut self, summary: &str) {
        self.wait_for("Completed");
        assert!(shows(&self.window, summary), "no {summary:?} in the summary");
        self.click("Close");
    }

    /// Confirms first: the button that does it stands before Cancel, whatever its label.
    pub fn confirm_and_finish(&mut self, summary: &str) {
        agree(&mut self.window);
        self.finish(summary);
    }

    /// A change of all controllers by another program.
    pub fn run(&self, operation: impl Operation + 'static) {
        for report in self.runtime.block_on(self.fleet.run(operation)) {
            assert!(report.result.is_ok(), "{report:?}");
        }
    }

    /// Waits until the workspace remembers something: saving has a thread of its own.
    pub fn wait_until_saved(&self, holds: impl Fn(&Configuration) -> bool) {
        let until = Instant::now() + WAIT_LIMIT;
        while !holds(&self.workspace.load().unwrap().configuration) {
            assert!(Instant::now() < until, "not saved");
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

/// The plant's controllers, read before.
pub fn listed(fleet: &TestFleet) -> Configuration {
    list(fleet, true)
}

/// `known`: their information was read before.
pub fn list(fleet: &TestFleet, known: bool) -> Configuration {
    let mut configuration = Configuration::default();
    for (index, listed) in fleet.listed().into_iter().enumerate() {
        let controller = fleet.controller(index);
        configuration.controllers.push(ControllerEntry {
            name: listed.name,
            address: listed.address,
            series: controller.series(),
            connection: ConnectionKind::Management,
            fingerprint: listed.fingerprint,
            last: known.then(|| RetrievedInfo { at: window::now(), info: controller.info() }),
        });
    }
    configuration
}
