//! Server certificates through the real window, against real virtual controllers over loopback.

use std::fs;
use std::path::Path;

use egui_kittest::kittest::{NodeT as _, Queryable as _};
use opcua_configurator::jobs::{SelfSigned, SelfSignedFields};
use opcua_configurator::model::{CertificateType, KeyLength, SelfSignedRequest, Subject, Validity};
use opcua_configurator::pki::{
    Certificate, Csr, PrivateKey, ServerNames, pkcs12_write, self_signed as make_self_signed,
};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::{CertificateFiles, Passwords as _};
use rcgen::{CertificateParams, SanType};

use crate::common::ca::Ca;
use crate::common::test_fleet;
use crate::common::window::{choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest};

impl WindowTest {
    /// A plant, and a window that knows it, all ticked.
    fn with_all_ticked(count: usize, firmware: FleetFirmware) -> Self {
        let mut app = Self::with_controllers(count, firmware);
        app.click("Tick all");
        app
    }

    fn files(&self) -> CertificateFiles {
        self.workspace.certificate_files()
    }

    fn have_self_signed(&self) {
        let operation = SelfSigned { fields: fields(), backup: None };
        for report in self.runtime.block_on(self.fleet.run(operation)) {
            assert!(report.result.is_ok(), "{report:?}");
        }
    }

    /// Has all controllers make a request, by the dialog that is open.
    fn create_csr(&mut self, summary: &str) {
        self.click("Create CSR…");
        wait_until(&mut self.window, WAIT_LIMIT, |window| is_enabled(window, "Create and save"));
        type_into(&mut self.window, "Organisation", "Example");
        self.click("Create and save");
        assert!(shows(&self.window, "the present CA-signed certificate becomes invalid at once"));
        self.click("Create CSR");
        self.finish(summary);
    }

    fn csr(&self, index: usize) -> Csr {
        Csr::from_any(&fs::read(self.files().csr_folder(&self.serial(index)).join("3_csr.der")).unwrap()).unwrap()
    }

    /// Puts a certificate where the import looks for it.
    fn put_from_ca(&self, index: usize, certificate: &[u8]) {
        let folder = self.files().ca_signed_folder(&self.serial(index));
        fs::create_dir_all(&folder).unwrap();
        fs::write(folder.join("from_ca.der"), certificate).unwrap();
    }
}

fn fields() -> SelfSignedFields {
    SelfSignedFields {
        common_name: None,
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: "Example".into(),
        key_length: KeyLength::Rsa2048,
        validity: Validity::try_from(5).unwrap(),
    }
}

fn create(app: &mut WindowTest, item: &str) {
    choose(&mut app.window, &["Certificate", "Create and save", item]);
}

#[test]
fn a_ca_signs_for_two_controllers_and_the_type_is_chosen_afterwards() {
    let mut app = WindowTest::with_all_ticked(2, FleetFirmware::Mixed);
    app.have_self_signed();
    create(&mut app, "CA signed…");
    app.create_csr("2 done");
    assert!(shows(&app.window, "2. Import certificate"), "the dialog is still there");

    // One certificate is there already, for the wrong controller; the other is not.
    let ca = Ca::new();
    app.put_from_ca(0, &ca.sign(&app.csr(1)));
    app.click("Import…");
    app.wait_for("0 of 2 certificates can be imported");
    assert!(shows(&app.window, "The certificate and the CSR do not match"));
    assert!(shows(&app.window, "The file to be imported was not found"));
    assert!(!is_enabled(&app.window, "Import"));
    app.click("Cancel");

    for index in 0..2 {
        app.put_from_ca(index, &ca.sign(&app.csr(index)));
    }
    app.click("Import…");
    app.wait_for("2 of 2 certificates can be imported");
    assert!(shows(&app.window, "The OPC UA server is stopped"));
    app.click("Import");
    app.finish("2 done");
    assert!(app.window.state().model.dialogs.is_empty());
    assert_eq!([app.in_use(0), app.in_use(1)], [Some(CertificateType::CaSigned); 2]);

    choose(&mut app.window, &["Certificate", "Type select…"]);
    app.wait_for("Stored in 2 of 2 controllers");
    assert!(app.window.query_by_label("User specified").is_none(), "one of them has current firmware");
    app.click("Self-signed");
    app.click("Apply");
    app.click("Switch certificate");
    app.finish("2 done");
    assert_eq!([app.in_use(0), app.in_use(1)], [Some(CertificateType::SelfSigned); 2]);
}

#[test]
fn warnings_are_asked_about_and_errors_stop_an_import() {
    let mut app = WindowTest::with_all_ticked(1, FleetFirmware::Current);
    create(&mut app, "CA signed…");
    app.click("Import…");
    app.wait_for("The file to be imported was not found");
    app.click("Close");
    app.create_csr("1 done");
    let (ca, csr) = (Ca::new(), app.csr(0));
    let nobody = |p: &mut CertificateParams| p.subject_alt_names.retain(|name| !matches!(name, SanType::URI(_)));
    app.put_from_ca(0, &ca.sign_changed(&csr, nobody));
    app.click("Import…");
    app.wait_for("Error: It has no application URI");
    assert!(!is_enabled(&app.window, "Import"));
    app.click("Cancel");

    // By its path, as it is pasted from a file manager.
    let elsewhere = tempfile::tempdir().unwrap();
    let file = elsewhere.path().join("from the CA.der");
    let nowhere = |p: &mut CertificateParams| p.subject_alt_names.retain(|name| matches!(name, SanType::URI(_)));
    fs::write(&file, ca.sign_changed(&csr, nowhere)).unwrap();
    type_into(&mut app.window, "Certificate file", &format!(" \"{}\" ", file.display()));
    app.click("Import…");
    app.wait_for("Warning: It is for no host; the application is reached as");
    assert_eq!(app.in_use(0), None, "nothing was sent");
    app.click("Import anyway");
    app.finish("1 done");
    assert_eq!(app.in_use(0), Some(CertificateType::CaSigned));
}

#[test]
fn a_controller_that_does_not_answer_keeps_no_other_out() {
    let mut app = WindowTest::with_all_ticked(2, FleetFirmware::Current);
    app.have_self_signed();
    let forget = |app: &WindowTest| app.fleet.passwords.forget(app.fleet.controller(1).fingerprint());
    forget(&app);
    choose(&mut app.window, &["Certificate", "Type select…"]);
    app.wait_for("Connection password needed");
    app.click("Cancel");
    assert!(shows(&app.window, "Stored in 1 of 2 controllers") && shows(&app.window, "cell 2: "));
    app.click("Cancel");

    choose(&mut app.window, &["Certificate", "Type select…"]);
    app.wait_for("Connection password needed");
    type_into(&mut app.window, "Connection password", test_fleet::PASSWORD);
    app.click("OK");
    app.wait_for("Stored in 2 of 2 controllers");
    app.click("Cancel");

    // The same before an import.
    create(&mut app, "CA signed…");
    app.create_csr("2 done");
    let ca = Ca::new();
    for index in 0..2 {
        app.put_from_ca(index, &ca.sign(&app.csr(index)));
    }
    forget(&app);
    app.click("Import…");
    app.wait_for("Connection password needed");
    app.click("Cancel");
    app.wait_for("1 of 2 certificates can be imported");
    app.click("Import");
    app.finish("1 done");
    assert_eq!(
        [app.in_use(0), app.in_use(1)].map(|kind| kind.unwrap()),
        [CertificateType::CaSigned, CertificateType::SelfSigned]
    );
}

#[test]
fn a_type_that_is_not_stored_cannot_be_chosen() {
    let mut app = WindowTest::with_all_ticked(1, FleetFirmware::Legacy);
    app.have_self_signed();
    choose(&mut app.window, &["Certificate", "Type select…"]);
    app.wait_for("in use");
    app.click("User specified");
    assert!(shows(&app.window, "The controller holds no certificate of this type"));
    assert!(!is_enabled(&app.window, "Apply"));
}

#[test]
fn self_signed_certificates_are_exported() {
    let mut app = WindowTest::with_all_ticked(2, FleetFirmware::Mixed);
    app.have_self_signed();
    choose(&mut app.window, &["Certificate", "Export self-signed…"]);
    app.click("pem");
    app.click("Export");
    assert!(shows(&app.window, "are kept: they are moved into a folder named after their date"));
    app.click("Export");
    app.wait_for("Completed");
    assert!(shows(&app.window, "Saved in"));
    app.click("Copy");
    app.finish("2 done");
    for index in 0..2 {
        let pem = fs::read(app.files().self_signed_folder(&app.serial(index)).join("1_cert.pem")).unwrap();
        let summary = Certificate::from_any(&pem).unwrap().summary();
        assert_eq!(Some(summary), app.fleet.controller(index).info().certificate.map(|c| c.summary));
    }
}

/// What another tool would make for the controller.
fn made_elsewhere(app: &WindowTest) -> (PrivateKey, Certificate) {
    let info = app.fleet.controller(0).info();
    let subject = Subject {
        common_name: info.application_name.clone(),
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: "Elsewhere".into(),
    };
    let validity = Validity::try_from(2).unwrap();
    let request = SelfSignedRequest { subject, key_length: KeyLength::Rsa2048, validity };
    let application_uri = format!("urn:{}", info.application_name);
    let names = ServerNames { application_uri, ips: vec!["127.0.0.1".parse().unwrap()], dns: vec![] };
    let key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let certificate = make_self_signed(&request, &names, &key, chrono::Utc::now()).unwrap();
    (key, certificate)
}

fn write(folder: &Path, name: &str, bytes: &[u8]) -> String {
    fs::create_dir_all(folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, bytes).unwrap();
    path.display().to_string()
}

#[test]
fn a_certificate_of_another_tool_is_imported() {
    let mut app = WindowTest::with_all_ticked(1, FleetFirmware::Legacy);
    let (key, certificate) = made_elsewhere(&app);
    let pfx = pkcs12_write("robot", &key, &[&certificate], "right").unwrap();
    let folder = app.files().user_specified_folder(&app.serial(0));
    write(&folder, "robot.pfx", &pfx);
    create(&mut app, "User specified…");
    type_into(&mut app.window, "Password of the file", "wrong");
    app.click("Import…");
    app.wait_for("The password of the private key is wrong");
    app.click("Close");
    type_into(&mut app.window, "Password of the file", "right");
    app.click("Import…");
    app.wait_for("Issued to");
    app.click("Import");
    app.finish("1 done");
    assert_eq!(app.in_use(0), Some(CertificateType::UserSpecified));

    // Files that do not belong together.
    create(&mut app, "User specified…");
    app.click("Certificate and key (.der, .key)");
    let other = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let certificate = write(&folder, "robot.der", certificate.der());
    type_into(&mut app.window, "Certificate file", &certificate);
    assert!(!is_enabled(&app.window, "Import…"), "the key is missing");
    let keys = write(&folder, "robot.key", &other.to_pkcs8_der().unwrap());
    type_into(&mut app.window, "Key file", &keys);
    app.click("Import…");
    app.wait_for("are not a pair");
    app.click("Close");
    write(&folder, "robot.key", &key.to_pkcs8_der().unwrap());
    app.click("Import…");
    app.wait_for("Issued to");
    app.click("Import");
    app.finish("1 done");
}

#[test]
fn a_user_specified_certificate_is_for_one_legacy_controller() {
    let disabled = |count, firmware, why: &str| {
        let mut app = WindowTest::with_all_ticked(count, firmware);
        choose(&mut app.window, &["Certificate", "Create and save"]);
        let item = app.window.get_by_label("User specified…");
        assert!(item.accesskit_node().is_disabled());
        item.hover();
        for _ in 0..60 {
            app.window.step();
        }
        assert!(shows(&app.window, why), "{why}");
    };
    disabled(2, FleetFirmware::Legacy, "For one controller at a time");
    disabled(1, FleetFirmware::Current, "Only for firmware before 8.0.0");
}
