//! The end of the program as Windows announces it: to a console, and at log-off and shutdown to windows only.

use std::ptr::{null, null_mut};
use std::sync::OnceLock;
use std::thread;
use std::time::Duration;

use tokio::signal::windows::{
    CtrlBreak, CtrlC, CtrlClose, CtrlLogoff, CtrlShutdown, ctrl_break, ctrl_c, ctrl_close, ctrl_logoff, ctrl_shutdown,
};
use tokio::sync::Notify;
use windows_sys::Win32::Foundation::{HWND, LPARAM, LRESULT, WPARAM};
use windows_sys::Win32::System::LibraryLoader::GetModuleHandleW;
use windows_sys::Win32::UI::WindowsAndMessaging::{
    CreateWindowExW, DefWindowProcW, DispatchMessageW, GetMessageW, MSG, RegisterClassW, WM_CLOSE, WM_ENDSESSION,
    WM_QUERYENDSESSION, WNDCLASSW,
};

use super::wide;

/// See [`crate::platform::stop_signal::StopSignals`].
///
/// A program that uses windows gets no log-off and shutdown event at its console (SetConsoleCtrlHandler, remarks), so
/// a hidden window waits for WM_ENDSESSION.
#[derive(Debug)]
pub struct StopSignals {
    ctrl_c: Option<CtrlC>,
    ctrl_break: Option<CtrlBreak>,
    ctrl_close: Option<CtrlClose>,
    ctrl_logoff: Option<CtrlLogoff>,
    ctrl_shutdown: Option<CtrlShutdown>,
    ended: &'static Notify,
}

/// The next event of a console, or never where it cannot be received.
macro_rules! next {
    ($event:expr) => {
        async {
            match $event.as_mut() {
                Some(event) => {
                    event.recv().await;
                }
                None => std::future::pending().await,
            }
        }
    };
}

impl StopSignals {
    /// Listens from now on. What cannot be listened to is logged.
    pub fn listen() -> Self {
        let ended = ENDED.get_or_init(Notify::new);
        if let Err(error) = thread::Builder::new().name("session end".to_owned()).spawn(watch) {
            tracing::warn!(%error, "the end of the session is not noticed");
        }
        Self {
            ctrl_c: noticed(ctrl_c(), "Ctrl-C"),
            ctrl_break: noticed(ctrl_break(), "Ctrl-Break"),
            ctrl_close: noticed(ctrl_close(), "the end of the console"),
            ctrl_logoff: noticed(ctrl_logoff(), "log-off"),
            ctrl_shutdown: noticed(ctrl_shutdown(), "shutdown"),
            ended,
        }
    }

    /// Waits for the first of them.
    pub async fn received(&mut self) {
        tokio::select! {
            () = next!(self.ctrl_c) => {}
            () = next!(self.ctrl_break) => {}
            () = next!(self.ctrl_close) => {}
            () = next!(self.ctrl_logoff) => {}
            () = next!(self.ctrl_shutdown) => {}
            () = self.ended.notified() => {}
        }
    }
}

fn noticed<T>(event: std::io::Result<T>, name: &str) -> Option<T> {
    event.inspect_err(|error| tracing::warn!(%error, "{name} is not noticed")).ok()
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
