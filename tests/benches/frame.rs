//! How long a frame takes with 10,000 controllers: drawing and tessellation, without a GPU.

#[path = "../common/samples.rs"]
mod samples;
#[allow(dead_code, reason = "the pictures need more of it")]
#[path = "../pictures/trust_samples.rs"]
mod trust_samples;

use std::time::{Duration, Instant};

use chrono::{DateTime, Utc};
use egui::{Modifiers, MouseWheelUnit, RawInput, Rect, pos2, vec2};
use opcua_configurator::jobs::{Report, Summary, TrustSnapshot};
use opcua_configurator::model::{CertificateStatus, FirmwareGeneration, Language};
use opcua_configurator::ui::App;
use opcua_configurator::ui::backend::{Command, Event, RecordingBackend};
use opcua_configurator::ui::command::UiCommand;
use opcua_configurator::ui::model::{Column, Message, Model, reduce};
use opcua_configurator::workspace::Workspace;
use trust_samples::{listed, refused};

const ROWS: usize = 10_000;
const CERTIFICATES: usize = 1_000;
const WARM_UP: usize = 30;
const FRAMES: usize = 300;
const TARGET: Duration = Duration::from_millis(1);

fn main() {
    let now: DateTime<Utc> = "2026-06-01T08:30:00Z".parse().unwrap_or_default();
    let model = || Model::new(samples::configuration(ROWS, now), Workspace::new("/nowhere"), Language::En, now);
    for (what, scrolling) in [("frame, still", false), ("frame, scrolling", true)] {
        report(what, median(frames(model(), scrolling)));
    }
    for (what, scrolling) in [("trust, still", false), ("trust, scrolling", true)] {
        report(what, median(frames(trust(model(), now), scrolling)));
    }
    let mut model = model();
    let mut once = |what: &str, message: Message| {
        let start = Instant::now();
        reduce(&mut model, message);
        report(what, start.elapsed());
    };
    once("sort by name, once", Message::Sort(Column::Name));
    once("sort by address, once", Message::Sort(Column::Address));
    once("search, per key", Message::Filter("99".into()));
    once("tick all, once", Message::TickAll(true));
}

/// The lists of one controller, with many certificates, over the list of controllers.
fn trust(mut model: Model, now: DateTime<Utc>) -> Model {
    reduce(&mut model, Message::MoveCursor(0));
    reduce(&mut model, Message::ToggleCursor);
    let commands = reduce(&mut model, Message::Invoke(UiCommand::ClientLists));
    let run = commands.iter().find_map(|command| match command {
        Command::Run { job, task, .. } => Some((*job, task)),
        _ => None,
    });
    let (job, task) = run.expect("the lists are read");
    let start = Instant::now();
    let result = Ok(many_certificates(CERTIFICATES, now));
    let event = task.finished(0, Report { result, info: None }).expect("lists are its result");
    reduce(&mut model, Message::Event(Event::Job { job, event }));
    report("trust, lists arrive", start.elapsed());
    reduce(&mut model, Message::Event(Event::JobEnded { job, summary: Summary { done: 1, ..Summary::default() } }));
    model
}

fn report(what: &str, took: Duration) {
    let ratio = took.as_secs_f64() / TARGET.as_secs_f64();
    println!("{what:24} {:8.3} ms   {ratio:5.2} × target of {TARGET:?}", took.as_secs_f64() * 1e3);
}

fn median(mut times: Vec<Duration>) -> Duration {
    times.sort();
    times[times.len() / 2]
}

fn frames(model: Model, scrolling: bool) -> Vec<Duration> {
    let ctx = egui::Context::default();
    let mut app = App::new(&ctx, model, RecordingBackend::default());
    let mut times = Vec::new();
    for frame in 0..WARM_UP + FRAMES {
        let mut input = RawInput {
            screen_rect: Some(Rect::from_min_size(pos2(0.0, 0.0), vec2(1280.0, 800.0))),
            time: Some(frame as f64 / 60.0),
            ..RawInput::default()
        };
        input.events.push(egui::Event::PointerMoved(pos2(640.0, 400.0)));
        if scrolling {
            input.events.push(egui::Event::MouseWheel {
                unit: MouseWheelUnit::Point,
                delta: vec2(0.0, -200.0),
                phase: egui::TouchPhase::Move,
                modifiers: Modifiers::NONE,
                source: egui::MouseWheelSource::Unknown,
            });
        }
        let start = Instant::now();
        let mut output = ctx.run_ui(input, |ui| app.frame(ui));
        let shapes = std::mem::take(&mut output.shapes);
        std::hint::black_box(ctx.tessellate(shapes, output.pixels_per_point));
        if frame >= WARM_UP {
            times.push(start.elapsed());
        }
        output.drop_without_applying_deltas();
    }
    times
}

/// As many certificates as that, evenly over the three lists.
fn many_certificates(count: usize, clock: DateTime<Utc>) -> TrustSnapshot {
    let mut held = trust_samples::nothing(FirmwareGeneration::Current, clock);
    for n in 0..count {
        let name = format!("Station {n}");
        match n % 3 {
            0 => held.trusted.push(listed(n, &name, "Plant CA", "station.der", n as i64 % 500, clock)),
            1 => held.issuers.push(listed(n, &name, "Plant root CA", "authority.der", 1000, clock)),
            _ => held.rejected.push(refused(n, &name, &name, CertificateStatus::Untrusted, 3, n as i64, clock)),
        }
    }
    held
}
