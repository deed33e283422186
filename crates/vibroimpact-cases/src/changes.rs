//! The same machine written in another way: other names, another order, other units, mirrored, twice beside itself.

use crate::case::Case;
use crate::draw::Draw;
use vibroimpact::events::Start;
use vibroimpact::machine::{HarmonicForce, Machine, MachineParts, StopLaw};
use vibroimpact::math::Matrix;

/// A way to write a machine again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rewriting {
    /// Other names, whose alphabetical order is another too.
    Names,
    /// Another order of coordinates, stops, joints and harmonics.
    Order,
    /// Other units of mass, length and time: numbers in the old units times these are those in the new ones.
    Units(f64, f64, f64),
    /// Other signs of some coordinates.
    Signs,
    /// All coordinates with the other sign.
    Mirror,
    /// The machine twice, beside itself.
    Twice,
}

impl Rewriting {
    /// One of each kind, units by powers of two and by other factors.
    pub const ALL: [Self; 8] = [
        Self::Names,
        Self::Order,
        Self::Units(4.0, 0.5, 8.0),
        Self::Units(0.453_592_37, 0.0254, 1.0),
        Self::Units(1.0, 1.0, 1e-3),
        Self::Signs,
        Self::Mirror,
        Self::Twice,
    ];
}

/// A machine written again, and how to read its motion.
#[derive(Clone, Debug)]
pub struct Changed {
    /// The machine.
    pub machine: Machine,
    /// The start.
    pub start: Start,
    /// For each coordinate of it, the coordinate of the old machine and the factor.
    pub coordinates: Vec<(usize, f64)>,
    /// For each stop or joint of it, the one of the old machine.
    pub places: Vec<usize>,
    /// A time is that of the old machine times this.
    pub time: f64,
}

/// A machine whose coordinate `i` is `factor * q[from]`, whose places are these of the old ones.
struct Writing {
    coordinates: Vec<(usize, f64)>,
    stops: Vec<usize>,
    joints: Vec<usize>,
    /// The units of mass, length and time.
    units: (f64, f64, f64),
}

/// The case written again.
///
/// # Panics
/// If the result is no machine, which is a fault of this function.
#[must_use]
pub fn changed(case: &Case, change: Rewriting) -> Changed {
    let parts = case.machine.parts();
    let (n, stops, joints) = (parts.n(), parts.stops.len(), parts.joints.len());
    let mut draw = Draw::new(case.family, case.seed);
    let mut writing = Writing {
        coordinates: (0..n).map(|i| (i, 1.0)).collect(),
        stops: (0..stops).collect(),
        joints: (0..joints).collect(),
        units: (1.0, 1.0, 1.0),
    };
    match change {
        Rewriting::Names => {}
        Rewriting::Order => {
            shuffle(&mut writing.coordinates, &mut draw);
            shuffle(&mut writing.stops, &mut draw);
            shuffle(&mut writing.joints, &mut draw);
        }
        Rewriting::Units(mass, length, time) => writing.units = (mass, length, time),
        Rewriting::Signs => writing.coordinates.iter_mut().for_each(|(_, sign)| *sign = draw.pick(&[1.0, -1.0])),
        Rewriting::Mirror => writing.coordinates.iter_mut().for_each(|(_, sign)| *sign = -1.0),
        Rewriting::Twice => {
            writing.coordinates = [&writing.coordinates[..], &writing.coordinates].concat();
            writing.stops = [&writing.stops[..], &writing.stops].concat();
            writing.joints = [&writing.joints[..], &writing.joints].concat();
        }
    }
    let mut parts = writing.parts(parts);
    if change == Rewriting::Names {
        let renamed = |name: &mut String, k: usize, all: usize| *name = format!("n{:03}-{name}", all - k);
        parts.coordinates.iter_mut().enumerate().for_each(|(k, name)| renamed(name, k, n));
        parts.stops.iter_mut().enumerate().for_each(|(k, stop)| renamed(&mut stop.name, k, stops));
        parts.joints.iter_mut().enumerate().for_each(|(k, joint)| renamed(&mut joint.name, k, joints));
    }
    let machine = Machine::new(parts).unwrap_or_else(|why| panic!("{} {} {change:?}: {why}", case.family, case.seed));
    let (_, length, time) = writing.units;
    let vector = |of: &[f64], unit: f64| -> Vec<f64> {
        if of.is_empty() { Vec::new() } else { writing.vector(of).iter().map(|value| unit * value).collect() }
    };
    let start =
        Start { q: vector(&case.start.q, length), qdot: vector(&case.start.qdot, length / time), ..case.start.clone() };
    let places = writing.stops.iter().copied().chain(writing.joints.iter().map(|k| stops + k)).collect();
    let coordinates = writing.coordinates.iter().map(|(from, sign)| (*from, sign * length)).collect();
    Changed { machine, start, coordinates, places, time }
}

fn shuffle<T>(list: &mut [T], draw: &mut Draw) {
    for k in (1..list.len()).rev() {
        list.swap(k, draw.count(0..=k));
    }
}

impl Writing {
    fn vector(&self, of: &[f64]) -> Vec<f64> {
        self.coordinates.iter().map(|(from, sign)| sign * of[*from]).collect()
    }

    /// A direction of the stop or joint `k` of the new machine. Of two machines beside each other it belongs to one.
    fn direction(&self, of: &[f64], k: usize, all: usize) -> Vec<f64> {
        let mut direction = self.vector(of);
        let n = of.len();
        if direction.len() > n {
            let other = if 2 * k < all { n..2 * n } else { 0..n };
            direction[other].fill(0.0);
        }
        direction
    }

    fn matrix(&self, of: &Matrix, unit: f64) -> Matrix {
        let n = of.rows();
        let mut matrix = Matrix::zeros(self.coordinates.len(), self.coordinates.len());
        for (i, (from, sign)) in self.coordinates.iter().enumerate() {
            for (j, (other, turned)) in self.coordinates.iter().enumerate() {
                if i / n == j / n {
                    matrix[(i, j)] = unit * sign * turned * of[(*from, *other)];
                }
            }
        }
        matrix
    }

    fn parts(&self, of: &MachineParts) -> MachineParts {
        let (mass, length, time) = self.units;
        let (stiffness, damping, force) = (mass / (time * time), mass / time, mass * length / (time * time));
        let n = of.n();
        let name = |name: &str, k: usize, all: usize| {
            if 2 * k >= all && self.coordinates.len() > n { format!("{name}-again") } else { name.to_owned() }
        };
        let coordinates =
            self.coordinates.iter().enumerate().map(|(k, (from, _))| name(&of.coordinates[*from], k, 2 * n));
        let mut parts = MachineParts {
            mass: self.matrix(&of.mass, mass),
            damping: self.matrix(&of.damping, damping),
            stiffness: self.matrix(&of.stiffness, stiffness),
            constant: self.vector(&of.constant).iter().map(|value| force * value).collect(),
            frequency: of.frequency.map(|frequency| frequency / time),
            impacts: of.impacts,
            ..MachineParts::new(coordinates)
        };
        let scaled = |vector: &[f64]| self.vector(vector).iter().map(|value| force * value).collect::<Vec<f64>>();
        for harmonic in of.forces.iter().rev() {
            let HarmonicForce { order, cos, sin } = harmonic;
            parts.forces.push(HarmonicForce { order: *order, cos: scaled(cos), sin: scaled(sin) });
        }
        for (k, from) in self.stops.iter().enumerate() {
            let mut stop = of.stops[*from].clone();
            stop.name = name(&stop.name, k, self.stops.len());
            stop.direction = self.direction(&stop.direction, k, self.stops.len());
            stop.gap *= length;
            for motion in &mut stop.motion {
                (motion.cos, motion.sin) = (length * motion.cos, length * motion.sin);
            }
            if let StopLaw::Compliant { stiffness: k, damping: c, preload: p, .. } = &mut stop.law {
                (*k, *c, *p) = (stiffness * *k, damping * *c, force * *p);
            }
            parts.stops.push(stop);
        }
        for (k, from) in self.joints.iter().enumerate() {
            let mut joint = of.joints[*from].clone();
            joint.name = name(&joint.name, k, self.joints.len());
            joint.direction = self.direction(&joint.direction, k, self.joints.len());
            (joint.sliding, joint.limit) = (force * joint.sliding, force * joint.limit);
            joint.belt *= length / time;
            parts.joints.push(joint);
        }
        parts
    }
}
