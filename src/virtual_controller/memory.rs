/// Returns to the system what stopped OPC UA servers leave free: about 10 MB each, which glibc would keep for a next
/// one that may never come. Soon, on another thread, and once for all that stop at about the same time.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn give_back() {
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::Duration;

    static PENDING: AtomicBool = AtomicBool::new(false);
    const PAUSE: Duration = Duration::from_secs(1);

    if PENDING.swap(true, Ordering::AcqRel) {
        return;
    }
    // A thread of its own: a runtime that ends meanwhile would never take the mark back.
    let thread = std::thread::Builder::new().name("memory".to_owned()).spawn(|| {
        std::thread::sleep(PAUSE);
        PENDING.store(false, Ordering::Release);
        // SAFETY: may be called at any time from any thread (malloc_trim(3)).
        unsafe { libc::malloc_trim(0) };
    });
    if thread.is_err() {
        PENDING.store(false, Ordering::Release);
    }
}

#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
pub fn give_back() {}
