//! Whom a controller trusts, through the real window, against real virtual controllers and OPC UA clients over
//! loopback.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Key, Modifiers};
use opcua::types::StatusCode;
use opcua_configurator::jobs::{BasicSettingsChange, SelfSigned, SelfSignedFields, SetBasicSettings, StartServer};
use opcua_configurator::model::{ErrorCode, KeyLength, Problem, UserTokenPolicy, Validity};
use opcua_configurator::pki::Certificate;
use opcua_configurator::ui::picker::{FileKind, FilePicker, Picked, PickedSeveral};
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::Passwords as _;
use time::OffsetDateTime;

use crate::common::authority::{Application, Authority, p7b};
use crate::common::opcua_client::Client;
use crate::common::test_fleet::{self, TestFleet};
use crate::common::window::{choose, is_enabled, settle, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest, listed};

/// A person who always chooses all the files of a folder.
#[derive(Debug)]
struct WholeFolder(PathBuf);

impl FilePicker for WholeFolder {
    fn pick(&self, _kind: FileKind, _title: String, done: Picked) {
        done(Ok(None));
    }

    fn pick_several(&self, _kind: FileKind, _title: String, done: PickedSeveral) {
        let mut paths: Vec<PathBuf> = fs::read_dir(&self.0).unwrap().map(|entry| entry.unwrap().path()).collect();
        paths.sort();
        done(Ok(paths));
    }

    fn open_folder(&self, _folder: &Path) -> Result<(), Problem> {
        Err(ErrorCode::FolderNotOpened.into())
    }
}

impl WindowTest {
    /// Controllers "cell 1", "cell 2", …, all ticked; a file dialog chooses the files of `usb`.
    fn with_usb_stick(count: usize, firmware: FleetFirmware) -> Self {
        let picker = |folder: &Path| {
            fs::create_dir(folder.join("usb")).unwrap();
            WholeFolder(folder.join("usb"))
        };
        let mut app = Self::start(|| TestFleet::start(count, firmware), listed, None, picker);
        app.click("Tick all");
        app
    }

    /// The OPC UA servers run, and take anybody whose certificate they trust.
    fn running(count: usize, firmware: FleetFirmware) -> Self {
        let app = Self::with_usb_stick(count, firmware);
        let fields = SelfSignedFields {
            common_name: None,
            country: String::new(),
            state: String::new(),
            locality: String::new(),
            organisation: String::new(),
            key_length: KeyLength::Rsa2048,
            validity: Validity::try_from(1).unwrap(),
        };
        app.run(SelfSigned { fields, backup: None });
        let user_tokens = Some(BTreeSet::from([UserTokenPolicy::Anonymous]));
        app.run(SetBasicSettings {
            change: BasicSettingsChange { user_tokens, ..Default::default() },
            ..Default::default()
        });
        app.run(StartServer);
        app
    }

    fn clients(&mut self) {
        choose(&mut self.window, &["Certificate", "Client certificates…"]);
    }

    fn crls(&mut self) {
        choose(&mut self.window, &["Certificate", "CRL…"]);
    }

    fn put_on_stick(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.folder.path().join("usb").join(name);
        fs::write(&path, bytes).unwrap();
        path
    }

    fn press(&mut self, modifiers: Modifiers, key: Key) {
        self.window.key_press_modifiers(modifiers, key);
        settle(&mut self.window);
    }

    fn connect(&self, index: usize, application: &Application) -> Result<Client, StatusCode> {
        let endpoint = self.fleet.controller(index).endpoint();
        self.runtime.block_on(Client::connect(&endpoint, application))
    }

    fn is_cut_off(&self, client: Client) -> bool {
        self.runtime.block_on(client.was_cut_off())
    }

    fn is_let_in(&self, application: &Application) -> bool {
        match self.connect(0, application) {
            Ok(client) => {
                self.runtime.block_on(client.close());
                true
            }
            Err(_) => false,
        }
    }

    /// Thumbprints in the lists of a controller: trusted, issuers.
    fn held(&self, index: usize) -> [BTreeSet<String>; 2] {
        let state = self.fleet.controller(index).state();
        let trusted = state.trusted.iter().map(|listed| thumbprint(&listed.certificate.0)).collect();
        let issuers = state.issuers.iter().map(|listed| thumbprint(&listed.certificate.0)).collect();
        [trusted, issuers]
    }
}

fn thumbprint(der: &[u8]) -> String {
    Certificate::from_der(der).unwrap().thumbprint_sha1()
}

fn set(ders: &[&[u8]]) -> BTreeSet<String> {
    ders.iter().map(|der| thumbprint(der)).collect()
}

fn pem(der: &[u8]) -> String {
    Certificate::from_der(der).unwrap().to_pem()
}

#[test]
fn a_client_that_knocks_appears_is_trusted_in_one_click_and_sent_away_again_by_undo() {
    let mut app = WindowTest::running(1, FleetFirmware::Current);
    let client = Application::new("HMI line 3");
    app.clients();
    app.wait_for("No client was refused");
    assert!(app.connect(0, &client).is_err());
    // It was not asked for.
    app.wait_for("1 new");
    app.click("Tick HMI line 3");
    assert!(shows(&app.window, "Neither it nor any of its issuers is in the trust list"), "why, in plain words");
    assert!(shows(&app.window, "127.0.0.1"));
    app.click("Rejected: Trust");
    app.wait_for("1 certificate moved from Rejected to Trusted");
    assert!(shows(&app.window, "Nobody was disconnected"));
    let connected = app.connect(0, &client).unwrap_or_else(|status| panic!("{status}"));

    app.press(Modifiers::COMMAND, Key::Z);
    app.wait_for("The change was taken back");
    assert!(shows(&app.window, "HMI line 3 (127.0.0.1:"), "who was disconnected");
    assert!(app.is_cut_off(connected));
    assert!(app.connect(0, &client).is_err());
    assert!(!is_enabled(&app.window, "Undo"));
    app.click("Close");
    assert!(app.window.state().model.dialogs.is_empty());
}

#[test]
fn files_of_any_encoding_are_sorted_into_the_right_lists_after_asking() {
    let mut app = WindowTest::with_usb_stick(1, FleetFirmware::Current);
    let root = Authority::root("Plant root CA");
    let issuing = root.authority("Plant issuing CA");
    let (first, second, third) =
        (issuing.application("HMI line 1"), Application::new("HMI line 2"), Application::new("历史数据采集站"));
    app.put_on_stick("chain.p7b", p7b(&[&first.der, &issuing.der, &root.der]));
    app.put_on_stick("hmi line 2.pem", pem(&second.der));
    app.put_on_stick("历史.der", &third.der);
    app.clients();
    app.wait_for("Nobody is let in by a certificate yet");
    app.click("Trusted: Add…");
    app.wait_for("What goes where");
    assert!(shows(&app.window, "only completes the chain"));
    assert_eq!(app.held(0), [set(&[]), set(&[])], "nothing was sent yet");
    app.click("Add");
    app.wait_for("5 added");
    let expected = [set(&[&first.der, &second.der, &third.der]), set(&[&issuing.der, &root.der])];
    assert_eq!(app.held(0), expected);

    // What is there already is not sent again, and what cannot be used stops the rest.
    let wrong = app.put_on_stick("holiday.jpg", "JFIF");
    app.drop_files(&[app.folder.path().join("usb/chain.p7b"), wrong]);
    app.wait_for("is in the controller already");
    app.wait_for("The file holds no usable certificate");
    assert!(!is_enabled(&app.window, "Add"));
    app.click("Leave out: holiday.jpg");
    assert!(!is_enabled(&app.window, "Add"), "nothing of it is new");
    app.click("Cancel");

    app.click("Undo");
    app.wait_for("The change was taken back");
    assert_eq!(app.held(0), [set(&[]), set(&[])]);
}

#[test]
fn what_was_deleted_comes_back_by_the_keyboard_alone() {
    let mut app = WindowTest::running(1, FleetFirmware::Current);
    let (first, second) = (Application::new("HMI line 1"), Application::new("HMI line 2"));
    app.clients();
    app.wait_for("Nobody is let in by a certificate yet");
    let files = [app.put_on_stick("1.der", &first.der), app.put_on_stick("2.der", &second.der)];
    app.drop_files(&files);
    app.wait_for("What goes where");
    app.press(Modifiers::NONE, Key::Enter);
    app.wait_for("2 added");
    let connected = app.connect(0, &second).unwrap_or_else(|status| panic!("{status}"));

    app.press(Modifiers::NONE, Key::ArrowDown);
    app.press(Modifiers::NONE, Key::ArrowDown);
    app.press(Modifiers::NONE, Key::Enter);
    assert!(shows(&app.window, "Certificate – HMI line 2"));
    assert!(shows(&app.window, "URI:urn:HMI:line:2"));
    app.press(Modifiers::NONE, Key::Escape);
    app.press(Modifiers::NONE, Key::Delete);
    assert!(shows(&app.window, "The OPC UA server goes on running"));
    app.press(Modifiers::NONE, Key::Enter);
    app.wait_for("1 certificate deleted from Trusted");
    assert!(shows(&app.window, "HMI line 2 (127.0.0.1:"));
    assert!(app.is_cut_off(connected));
    assert_eq!(app.held(0)[0], set(&[&first.der]));
    assert!(app.is_let_in(&first));

    app.press(Modifiers::COMMAND, Key::Z);
    app.wait_for("The change was taken back");
    assert_eq!(app.held(0)[0], set(&[&first.der, &second.der]));
    assert!(app.is_let_in(&second));
}

#[test]
fn limits_are_checked_before_anything_is_sent() {
    let mut app = WindowTest::with_usb_stick(1, FleetFirmware::Legacy);
    for n in 0..11 {
        app.put_on_stick(&format!("{n}.der"), &Application::new(&format!("HMI {n}")).der);
    }
    app.clients();
    app.wait_for("Firmware before 8.0.0 has no list of issuers");
    assert!(!is_enabled(&app.window, "Issuers: Add…"));
    app.click("Trusted: Add…");
    app.wait_for("More certificates than the controller can take");
    assert!(shows(&app.window, "11 > 10"));
    assert!(!is_enabled(&app.window, "Add"));
    app.click("Leave out: 10.der");
    app.click("Add");
    app.wait_for("10 added");
    assert!(!is_enabled(&app.window, "Trusted: Add…"), "the list is full");
}

#[test]
fn many_controllers_are_added_to_each_with_its_own_result_and_all_of_it_is_taken_back() {
    let mut app = WindowTest::with_usb_stick(2, FleetFirmware::Mixed);
    let root = Authority::root("Plant root CA");
    let client = Application::new("HMI");
    let files = [app.put_on_stick("root.der", &root.der), app.put_on_stick("hmi.der", &client.der)];
    // With several ticked there is only one dialog for them.
    app.drop_files(&files);
    app.wait_for("What goes where");
    app.click("Leave out: hmi.der");
    app.click("Issuers");
    assert!(shows(&app.window, "Firmware before 8.0.0: This function needs firmware 8.0.0 or later"));
    app.click("Add");
    app.confirm_and_finish("1 done, 1 failed");
    let issuers: Vec<usize> = (0..2).map(|index| app.held(index)[1].len()).collect();
    assert_eq!(issuers.iter().sum::<usize>(), 1, "{issuers:?}");

    app.clients();
    let path = app.folder.path().join("usb/hmi.der");
    type_into(&mut app.window, "Files", &path.display().to_string());
    app.click("Read file");
    app.wait_for("What goes where");
    app.click("Add");
    app.click("Add certificates");
    app.wait_for("2 done");
    assert_eq!([app.held(0)[0].clone(), app.held(1)[0].clone()], [set(&[&client.der]), set(&[&client.der])]);
    app.click("Undo");
    app.finish("2 done");
    assert_eq!([app.held(0)[0].len(), app.held(1)[0].len()], [0, 0]);
}

#[test]
fn a_crl_takes_effect_at_once_and_so_does_its_removal() {
    let mut app = WindowTest::running(1, FleetFirmware::Current);
    let authority = Authority::root("Plant CA");
    let (good, bad) = (authority.application("HMI good"), authority.application("HMI bad"));
    let now = OffsetDateTime::now_utc();
    app.crls();
    app.wait_for("No CRLs");
    // The authority comes first: without it the issuer of the CRL is not known.
    app.click("Close");
    app.clients();
    app.wait_for("Nobody is let in by a certificate yet");
    let files = [app.put_on_stick("ca.der", &authority.der), app.put_on_stick("first.crl", authority.crl(1, &[], now))];
    app.drop_files(&files);
    app.wait_for("What goes where");
    app.click("Trusted");
    assert!(shows(&app.window, "lets in every client with a certificate from it"));
    app.click("Add");
    app.wait_for("2 added");
    app.click("Close");
    let connected = [&good, &bad].map(|client| app.connect(0, client).unwrap_or_else(|status| panic!("{status}")));
    let [kept, cut] = connected;

    app.crls();
    app.wait_for("in use (covers Plant CA)");
    for name in ["first.crl", "ca.der"] {
        fs::remove_file(app.folder.path().join("usb").join(name)).unwrap();
    }
    app.put_on_stick("second.crl", authority.crl(2, &[&bad], now));
    app.click("CRL: Add…");
    app.wait_for("replaces the older one");
    app.click("Add");
    app.wait_for("1 added");
    assert!(shows(&app.window, "HMI bad (127.0.0.1:"), "who was disconnected");
    assert!(shows(&app.window, "The authority has revoked it"), "and why");
    assert!(app.is_cut_off(cut));
    assert!(!app.is_let_in(&bad) && app.is_let_in(&good));
    app.click("Tick Plant CA");
    app.click("Details…");
    assert!(shows(&app.window, "Revoked certificates"));
    app.click("Close");

    app.click("CRL: Delete…");
    app.click("Delete");
    app.wait_for("1 CRL deleted");
    assert!(shows(&app.window, "Authorities without a usable CRL: Plant CA"));
    // Without a CRL it is not known which clients were revoked.
    assert!(app.is_cut_off(kept));
    app.press(Modifiers::COMMAND, Key::Z);
    app.wait_for("The change was taken back");
    assert!(!app.is_let_in(&bad) && app.is_let_in(&good));
}

#[test]
fn why_a_client_was_refused_is_explained_with_what_is_missing() {
    let mut app = WindowTest::running(1, FleetFirmware::Current);
    let root = Authority::root("Plant root CA");
    let issuing = root.authority("Plant issuing CA");
    let client = issuing.application("HMI");
    assert!(app.connect(0, &client).is_err());
    app.clients();
    app.wait_for("The certificate of its issuer, CN=Plant issuing CA, is missing");
    app.click("Tick HMI");
    app.click("Details…");
    assert!(shows(&app.window, "CN=Plant issuing CA"));
    assert!(shows(&app.window, "missing: add its certificate to Issuers or Trusted"));
    app.click("Close");
    let now = OffsetDateTime::now_utc();
    app.put_on_stick("chain.p7b", p7b(&[&issuing.der, &root.der]));
    app.put_on_stick("issuing.crl", issuing.crl(1, &[], now));
    app.put_on_stick("root.crl", root.crl(1, &[], now));
    app.click("Issuers: Add…");
    app.wait_for("What goes where");
    app.click("Add");
    app.wait_for("4 added");
    app.click("Rejected: Trust");
    app.wait_for("1 certificate moved from Rejected to Trusted");
    assert!(app.is_let_in(&client));
}

#[test]
fn somebody_elses_change_shows_by_itself_and_a_password_is_asked_for() {
    let mut app = WindowTest::with_usb_stick(1, FleetFirmware::Current);
    app.fleet.passwords.forget(app.fleet.controller(0).fingerprint());
    app.clients();
    app.wait_for("Connection password needed");
    type_into(&mut app.window, "Connection password", test_fleet::PASSWORD);
    app.click("OK");
    app.wait_for("Nobody is let in by a certificate yet");
    let client = Application::new("HMI of somebody else");
    app.run(opcua_configurator::jobs::AddTrust {
        files: Arc::new([opcua_configurator::jobs::TrustFile {
            file_name: "hmi.der".into(),
            bundle: opcua_configurator::pki::read_bundle(&client.der).unwrap(),
        }]),
        destination: opcua_configurator::jobs::Destination::ByKind,
        based_on: None,
    });
    app.wait_for("HMI of somebody else");
    type_into(&mut app.window, "Filter by name, issuer, address or number", "nobody of that name");
    assert!(shows(&app.window, "Nothing matches the filter"));
    assert!(!shows(&app.window, "HMI of somebody else"));
    type_into(&mut app.window, "Filter by name, issuer, address or number", "SOMEBODY");
    wait_until(&mut app.window, WAIT_LIMIT, |window| shows(window, "HMI of somebody else"));
}
