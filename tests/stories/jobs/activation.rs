//! Activating controllers by their keys: one, many, and what goes wrong on the way.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use opcua_configurator::jobs::{Activate, ControllerReport, JobEvent, JobSummary, KeySource, StartServer};
use opcua_configurator::model::ErrorCode;
use opcua_configurator::model::activation::{ActivationFile, FIRST_LINE, parse};
use opcua_configurator::virtual_controller::{DropPoint, FleetFirmware, demo_keys};
use tokio_util::sync::CancellationToken;

use crate::common::test_fleet::{self, TestFleet};

/// An activation file for the first `count` controllers, with `edit` on each line.
fn file(fleet: &TestFleet, count: usize, edit: impl Fn(usize, String) -> String) -> Arc<ActivationFile> {
    let line = |index: usize| {
        let serial = fleet.controller(index).serial();
        let keys = demo_keys(&serial);
        edit(index, format!("{serial},{},{}\r\n", keys.licence, keys.activation))
    };
    let body: String = (0..count).map(line).collect();
    Arc::new(parse(format!("\u{feff}{FIRST_LINE}\r\n{body}").as_bytes()).unwrap())
}

fn from(file: &Arc<ActivationFile>) -> Activate {
    Activate { keys: KeySource::File(file.clone()) }
}

fn code<O>(report: &ControllerReport<O>) -> Option<ErrorCode> {
    report.result.as_ref().err().map(|problem| problem.code)
}

fn activated(fleet: &TestFleet, index: usize) -> bool {
    fleet.controller(index).info().activated
}

#[tokio::test(flavor = "multi_thread")]
async fn fifty_controllers_from_one_file_with_five_bad_lines_one_cable_pulled_and_a_cancel() {
    const COUNT: usize = 50;
    let fleet = TestFleet::not_activated(COUNT).await;
    let file = file(&fleet, COUNT, |index, line| match index {
        3 => line.replacen(',', ";", 2),
        11 => line.replace("\r\n", "!\r\n"),
        19 => String::new(),
        27 => line.repeat(2),
        // Well-formed, but the keys of another controller.
        35 => {
            let keys = demo_keys(&fleet.controller(36).serial());
            format!("{},{},{}\r\n", fleet.controller(35).serial(), keys.licence, keys.activation)
        }
        _ => line,
    });
    let lines: Vec<usize> = file.mistakes().iter().map(|mistake| mistake.line).collect();
    assert_eq!(lines, [5, 13, 28, 29]);
    fleet.controller(44).shutdown().await;

    // Once cancelled, what is done stays done, and is said so.
    let mut context = fleet.context();
    context.parallelism = 4;
    let (cancel, finished) = (CancellationToken::new(), Arc::new(AtomicUsize::new(0)));
    let (stop, count) = (cancel.clone(), finished.clone());
    let (reports, summary) = test_fleet::run(fleet.listed(), from(&file), context, cancel, move |event| {
        if matches!(event, JobEvent::Finished { .. }) && count.fetch_add(1, Ordering::Relaxed) == 9 {
            stop.cancel();
        }
    })
    .await;
    assert!(summary.done >= 5 && summary.not_started >= COUNT - 20, "{summary:?}");
    assert_eq!(summary.done + summary.failed + summary.not_started, COUNT);
    for (index, report) in reports.iter().enumerate() {
        assert_eq!(report.result.is_ok(), activated(&fleet, index), "what is said of controller {index} is so");
    }

    // And simply done again.
    let (reports, summary) =
        test_fleet::run(fleet.listed(), from(&file), fleet.context(), CancellationToken::new(), |_| {}).await;
    assert_eq!(summary, JobSummary { done: COUNT - 6, failed: 6, not_started: 0 });
    for (index, report) in reports.iter().enumerate() {
        let expected = match index {
            3 | 11 | 19 | 27 => Some(ErrorCode::NotInFile),
            35 => Some(ErrorCode::WrongKeys),
            44 => Some(ErrorCode::Unreachable),
            _ => None,
        };
        assert_eq!(code(report), expected, "controller {index}: {report:?}");
        if index != 44 {
            assert_eq!(activated(&fleet, index), expected.is_none());
            let changes = fleet.controller(index).info().revision.number() - 1;
            assert!(if expected.is_none() { (1..=2).contains(&changes) } else { changes == 0 }, "{index}: {changes}");
        }
    }
    let told = reports[11].result.as_ref().unwrap_err().detail.clone().unwrap();
    assert!(told.contains("line 13") && told.contains("activation key"), "{told}");
}

#[tokio::test(flavor = "multi_thread")]
async fn a_controller_that_is_known_not_to_be_in_the_file_is_not_even_asked() {
    let fleet = TestFleet::not_activated(2).await;
    let file = file(&fleet, 1, |_, line| line);
    let mut listed = fleet.listed();
    for (index, controller) in listed.iter_mut().enumerate() {
        controller.known = Some(fleet.controller(index).info());
    }
    fleet.controller(1).shutdown().await;
    let (reports, _) = test_fleet::run(listed, from(&file), fleet.context(), CancellationToken::new(), |_| {}).await;
    assert_eq!([code(&reports[0]), code(&reports[1])], [None, Some(ErrorCode::NotInFile)]);
}

#[tokio::test(flavor = "multi_thread")]
async fn without_keys_the_server_says_why_it_does_not_start() {
    let fleet = TestFleet::not_activated(1).await;
    let start = fleet.run(StartServer).await;
    assert_eq!(code(&start[0]), Some(ErrorCode::NotActivated));
    assert!(start[0].info.as_ref().is_some_and(|info| !info.activated && info.error == Some(ErrorCode::NotActivated)));
    let keys = demo_keys(&fleet.controller(0).serial());
    let reports = fleet.run(Activate { keys: KeySource::Typed(keys) }).await;
    assert!(reports[0].info.as_ref().is_some_and(|info| info.activated), "{reports:?}");
    assert_eq!(
        code(&fleet.run(StartServer).await[0]),
        Some(ErrorCode::NoCertificate),
        "the next thing that is missing"
    );
}

#[tokio::test(flavor = "multi_thread")]
async fn current_firmware_and_wrong_keys_are_refused_and_change_nothing() {
    let fleet = TestFleet::start(2, FleetFirmware::Mixed).await;
    let strange = demo_keys(&"R7A9999999".parse().unwrap());
    let before: Vec<_> = (0..2).map(|index| fleet.controller(index).state()).collect();
    let reports = fleet.run(Activate { keys: KeySource::Typed(strange) }).await;
    assert_eq!([code(&reports[0]), code(&reports[1])], [Some(ErrorCode::WrongKeys), Some(ErrorCode::FirmwareTooNew)]);
    for (index, before) in before.iter().enumerate() {
        assert_eq!(fleet.controller(index).state(), *before);
    }
}

#[tokio::test(flavor = "multi_thread")]
async fn an_activation_whose_answer_was_lost_is_found_in_the_row() {
    let fleet = TestFleet::not_activated(1).await;
    let file = file(&fleet, 1, |_, line| line);
    fleet.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::BeforeApply));
    let reports = fleet.run(from(&file)).await;
    assert_eq!(code(&reports[0]), Some(ErrorCode::ConnectionLost));
    assert!(!activated(&fleet, 0));
    fleet.controller(0).faults().update(|f| f.drop_next_change = Some(DropPoint::AfterApply));
    let reports = fleet.run(from(&file)).await;
    assert_eq!(code(&reports[0]), Some(ErrorCode::AnswerLost));
    assert!(reports[0].info.as_ref().is_some_and(|info| info.activated));
}
