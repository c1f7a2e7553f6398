//! The program is started while its window is open already.

use std::process::Command;
use std::time::Duration;

use egui::ViewportCommand;
use opcua_configurator::virtual_controller::FleetFirmware;
use serde_json::{Value, json};

use crate::common::process::{Finished, Running};
use crate::common::window_test::{WAIT_LIMIT, WindowTest};

/// As from the start menu: no display is needed to show a window that is there.
fn start_again(app: &WindowTest, arguments: &[&str]) -> Finished {
    let mut program = Command::new(env!("CARGO_BIN_EXE_opcua-configurator"));
    program.arg("--workspace").arg(app.workspace.root()).args(arguments);
    for display in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        program.env_remove(display);
    }
    Running::start(&mut program).unwrap().finish(WAIT_LIMIT)
}

impl WindowTest {
    /// Frames until the window has told its desktop this.
    fn wait_for_command(&mut self, wanted: impl Fn(&ViewportCommand) -> bool) {
        let until = std::time::Instant::now() + WAIT_LIMIT;
        loop {
            self.window.step();
            let viewports = &self.window.output().viewport_output;
            if viewports.values().any(|viewport| viewport.commands.iter().any(&wanted)) {
                return;
            }
            assert!(std::time::Instant::now() < until, "the window does not come to the front");
            std::thread::sleep(Duration::from_millis(10));
        }
    }
}

#[test]
fn a_second_start_brings_the_window_to_the_front() {
    let mut app = WindowTest::empty(1, FleetFirmware::Current);
    let finished = start_again(&app, &["--json"]);
    assert_eq!(finished.code, Some(0), "{}", finished.stderr);
    let line: Value = serde_json::from_str(&finished.stdout).unwrap();
    assert_eq!(line, json!({ "ok": true, "result": { "window": "shown" } }));
    // A minimised window is restored before it can take the focus.
    app.wait_for_command(|command| *command == ViewportCommand::Minimized(false));
    app.wait_for_command(|command| *command == ViewportCommand::Focus);
    // Again, in words.
    let finished = start_again(&app, &["--lang", "en"]);
    assert_eq!(finished.code, Some(0));
    assert!(finished.stdout.contains("its window was brought to the front"), "{}", finished.stdout);
    app.wait_for_command(|command| *command == ViewportCommand::Focus);
}

#[test]
fn a_closed_window_leaves_nothing_that_answers() {
    let app = WindowTest::empty(1, FleetFirmware::Current);
    let WindowTest { window, fleet: _fleet, runtime: _runtime, workspace, folder: _folder } = app;
    drop(window);
    assert!(!workspace.root().join(".window").exists());
    assert!(opcua_configurator::workspace::show_running_window(workspace.root()).is_err());
    assert!(workspace.lock().is_ok());
}
