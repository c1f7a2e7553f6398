//! Connecting to controllers as an OPC UA client, through the real window.

use opcua_configurator::jobs::{AddUser, SelfSigned, SelfSignedFields, SetSettings, SettingsChange, StartServer};
use opcua_configurator::model::{Credential, KeyLength, SecurityPolicy, UserPassword, UserTokenPolicy, Validity};
use opcua_configurator::virtual_controller::FleetFirmware;

use crate::common::window::{choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_desk::{Desk, PATIENCE};

impl Desk {
    /// Controllers whose servers run, with a user.
    fn with_servers(count: usize, policies: &[SecurityPolicy]) -> Self {
        let desk = Self::with_controllers(count, FleetFirmware::Mixed);
        let change = SettingsChange {
            security_policies: Some(policies.iter().copied().collect()),
            user_tokens: Some(UserTokenPolicy::ALL.into()),
            ..SettingsChange::default()
        };
        desk.run(SetSettings { change, ..SetSettings::default() });
        desk.run(SelfSigned {
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
            Credential { name: "operator1".parse().unwrap(), password: UserPassword::new("Passw0rd1").unwrap() };
        desk.run(AddUser { credential, based_on: None });
        desk.run(StartServer);
        desk
    }

    /// Until the reports are there.
    fn wait_for_reports(&mut self) {
        wait_until(&mut self.window, PATIENCE, |window| {
            window.state().model.job.is_none() && is_enabled(window, "Verify again")
        });
    }

    fn trusted(&self) -> usize {
        (0..2).map(|index| self.plant.controller(index).state().trusted.len()).sum()
    }
}

#[test]
fn what_fails_is_explained_mended_and_verified_again() {
    let mut desk = Desk::with_servers(2, &[SecurityPolicy::None, SecurityPolicy::Basic256Sha256]);
    desk.tick(&["cell 1", "cell 2"]);
    choose(&mut desk.window, &["Tools", "Verify"]);
    desk.wait_for_reports();
    for words in [
        "Not everything works",
        "1 work, 2 do not, 3 not tried",
        "a careful client accepts it",
        "The server does not trust the certificate of this configurator",
        "None is offered: whoever listens reads everything",
        "Not tried: give a user name",
    ] {
        assert!(shows(&desk.window, words), "{words}");
    }

    desk.click("Trust this configurator…");
    assert!(shows(&desk.window, "is put into Trusted and stays there"));
    assert_eq!(desk.trusted(), 0, "asked first");
    desk.click("Trust");
    wait_until(&mut desk.window, PATIENCE, |window| window.state().model.job.is_none());
    assert_eq!(desk.trusted(), 2);

    type_into(&mut desk.window, "User name", "operator1");
    assert!(!is_enabled(&desk.window, "Verify again"), "half a login");
    type_into(&mut desk.window, "Password", "Passw0rd1");
    desk.click("Verify again");
    desk.wait_for_reports();
    assert!(shows(&desk.window, "Everything tried works"));
    for words in ["Not everything works", "Not tried", "Trust this configurator…"] {
        assert!(!shows(&desk.window, words), "{words}");
    }
    desk.click("Close");
    assert!(desk.window.state().model.dialogs.is_empty());
}

#[test]
fn a_change_that_starts_the_server_again_can_be_verified() {
    let mut desk = Desk::with_servers(1, &[SecurityPolicy::None]);
    desk.tick(&["cell 1"]);
    let settings = |desk: &mut Desk| {
        choose(&mut desk.window, &["Server settings", "Basic settings…"]);
        wait_until(&mut desk.window, PATIENCE, |window| is_enabled(window, "Apply"));
        desk.click("Apply");
        desk.click("Change settings");
    };
    settings(&mut desk);
    desk.wait_for("Completed");
    desk.click("Verify");
    desk.wait_for_reports();
    assert!(shows(&desk.window, "Everything tried works"));
    desk.click("Close");

    choose(&mut desk.window, &["Options", "Options…"]);
    desk.click("Verify when the server has started again");
    desk.click("Close");
    desk.wait_until_saved(|configuration| configuration.options.verify_after_changes);
    settings(&mut desk);
    desk.wait_for_reports();
    assert!(shows(&desk.window, "Everything tried works"), "by itself");
    desk.click("Close");
}

#[test]
fn a_controller_that_cannot_be_asked_does_not_keep_the_others_out() {
    let mut desk = Desk::with_servers(2, &[SecurityPolicy::None]);
    desk.runtime.block_on(desk.plant.controller(0).shutdown());
    desk.tick(&["cell 1", "cell 2"]);
    choose(&mut desk.window, &["Tools", "Verify"]);
    desk.wait_for_reports();
    desk.click("cell 1");
    assert!(shows(&desk.window, "cannot be reached") || shows(&desk.window, "does not answer"));
    desk.click("cell 2");
    assert!(shows(&desk.window, "opc.tcp://127.0.0.1:"));
    desk.click("Close");
    desk.click("Tick cell 2");
    choose(&mut desk.window, &["Tools", "Verify"]);
    wait_until(&mut desk.window, PATIENCE, |window| window.state().model.job.is_none());
    assert!(!shows(&desk.window, "Verify again"), "there is nothing to look at");
}
