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
use crate::common::test_fleet::TestFleet;
use crate::common::window::{choose, is_enabled, settle, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest, listed};

fn named(common_name: &str) -> Subject {
    Subject {
        common_name: common_name.into(),
        country: String::new(),
        state: String::new(),
        locality: String::new(),
        organisation: String::new(),
    }
}

impl WindowTest {
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
fn other_tool(app: &WindowTest, index: usize) -> (PrivateKey, Certificate) {
    let key = PrivateKey::generate(KeyLength::Rsa2048).unwrap();
    let info = app.fleet.controller(index).info();
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
    let open = |fleet: &TestFleet| listed(fleet);
    let mut app = WindowTest::start(|| TestFleet::not_activated(2), open, None, |_| FixedPicker(Ok(None)));
    let lines = app.activation_line(0) + &app.activation_line(1);
    // Neither the name nor the ending tells what it is.
    let file = app.put_file("from the mail.txt", format!("OPCUA.Activation.Ver.1.0\r\n{lines}"));

    // With no controller ticked there is none to activate: said before and after dropping.
    app.hold(std::slice::from_ref(&file));
    app.wait_for("Tick at least one controller first");
    assert!(shows(&app.window, "from the mail.txt") && shows(&app.window, "Activation file"));
    app.drop_files(std::slice::from_ref(&file));
    app.wait_for("Dropped files");
    assert!(shows(&app.window, "Tick at least one controller first") && !is_enabled(&app.window, "Open"));
    app.click("Close");
    assert!(app.window.state().model.dialogs.is_empty());

    app.tick(&["cell 2"]);
    app.hold(std::slice::from_ref(&file));
    app.wait_for("Opens: Activation");
    // Carried away again, nothing remains.
    app.hold(&[]);
    assert!(!shows(&app.window, "Opens: Activation") && app.window.state().model.dialogs.is_empty());
    app.drop_files(&[file]);
    app.wait_for("Keys found for 1 of 1 controller");
    app.click("Apply");
    app.confirm_and_finish("1 done");
    let activated = [0, 1].map(|index| app.fleet.controller(index).info().activated);
    assert_eq!(activated, [false, true]);
}

#[test]
fn a_connection_list_opens_without_anything_ticked() {
    let mut app = WindowTest::empty(1, FleetFirmware::Current);
    let address = app.fleet.controller(0).management_address();
    let file = app.put_file("list.csv", format!("Name,Type,Address\nweld,Ethernet,{address}\n"));
    app.drop_files(&[file]);
    app.wait_for("Import 1 of 1 controller");
    app.click("Import");
    assert_eq!(app.window.state().model.rows.all().len(), 1);
}

#[test]
fn a_settings_export_from_anywhere_is_put_back() {
    let mut app = WindowTest::with_controllers(2, FleetFirmware::Legacy);
    app.tick(&["cell 1"]);
    choose(&mut app.window, &["Server settings", "Export…"]);
    app.click("Export");
    app.confirm_and_finish("1 done");
    let export = app.workspace.settings_files().path(&app.fleet.controller(0).serial());
    let elsewhere = app.put_file("settings of cell 1.bak", fs::read(&export).unwrap());
    fs::remove_file(&export).unwrap();

    app.tick(&["cell 2"]);
    app.drop_files(std::slice::from_ref(&elsewhere));
    app.wait_for("tick only that one");
    app.click("Close");
    // Another controller's.
    app.tick(&["cell 1"]);
    app.drop_files(std::slice::from_ref(&elsewhere));
    app.wait_for("Import settings – cell 2");
    app.wait_for("Remedy");
    assert!(!is_enabled(&app.window, "Import"));
    app.click("Cancel");

    app.tick(&["cell 1", "cell 2"]);
    let before = app.fleet.controller(0).info().revision.number();
    app.drop_files(&[elsewhere]);
    app.wait_for("settings of cell 1.bak");
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Import"));
    app.click("Import");
    app.confirm_and_finish("1 done");
    assert!(app.fleet.controller(0).info().revision.number() > before);
}

#[test]
fn a_certificate_goes_where_it_is_told_and_is_imported() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Legacy);
    app.tick(&["cell 1"]);
    choose(&mut app.window, &["Certificate", "Create and save", "CA signed…"]);
    app.click("Create CSR…");
    wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Create and save"));
    app.click("Create and save");
    app.confirm_and_finish("1 done");
    app.click("Close");
    let folder = app.workspace.certificate_files().csr_folder(&app.fleet.controller(0).serial());
    let csr = Csr::from_any(&fs::read(folder.join("3_csr.der")).unwrap()).unwrap();
    let signed = Certificate::from_der(&Ca::new().sign(&csr)).unwrap();
    let file = app.put_file("answer of the CA", signed.to_pem());

    app.hold(std::slice::from_ref(&file));
    app.wait_for("Several dialogs take this");
    app.drop_files(std::slice::from_ref(&file));
    app.wait_for("Use as");
    for part in ["CA-signed certificate", "User-specified certificate", "Client certificates"] {
        assert!(shows(&app.window, part), "no {part:?} among the choices");
    }
    app.click("User-specified certificate");
    app.click("Open");
    assert!(app.has_value(&file.display().to_string()), "the field for the certificate is filled");
    assert!(shows(&app.window, "Key file"));
    app.click("Cancel");

    app.drop_files(std::slice::from_ref(&file));
    app.wait_for("Use as");
    app.click("CA-signed certificate");
    app.click("Open");
    assert!(app.has_value(&file.display().to_string()));
    app.click("Import…");
    app.wait_for("Plant CA");
    // Warnings of clients.
    let ok = if is_enabled(&app.window, "Import") { "Import" } else { "Import anyway" };
    app.click(ok);
    app.finish("1 done");
    assert_eq!(app.in_use(0), Some(CertificateType::CaSigned));
}

#[test]
fn a_pfx_and_a_pair_of_files_fill_the_user_specified_dialog() {
    let mut app = WindowTest::with_controllers(2, FleetFirmware::Mixed);
    let legacy = (0..2).find(|at| !app.fleet.controller(*at).info().firmware.to_string().starts_with('8')).unwrap();
    let name = format!("cell {}", legacy + 1);
    let other = format!("cell {}", 2 - legacy);
    let (key, certificate) = other_tool(&app, legacy);
    let pfx = app.put_file("x.bin", pkcs12_write("robot", &key, &[&certificate], "secret").unwrap());
    let (key_file, certificate_file) =
        (app.put_file("k", &*key.to_pkcs8_der().unwrap()), app.put_file("c", certificate.der()));

    // Later firmware makes its own keys.
    app.tick(&[&other]);
    app.drop_files(std::slice::from_ref(&pfx));
    app.wait_for("Only for firmware before 8.0.0");
    app.click("Close");
    app.tick(&[&other, &name]);

    app.drop_files(std::slice::from_ref(&pfx));
    app.wait_for_value(&pfx.display().to_string());
    type_into(&mut app.window, "Password of the file", "secret");
    app.click("Import…");
    app.wait_for("Issued to");
    app.click("Cancel");
    app.click("Cancel");

    // The key alone, then both in either order.
    app.drop_files(std::slice::from_ref(&key_file));
    app.wait_for_value(&key_file.display().to_string());
    app.click("Cancel");
    app.drop_files(&[key_file.clone(), certificate_file.clone()]);
    app.wait_for("Use as");
    app.click("Open");
    app.wait_for_value(&key_file.display().to_string());
    assert!(app.has_value(&certificate_file.display().to_string()));
    app.click("Import…");
    app.wait_for("Issued to");
    let ok = if is_enabled(&app.window, "Import") { "Import" } else { "Import anyway" };
    app.click(ok);
    app.finish("1 done");
    assert_eq!(app.in_use(legacy), Some(CertificateType::UserSpecified));

    // Both in one file are to be taken apart.
    let both = app
        .put_file("both.pem", certificate.to_pem() + "-----BEGIN PRIVATE KEY-----\nMA==\n-----END PRIVATE KEY-----\n");
    app.drop_files(&[both]);
    app.wait_for("save them as two files");
    app.click("Close");
}

#[test]
fn lists_requests_and_collections_say_where_they_will_go() {
    let mut app = WindowTest::with_controllers(1, FleetFirmware::Current);
    app.tick(&["cell 1"]);
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
    let revoked = app.put_file("revoked", crl.der());
    app.drop_files(&[revoked]);
    app.wait_for("What goes where");
    assert!(shows(&app.window, "Add CRL"));
    app.click("Cancel");
    app.click("Close");
    // A request waits until there is an authority to sign it.
    let request = app.put_file("request", request.to_pem());
    app.drop_files(&[request]);
    app.wait_for("Create CA…");
    app.click("Create CA…");
    type_into(&mut app.window, "Common name", "Plant CA");
    app.click("2048 bits");
    type_into(&mut app.window, "Passphrase", "correct horse");
    type_into(&mut app.window, "Passphrase again", "correct horse");
    app.click("Create");
    app.wait_for("SCADA, 2048 bits");
    app.click("Cancel");
    app.click("Close");
    // Nothing of a collection that cannot be read is sent anywhere.
    let collection = app.put_file("all.p7b", "-----BEGIN PKCS7-----\nMA==\n-----END PKCS7-----\n");
    app.drop_files(&[collection]);
    app.wait_for("Client certificates");
}

#[test]
fn what_cannot_be_used_is_said_with_its_reason() {
    let mut app = WindowTest::start(
        || TestFleet::start(1, FleetFirmware::Current),
        |_| Configuration::default(),
        None,
        |_| FixedPicker(Ok(None)),
    );
    let picture = app.put_file("holiday.der", b"\x89PNG\r\n\x1a\n and so on");
    let large = app.put_file("large.csv", vec![b'x'; 9 * 1024 * 1024]);
    let empty = app.put_file("empty.pem", "");
    let folder = app.folder.path().join("a folder");
    fs::create_dir(&folder).unwrap();
    for (path, said) in [
        (picture.clone(), "The file is of no known kind"),
        (large, "The file is too large"),
        (empty, "The file is of no known kind"),
        (folder, "The file cannot be read"),
        (app.folder.path().join("gone.csv"), "The file cannot be read"),
    ] {
        app.drop_files(std::slice::from_ref(&path));
        app.wait_for("Dropped files");
        assert!(shows(&app.window, said), "{path:?}: no {said:?}");
        app.click("Close");
    }

    // One good file among others: what it is for is offered, what is wrong with the others is told.
    let list = app.put_file("list.csv", "Name,Type,Address\nweld,Ethernet,10.0.0.1\n");
    app.drop_files(&[picture, list.clone()]);
    app.wait_for("Use as");
    assert!(shows(&app.window, "The file is of no known kind") && shows(&app.window, "Only list.csv"));
    app.click("Open");
    app.wait_for("Import 1 of 1 controller");

    // A dialog is open: it stays as it is.
    app.hold(std::slice::from_ref(&list));
    assert!(shows(&app.window, "A dialog is open"));
    app.drop_files(std::slice::from_ref(&list));
    assert!(shows(&app.window, "A dialog is open"));
    app.click("Close");
    assert!(shows(&app.window, "Import 1 of 1 controller"));
    app.click("Cancel");

    app.drop_files(&vec![list.clone(); 101]);
    app.wait_for("Too many files");
    app.click("Close");
    app.drop_files(&[list.clone(), list]);
    app.wait_for("One file at a time");
}
