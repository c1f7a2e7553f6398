//! Connecting to controllers as an OPC UA client, through the real window.

use opcua_configurator::model::SecurityPolicy;
use opcua_configurator::virtual_controller::FleetFirmware;

use crate::common::window::{choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest};

impl WindowTest {
    /// Until the reports are there.
    fn wait_for_reports(&mut self) {
        wait_until(&mut self.window, WAIT_LIMIT, |window| {
            window.state().model.job.is_none() && is_enabled(window, "Verify again")
        });
    }

    fn trusted(&self) -> usize {
        (0..2).map(|index| self.fleet.controller(index).state().trusted.len()).sum()
    }
}

#[test]
fn what_fails_is_explained_mended_and_verified_again() {
    let mut app =
        WindowTest::with_servers(2, FleetFirmware::Mixed, &[SecurityPolicy::None, SecurityPolicy::Basic256Sha256]);
    app.tick(&["cell 1", "cell 2"]);
    choose(&mut app.window, &["Tools", "Verify"]);
    app.wait_for_reports();
    for words in [
        "Not everything works",
        "1 work, 2 do not, 3 not tried",
        "a careful client accepts it",
        "The server does not trust the certificate of this configurator",
        "None is offered: whoever listens reads everything",
        "Not tried: give a user name",
    ] {
        assert!(shows(&app.window, words), "{words}");
    }

    app.click("Trust this configurator…");
    assert!(shows(&app.window, "is put into Trusted and stays there"));
    assert_eq!(app.trusted(), 0, "asked first");
    app.click("Trust");
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.job.is_none());
    assert_eq!(app.trusted(), 2);

    type_into(&mut app.window, "User name", "operator1");
    assert!(!is_enabled(&app.window, "Verify again"), "half a login");
    type_into(&mut app.window, "Password", "Passw0rd1");
    app.click("Verify again");
    app.wait_for_reports();
    assert!(shows(&app.window, "Everything tried works"));
    for words in ["Not everything works", "Not tried", "Trust this configurator…"] {
        assert!(!shows(&app.window, words), "{words}");
    }
    app.click("Close");
    assert!(app.window.state().model.dialogs.is_empty());
}

#[test]
fn a_change_that_starts_the_server_again_can_be_verified() {
    let mut app = WindowTest::with_servers(1, FleetFirmware::Mixed, &[SecurityPolicy::None]);
    app.tick(&["cell 1"]);
    let settings = |app: &mut WindowTest| {
        choose(&mut app.window, &["Server settings", "Basic settings…"]);
        wait_until(&mut app.window, WAIT_LIMIT, |window| is_enabled(window, "Apply"));
        app.click("Apply");
        app.click("Change settings");
    };
    settings(&mut app);
    app.wait_for("Completed");
    app.click("Verify");
    app.wait_for_reports();
    assert!(shows(&app.window, "Everything tried works"));
    app.click("Close");

    choose(&mut app.window, &["Options", "Options…"]);
    app.click("Verify when the server has started again");
    app.click("Close");
    app.wait_until_saved(|configuration| configuration.options.verify_after_changes);
    settings(&mut app);
    app.wait_for_reports();
    assert!(shows(&app.window, "Everything tried works"), "by itself");
    app.click("Close");
}

#[test]
fn a_controller_that_cannot_be_asked_does_not_keep_the_others_out() {
    let mut app = WindowTest::with_servers(2, FleetFirmware::Mixed, &[SecurityPolicy::None]);
    app.runtime.block_on(app.fleet.controller(0).shutdown());
    app.tick(&["cell 1", "cell 2"]);
    choose(&mut app.window, &["Tools", "Verify"]);
    app.wait_for_reports();
    app.click("cell 1");
    assert!(shows(&app.window, "cannot be reached") || shows(&app.window, "does not answer"));
    app.click("cell 2");
    assert!(shows(&app.window, "opc.tcp://127.0.0.1:"));
    app.click("Close");
    app.click("Tick cell 2");
    choose(&mut app.window, &["Tools", "Verify"]);
    wait_until(&mut app.window, WAIT_LIMIT, |window| window.state().model.job.is_none());
    assert!(!shows(&app.window, "Verify again"), "there is nothing to look at");
}
