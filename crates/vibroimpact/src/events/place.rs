//! Where a machine is: state, phase, and what its stops and joints do.

use crate::arc::{MachineFlight, Recovery};
use crate::machine::Machine;
use crate::math::dot;
use crate::regime::{ContactState, GuardKind, NoStructure, Normal, Structure};
use crate::system::phase;
use std::collections::BTreeMap;
use std::sync::Arc;

/// The structures of the regimes that a motion has visited.
#[derive(Clone, Debug, Default)]
pub(super) struct Structures(BTreeMap<Vec<ContactState>, Result<Arc<Structure>, NoStructure>>);

impl Structures {
    pub(super) fn get(
        &mut self,
        machine: &Machine,
        normal: &Normal,
        states: &[ContactState],
    ) -> Result<Arc<Structure>, NoStructure> {
        if let Some(known) = self.0.get(states) {
            return known.clone();
        }
        let made = Structure::new(machine, normal, states).map(Arc::new);
        self.0.insert(states.to_vec(), made.clone());
        made
    }
}

/// The state of a machine at one time.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// Mass-normalised coordinates and velocities.
    pub(super) x: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) phase: f64,
    pub(super) states: Vec<ContactState>,
    /// The surfaces of stops that have opened by force.
    pub(super) surfaces: Vec<Option<Recovery>>,
    /// How many derivatives of a guard are zero now.
    pub(super) known: Vec<(GuardKind, usize)>,
}

impl Place {
    /// The phases of all harmonics.
    pub(super) fn phases(&self, normal: &Normal) -> Vec<f64> {
        normal
            .orders
            .iter()
            .map(|order| if *order == 1.0 { self.phase } else { phase::wrap(order * self.phase) })
            .collect()
    }

    /// The flight from here in the regime of `structure`.
    pub(super) fn flight(&self, normal: &Normal, structure: Arc<Structure>) -> MachineFlight {
        // the time restarts with each flight, and the set points of joints that hold on a moving belt with it
        let stops = self.surfaces.len();
        let joints = 0..self.states.len() - stops;
        let set = joints.map(|joint| match self.states[stops + joint] {
            ContactState::Holding => dot(&normal.directions[stops + joint], &self.x),
            _ => 0.0,
        });
        let phases = self.phases(normal);
        let gap = |stop: usize| {
            let at_zero = self.known.iter().any(|(kind, _)| *kind == GuardKind::Depth(stop));
            let gap = if at_zero { 0.0 } else { self.gap(normal, stop).0 };
            let harmonics = normal.walls[stop].harmonics.iter().zip(&phases);
            harmonics.fold(gap, |gap, ((a, b), phase)| {
                let (sin, cos) = crate::math::sin_cos(*phase);
                gap - (a * cos + b * sin)
            })
        };
        MachineFlight::new(structure, &self.x, &self.v, set.collect(), &phases, gap, |kind| {
            let known = self.known.iter().find(|(of, _)| *of == kind).map_or(0, |(_, count)| *count);
            let surface = if let GuardKind::Gap(stop) = kind { self.surfaces[stop] } else { None };
            (known, surface)
        })
    }

    /// The wall of a stop and its velocity.
    fn wall(&self, normal: &Normal, stop: usize) -> (f64, f64) {
        let signal = &normal.walls[stop];
        let (mut place, mut rate) = (signal.constant, 0.0);
        for ((a, b), (phase, w)) in signal.harmonics.iter().zip(self.phases(normal).iter().zip(&normal.rates)) {
            let (sin, cos) = crate::math::sin_cos(*phase);
            place += a * cos + b * sin;
            rate += w * (b * cos - a * sin);
        }
        (place, rate)
    }

    /// The gap of a stop, its rate, and the sizes of the terms of both.
    pub(super) fn gap(&self, normal: &Normal, stop: usize) -> (f64, f64, f64, f64) {
        let w = &normal.directions[stop];
        let (wall, wall_rate) = self.wall(normal, stop);
        let size = |x: &[f64]| w.iter().zip(x).map(|(w, x)| (w * x).abs()).sum::<f64>();
        (
            wall - dot(w, &self.x),
            wall_rate - dot(w, &self.v),
            wall.abs() + size(&self.x),
            wall_rate.abs() + size(&self.v),
        )
    }

    /// The relative velocity of a joint, and the size of its terms.
    pub(super) fn sliding(&self, machine: &Machine, normal: &Normal, joint: usize) -> (f64, f64) {
        let w = &normal.directions[machine.stops().len() + joint];
        let belt = machine.joints()[joint].belt;
        (dot(w, &self.v) - belt, belt.abs() + w.iter().zip(&self.v).map(|(w, v)| (w * v).abs()).sum::<f64>())
    }
}
