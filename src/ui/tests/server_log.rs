//! The window of the server log.

use super::*;
use crate::jobs::ServerEffect;
use crate::model::LogChunk;
use crate::ui::features::server_log::LogView;

const TEXT: &str = "10:00 INFO server started\r\n10:01 WARN 客户端 refused\n10:02 INFO server stopped";

fn chunk() -> LogChunk {
    LogChunk { size: 1000, from: 900, next: 1000, text: TEXT.into() }
}

fn log(model: &mut Model) -> &mut LogView {
    let Some(log) = model.dialog::<LogView>() else { panic!("no log") };
    log
}

fn opened() -> Model {
    let mut model = model();
    tick(&mut model, &["Paint"]);
    let id = job(&reduce(&mut model, Message::Invoke(UiCommand::SERVER_LOG)));
    assert!(!log(&mut model).is_read());
    done(&mut model, id, 0, chunk());
    ended(&mut model, id, 1, 0);
    model
}

#[test]
fn it_is_about_one_controller() {
    let mut model = model();
    assert!(UiCommand::SERVER_LOG.why_disabled(&model).is_some());
    tick(&mut model, &["Paint"]);
    assert!(UiCommand::SERVER_LOG.why_disabled(&model).is_none());
    tick(&mut model, &["Weld 2"]);
    assert!(UiCommand::SERVER_LOG.why_disabled(&model).is_some());
}

#[test]
fn lines_are_found_whatever_their_case() {
    let mut model = opened();
    let log = log(&mut model);
    assert_eq!((log.lines(), log.shown(), log.size()), (3, 3, (1000, 100)));
    assert_eq!(log.line(0), "10:00 INFO server started");
    assert_eq!(log.longest(), 25);
    log.filter = "SERVER".into();
    log.find();
    assert_eq!(log.copied(), "10:00 INFO server started\n10:02 INFO server stopped\n");
    log.filter = "客户端".into();
    log.find();
    assert_eq!((log.shown(), log.line(0)), (1, "10:01 WARN 客户端 refused"));
    assert_eq!(log.line(1), "", "there is no such line");
}

#[test]
fn what_was_read_stays_when_it_cannot_be_read_again() {
    let mut model = opened();
    let id = job(&reduce(&mut model, Message::act(Model::refresh_log)));
    assert!(log(&mut model).reading && log(&mut model).is_read());
    fail(&mut model, id, 0, ErrorCode::Unreachable);
    ended(&mut model, id, 0, 1);
    assert_eq!(open(&model), ["LogView", "ErrorDialog"]);
    assert!(!log(&mut model).reading);
    assert_eq!(log(&mut model).shown(), 3);
}

#[test]
fn it_is_deleted_after_a_question_and_read_again() {
    let mut model = opened();
    assert!(reduce(&mut model, Message::act(Model::delete_log)).is_empty());
    let confirmation = model.top::<ConfirmDialog>().expect("a question").confirmation;
    assert!(confirmation.deletes_log && confirmation.server == ServerEffect::Restarts);
    let commands = reduce(&mut model, Message::Submit);
    let [BackendCommand::Run { job: id, ref task, .. }] = commands[..] else { panic!("{commands:?}") };
    assert!(task.operation::<SetBasicSettings>().unwrap().change.delete_log);
    done(&mut model, id, 0, NoOutput);
    ended(&mut model, id, 1, 0);
    let id = job(&reduce(&mut model, Message::Submit));
    done(&mut model, id, 0, LogChunk::default());
    ended(&mut model, id, 1, 0);
    assert_eq!(log(&mut model).size(), (0, 0));
    assert!(matches!(reduce(&mut model, Message::Close)[..], []));
    assert!(model.dialogs.is_empty());
}
