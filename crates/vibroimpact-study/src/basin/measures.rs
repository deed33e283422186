//! Measures of the basins in a plane of starts: shares with their errors, basin entropy, boundary entropy, uncertainty
//! exponent, and the merging method for at least three basins.
//!
//! The plane is divided into boxes of $`b \times b`$ cells. With $`p_{ij}`$ the share of motion $`j`$ in box $`i`$, the
//! entropy of the box is $`S_i = -\sum_j p_{ij}\ln p_{ij}`$. The basin entropy is the mean of $`S_i`$ over all boxes,
//! the boundary entropy the mean over the boxes with more than one motion (A. Daza et al., "Basin entropy: a new tool to
//! analyze uncertainty in dynamical systems", Sci. Rep. 6, 31416 (2016), <https://doi.org/10.1038/srep31416>). A boundary
//! entropy above $`\ln 2`$ is possible only for a fractal boundary.
//!
//! The share of boxes with more than one motion falls as $`(b-1)^\alpha`$, because the outermost starts of a box are
//! $`b-1`$ spacings apart; $`\alpha`$ is the uncertainty exponent (C. Grebogi et al., Phys. Lett. A 99, 415 (1983)): 1 for
//! a smooth boundary in the plane, less for a fractal one. (With $`b`$ in place of $`b-1`$, the exponent of a straight line
//! would come out as 1.18 from boxes of 2 to 64 starts.)

use super::merging::{Merging, merging};

/// Measures of the basins in a plane.
#[derive(Clone, Debug, PartialEq)]
pub struct BasinMeasures {
    /// Side of the boxes of both entropies, in cells.
    pub side: usize,
    /// The basin entropy.
    pub entropy: f64,
    /// The boundary entropy; `None` if all boxes have one motion each.
    pub boundary_entropy: Option<f64>,
    /// The uncertainty exponent; `None` with fewer than three sizes of boxes of which some have more than one motion.
    pub uncertainty: Option<UncertaintyExponent>,
    /// Whether all basins have one boundary; `None` with fewer than three basins.
    pub merging: Option<Merging>,
}

/// The slope of the logarithm of the share of uncertain boxes over that of their width, by least squares.
#[derive(Clone, Debug, PartialEq)]
pub struct UncertaintyExponent {
    /// The exponent.
    pub value: f64,
    /// Its standard error, from the scatter about the line.
    pub error: f64,
    /// The sides of the boxes in cells, with the share of the boxes that have more than one motion.
    pub shares: Vec<(usize, f64)>,
}

/// Side of the boxes of the entropies, as in the paper of Daza et al.
const SIDE: usize = 5;
/// There are at least this many boxes along the shorter side of the plane for the uncertainty exponent.
const FEWEST: usize = 8;

/// The measures of a plane whose cells are numbers of motions, with `width` cells in each row.
///
/// ```
/// use vibroimpact_study::basin::measures;
/// // two halves with a straight boundary between the cells of one box: in every second row of boxes half and half
/// let cells: Vec<u32> = (0..100).map(|k| u32::from(k % 10 >= 7)).collect();
/// let found = measures(&cells, 10);
/// let half = -(0.4_f64 * 0.4_f64.ln() + 0.6 * 0.6_f64.ln());
/// assert!((found.boundary_entropy.unwrap() - half).abs() < 1e-15);
/// assert!((found.entropy - 0.5 * half).abs() < 1e-15);
/// ```
#[must_use]
pub fn measures<T: Copy + PartialEq>(cells: &[T], width: usize) -> BasinMeasures {
    let side = SIDE.min(width.max(1)).min((cells.len() / width.max(1)).max(1));
    let (mut sum, mut boxes, mut mixed) = (0.0, 0.0, 0.0);
    each_box(cells, width, side, |counts| {
        let total: f64 = counts.iter().map(|(_, count)| f64::from(*count)).sum();
        let terms = counts.iter().map(|(_, count)| f64::from(*count) / total).map(|p| -p * p.ln());
        sum += terms.sum::<f64>();
        boxes += 1.0;
        mixed += f64::from(u8::from(counts.len() > 1));
    });
    BasinMeasures {
        side,
        entropy: sum / f64::max(boxes, 1.0),
        boundary_entropy: (mixed > 0.0).then(|| sum / mixed),
        uncertainty: exponent(cells, width),
        merging: merging(cells, width),
    }
}

/// Calls `each` with the motions and their counts of every whole box of the plane. Cells beyond the last whole box are
/// left out.
fn each_box<T: Copy + PartialEq>(cells: &[T], width: usize, side: usize, mut each: impl FnMut(&[(T, u32)])) {
    let height = cells.len() / width.max(1);
    let mut counts: Vec<(T, u32)> = Vec::new();
    for top in (0..height / side).map(|k| k * side) {
        for left in (0..width / side).map(|k| k * side) {
            counts.clear();
            for row in top..top + side {
                for cell in &cells[row * width + left..row * width + left + side] {
                    match counts.iter_mut().find(|(motion, _)| motion == cell) {
                        Some((_, count)) => *count += 1,
                        None => counts.push((*cell, 1)),
                    }
                }
            }
            each(&counts);
        }
    }
}

/// The uncertainty exponent from boxes of 2, 4, 8 ... cells.
fn exponent<T: Copy + PartialEq>(cells: &[T], width: usize) -> Option<UncertaintyExponent> {
    let shorter = width.min(cells.len() / width.max(1));
    let mut shares = Vec::new();
    let mut side = 2;
    while side * FEWEST <= shorter {
        let (mut boxes, mut mixed) = (0.0, 0.0);
        each_box(cells, width, side, |counts| {
            boxes += 1.0;
            mixed += f64::from(u8::from(counts.len() > 1));
        });
        if mixed > 0.0 {
            shares.push((side, mixed / boxes));
        }
        side *= 2;
    }
    if shares.len() < 3 {
        return None;
    }
    #[allow(clippy::cast_precision_loss)] // sides of a few thousand cells
    let points: Vec<(f64, f64)> = shares.iter().map(|(side, share)| ((*side as f64 - 1.0).ln(), share.ln())).collect();
    let (value, error) = slope(&points);
    Some(UncertaintyExponent { value, error, shares })
}

/// The slope of the line through at least three points by least squares, and its standard error.
fn slope(points: &[(f64, f64)]) -> (f64, f64) {
    #[allow(clippy::cast_precision_loss)] // a handful
    let n = points.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let spread: f64 = points.iter().map(|p| (p.0 - x).powi(2)).sum();
    let value = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
    let rest: f64 = points.iter().map(|p| (p.1 - y - value * (p.0 - x)).powi(2)).sum();
    (value, (rest / (n - 2.0) / spread).sqrt())
}

/// The normal deviate of a confidence of 95 %.
const DEVIATE: f64 = 1.959_963_984_540_054;

/// The interval of a share at a confidence of 95 %, for `count` of `total` random starts (Wilson's score interval, J. Am.
/// Stat. Assoc. 22, 209 (1927)). Starts on a grid or of low discrepancy are more even than random ones.
#[must_use]
#[allow(clippy::cast_precision_loss)] // counts below 2^53
pub fn share_interval(count: u64, total: u64) -> (f64, f64) {
    let n = total.max(1) as f64;
    let (p, z) = (count as f64 / n, DEVIATE * DEVIATE / n);
    let middle = (p + 0.5 * z) / (1.0 + z);
    let half = (z * (p * (1.0 - p) + 0.25 * z)).sqrt() / (1.0 + z);
    // exact at both ends, where rounding would leave a little
    let low = if count == 0 { 0.0 } else { middle - half };
    let high = if count == total { 1.0 } else { middle + half };
    (low, high)
}

/// The largest share of a motion that none of `total` random starts leads to, at a confidence of 95 %:
/// $`1 - 0.05^{1/N}`$.
#[must_use]
#[allow(clippy::cast_precision_loss)] // counts below 2^53
pub fn missed_share(total: u64) -> f64 {
    -(0.05_f64.ln() / total.max(1) as f64).exp_m1()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: four boxes of 5 x 5 cells, one of them with 10 cells of one motion and 15 of another, one with three
    /// motions of 5, 10 and 10 cells.
    #[test]
    fn entropies_by_hand() {
        let mut cells = vec![0_u8; 100];
        for k in 0..25 {
            let (row, column) = (k / 5, k % 5);
            cells[row * 10 + column] = u8::from(row >= 2);
            cells[(row + 5) * 10 + column + 5] = [0, 1, 1, 2, 2][row];
        }
        let found = measures(&cells, 10);
        let entropy = |shares: &[f64]| -> f64 { shares.iter().map(|p| -p * p.ln()).sum() };
        let (a, b) = (entropy(&[0.4, 0.6]), entropy(&[0.2, 0.4, 0.4]));
        assert!((found.entropy - (a + b) / 4.0).abs() < 1e-15);
        assert!((found.boundary_entropy.unwrap() - (a + b) / 2.0).abs() < 1e-15);
        assert_eq!((found.side, found.uncertainty), (5, None));
        let one = measures(&[7; 100], 10);
        assert_eq!((one.entropy, one.boundary_entropy), (0.0, None));
        // a box of equal shares of k motions has the entropy ln k
        let many: Vec<usize> = (0..625).map(|k| k % 25).collect();
        assert!((measures(&many, 25).entropy - 5.0_f64.ln()).abs() < 1e-14);
    }

    /// A straight boundary, of any slope, has the exponent 1; random cells have 0.
    #[test]
    fn exponents_of_known_planes() {
        let side = 512_usize;
        let line: Vec<bool> = (0..side * side).map(|k| 3 * (k % side) > 5 * (k / side) + 40).collect();
        let found = measures(&line, side).uncertainty.unwrap();
        assert!((found.value - 1.0).abs() < 0.05, "{found:?}");
        assert!(found.error < 0.05 && found.shares.len() == 6, "{found:?}");
        // over the number of starts instead of the distance of the outermost ones, as other programs have it
        let points: Vec<(f64, f64)> =
            found.shares.iter().map(|(side, share)| ((*side as f64).ln(), share.ln())).collect();
        let (slope, _) = slope(&points);
        assert!((slope - 1.18).abs() < 0.005, "{slope}");
        let mut state = 1_u64;
        let noise: Vec<bool> = (0..side * side)
            .map(|_| {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                state >> 63 == 1
            })
            .collect();
        let found = measures(&noise, side);
        assert!(found.uncertainty.unwrap().value < 0.05);
        assert!((found.entropy - 2.0_f64.ln()).abs() < 0.03);
    }

    /// Wilson's interval against its defining equation |p - q| = z sqrt(q (1 - q) / n), and known values.
    #[test]
    fn intervals_of_shares() {
        for (count, total) in [(3_u32, 10_u32), (64, 200), (1, 1000), (999, 1000)] {
            let p = f64::from(count) / f64::from(total);
            let (low, high) = share_interval(count.into(), total.into());
            for q in [low, high] {
                let right = DEVIATE * (q * (1.0 - q) / f64::from(total)).sqrt();
                assert!(((p - q).abs() - right).abs() < 1e-14, "{count} of {total}");
            }
        }
        assert_eq!((share_interval(0, 50).0, share_interval(50, 50).1), (0.0, 1.0));
        assert!((missed_share(100) - (1.0 - 0.05_f64.powf(0.01))).abs() < 1e-15);
    }
}
