//! Pictures of the window over a backend that only plays back what it is told.

use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

use egui::{Context, LayerId, Order, Pos2, Rect, vec2};
use egui_kittest::kittest::Queryable as _;
use egui_kittest::{SnapshotOptions, image_snapshot};
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{RgbaImage, imageops};
use opcua_configurator::jobs::{ControllerReport, JobStep, JobSummary, OperationOutput};
use opcua_configurator::model::{ControllerInfo, Language, Problem};
use opcua_configurator::ui::backend::{BackendCommand, BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::{JobId, Message, Task, TaskEvent};
use opcua_configurator::ui::reduce;

use crate::harness::{Window, click, settle};

pub type W = Window<RecordingBackend>;

/// Compares what is on top in the window with the picture of this name: the dialog, else the open menus, else all of it.
pub fn picture(window: &mut W, name: &str) {
    window.remove_cursor();
    // A blinking cursor would make every other picture different.
    window.ctx.all_styles_mut(|style| style.visuals.text_cursor.blink = false);
    settle(window);
    let image = window.render().expect("the window can be drawn");
    let part = on_top(&window.ctx).unwrap_or(window.ctx.content_rect());
    image_snapshot(&cropped(&image, part.expand(MARGIN)), name);
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        squeeze(&SnapshotOptions::default().output_path.join(format!("{name}.png")));
    }
}

/// Of the window around a dialog, in pixels.
const MARGIN: f32 = 8.0;

/// The dialog on top with its lists, or the open menus; `None` if nothing is open over the window.
fn on_top(ctx: &Context) -> Option<Rect> {
    ctx.memory(|memory| {
        let modal = memory.top_modal_layer();
        let open = memory
            .areas()
            .visible_layer_ids()
            .into_iter()
            .filter(|layer| matches!(layer.order, Order::Foreground | Order::Tooltip));
        let shown = |layer: &LayerId| modal.is_none_or(|modal| *layer == modal || memory.is_above_modal_layer(*layer));
        open.filter(shown).filter_map(|layer| memory.area_rect(layer.id)).reduce(Rect::union)
    })
}

fn cropped(image: &RgbaImage, part: Rect) -> RgbaImage {
    let part = part.intersect(Rect::from_min_size(Pos2::ZERO, vec2(image.width() as f32, image.height() as f32)));
    let (min, size) = (part.min.floor(), part.size().ceil());
    imageops::crop_imm(image, min.x as u32, min.y as u32, size.x as u32, size.y as u32).to_image()
}

/// Writes a picture again without its alpha channel, which is opaque, and as small as the encoder can.
fn squeeze(path: &Path) {
    let image = image::open(path).expect("the picture just taken").to_rgb8();
    let file = File::create(path).expect("the picture's file");
    let encoder = PngEncoder::new_with_quality(BufWriter::new(file), CompressionType::Best, FilterType::Adaptive);
    image.write_with_encoder(encoder).expect("the picture's file");
}

/// What needs no picture of its own: the window has these words on it.
pub fn assert_shows(window: &W, words: &str) {
    assert!(window.query_all_by_label_contains(words).next().is_some(), "the window does not show {words:?}");
}

pub fn tick(window: &mut W, names: &[&str]) {
    for name in names {
        click(window, &format!("Tick {name}"));
    }
}

/// The backend reports something.
pub fn tell(window: &mut W, event: BackendEvent) {
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
    let of = |command: &BackendCommand| match command {
        BackendCommand::Run { job, .. }
        | BackendCommand::Probe { job, .. }
        | BackendCommand::Enroll { job, .. }
        | BackendCommand::ReadFile { job, .. }
        | BackendCommand::PickFile { job, .. }
        | BackendCommand::Recognise { job, .. }
        | BackendCommand::LookAtExport { job, .. }
        | BackendCommand::WatchValues { job, .. }
        | BackendCommand::Recorder { job, .. }
        | BackendCommand::Authority { job, .. } => Some(*job),
        _ => None,
    };
    window.state().backend.sent.iter().rev().find_map(of).expect("something was asked for")
}

/// The job that was started last, and its task.
fn running(window: &W) -> (JobId, Task) {
    let of = |command: &BackendCommand| match command {
        BackendCommand::Run { job, task, .. } => Some((*job, task.clone())),
        _ => None,
    };
    window.state().backend.sent.iter().rev().find_map(of).expect("a job was started")
}

/// The operation of that job succeeds for one of its controllers.
pub fn succeed<O: OperationOutput>(window: &mut W, index: usize, output: O, info: Option<ControllerInfo>) {
    let (job, task) = running(window);
    let event =
        task.finished(index, ControllerReport { result: Ok(output), info }).expect("a result of this operation");
    tell(window, BackendEvent::Job { job, event });
}

/// It fails for one of them.
pub fn fail(window: &mut W, index: usize, problem: impl Into<Problem>) {
    let (job, task) = running(window);
    tell(window, BackendEvent::Job { job, event: task.failed(index, problem.into()) });
}

/// It is at this step with one of them.
pub fn step(window: &mut W, index: usize, step: JobStep) {
    let (job, _) = running(window);
    tell(window, BackendEvent::Job { job, event: TaskEvent::Step { index, step } });
}

/// It ends.
pub fn end_job(window: &mut W, done: usize, failed: usize, not_started: usize) {
    let (job, _) = running(window);
    tell(window, BackendEvent::JobEnded { job, summary: JobSummary { done, failed, not_started } });
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
