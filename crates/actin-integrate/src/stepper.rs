use crate::environment::{DragHalves, Environment, Heating, NoEnvironment};
use crate::{Bath, Composition, Drag, Stage};
use actin_mechanics::{Split, Thermostat};

/// Advances a system by `steps` steps of `h` (ns). Positions and momenta are synchronised at the
/// end.
///
/// A step consists of drag over `h/2`, the stages of `scheme` over `b h`, and drag over `h/2`, with
/// `b` of [`Drag::time_rescaling`]. Neighbouring halves of the drag are merged; without drag,
/// neighbouring outer stages are merged. Dividing a run into two calls therefore changes it by
/// rounding only. Held and driven bodies move over `h`.
///
/// Without drag the error has the order of `scheme`. With drag, free decay, terminal displacement
/// under a constant force, and equilibria are exact for any step. Damped oscillations have order 2,
/// and the relaxation rate `r` of a mode has a relative error of at most `r h/2`. Velocities at the
/// ends of steps are smaller than displacement per time by [`Drag::recorded_drift`].
///
/// A negative `h` integrates backwards in time; drag then accelerates the system.
///
/// The loads are evaluated `steps * scheme.force_evaluations_per_step()` times, and once more if
/// the scheme begins with a kick and the loads are not current.
pub fn advance<S: Split + ?Sized>(
    system: &mut S,
    scheme: &Composition,
    h: f64,
    steps: u64,
    drag: &Drag,
) {
    if drag.is_none() {
        integrate(system, scheme, h, steps, &mut NoEnvironment);
    } else {
        integrate(system, scheme, h, steps, &mut DragHalves::new(drag, h));
    }
}

/// Advances a system in a heat bath, see [`advance`]. The first step has the number `first_step`.
///
/// A step consists of the Ornstein-Uhlenbeck process of `bath` over `h/2`, the stages of `scheme`
/// over `b h`, and the process over `h/2`. Nothing is merged, so that dividing a run into calls
/// with consecutive step numbers does not change any bit.
///
/// Without loads, the momenta have their exact distribution and the diffusion coefficient is
/// `kT/(m gamma)`. With loads, the error of the position distribution is of order 2 in `b h` for
/// the Verlet methods and of order 4 for the others.
pub fn advance_in<S: Thermostat + ?Sized>(
    system: &mut S,
    scheme: &Composition,
    h: f64,
    steps: u64,
    bath: &Bath,
    first_step: u64,
) {
    let mut heating = Heating::new(bath, h, first_step, system.bodies());
    integrate(system, scheme, h, steps, &mut heating);
}

fn integrate<S: Split + ?Sized>(
    system: &mut S,
    scheme: &Composition,
    h: f64,
    steps: u64,
    environment: &mut impl Environment<S>,
) {
    let [outer, inner @ .., _] = scheme.coefficients else {
        return;
    };
    if steps == 0 {
        return;
    }
    let (first, second) = (scheme.first, scheme.first.other());
    // The table is symmetric, so the last coefficient equals the first.
    let outer = outer * h;
    environment.before(system);
    environment.apply(first, system, outer);
    for _ in 1..steps {
        apply_inner(system, environment, second, inner, h);
        environment.between(system, first, outer);
    }
    apply_inner(system, environment, second, inner, h);
    environment.apply(first, system, outer);
    environment.after(system);
}

#[inline]
fn apply_inner<S: Split + ?Sized>(
    system: &mut S,
    environment: &impl Environment<S>,
    first: Stage,
    inner: &[f64],
    h: f64,
) {
    let mut stage = first;
    for coefficient in inner {
        environment.apply(stage, system, coefficient * h);
        stage = stage.other();
    }
}
