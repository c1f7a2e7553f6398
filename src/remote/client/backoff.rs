use std::time::Duration;

use tokio::time::Instant;

/// How long to wait before the next attempt to connect: half a second after the first failure, twice as long after each
/// further one, at most 30 s.
#[derive(Debug, Default)]
pub(super) struct Backoff {
    failures: u32,
    next: Option<Instant>,
}

const FIRST: Duration = Duration::from_millis(500);
const LONGEST: Duration = Duration::from_secs(30);

impl Backoff {
    pub fn failed(&mut self) {
        self.next = Some(Instant::now() + self.delay());
        self.failures = self.failures.saturating_add(1);
    }

    pub fn succeeded(&mut self) {
        *self = Self::default();
    }

    /// Waits until the next attempt is due.
    pub async fn wait(&self) {
        if let Some(next) = self.next {
            tokio::time::sleep_until(next).await;
        }
    }

    fn delay(&self) -> Duration {
        FIRST.saturating_mul(2_u32.saturating_pow(self.failures)).min(LONGEST)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wait_grows_up_to_its_limit_and_begins_anew_after_a_success() {
        let mut backoff = Backoff::default();
        let mut delays = Vec::new();
        for _ in 0..8 {
            delays.push(backoff.delay().as_millis());
            backoff.failed();
        }
        assert_eq!(delays, [500, 1000, 2000, 4000, 8000, 16_000, 30_000, 30_000]);
        backoff.succeeded();
        assert_eq!(backoff.delay(), FIRST);
    }
}
