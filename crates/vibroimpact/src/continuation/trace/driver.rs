//! The driver of a branch or a curve of any system: an iterator over its points.
//!
//! The [tracer](super::tracer) takes the steps. What is done with a step - the events on it, other equations beyond an
//! event, the end - is that of a [`Path`]: one for branches and one for curves of each system. The driver has what all
//! of them share: the points that wait to be returned, the largest number of points, and the end of a closed path.

use super::tracer::{Problem, Solution, Step, Tracer};
use core::fmt::Debug;
use std::collections::VecDeque;

/// What is known of the solutions of a path.
type Known<P> = <<P as Path>::Problem as Problem>::Known;
/// A solution on a path.
pub(crate) type PathSolution<P> = Solution<Known<P>>;

/// The events of every path.
pub(crate) trait PathEvent: Copy + Debug {
    /// The next point would be the first.
    const CLOSED: Self;
    /// The largest number of points is reached.
    const STEP_LIMIT: Self;
    /// No step converges.
    const NO_CONVERGENCE: Self;
}

/// A branch or a curve of one system, with what it keeps from step to step beside the tracer.
pub(crate) trait Path: Sized {
    type Problem: Problem;
    type Event: PathEvent;
    type Point: Clone + Debug;

    /// Whether the largest number of points is exact. If not, the first point does not count, and the last one is
    /// repeated with its event.
    const EXACT: bool;

    /// The point at a solution; `None` if it cannot be computed.
    fn point(driver: &Driver<Self>, at: &PathSolution<Self>, event: Option<Self::Event>) -> Option<Self::Point>;

    /// Reports the events of a step in order and makes its end the current point, or ends the path at one of them.
    fn go_through(driver: &mut Driver<Self>, step: Step<Known<Self>>);

    /// Goes on or ends the path where no step converges.
    fn stop(driver: &mut Driver<Self>) {
        driver.finish(Self::Event::NO_CONVERGENCE);
    }

    /// A point that the path has instead of the current one where it ends with this event.
    fn limit(_driver: &Driver<Self>, _event: Self::Event) -> Option<Self::Point> {
        None
    }
}

/// A path that is being followed.
#[derive(Clone, Debug)]
pub(crate) struct Driver<P: Path> {
    pub(crate) path: P,
    pub(crate) tracer: Tracer<P::Problem>,
    /// The first solution, as long as the equations have not been exchanged.
    begin: Option<PathSolution<P>>,
    /// The largest number of points, and the number so far.
    most: u32,
    count: u32,
    pending: VecDeque<P::Point>,
    pub(crate) over: bool,
}

/// A closed path has more points than this.
const SHORTEST_LOOP: u32 = 3;

impl<P: Path> Driver<P> {
    /// Begins at the solution of a tracer; `None` if it has no point.
    pub(crate) fn new(path: P, tracer: Tracer<P::Problem>, most: u32) -> Option<Self> {
        let begin = Some(tracer.here.clone());
        let (count, pending) = (u32::from(P::EXACT), VecDeque::new());
        let mut driver = Self { path, tracer, begin, most, count, pending, over: false };
        driver.pending.push_back(P::point(&driver, &driver.tracer.here, None)?);
        Some(driver)
    }

    /// Adds a point. With an exact limit the ordinary point with which it is reached ends the path.
    pub(crate) fn add(&mut self, at: &PathSolution<P>, event: Option<P::Event>) {
        let full = P::EXACT && event.is_none() && self.count + 1 >= self.most;
        let event = if full { Some(P::Event::STEP_LIMIT) } else { event };
        let point = P::point(self, at, event);
        self.push(point);
        self.over |= full;
    }

    /// The number of points so far.
    pub(crate) const fn points_so_far(&self) -> u32 {
        self.count
    }

    fn push(&mut self, point: Option<P::Point>) {
        self.pending.extend(point);
        self.count += 1;
    }

    /// Adds an event that ends the path.
    pub(crate) fn end(&mut self, at: &PathSolution<P>, event: P::Event) {
        self.add(at, Some(event));
        self.over = true;
    }

    /// Ends the path at the current point, or at the limit that its events approach.
    pub(crate) fn finish(&mut self, event: P::Event) {
        match P::limit(self, event) {
            Some(limit) => self.push(Some(limit)),
            None => self.add(&self.tracer.here.clone(), Some(event)),
        }
        self.over = true;
    }

    /// Makes `there` the current point, or ends the path if it is closed.
    pub(crate) fn take(&mut self, there: PathSolution<P>) {
        let closes = |begin| self.tracer.closes(begin, &there);
        let closed = self.count > SHORTEST_LOOP && self.begin.as_ref().is_some_and(closes);
        self.tracer.take(there);
        self.add(&self.tracer.here.clone(), closed.then_some(P::Event::CLOSED));
        self.over |= closed;
    }

    /// Goes on with other equations.
    pub(crate) fn exchange(&mut self, tracer: Tracer<P::Problem>) {
        // with other equations the first point is none of theirs, and no loop closes there
        (self.tracer, self.begin) = (tracer, None);
    }

    /// Takes one step, or ends the path.
    fn advance(&mut self) {
        if self.count >= self.most {
            return self.finish(P::Event::STEP_LIMIT);
        }
        match self.tracer.step() {
            Some(step) => P::go_through(self, step),
            None => P::stop(self),
        }
    }
}

impl<P: Path> Iterator for Driver<P> {
    type Item = P::Point;

    fn next(&mut self) -> Option<P::Point> {
        while self.pending.is_empty() && !self.over {
            self.advance();
        }
        self.pending.pop_front()
    }
}

#[cfg(test)]
mod tests {
    use super::super::equations::Equations;
    use super::super::step_length::StepLength;
    use super::super::tracer::StepRules;
    use super::*;

    /// The unit circle, without test functions.
    #[derive(Clone, Debug)]
    struct Circle;

    impl Equations for Circle {
        fn weights(&self) -> &[f64] {
            &[1.0, 1.0]
        }

        fn at(&self, w: &[f64]) -> Option<(Vec<f64>, Vec<f64>)> {
            Some((vec![w[0] * w[0] + w[1] * w[1] - 1.0], vec![2.0 * w[0], 2.0 * w[1], 0.0, 0.0]))
        }
    }

    impl Problem for Circle {
        type Known = ();
        type Equations = Self;

        fn equations(&self) -> &Self {
            self
        }

        fn rules(&self) -> StepRules {
            StepRules {
                stray: 0.3,
                rounding: 0.0,
                bend: 0.9,
                straight: 0.99,
                few: 3,
                many: 5,
                zero: 1e-11,
                beside: 0.0,
            }
        }

        fn tests(&self) -> usize {
            0
        }

        fn look(&self, _w: &[f64], _tangent: &[f64]) -> Option<(Vec<f64>, ())> {
            Some((Vec::new(), ()))
        }

        fn test(&self, _j: usize, _w: &[f64], _tangent: impl Fn() -> Option<Vec<f64>>) -> Option<f64> {
            None
        }

        fn resolution(&self, _j: usize) -> f64 {
            1e-12
        }

        fn phases(&self) -> usize {
            0
        }
    }

    #[derive(Clone, Copy, Debug, PartialEq)]
    enum End {
        Closed,
        StepLimit,
        NoConvergence,
    }

    impl PathEvent for End {
        const CLOSED: Self = Self::Closed;
        const STEP_LIMIT: Self = Self::StepLimit;
        const NO_CONVERGENCE: Self = Self::NoConvergence;
    }

    /// Once round the circle, with an exact limit or not.
    #[derive(Clone, Debug)]
    struct Round<const EXACT: bool>;

    impl<const EXACT: bool> Path for Round<EXACT> {
        type Problem = Circle;
        type Event = End;
        type Point = (Vec<f64>, Option<End>);

        const EXACT: bool = EXACT;

        fn point(_driver: &Driver<Self>, at: &PathSolution<Self>, event: Option<End>) -> Option<Self::Point> {
            Some((at.w.clone(), event))
        }

        fn go_through(driver: &mut Driver<Self>, step: Step<()>) {
            driver.take(step.there);
        }
    }

    fn round<const EXACT: bool>(most: u32) -> Vec<(Vec<f64>, Option<End>)> {
        let step = StepLength { now: 0.1, longest: 0.2, shortest: 1e-9 };
        let tracer = Tracer::new(Circle, vec![1.0, 0.0], vec![0.0, 1.0], step).unwrap();
        Driver::new(Round::<EXACT>, tracer, most).unwrap().collect()
    }

    #[test]
    fn a_closed_path_ends_where_it_began() {
        let points = round::<true>(1000);
        let (last, others) = points.split_last().unwrap();
        assert!(others.iter().all(|(_, event)| event.is_none()) && last.1 == Some(End::Closed));
        assert!(points.len() > 30 && (last.0[0] - 1.0).abs() < 0.03, "{points:?}");
        assert_eq!(round::<false>(1000), points);
    }

    #[test]
    fn the_largest_number_of_points() {
        let (exact, other) = (round::<true>(10), round::<false>(10));
        assert_eq!((exact.len(), exact[9].1), (10, Some(End::StepLimit)));
        // the first point does not count, and the last one is repeated
        assert_eq!((other.len(), &other[11].0, other[11].1), (12, &other[10].0, Some(End::StepLimit)));
    }
}
