//! A machine of a file with some of its numbers varied.

use super::MachineSource;
use vibroimpact::continuation::machine::Family;
use vibroimpact::machine::Machine;

/// A machine as a function of the numbers at some paths.
#[derive(Clone, Debug)]
pub(crate) struct VariedMachine {
    source: MachineSource,
    paths: Vec<String>,
    /// The expanded machine, if the numbers stand in it as they do in the file. Then they change there, and nothing expands
    /// anew.
    expanded: Option<Machine>,
}

impl VariedMachine {
    /// `samples` are values of the numbers between which they vary.
    pub(crate) fn new<'a>(source: &MachineSource, paths: impl Iterator<Item = &'a str>, samples: &[Vec<f64>]) -> Self {
        let paths = paths.map(str::to_owned).collect();
        let anew = Self { source: source.clone(), paths, expanded: None };
        let Ok(machine) = source.machine() else { return anew };
        let changed = Self { expanded: Some(machine), ..anew.clone() };
        // a sample that is not allowed says nothing
        let same = samples.iter().all(|values| changed.at(values).is_some_and(|at| anew.at(values) == Some(at)));
        if same { changed } else { anew }
    }

    /// The machines with values that are a function of N numbers.
    pub(crate) fn family<const N: usize>(
        self,
        values: impl Fn([f64; N]) -> Vec<f64> + Clone + Send + Sync + 'static,
    ) -> Family<N> {
        let changed = self.expanded.as_ref().map(|one| Family::of_paths(one, self.paths.clone(), values.clone()));
        match changed {
            Some(Ok(family)) => family,
            _ => Family::of(move |numbers| self.at(&values(numbers))),
        }
    }

    /// The machine with these values; `None` if they are not allowed.
    pub(crate) fn at(&self, values: &[f64]) -> Option<Machine> {
        let mut changes = self.paths.iter().map(String::as_str).zip(values.iter().copied());
        if let Some(machine) = &self.expanded {
            let mut parts = machine.parts().clone();
            changes.try_for_each(|(path, value)| parts.set(path, value)).ok()?;
            return Machine::new(parts).ok();
        }
        self.source.with_all(changes).ok()?.machine().ok()
    }
}

#[cfg(test)]
mod tests {
    use super::super::CATALOGUE;
    use super::*;

    /// Each number of each machine of the catalogue, changed in the expansion and in the file.
    #[test]
    fn numbers_change_as_in_the_file() {
        let (mut expanded, mut all) = (0, 0);
        for entry in CATALOGUE {
            let source = entry.source().unwrap();
            for path in source.paths().unwrap() {
                let value = source.number(&path).unwrap();
                let samples: Vec<Vec<f64>> = [0.9, 1.0, 1.1].map(|factor| vec![factor * value]).into();
                let varied = VariedMachine::new(&source, core::iter::once(path.as_str()), &samples);
                for factor in [0.93, 1.04, 1.07] {
                    let anew = source.with(&path, factor * value).unwrap().machine().ok();
                    assert_eq!(varied.at(&[factor * value]), anew, "{} {path}", entry.name);
                }
                expanded += u32::from(varied.expanded.is_some());
                all += 1;
            }
        }
        assert!(expanded > all / 2 && expanded < all, "{expanded} of {all}");
    }
}
