//! The extent of marks.

/// The smallest and largest finite value so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Extent {
    range: Option<(f64, f64)>,
    /// Whether only positive values count, for a logarithmic axis.
    positive: bool,
}

impl Extent {
    pub(crate) fn new(positive: bool) -> Self {
        Self { range: None, positive }
    }

    pub(crate) fn see(&mut self, value: f64) {
        if value.is_finite() && (!self.positive || value > 0.0) {
            let (lo, hi) = self.range.unwrap_or((value, value));
            self.range = Some((lo.min(value), hi.max(value)));
        }
    }

    pub(crate) fn see_all(&mut self, values: &[f64]) {
        for &value in values {
            self.see(value);
        }
    }

    pub(crate) fn range(&self) -> Option<(f64, f64)> {
        self.range
    }
}

#[cfg(test)]
mod tests {
    use super::Extent;

    #[test]
    fn extents_skip_what_cannot_be_shown() {
        let mut all = Extent::new(false);
        all.see_all(&[f64::NAN, 2.0, f64::INFINITY, -1.0]);
        assert_eq!(all.range(), Some((-1.0, 2.0)));
        let mut positive = Extent::new(true);
        positive.see_all(&[0.0, -3.0]);
        assert_eq!(positive.range(), None);
    }
}
