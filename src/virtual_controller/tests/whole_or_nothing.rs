use std::path::Path;

use serde_json::{Value, json};

use super::test_controller::{
    CURRENT, RequestFailure, TestController, bounded, clients, code, initial, request, switch_on, with_certificate,
};
use crate::model::{Changed, ErrorCode, ServerStatus, StartupMode};
use crate::protocol::{self, Request as _};
use crate::virtual_controller::{DropPoint, FaultSwitches};

type Throw = fn(&mut FaultSwitches);

/// Every kind of change that touches a running server.
fn changes(revision: u64) -> [(&'static str, Value); 3] {
    [
        (protocol::GetUsers::PATH, json!({ "revision": revision, "name": "operator1", "password": "Passw0rd" })),
        (protocol::MakeSelfSigned::PATH, json!({ "revision": revision, "request": request("another", 2048) })),
        (
            protocol::EditTrust::PATH,
            json!({ "revision": revision, "steps": [{ "add": { "list": "trusted", "certificates": clients("c", 2) } }] }),
        ),
    ]
}

fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap())
        .filter(|entry| entry.file_type().unwrap().is_file())
        .map(|entry| (entry.file_name().into_string().unwrap(), std::fs::read(entry.path()).unwrap()))
        .collect();
    files.sort();
    files
}

async fn running() -> TestController {
    let mut new = with_certificate(initial(CURRENT));
    new.settings.startup = StartupMode::Auto;
    let test_controller = TestController::new(new).await;
    assert!(test_controller.answers());
    test_controller
}

#[tokio::test]
async fn a_change_that_fails_leaves_everything_as_it_was() {
    bounded(async {
        let test_controller = running().await;
        let client = test_controller.client().await;
        let (state, on_disk) = (test_controller.state(), files(test_controller.folder.path()));
        let full = |switches: &mut FaultSwitches| switches.disk_full = true;
        let lost = |switches: &mut FaultSwitches| switches.drop_next_change = Some(DropPoint::BeforeApply);
        let broken = |switches: &mut FaultSwitches| switches.server_error = true;
        let faults: [(Throw, Option<ErrorCode>); 3] =
            [(full, Some(ErrorCode::DiskFull)), (lost, None), (broken, Some(ErrorCode::ServerError))];
        for (fault, expected) in faults {
            for (path, body) in changes(1) {
                if expected == Some(ErrorCode::ServerError) && path == protocol::EditTrust::PATH {
                    continue; // does not restart the server
                }
                test_controller.controller.faults().update(fault);
                match (client.post::<Value>(path, &body).await, expected) {
                    (Err(RequestFailure::Failure(_, failure)), Some(expected)) => {
                        assert_eq!(failure.code, expected, "{path}")
                    }
                    (Err(RequestFailure::Lost), None) => {}
                    (other, _) => panic!("{path}: {other:?}"),
                }
                test_controller.controller.faults().update(|switches| *switches = FaultSwitches::default());
                assert_eq!(test_controller.state(), state, "{path}");
                assert_eq!(files(test_controller.folder.path()), on_disk, "{path}");
                assert_eq!(test_controller.status(), (ServerStatus::Run, None), "{path}");
                assert!(test_controller.answers(), "{path}");
            }
        }
        let [first, ..] = changes(1);
        client.post::<Changed>(first.0, &first.1).await.expect("and then it works");
    })
    .await;
}

#[tokio::test]
async fn a_change_whose_answer_is_lost_was_applied() {
    bounded(async {
        let test_controller = running().await;
        let client = test_controller.client().await;
        test_controller.controller.faults().update(|switches| switches.drop_next_change = Some(DropPoint::AfterApply));
        let [(path, body), ..] = changes(1);
        assert!(matches!(client.post::<Changed>(path, &body).await, Err(RequestFailure::Lost)));
        assert_eq!((test_controller.revision(), test_controller.state().users.len()), (2, 1));
        assert!(test_controller.answers());
        assert_eq!(code(client.post::<Changed>(path, &body).await), ErrorCode::ChangedMeanwhile);
    })
    .await;
}

#[tokio::test]
async fn a_client_that_leaves_in_the_middle_does_not_stop_a_change() {
    bounded(async {
        let test_controller = running().await;
        let client = test_controller.client().await;
        let [_, (path, body), _] = changes(1);
        let asking = client.post::<Value>(path, &body);
        let _ = tokio::time::timeout(std::time::Duration::from_millis(30), asking).await;
        // The next change runs after it, also if it failed.
        let _: Changed = client.post(protocol::StartServer::PATH, &()).await.unwrap();
        assert_eq!(test_controller.status(), (ServerStatus::Run, None));
        assert!(test_controller.answers());
        let on_disk = switch_on(test_controller.folder.path(), initial(CURRENT)).await.unwrap();
        assert_eq!(on_disk.state(), test_controller.state());
    })
    .await;
}
