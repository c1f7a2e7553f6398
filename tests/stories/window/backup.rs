//! Backups of keys through the real window, against real virtual controllers over loopback.

use std::fs;
use std::path::PathBuf;

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use opcua_configurator::model::{CertificateType, ServerStatus};
use opcua_configurator::pki::Csr;
use opcua_configurator::virtual_controller::FleetFirmware;

use crate::common::ca::Ca;
use crate::common::plant;
use crate::common::window::{agree, choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_desk::{Desk, FileManager, PATIENCE, listed};

impl Desk {
    fn with_legacy_controller() -> (Self, FileManager) {
        let (mut desk, manager) = Self::with_file_manager(1, FleetFirmware::Legacy);
        desk.click("Tick cell 1");
        (desk, manager)
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
        wait_until(&mut self.window, PATIENCE, |window| button.iter().any(|label| is_enabled(window, label)));
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
        let state = self.plant.controller(0).state();
        state.selected_certificate().map(|pair| (state.selected, pair.certificate.0.clone()))
    }

    fn cert(&self, name: &str) -> PathBuf {
        self.workspace.root().join(self.plant.controller(0).serial().as_str()).join("Cert").join(name)
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
    let (mut desk, manager) = Desk::with_legacy_controller();
    desk.set_backup();
    desk.fill_in_self_signed();
    let first = desk.certificate_in_use().unwrap();
    assert!(desk.cert("SelfSigned/1_key.pfx").is_file());
    desk.set_backup();
    desk.fill_in_self_signed();
    assert_ne!(desk.certificate_in_use(), Some(first.clone()));

    choose(&mut desk.window, &["Certificate", "Export self-signed…"]);
    desk.click("Export");
    assert!(shows(&desk.window, "and their keys, are kept: they are moved into a folder named after their date"));
    desk.click("Export");
    desk.wait_for("Completed");
    assert!(shows(&desk.window, "Former files were moved to"));
    let former = desk.former_key("SelfSigned", "1_key.pfx");
    assert!(shows(&desk.window, &former.parent().unwrap().display().to_string()));
    desk.open_folder(&manager, former.parent().unwrap());
    desk.finish("1 done");
    assert!(!desk.cert("SelfSigned/1_key.pfx").exists() && desk.cert("SelfSigned/1_cert.der").is_file());

    desk.restore(SELF_SIGNED, None, "");
    desk.wait_for("The file to be imported was not found");
    desk.click("Close");
    assert!(shows(&desk.window, "Former backups are in folders named after their date"));
    type_into(&mut desk.window, "Key file", &former.display().to_string());
    desk.click("Restore…");
    desk.wait_for("Issued to");
    assert!(shows(&desk.window, "The certificate of this type in the controller is replaced"));
    desk.click("Restore");
    desk.finish("1 done");
    assert_eq!(desk.certificate_in_use(), Some(first), "type 1, with its own key");
}

#[test]
fn a_request_comes_back_with_its_key_and_what_the_ca_issued_for_it() {
    let (mut desk, _) = Desk::with_legacy_controller();
    desk.set_backup();
    desk.make_csr();
    desk.finish("1 done");
    let csr = Csr::from_any(&fs::read(desk.cert("CSR/3_csr.der")).unwrap()).unwrap();
    fs::write(desk.cert("CASigned/from_ca.der"), Ca::new().sign(&csr)).unwrap();
    desk.click("Import…");
    desk.wait_for("Issued to");
    desk.click("Import");
    desk.finish("1 done");
    let issued = desk.certificate_in_use().unwrap();
    desk.click("Start");
    wait_until(&mut desk.window, PATIENCE, |window| shows(window, "Run"));

    // A new request stops a server that runs on the certificate, and says so first.
    choose(&mut desk.window, &["Certificate", "Create and save", "CA signed…"]);
    desk.click("Create CSR…");
    wait_until(&mut desk.window, PATIENCE, |window| is_enabled(window, "Create and save"));
    desk.click("Create and save");
    for said in ["a server that uses it stops, connected clients are cut off", "stays stopped until"] {
        assert!(shows(&desk.window, said), "{said}");
    }
    desk.click("Create CSR");
    desk.wait_for("Completed");
    assert!(shows(&desk.window, "Former files were moved to"));
    desk.finish("1 done");
    desk.click("Close");
    assert_eq!(desk.plant.controller(0).info().status, ServerStatus::Stop);
    assert!(!desk.cert("CASigned/from_ca.der").exists());

    // The one just made has a backup too, and no certificate yet.
    desk.restore(CA_SIGNED, None, "");
    desk.wait_for("CSR and key, without a certificate from the CA");
    assert!(shows(&desk.window, "The CSR in the controller and its key are replaced"));
    desk.click("Restore");
    desk.finish("1 done");

    let former = desk.former_key("CASigned", "3_key.pfx");
    desk.restore(CA_SIGNED, Some(&former), "wrong");
    desk.wait_for("The password of the private key is wrong");
    desk.click("Close");
    type_into(&mut desk.window, "Password of the file", plant::PASSWORD);
    desk.click("Restore…");
    desk.wait_for("Issued to");
    desk.click("Restore");
    desk.finish("1 done");
    assert_eq!(desk.certificate_in_use(), Some(issued));
}

#[test]
fn an_empty_connection_password_is_refused_with_its_reason() {
    let empty = || plant::Plant::without_password(1, FleetFirmware::Legacy);
    let mut desk = Desk::start(empty, listed, None, |_| FileManager::default());
    desk.click("Tick cell 1");
    desk.set_backup();
    desk.make_self_signed_refused();
    choose(&mut desk.window, &["Server settings", "Export…"]);
    assert!(shows(&desk.window, "A controller without a connection password needs a passphrase"));
    desk.click("Export");
    desk.click("Export");
    desk.wait_for("The connection password is empty and protects no file");
    assert!(shows(&desk.window, "give a passphrase"));
    desk.click("Close");
    choose(&mut desk.window, &["Server settings", "Export…"]);
    type_into(&mut desk.window, "Passphrase", "correct horse");
    desk.click("Export");
    desk.confirm_and_finish("1 done");
}

impl Desk {
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
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    desk.click("Tick cell 1");
    desk.click("Certificate");
    let item = desk.window.get_by_label("Restore backup…");
    assert!(item.accesskit_node().is_disabled());
    item.hover();
    for _ in 0..60 {
        desk.window.step();
    }
    assert!(shows(&desk.window, "Only for firmware before 8.0.0"));
}
