//! Files held over and dropped onto the window, as it looks.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use opcua_configurator::model::{ErrorCode, Problem};
use opcua_configurator::pki::PkiKind;
use opcua_configurator::ui::backend::{BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::DroppedFile;
use opcua_configurator::workspace::Recognised;

use crate::harness::{SIZE, now, settle, window};
use crate::pictures::{W, assert_shows, chinese, job, picture, tell, tick};
use crate::samples::configuration;

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        Err("the window must not read files itself".into())
    }
}

fn open(ticked: &[&str]) -> W {
    let mut window = window(RecordingBackend::default(), configuration(24, now()), SIZE);
    tick(&mut window, ticked);
    window
}

fn file(name: &str, found: Result<Recognised, Problem>) -> DroppedFile {
    DroppedFile { path: Path::new("/home/engineer/Downloads").join(name), found }
}

fn hold(window: &mut W, files: Vec<DroppedFile>) {
    let hovered = files.iter().map(|file| egui::HoveredFile { path: Some(file.path.clone()), mime: String::new() });
    window.input_mut().hovered_files = hovered.collect();
    settle(window);
    let job = job(window);
    tell(window, BackendEvent::Recognised { job, files });
}

fn drop(window: &mut W, files: Vec<DroppedFile>) {
    window.input_mut().hovered_files.clear();
    for file in &files {
        window.input_mut().dropped_files.push(Arc::new(Dropped(file.path.clone())));
    }
    settle(window);
    let job = job(window);
    tell(window, BackendEvent::Recognised { job, files });
}

#[test]
fn held_over_the_window() {
    let mut window = open(&["Weld 2"]);
    let activation = || vec![file("keys of line 3.csv", Ok(Recognised::Activation))];
    hold(&mut window, activation());
    assert_shows(&window, "keys of line 3.csv");
    chinese(&mut window);
    picture(&mut window, "drop_hover_chinese");
}

#[test]
fn several_dialogs_take_it() {
    let mut window = open(&["Weld 2"]);
    let files = || {
        vec![
            file("robot_7.der", Ok(Recognised::Pki(PkiKind::Certificate))),
            file("robot_7.key", Ok(Recognised::Pki(PkiKind::Key))),
        ]
    };
    drop(&mut window, files());
    picture(&mut window, "drop_choice");
}

#[test]
fn nothing_takes_it() {
    let mut window = open(&[]);
    let unknown = Problem::with_detail(ErrorCode::FileNotRecognised, "/home/engineer/Downloads/holiday.png");
    drop(&mut window, vec![file("holiday.png", Err(unknown)), file("plant.p7b", Ok(Recognised::Pki(PkiKind::Bundle)))]);
    assert_shows(&window, "The file is of no known kind");
}
