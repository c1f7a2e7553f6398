use std::path::Path;

use serde_json::{Value, json};

use super::bench::{Bench, CURRENT, Refusal, bounded, clients, code, initial, request, switch_on, with_certificate};
use crate::model::{Changed, ErrorCode, ServerStatus, StartupMode};
use crate::protocol::{self, Request as _};
use crate::virtual_controller::{DropPoint, Switches};

type Throw = fn(&mut Switches);

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

async fn running() -> Bench {
    let mut new = with_certificate(initial(CURRENT));
    new.settings.startup = StartupMode::Auto;
    let bench = Bench::new(new).await;
    assert!(bench.answers());
    bench
}

#[tokio::test]
async fn a_change_that_fails_leaves_everything_as_it_was() {
    bounded(async {
        let bench = running().await;
        let client = bench.client().await;
        let (state, on_disk) = (bench.state(), files(bench.folder.path()));
        let full = |switches: &mut Switches| switches.disk_full = true;
        let lost = |switches: &mut Switches| switches.drop_next_change = Some(DropPoint::BeforeApply);
        let broken = |switches: &mut Switches| switches.server_error = true;
        let faults: [(Throw, Option<ErrorCode>); 3] =
            [(full, Some(ErrorCode::DiskFull)), (lost, None), (broken, Some(ErrorCode::ServerError))];
        for (fault, expected) in faults {
            for (path, body) in changes(1) {
                if expected == Some(ErrorCode::ServerError) && path == protocol::EditTrust::PATH {
                    continue; // does not restart the server
                }
                bench.controller.faults().update(fault);
                match (client.post::<Value>(path, &body).await, expected) {
                    (Err(Refusal::Failure(_, failure)), Some(expected)) => assert_eq!(failure.code, expected, "{path}"),
                    (Err(Refusal::Lost), None) => {}
                    (other, _) => panic!("{path}: {other:?}"),
                }
                bench.controller.faults().update(|switches| *switches = Switches::default());
                assert_eq!(bench.state(), state, "{path}");
                assert_eq!(files(bench.folder.path()), on_disk, "{path}");
                assert_eq!(bench.status(), (ServerStatus::Run, None), "{path}");
                assert!(bench.answers(), "{path}");
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
        let bench = running().await;
        let client = bench.client().await;
        bench.controller.faults().update(|switches| switches.drop_next_change = Some(DropPoint::AfterApply));
        let [(path, body), ..] = changes(1);
        assert!(matches!(client.post::<Changed>(path, &body).await, Err(Refusal::Lost)));
        assert_eq!((bench.revision(), bench.state().users.len()), (2, 1));
        assert!(bench.answers());
        assert_eq!(code(client.post::<Changed>(path, &body).await), ErrorCode::ChangedMeanwhile);
    })
    .await;
}

#[tokio::test]
async fn a_client_that_leaves_in_the_middle_does_not_stop_a_change() {
    bounded(async {
        let bench = running().await;
        let client = bench.client().await;
        let [_, (path, body), _] = changes(1);
        let asking = client.post::<Value>(path, &body);
        let _ = tokio::time::timeout(std::time::Duration::from_millis(30), asking).await;
        // The next one takes its turn after it, whatever became of it.
        let _: Changed = client.post(protocol::StartServer::PATH, &()).await.unwrap();
        assert_eq!(bench.status(), (ServerStatus::Run, None));
        assert!(bench.answers());
        let on_disk = switch_on(bench.folder.path(), initial(CURRENT)).await.unwrap();
        assert_eq!(on_disk.state(), bench.state());
    })
    .await;
}
