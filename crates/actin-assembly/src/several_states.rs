//! Detection of rods under twist and bending at which monomers have several states.
//!
//! Under-twisted monomers snap under bending. At one curvature and twist they have states of
//! different energies and torques about the axis, selected by the loading history. A rod has a
//! single state.

use super::Assembly;
use super::range::bends;
use actin_mechanics::{State, Vector3};

/// Twists with several states (rad/nm).
///
/// Over-twisted monomers are omitted: they have several states from 0.025 rad/nm on, with torques
/// that differ by less than a tenth. Stronger under-twist is omitted too: its states appear at
/// smaller curvatures in planar bending.
///
/// # Source
/// `cargo xtask homogenise states`, also for [`CURVATURES`].
const TWISTS: [f64; 2] = [-0.028, -0.004];
/// Curvatures with several states, over the magnitude of the twist.
///
/// Cells have several states from 0.5 to 0.6 on. The lower bound is smaller because snapping
/// filaments bend nonuniformly. The end torque of filaments of 300 nm that buckle under -300 deg
/// (0.50 in a rod) is 12 % off, under -330 deg (0.46) 5 %, and under -360 deg (0.42) less than 1 %.
const CURVATURES: [f64; 2] = [0.45, 2.0];

impl Assembly {
    /// Warning on rods under a potential where monomers would have several states in `state`. `None` in a heat
    /// bath, where monomers change between the states.
    pub fn note_on_several_states(&self, state: &State) -> Option<String> {
        if self.scene.thermal().is_some() {
            return None;
        }
        let place = |(filament, [from, to]): (usize, [f64; 2])| match filament {
            0 => format!("from {from:.0} to {to:.0} nm"),
            _ => format!("of filament {filament} from {from:.0} to {to:.0} nm"),
        };
        let places: Vec<String> = self.several_states(state).map(place).collect();
        (!places.is_empty()).then(|| {
            format!(
                "the rod {} has an under-twist and bending at which monomers would have several states, with axial torques that differ by \
                 5 to 110 pN nm. A rod has one state. Resolve monomers there to distinguish \
                 them (docs/measured/homogenised.md)",
                places.join(", ")
            )
        })
    }

    /// Returns filament and arc length interval (nm, at rest) of each stretch of rods under a potential with several
    /// states.
    fn several_states(&self, state: &State) -> impl Iterator<Item = (usize, [f64; 2])> {
        let rods = self.rods.iter();
        let under_potential = rods.filter(|rod| rod.material.potential().is_some());
        under_potential.flat_map(|rod| {
            let filament = self.filament_of_section(rod.section);
            let from_nm = self.sections[rod.section].from_nm;
            let elements = bends(rod, state).map(|(s, bend)| (s, has_several(bend)));
            let found = stretches(elements.collect(), rod.layout.length());
            found
                .into_iter()
                .map(move |span| (filament, span.map(|s| from_nm + s)))
        })
    }
}

fn has_several(bend: Vector3) -> bool {
    let within = |[low, high]: [f64; 2], value: f64| low <= value && value <= high;
    within(TWISTS, bend.z) && within(CURVATURES, bend.xy().norm() / bend.z.abs())
}

/// Intervals (nm) around marked places of a rod, extended halfway to the nearest unmarked place.
fn stretches(mut places: Vec<(f64, bool)>, length: f64) -> Vec<[f64; 2]> {
    places.sort_by(|a, b| a.0.total_cmp(&b.0));
    // Junctions have several elements at one place; keep one.
    places.dedup_by(|next, kept| {
        let is_same = next.0 <= kept.0;
        kept.1 |= is_same && next.1;
        is_same
    });
    let mut found: Vec<[f64; 2]> = Vec::new();
    for (k, &(s, _)) in places.iter().enumerate().filter(|(_, place)| place.1) {
        let from = k
            .checked_sub(1)
            .map_or(0.0, |before| 0.5 * (places[before].0 + s));
        let to = places.get(k + 1).map_or(length, |next| 0.5 * (s + next.0));
        match found.last_mut() {
            Some(last) if from <= last[1] => last[1] = to,
            _ => found.push([from, to]),
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_surround_marked_places() {
        let at = |s: f64, is_marked: bool| (s, is_marked);
        let places = vec![
            at(40.0, true),
            at(0.0, false),
            at(0.0, true),
            at(10.0, false),
            at(20.0, false),
            at(30.0, true),
        ];
        assert_eq!(stretches(places, 45.0), [[0.0, 5.0], [25.0, 45.0]]);
        assert_eq!(stretches(vec![at(5.0, true)], 10.0), [[0.0, 10.0]]);
        assert_eq!(stretches(Vec::new(), 10.0), [[0.0; 2]; 0]);
    }
}
