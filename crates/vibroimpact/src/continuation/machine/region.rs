//! The region of a plane of two numbers of a machine in which a motion exists or is stable.
//!
//! The cycles with the label are searched for at some points of a grid, and followed from there to all others: from one point to the
//! next by Newton's method on the motion itself, so that every cycle found is admissible. The edge of the set of points to which
//! a cycle can be followed is outlined to the resolution of [`HALVINGS`] and named by what the nearest cycle inside comes to.

use super::curves::Plane;
use crate::continuation::curves::node;
use crate::continuation::regions::{Bound, Outline, Polygon, Region, RegionKind, RegionOptions};
use crate::math::{Multiplier, hypot, sort_by};
use crate::orbit::{Count, Label, MachineFrame, MachineLap, find_unreduced, machine::Cycle};
use crate::verdict::scattered_machine_starts;
use core::cell::RefCell;

/// The cycles are searched for at every so many points of the grid in each direction, or at more of them where there would be less
/// than [`LEAST`].
const EVERY: u32 = 3;
const LEAST: u32 = 3;
/// The number of starts from which they are searched for at each of these points.
const STARTS: u64 = 8;
/// Two cycles at one point that differ by less are the same.
const SAME: f64 = 1e-6;
/// A way along which a cycle cannot be followed at once is halved up to so many times.
const DEEPEST: u32 = 3;
/// From so many of the nearest points with a cycle it is followed to another one.
const NEAREST: usize = 3;
/// A way shorter than this, in steps of the grid, is not halved, and no other point is tried: the edge is between both.
const SHORT: f64 = 0.1;
/// The number of halvings of the way between neighbouring points of the grid by which the edge is located.
const HALVINGS: u32 = 20;
/// The longest edge of a polygon and its largest distance from the true edge, in quarters of the frame.
const EDGE: (f64, f64) = (0.1, 1e-3);
/// A multiplier this near to the unit circle, at the last cycle inside, is that of a bifurcation.
const NEAR: f64 = 5e-2;
/// How far beyond an edge the closings are counted, in quarters of the frame: farther than the edge is off.
const BESIDE: f64 = 1e-5;

/// A cycle, and the values of both numbers.
#[derive(Clone, Debug)]
struct Known {
    at: (f64, f64),
    cycle: Cycle,
}

/// The cycles with a label at some points of a grid over a plane. The regions of existence and of stability begin with the same.
#[derive(Clone, Debug)]
pub struct Seeds {
    label: Label,
    grid: (u32, u32),
    cycles: Vec<((u32, u32), Cycle)>,
}

struct Search<'a> {
    plane: &'a Plane,
    seeds: &'a Seeds,
    kind: RegionKind,
    /// All cycles so far.
    known: RefCell<Vec<Known>>,
    go_on: &'a dyn Fn() -> bool,
}

impl Plane {
    /// The region of the cycles with the label `label`; `None` when `go_on` returned false, which is called at each cycle that is
    /// computed. Over the oscillators that the machines [are](Self::reduced), [`region`](crate::continuation::region) is faster and
    /// more accurate.
    ///
    /// The polygons contain the points to which a cycle could be followed from another point. Cycles are searched for at every
    /// third point of the grid (of a small grid at three in each direction or more), so parts of the region with fewer points can
    /// be missed, and so can orbits that are not stable and to which no start leads. The largest distance between the edges of a
    /// polygon and the true edge is about $`10^{-3}`$ of a quarter of the frame. Points of the grid at which a cycle was found
    /// outside the polygons, or none inside, are [unresolved](Region::unresolved). Of the options, `grid` and `vertices` are used.
    ///
    /// ```
    /// use vibroimpact::Label;
    /// use vibroimpact::continuation::{RegionKind, RegionOptions, machine::Plane};
    /// use vibroimpact::machine::{Machine, MachineParts};
    /// let parts = MachineParts::new(["frame", "head"]).with_mass(0, 1.0).with_mass(1, 0.5);
    /// let parts = parts.with_link(&[1.0, 0.0], 1.0, 0.1).with_link(&[1.0, -1.0], 1.0, 0.1).with_frequency(1.0);
    /// let parts = parts.with_force(0, 1, 0.0, 1.0).with_rigid_stop("anvil", &[0.0, 1.0], 0.5, 0.6);
    /// let plane = Plane::of_paths(&Machine::new(parts)?, ("frequency", "stop.anvil.gap"), (1.0..=1.3, 0.3..=0.9))?;
    /// let options = RegionOptions { grid: (6, 6), ..RegionOptions::default() };
    /// let found = plane.region_while(Label::new(1, 1), RegionKind::Stability, options, &|| true).expect("it is not stopped");
    /// assert!(found.contains((1.2, 0.5)));
    /// # Ok::<(), vibroimpact::machine::MachineError>(())
    /// ```
    #[must_use]
    pub fn region_while(
        &self,
        label: Label,
        kind: RegionKind,
        options: RegionOptions,
        go_on: &dyn Fn() -> bool,
    ) -> Option<Region> {
        self.region_from(&self.seeds_while(label, options, go_on)?, kind, options, go_on)
    }

    /// The cycles from which [regions](Self::region_from) begin; `None` when `go_on` returned false.
    #[must_use]
    pub fn seeds_while(&self, label: Label, options: RegionOptions, go_on: &dyn Fn() -> bool) -> Option<Seeds> {
        let (columns, rows) = options.grid;
        let some = |count: u32| {
            let every = (count / LEAST).clamp(1, EVERY);
            (0..count).filter(move |k| k % every == every / 2)
        };
        let mut cycles = Vec::new();
        for place in some(rows).flat_map(|j| some(columns).map(move |i| (i, j))) {
            let at = node(&self.ranges, place, options.grid);
            let Some(machine) = self.family.machine(at.into()) else { continue };
            let starts = (0..STARTS).map(|k| scattered_machine_starts(&machine, 1, k));
            let found = find_unreduced(&machine, label, starts, go_on)?;
            cycles.extend(found.into_iter().map(|cycle| (place, cycle)));
        }
        Some(Seeds { label, grid: options.grid, cycles })
    }

    /// The [region](Self::region_while) of the cycles to which these lead, with the same options.
    #[must_use]
    pub fn region_from(
        &self,
        seeds: &Seeds,
        kind: RegionKind,
        options: RegionOptions,
        go_on: &dyn Fn() -> bool,
    ) -> Option<Region> {
        Search { plane: self, seeds, kind, known: RefCell::default(), go_on }.region(options)
    }
}

impl Search<'_> {
    /// The point `(i, j)` of the grid.
    fn node(&self, place: (u32, u32)) -> (f64, f64) {
        node(&self.plane.ranges, place, self.seeds.grid)
    }

    fn wanted(&self, cycle: &Cycle) -> bool {
        cycle.label == self.seeds.label && (self.kind == RegionKind::Existence || cycle.stable())
    }

    /// The cycle at `to` to which one at `from` leads, followed along the straight line between both.
    fn followed(&self, from: &Known, to: (f64, f64), depth: u32) -> Option<Cycle> {
        (self.go_on)().then_some(())?;
        let there = || {
            let machine = self.plane.family.machine(to.into())?;
            let (begin, time) = (from.cycle.strobes.first()?, (from.cycle.label.periods, from.cycle.period));
            Cycle::lasting(&MachineFrame::new(&machine), begin, time).filter(|cycle| self.wanted(cycle))
        };
        there().or_else(|| {
            // the way is halved, and the cycle followed to its middle first
            let half = depth.checked_sub(1)?;
            let at = (0.5 * (from.at.0 + to.0), 0.5 * (from.at.1 + to.1));
            let middle = Known { at, cycle: self.followed(from, at, half)? };
            self.followed(&middle, to, half)
        })
    }

    /// The distance of two points in quarters of the frame.
    fn apart(&self, a: (f64, f64), b: (f64, f64)) -> f64 {
        let [p, q] = self.plane.scales();
        hypot((a.0 - b.0) / p, (a.1 - b.1) / q)
    }

    /// The cycles nearest to a point, the nearest first.
    fn nearest(&self, at: (f64, f64)) -> Vec<Known> {
        let known = self.known.borrow();
        let mut places: Vec<(f64, usize)> =
            known.iter().enumerate().map(|(k, one)| (self.apart(one.at, at), k)).collect();
        sort_by(&mut places, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        places.truncate(NEAREST);
        places.into_iter().map(|(_, k)| known[k].clone()).collect()
    }

    /// Whether a cycle can be followed to a point; it is remembered.
    fn holds(&self, at: (f64, f64)) -> bool {
        // closer than the edge is outlined, one short try decides
        let mut from = self.nearest(at);
        let short =
            |from: &Known| self.apart(from.at, at) * f64::from(self.seeds.grid.0.min(self.seeds.grid.1)) < 4.0 * SHORT;
        let depth = if from.first().is_some_and(short) { 0 } else { DEEPEST };
        from.truncate(if depth == 0 { 1 } else { NEAREST });
        let found = from.iter().find_map(|from| self.followed(from, at, depth));
        let holds = found.is_some();
        self.known.borrow_mut().extend(found.map(|cycle| Known { at, cycle }));
        holds
    }

    /// Adds a cycle at a point if it is another one there.
    fn learn(&self, at: (f64, f64), cycle: Cycle) -> bool {
        let mut known = self.known.borrow_mut();
        let new = !known.iter().any(|other| other.at == at && other.cycle.same_as(&cycle, SAME));
        if new {
            known.push(Known { at, cycle });
        }
        new
    }

    /// Follows the first cycles to the neighbours of their points, and so on until none is new.
    fn survey(&self) -> Option<()> {
        let (columns, rows) = self.seeds.grid;
        let wanted = |(_, cycle): &&((u32, u32), Cycle)| self.wanted(cycle);
        // they are taken from the end: so the first point comes first
        let mut waiting: Vec<((u32, u32), Cycle)> = self.seeds.cycles.iter().filter(wanted).rev().cloned().collect();
        while let Some(((i, j), cycle)) = waiting.pop() {
            (self.go_on)().then_some(())?;
            let from = Known { at: self.node((i, j)), cycle };
            if !self.learn(from.at, from.cycle.clone()) {
                continue;
            }
            // a number below 0 wraps and is left out with those beyond the grid
            let beside = [(i.wrapping_sub(1), j), (i + 1, j), (i, j.wrapping_sub(1)), (i, j + 1)];
            for next in beside.into_iter().filter(|&(k, l)| k < columns && l < rows) {
                waiting.extend(self.followed(&from, self.node(next), DEEPEST).map(|cycle| (next, cycle)));
            }
        }
        Some(())
    }

    /// The region, with its edges.
    fn region(&self, options: RegionOptions) -> Option<Region> {
        self.survey()?;
        // before the outline finds more
        let found: Vec<(f64, f64)> = self.known.borrow().iter().map(|one| one.at).collect();
        let options = RegionOptions { longest: EDGE.0, accuracy: EDGE.1, ..options };
        let (columns, rows) = self.seeds.grid;
        let cells = columns.max(rows);
        let holds = |at| self.holds(at);
        let polygons =
            Outline { ranges: &self.plane.ranges, cells, halvings: HALVINGS, options, holds: &holds }.polygons();
        let polygons = polygons.into_iter().map(|polygon| self.named(polygon)).collect();
        let mut region = Region { polygons, unresolved: Vec::new() };
        let nodes = (0..rows).flat_map(|j| (0..columns).map(move |i| self.node((i, j))));
        region.unresolved = nodes.filter(|at| found.contains(at) != region.contains(*at)).collect();
        (self.go_on)().then_some(region)
    }

    /// The same polygon with the names of its edges.
    fn named(&self, mut polygon: Polygon) -> Polygon {
        for vertex in polygon.vertices.iter_mut().filter(|vertex| vertex.bound == Bound::Touch) {
            vertex.bound = self.bound(vertex.values).unwrap_or(Bound::Change);
        }
        polygon
    }

    /// What bounds the region close to the last point inside: another number of closings of the motion a little beyond, or a
    /// multiplier of its cycle on the unit circle. An orbit that ceases to exist with its events does so at a fold, where a multiplier
    /// is +1; close to a torus bifurcation it is one of a complex pair until right before.
    fn bound(&self, at: (f64, f64)) -> Option<Bound> {
        let Known { cycle, .. } = self.nearest(at).into_iter().next()?;
        // existence ends at +1 only; stability at any point of the circle
        let off = |m: &Multiplier| match self.kind {
            RegionKind::Existence => hypot(m.re - 1.0, m.im),
            RegionKind::Stability => (m.modulus() - 1.0).abs(),
        };
        let nearest = || cycle.multipliers.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        let bifurcation = |m: &Multiplier| match (m.im == 0.0 || self.kind == RegionKind::Existence, m.re > 0.0) {
            (true, true) => Bound::Fold,
            (true, false) => Bound::Flip,
            _ => Bound::Torus,
        };
        self.beyond(at, &cycle).or_else(|| nearest().filter(|m| off(m) < NEAR).map(bifurcation))
    }

    /// Whether the motion has more closings or fewer right outside.
    fn beyond(&self, (p, q): (f64, f64), cycle: &Cycle) -> Option<Bound> {
        let Count::Finite(closings) = cycle.label.impacts else { return None };
        let [by, up] = self.plane.scales().map(|scale| BESIDE * scale);
        [(by, 0.0), (-by, 0.0), (0.0, up), (0.0, -up)].into_iter().find_map(|(dp, dq)| {
            let machine = self.plane.family.machine([p + dp, q + dq])?;
            let lap = MachineLap::replay(&MachineFrame::new(&machine), cycle.strobes.first()?, cycle.period)?;
            let count = lap.events.iter().filter(|event| event.closes()).count();
            match count.cmp(&(closings as usize)) {
                // an impact has lost its speed, or a new one has come
                core::cmp::Ordering::Less => Some(Bound::NoSpeed),
                core::cmp::Ordering::Greater => Some(Bound::Touch),
                core::cmp::Ordering::Equal => None,
            }
        })
    }
}
