//! The parts of the main window beside the table: details, the menu of a row, the command palette.

use egui::{Event, Key, Modifiers, PointerButton};
use egui_kittest::kittest::Queryable as _;
use opcua_configurator::jobs::Overview;
use opcua_configurator::model::{ErrorCode, Problem, ServerSettings};
use opcua_configurator::ui::backend::{Backend as _, RecordingBackend};
use opcua_configurator::ui::model::{Message, RowId};
use opcua_configurator::ui::{App, reduce};
use opcua_configurator::workspace::ThemeChoice;

use crate::harness::{SIZE, click, now, settle, window};
use crate::pictures::{W, assert_shows, chinese, end_job, fail, finish, picture, say, tick};
use crate::samples::configuration;

const LONG: &str = "Test bench in hall 4 with a long";

fn open(size: [f32; 2]) -> W {
    window(RecordingBackend::default(), configuration(24, now()), size)
}

fn key(window: &mut W, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    settle(window);
}

fn details_of(window: &mut W, name: &str) -> RowId {
    let rows = &window.state().model.rows;
    let row = rows.all().iter().find(|row| row.entry.name.as_str() == name).map(|row| row.id);
    let row = row.expect("a row of this name");
    say(window, Message::OpenDetails(row));
    row
}

#[test]
fn details() {
    let mut window = open(SIZE);
    tick(&mut window, &["Weld 1"]);
    click(&mut window, "Get new information");
    fail(&mut window, 0, Problem::with_detail(ErrorCode::Unreachable, "connection refused"));
    end_job(&mut window, 0, 1, 0);
    click(&mut window, "Close");
    details_of(&mut window, "Weld 1");
    assert_shows(&window, "Switch the controller on, check the cable and the address, then try again.");
}

#[test]
fn details_in_a_small_window() {
    let mut window = open(SIZE);
    let row = details_of(&mut window, LONG);
    // The button may be below what is visible of the pane.
    let App { model, backend, .. } = window.state_mut();
    reduce(model, Message::ReadOverview(row)).into_iter().for_each(|command| backend.send(command));
    window.set_size([900.0, 500.0].into());
    let settings = ServerSettings::default();
    finish(&mut window, vec![Ok(Overview { settings, users: 3, trusted: 12, rejected: 1, issuers: Some(2), crls: 2 })]);
    say(&mut window, Message::SetTheme(ThemeChoice::Dark));
    chinese(&mut window);
    assert_shows(&window, "Aes256Sha256RsaPss");
}

#[test]
fn menu_of_a_row() {
    let mut window = open(SIZE);
    let at = window.get_by_label("Paint booth").rect().center();
    let button = PointerButton::Secondary;
    let press = |pressed| Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::NONE };
    window.input_mut().events.extend([Event::PointerMoved(at), press(true), press(false)]);
    window.step();
    settle(&mut window);
    click(&mut window, "Server settings");
    picture(&mut window, "row_menu");
}

#[test]
fn command_palette() {
    let mut window = open(SIZE);
    say(&mut window, Message::SetTheme(ThemeChoice::Dark));
    chinese(&mut window);
    key(&mut window, Modifiers::COMMAND, Key::K);
    window.event(Event::Text("server".into()));
    settle(&mut window);
    picture(&mut window, "command_palette_chinese");
}
