//! Shorter segments for the rods of a scene.

use super::choose::DOUBT;
use super::halving::{of_all, of_stretches, with_segments};
use super::setting::SHORTEST_SEGMENTS_NM;
use super::stretch::divided;
use super::{ErrorEstimate, RodStretch, at_rest, check, equilibrium, grade, value};
use crate::scene::{Quantity, Scene, SceneProblem, Section};

/// The scene with shorter segments in its rods, which leave about as much of the error that they make in a number as halving all of
/// them would: graded, where that takes fewer, else all of half the length. None become longer than the longest, nor
/// shorter than half of 2.5 nm.
///
/// ```
/// use actin_sim::adapt::finer;
/// use actin_sim::{Quantity, Scene};
/// let text = "Scene(
///     filament: Filament(
///         sections: [Rod(from_nm: 0.0, to_nm: 160.0, segments: 8)],
///         rod: RodModel(law: Homogenised),
///     ),
///     clamps: [Clamp(end: Start), Clamp(end: End)],
///     path: [Stage(set: [Turn(end: End, turn_deg: (20.0, 0.0, 45.0))])],
///     task: Equilibrium(),
/// )";
/// // The couple of the turned end: the 20 nm beside it are resolved.
/// let scene = finer(&Scene::from_ron(text)?, Quantity::EndCouple)?;
/// assert_eq!(scene.filament.sections.len(), 2);
/// assert_eq!(scene.filament.sections[1].span_nm(), (140.0, 160.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Scenes of which errors are not known, as for [`estimate`](super::estimate), and an equilibrium that is not found.
pub fn finer(scene: &Scene, quantity: Quantity) -> Result<Scene, SceneProblem> {
    check(scene, quantity)?;
    let (assembly, state) = equilibrium(scene)?;
    let value = value(&assembly, &state, quantity);
    let segments = of_all((&assembly, &state), quantity, value)?;
    let counted = with_segments(&assembly, 1).filament.sections;
    let rods: Vec<RodStretch> = counted.iter().filter_map(RodStretch::of).collect();
    let longest_nm = rods.iter().map(RodStretch::segment_nm).fold(0.0, f64::max);
    let mut scene = scene.clone();
    scene.filament.sections = counted;
    let found = ErrorEstimate::of_segments(quantity, value, segments);
    let finer = graded(&scene, &found, longest_nm);
    let finer = finer.unwrap_or_else(|| rods.iter().map(RodStretch::halved).collect());
    let sections = scene.filament.sections.iter();
    let parts = sections.flat_map(|section| parts(section, &finer));
    scene.filament.sections = parts.collect::<Vec<_>>().into();
    Ok(scene)
}

/// Lengths up to a longest (nm) that leave as much of the segments' part of an estimate as halving all would; none where
/// these are about as many. All segments are counted in the scene.
pub(super) fn graded(
    scene: &Scene,
    found: &ErrorEstimate,
    longest_nm: f64,
) -> Option<Vec<RodStretch>> {
    let shares = of_stretches(&at_rest(scene), found, DOUBT)?;
    grade::graded(&shares, [SHORTEST_SEGMENTS_NM, longest_nm])
}

/// A section, in several where it is a rod whose segments are graded.
pub(super) fn parts(section: &Section, graded: &[RodStretch]) -> Vec<Section> {
    let (from_nm, to_nm) = section.span_nm();
    let stretches = divided([from_nm, to_nm], graded);
    if !section.is_rod() || stretches.is_empty() {
        return vec![section.clone()];
    }
    stretches.iter().map(RodStretch::section).collect()
}
