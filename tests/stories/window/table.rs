//! The table of controllers by mouse and keyboard: details, context menu, order of columns, command palette.

use egui::{Event, Key, Modifiers, PointerButton, Pos2};
use egui_kittest::kittest::Queryable as _;
use opcua_configurator::ui::BackupDialog;
use opcua_configurator::ui::DeleteControllersDialog;
use opcua_configurator::ui::backend::{Backend, RecordingBackend};
use opcua_configurator::ui::model::Column;
use opcua_configurator::virtual_controller::FleetFirmware;
use opcua_configurator::workspace::Workspace;

use crate::common::samples::configuration;
use crate::common::window::{SIZE, Window, choose, click, is_enabled, now, settle, shows, wait_until, window};
use crate::common::window_test::{WAIT_LIMIT, WindowTest};

/// The first has current firmware, the second legacy firmware.
const CURRENT: &str = "Weld 1";
const LEGACY: &str = "Weld 2";

fn open() -> Window<RecordingBackend> {
    window(RecordingBackend::default(), configuration(12, now()), SIZE)
}

fn place<B: Backend>(window: &Window<B>, label: &str) -> Pos2 {
    window.query_all_by_label(label).next().unwrap_or_else(|| panic!("no {label:?}")).rect().center()
}

/// Presses and releases a mouse button so often, each click in a frame of its own.
fn press<B: Backend>(window: &mut Window<B>, pos: Pos2, button: PointerButton, times: usize) {
    for _ in 0..times {
        let at = |pressed| Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE };
        window.input_mut().events.extend([Event::PointerMoved(pos), at(true), at(false)]);
        window.step();
    }
    settle(window);
}

fn key<B: Backend>(window: &mut Window<B>, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    settle(window);
}

fn ticked<B: Backend>(window: &Window<B>) -> Vec<String> {
    let rows = &window.state().model.rows;
    rows.names(&rows.ticked())
}

#[test]
fn a_double_click_opens_the_details_and_ticks_nothing() {
    let mut window = open();
    let row = place(&window, LEGACY);
    press(&mut window, row, PointerButton::Primary, 2);
    assert!(ticked(&window).is_empty());
    for text in ["Issued to", "EpsonRC.SN0001460", "Firmware", "7.5.54", "No job since the window was opened"] {
        assert!(shows(&window, text), "{text}");
    }
    key(&mut window, Modifiers::NONE, Key::ArrowUp);
    assert!(shows(&window, "EpsonRC.SN0000123"), "the pane follows the cursor");
    click(&mut window, "Close");
    assert!(!shows(&window, "Issued to"));
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(shows(&window, "Issued to"), "Enter opens them for the row under the cursor");
    let remembered = window.state().model.configuration();
    let again = self::window(RecordingBackend::default(), remembered, SIZE);
    assert!(shows(&again, "Choose a controller"), "the pane is open after a restart");
}

#[test]
fn the_menu_of_a_row_acts_on_that_row_or_on_all_that_are_ticked() {
    let mut window = open();
    click(&mut window, &format!("Tick {CURRENT}"));
    let row = place(&window, LEGACY);
    press(&mut window, row, PointerButton::Secondary, 1);
    assert!(shows(&window, "Only Weld 2"));
    click(&mut window, "Delete…");
    assert_eq!(window.state().model.top::<DeleteControllersDialog>().unwrap().names, [LEGACY]);
    click(&mut window, "Cancel");
    assert_eq!(ticked(&window), [CURRENT], "the ticks are as before");

    click(&mut window, &format!("Tick {LEGACY}"));
    press(&mut window, row, PointerButton::Secondary, 1);
    assert!(shows(&window, "All 2 ticked controllers"));
    click(&mut window, "Delete…");
    assert_eq!(window.state().model.top::<DeleteControllersDialog>().unwrap().names.len(), 2);
}

#[test]
fn the_menu_of_a_row_opens_with_the_keyboard_and_offers_what_fits_the_row() {
    let mut window = open();
    for _ in 0..2 {
        key(&mut window, Modifiers::NONE, Key::ArrowDown);
    }
    key(&mut window, Modifiers::SHIFT, Key::F10);
    assert!(shows(&window, "Only Weld 2"));
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!shows(&window, "Only Weld 2"));
    for (row, offered) in [(CURRENT, false), (LEGACY, true)] {
        let at = place(&window, row);
        press(&mut window, at, PointerButton::Secondary, 1);
        choose(&mut window, &["Server settings"]);
        assert_eq!(is_enabled(&window, "Activation…"), offered, "{row}");
        assert!(is_enabled(&window, "Server log…"), "{row}");
        key(&mut window, Modifiers::NONE, Key::Escape);
        key(&mut window, Modifiers::NONE, Key::Escape);
    }
}

#[test]
fn a_column_is_dragged_to_another_place_and_stays_there() {
    let mut window = open();
    let (from, to) = (place(&window, "Sort by status"), place(&window, "Sort by name"));
    let to = to - egui::vec2(40.0, 0.0);
    let button = |pos, pressed| Event::PointerButton {
        pos,
        button: PointerButton::Primary,
        pressed,
        modifiers: Modifiers::NONE,
    };
    let drag = [
        Event::PointerMoved(from),
        button(from, true),
        Event::PointerMoved(from - egui::vec2(30.0, 0.0)),
        Event::PointerMoved(to),
        button(to, false),
    ];
    for event in drag {
        window.input_mut().events.push(event);
        window.step();
    }
    settle(&mut window);
    let model = &window.state().model;
    assert_eq!(model.columns()[..2], [Column::Status, Column::Name]);
    assert_eq!(model.rows.sort, None, "dragging does not sort");
    let remembered = model.configuration();
    assert_eq!(remembered.options.window.column_order[0], "status");
    let again = self::window(RecordingBackend::default(), remembered, SIZE);
    let x = |label: &str| place(&again, label).x;
    assert!(x("Sort by status") < x("Sort by name") && x("Sort by name") < x("Sort by controller type"));
}

#[test]
fn a_command_is_found_by_a_part_of_its_name_and_done_with_the_keyboard() {
    let mut window = open();
    key(&mut window, Modifiers::COMMAND, Key::K);
    window.event(Event::Text("server log".into()));
    settle(&mut window);
    assert!(shows(&window, "Server settings: Server log… – Tick at least one controller first"));
    assert!(!shows(&window, "Server settings: Users"));
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(window.state().model.command_palette.is_some(), "nothing is ticked, so nothing is done");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.state().model.command_palette.is_none());

    key(&mut window, Modifiers::COMMAND, Key::K);
    window.event(Event::Text("options".into()));
    settle(&mut window);
    key(&mut window, Modifiers::NONE, Key::ArrowDown);
    key(&mut window, Modifiers::NONE, Key::Enter);
    assert!(window.state().model.command_palette.is_none());
    assert!(window.state().model.top::<BackupDialog>().is_some(), "the second one found");
}

#[test]
fn an_old_configuration_has_the_usual_columns_and_no_pane() {
    let json = r#"{"version":1,"options":{"window":{"columns":{"name":200.0},"column_order":["status","no such"]}}}"#;
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("epson_opcua_config.json"), json).unwrap();
    let mut loaded = Workspace::new(folder.path()).load().unwrap().configuration;
    loaded.controllers = configuration(1, now()).controllers;
    let window = window(RecordingBackend::default(), loaded, SIZE);
    let model = &window.state().model;
    assert_eq!(model.columns()[..3], [Column::Status, Column::Name, Column::Type]);
    assert_eq!(model.columns().len(), Column::ALL.len());
    assert!(!model.options.window.details);
}

#[test]
fn settings_and_lists_are_read_for_the_details() {
    let mut app = WindowTest::with_controllers(2, FleetFirmware::Mixed);
    key(&mut app.window, Modifiers::NONE, Key::ArrowDown);
    key(&mut app.window, Modifiers::NONE, Key::Enter);
    assert!(shows(&app.window, "Not read since the window was opened"));
    app.window.get_by_label("Read settings and lists").scroll_to_me();
    settle(&mut app.window);
    app.click("Read settings and lists");
    wait_until(&mut app.window, WAIT_LIMIT, |window| shows(window, "Aes256Sha256RsaPss"));
    for text in ["Users", "Trusted", "Rejected", "CRL"] {
        assert!(shows(&app.window, text), "{text}");
    }
    app.click("Tick cell 1");
    app.click("Get new information");
    wait_until(&mut app.window, WAIT_LIMIT, |window| shows(window, "Get new information, "));
}
