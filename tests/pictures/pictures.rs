//! Pictures of the window over a backend that only plays back what it is told.
#![allow(dead_code, reason = "not every story needs everything")]

use opcua_configurator::jobs::{OperationOutput, Report, Step, Summary};
use opcua_configurator::model::{ControllerInfo, Language, Problem};
use opcua_configurator::ui::backend::{Command, Event, RecordingBackend};
use opcua_configurator::ui::model::{JobId, Message, Task, TaskEvent, reduce};

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

/// The job that was started last, and its task.
fn running(window: &W) -> (JobId, Task) {
    let of = |command: &Command| match command {
        Command::Run { job, task, .. } => Some((*job, task.clone())),
        _ => None,
    };
    window.state().backend.sent.iter().rev().find_map(of).expect("a job was started")
}

/// The operation of that job succeeds for one of its controllers.
pub fn succeed<O: OperationOutput>(window: &mut W, index: usize, output: O, info: Option<ControllerInfo>) {
    let (job, task) = running(window);
    let event = task.finished(index, Report { result: Ok(output), info }).expect("a result of this operation");
    tell(window, Event::Job { job, event });
}

/// It fails for one of them.
pub fn fail(window: &mut W, index: usize, problem: impl Into<Problem>) {
    let (job, task) = running(window);
    tell(window, Event::Job { job, event: task.failed(index, problem.into()) });
}

/// It is at this step with one of them.
pub fn step(window: &mut W, index: usize, step: Step) {
    let (job, _) = running(window);
    tell(window, Event::Job { job, event: TaskEvent::Step { index, step } });
}

/// It ends.
pub fn end_job(window: &mut W, done: usize, failed: usize, not_started: usize) {
    let (job, _) = running(window);
    tell(window, Event::JobEnded { job, summary: Summary { done, failed, not_started } });
}

/// It gives these results, one a controller, and ends.
pub fn finish<O: OperationOutput>(window: &mut W, results: Vec<Result<O, Problem>>) {
    let failed = results.iter().filter(|result| result.is_err()).count();
    let done = results.len() - failed;
    for (index, result) in results.into_iter().enumerate() {
        match result {
            Ok(output) => succeed(window, index, output, None),
            Err(problem) => fail(window, index, problem),
        }
    }
    end_job(window, done, failed, 0);
}
