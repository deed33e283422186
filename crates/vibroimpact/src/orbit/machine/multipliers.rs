//! The multipliers of a cycle, also of those directions that decay by more than the rounding errors of the others.
//!
//! The derivative of a cycle over its period is the product of those of its flights and events. Its eigenvalues are found from
//! this product where it holds them all. Whether it does is known from an orthonormal frame that is carried around the cycle
//! once: its stretches multiply to the determinant (Liouville's formula), with all digits, whatever decays. Where the eigenvalues of
//! the product do not, the frame is carried around again and again, as in the periodic QR method (A. Bojanczyk, G. H. Golub and
//! P. Van Dooren, "The periodic Schur decomposition: algorithms and applications", Proc. SPIE 1770 (1992) 31-42,
//! doi:10.1117/12.130915). It converges to invariant subspaces in the order of their stretches, and multipliers of about one
//! size are the eigenvalues of a product of small blocks.

use super::frame::MachineFrame;
use super::lap::MachineLap;
use crate::events::{FrameChange, Metric, Place, TangentStep, tangent_steps};
use crate::math::{Matrix, Multiplier, add_scaled, dot, exp, general_eigenvalues, ln, sort_by};

/// A multiplier and the logarithm of its modulus, which says how small it is where it underflows; minus infinity if it is 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stretching {
    pub(crate) multiplier: Multiplier,
    pub(crate) log: f64,
}

/// The eigenvalues of the whole product are right if the logarithm of their product differs by less from that of the determinant.
const AGREED: f64 = 1e-9;
/// A subspace that differs by less after a round is invariant.
const INVARIANT: f64 = 1e-12;
/// Two stretches are told apart if one is larger by this logarithm; others are of about one size.
const APART: f64 = 0.7;
/// The rounds after which it is known which stretches are apart, and the largest number of rounds.
const SETTLED: u32 = 12;
const ROUNDS: u32 = 64;

/// The multipliers of the cycle that begins at `begin` and whose motion over a period is `lap`, the largest first. `None` where
/// its derivative is infinite.
pub(super) fn multipliers(frame: &MachineFrame<'_>, begin: &Place, lap: &MachineLap) -> Option<Vec<Stretching>> {
    let whole = frame.across_cycles(lap.derivative.clone()?, begin);
    let count = frame.multipliers();
    let mut product: Vec<Stretching> = general_eigenvalues(&whole)?
        .into_iter()
        .map(|multiplier| Stretching { multiplier, log: ln(multiplier.modulus()) })
        .collect();
    product.truncate(count);
    let Some(mut found) = by_frames(frame, (begin, lap), &product) else { return Some(product) };
    // what has vanished along the lap has the multiplier 0
    found.resize(count, Stretching { multiplier: Multiplier::default(), log: f64::NEG_INFINITY });
    Some(found)
}

/// The parts of a lap, to first order.
fn parts(frame: &MachineFrame<'_>, lap: &MachineLap) -> Option<Vec<TangentStep>> {
    let mut parts = Vec::new();
    let last = lap.steps.len().checked_sub(1)?;
    for (k, (begin, from, passage)) in lap.steps.iter().enumerate() {
        let left = lap.time - begin;
        // the lap ends within the last step
        if k == last && left <= passage.duration {
            parts.push(TangentStep::Flight(passage.structure.clone(), Box::new(from.clone()), left));
            break;
        }
        let own = frame
            .with(|structures| tangent_steps(&frame.shape, frame.machine, &frame.normal, structures, (from, passage)));
        parts.extend(own?);
    }
    Some(parts)
}

/// The multipliers that are not 0, from frames that are carried around the cycle. `None` if those of the product of all
/// derivatives are right, or nothing better is found.
fn by_frames(
    frame: &MachineFrame<'_>,
    (begin, lap): (&Place, &MachineLap),
    product: &[Stretching],
) -> Option<Vec<Stretching>> {
    let parts = parts(frame, lap)?;
    let translations = &frame.normal.translations;
    let remove = |vector: &mut Vec<f64>| translations.remove(vector);
    // without forcing the first vector is along the motion, and what it is stretched by says nothing of the cycle
    let along = frame.unforced().then(|| frame.flow(begin)).flatten();
    let first = usize::from(along.is_some());
    let mut vectors = states(frame, begin)?;
    if let Some(along) = &along {
        vectors.insert(0, along.clone());
    }
    let mut basis = independent(&vectors);
    let metric = Metric::default();
    for round in 0..ROUNDS {
        let before = basis.clone();
        let mut changes: Vec<FrameChange> = Vec::new();
        let mut whole = true;
        for part in &parts {
            for change in part.carry(&frame.shape, &frame.normal, &mut basis, (&metric, &remove)) {
                // where a vector vanishes before others, those after it take other places: no frame to compare with
                whole &= change.kept.len() == change.kept.iter().max().map_or(0, |last| last + 1);
                changes.push(change);
            }
        }
        whole &= basis.len() == before.len();
        // nothing is left but the direction of the motion: all multipliers are 0
        if basis.len() <= first {
            return Some(Vec::new());
        }
        // rounding errors turn it away from the motion, so it is set again in each round
        if let Some(along) = &along {
            basis[0].clone_from(along);
            basis = independent(&basis);
        }
        if !whole {
            continue;
        }
        let d = basis.len();
        // how the frame has turned in the round; where it is invariant, by a triangular matrix with 1 and -1 on the
        // diagonal
        let mut turn = Matrix::zeros(d, d);
        for (i, old) in before.iter().enumerate() {
            for (j, new) in basis.iter().enumerate() {
                turn[(i, j)] = dot(old, new);
            }
        }
        let logs: Vec<f64> = (0..d).map(|k| changes.iter().map(|change| change.log(k)).sum()).collect();
        let determinant: f64 = logs[first..].iter().sum();
        let own: f64 = product.iter().map(|of| of.log).sum();
        // nothing has been lost in the product: its eigenvalues are the better ones
        if d - first == product.len() && (own - determinant).abs() <= AGREED {
            return None;
        }
        // where the subspaces of the first vectors are invariant
        let splits: Vec<usize> =
            (1..d).filter(|k| (*k..d).all(|i| (0..*k).all(|j| turn[(i, j)].abs() <= INVARIANT))).collect();
        // more rounds for subspaces that have not converged, unless their stretches are of about one size
        let open = (1..d).any(|k| !splits.contains(&k) && (round < SETTLED || logs[k - 1] - logs[k] > APART));
        if open && round + 1 < ROUNDS {
            continue;
        }
        let mut found = Vec::new();
        let mut begin = first;
        for end in splits.into_iter().chain([d]).filter(|end| *end > first) {
            found.extend(block(&turn, &changes, &logs, (begin, end))?);
            begin = end;
        }
        sort_by(&mut found, |a: &Stretching, b| b.log.total_cmp(&a.log));
        return Some(found);
    }
    None
}

/// The multipliers of the diagonal block of the vectors from `begin` to `end`.
fn block(
    turn: &Matrix,
    changes: &[FrameChange],
    logs: &[f64],
    (begin, end): (usize, usize),
) -> Option<Vec<Stretching>> {
    let size = end - begin;
    if size == 1 {
        // a single direction: its stretch, with the sign of all factors
        let negative = changes
            .iter()
            .filter(|change| (change.left[(begin, begin)] < 0.0) != (change.right[(begin, begin)] < 0.0))
            .count();
        let sign = if negative.is_multiple_of(2) { turn[(begin, begin)] } else { -turn[(begin, begin)] };
        let multiplier = Multiplier { re: exp(logs[begin]).copysign(sign), im: 0.0 };
        return Some(vec![Stretching { multiplier, log: logs[begin] }]);
    }
    let cut = |matrix: &Matrix| {
        let mut cut = Matrix::zeros(size, size);
        for i in 0..size {
            cut.row_mut(i).copy_from_slice(&matrix.row(begin + i)[begin..end]);
        }
        cut
    };
    // the product, apart from the exponential of its size
    let (mut product, mut scale) = (Matrix::identity(size), 0.0);
    for change in changes {
        let own = &change.scales[begin..end];
        // relative to the largest stretch, so that nothing overflows
        let largest = own.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        product = cut(&change.right).times(&product);
        for (i, own) in own.iter().enumerate() {
            let factor = exp(own - largest);
            product.row_mut(i).iter_mut().for_each(|x| *x *= factor);
        }
        product = cut(&change.left).times(&product);
        let size = product.largest();
        if size == 0.0 || !size.is_finite() {
            return None;
        }
        // and again after each product
        product = product.times(&Matrix::diagonal(&vec![1.0 / size; product.rows()]));
        scale += largest + ln(size);
    }
    let values = general_eigenvalues(&cut(turn).times(&product))?;
    let factor = exp(scale);
    let found = values.into_iter().map(|value| Stretching {
        multiplier: Multiplier { re: value.re * factor, im: value.im * factor },
        log: ln(value.modulus()) + scale,
    });
    Some(found.collect())
}

/// The differences of states that the regime at a state allows, but for translations.
fn states(frame: &MachineFrame<'_>, at: &Place) -> Option<Vec<Vec<f64>>> {
    let structure = frame.structure(&at.states)?;
    let whole = frame.shape.transition(&structure, &frame.normal, at, 0.0);
    let mut columns: Vec<Vec<f64>> = (0..whole.columns()).map(|j| whole.column(j)).collect();
    columns.iter_mut().for_each(|column| frame.normal.translations.remove(column));
    Some(columns)
}

/// An orthonormal basis of what these vectors span, beginning with the first of them.
fn independent(vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for vector in vectors {
        // twice, so that what is left is perpendicular to rounding
        let before = dot(vector, vector).sqrt();
        let mut rest = vector.clone();
        for _ in 0..2 {
            for other in &basis {
                let share = dot(other, &rest);
                add_scaled(&mut rest, -share, other);
            }
        }
        let length = dot(&rest, &rest).sqrt();
        if length > DEPENDENT * before && length > 0.0 {
            basis.push(rest.iter().map(|x| x / length).collect());
        }
    }
    basis
}

/// A vector that differs by less from a combination of others depends on them.
const DEPENDENT: f64 = 1e-9;
