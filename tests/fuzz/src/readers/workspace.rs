use std::fs;

use opcua_configurator::workspace::{MAX_PARALLELISM, Workspace, WorkspaceLock};
use tempfile::TempDir;

struct TempWorkspace {
    folder: TempDir,
    workspace: Workspace,
    lock: WorkspaceLock,
}

thread_local! {
    static DESK: TempWorkspace = {
        let folder = TempDir::new().expect("a temporary folder");
        let workspace = Workspace::new(folder.path());
        let lock = workspace.lock().expect("a folder of our own");
        TempWorkspace { folder, workspace, lock }
    };
}

/// `Workspace::load`: a file that is no configuration is kept aside as it was; one that is can be saved, and is then
/// loaded the same.
pub fn configuration(bytes: &[u8]) {
    DESK.with(|TempWorkspace { folder, workspace, lock }| {
        fs::write(folder.path().join("epson_opcua_config.json"), bytes).expect("a file of our own");
        let loaded = workspace.load().expect("a folder of our own");
        if let Some((aside, reason)) = &loaded.damaged {
            assert!(!reason.is_empty() && loaded.configuration.controllers.is_empty());
            assert_eq!(fs::read(aside).expect("kept aside"), bytes);
            fs::remove_file(aside).expect("a file of our own");
            return;
        }
        let configuration = loaded.configuration;
        assert!((1..=MAX_PARALLELISM).contains(&configuration.options.parallelism));
        workspace.save(&configuration, lock).expect("what was loaded can be saved");
        assert_eq!(workspace.load().expect("a folder of our own").configuration, configuration);
    });
}
