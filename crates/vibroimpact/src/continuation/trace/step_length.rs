//! The length of a step along a curve: halved where a step fails, increased where steps converge easily.

/// The length of the next step, with its largest and smallest value.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepLength {
    pub(crate) now: f64,
    pub(crate) longest: f64,
    pub(crate) shortest: f64,
}

impl StepLength {
    /// Halves the length of the next step.
    pub(crate) fn halve(&mut self) {
        self.now *= 0.5;
    }

    /// Multiplies the length of the next step by `factor`, up to the largest length.
    pub(crate) fn grow(&mut self, factor: f64) {
        self.now = (factor * self.now).min(self.longest);
    }

    /// Tries steps, each half as long as the one before, until `attempt` succeeds; `None` if the length would become
    /// less than the smallest.
    pub(crate) fn find<T>(&mut self, attempt: impl Fn(f64) -> Option<T>) -> Option<T> {
        loop {
            if let Some(taken) = attempt(self.now) {
                return Some(taken);
            }
            self.halve();
            if self.now < self.shortest {
                return None;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halved_until_it_is_short_enough_or_too_short() {
        let mut step = StepLength { now: 1.0, longest: 1.0, shortest: 0.01 };
        assert_eq!(step.find(|h| (h <= 0.2).then_some(h)), Some(0.125));
        step.grow(1.6);
        assert_eq!(step.now, 0.2);
        step.grow(100.0);
        assert_eq!((step.now, step.find(|_| None::<f64>)), (1.0, None));
    }
}
