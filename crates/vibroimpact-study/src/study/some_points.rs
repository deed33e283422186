//! Some points of a map, as many as there is time for.

use super::Study;
use crate::{Column, Control};
use core::sync::atomic::{AtomicUsize, Ordering};
use rayon::prelude::*;

/// Consecutive points of a list, and their columns, one for each field.
pub type PointColumns<'a> = (&'a [usize], Vec<Column>);

/// The columns of some points of a map, which are computed by several threads in groups of `together` points. No group
/// begins after `enough` returns true, except the first one. The groups that are finished are returned in their order,
/// also when the run is stopped. There are none for studies of which only whole tiles are computed.
pub fn points_until<'a>(
    study: &Study,
    points: &'a [usize],
    together: usize,
    control: &Control<'_>,
    enough: impl Fn() -> bool + Sync,
) -> Vec<PointColumns<'a>> {
    let begun = AtomicUsize::new(0);
    let one = |group: &'a [usize]| {
        let first = begun.fetch_add(1, Ordering::Relaxed) == 0;
        if control.stopping() || !first && enough() {
            return None;
        }
        Some((group, study.points(group, &|| control.stopping())?))
    };
    let size = together.max(1);
    match control.pool() {
        Ok(pool) => pool.install(|| points.par_chunks(size).filter_map(one).collect()),
        // on a system without threads
        Err(_) => points.chunks(size).filter_map(one).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Plan;
    use crate::study::in_memory;
    use core::sync::atomic::AtomicBool;

    fn map(more: &str) -> Study {
        let axes = r#"[{"vary":"inverse_beta","over":"0.9:1.5:23"},{"vary":"gap","over":"0.3:2.5:17"}]"#;
        let text = format!(
            r#"{{"version":1,"system":{{"inverse_beta":1,"gap":1,"restitution":0.5}},"task":{{"map":{{"axes":{axes},"starts":3,"seed":1,"impacts":200,"fields":["power"]{more}}}}}}}"#
        );
        Study::new(&Plan::from_text(&text).unwrap()).unwrap()
    }

    #[test]
    fn points_are_those_of_the_tiles() {
        let control = Control { threads: 2, ..Control::default() };
        let all = in_memory(map(""), &control).unwrap();
        // in no order that a tile has
        let points: Vec<usize> = (0..23 * 17).map(|k| (k * 100) % (23 * 17)).collect();
        let mut seen = 0;
        for (group, columns) in points_until(&map(""), &points, 30, &control, || false) {
            for (field, (column, whole)) in all.fields.iter().zip(columns.iter().zip(&all.columns)) {
                for (k, point) in group.iter().enumerate() {
                    let width = field.width();
                    let (mut found, mut wanted) = (field.empty(1), field.empty(1));
                    found.copy(0, column, k * width, width);
                    wanted.copy(0, whole, point * width, width);
                    assert_eq!(found, wanted, "{} of {point}", field.name);
                }
            }
            seen += group.len();
        }
        assert_eq!(seen, points.len());
        // with refinement a field says that they are computed
        let refined = map(r#","refine":8"#);
        let groups = points_until(&refined, &points[..40], 100, &control, || false);
        assert_eq!(groups[0].1.last().unwrap().flags(), [1; 40]);
    }

    #[test]
    fn it_ends_when_there_is_no_time_or_it_is_stopped() {
        let points: Vec<usize> = (0..100).collect();
        let done = |control: &Control<'_>| {
            points_until(&map(""), &points, 10, control, || true).iter().map(|(group, _)| group.len()).sum::<usize>()
        };
        assert_eq!(done(&Control { threads: 1, ..Control::default() }), 10);
        let stop = AtomicBool::new(true);
        assert_eq!(done(&Control { stop: &stop, ..Control::default() }), 0);
        let sweep = r#"{"version":1,"system":{"inverse_beta":1.3,"gap":0.75,"restitution":0.5},"task":{"diagram":{"vary":"gap","over":"0.5:1.5:4"}}}"#;
        let sweep = Study::new(&Plan::from_text(sweep).unwrap()).unwrap();
        assert!(points_until(&sweep, &[0, 1], 1, &Control::default(), || false).is_empty());
    }
}
