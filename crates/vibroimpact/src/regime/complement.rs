//! Directions in which a structure is free.

use crate::math::{Matrix, add_scaled, dot};

/// A direction of whose length less than this part is left beside other directions depends on them.
const DEPENDENT: f64 = 1e-9;

/// Takes from `vector` what lies along the orthonormal directions `basis`, twice, so that the result is orthogonal to
/// rounding. Returns the length of what is left.
fn project(basis: &[Vec<f64>], vector: &mut [f64]) -> f64 {
    for _ in 0..2 {
        for known in basis {
            let part = dot(known, vector);
            add_scaled(vector, -part, known);
        }
    }
    dot(vector, vector).sqrt()
}

fn scaled(vector: &[f64], size: f64) -> Vec<f64> {
    vector.iter().map(|x| x / size).collect()
}

/// Orthonormal directions, to which more are added.
#[derive(Clone, Debug, Default)]
pub(crate) struct Orthonormal(Vec<Vec<f64>>);

impl Orthonormal {
    /// Those that span these directions.
    pub(crate) fn spanning<'a>(directions: impl Iterator<Item = &'a Vec<f64>>) -> Self {
        let mut basis = Self::default();
        for direction in directions {
            if let Some(left) = basis.beside(direction) {
                let size = dot(&left, &left).sqrt();
                basis.0.push(scaled(&left, size));
            }
        }
        basis
    }

    /// Takes away from a vector what it has along these.
    pub(crate) fn remove(&self, vector: &mut [f64]) {
        project(&self.0, vector);
    }

    /// What is left of a direction beside these; `None` if it depends on these.
    pub(crate) fn beside(&self, direction: &[f64]) -> Option<Vec<f64>> {
        let mut left = direction.to_vec();
        let size = project(&self.0, &mut left);
        (size >= DEPENDENT * dot(direction, direction).sqrt()).then_some(left)
    }
}

/// The places of those directions that do not depend on the ones before them.
pub(crate) fn independent<'a>(directions: impl Iterator<Item = &'a [f64]>) -> Vec<usize> {
    let (mut basis, mut places): (Vec<Vec<f64>>, Vec<usize>) = Default::default();
    for (place, direction) in directions.enumerate() {
        // of length 1, so that what is left of it is a part of it
        let mut vector = scaled(direction, dot(direction, direction).sqrt());
        let rest = project(&basis, &mut vector);
        if rest >= DEPENDENT {
            basis.push(scaled(&vector, rest));
            places.push(place);
        }
    }
    places
}

/// An orthonormal basis of what is orthogonal to all directions `held`, as columns, the first of them along the
/// directions `along`; and the components of these directions in it, with exact zeros. `None` if the directions `held`
/// depend on each other.
pub(super) fn complement(held: &[Vec<f64>], along: &[&[f64]], n: usize) -> Option<(Matrix, Vec<Vec<f64>>)> {
    let mut basis: Vec<Vec<f64>> = Vec::with_capacity(n);
    for direction in held {
        let mut vector = scaled(direction, dot(direction, direction).sqrt());
        let rest = project(&basis, &mut vector);
        if rest < DEPENDENT {
            return None;
        }
        basis.push(scaled(&vector, rest));
    }
    let first = basis.len();
    let mut reached = Vec::with_capacity(along.len());
    for direction in along {
        let size = dot(direction, direction).sqrt();
        let mut vector = scaled(direction, size);
        let rest = project(&basis, &mut vector);
        // all that reaches beyond rounding: the components must be exact there
        if rest > 1e-12 && basis.len() < n {
            basis.push(scaled(&vector, rest));
        }
        reached.push(basis.len());
    }
    let mut left: Vec<usize> = (0..n).collect();
    while basis.len() < n {
        // the unit vector that is farthest from what is spanned already
        let mut best = (0.0, 0, Vec::new());
        for (place, i) in left.iter().enumerate() {
            let mut vector = vec![0.0; n];
            vector[*i] = 1.0;
            let rest = project(&basis, &mut vector);
            // of equal ones the first, whatever their rounding errors
            if rest > best.0 * (1.0 + 1e-9) {
                best = (rest, place, vector);
            }
        }
        left.remove(best.1);
        basis.push(scaled(&best.2, best.0));
    }
    let mut columns = Matrix::zeros(n, n - first);
    for (j, vector) in basis[first..].iter().enumerate() {
        for (i, x) in vector.iter().enumerate() {
            columns[(i, j)] = *x;
        }
    }
    let share = |direction: &[f64], end: usize| {
        let mut share = vec![0.0; n - first];
        for (value, vector) in share.iter_mut().zip(&basis[first..end]) {
            *value = dot(direction, vector);
        }
        share
    };
    let shares = along.iter().zip(reached).map(|(direction, end)| share(direction, end)).collect();
    Some((columns, shares))
}
