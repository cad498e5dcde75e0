//! The one loop that all methods share.

use crate::surroundings::{Dragging, Heating, Nothing, Surroundings};
use crate::{Bath, Composition, Drag, Stage};
use actin_mechanics::{Split, Thermostat};

/// Advances a system by `steps` steps of `h` (ns), and leaves it with positions and momenta at
/// the same time.
///
/// Each step is: drag over `h/2`, the stages of `scheme` over a time `b h`, drag over `h/2`, with
/// `b` of [`Drag::time_rescaling`]. Between steps the two halves of the drag are one; without drag
/// `b` is 1, and the last stage of a step and the first of the next are one too. Splitting a run
/// into two calls therefore changes it by round-off only. What is held or driven moves over `h`.
///
/// Without drag the error is of the order of `scheme`. With drag the following are exact at any
/// step: the decay of free motion, the displacement of a body under a constant force once its
/// velocity is terminal, and equilibria. The alternation of drag with the conservative step is of
/// second order in what remains: with drag, an oscillation is followed to order 2 by every scheme,
/// and the rate `r` at which a mode relaxes is off by at most `r h/2`, relative.
///
/// A terminal velocity shows in the displacement. The velocity at the end of a step stands behind
/// half a step of drag and is smaller, by [`Drag::recorded_drift`].
///
/// A negative `h` goes back in time; drag then speeds the system up.
///
/// Evaluates the loads `steps * scheme.force_evaluations_per_step()` times, and once more if the
/// scheme begins with a kick and the loads were not current.
pub fn advance<S: Split + ?Sized>(
    system: &mut S,
    scheme: &Composition,
    h: f64,
    steps: u64,
    drag: &Drag,
) {
    if drag.is_none() {
        integrate(system, scheme, h, steps, &mut Nothing);
    } else {
        integrate(system, scheme, h, steps, &mut Dragging::over(drag, h));
    }
}

/// [`advance`] in a heat bath, from the step with the number `first_step` on.
///
/// Each step is: the Ornstein-Uhlenbeck process of `bath` over `h/2`, the stages of `scheme` over
/// `b h` as in [`advance`], the process over `h/2`. Nothing is merged between steps: splitting a run into two calls, the second
/// with the number of the step that it begins with, changes no bit.
///
/// Where there are no loads, momenta have their exact law at every step, and a body diffuses with
/// `kT/(m gamma)`. Where there are, the stationary law of positions differs from Boltzmann's by the
/// error of `scheme` in the energy that it conserves: of order 2 in `b h` for the Verlet methods, of
/// order 4 for the others.
pub fn advance_in<S: Thermostat + ?Sized>(
    system: &mut S,
    scheme: &Composition,
    h: f64,
    steps: u64,
    bath: &Bath,
    first_step: u64,
) {
    let mut heating = Heating::over(bath, h, first_step, system.bodies());
    integrate(system, scheme, h, steps, &mut heating);
}

/// The loop: steps of `scheme`, with what happens around them.
fn integrate<S: Split + ?Sized>(
    system: &mut S,
    scheme: &Composition,
    h: f64,
    steps: u64,
    surroundings: &mut impl Surroundings<S>,
) {
    let [outer, inner @ .., _] = scheme.coefficients else {
        return;
    };
    if steps == 0 {
        return;
    }
    let (first, second) = (scheme.first, scheme.first.other());
    // The table being a palindrome, its last coefficient is its first.
    let outer = outer * h;
    surroundings.before(system);
    surroundings.apply(first, system, outer);
    for _ in 1..steps {
        apply_inner(system, surroundings, second, inner, h);
        surroundings.between(system, first, outer);
    }
    apply_inner(system, surroundings, second, inner, h);
    surroundings.apply(first, system, outer);
    surroundings.after(system);
}

/// Everything between the first and the last stage of a step.
#[inline]
fn apply_inner<S: Split + ?Sized>(
    system: &mut S,
    surroundings: &impl Surroundings<S>,
    first: Stage,
    inner: &[f64],
    h: f64,
) {
    let mut stage = first;
    for coefficient in inner {
        surroundings.apply(stage, system, coefficient * h);
        stage = stage.other();
    }
}
