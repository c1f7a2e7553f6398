//! Counts the work that must not be cut off when the window closes.

use std::sync::Arc;
use std::time::{Duration, Instant};

use parking_lot::{Condvar, Mutex};

/// A counter shared by the backend and the work it has started.
#[derive(Clone)]
pub(super) struct UnfinishedWork(Arc<Shared>);

struct Shared {
    count: Mutex<usize>,
    changed: Condvar,
    /// Called whenever the count has become zero.
    wake: Box<dyn Fn() + Send + Sync>,
}

/// One piece of work that is counted until this is dropped.
pub(super) struct WorkGuard(UnfinishedWork);

impl UnfinishedWork {
    pub(super) fn new(wake: impl Fn() + Send + Sync + 'static) -> Self {
        Self(Arc::new(Shared { count: Mutex::new(0), changed: Condvar::new(), wake: Box::new(wake) }))
    }

    pub(super) fn begin(&self) -> WorkGuard {
        *self.0.count.lock() += 1;
        WorkGuard(self.clone())
    }

    pub(super) fn is_empty(&self) -> bool {
        *self.0.count.lock() == 0
    }

    /// Blocks until nothing is counted, for at most `limit`. Returns whether nothing is.
    pub(super) fn wait(&self, limit: Duration) -> bool {
        let until = Instant::now() + limit;
        let mut count = self.0.count.lock();
        while *count > 0 {
            if self.0.changed.wait_until(&mut count, until).timed_out() {
                return *count == 0;
            }
        }
        true
    }
}

impl Drop for WorkGuard {
    fn drop(&mut self) {
        let shared = &self.0.0;
        let mut count = shared.count.lock();
        *count -= 1;
        if *count == 0 {
            drop(count);
            shared.changed.notify_all();
            (shared.wake)();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    #[test]
    fn work_is_counted_until_it_ends() {
        let woken = Arc::new(AtomicUsize::new(0));
        let work = UnfinishedWork::new({
            let woken = woken.clone();
            move || {
                woken.fetch_add(1, Ordering::SeqCst);
            }
        });
        let (one, other) = (work.begin(), work.begin());
        drop(one);
        assert!(!work.is_empty() && !work.wait(Duration::from_millis(1)));
        assert_eq!(woken.load(Ordering::SeqCst), 0);
        let ending = std::thread::spawn(move || drop(other));
        assert!(work.wait(Duration::from_secs(60)));
        ending.join().unwrap();
        assert!(work.is_empty());
        assert_eq!(woken.load(Ordering::SeqCst), 1);
    }
}
