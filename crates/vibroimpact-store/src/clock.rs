//! The processor time of a thread.

use std::time::Duration;

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
}
