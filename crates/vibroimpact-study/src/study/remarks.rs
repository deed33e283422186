//! What a store of a machine keeps of a motion beside its label: the stops that stay closed for ever, and the number of events
//! over which chaos was seen.

use crate::field::{Extra, Field, NumberType};

/// Where there is nothing to say of a motion.
pub(super) const NONE: i32 = -1;
/// Stops of one number: its bits without the sign.
const BITS: usize = 31;

/// The fields of the remarks on motions of a machine with so many stops: one for each [`BITS`] stops, and the number of events.
pub(super) fn fields(stops: usize, extra: &[Extra]) -> Vec<Field> {
    let flags = [(i32::MIN, "not_computed"), (NONE, "not_chaotic")];
    let long_name = "number of events over which chaos was seen";
    let seen = Field::integers("seen_events", long_name, NumberType::I32, extra, &flags);
    let closed = |k: usize| Field {
        name: if k == 0 { "closed".into() } else { format!("closed_{}", k + 1).into() },
        long_name: "stops that stay closed for ever".into(),
        flags: vec![(i32::MIN, "not_computed"), (NONE, "none")],
        comment: "sum of 2^k over the stops, k counted from 0 in the order of the machine, and from 0 again for each 31 stops",
        ..seen.clone()
    };
    (0..stops.div_ceil(BITS)).map(closed).chain([seen.clone()]).collect()
}

/// The remarks on a motion, one for each of the [`fields`].
pub(super) fn of(stops: usize, closed: &[usize], seen: Option<u64>) -> Vec<i32> {
    let mut remarks = vec![NONE; stops.div_ceil(BITS) + 1];
    for stop in closed {
        let sum = &mut remarks[stop / BITS];
        *sum = (*sum).max(0) | 1 << (stop % BITS);
    }
    if let (Some(seen), Some(last)) = (seen, remarks.last_mut()) {
        *last = i32::try_from(seen).unwrap_or(i32::MAX);
    }
    remarks
}

/// Whether a field with this name has stops that stay closed.
#[must_use]
pub fn has_closed(name: &str) -> bool {
    name == "closed" || name.starts_with("closed_")
}

/// The stops that stay closed, by their numbers from 0, of the fields that [have them](has_closed), in order.
///
/// ```
/// use vibroimpact_study::study::closed_of;
/// assert_eq!(closed_of([5, -1, 1]), [0, 2, 62]);
/// ```
#[must_use]
pub fn closed_of(sums: impl IntoIterator<Item = i32>) -> Vec<usize> {
    let of = |(k, sum): (usize, i32)| {
        (0..BITS).filter(move |bit| sum > 0 && sum >> bit & 1 == 1).map(move |bit| BITS * k + bit)
    };
    sums.into_iter().enumerate().flat_map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stops_come_back() {
        for closed in [vec![], vec![0], vec![30], vec![31], vec![1, 29, 30, 31, 61, 62, 69]] {
            let remarks = of(70, &closed, Some(20_001));
            assert_eq!((closed_of(remarks[..3].iter().copied()), remarks[3]), (closed, 20_001));
            assert_eq!(fields(70, &[]).len(), remarks.len());
        }
        assert_eq!(of(1, &[], None), [NONE, NONE]);
        assert_eq!(of(0, &[], Some(u64::MAX)), [i32::MAX]);
        let names: Vec<_> = fields(40, &[]).into_iter().map(|field| (has_closed(&field.name), field.name)).collect();
        assert_eq!(names, [(true, "closed".into()), (true, "closed_2".into()), (false, "seen_events".into())]);
    }
}
