//! How many bodies and bonds all filaments of a scene have: counted before any is allocated.

use super::strand::Strand;
use crate::scene::{MOST_BODIES, MOST_BONDS, Problem, Scene};

/// Refuses a scene whose sections together have more than memory would hold, each of them alone
/// being small enough.
///
/// # Errors
/// The section with which it becomes too much.
pub(super) fn check(scene: &Scene, strands: &[Strand<'_>]) -> Result<(), Problem> {
    let mut totals = [0.0; 2];
    for (index, strand) in strands.iter().enumerate() {
        for i in 0..strand.filament.sections.len() {
            let named = |problem: Problem| problem.with_filament(&scene.filament_key(index));
            add(&mut totals, strand, i).map_err(named)?;
        }
    }
    Ok(())
}

fn add(totals: &mut [f64; 2], strand: &Strand<'_>, i: usize) -> Result<(), Problem> {
    let counts = match strand.resolved[i].monomers {
        Some((first, last)) => {
            let monomers = &strand.filament.monomers;
            let each = monomers.lateral_bonds + monomers.longitudinal_bonds;
            let count = (last - first + 1) as f64;
            [count, count * each as f64]
        }
        None => [strand.segments(i)? as f64, 0.0],
    };
    let limits = [("bodies", MOST_BODIES), ("bonds", MOST_BONDS)];
    for ((total, count), (what, most)) in totals.iter_mut().zip(counts).zip(limits) {
        *total += count;
        if *total > most {
            let (_, to_nm) = strand.filament.sections[i].span_nm();
            return Err(Problem::new(
                format!("filament.sections[{i}].to_nm"),
                format!("{to_nm:?}"),
                format!("{total:.2e} {what} up to this section, at most {most:e} are allowed"),
            ));
        }
    }
    Ok(())
}
