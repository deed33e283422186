//! The words of the page around its numbers.

use super::page::short;
use super::rates::Rates;

/// What the page is about.
pub(super) const HEAD: &str = "\
# Performance

<!-- Written by `cargo xtask bench-peers`. Do not edit: change crates/xtask/src/bench_peers instead. -->

How fast vibroimpact follows motions and labels starts, beside other ways to do the same, and which of them miss impacts. The
peers are in [benches/peers](../benches/peers/README.md); the baseline, ratio 1, is the algorithm of the 1971 paper in C: the
closed form of the flight, looked at every 0.1 units of time until the mass is beyond the stop, then Newton's method.
";

/// Before the table of rates.
pub(super) const RATES: &str = "\
## Rates

One oscillator, one stop, restitution 0.5, no damping. One thread each.

- **chaos**: impacts per second on the chaotic motion at 1/beta = 1.11, gap 3 (the paper's point U); the first 200 impacts of each
  motion are dropped.
- **regular**: impacts per second on the settled motions at 1/beta = 1.3, gap 0.75 (point S), as many impacts of 1/1 as of 2/1.
- **basin**: starts per second to a label at S, for x in [-4, 0.75], v in [-4, 4], phase 0. The peers follow each start for 120
  impacts and then call it m/n for the smallest m up to 8 that repeats phase and velocity to 1e-6.
";

/// Before the table of labels.
pub(super) const LABELS: &str = "\
## What the starts were called

The labels of all rounds together. The peers visit the cells of one grid in one order, each as far as it comes in the time, so the
shares should agree up to the number of starts. *stuck*: the mass came to rest on the stop, where the paper's algorithm ends, or no
impact followed; *open*: no m up to 8 after 120 impacts, as in a chatter that the peer does not complete.
";

/// Before the table of accuracy.
pub(super) const ACCURACY: &str = "\
## Accuracy

Starts with a wrong impact among the first FIRST: a time that differs by more than TOLERANCE, one that is missing or one too many.
The truth is `vibro simulate`, whose search advances only where contact is proven impossible, and which the tests of this
repository hold against an independent search in high precision; so vibroimpact has no row here. The safe search in C shares no
code with it. A start is followed for at most PERIODS forcing periods, and up to where the mass comes to rest on the stop. N to U
are the points of the paper, with random x in [-4, gap], v in [-4, 4] and phase. The starts near grazing are at 1/beta = 1.11, with
the stop 1e-6 to 1e-4 below the first maximum of their flight.

Two things make an impact wrong: it is missed, as by a scan or a long step over a short excursion, or its time is off. RK45 as
it comes aims at relative errors of 1e-3, so nearly all of its times are off by more than the tolerance here.
";

/// How to get the page again.
pub(super) const AGAIN: &str = "\
## Again

```sh
cargo xtask bench-peers                          # this page
cargo xtask bench-peers --rounds 9 --seconds 2   # the same with more patience
cargo xtask bench-peers --quick                  # a look, into target/peers/performance.md
```

It needs gcc, Python 3.11 or later with `venv`, and for the first run access to PyPI; what it installs and builds lies in
`target/peers`.
";

/// What to keep in mind, with what was measured of it.
pub(super) fn fairness(rates: &Rates) -> String {
    let share = |name: &str| rates.rows.iter().find(|row| row.name == name).map_or(0.0, |row| row.callback_share);
    let per_cent = |share: f64| if share > 0.0 { format!("{} %", short(100.0 * share)) } else { "a part".to_owned() };
    format!(
        "\
## What to keep in mind

- The contenders take turns, so that a slow minute of the machine falls on all of them. A slow second falls on one: differences
  within the spread given below the table mean nothing. Time is wall-clock time, without the start of the program and without
  compilation.
- The baseline computes two sines and a cosine at each step. The table avoids this and lets the compiler use vector instructions;
  it misses what the baseline misses. A shorter step would miss less and take longer.
- The safe search in C is what one gets by hand for this one system. It knows no damping, no second stop, no resonance and no
  chatter.
- heyoka and SciPy solve far more general problems and do not know that the flight has a closed form. heyoka runs with a
  tolerance of 1e-12 and fast_math. From Python it must call a Python function at every impact; in the chaos runs that function
  alone took {} of the time of one motion and {} of that of the batch, and the call costs some more. heyoka used from C++ would
  be faster by about that.
- SciPy follows few impacts in the time given, so its rates are less certain, and in the basin its last start counts by the part
  that was done. With RK45 as it comes the motion is not the true one for long; what is timed is then another motion of the same
  kind.
- vibroimpact runs with one thread. Its lanes follow several motions at once, and so does the batch of heyoka. In the basin it does
  not count to 120: it stops when the motion is confirmed to have settled, and looks further where it has not. It does more at each
  impact than the peers: the touch that is no impact, the chatter that ends and the mass that sticks are results of their own.
",
        per_cent(share("heyoka, one motion")),
        per_cent(share("heyoka, batch"))
    )
}
