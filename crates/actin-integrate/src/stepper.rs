//! The one loop that all methods share.

use crate::surroundings::{Dragging, Heating, Nothing, Surroundings};
use crate::{Bath, Composition, Drag, Stage};
use actin_mechanics::{Agitate, Split};

/// Advances a system by `steps` steps of `h` (ns), and leaves it with positions and momenta at
/// the same time.
///
/// Each step is: drag over `h/2`, the stages of `scheme`, drag over `h/2`. Between steps the two
/// halves of the drag are one; without drag, the last stage of a step and the first of the next
/// are one too. Splitting a run into two calls therefore changes it by round-off only, and with
/// drag by at most the round-off of `exp(-gamma h/2)^2` against `exp(-gamma h)`.
///
/// Without drag the error is of the order of `scheme`. Drag is exact on its own, but its
/// alternation with the conservative step is of second order: with drag, an oscillation is
/// followed to order 2 by every scheme. Equilibria are not affected.
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
/// Each step is: the Ornstein-Uhlenbeck process of `bath` over `h/2`, the stages of `scheme`, the
/// process over `h/2`. Nothing is merged between steps: splitting a run into two calls, the second
/// with the number of the step that it begins with, changes no bit.
///
/// Where there are no loads, momenta have their exact law at every step. Where there are, the
/// stationary law of positions differs from Boltzmann's by the error of `scheme` in the energy
/// that it conserves: of order 2 in `h` for the Verlet methods, of order 4 for the others.
pub fn advance_in<S: Agitate + ?Sized>(
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
    first.apply(system, outer);
    for _ in 1..steps {
        apply_inner(system, second, inner, h);
        surroundings.between(system, first, outer);
    }
    apply_inner(system, second, inner, h);
    first.apply(system, outer);
    surroundings.after(system);
}

/// Everything between the first and the last stage of a step.
#[inline]
fn apply_inner<S: Split + ?Sized>(system: &mut S, first: Stage, inner: &[f64], h: f64) {
    let mut stage = first;
    for coefficient in inner {
        stage.apply(system, coefficient * h);
        stage = stage.other();
    }
}
