//! Chaos: Lyapunov exponents through impacts, chatter and sticking, the dimension, and sections of the attractor.
//!
//! Two tangent vectors of an oscillator follow the motion and are made orthogonal again after each impact (Benettin et al. 1980,
//! doi:10.1007/BF02128236; through impacts: P. Müller, Chaos Solitons Fractals 5 (1995) 1671-1681,
//! doi:10.1016/0960-0779(94)00170-U). Per unit of time,
//!
//! $$`\lambda_i = \lim \frac{1}{t}\sum_j \ln r_{ii}^{(j)}, \qquad
//!   \lambda_1 + \lambda_2 = 2\,\overline{\ln\varepsilon}\;\nu - 2\zeta,`$$
//!
//! where $`\nu`$ is the number of impacts per unit of time and the mean is over impacts. The second equation is an
//! identity of the determinant. The exponents are measured independently of it, and tests compare both.
//!
//! Some motions have no impacts that could be measured. Their exponents are known exactly:
//!
//! | motion | exponents |
//! |---|---|
//! | without impacts | those of the flight: $`-\zeta`$ twice, from $`\zeta = 1`$ on $`-\zeta \pm \sqrt{\zeta^2-1}`$ |
//! | sticks again and again | $`-\infty`$ twice: a release is one state, whatever the motion was before |
//! | stuck for ever | $`-\infty`$ twice |
//! | impacts on a stop of restitution 0 without sticking | $`\lambda_2 = -\infty`$: the rebound does not depend on the arrival speed |
//! | only grazes a stop | none: at a grazing contact there is no derivative |
//!
//! | idea | file |
//! |---|---|
//! | the exponents of the motion from a start | [`exponents()`], [`Exponents`] |
//! | how neighbouring motions separate: flight and saltation | [`tangent`] |
//! | all exponents of the motion of a machine | [`machine_exponents_while`] |
//! | the Kaplan-Yorke dimension | `dimension` |
//! | points of the attractor in both sections | [`section`] |
//! | exponents along impacts, as measured for verdicts | [`lyapunov`] |

mod dimension;
mod exponents;
mod machine;
mod run;
mod section;

pub use crate::lyapunov::{Arrivals, Measured, Spectrum, Tail, lyapunov, tangent};
pub use exponents::{
    DEFAULT_IMPACTS, DEFAULT_TRANSIENT, ExponentOptions, Exponents, Grounds, exponents, exponents_while,
};
pub use machine::{DEFAULT_EVENTS, DEFAULT_MACHINE_TRANSIENT, machine_exponents_while};
pub use section::{Section, section, section_while};
