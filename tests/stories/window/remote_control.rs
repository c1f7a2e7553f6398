//! Remote control of a virtual controller, through the real window.

use std::fs;

use opcua_configurator::model::{FirmwareGeneration, StatusFlag};
use opcua_configurator::remote::{Command, Password};
use opcua_configurator::ui::{RemoteForm, RemoteLink, RemoteSection, WhyNot};
use opcua_configurator::virtual_controller::cell::{IoDirection, find_bit, io_ports};
use opcua_configurator::virtual_controller::remote::RemoteOptions;

use crate::common::window::{choose, is_enabled, shows, type_into, wait_until};
use crate::common::window_test::{WAIT_LIMIT, WindowTest};

impl WindowTest {
    /// A controller that answers remote commands as text and in frames.
    fn with_remote_password(password: &str) -> Self {
        let password = Password::new(password).unwrap();
        let options = RemoteOptions { text_port: Some(0), frames_port: Some(0), password, ..RemoteOptions::default() };
        Self::with_remote(1, options)
    }

    /// Opens the dialog and types where the text form is answered.
    fn open_remote(&mut self) {
        self.tick(&["cell 1"]);
        choose(&mut self.window, &["Tools", "Remote control…"]);
        let address = self.fleet.controller(0).remote().text_address().unwrap();
        assert!(self.remote().target.ends_with(":5000"), "the port of real controllers is proposed");
        type_into(&mut self.window, "Connection", &format!("tcp://{address}"));
    }

    fn remote(&mut self) -> &mut RemoteForm {
        self.window.state_mut().model.dialog::<RemoteForm>().expect("the dialog is open")
    }

    fn wait_for_remote(&mut self, holds: impl Fn(&RemoteForm) -> bool) {
        wait_until(&mut self.window, WAIT_LIMIT, |window| window.state().model.top::<RemoteForm>().is_some_and(&holds));
    }

    fn wait_for_flag(&mut self, flag: StatusFlag) {
        self.wait_for_remote(|form| form.status.is_some_and(|status| status.flags.contains(flag)));
    }

    fn allow_commands(&mut self) {
        self.click("Allow commands…");
        assert!(shows(&self.window, "Robots may move at once"));
        self.click("Allow");
    }
}

#[test]
fn a_controller_is_watched_and_its_program_is_stopped_and_started_only_when_that_is_allowed() {
    let mut app = WindowTest::with_remote_password("");
    app.open_remote();
    app.click("Connect");
    app.wait_for_remote(|form| form.link == RemoteLink::Live && form.status.is_some());
    app.wait_for("Auto: On");
    app.wait_for_remote(|form| form.identity.as_ref().is_some_and(|identity| identity.serial.is_some()));
    let serial = app.serial(0).to_string();
    assert!(shows(&app.window, &serial));
    // The program of the cell starts two seconds after power-on.
    app.wait_for_flag(StatusFlag::Running);
    assert!(!is_enabled(&app.window, "Stop"), "monitoring only");
    assert_eq!(app.remote().why_not(Command::Stop), Some(WhyNot::MonitoringOnly));

    app.allow_commands();
    assert!(shows(&app.window, "Commands are allowed"));
    assert!(is_enabled(&app.window, "Stop") && !is_enabled(&app.window, "Start"), "a task runs");
    app.click("Stop");
    app.wait_for("Stop: done");
    app.wait_for_flag(StatusFlag::Ready);
    assert!(is_enabled(&app.window, "Start") && !is_enabled(&app.window, "Pause"));
    app.click("Start");
    app.wait_for("Start: done");
    app.wait_for_flag(StatusFlag::Running);
    app.click("Close");

    choose(&mut app.window, &["Tools", "Remote control…"]);
    assert!(!app.remote().may_act() && app.remote().link == RemoteLink::Off, "opened again, it is off");
}

#[test]
fn a_wrong_password_is_told_and_the_right_one_connects() {
    let mut app = WindowTest::with_remote_password("secret");
    app.open_remote();
    type_into(&mut app.window, "Password", "guess");
    app.click("Connect");
    app.wait_for("The password for remote commands is wrong");
    type_into(&mut app.window, "Password", "secret");
    app.click("Connect");
    app.wait_for_remote(|form| form.link == RemoteLink::Live);
    app.click("Log");
    app.wait_for("Save…");
    let log = app.remote().log.written(Default::default());
    assert!(!log.contains("secret") && !log.contains("guess"), "{log}");
    app.click("Save…");
    app.click("Save");
    wait_until(&mut app.window, WAIT_LIMIT, |window| {
        window.state().model.status.as_ref().is_some_and(|status| status.starts_with("Saved in"))
    });
    let status = app.window.state().model.status.clone().unwrap();
    let saved = fs::read_to_string(status.trim_start_matches("Saved in ")).unwrap();
    assert!(saved.contains("$Login,***<0D><0A>\t24 4C 6F 67 69 6E"), "{saved}");
}

#[test]
fn the_connection_is_lost_with_the_controllers_power_and_commands_have_to_be_allowed_again() {
    let mut app = WindowTest::with_remote_password("");
    app.open_remote();
    app.click("Connect");
    app.wait_for_remote(|form| form.link == RemoteLink::Live && form.status.is_some());
    app.allow_commands();
    app.runtime.block_on(app.fleet.controller(0).remote().stop());
    app.wait_for_remote(|form| matches!(form.link, RemoteLink::Lost(_)));
    assert!(!app.remote().may_act());
    assert!(shows(&app.window, "before the connection was lost"));
    assert!(!is_enabled(&app.window, "Allow commands…"));
    app.click("Disconnect");
    assert!(is_enabled(&app.window, "Connect"));
}

#[test]
fn outputs_memory_variables_and_spel_commands_reach_the_cell() {
    let mut app = WindowTest::with_remote_password("");
    app.open_remote();
    app.click("Connect");
    app.wait_for_remote(|form| form.link == RemoteLink::Live && form.status.is_some());
    app.allow_commands();
    app.wait_for_flag(StatusFlag::Running);
    app.click("Stop");
    app.wait_for_flag(StatusFlag::Ready);

    app.click("I/O");
    app.wait_for_remote(|form| form.io.bit(0).is_some());
    app.click("Memory I/O");
    app.wait_for("Bit 5: off");
    app.click("Bit 5: off");
    app.wait_for("Bit 5: on");
    app.click("Outputs");
    assert!(shows(&app.window, "Bit 3: not known"));
    app.click("Bit 3: not known");
    app.wait_for("Bit 3: on");
    let (port, offset) = find_bit(io_ports(FirmwareGeneration::Current), IoDirection::Output, 3).unwrap();
    assert!(app.fleet.controller(0).cell().snapshot().io.bit(port, offset));

    app.click("Execute");
    type_into(&mut app.window, "Command of SPEL+", "Print 6 * 7");
    app.window.key_press(egui::Key::Enter);
    app.wait_for_remote(|form| {
        let last = form.execute.history().next().and_then(|last| last.result.clone());
        last.is_some_and(|result| result.is_ok_and(|text| text.is_some_and(|text| text.contains("42"))))
    });
    assert_eq!(app.remote().section, RemoteSection::Execute);
}
