//! How long a step along a curve is: shorter where it fails, longer again where it is easy.

/// The length of the next step, and between which lengths it stays.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepLength {
    pub(crate) now: f64,
    pub(crate) longest: f64,
    pub(crate) shortest: f64,
}

impl StepLength {
    /// The next step is half as long.
    pub(crate) fn halve(&mut self) {
        self.now *= 0.5;
    }

    /// The next step is longer by this factor, as far as it may be.
    pub(crate) fn grow(&mut self, factor: f64) {
        self.now = (factor * self.now).min(self.longest);
    }

    /// Tries steps, each half as long as the one before, until one is taken; `None` where it would have to be shorter than the
    /// shortest.
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
