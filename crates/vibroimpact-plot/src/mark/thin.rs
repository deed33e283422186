//! Reduces polylines to the visible resolution.
//!
//! A waveform of 10^6 samples would give a file of many megabytes that looks like one of a few thousand points. Three
//! passes, each linear in time, preserve the appearance:
//!
//! 1. pieces that leave the frame are cut (Liang and Barsky 1984, doi:10.1145/357332.357333);
//! 2. consecutive points in one narrow column keep the first, lowest, highest and last (M4:
//!    Jugel et al., PVLDB 7 (2014) 797, doi:10.14778/2732951.2732953);
//! 3. points on a straight run are dropped while a cone of half-width [`TOLERANCE`] contains them
//!    (Williams 1978, doi:10.1016/0146-664X(78)90060-5).

use crate::canvas::Frame;
use crate::number::N;

/// Maximum deviation of a drawn line, in figure units: 6 micrometres in print.
const TOLERANCE: f64 = 0.05;

/// Width of a column of the second pass, in figure units: a tenth of a default line.
const COLUMN: f64 = 0.25;

/// Distance outside the frame at which lines are cut, so that no cut end or corner is visible.
const MARGIN: f64 = 60.0;

type Point = (f64, f64);

/// The path data of some page points.
pub(crate) fn path(points: impl Iterator<Item = Point>, frame: &Frame) -> String {
    let mut out = String::new();
    for piece in pieces(points, frame) {
        for (i, (x, y)) in straighten(&columns(&piece)).into_iter().enumerate() {
            out.push_str(&format!("{}{} {}", if i == 0 { 'M' } else { 'L' }, N(x), N(y)));
        }
    }
    out
}

/// Pass 1: the parts near the frame.
fn pieces(points: impl Iterator<Item = Point>, frame: &Frame) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut last: Option<Point> = None;
    for p in points {
        if p.0.is_nan() || p.1.is_nan() {
            last = None;
            continue;
        }
        if let Some((a, b)) = last.and_then(|from| cut(from, p, frame)) {
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&a) => piece.push(b),
                _ => pieces.push(vec![a, b]),
            }
        }
        last = Some(p);
    }
    pieces
}

fn cut(a: Point, b: Point, frame: &Frame) -> Option<(Point, Point)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for (step, room) in [
        (-dx, a.0 - (frame.left - MARGIN)),
        (dx, frame.right() + MARGIN - a.0),
        (-dy, a.1 - (frame.top - MARGIN)),
        (dy, frame.bottom() + MARGIN - a.1),
    ] {
        if step == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if step < 0.0 {
            enter = enter.max(room / step);
        } else {
            leave = leave.min(room / step);
        }
    }
    let on = |t: f64| (a.0 + t * dx, a.1 + t * dy);
    // ends that are not cut keep their exact bits, by which the next part is recognised
    let start = if enter > 0.0 { on(enter) } else { a };
    let end = if leave < 1.0 { on(leave) } else { b };
    (enter <= leave).then_some((start, end))
}

/// Pass 2: the first, extreme and last points of every run inside one column.
fn columns(points: &[Point]) -> Vec<Point> {
    let column = |p: &Point| (p.0 / COLUMN).floor();
    let mut out = Vec::new();
    for run in points.chunk_by(|a, b| column(a) == column(b)) {
        if run.len() <= 4 {
            out.extend_from_slice(run);
            continue;
        }
        let by = |i: &usize, j: &usize| run[*i].1.total_cmp(&run[*j].1);
        let lowest = (0..run.len()).min_by(by).unwrap_or(0);
        let highest = (0..run.len()).max_by(by).unwrap_or(0);
        let mut keep = [0, lowest.min(highest), lowest.max(highest), run.len() - 1].to_vec();
        keep.dedup();
        out.extend(keep.into_iter().map(|i| run[i]));
    }
    out
}

/// Pass 3: drops points as long as one straight line passes close to all dropped points.
fn straighten(points: &[Point]) -> Vec<Point> {
    let mut out: Vec<Point> = Vec::with_capacity(points.len().min(1024));
    let (mut cone, mut reach): (Option<(f64, f64)>, f64) = (None, 0.0);
    for (i, &p) in points.iter().enumerate() {
        let Some(&anchor) = out.last() else {
            out.push(p);
            continue;
        };
        let (dx, dy) = (p.0 - anchor.0, p.1 - anchor.1);
        let far = dx.hypot(dy);
        if far <= TOLERANCE && i + 1 < points.len() && cone.is_none() {
            continue;
        }
        let (angle, half) = (dy.atan2(dx), (TOLERANCE / far.max(TOLERANCE)).asin());
        let narrowed = match cone {
            None => Some((angle - half, angle + half)),
            Some((lo, hi)) => {
                // angles are periodic: use the value nearest to the cone
                let turn = ((f64::midpoint(lo, hi) - angle) / std::f64::consts::TAU).round();
                let angle = angle + turn * std::f64::consts::TAU;
                // a step back towards the anchor is a turning point, which must be kept
                (angle >= lo && angle <= hi && far >= reach).then_some((lo.max(angle - half), hi.min(angle + half)))
            }
        };
        if let Some(narrowed) = narrowed {
            (cone, reach) = (Some(narrowed), far);
        } else {
            let corner = points[i - 1];
            out.push(corner);
            let (dx, dy) = (p.0 - corner.0, p.1 - corner.1);
            let far = dx.hypot(dy);
            let half = (TOLERANCE / far.max(TOLERANCE)).asin();
            let angle = dy.atan2(dx);
            (cone, reach) = (Some((angle - half, angle + half)), far);
        }
    }
    if let (Some(&last), true) = (points.last(), points.len() > 1) {
        out.push(last);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::canvas::test_frame;

    fn drawn(xs: &[f64], ys: &[f64]) -> String {
        let frame = test_frame((0.0, 100.0), (100.0, 0.0));
        path(xs.iter().zip(ys).map(|(&x, &y)| frame.at(x, y)), &frame)
    }

    #[test]
    fn nan_breaks_and_corners_stay() {
        let nan = f64::NAN;
        assert_eq!(drawn(&[0.0, 10.0, 10.0], &[0.0, 0.0, 20.0]), "M0 0L10 0L10 20");
        assert_eq!(drawn(&[0.0, 10.0, nan, 20.0, 30.0], &[0.0; 5]), "M0 0L10 0M20 0L30 0");
        assert_eq!(drawn(&[0.0, 50.0, 20.0], &[0.0; 3]), "M0 0L50 0L20 0");
        assert_eq!(drawn(&[], &[]), "");
        assert_eq!(drawn(&[1.0], &[1.0]), "");
    }

    #[test]
    fn far_away_pieces_are_cut() {
        assert_eq!(drawn(&[-1e300, 1e300], &[50.0, 50.0]), "M-60 50L160 50");
        assert_eq!(drawn(&[500.0, 600.0], &[50.0, 50.0]), "");
    }

    #[test]
    fn a_thinned_line_stays_within_the_tolerance() {
        let n = 200_000;
        let xs: Vec<f64> = (0..=n).map(|i| 100.0 * f64::from(i) / f64::from(n)).collect();
        let ys: Vec<f64> = xs.iter().map(|x| 50.0 + 40.0 * (x / 3.0).sin()).collect();
        let frame = test_frame((0.0, 100.0), (100.0, 0.0));
        let points: Vec<Point> = xs.iter().zip(&ys).map(|(&x, &y)| frame.at(x, y)).collect();
        let thin = straighten(&columns(&points));
        assert!(thin.len() < 1500, "{} points left", thin.len());
        let mut k = 0;
        for p in points {
            while thin[k + 1].0 < p.0 {
                k += 1;
            }
            let (a, b) = (thin[k], thin[k + 1]);
            let (dx, dy) = (b.0 - a.0, b.1 - a.1);
            let away = ((p.0 - a.0) * dy - (p.1 - a.1) * dx).abs() / dx.hypot(dy).max(1e-12);
            assert!(away <= 2.0 * TOLERANCE, "{p:?} lies {away} off");
        }
    }

    #[test]
    fn noise_keeps_its_envelope() {
        let ys: Vec<f64> = (0..100_000u32).map(|i| f64::from(i.wrapping_mul(2_654_435_761) % 1000) / 10.0).collect();
        let xs: Vec<f64> = (0..100_000u32).map(|i| f64::from(i) / 1000.0).collect();
        let text = drawn(&xs, &ys);
        assert!(text.len() < 40_000, "{} bytes", text.len());
        assert!(text.contains(" 99.9") && text.contains(" 0L"));
    }
}
