//! Backups of keys through the real window, against real virtual controllers over loopback.

use std::fs;
use std::path::PathBuf;

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use opcua_configurator::model::{CertificateType, ServerStatus};
use opcua_configurator::pki::Csr;
use opcua_configurator::virtual_controller::FleetFirmware;

use crate::common::ca::Ca;
use crate::common::test_fleet;
use crate::common::window::{agree, choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_test::{FileManager, WAIT_LIMIT, WindowTest, listed};

impl WindowTest {
    fn with_legacy_controller() -> (Self, FileManager) {
        let (mut app, manager) = Self::with_file_manager(1, FleetFirmware::Legacy);
        app.click("Tick cell 1");
        (app, manager)
    }

    fn set_backup(&mut self) {
        choose(&mut self.window, &["Options", "Backup…"]);
        self.click("Keep copies of certificates made here");
        assert!(shows(&self.window, "A backup is put back with Certificate"));
        self.click("Apply");
    }

    fn fill_in_self_signed(&mut self) {
        choose(&mut self.window, &["Certificate", "Create and save", "Self-signed…"]);
        self.fill_in();
        self.finish("1 done");
    }

    /// The fields of a certificate or a request, up to the agreement.
    fn fill_in(&mut self) {
        let button = ["Create and save", "Apply"];
        wait_until(&mut self.window, WAIT_LIMIT, |window| button.iter().any(|label| is_enabled(window, label)));
        type_into(&mut self.window, "Organisation", "Example");
        let label = button.into_iter().find(|label| is_enabled(&self.window, label)).unwrap();
        self.click(label);
        agree(&mut self.window);
    }

    fn make_csr(&mut self) {
        choose(&mut self.window, &["Certificate", "Create and save", "CA signed…"]);
        self.click("Create CSR…");
        self.fill_in();
    }

    fn certificate_in_use(&self) -> Option<(CertificateType, Vec<u8>)> {
        let state = self.fleet.controller(0).state();
        state.selected_certificate().map(|pair| (state.selected, pair.certificate.0.clone()))
    }

    fn cert(&self, name: &str) -> PathBuf {
        self.workspace.root().join(self.fleet.controller(0).serial().as_str()).join("Cert").join(name)
    }

    /// The key that was moved aside, below a folder.
    fn former_key(&self, folder: &str, name: &str) -> PathBuf {
        let folders = fs::read_dir(self.cert(folder)).unwrap().map(|entry| entry.unwrap().path());
        let found: Vec<_> = folders.map(|folder| folder.join(name)).filter(|path| path.is_file()).collect();
        assert_eq!(found.len(), 1, "{found:?}");
        found[0].clone()
    }

    fn restore(&mut self, kind: &str, file: Option<&PathBuf>, password: &str) {
        choose(&mut self.window, &["Certificate", "Restore backup…"]);
        self.click(kind);
        if let Some(file) = file {
            type_into(&mut self.window, "Key file", &file.display().to_string());
        }
        type_into(&mut self.window, "Password of the file", password);
        self.click("Restore…");
    }
}

const SELF_SIGNED: &str = "Self-signed certificate and its key (1_key.pfx)";
const CA_SIGNED: &str = "CSR, its key and the certificate from the CA (3_key.pfx)";

#[test]
fn a_former_certificate_is_kept_with_its_key_and_put_back_from_there() {
    let (mut app, manager) = WindowTest::with_legacy_controller();
    app.set_backup();
    app.fill_in_self_signed();
    let first = app.certificate_in_use().unwrap();
    assert!(app.cert("SelfSigned/1_key.pfx").is_file());
    app.set_backup();
    app.fill_in_self_signed();
    assert_ne!(app.certificate_in_use(), Some(first.clone()));

    choose(&mut app.window, &["Certificate", "Export self-signed…"]);
    app.click("Export");
    assert!(shows(&app.window, "and their keys, are kept: they are moved into a folder named after their date"));
    app.click("Export");
    app.wait_for("Completed");
    assert!(shows(&app.window, "Former files were moved to"));
    let former = app.former_key("SelfSigned", "1_key.pfx");
    assert!(shows(&app.window, &former.parent().unwrap().display().to_string()));
    app.open_folder(&manager, former.parent().unwrap());
    app.finish("1 done");
    assert!(!app.cert("SelfSigned/1_key.pfx").exists() && app.cert("SelfSigned/1_cert.der").is_file());

    app.restore(SELF_SIGNED, None, "");
    app.wait_for("The file to be imported was not found");
    app.click("Close");
    assert!(shows(&app.window, "Former backups are in folders named after their date"));
    type_into(&mut app.window, "Key file", &former.display().to_string());
    app.click("Restore…");
    app.wait_for("Issued to");
    assert!(shows(&app.window, "The certificate of this type in the controller is replaced"));
    app.click("Restore");
    app.finish("1 done");
    assert_eq!(app.certificate_in_use(), Some(first), "type 1, with its own key");
}

#[test]
fn a_request_comes_back_with_its_key_and_what_the_ca_issued_for_it() {
    let (mut app, _) = WindowTest::with_legacy_controller();
    app.set_backup();
    app.make_csr();
    app.finish("1 done");
    let csr = Csr::from_any(&fs::read(app.cert("CSR/3_csr.der")).unwrap()).unwrap();
    fs::write(app.cert("CASigned/from_ca.der"), Ca::new().sign(&csr)).unwrap();
    app.click("Import…");
    app.wait_for("Issued to");
    app.click("Import");
    app.finish("1 done");
    let issued = app.certificate_in_use().unwrap();
    app.click("Start");
    wait_until(&mut app.window, WAIT_LIMIT, |window| shows(window, "Run"));

    // A new request stops a server that runs on the certificate, and says so first.
    choose(&mut app.window, &["Certificate", "Create and save", "CA signed…"]);
    app.click("Create CSR…");
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Create and save"));
    app.click("Create and save");
    for said in ["a server that uses it stops, connected clients are cut off", "stays stopped until"] {
        assert!(shows(&app.window, said), "{said}");
    }
    app.click("Create CSR");
    app.wait_for("Completed");
    assert!(shows(&app.window, "Former files were moved to"));
    app.finish("1 done");
    app.click("Close");
    assert_eq!(app.fleet.controller(0).info().status, ServerStatus::Stop);
    assert!(!app.cert("CASigned/from_ca.der").exists());

    // The one just made has a backup too, and no certificate yet.
    app.restore(CA_SIGNED, None, "");
    app.wait_for("CSR and key, without a certificate from the CA");
    assert!(shows(&app.window, "The CSR in the controller and its key are replaced"));
    app.click("Restore");
    app.finish("1 done");

    let former = app.former_key("CASigned", "3_key.pfx");
    app.restore(CA_SIGNED, Some(&former), "wrong");
    app.wait_for("The password of the private key is wrong");
    app.click("Close");
    type_into(&mut app.window, "Password of the file", test_fleet::PASSWORD);
    app.click("Restore…");
    app.wait_for("Issued to");
    app.click("Restore");
    app.finish("1 done");
    assert_eq!(app.certificate_in_use(), Some(issued));
}

#[test]
fn an_empty_connection_password_is_refused_with_its_reason() {
    let empty = || test_fleet::TestFleet::without_password(1, FleetFirmware::Legacy);
    let mut app = WindowTest::start(empty, listed, None, |_| FileManager::default());
    app.click("Tick cell 1");
    app.set_backup();
    app.make_self_signed_refused();
    choose(&mut app.window, &["Server settings", "Export…"]);
    assert!(shows(&app.window, "A controller without a connection password needs a passphrase"));
    app.click("Export");
    app.click("Export");
    app.wait_for("The connection password is empty and protects no file");
    assert!(shows(&app.window, "give a passphrase"));
    app.click("Close");
    choose(&mut app.window, &["Server settings", "Export…"]);
    type_into(&mut app.window, "Passphrase", "correct horse");
    app.click("Export");
    app.confirm_and_finish("1 done");
}

impl WindowTest {
    fn make_self_signed_refused(&mut self) {
        choose(&mut self.window, &["Certificate", "Create and save", "Self-signed…"]);
        self.fill_in();
        self.wait_for("1 failed");
        assert!(shows(&self.window, "The connection password is empty and protects no file"));
        self.click("Close");
        assert_eq!(self.certificate_in_use(), None, "nothing was changed");
    }
}

#[test]
fn current_firmware_says_why_there_is_nothing_to_restore() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    app.click("Tick cell 1");
    app.click("Certificate");
    let item = app.window.get_by_label("Restore backup…");
    assert!(item.accesskit_node().is_disabled());
    item.hover();
    for _ in 0..60 {
        app.window.step();
    }
    assert!(shows(&app.window, "Only for firmware before 8.0.0"));
}
