//! Hundreds of certificate chains, with one flaw each or none, judged by this program and by OpenSSL.
//!
//! What OPC UA says of each stands in the table (`trust_corpus/table.rs`), and so does where OpenSSL rightly says the
//! opposite. Without OpenSSL that half is skipped and says so; with `OPCUA_INTEROP_REQUIRED=1` that is a failure.

#[path = "trust_corpus/der.rs"]
mod der;
#[path = "trust_corpus/forge.rs"]
mod forge;
#[path = "trust_corpus/openssl.rs"]
mod openssl;
#[path = "trust_corpus/table.rs"]
mod table;
#[path = "trust_corpus/world.rs"]
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
    let with_openssl = openssl::is_there();
    if !with_openssl {
        assert!(std::env::var_os("OPCUA_INTEROP_REQUIRED").is_none(), "there is no `openssl`");
        eprintln!("SKIPPED the half with OpenSSL: there is no `openssl`");
    }
    let (next, wrong) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(2, usize::from) {
            scope.spawn(|| {
                let folder = tempfile::tempdir().expect("a temporary folder");
                while let Some(case) = cases.get(next.fetch_add(1, Ordering::Relaxed)) {
                    if let Err(why) = check(case, with_openssl.then(|| folder.path())) {
                        wrong.lock().unwrap().push(format!("{}: {why}", case.name));
                    }
                }
            });
        }
    });
    let wrong = wrong.into_inner().unwrap();
    assert!(wrong.is_empty(), "{} of {} cases are wrong:\n{}", wrong.len(), cases.len(), wrong.join("\n"));
}

fn check(case: &Case, folder: Option<&std::path::Path>) -> Result<(), String> {
    let built = case.world.built();
    let status = world::judge(&case.world, &built)?;
    if status != case.expected {
        return Err(format!("{status:?} instead of {:?}", case.expected));
    }
    let Some(folder) = folder else { return Ok(()) };
    let (accepts, said) = openssl::accepts(&case.world, &built, folder);
    match case.peer {
        Peer::Agrees if accepts != status.is_none() => Err(format!("we say {status:?}, OpenSSL says:\n{said}")),
        Peer::Differs(why) if accepts == status.is_none() => {
            Err(format!("OpenSSL agrees that it is {status:?}, though \"{why}\":\n{said}"))
        }
        _ => Ok(()),
    }
}
