//! Where a state leaves the data behind a rod's fitted laws.

use super::{Assembly, Rod};
use actin_cosserat::BendingElement;
use actin_mechanics::{State, Vector3};
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// A rod goes further than the data that one of its laws was fitted to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeyondRange {
    /// Index of the filament.
    #[serde(default)]
    pub filament: usize,
    /// Index of the section in its filament.
    pub section: usize,
    /// `twist` or `curvature`.
    pub quantity: String,
    /// Where it goes furthest, as arc length at rest (nm).
    pub s_nm: f64,
    /// What it reaches there (rad/nm).
    pub value_per_nm: f64,
    /// How far the data reach (rad/nm).
    pub range_per_nm: f64,
}

impl Assembly {
    /// Where the rods leave the data of their laws in `state`: at most once per section and
    /// quantity, where it is worst. Beyond their data laws of twist and of length go on with the
    /// slope that they have there, bending by its formula. Junctions are not looked at.
    pub fn beyond_range(&self, state: &State) -> Vec<BeyondRange> {
        let twist = |kappa: Vector3| kappa.z;
        let bend = |kappa: Vector3| kappa.xy().norm();
        let mut found = Vec::new();
        for rod in &self.rods {
            let filament = self.filament_of_section(rod.section);
            let ranges = [
                ("twist", rod.twist_range, twist as fn(Vector3) -> f64),
                ("curvature", rod.bend_range, bend),
            ];
            for (quantity, range, measure) in ranges {
                let Some(range_per_nm) = range else { continue };
                let (s_nm, value_per_nm) = self.furthest(rod, state, measure);
                if value_per_nm.abs() > range_per_nm {
                    found.push(BeyondRange {
                        filament,
                        section: rod.section - self.filaments[filament].sections.start,
                        quantity: quantity.to_owned(),
                        s_nm,
                        value_per_nm,
                        range_per_nm,
                    });
                }
            }
        }
        found
    }

    /// The worst of [`beyond_range`](Self::beyond_range) over some states.
    pub fn worst_beyond_range<'a>(
        &self,
        states: impl IntoIterator<Item = &'a State>,
    ) -> Vec<BeyondRange> {
        let mut worst: Vec<BeyondRange> = Vec::new();
        let mut known: HashMap<(usize, usize, String), usize> = HashMap::new();
        for beyond in states
            .into_iter()
            .flat_map(|state| self.beyond_range(state))
        {
            let place = (beyond.filament, beyond.section, beyond.quantity.clone());
            let k = *known.entry(place).or_insert(worst.len());
            match worst.get_mut(k) {
                Some(known) if known.value_per_nm.abs() >= beyond.value_per_nm.abs() => {}
                Some(known) => *known = beyond,
                None => worst.push(beyond),
            }
        }
        worst
    }

    /// Where in a rod `measure` of the curvature is largest, and what it is there.
    fn furthest(&self, rod: &Rod, state: &State, measure: fn(Vector3) -> f64) -> (f64, f64) {
        let Rod {
            section, layout, ..
        } = rod;
        let q = &state.frames.orientation;
        let positions = layout.element_positions();
        let nodes = positions[layout.segments()..].iter();
        let elements = layout
            .bending_chain()
            .zip(layout.voronoi_lengths())
            .zip(nodes);
        let values = elements.map(|((a, &rest_distance), s)| {
            let kappa = BendingElement { rest_distance }.curvature(q.get(a), q.get(a + 1));
            (self.sections[*section].from_nm + s, measure(kappa))
        });
        values
            .max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))
            .unwrap_or_default()
    }
}
