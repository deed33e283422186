//! The processor time of a thread, and pauses between writes.

use std::time::{Duration, Instant};

/// Minimum time between two writes.
const SHORTEST: Duration = Duration::from_secs(2);
/// The part of the time that writes may take.
const PART: u32 = 50;

/// The time until something is written again: it is longer where writes take longer.
#[derive(Debug, Default)]
pub(crate) struct Pause {
    /// The end of the last write, or the begin of the work, and how long the pause is from then.
    last: Option<(Instant, Duration)>,
}

impl Pause {
    /// Whether it is over. It begins with the first call.
    pub(crate) fn is_over(&mut self) -> bool {
        let (from, pause) = *self.last.get_or_insert_with(|| (Instant::now(), SHORTEST));
        from.elapsed() >= pause
    }

    /// Writes, and begins another pause.
    pub(crate) fn during(&mut self, write: impl FnOnce()) {
        let begun = Instant::now();
        write();
        self.last = Some((Instant::now(), (begun.elapsed() * PART).max(SHORTEST)));
    }
}

/// The processor time that this thread has used.
#[cfg(unix)]
pub(crate) fn thread_time() -> Duration {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime);
    let part = |of: i64| u64::try_from(of).unwrap_or(0);
    Duration::new(part(time.tv_sec), 0) + Duration::from_nanos(part(time.tv_nsec))
}

/// On other systems, the time since the first call.
#[cfg(not(unix))]
pub(crate) fn thread_time() -> Duration {
    static BEGUN: std::sync::OnceLock<std::time::Instant> = std::sync::OnceLock::new();
    BEGUN.get_or_init(std::time::Instant::now).elapsed()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_takes_processor_time() {
        let begun = thread_time();
        let mut sum = 0_u64;
        while thread_time() == begun {
            sum = std::hint::black_box(sum.wrapping_add(1));
        }
        assert!(thread_time() > begun);
    }

    #[test]
    fn pauses_have_a_least_length() {
        let mut pause = Pause::default();
        assert!(!pause.is_over());
        pause.during(|| {});
        assert!(!pause.is_over() && pause.last.is_some_and(|(_, length)| length >= SHORTEST));
        pause.last = Some((Instant::now(), Duration::ZERO));
        assert!(pause.is_over());
    }
}
