//! The motions at the points of a grid as a store or a Dataset has them: codes of labels, and what belongs to them.

use crate::ReportError;
use crate::figure::basin::{self, BasinMotion};
use crate::figure::coloured::Value;
use crate::figure::plane::Sides;
use crate::figure::point_motion::{PointMotion, PointMotions};
use std::collections::BTreeMap;
use vibroimpact::math::sort_by_key;
use vibroimpact_plot::Figure;
use vibroimpact_study::study::{NOT_COMPUTED, REFUSED, label_of};

/// The values of a quantity of motions, and its unit at each point.
pub type Values<'a> = (&'a [f64], &'a dyn Fn(usize) -> f64);

/// Motions at points, `width` of them at each, the most frequent first.
#[derive(Clone, Copy, Debug)]
pub struct Cells<'a> {
    /// The codes of their labels.
    pub labels: &'a [i32],
    /// The largest number of motions at a point.
    pub width: usize,
    /// The shares of starts that lead to them; 1 where there is one motion at each point.
    pub shares: Option<&'a [f64]>,
    /// The numbers of their cycles, where all starts are of one system: two cycles may have one label.
    pub cycles: Option<&'a [i32]>,
    /// For each point 1 if it was computed itself, and did not take the label of its neighbours.
    pub computed: Option<&'a [i8]>,
}

impl Cells<'_> {
    fn share(&self, place: usize) -> f64 {
        self.shares.map_or(1.0, |shares| shares[place])
    }

    /// The motions with the values of a quantity in its unit. Points that were not computed, and those that took the
    /// label of their neighbours, have no value.
    #[must_use]
    pub fn points(&self, quantity: Option<Values<'_>>) -> PointMotions {
        let mut all = PointMotions::default();
        let mut known: BTreeMap<i32, Option<(String, usize)>> = BTreeMap::new();
        for (point, codes) in self.labels.chunks(self.width.max(1)).enumerate() {
            // starts of one system share the quantities of their cycle, so those that took it from their neighbours have values
            let own = self.cycles.is_some() || self.computed.is_none_or(|computed| computed.get(point) == Some(&1));
            let mut motions = Vec::new();
            for (k, code) in codes.iter().enumerate() {
                let label = known.entry(*code).or_insert_with(|| {
                    let label = label_of(*code)?;
                    let class = all.class(&label);
                    Some((label, class))
                });
                let Some((label, class)) = label else { continue };
                let place = point * self.width + k;
                let value = match Value::of(label, quantity.map(|(values, unit)| values[place] * unit(point))) {
                    Value::Undefined if !own => Value::NotComputed,
                    value => value,
                };
                motions.push(PointMotion { class: *class, share: self.share(place), value });
            }
            if motions.is_empty() && codes[0] != NOT_COMPUTED {
                // no valid system: it has no motions
                motions.push(PointMotion { class: all.class(""), share: 0.0, value: Value::Undefined });
            }
            all.points.push(motions);
        }
        all
    }

    /// The figure of a basin, in which each start has one motion.
    ///
    /// # Errors
    /// As [`basin::draw`].
    #[allow(clippy::cast_precision_loss)] // counts below 2^53
    pub fn basin(&self, sides: &Sides, title: String) -> Result<Figure, ReportError> {
        let key = |k: usize| (self.labels[k], self.cycles.map_or(-1, |cycles| cycles[k]));
        let mut motions: BTreeMap<(i32, i32), (u16, u64)> = BTreeMap::new();
        let mut cells = Vec::with_capacity(self.labels.len());
        for k in 0..self.labels.len() {
            let next = u16::try_from(motions.len()).unwrap_or(u16::MAX);
            if label_of(key(k).0).is_none() {
                cells.push(u16::MAX);
                continue;
            }
            let entry = motions.entry(key(k)).or_insert((next, 0));
            entry.1 += 1;
            cells.push(entry.0);
        }
        // starts of a machine beyond a rigid stop have no motion
        let total = self.labels.iter().filter(|code| **code != REFUSED).count() as f64;
        let mut list: Vec<_> = motions.into_iter().collect();
        sort_by_key(&mut list, |(_, (number, _))| *number);
        let motion = |((code, _), (_, count)): ((i32, i32), (u16, u64))| BasinMotion {
            label: label_of(code).unwrap_or_default(),
            share: count as f64 / total,
        };
        basin::draw(sides, &list.into_iter().map(motion).collect::<Vec<_>>(), cells, title)
    }
}
