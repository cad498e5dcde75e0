//! The equilibrium of a filament, found from that of the same filament with other segments.

use super::{at_rest, equilibrium};
use crate::assembly::BodyKind;
use crate::scene::{Scene, SceneProblem, Slides, Task};
use crate::shape::axis::Axis;
use crate::{Assembly, run};
use actin_mechanics::State;

/// The equilibrium that a scene leads to, found from that of `near`, which differs in the segments of its rods alone.
///
/// Newton's method takes a few steps from there, and from the built state as many as the scene itself; of a scene with a
/// path it is the minimum at its end that is next to `near`, wherever the path would lead. Solved from the
/// built state are scenes of which no minimum is found from there, and those with ends that slide or have hinges.
pub(super) fn equilibrium_near(
    scene: &Scene,
    near: (&Assembly, &State),
) -> Result<(Assembly, State), SceneProblem> {
    let assembly = Assembly::build(&at_rest(scene))?;
    match found(&assembly, near) {
        Some(state) => Ok((assembly, state)),
        None => equilibrium(scene),
    }
}

fn found(assembly: &Assembly, near: (&Assembly, &State)) -> Option<State> {
    let Task::Equilibrium(settings) = &assembly.scene.task else {
        return None;
    };
    let mut clamps = assembly.scene.clamps.iter();
    if clamps.any(|clamp| clamp.slides != Slides::Nowhere || clamp.hinge.is_some()) {
        return None;
    }
    let mut state = laid_along(assembly, near);
    let mut newton = run::solver(assembly, settings).ok()?;
    let solved = newton.solve(&mut state, assembly.system.interactions());
    solved
        .is_ok_and(|solved| !solved.is_saddle())
        .then_some(state)
}

/// Rods along those of another state, monomers as they are there.
fn laid_along(assembly: &Assembly, (other, there): (&Assembly, &State)) -> State {
    let mut state = assembly.system.state().clone();
    let end = assembly.drive.stages() as f64;
    assembly.drive.place(&mut state, end);
    let axis = Axis::of(other, there);
    let span = &assembly.filaments[0];
    let rest = &assembly.rest;
    for i in (0..assembly.points.len()).filter(|&i| rest.points.is_free(i)) {
        let s_nm = assembly.points[i].s_nm;
        let (place, axes) = axis.at(s_nm);
        let arm = rest.points.position.get(i) - span.axis_place(s_nm);
        let turned = axes * span.rotation.inverse();
        state.points.position.set(i, place + turned * arm);
    }
    for i in (0..assembly.frames.len()).filter(|&i| rest.frames.is_free(i)) {
        let turned = axis.at(assembly.frames[i].s_nm).1 * span.rotation.inverse();
        let q = turned * rest.frames.orientation.get(i);
        state.frames.orientation.set(i, q);
    }
    // Held monomers are where they were, too.
    for (i, k) in monomers(assembly).zip(monomers(other)) {
        let place = there.points.position.get(k);
        state.points.position.set(i, place);
        if let Some((i, k)) = assembly.points[i].frame.zip(other.points[k].frame) {
            let q = there.frames.orientation.get(k);
            state.frames.orientation.set(i, q);
        }
    }
    state
}

/// The points that are monomers, in order.
fn monomers(assembly: &Assembly) -> impl Iterator<Item = usize> + '_ {
    let points = 0..assembly.points.len();
    points.filter(|&i| assembly.points[i].kind == BodyKind::Monomer)
}
