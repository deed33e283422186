//! Many motions side by side: impacts per second of a batch, by the width of the lanes, where motions are periodic and
//! where they are chaotic.

use crate::widths;
use criterion::{BenchmarkId, Criterion, Throughput};
use vibroimpact::flight::{Contact, SearchLimits};
use vibroimpact::lanes::{ABREAST, Batch, Width};
use vibroimpact::verdict::{StartBox, scattered_starts};
use vibroimpact::{Oscillator, scenario};

/// Impacts of all of them together that one iteration stands for.
const IMPACTS: u64 = 20_000;

/// A batch that goes on for ever.
struct Flow<'a> {
    osc: &'a Oscillator,
    batch: Batch,
    next: u64,
}

impl<'a> Flow<'a> {
    fn new(osc: &'a Oscillator, width: Width) -> Self {
        let batch = Batch::new(osc, ABREAST, width).expect("lanes fly the paper's points");
        let mut flow = Self { osc, batch, next: ABREAST as u64 };
        for index in 0..ABREAST as u64 {
            flow.batch.push(scattered_starts(osc, StartBox::natural(osc), 1, index));
        }
        // past the transients
        let mut impacts = 0;
        while impacts < 100 * ABREAST as u64 {
            impacts += flow.round();
        }
        flow
    }

    /// A round with all that it leaves to be done; how many impacts it had.
    fn round(&mut self) -> u64 {
        self.batch.round();
        let mut impacts = self.batch.struck().len() as u64;
        for slot in self.batch.settling().to_vec() {
            self.replace(slot);
        }
        for slot in self.batch.rare().to_vec() {
            match self.batch.carefully(slot, SearchLimits::default()).0 {
                Contact::Impact { .. } if !self.batch.settles_after(slot, &self.batch.arrival(slot).0) => impacts += 1,
                _ => self.replace(slot),
            }
        }
        impacts
    }

    fn replace(&mut self, slot: u32) {
        self.batch.launch(slot, scattered_starts(self.osc, StartBox::natural(self.osc), 1, self.next));
        self.next += 1;
    }
}

pub(crate) fn bench(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("lanes");
    group.throughput(Throughput::Elements(IMPACTS));
    for (name, point) in [("S", scenario::S), ("U", scenario::U)] {
        let osc = point.oscillator();
        for (width, width_name) in widths() {
            let mut flow = Flow::new(&osc, width);
            // what one iteration does too much the next one does less
            let mut done = 0;
            group.bench_function(BenchmarkId::new(name, width_name), |b| {
                b.iter(|| {
                    while done < IMPACTS {
                        done += flow.round();
                    }
                    done -= IMPACTS;
                });
            });
        }
    }
    group.finish();
}
