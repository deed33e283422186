//! The free translations of a machine: directions along which all of it moves without a change of any force.
//!
//! A direction $`r`$ is one if no spring and no stop sees it, $`Kr = 0`$ and $`w_j\cdot r = 0`$. Dampers and friction joints
//! act on velocities only, which a translation does not change. A motion that is moved by $`c\,r`$ is a motion again, so a
//! cycle may return to its beginning moved along $`r`$, and cycles that differ by a translation are the same motion.

use crate::machine::MachineParts;
use crate::math::{Matrix, add_scaled, dot, sort_by};

/// A row that is a combination of others to within this part of its size depends on them.
const DEPENDENT: f64 = 1e-14;
/// A spring or a stop of this part of the size of its row does not see a direction, which is rounded.
const UNSEEN: f64 = 1e-13;

/// The free translations. Most machines have none, and then nothing here changes a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Translations {
    /// Orthonormal directions of them in mass-normalised coordinates.
    along: Vec<Vec<f64>>,
    /// Orthonormal directions of all other displacements there.
    across: Vec<Vec<f64>>,
    /// Orthonormal directions of the translations in the coordinates of the machine.
    in_machine: Vec<Vec<f64>>,
}

impl Translations {
    /// Those of a machine with this lower factor of its mass matrix.
    pub(crate) fn new(parts: &MachineParts, factor: &Matrix) -> Self {
        let n = parts.n();
        let mut across: Vec<Vec<f64>> = Vec::new();
        let mut rows: Vec<Vec<f64>> = Vec::new();
        let mut springs: Vec<usize> = (0..n).collect();
        // the smallest first, so that stiff springs hide no soft ones
        let size = |i: &usize| dot(parts.stiffness.row(*i), parts.stiffness.row(*i));
        sort_by(&mut springs, |a, b| size(a).total_cmp(&size(b)));
        let stops = parts.stops.iter().map(|stop| stop.direction.as_slice());
        for row in stops.chain(springs.iter().map(|i| parts.stiffness.row(*i))) {
            let row = factor.solve_lower(row);
            across.extend(perpendicular(&row, &across));
            if across.len() == n {
                return Self::default();
            }
            rows.push(row);
        }
        let mut along: Vec<Vec<f64>> = Vec::new();
        while along.len() + across.len() < n {
            let known: Vec<Vec<f64>> = across.iter().chain(&along).cloned().collect();
            // the unit vector that is farthest from all of them
            let share = |i: usize| known.iter().map(|other| other[i] * other[i]).sum::<f64>();
            let Some(i) = (0..n).min_by(|a, b| share(*a).total_cmp(&share(*b))) else { break };
            let unit: Vec<f64> = (0..n).map(|k| if k == i { 1.0 } else { 0.0 }).collect();
            let Some(next) = perpendicular(&unit, &known) else { break };
            along.push(next);
        }
        let sees = |row: &Vec<f64>, r: &Vec<f64>| dot(row, r).abs() > UNSEEN * dot(row, row).sqrt();
        if rows.iter().any(|row| along.iter().any(|r| sees(row, r))) {
            return Self::default();
        }
        let mut in_machine: Vec<Vec<f64>> = Vec::new();
        for x in &along {
            let q = factor.solve_lower_transposed(x);
            in_machine.extend(perpendicular(&q, &in_machine));
        }
        Self { along, across, in_machine }
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.along.is_empty()
    }

    /// The number of them.
    pub(crate) const fn count(&self) -> usize {
        self.along.len()
    }

    /// Whether one of them moves a coordinate of the machine.
    pub(crate) fn moves(&self, coordinate: usize) -> bool {
        self.in_machine.iter().any(|direction| direction[coordinate].abs() > UNSEEN)
    }

    /// The directions of a state that are no translations: of displacements, of velocities and of what follows them.
    pub(crate) fn others(&self, size: usize) -> Matrix {
        let n = self.along.len() + self.across.len();
        let mut matrix = Matrix::zeros(size, size - self.along.len());
        for (k, direction) in self.across.iter().enumerate() {
            for (i, value) in direction.iter().enumerate() {
                matrix[(i, k)] = *value;
            }
        }
        for i in n..size {
            matrix[(i, i - self.along.len())] = 1.0;
        }
        matrix
    }

    /// Removes the translation from mass-normalised coordinates, which are the first of `values`.
    pub(crate) fn remove(&self, values: &mut [f64]) {
        if self.is_empty() {
            return;
        }
        let n = self.along.len() + self.across.len();
        let x = &mut values[..n];
        // what is left is put together anew: to subtract a large part along them would leave its rounding errors
        let rest: Vec<f64> = self.across.iter().map(|direction| dot(direction, x)).collect();
        x.fill(0.0);
        for (direction, share) in self.across.iter().zip(rest) {
            add_scaled(x, share, direction);
        }
    }

    /// Removes the translation from each column of a matrix; coordinates are its rows from `first` on.
    pub(crate) fn remove_from_columns(&self, matrix: &mut Matrix, first: usize) {
        if self.is_empty() {
            return;
        }
        for j in 0..matrix.columns() {
            let mut column = matrix.column(j);
            self.remove(&mut column[first..]);
            for (i, value) in column.into_iter().enumerate() {
                matrix[(i, j)] = value;
            }
        }
    }

    /// The part of mass-normalised coordinates that is a translation.
    pub(crate) fn part(&self, x: &[f64]) -> Vec<f64> {
        let mut part = vec![0.0; x.len()];
        for direction in &self.along {
            add_scaled(&mut part, dot(direction, x), direction);
        }
        part
    }

    /// Removes the translation from a difference of two states in the coordinates of the machine.
    pub(crate) fn remove_in_machine(&self, q: &mut [f64]) {
        for direction in &self.in_machine {
            let share = dot(direction, q);
            add_scaled(q, -share, direction);
        }
    }
}

/// A vector made perpendicular to orthonormal ones and of length 1; `None` if it depends on them.
fn perpendicular(vector: &[f64], to: &[Vec<f64>]) -> Option<Vec<f64>> {
    let before = dot(vector, vector).sqrt();
    let mut rest = vector.to_vec();
    // twice, because once leaves rounding errors of the original length
    for _ in 0..2 {
        for other in to {
            let share = dot(other, &rest);
            add_scaled(&mut rest, -share, other);
        }
    }
    let length = dot(&rest, &rest).sqrt();
    (length > DEPENDENT * before).then(|| rest.iter().map(|x| x / length).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::machine::Machine;

    fn of(parts: MachineParts) -> Translations {
        let machine = Machine::new(parts).unwrap();
        Translations::new(machine.parts(), machine.factor())
    }

    fn chain(masses: &[f64], springs: &[f64]) -> MachineParts {
        let names: Vec<String> = (0..masses.len()).map(|i| format!("m{i}")).collect();
        let mut parts = MachineParts::new(names);
        for (i, mass) in masses.iter().enumerate() {
            parts = parts.with_mass(i, *mass);
        }
        for (i, spring) in springs.iter().enumerate() {
            let mut link = vec![0.0; masses.len()];
            (link[i], link[i + 1]) = (1.0, -1.0);
            parts = parts.with_link(&link, *spring, 0.1);
        }
        parts
    }

    /// A free chain moves as a whole, whatever its masses and springs; a spring or a stop to the ground holds it.
    #[test]
    fn chains() {
        for springs in [[0.3, 0.1, 0.7], [1e12, 1.0, 1e-6], [1e-9, 3e7, 0.2]] {
            let parts = chain(&[1.0, 1e-3, 7.0, 1e4], &springs);
            let free = of(parts.clone().with_rigid_stop("between", &[1.0, 0.0, -1.0, 0.0], 0.1, 0.5));
            assert_eq!(free.count(), 1, "{springs:?}");
            let direction = &free.in_machine[0];
            assert!(direction.iter().all(|q| (q.abs() - 0.5).abs() < 1e-12), "{direction:?}");
            assert!(of(parts.clone().with_rigid_stop("wall", &[0.0, 1.0, 0.0, 0.0], 0.1, 0.5)).is_empty());
            let soft = 1e-9 * springs.iter().sum::<f64>();
            assert!(of(parts.with_link(&[0.0, 0.0, 1.0, 0.0], soft, 0.0)).is_empty());
        }
    }

    /// Free bodies have as many translations as coordinates that no stop connects.
    #[test]
    fn free_bodies() {
        let parts = chain(&[1.0, 2.0, 3.0], &[]);
        assert_eq!(of(parts.clone()).count(), 3);
        let two = of(parts.with_rigid_stop("between", &[1.0, -1.0, 0.0], 0.1, 0.5));
        assert_eq!(two.count(), 2);
        let mut x = vec![0.3, -0.2, 5.0, 1.0, 2.0, 3.0];
        let part = two.part(&x[..3]);
        let whole = x.clone();
        two.remove(&mut x);
        assert!((0..3).all(|i| (x[i] + part[i] - whole[i]).abs() < 1e-15) && x[3..] == whole[3..]);
        assert_eq!((two.others(6).rows(), two.others(6).columns()), (6, 4));
    }
}
