//! The small CA through the real window, against real virtual controllers over loopback.

use std::fs;

use opcua_configurator::jobs::ListTrust;
use opcua_configurator::model::{CertificateType, CsrRequest, KeyLength, Subject};
use opcua_configurator::pki::{Certificate, PrivateKey, RevocationReason, ServerNames, make_csr};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::authority::AuthorityOverview;

use crate::common::window::{choose, click, is_enabled, shows, type_into, wait_until};
use crate::common::window_desk::{Desk, PATIENCE};

const PASSPHRASE: &str = "correct horse";

impl Desk {
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
    let mut desk = Desk::with_controllers(2, FleetFirmware::Mixed);
    desk.create_ca();
    assert!(!is_enabled(&desk.window, "Sign ticked controllers…"), "nothing is ticked");
    assert!(!is_enabled(&desk.window, "Revoke…"));
    desk.click("Close");
    desk.click("Tick all");

    desk.open_ca();
    desk.wait_for("Sign ticked controllers…");
    desk.click("Sign ticked controllers…");
    assert!(shows(&desk.window, "The OPC UA server is stopped for the change") && shows(&desk.window, "cell 2"));
    assert!(!is_enabled(&desk.window, "Sign"), "the passphrase is missing");
    type_into(&mut desk.window, "Passphrase", "correct house");
    desk.click("Sign");
    desk.wait_for("The passphrase of the certificate authority is wrong");
    desk.with_passphrase("Sign");
    desk.finish("2 done");
    let issued = desk.ca().issued;
    for index in 0..2 {
        let info = desk.plant.controller(index).info();
        let in_use = info.certificate.unwrap();
        assert_eq!((in_use.kind, in_use.summary.issued_by.as_str()), (CertificateType::CaSigned, "Plant CA"));
        let issued = issued.iter().find(|issued| issued.thumbprint == in_use.summary.thumbprint).unwrap();
        assert_eq!(issued.controller.as_ref().unwrap().name.as_str(), format!("cell {}", index + 1));
        desk.wait_for(&issued.serial_number);
    }

    let first = issued[0].issued_to.clone();
    desk.click(&first);
    desk.click("Revoke…");
    assert!(shows(&desk.window, "Revoked certificates cannot be made valid again"));
    desk.click("Reason");
    desk.click("Key compromised");
    desk.with_passphrase("Revoke");
    desk.wait_for("1 revoked, number ");
    assert_eq!(desk.ca().issued[0].revoked.unwrap().reason, RevocationReason::KeyCompromise);

    desk.click("Publish CRL…");
    desk.with_passphrase("Publish");
    desk.finish("2 done");
    for report in desk.runtime.block_on(desk.plant.run(ListTrust)) {
        let lists = report.result.unwrap();
        assert_eq!(lists.crls.len(), 1);
        assert_eq!((lists.crls[0].summary.issuer.as_str(), lists.crls[0].summary.entries), ("Plant CA", 1));
        assert_eq!(lists.trusted, [], "nobody asked for that");
    }
}

#[test]
fn a_request_of_any_tool_is_signed_and_the_ca_moves_to_another_workspace() {
    let mut desk = Desk::empty(1, FleetFirmware::Current);
    desk.create_ca();
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
    let file = desk.folder.path().join("scada.csr");
    fs::write(&file, "not a request").unwrap();

    desk.click("Sign CSR file…");
    type_into(&mut desk.window, "File", &file.display().to_string());
    desk.click("Read file");
    desk.wait_for("The file has the wrong format");
    fs::write(&file, csr.to_pem()).unwrap();
    desk.click("Read file");
    desk.wait_for("SCADA, 2048 bits");
    assert!(!is_enabled(&desk.window, "Sign"), "the passphrase is missing");
    desk.with_passphrase("Sign");
    desk.wait_for("Saved as ");
    let issued = desk.ca().issued.remove(0);
    let saved = desk.ca().folder.join("issued").join(format!("{}.der", issued.serial_number));
    assert!(shows(&desk.window, &saved.display().to_string()));
    assert!(csr.matches(&Certificate::from_der(&fs::read(saved).unwrap()).unwrap()));

    // A second time is refused, and says so.
    desk.click("Sign CSR file…");
    type_into(&mut desk.window, "File", &file.display().to_string());
    desk.window.key_press(egui::Key::Enter);
    desk.wait_for("SCADA, 2048 bits");
    desk.with_passphrase("Sign");
    desk.wait_for("There is a valid certificate for this request");
    desk.click("Cancel");

    let backup = desk.folder.path().join("ca.backup").display().to_string();
    desk.click("Back up…");
    type_into(&mut desk.window, "File", &backup);
    desk.with_passphrase("Back up");
    desk.wait_for("Saved as ");
    desk.click("Close");
    let before = desk.ca();
    fs::remove_dir_all(&before.folder).unwrap();
    desk.open_ca();
    desk.wait_for("Restore backup…");
    desk.click("Restore backup…");
    type_into(&mut desk.window, "File", &backup);
    desk.with_passphrase("Restore");
    wait_until(&mut desk.window, PATIENCE, |window| shows(window, "Plant CA, 2048 bits"));
    assert_eq!(desk.ca(), before);
}

#[test]
fn a_ca_that_is_damaged_or_in_use_says_so() {
    let mut desk = Desk::empty(1, FleetFirmware::Current);
    desk.create_ca();
    let held = desk.workspace.authority().open(&PASSPHRASE.into()).unwrap();
    desk.click("Publish CRL…");
    assert!(shows(&desk.window, "Tick controllers to send it to them as well"));
    desk.with_passphrase("Publish");
    desk.wait_for("The certificate authority is in use");
    drop(held);
    desk.click("Publish");
    wait_until(&mut desk.window, PATIENCE, |window| !shows(window, "Passphrase"));
    click(&mut desk.window, "Close");
    fs::write(desk.workspace.authority().folder().join("ca.json"), "{").unwrap();
    desk.open_ca();
    desk.wait_for("The files of the certificate authority are damaged");
}
