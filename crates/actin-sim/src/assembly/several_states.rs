//! Where rods are twisted and bent so that the monomers that they stand for have several states.
//!
//! Under-twisted monomers snap when they are bent: at one curvature and twist there are states of other energies, which bear other
//! couples about the axis. Which they are in depends on how they came there; a rod has one.

use super::range::bends;
use super::{Assembly, Rod};
use actin_mechanics::{State, Vector3};

/// Twists between which there are several (rad/nm).
///
/// # Source
/// `cargo xtask homogenise states`, as the next.
const TWISTS: [f64; 2] = [-0.0225, -0.004];
/// Curvatures between which there are several, over the size of the twist. Cells have them from 0.55 to 0.65 on; filaments bend more
/// here and less there once they have: those of 300 nm that buckle snap where their rods reach 0.45.
const CURVATURES: [f64; 2] = [0.45, 2.0];

impl Assembly {
    /// Stretches of rods under a potential at which the monomers that they stand for have several states, each with its filament
    /// (arc lengths at rest, nm).
    pub(crate) fn several_states(&self, state: &State) -> Vec<(usize, [f64; 2])> {
        let mut found: Vec<(usize, [f64; 2])> = Vec::new();
        let has_potential = |rod: &&Rod| rod.law.0.potential().is_some();
        for rod in self.rods.iter().filter(has_potential) {
            let filament = self.filament_of_section(rod.section);
            let from_nm = self.sections[rod.section].from_nm;
            let mut elements: Vec<_> = bends(rod, state).collect();
            elements.sort_by(|a, b| a.0.total_cmp(&b.0));
            let middle = |a: usize, b: usize| 0.5 * (elements[a].0 + elements[b].0) + from_nm;
            let last = elements.len().saturating_sub(1);
            for k in (0..=last).filter(|&k| elements.get(k).is_some_and(|e| has_several(e.1))) {
                let [from, to] = [middle(k.saturating_sub(1), k), middle(k, last.min(k + 1))];
                match found.last_mut() {
                    Some((same, span)) if *same == filament && from <= span[1] => span[1] = to,
                    _ => found.push((filament, [from, to])),
                }
            }
        }
        found
    }
}

/// Whether monomers have several states at this curvature and twist (rad/nm, beyond those at rest).
fn has_several(bend: Vector3) -> bool {
    let within = |[low, high]: [f64; 2], value: f64| low <= value && value <= high;
    within(TWISTS, bend.z) && within(CURVATURES, bend.xy().norm() / bend.z.abs())
}
