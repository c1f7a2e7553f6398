use std::fs;
use std::net::Ipv4Addr;

use chrono::DateTime;
use opcua_configurator::model::ClientList;
use opcua_configurator::virtual_controller::{ControllerState, Faults, OperatingContext, Store, StoreError};
use sha2::{Digest as _, Sha256};
use tempfile::TempDir;

thread_local! {
    static FOLDER: (TempDir, Store) = {
        let folder = TempDir::new().expect("a temporary folder");
        let store = Store::open(folder.path(), Faults::default()).expect("a folder of our own");
        (folder, store)
    };
}

/// `Store::load`, once with the bytes as the file and once as what its checksum is right for: a file that is damaged
/// is kept aside; one that is not holds a state a controller may be in, which is stored and loaded the same.
pub fn controller_state(bytes: &[u8]) {
    if let Some(state) = load(bytes) {
        assert_state(&state);
    }
    let header = format!("opcua-virtual-controller 1 {}\n", hex::encode(Sha256::digest(bytes)));
    if let Some(state) = load(&[header.as_bytes(), bytes].concat()) {
        assert_state(&state);
    }
}

fn load(bytes: &[u8]) -> Option<ControllerState> {
    FOLDER.with(|(folder, store)| {
        let path = folder.path().join("controller.state");
        fs::write(&path, bytes).expect("a file of our own");
        match store.load() {
            Ok(state) => state,
            Err(StoreError::Damaged { kept, .. }) => {
                assert_eq!(fs::read(&kept).expect("kept aside"), bytes);
                fs::remove_file(kept).expect("a file of our own");
                None
            }
            Err(StoreError::TooNew { .. }) => {
                assert_eq!(fs::read(path).expect("left as it was"), bytes);
                None
            }
            Err(error) => panic!("{error}"),
        }
    })
}

fn assert_state(state: &ControllerState) {
    state.check().expect("a state a controller may be in");
    let context = OperatingContext {
        now: DateTime::from_timestamp(1_900_000_000, 0).expect("a time"),
        bind: Ipv4Addr::LOCALHOST.into(),
        management_port: 7943,
    };
    let _ = state.check_start(&context);
    drop((state.server_certificate(), state.server_names(&context), state.taken_ports(&context)));
    for list in [ClientList::Trusted, ClientList::Issuers, ClientList::Rejected] {
        state.list(list).iter().for_each(|listed| drop(listed.to_message()));
    }
    FOLDER.with(|(_, store)| {
        store.save(state).expect("a folder of our own");
        assert_eq!(store.load().expect("what was saved").as_ref(), Some(state));
    });
}
