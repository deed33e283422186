//! Ever gentler impacts: the undamped limit without impacts.
//!
//! Without damping an impact with speed $`u > 0`$ is always followed by another ($`0 < \varepsilon`$): if $`\beta = p/q`$ and none
//! came within the common period $`2\pi q`$, the state would return to $`x = \delta`$ with velocity $`-\varepsilon u`$, so it
//! would have been beyond the stop just before. What there is instead is a limit: let $`u`$ be small and the flight be
//! free of contact for a whole common period. It returns to the phase of the impact, crosses $`\delta`$ a little earlier
//! on the same arc, $`\ddot x = -|a|`$, and strikes with
//!
//! $$`u_{j+1} = \varepsilon u_j\,(1 + O(u_j)), \qquad s_j = 2\pi q - \frac{2\varepsilon u_j}{|a|}(1 + O(u_j)).`$$
//!
//! So the speeds fall geometrically for ever, in infinite time, to a motion that just touches the stop and strikes no
//! more: label `0`. A labeller with a tolerance calls it 1/10 or 1/20, by the common period; and from $`u \approx 10^{-7}`$ on,
//! where the arc rises above the stop by less than rounding, a search finds nothing and reports a fluke. The limit is
//! recognised here by its law, over several impacts in a row, well before that.

use crate::motion::ImpactState;
use crate::system::{Oscillator, phase};

/// Impacts in a row that must obey the law.
pub const RUN: usize = 5;
/// Speed below which the law is tested: its corrections are of the order of the speed, and the law must hold to 2 %.
const SLOW: f64 = 1e-3;

/// Whether the last [`RUN`] impacts (state and the time since the impact before) follow the law of the graze limit.
#[must_use]
pub fn recognised(osc: &Oscillator, impacts: &[(ImpactState, f64)]) -> bool {
    let Some(run) = impacts.len().checked_sub(RUN).and_then(|first| impacts.get(first..)) else {
        return false;
    };
    let eps = osc.stop(run[0].0.side).map_or(0.0, |stop| stop.restitution);
    if osc.damping() > 0.0 || run[0].0.velocity > SLOW || eps >= 1.0 {
        return false;
    }
    run.windows(2).all(|pair| {
        let ((before, _), (after, interval)) = (&pair[0], &pair[1]);
        let away = -crate::contact::sticking::pressure(osc, after.side, after.phase);
        let early = 4.0 * (1.0 + eps) * before.velocity / away + 1e-9;
        before.side == after.side
            && away > 0.0
            && (after.velocity / (eps * before.velocity) - 1.0).abs() < 0.02
            && phase::difference(osc.beta() * interval, 0.0).abs() < early * (1.0 + osc.beta())
            && phase::difference(*interval, 0.0).abs() < early
    })
}
