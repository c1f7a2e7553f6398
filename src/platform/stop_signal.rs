//! The requests of the system and of the user that the program end.

/// The requests to end that this process receives.
///
/// - Unix: SIGINT (Ctrl-C), SIGTERM (a service manager), SIGHUP (the terminal was closed; not under `nohup`).
/// - Windows: Ctrl-C, Ctrl-Break, the console window was closed, log-off, shutdown, `taskkill`. Windows allows about 5 s from then.
///
/// From [`StopSignals::listen`] on none of them ends the process by itself, and none is lost between two calls of
/// [`StopSignals::received`].
#[derive(Debug)]
pub struct StopSignals {
    #[cfg(unix)]
    inner: unix::StopSignals,
    #[cfg(windows)]
    inner: super::windows::session_end::StopSignals,
}

impl StopSignals {
    /// Begins to receive the requests, so call it before anything is announced that a caller may answer with one.
    ///
    /// # Panics
    /// Outside a Tokio runtime.
    #[must_use]
    pub fn listen() -> Self {
        Self {
            #[cfg(unix)]
            inner: unix::StopSignals::listen(),
            #[cfg(windows)]
            inner: super::windows::session_end::StopSignals::listen(),
        }
    }

    /// Returns at the next request. Never returns if the system allows the program to receive none of them.
    pub async fn received(&mut self) {
        self.inner.received().await;
    }

    /// Calls `on_first` at the first request. The second one ends the process at once, with the exit code 130 that shells
    /// report of a program that Ctrl-C ended.
    pub async fn end_at_second(mut self, on_first: impl FnOnce()) {
        self.received().await;
        on_first();
        self.received().await;
        std::process::exit(INTERRUPTED);
    }
}

const INTERRUPTED: i32 = 130;

#[cfg(unix)]
mod unix {
    use std::future::pending;

    use tokio::signal::unix::{Signal, SignalKind, signal};

    #[derive(Debug)]
    pub(super) struct StopSignals {
        interrupt: Option<Signal>,
        terminate: Option<Signal>,
        hang_up: Option<Signal>,
    }

    impl StopSignals {
        pub(super) fn listen() -> Self {
            let hang_up_counts = !is_ignored(libc::SIGHUP);
            Self {
                interrupt: listen_for(SignalKind::interrupt()),
                terminate: listen_for(SignalKind::terminate()),
                hang_up: hang_up_counts.then(|| listen_for(SignalKind::hangup())).flatten(),
            }
        }

        pub(super) async fn received(&mut self) {
            tokio::select! {
                () = next(self.interrupt.as_mut()) => {}
                () = next(self.terminate.as_mut()) => {}
                () = next(self.hang_up.as_mut()) => {}
            }
        }
    }

    fn listen_for(kind: SignalKind) -> Option<Signal> {
        signal(kind).inspect_err(|error| tracing::warn!(?kind, %error, "the program does not receive this signal")).ok()
    }

    async fn next(signal: Option<&mut Signal>) {
        match signal {
            Some(signal) => {
                signal.recv().await;
            }
            None => pending().await,
        }
    }

    /// Whether the program was started with this signal ignored.
    fn is_ignored(signal: libc::c_int) -> bool {
        // SAFETY: a plain structure of which all-zero is a value.
        let mut action: libc::sigaction = unsafe { std::mem::zeroed() };
        // SAFETY: reads the disposition into the structure, which outlives the call; changes nothing.
        let read = unsafe { libc::sigaction(signal, std::ptr::null(), &raw mut action) };
        read == 0 && action.sa_sigaction == libc::SIG_IGN
    }

    #[cfg(test)]
    mod tests {
        #[test]
        fn nohup_is_told_from_a_terminal() {
            // Rust's runtime ignores SIGPIPE.
            assert!(super::is_ignored(libc::SIGPIPE));
            assert!(!super::is_ignored(libc::SIGTERM));
        }
    }
}
