//! Which programs have a file open, asked of the Restart Manager.

use std::fs::File;
use std::os::windows::fs::OpenOptionsExt as _;
use std::path::Path;
use std::ptr::null;

use windows_sys::Win32::Foundation::ERROR_SHARING_VIOLATION;
use windows_sys::Win32::Storage::FileSystem::DELETE;
use windows_sys::Win32::System::RestartManager::{
    CCH_RM_SESSION_KEY, RM_PROCESS_INFO, RmEndSession, RmGetList, RmRegisterResources, RmStartSession,
};

use super::wide;

/// Programs that have a file open, each with its process number; at most 8. Empty if Windows does not say.
pub fn holders(path: &Path) -> Vec<String> {
    let Ok(path) = std::path::absolute(path) else { return Vec::new() };
    let name = wide(&path);
    let mut session = 0;
    let mut key = [0; CCH_RM_SESSION_KEY as usize + 1];
    // SAFETY: the key is as long as documented.
    if unsafe { RmStartSession(&raw mut session, 0, key.as_mut_ptr()) } != 0 {
        return Vec::new();
    }
    let mut found = vec![RM_PROCESS_INFO::default(); MOST];
    let (mut needed, mut count, mut reasons) = (0, MOST as u32, 0);
    let files = [name.as_ptr()];
    // SAFETY: one file name that ends with a zero; `found` has room for `count` entries, and `count` is then how many
    // were written; the session is ended.
    unsafe {
        let registered = RmRegisterResources(session, 1, files.as_ptr(), 0, null(), 0, null());
        let listed = registered == 0
            && RmGetList(session, &raw mut needed, &raw mut count, found.as_mut_ptr(), &raw mut reasons) == 0;
        if !listed {
            count = 0;
        }
        RmEndSession(session);
    }
    found.truncate(count as usize);
    found.iter().map(name_of).collect()
}

/// Whether another handle keeps a file from being replaced or removed.
pub fn is_open_elsewhere(path: &Path) -> bool {
    let opened = File::options().access_mode(DELETE).open(path);
    let code = opened.err().and_then(|error| error.raw_os_error());
    code.map(i32::cast_unsigned) == Some(ERROR_SHARING_VIOLATION)
}

fn name_of(process: &RM_PROCESS_INFO) -> String {
    let name = &process.strAppName;
    let end = name.iter().position(|unit| *unit == 0).unwrap_or(name.len());
    format!("{} (process {})", String::from_utf16_lossy(&name[..end]), process.Process.dwProcessId)
}

const MOST: usize = 8;
