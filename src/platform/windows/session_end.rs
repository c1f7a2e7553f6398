//! The end of the program as Windows announces it: to a console, and at log-off and shutdown to windows only.

use std::ptr::{null, null_mut};
use std::sync::OnceLock;
use std::thread;
use std::time::Duration;

use tokio::signal::windows::{ctrl_break, ctrl_c, ctrl_close, ctrl_logoff, ctrl_shutdown};
use tokio::sync::Notify;
use windows_sys::Win32::Foundation::{HWND, LPARAM, LRESULT, WPARAM};
use windows_sys::Win32::System::LibraryLoader::GetModuleHandleW;
use windows_sys::Win32::UI::WindowsAndMessaging::{
    CreateWindowExW, DefWindowProcW, DispatchMessageW, GetMessageW, MSG, RegisterClassW, WM_CLOSE, WM_ENDSESSION,
    WM_QUERYENDSESSION, WNDCLASSW,
};

use super::wide;

/// See [`crate::platform::stop_signal::stop_signal`].
///
/// A program that uses windows gets no log-off and shutdown event at its console (SetConsoleCtrlHandler, remarks), so
/// a hidden window waits for WM_ENDSESSION.
pub async fn stop_signal() {
    let ended = ENDED.get_or_init(Notify::new);
    if let Err(error) = thread::Builder::new().name("session end".to_owned()).spawn(watch) {
        tracing::warn!(%error, "the end of the session is not noticed");
    }
    macro_rules! event {
        ($listen:ident) => {
            async {
                match $listen() {
                    Ok(mut event) => {
                        event.recv().await;
                    }
                    Err(error) => {
                        tracing::warn!(%error, concat!(stringify!($listen), " is not noticed"));
                        std::future::pending().await
                    }
                }
            }
        };
    }
    tokio::select! {
        () = event!(ctrl_c) => {}
        () = event!(ctrl_break) => {}
        () = event!(ctrl_close) => {}
        () = event!(ctrl_logoff) => {}
        () = event!(ctrl_shutdown) => {}
        () = ended.notified() => {}
    }
}

static ENDED: OnceLock<Notify> = OnceLock::new();

/// Runs a hidden top-level window; windows for messages only are told of no log-off.
fn watch() {
    let class = wide("opcua-configurator-session-end");
    // SAFETY: the class name and the message outlive the calls; the window belongs to this thread.
    unsafe {
        let instance = GetModuleHandleW(null());
        let definition = WNDCLASSW {
            lpfnWndProc: Some(on_message),
            hInstance: instance,
            lpszClassName: class.as_ptr(),
            ..Default::default()
        };
        RegisterClassW(&raw const definition);
        let name = class.as_ptr();
        let window = CreateWindowExW(0, name, name, 0, 0, 0, 0, 0, null_mut(), null_mut(), instance, null());
        if window.is_null() {
            tracing::warn!(error = %std::io::Error::last_os_error(), "log-off and shutdown are not noticed");
            return;
        }
        let mut message = MSG::default();
        while GetMessageW(&raw mut message, null_mut(), 0, 0) > 0 {
            DispatchMessageW(&raw const message);
        }
    }
}

unsafe extern "system" fn on_message(window: HWND, message: u32, w: WPARAM, l: LPARAM) -> LRESULT {
    match message {
        WM_QUERYENDSESSION => 1,
        // Windows ends the process when this returns; the program ends by itself before.
        WM_ENDSESSION if w != 0 => {
            if let Some(ended) = ENDED.get() {
                ended.notify_one();
                thread::sleep(TIME_TO_END);
            }
            0
        }
        // `taskkill` without `/F`.
        WM_CLOSE => {
            if let Some(ended) = ENDED.get() {
                ended.notify_one();
            }
            0
        }
        // SAFETY: the arguments are passed on unchanged.
        _ => unsafe { DefWindowProcW(window, message, w, l) },
    }
}

/// Windows itself ends programs after 5 s.
const TIME_TO_END: Duration = Duration::from_secs(10);
