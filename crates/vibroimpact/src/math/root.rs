//! A zero of a function within a bracket, and the border of a property.

/// The largest number of evaluations.
const MAX_EVALUATIONS: u32 = 90;
/// The largest number of bisections; fewer reach neighbouring numbers.
const MAX_HALVINGS: u32 = 100;

/// The place at which `f` changes sign between `low` and `high`, to within `resolution`; the values at both ends are
/// given. The method is regula falsi in which the value of an end that stays is halved (Illinois). The bracket is
/// bisected where this is slow or values are infinite. `None` when `f` has no value at a point that is tried.
pub(crate) fn between(
    mut f: impl FnMut(f64) -> Option<f64>,
    (mut low, mut at_low): (f64, f64),
    (mut high, mut at_high): (f64, f64),
    resolution: f64,
) -> Option<f64> {
    let mut last = 0;
    let mut width = high - low;
    for count in 0..MAX_EVALUATIONS {
        if at_high == 0.0 {
            return Some(high);
        }
        if high - low <= resolution {
            break;
        }
        let mut s = low - at_low * (high - low) / (at_high - at_low);
        // if three steps have not reduced the bracket to a quarter, the next step bisects it
        let slow = count % 3 == 2 && {
            let slow = high - low > 0.25 * width;
            width = high - low;
            slow
        };
        if slow || !(s > low && s < high) {
            s = 0.5 * (low + high);
        }
        if s <= low || s >= high {
            break;
        }
        let value = f(s)?;
        if value == 0.0 {
            return Some(s);
        }
        if (value > 0.0) == (at_high > 0.0) {
            (high, at_high) = (s, value);
            // the rule of Illinois: where one end stays, half its value brings the next point to its side of the zero
            if last == 1 {
                at_low *= 0.5;
            }
            last = 1;
        } else {
            (low, at_low) = (s, value);
            if last == -1 {
                at_high *= 0.5;
            }
            last = -1;
        }
    }
    Some(if at_low.abs() < at_high.abs() { low } else { high })
}

/// The neighbouring numbers between which a property ends, which the number `inside` has and `outside` has not: the one with it
/// and the one without it.
pub(crate) fn border(mut inside: f64, mut outside: f64, has: impl Fn(f64) -> bool) -> (f64, f64) {
    for _ in 0..MAX_HALVINGS {
        let middle = 0.5 * (inside + outside);
        if middle == inside || middle == outside {
            break;
        }
        if has(middle) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    (inside, outside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn simple_threefold_and_jumping() {
        let find = |f: fn(f64) -> f64| between(|s| Some(f(s)), (0.0, f(0.0)), (2.0, f(2.0)), 1e-15).unwrap();
        assert!((find(|s| s * s - 2.0) - 2.0_f64.sqrt()).abs() < 3e-15);
        assert!((find(|s| (1.25 - s) * (1.25 - s) * (1.25 - s)) - 1.25).abs() < 1e-5);
        assert!((find(|s| if s < 0.7 { -0.01 } else { f64::INFINITY }) - 0.7).abs() < 3e-15);
    }

    #[test]
    fn a_border_lies_between_neighbouring_numbers() {
        let (inside, outside) = border(0.0, 3.0, |s| s * s < 2.0);
        assert!(inside * inside < 2.0 && outside * outside >= 2.0 && outside == inside.next_up());
    }
}
