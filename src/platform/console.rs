//! Standard streams and messages of a program that has no console window of its own.
//!
//! On Windows the program is one for windows, so that no console window opens behind it. As a command line it then
//! has to attach to the console it was started from. Streams that were redirected to files or pipes stay as they are.
//! On other systems the functions here do nothing.

/// Uses the console of the program that started this one, if there is one. Called first, before anything is printed.
pub fn attach() {
    #[cfg(windows)]
    windows::attach();
}

/// Lets go of that console, which would take the window with it when it is closed. Called before the window opens.
pub fn detach() {
    #[cfg(windows)]
    windows::detach();
}

/// Whether standard error is shown anywhere: false on Windows for a program that was started by a
/// double click, or that let go of its console.
pub fn has_error_stream() -> bool {
    #[cfg(windows)]
    return windows::has_error_stream();
    #[cfg(not(windows))]
    true
}

/// Shows a text in a message box, and waits until it is closed. On other systems than Windows it does nothing.
pub fn message_box(title: &str, text: &str) {
    #[cfg(windows)]
    windows::message_box(title, text);
    #[cfg(not(windows))]
    let _ = (title, text);
}

#[cfg(windows)]
mod windows {
    use std::ptr::{null, null_mut};

    use windows_sys::Win32::Foundation::{GENERIC_READ, GENERIC_WRITE, HANDLE, INVALID_HANDLE_VALUE};
    use windows_sys::Win32::Storage::FileSystem::{
        CreateFileW, FILE_SHARE_READ, FILE_SHARE_WRITE, FILE_TYPE_UNKNOWN, GetFileType, OPEN_EXISTING,
    };
    use windows_sys::Win32::System::Console::{
        ATTACH_PARENT_PROCESS, AttachConsole, FreeConsole, GetConsoleMode, GetStdHandle, STD_ERROR_HANDLE, STD_HANDLE,
        STD_INPUT_HANDLE, STD_OUTPUT_HANDLE, SetStdHandle,
    };
    use windows_sys::Win32::UI::WindowsAndMessaging::{
        MB_ICONERROR, MB_OK, MB_SETFOREGROUND, MB_TASKMODAL, MessageBoxW,
    };

    use crate::platform::windows::wide;

    const STREAMS: [(STD_HANDLE, &str); 3] =
        [(STD_INPUT_HANDLE, "CONIN$"), (STD_OUTPUT_HANDLE, "CONOUT$"), (STD_ERROR_HANDLE, "CONOUT$")];

    pub(super) fn attach() {
        let missing = STREAMS.map(|(stream, _)| handle(stream).is_none());
        // SAFETY: takes no memory of this process.
        if unsafe { AttachConsole(ATTACH_PARENT_PROCESS) } == 0 {
            return;
        }
        for ((stream, device), _) in STREAMS.into_iter().zip(missing).filter(|(_, missing)| *missing) {
            // SAFETY: the name ends with a zero and outlives the call. The handle is a standard stream from now on and
            // is never closed.
            unsafe {
                let handle = CreateFileW(
                    wide(device).as_ptr(),
                    GENERIC_READ | GENERIC_WRITE,
                    FILE_SHARE_READ | FILE_SHARE_WRITE,
                    null(),
                    OPEN_EXISTING,
                    0,
                    null_mut(),
                );
                if handle != INVALID_HANDLE_VALUE {
                    SetStdHandle(stream, handle);
                }
            }
        }
    }

    pub(super) fn detach() {
        for (stream, _) in STREAMS {
            if handle(stream).is_some_and(is_console) {
                // SAFETY: the stream is empty from now on, which the standard library takes for closed.
                unsafe { SetStdHandle(stream, null_mut()) };
            }
        }
        // SAFETY: no handle of the console is used any more.
        unsafe { FreeConsole() };
    }

    pub(super) fn has_error_stream() -> bool {
        handle(STD_ERROR_HANDLE).is_some()
    }

    /// The handle of a standard stream, if it is of a file, a pipe or a console.
    fn handle(stream: STD_HANDLE) -> Option<HANDLE> {
        // SAFETY: asks about a handle that this process has, or that is invalid, which is an answer.
        let (handle, kind) = unsafe {
            let handle = GetStdHandle(stream);
            (handle, GetFileType(handle))
        };
        let is_open = !handle.is_null() && handle != INVALID_HANDLE_VALUE && kind != FILE_TYPE_UNKNOWN;
        is_open.then_some(handle)
    }

    fn is_console(handle: HANDLE) -> bool {
        let mut mode = 0;
        // SAFETY: `mode` outlives the call; the call fails for other handles.
        unsafe { GetConsoleMode(handle, &raw mut mode) != 0 }
    }

    pub(super) fn message_box(title: &str, text: &str) {
        let (title, text) = (wide(title), wide(text));
        // SAFETY: both texts end with a zero and outlive the call.
        unsafe {
            MessageBoxW(
                null_mut(),
                text.as_ptr(),
                title.as_ptr(),
                MB_OK | MB_ICONERROR | MB_SETFOREGROUND | MB_TASKMODAL,
            );
        }
    }
}
