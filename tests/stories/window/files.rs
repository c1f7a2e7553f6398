//! Files and folders of certificates through the real window: the desktop's dialogs, and the chain of what a CA issued.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui_kittest::kittest::Queryable as _;
use opcua_configurator::model::{ErrorCode, Problem};
use opcua_configurator::pki::{Certificate, Csr};
use opcua_configurator::ui::picker::{FileKind, FilePicker, FixedPicker, Picked, PickedSeveral};
use opcua_configurator::virtual_controller::FleetFirmware;
use parking_lot::Mutex;

use crate::common::ca::Ca;
use crate::common::test_fleet::TestFleet;
use crate::common::window::{choose, is_enabled, shows, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest, listed};

/// A desktop where a person chooses a file named after what is looked for, and that remembers the folders it showed.
#[derive(Debug, Clone, Default)]
struct Desktop {
    folder: PathBuf,
    opened: Arc<Mutex<Vec<PathBuf>>>,
}

impl FilePicker for Desktop {
    fn pick(&self, kind: FileKind, _title: String, done: Picked) {
        done(Ok(Some(self.folder.join(format!("{kind:?}")))));
    }

    fn pick_several(&self, kind: FileKind, _title: String, done: PickedSeveral) {
        done(Ok(vec![self.folder.join(format!("{kind:?}"))]));
    }

    fn open_folder(&self, folder: &Path) -> Result<(), Problem> {
        self.opened.lock().push(folder.to_owned());
        Ok(())
    }
}

fn app(firmware: FleetFirmware) -> (WindowTest, Desktop) {
    let opened = Arc::default();
    let with = |folder: &Path| Desktop { folder: folder.to_owned(), opened: Arc::clone(&opened) };
    let mut app = WindowTest::start(|| TestFleet::start(1, firmware), listed, None, with);
    app.click("Tick cell 1");
    let desktop = Desktop { folder: app.folder.path().to_owned(), opened };
    (app, desktop)
}

impl WindowTest {
    fn create(&mut self, item: &str) {
        choose(&mut self.window, &["Certificate", "Create and save", item]);
    }

    /// Clicks the nth button of this name, counted from 0.
    fn click_nth(&mut self, label: &str, nth: usize) {
        self.window.query_all_by_label(label).nth(nth).unwrap_or_else(|| panic!("no {label:?} {nth}")).click();
        crate::common::window::settle(&mut self.window);
    }
}

#[test]
fn every_path_of_a_certificate_can_be_browsed_for() {
    let (mut app, desktop) = app(FleetFirmware::Legacy);
    app.create("User specified…");
    app.click("Browse…");
    app.wait_for_value(&desktop.folder.join("Pkcs12").display().to_string());
    app.click("Certificate and key (.der, .key)");
    app.click_nth("Browse…", 0);
    app.wait_for_value(&desktop.folder.join("Certificate").display().to_string());
    app.click_nth("Browse…", 1);
    app.wait_for_value(&desktop.folder.join("Key").display().to_string());
    app.click("Cancel");
    app.create("CA signed…");
    app.click("Browse…");
    app.wait_for_value(&desktop.folder.join("Certificate").display().to_string());
}

#[test]
fn folders_are_shown_in_the_file_manager_and_made_if_they_are_missing() {
    let (mut app, desktop) = app(FleetFirmware::Current);
    app.create("CA signed…");
    // Where the CSR is, and where the certificate goes.
    for nth in [0, 1] {
        app.click_nth("Open folder", nth);
    }
    wait_until(&mut app.window, WAIT_LIMIT, |_| desktop.opened.lock().len() == 2);
    let files = app.workspace.certificate_files();
    let mut opened = desktop.opened.lock().clone();
    opened.sort();
    assert_eq!(opened, [files.ca_signed_folder(&app.serial(0)), files.csr_folder(&app.serial(0))]);
    assert!(opened.iter().all(|folder| folder.is_dir()));

    // What was saved is one click away.
    app.click("Create CSR…");
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Create and save"));
    app.click("Create and save");
    app.click("Create CSR");
    app.wait_for("Saved in");
    app.click("Open folder");
    wait_until(&mut app.window, WAIT_LIMIT, |_| desktop.opened.lock().len() == 3);
    assert_eq!(desktop.opened.lock().last(), Some(&files.csr_folder(&app.serial(0))));
}

#[test]
fn a_desktop_without_a_file_manager_says_the_path_instead() {
    let with = |_: &Path| FixedPicker(Err(ErrorCode::NoFilePicker.into()));
    let mut app = WindowTest::start(|| TestFleet::start(1, FleetFirmware::Current), listed, None, with);
    app.click("Tick cell 1");
    app.create("CA signed…");
    app.click_nth("Open folder", 0);
    app.wait_for("The folder cannot be opened");
    let folder = app.workspace.certificate_files().csr_folder(&app.serial(0));
    assert!(shows(&app.window, &folder.display().to_string()));
    app.click("Close");
    app.click("Browse…");
    app.wait_for("The file dialog cannot be opened");
}

#[test]
fn the_chain_of_what_a_ca_issued_is_shown_before_the_import() {
    let (mut app, _) = app(FleetFirmware::Current);
    app.create("CA signed…");
    app.click("Create CSR…");
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Create and save"));
    app.click("Create and save");
    app.confirm_and_finish("1 done");
    let files = app.workspace.certificate_files();
    let csr = Csr::from_any(&fs::read(files.csr_folder(&app.serial(0)).join("3_csr.der")).unwrap()).unwrap();
    let ca = Ca::new();
    let folder = files.ca_signed_folder(&app.serial(0));
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("robot.der"), ca.sign(&csr)).unwrap();

    // The CA is not known; one of the same name did not sign it.
    fs::write(folder.join("other.cer"), Ca::new().certificate()).unwrap();
    app.click("Import…");
    app.wait_for("by Plant CA");
    assert!(shows(&app.window, "The next issuer is neither in the file nor"));
    assert!(!shows(&app.window, "Plant CA, root"));
    app.click("Cancel");

    // Its certificate beside the file.
    fs::write(folder.join("ca.crt"), ca.certificate()).unwrap();
    app.click("Import…");
    app.wait_for("Plant CA, root, valid from");
    assert!(!shows(&app.window, "The next issuer"));
    app.click("Cancel");

    // Both in one file, as many authorities send it, in either order.
    let pem = |der: &[u8]| Certificate::from_der(der).unwrap().to_pem();
    let both = app.folder.path().join("answer.pem");
    fs::write(&both, pem(ca.certificate()) + &pem(&ca.sign(&csr))).unwrap();
    crate::common::window::type_into(&mut app.window, "Certificate file", &both.display().to_string());
    app.click("Import…");
    app.wait_for("Plant CA, root, valid from");
    app.click(if is_enabled(&app.window, "Import") { "Import" } else { "Import anyway" });
    app.finish("1 done");
}
