//! What the lengths of segments do to a number: of all together, and of each stretch of a rod.
//!
//! Found by halving them, of a stretch with all others left as they are. The scheme is of second order also where
//! lengths change from one segment to the next, since each half of a segment bends by the moment at its own node; what
//! stretches do adds up. The state of the undivided segments is where the search for the equilibrium begins, and
//! nothing else: taken to another mesh it has errors of the same order.

use super::nearby::equilibrium_near;
use super::{ErrorEstimate, RodStretch, equilibrium, value};
use crate::Assembly;
use crate::scene::{Quantity, Scene, SceneProblem, Section};
use actin_mechanics::State;

/// Of an error of order 2 in the length of segments, what halving them leaves.
pub(super) const LEFT_BY_HALVING: f64 = 0.25;
/// Most stretches that are halved by themselves, where a rod is one section.
const MOST_STRETCHES: usize = 16;

/// A stretch, and what its segments do to the number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share {
    pub stretch: RodStretch,
    /// In the unit of the number; what is to be added to it.
    pub error: f64,
}

/// What halving all segments changes, and what that leaves; of an equilibrium with this value.
pub(super) fn of_all(
    here: (&Assembly, &State),
    quantity: Quantity,
    value: f64,
) -> Result<f64, SceneProblem> {
    let scene = with_segments(here.0, 2);
    if !scene.filament.sections.iter().any(Section::is_rod) {
        return Ok(0.0);
    }
    changed(&scene, here, (quantity, value))
}

/// The scene of an assembly with so many times its segments, counted.
pub(super) fn with_segments(assembly: &Assembly, times: usize) -> Scene {
    let mut scene = assembly.scene.clone();
    let spans = assembly.sections_of(0).iter();
    for (section, span) in scene.filament.sections.iter_mut().zip(spans) {
        if let Section::Rod { segments, .. } = section {
            *segments = Some(times * (span.points.len() - 1));
        }
    }
    scene
}

/// What each stretch does to the number, whose estimate is `found` in the equilibrium of the scene; none where a
/// stretch finds no equilibrium, or where they do not add up to the estimate within `doubt` of their sizes. All
/// segments are counted in the scene.
pub(super) fn of_stretches(scene: &Scene, found: &ErrorEstimate, doubt: f64) -> Option<Vec<Share>> {
    let sections = &scene.filament.sections;
    let counted = sections
        .iter()
        .filter_map(RodStretch::of)
        .map(|rod| rod.segments);
    let most = counted.sum::<usize>().div_ceil(MOST_STRETCHES);
    let (assembly, state) = equilibrium(scene).ok()?;
    let mut shares = Vec::new();
    for (i, section) in sections.iter().enumerate() {
        let Some(rod) = RodStretch::of(section) else {
            continue;
        };
        for stretch in rod.cut(most) {
            let mut halved = scene.clone();
            let mut all: Vec<Section> = sections.iter().cloned().collect();
            all.splice(i..=i, rod.with_halved(&stretch));
            halved.filament.sections = all.into();
            let error =
                changed(&halved, (&assembly, &state), (found.quantity, found.value)).ok()?;
            shares.push(Share { stretch, error });
        }
    }
    let sum = shares.iter().map(|share| share.error).sum::<f64>();
    let sizes = shares.iter().map(|share| share.error.abs()).sum::<f64>();
    ((sum - found.segments).abs() <= doubt * sizes).then_some(shares)
}

/// By how much more than to this scene the number changes when its segments are made shorter without end, if those that
/// changed it from `value` are of half the length; `near` is the equilibrium with that value.
fn changed(
    halved: &Scene,
    near: (&Assembly, &State),
    (quantity, value): (Quantity, f64),
) -> Result<f64, SceneProblem> {
    let (assembly, state) = equilibrium_near(halved, near)?;
    let halved = self::value(&assembly, &state, quantity);
    Ok((halved - value) / (1.0 - LEFT_BY_HALVING))
}
