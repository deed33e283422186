//! The families. To add one: a file with `fn draw(draw: &mut Draw) -> Drawn`, and a line in [`FAMILIES`].

mod beads;
mod beams;
mod chains;
mod columns;
mod cradles;
mod duplicates;
mod friction;
mod hammers;
mod idle;
mod light;
mod locked;
mod plates;
mod preloads;
mod rings;
mod rotated;
mod stacks;
mod strings;
mod twins;

// for all families
use crate::bodies::{along, between, bodies, chained, touching};
use crate::case::{Case, Drawn, Symmetry};
use crate::draw::Draw;
use core::f64::consts::PI;
use core::fmt;
use vibroimpact::events::Start;
use vibroimpact::machine::{HarmonicMotion, Machine, MachineParts, Opening, StopLaw};
use vibroimpact::math::sin_cos;

/// A family of machines.
#[derive(Clone, Copy)]
pub struct DrawnFamily {
    /// Its name.
    pub name: &'static str,
    /// What is degenerate in it.
    pub about: &'static str,
    draw: fn(&mut Draw) -> Drawn,
}

impl fmt::Debug for DrawnFamily {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

const fn family(name: &'static str, about: &'static str, draw: fn(&mut Draw) -> Drawn) -> DrawnFamily {
    DrawnFamily { name, about, draw }
}

/// All families.
pub const FAMILIES: &[DrawnFamily] = &[
    family("twins", "equal oscillators that touch, under equal forces", twins::draw),
    family("cradles", "balls on equal springs that touch; the first ones strike", cradles::draw),
    family("stacks", "bodies one on the other, on a table that is still or shakes", stacks::draw),
    family("columns", "bodies with equal gaps that fall on a floor", columns::draw),
    family("beads", "free bodies without any force, between walls", beads::draw),
    family("chains", "mirror-symmetric chains of bodies along a line, with walls and gaps", chains::draw),
    family("strings", "mirror-symmetric chains of bodies that move across the line", strings::draw),
    family("rings", "equal bodies in a ring, each above a stop or beside the next", rings::draw),
    family("plates", "plates and bars on 2 to 4 supports, dropped or driven", plates::draw),
    family("beams", "beams by their modes, with symmetric supports", beams::draw),
    family("duplicates", "the same stop or joint twice, rigid and compliant at one gap", duplicates::draw),
    family("idle", "bodies at rest on stops without a load, beside others that move", idle::draw),
    family("friction", "friction joints beside stops", friction::draw),
    family("hammers", "bodies between two stops at equal gaps", hammers::draw),
    family("preloads", "compliant stops with a preload, touching, under small loads", preloads::draw),
    family("rotated", "equal frequencies, in coordinates turned against the stops", rotated::draw),
    family("light", "a very light body between a heavy one and a stop", light::draw),
    family("locked", "bodies without any room between two walls, beside others that move", locked::draw),
];

impl DrawnFamily {
    /// The family of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        FAMILIES.iter().find(|family| family.name == name).copied()
    }

    /// The case of a seed.
    ///
    /// # Panics
    /// If the family draws an invalid machine, which is a fault of the family.
    #[must_use]
    pub fn case(&self, seed: u64) -> Case {
        let Drawn { parts, start, symmetries, equal, same_as } = (self.draw)(&mut Draw::new(self.name, seed));
        let machine = |parts: MachineParts| {
            Machine::new(parts).unwrap_or_else(|why| panic!("{} {seed} is no machine: {why}", self.name))
        };
        let (machine, same_as) = (machine(parts), same_as.map(machine));
        Case { family: self.name, seed, machine, start, symmetries, equal, same_as }
    }
}
