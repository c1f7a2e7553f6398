//! How long a frame takes with 10,000 controllers: drawing and tessellation, without a GPU. The same rows in a bare egui
//! table, in the same run, show how much of it is the table's own.

#[path = "../common/samples.rs"]
mod samples;
#[allow(dead_code, reason = "the pictures need more of it")]
#[path = "../pictures/trust_samples.rs"]
mod trust_samples;

use std::time::{Duration, Instant};

use chrono::{DateTime, Utc};
use egui::{Label, Modifiers, MouseWheelUnit, RawInput, Rect, pos2, vec2};
use egui_extras::TableBuilder;
use opcua_configurator::jobs::{ControllerReport, JobSummary, TrustSnapshot};
use opcua_configurator::model::{CertificateStatus, FirmwareGeneration, Language};
use opcua_configurator::ui::App;
use opcua_configurator::ui::backend::{BackendCommand, BackendEvent, RecordingBackend};
use opcua_configurator::ui::model::{Column, Message, Model, Row, UiCommand};
use opcua_configurator::ui::reduce;
use opcua_configurator::workspace::{Configuration, Workspace};
use trust_samples::{listed, refused};

const ROWS: usize = 10_000;
const CERTIFICATES: usize = 1_000;
const WARM_UP: usize = 30;
const FRAMES: usize = 300;
const TARGET: Duration = Duration::from_millis(1);

fn main() {
    let now: DateTime<Utc> = "2026-06-01T08:30:00Z".parse().unwrap_or_default();
    let model = || Model::new(samples::configuration(ROWS, now), Workspace::new("/nowhere"), Language::En, now);
    for (what, scrolling) in [("still", false), ("scrolling", true)] {
        let window = median(frames(model(), scrolling));
        report(&format!("frame, {what}"), window);
        let bare = median(bare_table(&model(), scrolling));
        let ratio = window.as_secs_f64() / bare.as_secs_f64();
        println!(
            "{:24} {:8.3} ms   the window takes {ratio:.2} × as long",
            format!("bare table, {what}"),
            bare.as_secs_f64() * 1e3
        );
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
    let commands = reduce(&mut model, Message::Invoke(UiCommand::CLIENT_CERTIFICATES));
    let run = commands.iter().find_map(|command| match command {
        BackendCommand::Run { job, task, .. } => Some((*job, task)),
        _ => None,
    });
    let (job, task) = run.expect("the lists are read");
    let start = Instant::now();
    let result = Ok(many_certificates(CERTIFICATES, now));
    let event = task.finished(0, ControllerReport { result, info: None }).expect("lists are its result");
    reduce(&mut model, Message::Event(BackendEvent::Job { job, event }));
    report("trust, lists arrive", start.elapsed());
    reduce(
        &mut model,
        Message::Event(BackendEvent::JobEnded { job, summary: JobSummary { done: 1, ..JobSummary::default() } }),
    );
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
    time_frames(&ctx, scrolling, |ui| app.frame(ui))
}

/// The same texts in as many columns of `egui_extras`, with nothing around them, in the window's fonts and theme.
fn bare_table(model: &Model, scrolling: bool) -> Vec<Duration> {
    const HEIGHT: f32 = 32.0;
    let ctx = egui::Context::default();
    let model_for_theme = Model::new(Configuration::default(), Workspace::new("/nowhere"), Language::En, model.now);
    drop(App::new(&ctx, model_for_theme, RecordingBackend::default()));
    let text = |row: &Row| {
        let info = row.info();
        let of = |text: Option<String>| text.unwrap_or_else(|| "—".to_owned());
        [
            row.entry.name.to_string(),
            row.entry.series.as_str().to_owned(),
            row.address.clone(),
            of(info.map(|info| info.serial.to_string())),
            of(info.map(|info| format!("{:?}", info.status))),
            of(row.not_after().map(|end| model.zone.date(end))),
            of(row.certificate_type().map(|kind| format!("{kind:?}"))),
            of(info.map(|info| if info.activated { "Yes" } else { "No" }.to_owned())),
            of(row.entry.last.as_ref().map(|last| model.zone.date_time(last.at))),
        ]
    };
    let rows: Vec<[String; 9]> = model.rows.all().iter().map(text).collect();
    time_frames(&ctx, scrolling, |ui| {
        egui::CentralPanel::default().show(ui, |ui| {
            let table = TableBuilder::new(ui).striped(true).resizable(true).auto_shrink(false);
            let table = table.columns(egui_extras::Column::initial(125.0).clip(true), 9);
            table
                .header(HEIGHT, |mut header| {
                    for column in Column::ALL {
                        header.col(|ui| drop(ui.label(column.key())));
                    }
                })
                .body(|body| {
                    body.rows(HEIGHT, rows.len(), |mut row| {
                        for text in &rows[row.index()] {
                            row.col(|ui| drop(ui.add(Label::new(text).truncate())));
                        }
                    });
                });
        });
    })
}

fn time_frames(ctx: &egui::Context, scrolling: bool, mut draw: impl FnMut(&mut egui::Ui)) -> Vec<Duration> {
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
        let mut output = ctx.run_ui(input, |ui| draw(ui));
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
