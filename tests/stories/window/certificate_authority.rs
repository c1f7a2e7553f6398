//! The small CA through the real window, against real virtual controllers over loopback.

use std::fs;

use opcua_configurator::jobs::ListTrust;
use opcua_configurator::model::{CertificateType, CsrRequest, KeyLength, Subject};
use opcua_configurator::pki::{Certificate, PrivateKey, RevocationReason, ServerNames, make_csr};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::authority::AuthorityOverview;

use crate::common::window::{choose, click, is_enabled, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest};

const PASSPHRASE: &str = "correct horse";

impl WindowTest {
    fn open_ca(&mut self) {
        choose(&mut self.window, &["Tools", "Certificate authority…"]);
    }

    fn create_ca(&mut self) {
        self.open_ca();
        self.wait_for("This workspace has no certificate authority yet");
        self.click("Create CA…");
        type_into(&mut self.window, "Common name", "Plant CA");
        self.click("2048 bits");
        type_into(&mut self.window, "Passphrase", PASSPHRASE);
        type_into(&mut self.window, "Passphrase again", PASSPHRASE);
        self.click("Create");
        self.wait_for("No certificate has been issued yet");
    }

    /// Types the passphrase into the dialog on top, and presses its main button.
    fn with_passphrase(&mut self, button: &str) {
        type_into(&mut self.window, "Passphrase", PASSPHRASE);
        self.click(button);
    }

    fn ca(&self) -> AuthorityOverview {
        self.workspace.authority().overview().unwrap()
    }
}

#[test]
fn from_nothing_to_ca_signed_controllers_that_know_what_was_revoked() {
    let mut app = WindowTest::with_controllers(2, FleetFirmware::Mixed);
    app.create_ca();
    assert!(!is_enabled(&app.window, "Sign ticked controllers…"), "nothing is ticked");
    assert!(!is_enabled(&app.window, "Revoke…"));
    app.click("Close");
    app.click("Tick all");

    app.open_ca();
    app.wait_for("Sign ticked controllers…");
    app.click("Sign ticked controllers…");
    assert!(shows(&app.window, "The OPC UA server is stopped for the change") && shows(&app.window, "cell 2"));
    assert!(!is_enabled(&app.window, "Sign"), "the passphrase is missing");
    type_into(&mut app.window, "Passphrase", "correct house");
    app.click("Sign");
    app.wait_for("The passphrase of the certificate authority is wrong");
    app.with_passphrase("Sign");
    app.finish("2 done");
    let issued = app.ca().issued;
    for index in 0..2 {
        let info = app.fleet.controller(index).info();
        let in_use = info.certificate.unwrap();
        assert_eq!((in_use.kind, in_use.summary.issued_by.as_str()), (CertificateType::CaSigned, "Plant CA"));
        let issued = issued.iter().find(|issued| issued.thumbprint == in_use.summary.thumbprint).unwrap();
        assert_eq!(issued.controller.as_ref().unwrap().name.as_str(), format!("cell {}", index + 1));
        app.wait_for(&issued.serial_number);
    }

    let first = issued[0].issued_to.clone();
    app.click(&first);
    app.click("Revoke…");
    assert!(shows(&app.window, "Revoked certificates cannot be made valid again"));
    app.click("Reason");
    app.click("Key compromised");
    app.with_passphrase("Revoke");
    app.wait_for("1 revoked, number ");
    assert_eq!(app.ca().issued[0].revoked.unwrap().reason, RevocationReason::KeyCompromise);

    app.click("Publish CRL…");
    app.with_passphrase("Publish");
    app.finish("2 done");
    for report in app.runtime.block_on(app.fleet.run(ListTrust)) {
        let lists = report.result.unwrap();
        assert_eq!(lists.crls.len(), 1);
        assert_eq!((lists.crls[0].summary.issuer.as_str(), lists.crls[0].summary.entries), ("Plant CA", 1));
        assert_eq!(lists.trusted, [], "nobody asked for that");
    }
}

#[test]
fn a_request_of_any_tool_is_signed_and_the_ca_moves_to_another_workspace() {
    let mut app = WindowTest::empty(1, FleetFirmware::Current);
    app.create_ca();
    let key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let subject = Subject {
        common_name: "SCADA".into(),
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: String::new(),
    };
    let names = ServerNames { application_uri: "urn:scada".into(), ips: vec![], dns: vec!["scada".into()] };
    let csr = make_csr(&CsrRequest { subject, key_length: KeyLength::Rsa2048 }, &names, &key).unwrap();
    let file = app.folder.path().join("scada.csr");
    fs::write(&file, "not a request").unwrap();

    app.click("Sign CSR file…");
    type_into(&mut app.window, "File", &file.display().to_string());
    app.click("Read file");
    app.wait_for("The file has the wrong format");
    fs::write(&file, csr.to_pem()).unwrap();
    app.click("Read file");
    app.wait_for("SCADA, 2048 bits");
    assert!(!is_enabled(&app.window, "Sign"), "the passphrase is missing");
    app.with_passphrase("Sign");
    app.wait_for("Saved as ");
    let issued = app.ca().issued.remove(0);
    let saved = app.ca().folder.join("issued").join(format!("{}.der", issued.serial_number));
    assert!(shows(&app.window, &saved.display().to_string()));
    assert!(csr.matches(&Certificate::from_der(&fs::read(saved).unwrap()).unwrap()));

    // A second time is refused, and says so.
    app.click("Sign CSR file…");
    type_into(&mut app.window, "File", &file.display().to_string());
    app.window.key_press(egui::Key::Enter);
    app.wait_for("SCADA, 2048 bits");
    app.with_passphrase("Sign");
    app.wait_for("There is a valid certificate for this request");
    app.click("Cancel");

    let backup = app.folder.path().join("ca.backup").display().to_string();
    app.click("Back up…");
    type_into(&mut app.window, "File", &backup);
    app.with_passphrase("Back up");
    app.wait_for("Saved as ");
    app.click("Close");
    let before = app.ca();
    fs::remove_dir_all(&before.folder).unwrap();
    app.open_ca();
    app.wait_for("Restore backup…");
    app.click("Restore backup…");
    type_into(&mut app.window, "File", &backup);
    app.with_passphrase("Restore");
    wait_until(&mut app.window, WAIT_LIMIT, |window| shows(window, "Plant CA, 2048 bits"));
    assert_eq!(app.ca(), before);
}

#[test]
fn a_ca_that_is_damaged_or_in_use_says_so() {
    let mut app = WindowTest::empty(1, FleetFirmware::Current);
    app.create_ca();
    let held = app.workspace.authority().open(&PASSPHRASE.into()).unwrap();
    app.click("Publish CRL…");
    assert!(shows(&app.window, "Tick controllers to send it to them as well"));
    app.with_passphrase("Publish");
    app.wait_for("The certificate authority is in use");
    drop(held);
    app.click("Publish");
    wait_until(&mut app.window, WAIT_LIMIT, |window| !shows(window, "Passphrase"));
    click(&mut app.window, "Close");
    fs::write(app.workspace.authority().folder().join("ca.json"), "{").unwrap();
    app.open_ca();
    app.wait_for("The files of the certificate authority are damaged");
}
