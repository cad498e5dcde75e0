//! The one loop that all methods share.

use crate::{Composition, Drag, Stage};
use actin_mechanics::Split;

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
    let [outer, inner @ .., _] = scheme.coefficients else {
        return;
    };
    if steps == 0 {
        return;
    }
    let (first, second) = (scheme.first, scheme.first.other());
    let outer = outer * h;
    let half = Damping::over(drag, 0.5 * h);
    let whole = Damping::over(drag, h);
    half.apply(system);
    apply(system, first, outer);
    for _ in 1..steps {
        apply_inner(system, second, inner, h);
        join(system, first, outer, whole);
    }
    apply_inner(system, second, inner, h);
    apply(system, first, outer);
    half.apply(system);
}

/// Applies one stage for a time `t`.
#[inline]
fn apply<S: Split + ?Sized>(system: &mut S, stage: Stage, t: f64) {
    match stage {
        Stage::Drift => system.drift(t),
        Stage::Kick => system.kick(t),
    }
}

/// Everything between the first and the last stage of a step.
#[inline]
fn apply_inner<S: Split + ?Sized>(system: &mut S, first: Stage, inner: &[f64], h: f64) {
    let mut stage = first;
    for coefficient in inner {
        apply(system, stage, coefficient * h);
        stage = stage.other();
    }
}

/// What lies between the inner stages of two steps; the table being a palindrome, its last
/// coefficient is its first.
#[inline]
fn join<S: Split + ?Sized>(system: &mut S, stage: Stage, outer: f64, damping: Damping) {
    if damping.0.is_none() {
        apply(system, stage, 2.0 * outer);
    } else {
        apply(system, stage, outer);
        damping.apply(system);
        apply(system, stage, outer);
    }
}

/// Factors on velocities and angular momenta, if there is drag at all.
#[derive(Clone, Copy)]
struct Damping(Option<(f64, f64)>);

impl Damping {
    /// The effect of `drag` over a time `t`.
    fn over(drag: &Drag, t: f64) -> Self {
        Self((!drag.is_none()).then(|| drag.factors(t)))
    }

    #[inline]
    fn apply<S: Split + ?Sized>(self, system: &mut S) {
        if let Some((translational, rotational)) = self.0 {
            system.damp(translational, rotational);
        }
    }
}
