//! Pictures of the window over a backend that only plays back what it is told.

use opcua_configurator::model::Language;
use opcua_configurator::ui::backend::{Command, Event, RecordingBackend};
use opcua_configurator::ui::model::{JobId, Message, reduce};

use crate::harness::{Window, click, settle};

pub type W = Window<RecordingBackend>;

/// Compares the window with the picture of this name.
pub fn picture(window: &mut W, name: &str) {
    window.remove_cursor();
    // A blinking cursor would make every other picture different.
    window.ctx.all_styles_mut(|style| style.visuals.text_cursor.blink = false);
    settle(window);
    window.snapshot(name);
}

pub fn tick(window: &mut W, names: &[&str]) {
    for name in names {
        click(window, &format!("Tick {name}"));
    }
}

/// The backend reports something.
pub fn tell(window: &mut W, event: Event) {
    window.state_mut().backend.events.push_back(event);
    settle_twice(window);
}

pub fn say(window: &mut W, message: Message) {
    reduce(&mut window.state_mut().model, message);
    settle_twice(window);
}

pub fn chinese(window: &mut W) {
    say(window, Message::SetLanguage(Language::Zh));
}

/// What is drawn first decides how large the rest may be.
fn settle_twice(window: &mut W) {
    settle(window);
    window.step();
    settle(window);
}

/// The job, attempt or file that was asked for last.
pub fn job(window: &W) -> JobId {
    let of = |command: &Command| match command {
        Command::Run { job, .. }
        | Command::Probe { job, .. }
        | Command::Enroll { job, .. }
        | Command::ReadFile { job, .. }
        | Command::PickFile { job, .. }
        | Command::Recognise { job, .. }
        | Command::LookAtExport { job, .. }
        | Command::Authority { job, .. } => Some(*job),
        _ => None,
    };
    window.state().backend.sent.iter().rev().find_map(of).expect("something was asked for")
}
