//! Waits until the system or the user asks the program to end.

/// Returns when the program is to end properly:
///
/// - Unix: SIGINT (Ctrl-C), SIGTERM (a service manager), SIGHUP (the terminal was closed; not under `nohup`).
/// - Windows: Ctrl-C, Ctrl-Break, the console window was closed, log-off, shutdown, `taskkill`. Windows allows about 5 s from then.
///
/// Never returns if the system allows the program to receive none of them.
pub async fn stop_signal() {
    #[cfg(unix)]
    unix::stop_signal().await;
    #[cfg(windows)]
    super::windows::session_end::stop_signal().await;
}

#[cfg(unix)]
mod unix {
    use std::future::pending;

    use tokio::signal::unix::{SignalKind, signal};

    pub(super) async fn stop_signal() {
        tokio::select! {
            () = one(SignalKind::interrupt()) => {}
            () = one(SignalKind::terminate()) => {}
            () = hang_up() => {}
        }
    }

    async fn one(kind: SignalKind) {
        match signal(kind) {
            Ok(mut signal) => {
                signal.recv().await;
            }
            Err(error) => {
                tracing::warn!(?kind, %error, "the program does not receive this signal");
                pending().await
            }
        }
    }

    async fn hang_up() {
        if is_ignored(libc::SIGHUP) { pending().await } else { one(SignalKind::hangup()).await }
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
