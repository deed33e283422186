//! Long lists in a summary: those with the largest shares, and the others together.

use crate::number::percent;
use vibroimpact::math::sort_by;

/// Number of items that are shown of a longer list.
const SHOWN: usize = 12;

/// The items to show of a list, and what the others have in common.
pub(crate) struct Leading<T> {
    pub(crate) shown: Vec<T>,
    /// The number of the others, and the sum of their shares. `None` if all are shown.
    pub(crate) others: Option<(usize, f64)>,
}

/// The twelve items with the largest shares, in falling order, and those that must be `kept`. A list with one more is shown as it is.
pub(crate) fn leading<T>(items: Vec<T>, share: impl Fn(&T) -> f64, kept: impl Fn(&T) -> bool) -> Leading<T> {
    if items.len() <= SHOWN + 1 {
        return Leading { shown: items, others: None };
    }
    let mut items = items;
    // a stable sort: equal shares stay in their order
    sort_by(&mut items, |a, b| share(b).total_cmp(&share(a)));
    let rest = items.split_off(SHOWN);
    let (kept, others): (Vec<T>, Vec<T>) = rest.into_iter().partition(kept);
    items.extend(kept);
    let sum = others.iter().map(share).sum();
    Leading { shown: items, others: Some((others.len(), sum)).filter(|(count, _)| *count > 0) }
}

impl<T> Leading<T> {
    /// The rows of a table with `width` columns: one for each item, and one for the others, with their share in column `share`
    /// and their name in column `name`.
    pub(crate) fn rows(
        &self,
        row: impl Fn(&T) -> Vec<String>,
        noun: &str,
        (name, share, width): (usize, usize, usize),
    ) -> Vec<Vec<String>> {
        let others = self.others.map(|(count, sum)| {
            let mut cells = vec![String::new(); width];
            cells[name] = format!("others ({count} {noun}s)");
            cells[share] = percent(sum);
            cells
        });
        self.shown.iter().map(row).chain(others).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_dozen_and_the_sum_of_the_others() {
        let items = |n: u32| (0..n).map(|k| (k, f64::from(k))).collect::<Vec<_>>();
        let few = leading(items(13), |item| item.1, |_| false);
        assert_eq!((few.shown.len(), few.shown[0].0, few.others), (13, 0, None));
        let many = leading(items(50), |item| item.1, |item| item.0 == 3);
        assert_eq!(
            many.shown.iter().map(|item| item.0).collect::<Vec<_>>(),
            [49, 48, 47, 46, 45, 44, 43, 42, 41, 40, 39, 38, 3]
        );
        assert_eq!(many.others, Some((37, f64::from((0..38).sum::<i32>() - 3))));
        let rows = many.rows(|item| vec![item.0.to_string(), String::new()], "label", (0, 1, 2));
        assert_eq!(rows.last().unwrap()[0], "others (37 labels)");
        assert_eq!(rows.len(), 14);
    }
}
