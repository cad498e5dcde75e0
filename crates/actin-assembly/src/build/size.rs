//! Memory of all filaments of a scene, estimated before allocation.

use super::strand::Strand;
use crate::memory;
use crate::scene::{Scene, SceneProblem, Section};

/// Refuses a scene that exceeds the memory of the machine; returns the estimate (bytes).
///
/// # Errors
/// Names the section at which the sum exceeds the memory.
pub(super) fn check(scene: &Scene, strands: &[Strand<'_>]) -> Result<f64, SceneProblem> {
    let mut bytes = 0.0;
    for (index, strand) in strands.iter().enumerate() {
        bytes += memory::of_filament(&scene.task);
        for i in 0..strand.filament.sections.len() {
            let named = |problem: SceneProblem| problem.with_filament(&scene.filament_key(index));
            add(&mut bytes, scene, (strand, i)).map_err(named)?;
        }
    }
    Ok(bytes)
}

fn add(
    bytes: &mut f64,
    scene: &Scene,
    (strand, i): (&Strand<'_>, usize),
) -> Result<(), SceneProblem> {
    let filament = strand.filament;
    let (count, what) = if let Some((first, last)) = strand.resolved[i].monomers {
        let monomers = filament.sections[i].monomers(&filament.monomers);
        let bonds = monomers.lateral_bonds + monomers.longitudinal_bonds;
        let count = (last - first + 1) as f64;
        *bytes += memory::of_monomers(count, bonds, &scene.task);
        (count, "monomers")
    } else {
        let count = strand.segments[i] as f64;
        let rod = filament.sections[i].rod_model(&filament.rod);
        *bytes += memory::of_segments(count, &rod, &scene.task);
        (count, "segments")
    };
    let (name, value) = match filament.sections[i] {
        Section::Rod {
            segments: Some(written),
            ..
        } => ("segments", written.to_string()),
        Section::Rod { to_nm, .. } | Section::Ellipsoids { to_nm, .. } => {
            ("to_nm", format!("{to_nm:?}"))
        }
    };
    let key = format!("filament.sections[{i}].{name}");
    memory::check(*bytes, (&key, value), || {
        format!("with the {count:.2e} {what} of this section the scene needs")
    })
}
