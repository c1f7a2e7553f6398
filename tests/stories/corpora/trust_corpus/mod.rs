//! Hundreds of certificate chains, with one flaw each or none, judged by this program and by OpenSSL.
//!
//! What OPC UA says of each stands in the table (`trust_corpus/table.rs`), and so does where OpenSSL rightly says the
//! opposite, and from which version on. Without OpenSSL that half is skipped and says so; with
//! `OPCUA_INTEROP_REQUIRED=1` that is a failure.

mod agreement;
mod der;
mod forge;
mod openssl;
mod table;
mod world;

use std::collections::BTreeSet;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use table::{Case, Peer};

#[test]
fn every_chain_gets_its_opc_ua_status_and_openssl_agrees_where_it_should() {
    let cases = table::cases();
    assert!(cases.len() >= 300, "{} cases", cases.len());
    let names: BTreeSet<&str> = cases.iter().map(|case| case.name.as_str()).collect();
    assert_eq!(names.len(), cases.len(), "two cases have the same name");
    let version = openssl::Version::ask();
    match &version {
        Some(version) => eprintln!("compared with {}", version.text),
        None => {
            assert!(std::env::var_os("OPCUA_INTEROP_REQUIRED").is_none(), "there is no `openssl`");
            eprintln!("SKIPPED the half with OpenSSL: there is no `openssl`");
        }
    }
    let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                let folder = tempfile::tempdir().expect("a temporary folder");
                while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if let Err(why) = check(case, version.as_ref().map(|version| (version, folder.path()))) {
                        wrong.lock().unwrap().push(format!("{}: {why}", case.name));
                    }
                }
            });
        }
    });
    let wrong = wrong.into_inner().unwrap();
    let version = version.map_or("no OpenSSL".to_owned(), |version| version.text);
    let (count, all, list) = (wrong.len(), cases.len(), wrong.join("\n"));
    assert!(wrong.is_empty(), "{count} of {all} cases are wrong, with {version}:\n{list}");
}

fn check(case: &Case, openssl: Option<(&openssl::Version, &std::path::Path)>) -> Result<(), String> {
    let built = case.world.built();
    let status = world::judge(&case.world, &built)?;
    if status != case.expected {
        return Err(format!("{status:?} instead of {:?}", case.expected));
    }
    let Some((version, folder)) = openssl else { return Ok(()) };
    let Some(peer) = case.peer.of(version) else {
        eprintln!("SKIPPED OpenSSL's half of \"{}\": {} does not say when it was released", case.name, version.text);
        return Ok(());
    };
    let (accepts, said) = openssl::accepts(&case.world, &built, folder);
    match peer {
        Peer::Agrees if accepts != status.is_none() => Err(format!("we say {status:?}, OpenSSL says:\n{said}")),
        Peer::Differs(why) if accepts == status.is_none() => {
            Err(format!("OpenSSL agrees that it is {status:?}, though \"{why}\":\n{said}"))
        }
        _ => Ok(()),
    }
}
