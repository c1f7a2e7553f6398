//! Files dropped onto the real window, against real virtual controllers over loopback.

use std::fs;
use std::path::PathBuf;

use egui_kittest::kittest::Queryable as _;
use opcua_configurator::model::{CertificateType, CsrRequest, KeyLength, SelfSignedRequest, Subject, Validity};
use opcua_configurator::pki::{Certificate, Csr, PrivateKey, ServerNames, make_csr, pkcs12_write, self_signed};
use opcua_configurator::ui::picker::FixedPicker;
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::Configuration;
use rcgen::{CertificateParams, CertificateRevocationListParams, Issuer, KeyIdMethod, KeyPair, SerialNumber};

use crate::common::ca::Ca;
use crate::common::plant::Plant;
use crate::common::window::{choose, is_enabled, settle, shows, type_into, wait_until};
use crate::common::window_desk::{Desk, PATIENCE, listed};

fn named(common_name: &str) -> Subject {
    Subject {
        common_name: common_name.into(),
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: String::new(),
    }
}

impl Desk {
    fn put_file(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.folder.path().join(name);
        fs::write(&path, bytes).unwrap();
        path
    }

    fn hold(&mut self, paths: &[PathBuf]) {
        let hovered = paths.iter().map(|path| egui::HoveredFile { path: Some(path.clone()), mime: String::new() });
        self.window.input_mut().hovered_files = hovered.collect();
        settle(&mut self.window);
    }

    fn has_value(&self, text: &str) -> bool {
        self.window.query_all_by_value(text).next().is_some()
    }
}

/// A key and a certificate for a controller, made with another tool.
fn other_tool(desk: &Desk, index: usize) -> (PrivateKey, Certificate) {
    let key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let info = desk.plant.controller(index).info();
    let subject = named(&info.application_name);
    let request =
        SelfSignedRequest { subject, key_length: KeyLength::Rsa2048, validity: Validity::try_from(1).unwrap() };
    let names = ServerNames {
        application_uri: format!("urn:{}", info.application_name),
        ips: vec!["127.0.0.1".parse().unwrap()],
        dns: vec![],
    };
    let certificate = self_signed(&request, &names, &key, chrono::Utc::now()).unwrap();
    (key, certificate)
}

#[test]
fn an_activation_file_is_announced_and_opens_its_dialog_also_for_one_controller() {
    let open = |plant: &Plant| listed(plant);
    let mut desk = Desk::start(|| Plant::not_activated(2), open, None, |_| FixedPicker(Ok(None)));
    let lines = desk.activation_line(0) + &desk.activation_line(1);
    // Neither the name nor the ending tells what it is.
    let file = desk.put_file("from the mail.txt", format!("OPCUA.Activation.Ver.1.0\r\n{lines}"));

    // With no controller ticked there is nobody to activate: said before and after dropping.
    desk.hold(std::slice::from_ref(&file));
    desk.wait_for("Tick at least one controller first");
    assert!(shows(&desk.window, "from the mail.txt") && shows(&desk.window, "Activation file"));
    desk.drop_files(std::slice::from_ref(&file));
    desk.wait_for("Dropped files");
    assert!(shows(&desk.window, "Tick at least one controller first") && !is_enabled(&desk.window, "Open"));
    desk.click("Close");
    assert!(desk.window.state().model.dialogs.is_empty());

    desk.tick(&["cell 2"]);
    desk.hold(std::slice::from_ref(&file));
    desk.wait_for("Opens: Activation");
    // Carried away again, nothing remains.
    desk.hold(&[]);
    assert!(!shows(&desk.window, "Opens: Activation") && desk.window.state().model.dialogs.is_empty());
    desk.drop_files(&[file]);
    desk.wait_for("Keys found for 1 of 1 controller");
    desk.click("Apply");
    desk.confirm_and_finish("1 done");
    let activated = [0, 1].map(|index| desk.plant.controller(index).info().activated);
    assert_eq!(activated, [false, true]);
}

#[test]
fn a_connection_list_opens_without_anything_ticked() {
    let mut desk = Desk::empty(1, FleetFirmware::Current);
    let address = desk.plant.controller(0).management_address();
    let file = desk.put_file("list.csv", format!("Name,Type,Address\nweld,Ethernet,{address}\n"));
    desk.drop_files(&[file]);
    desk.wait_for("Import 1 of 1 controller");
    desk.click("Import");
    assert_eq!(desk.window.state().model.rows.all().len(), 1);
}

#[test]
fn a_settings_export_from_anywhere_is_put_back() {
    let mut desk = Desk::with_controllers(2, FleetFirmware::Legacy);
    desk.tick(&["cell 1"]);
    choose(&mut desk.window, &["Server settings", "Export…"]);
    desk.click("Export");
    desk.confirm_and_finish("1 done");
    let export = desk.workspace.settings_files().path(&desk.plant.controller(0).serial());
    let elsewhere = desk.put_file("settings of cell 1.bak", fs::read(&export).unwrap());
    fs::remove_file(&export).unwrap();

    desk.tick(&["cell 2"]);
    desk.drop_files(std::slice::from_ref(&elsewhere));
    desk.wait_for("tick only that one");
    desk.click("Close");
    // Another controller's.
    desk.tick(&["cell 1"]);
    desk.drop_files(std::slice::from_ref(&elsewhere));
    desk.wait_for("Import settings – cell 2");
    desk.wait_for("Remedy");
    assert!(!is_enabled(&desk.window, "Import"));
    desk.click("Cancel");

    desk.tick(&["cell 1", "cell 2"]);
    let before = desk.plant.controller(0).info().revision.number();
    desk.drop_files(&[elsewhere]);
    desk.wait_for("settings of cell 1.bak");
    wait_until(&mut desk.window, PATIENCE, |window| is_enabled(window, "Import"));
    desk.click("Import");
    desk.confirm_and_finish("1 done");
    assert!(desk.plant.controller(0).info().revision.number() > before);
}

#[test]
fn a_certificate_goes_where_it_is_told_and_is_imported() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Legacy);
    desk.tick(&["cell 1"]);
    choose(&mut desk.window, &["Certificate", "Create and save", "CA signed…"]);
    desk.click("Create CSR…");
    wait_until(&mut desk.window, PATIENCE, |window| is_enabled(window, "Create and save"));
    desk.click("Create and save");
    desk.confirm_and_finish("1 done");
    desk.click("Close");
    let folder = desk.workspace.certificate_files().csr_folder(&desk.plant.controller(0).serial());
    let csr = Csr::from_any(&fs::read(folder.join("3_csr.der")).unwrap()).unwrap();
    let signed = Certificate::from_der(&Ca::new().sign(&csr)).unwrap();
    let file = desk.put_file("answer of the CA", signed.to_pem());

    desk.hold(std::slice::from_ref(&file));
    desk.wait_for("Several dialogs take this");
    desk.drop_files(std::slice::from_ref(&file));
    desk.wait_for("Use as");
    for part in ["CA-signed certificate", "User-specified certificate", "Client certificates"] {
        assert!(shows(&desk.window, part), "no {part:?} among the choices");
    }
    desk.click("User-specified certificate");
    desk.click("Open");
    assert!(desk.has_value(&file.display().to_string()), "the field for the certificate is filled");
    assert!(shows(&desk.window, "Key file"));
    desk.click("Cancel");

    desk.drop_files(std::slice::from_ref(&file));
    desk.wait_for("Use as");
    desk.click("CA-signed certificate");
    desk.click("Open");
    assert!(desk.has_value(&file.display().to_string()));
    desk.click("Import…");
    desk.wait_for("Plant CA");
    // Whatever clients may warn of.
    let ok = if is_enabled(&desk.window, "Import") { "Import" } else { "Import anyway" };
    desk.click(ok);
    desk.finish("1 done");
    assert_eq!(desk.in_use(0), Some(CertificateType::CaSigned));
}

#[test]
fn a_pfx_and_a_pair_of_files_fill_the_user_specified_dialog() {
    let mut desk = Desk::with_controllers(2, FleetFirmware::Mixed);
    let legacy = (0..2).find(|at| !desk.plant.controller(*at).info().firmware.to_string().starts_with('8')).unwrap();
    let name = format!("cell {}", legacy + 1);
    let other = format!("cell {}", 2 - legacy);
    let (key, certificate) = other_tool(&desk, legacy);
    let pfx = desk.put_file("x.bin", pkcs12_write("robot", &key, &[&certificate], "secret").unwrap());
    let (key_file, certificate_file) =
        (desk.put_file("k", &*key.to_pkcs8_der().unwrap()), desk.put_file("c", certificate.der()));

    // Later firmware makes its own keys.
    desk.tick(&[&other]);
    desk.drop_files(std::slice::from_ref(&pfx));
    desk.wait_for("Only for firmware before 8.0.0");
    desk.click("Close");
    desk.tick(&[&other, &name]);

    desk.drop_files(std::slice::from_ref(&pfx));
    desk.wait_for_value(&pfx.display().to_string());
    type_into(&mut desk.window, "Password of the file", "secret");
    desk.click("Import…");
    desk.wait_for("Issued to");
    desk.click("Cancel");
    desk.click("Cancel");

    // The key alone, then both in whatever order.
    desk.drop_files(std::slice::from_ref(&key_file));
    desk.wait_for_value(&key_file.display().to_string());
    desk.click("Cancel");
    desk.drop_files(&[key_file.clone(), certificate_file.clone()]);
    desk.wait_for("Use as");
    desk.click("Open");
    desk.wait_for_value(&key_file.display().to_string());
    assert!(desk.has_value(&certificate_file.display().to_string()));
    desk.click("Import…");
    desk.wait_for("Issued to");
    let ok = if is_enabled(&desk.window, "Import") { "Import" } else { "Import anyway" };
    desk.click(ok);
    desk.finish("1 done");
    assert_eq!(desk.in_use(legacy), Some(CertificateType::UserSpecified));

    // Both in one file are to be taken apart.
    let both = desk
        .put_file("both.pem", certificate.to_pem() + "-----BEGIN PRIVATE KEY-----\nMA==\n-----END PRIVATE KEY-----\n");
    desk.drop_files(&[both]);
    desk.wait_for("save them as two files");
    desk.click("Close");
}

#[test]
fn lists_requests_and_collections_say_where_they_will_go() {
    let mut desk = Desk::with_controllers(1, FleetFirmware::Current);
    desk.tick(&["cell 1"]);
    let issuer = Issuer::new(CertificateParams::default(), KeyPair::generate().unwrap());
    let now = time::OffsetDateTime::now_utc();
    let crl = CertificateRevocationListParams {
        this_update: now,
        next_update: now + time::Duration::days(30),
        crl_number: SerialNumber::from(1),
        issuing_distribution_point: None,
        revoked_certs: vec![],
        key_identifier_method: KeyIdMethod::Sha256,
    }
    .signed_by(&issuer)
    .unwrap();
    let key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let subject = named("SCADA");
    let names = ServerNames { application_uri: "urn:scada".into(), ips: vec![], dns: vec!["scada".into()] };
    let request = make_csr(&CsrRequest { subject, key_length: KeyLength::Rsa2048 }, &names, &key).unwrap();
    // There is but one dialog for it, which asks before anything is sent.
    let revoked = desk.put_file("revoked", crl.der());
    desk.drop_files(&[revoked]);
    desk.wait_for("What goes where");
    assert!(shows(&desk.window, "Add CRL"));
    desk.click("Cancel");
    desk.click("Close");
    // A request waits until there is an authority to sign it.
    let request = desk.put_file("request", request.to_pem());
    desk.drop_files(&[request]);
    desk.wait_for("Create CA…");
    desk.click("Create CA…");
    type_into(&mut desk.window, "Common name", "Plant CA");
    desk.click("2048 bits");
    type_into(&mut desk.window, "Passphrase", "correct horse");
    type_into(&mut desk.window, "Passphrase again", "correct horse");
    desk.click("Create");
    desk.wait_for("SCADA, 2048 bits");
    desk.click("Cancel");
    desk.click("Close");
    // Nothing of a collection that cannot be read is sent anywhere.
    let collection = desk.put_file("all.p7b", "-----BEGIN PKCS7-----\nMA==\n-----END PKCS7-----\n");
    desk.drop_files(&[collection]);
    desk.wait_for("Client certificates");
}

#[test]
fn what_cannot_be_used_is_said_with_its_reason() {
    let mut desk = Desk::start(
        || Plant::start(1, FleetFirmware::Current),
        |_| Configuration::default(),
        None,
        |_| FixedPicker(Ok(None)),
    );
    let picture = desk.put_file("holiday.der", b"\x89PNG\r\n\x1a\n and so on");
    let large = desk.put_file("large.csv", vec![b'x'; 9 * 1024 * 1024]);
    let empty = desk.put_file("empty.pem", "");
    let folder = desk.folder.path().join("a folder");
    fs::create_dir(&folder).unwrap();
    for (path, said) in [
        (picture.clone(), "The file is of no known kind"),
        (large, "The file is too large"),
        (empty, "The file is of no known kind"),
        (folder, "The file cannot be read"),
        (desk.folder.path().join("gone.csv"), "The file cannot be read"),
    ] {
        desk.drop_files(std::slice::from_ref(&path));
        desk.wait_for("Dropped files");
        assert!(shows(&desk.window, said), "{path:?}: no {said:?}");
        desk.click("Close");
    }

    // One good file among others: what it is for is offered, what is wrong with the others is told.
    let list = desk.put_file("list.csv", "Name,Type,Address\nweld,Ethernet,10.0.0.1\n");
    desk.drop_files(&[picture, list.clone()]);
    desk.wait_for("Use as");
    assert!(shows(&desk.window, "The file is of no known kind") && shows(&desk.window, "Only list.csv"));
    desk.click("Open");
    desk.wait_for("Import 1 of 1 controller");

    // A dialog is open: it stays as it is.
    desk.hold(std::slice::from_ref(&list));
    assert!(shows(&desk.window, "A dialog is open"));
    desk.drop_files(std::slice::from_ref(&list));
    assert!(shows(&desk.window, "A dialog is open"));
    desk.click("Close");
    assert!(shows(&desk.window, "Import 1 of 1 controller"));
    desk.click("Cancel");

    desk.drop_files(&vec![list.clone(); 101]);
    desk.wait_for("Too many files");
    desk.click("Close");
    desk.drop_files(&[list.clone(), list]);
    desk.wait_for("One file at a time");
}
