//! Detection of states outside the validity of the models, in which deformations reach the size of
//! a body. Extrapolation of rod laws is detected in `range`.

use super::range::curvatures;
use super::{Assembly, Part, Rod, SectionSpan};
use crate::scene::Monomers;
use actin_cosserat::constants::cross_section_radius;
use actin_mechanics::{State, Vector3};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Limit of the relative strain of a segment or of a junction's bond.
const STRAIN: f64 = 0.5;
/// Limit of curvature times radius. At 1 the inner side of a bent rod folds over.
const BEND: f64 = 1.0;
/// Limit of the root-mean-square change of length of an interface's bonds, over the maximum bond
/// length at rest.
const BONDS: f64 = 1.0;
/// Limit of the overlap of two bonded monomers in semi-axes. Spheres in contact have 0; at 1 one
/// centre lies on the surface of the other monomer.
const OVERLAP: f64 = 1.0;

/// Deformation of a filament beyond the validity of the model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModelLimitExceeded {
    /// Index of the filament.
    pub filament: usize,
    /// Index of the section in its filament; for a junction, index of the section before it.
    pub section: usize,
    /// Name of the dimensionless quantity that exceeds its limit:
    ///
    /// - `strain`: change of the end-to-end vector of a segment or of a junction's bond, in the
    ///   body frame, over its rest length;
    /// - `bend`: curvature of a rod times the radius of its cross-section;
    /// - `bonds`: root-mean-square change of length of the bonds between two monomers, over
    ///   `lateral_max_bond_nm` or `longitudinal_max_bond_nm`;
    /// - `contact`: depth of overlap of two surfaces, over the distance of their axes in contact;
    /// - `wall`: penetration depth into a wall, over the radius;
    /// - `overlap`: 2 minus the distance of the centres of two bonded monomers in semi-axes, along
    ///   the line of centres.
    pub quantity: String,
    /// Arc length of the largest value (nm, at rest).
    pub s_nm: f64,
    /// Largest value.
    pub value: f64,
    /// Limit of the quantity.
    pub limit: f64,
}

impl fmt::Display for ModelLimitExceeded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            s_nm, value, limit, ..
        } = self;
        match self.quantity.as_str() {
            "strain" => write!(f, "a segment at s = {s_nm:.2} nm is strained by {value:.2}")?,
            "bend" => write!(
                f,
                "the rod at s = {s_nm:.2} nm is bent to a curvature of {value:.2} over its radius"
            )?,
            "bonds" => write!(
                f,
                "the bonds at s = {s_nm:.2} nm are stretched or compressed by {value:.2} times the \
                 longest length that they may have at rest"
            )?,
            "contact" => write!(
                f,
                "the filament at s = {s_nm:.2} nm is pressed into another, or into itself, by {value:.2} \
                 of the distance of contact"
            )?,
            "wall" => write!(
                f,
                "the filament at s = {s_nm:.2} nm is pressed into a wall by {value:.2} of its radius"
            )?,
            _ => write!(
                f,
                "two monomers at s = {s_nm:.2} nm overlap by {value:.2} semi-axes"
            )?,
        }
        if self.filament > 0 {
            write!(f, " in filament {}", self.filament)?;
        }
        write!(f, " (limit {limit})")
    }
}

type LargestExcess = (f64, f64);

impl Assembly {
    /// Returns the model limits that `state` exceeds, at most one entry per section and quantity.
    ///
    /// Only neighbouring bodies and repelling bodies are checked. Without repulsion, distant parts
    /// of a filament or two filaments pass through each other undetected.
    pub fn beyond_use(&self, state: &State) -> Vec<ModelLimitExceeded> {
        let mut found = Vec::new();
        for rod in &self.rods {
            let radius = cross_section_radius();
            let from_nm = self.sections[rod.section].from_nm;
            let bends = curvatures(rod, state).map(|(s, kappa)| (from_nm + s, kappa.xy().norm()));
            let (s_nm, curvature) = bends.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default();
            let strain = self.largest_strain_of(rod, state);
            self.push_beyond(&mut found, rod.section, ("strain", STRAIN), strain);
            let bend = (s_nm, curvature * radius);
            self.push_beyond(&mut found, rod.section, ("bend", BEND), bend);
        }
        for (i, section) in self.sections.iter().enumerate() {
            if section.is_ellipsoids() {
                let (filament, place) = self.place_of_section(i);
                let monomers = self.monomers_of(filament);
                let own = self.written(filament).sections[place].monomers(monomers);
                if section.bonds() > 0 {
                    let bonds = self.largest_change_of_bonds(i, &own, state);
                    self.push_beyond(&mut found, i, ("bonds", BONDS), bonds);
                }
                let overlap = self.largest_overlap(section, monomers, state);
                self.push_beyond(&mut found, i, ("overlap", OVERLAP), overlap);
            }
        }
        for bond in self.junction_bonds() {
            let strain = self.strain(state, [bond.monomer, bond.node], bond.frame);
            let strain = (self.frames[bond.frame].s_nm, strain);
            self.push_beyond(&mut found, bond.junction, ("strain", STRAIN), strain);
        }
        self.push_touching(&mut found, state);
        worst(found)
    }

    fn push_touching(&self, found: &mut Vec<ModelLimitExceeded>, state: &State) {
        let repelled = self.repelled.iter();
        for touching in repelled.flat_map(|repelled| repelled.touching(state)) {
            let s_nm = touching.gap.places[0];
            let sections = &self.filaments[touching.filaments[0]].sections;
            let is_past = |section: &SectionSpan| section.to_nm < s_nm;
            let behind = self.sections[sections.clone()].partition_point(is_past);
            let section = (sections.start + behind).min(sections.end - 1);
            let quantity = match touching.part {
                Part::Contacts => "contact",
                _ => "wall",
            };
            let depth = (s_nm, touching.depth);
            self.push_beyond(found, section, (quantity, touching.limit), depth);
        }
    }

    fn push_beyond(
        &self,
        found: &mut Vec<ModelLimitExceeded>,
        section: usize,
        (quantity, limit): (&str, f64),
        (s_nm, value): LargestExcess,
    ) {
        if value > limit {
            let (filament, section) = self.place_of_section(section);
            found.push(ModelLimitExceeded {
                filament,
                section,
                quantity: quantity.to_owned(),
                s_nm,
                value,
                limit,
            });
        }
    }

    fn largest_strain_of(&self, rod: &Rod, state: &State) -> LargestExcess {
        let segments = rod.layout.points().zip(rod.layout.frames());
        let strains = segments.map(|(point, frame)| {
            let strain = self.strain(state, [point, point + 1], frame);
            (self.frames[frame].s_nm, strain)
        });
        largest(strains)
    }

    /// Change of the vector between two points in a body frame, over its length at rest.
    fn strain(&self, state: &State, [a, b]: [usize; 2], frame: usize) -> f64 {
        let seen = |state: &State| {
            let between = state.points.position.get(b) - state.points.position.get(a);
            state.frames.orientation.get(frame).inverse() * between
        };
        let rest = seen(&self.rest);
        (seen(state) - rest).norm() / rest.norm()
    }

    /// Largest root-mean-square change of bond length, obtained from the energy `S/2 <change^2>` of
    /// each interface.
    fn largest_change_of_bonds(
        &self,
        i: usize,
        monomers: &Monomers,
        state: &State,
    ) -> LargestExcess {
        let term = self.terms.iter().position(|t| t.part == Part::Section(i));
        let term = term.expect("every section has a term");
        let bonds = &self.system.interactions()[term];
        let mut energies = vec![0.0; bonds.elements()];
        bonds.write_energies(state, &mut energies);
        let changes = energies.iter().zip(&self.spans[term]);
        largest(changes.map(|(energy, [from, to])| {
            let is_lateral = to - from < 1.5 * monomers.rise_nm;
            let (rigidity, greatest) = if is_lateral {
                (
                    monomers.lateral_rigidity_pn_per_nm,
                    monomers.lateral_max_bond_nm,
                )
            } else {
                (
                    monomers.longitudinal_rigidity_pn_per_nm,
                    monomers.longitudinal_max_bond_nm,
                )
            };
            let change = (2.0 * energy / rigidity).sqrt() / greatest;
            (0.5 * (from + to), change)
        }))
    }

    fn largest_overlap(
        &self,
        section: &SectionSpan,
        monomers: &Monomers,
        state: &State,
    ) -> LargestExcess {
        let first_frame = section.frames.start;
        let (first, count) = (section.points.start, section.points.len());
        let semi_axes = Vector3::from(monomers.semi_axes_nm);
        let overlap = |lower: usize, upper: usize| {
            let x = |k: usize| state.points.position.get(first + k);
            let between = x(upper) - x(lower);
            let distance = [lower, upper].map(|k| {
                let q = state.frames.orientation.get(first_frame + k);
                let seen = q.inverse() * between;
                seen.component_div(&semi_axes).norm()
            });
            let s_nm = |k: usize| self.points[first + k].s_nm;
            let middle = 0.5 * (s_nm(lower) + s_nm(upper));
            (middle, 2.0 - distance[0].min(distance[1]))
        };
        let pairs = (0..count).flat_map(|lower| [(lower, lower + 1), (lower, lower + 2)]);
        let bonded = pairs.filter(|&(_, upper)| upper < count);
        largest(bonded.map(|(lower, upper)| overlap(lower, upper)))
    }
}

/// Returns the largest excess of each quantity, filament and section, in the order of their first occurrence.
pub fn worst(found: impl IntoIterator<Item = ModelLimitExceeded>) -> Vec<ModelLimitExceeded> {
    let mut worst: Vec<ModelLimitExceeded> = Vec::new();
    for beyond in found {
        let is_same = |b: &&mut ModelLimitExceeded| {
            (b.filament, b.section, &b.quantity)
                == (beyond.filament, beyond.section, &beyond.quantity)
        };
        match worst.iter_mut().find(is_same) {
            Some(known) if known.value >= beyond.value => {}
            Some(known) => *known = beyond,
            None => worst.push(beyond),
        }
    }
    worst
}

fn largest(values: impl Iterator<Item = LargestExcess>) -> LargestExcess {
    values
        .max_by(|a, b| a.1.total_cmp(&b.1))
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use actin_mechanics::{UnitQuaternion, rotation};

    fn build() -> Assembly {
        let text = "Scene(
            filament: Filament(sections: [
                Rod(from_nm: 0.0, to_nm: 20.0, segments: 2),
                Ellipsoids(from_nm: 20.0, to_nm: 50.0),
                Rod(from_nm: 50.0, to_nm: 70.0, segments: 2),
            ]),
            clamps: [Clamp(end: Start)],
            task: Equilibrium(),
        )";
        Assembly::build(&Scene::from_ron(text).unwrap()).unwrap()
    }

    fn quantities(assembly: &Assembly, state: &State) -> Vec<(usize, String)> {
        let found = assembly.beyond_use(state).into_iter();
        found.map(|b| (b.section, b.quantity)).collect()
    }

    fn parted(assembly: &Assembly, from: usize, by: f64) -> State {
        let mut state = assembly.rest.clone();
        for i in from..state.points.len() {
            state.points.position.add(i, Vector3::z() * by);
        }
        state
    }

    #[test]
    fn rigid_motions_stay_within_the_limits() {
        let assembly = build();
        let mut state = assembly.rest.clone();
        assert!(assembly.beyond_use(&state).is_empty());
        let turn = UnitQuaternion::from_scaled_axis(Vector3::new(0.3, -2.0, 0.7));
        for i in 0..state.points.len() {
            let x = turn * state.points.position.get(i) + Vector3::repeat(1e3);
            state.points.position.set(i, x);
        }
        for i in 0..state.frames.len() {
            let q = turn * state.frames.orientation.get(i);
            state.frames.orientation.set(i, q);
        }
        assert!(assembly.beyond_use(&state).is_empty());
        let overlap = assembly.largest_overlap(
            &assembly.sections[1],
            &assembly.scene.filament.monomers,
            &state,
        );
        // At rest, surfaces of neighbours nearly touch.
        assert!(overlap.1.abs() < 0.2, "{overlap:?}");
    }

    #[test]
    fn a_segment_may_be_strained_by_half() {
        let assembly = build();
        let length = assembly.rods[0].layout.segment_lengths()[0];
        for (share, expected) in [(0.49, 0), (0.51, 1), (-0.49, 0), (-0.51, 1), (-1.9, 1)] {
            let found = assembly.beyond_use(&parted(&assembly, 1, share * length));
            assert_eq!(found.len(), expected, "{share}");
            for beyond in found {
                assert_eq!((beyond.section, beyond.quantity.as_str()), (0, "strain"));
                assert!((beyond.value - f64::abs(share)).abs() < 1e-12);
                assert!((beyond.s_nm - 0.5 * length).abs() < 1e-12);
            }
        }
        let state = parted(&assembly, 1, -1.9 * length);
        let words = assembly.beyond_use(&state)[0].to_string();
        assert_eq!(
            words,
            "a segment at s = 5.13 nm is strained by 1.90 (limit 0.5)"
        );
    }

    #[test]
    fn bonds_may_change_by_their_greatest_length() {
        let assembly = build();
        let points = assembly.sections[1].points.clone();
        let middle = usize::midpoint(points.start, points.end);
        assert_eq!(quantities(&assembly, &parted(&assembly, middle, 0.5)), []);
        let found = assembly.beyond_use(&parted(&assembly, middle, 20.0));
        let [bonds] = &found[..] else {
            panic!("{found:?}");
        };
        assert_eq!((bonds.section, bonds.quantity.as_str()), (1, "bonds"));
        // Lateral bonds are at most 1.6 nm long at rest. They run about as much across as along.
        assert!(bonds.value > 10.0 && bonds.value < 20.0 / 1.6, "{bonds}");
        let s_nm = assembly.points[middle].s_nm;
        assert!((bonds.s_nm - s_nm).abs() < 3.0, "{bonds}");
    }

    #[test]
    fn overlapping_monomers_are_reported() {
        let assembly = build();
        let first = assembly.sections[1].points.start;
        for (share, expected) in [(0.3, false), (0.6, true), (1.0, true)] {
            let mut state = assembly.rest.clone();
            let x = &state.points.position;
            let along = x.get(first + 5) - x.get(first + 3);
            state.points.position.add(first + 3, along * share);
            let found = assembly.beyond_use(&state);
            let overlap = found.iter().find(|b| b.quantity == "overlap");
            assert_eq!(overlap.is_some(), expected, "{share}: {found:?}");
            if share > 0.9 {
                assert!((overlap.unwrap().value - 2.0).abs() < 1e-12);
            }
        }
    }

    /// With segments of about 10 nm, 2 rad per joint give 0.2 rad/nm, or 0.7 times the inverse
    /// radius of 3.5 nm.
    #[test]
    fn a_rod_may_be_bent_to_its_own_radius() {
        let assembly = build();
        for (angle, expected) in [(2.0, 0), (3.0, 1)] {
            let mut state = assembly.rest.clone();
            let turn = rotation::exp(Vector3::x() * angle);
            let node = assembly.rods[0].layout.points().start + 1;
            let pivot = state.points.position.get(node);
            for i in node..state.points.len() {
                let arm = state.points.position.get(i) - pivot;
                state.points.position.set(i, pivot + turn * arm);
            }
            let frame = assembly.rods[0].layout.frames().start + 1;
            for i in frame..state.frames.len() {
                let q = turn * state.frames.orientation.get(i);
                state.frames.orientation.set(i, q);
            }
            let found = assembly.beyond_use(&state);
            assert_eq!(found.len(), expected, "{found:?}");
            for beyond in found {
                assert_eq!((beyond.section, beyond.quantity.as_str()), (0, "bend"));
                let between = assembly.rods[0].layout.voronoi_lengths()[1];
                let exact = angle / between * (38.5_f64 / std::f64::consts::PI).sqrt();
                assert!((beyond.value - exact).abs() < 1e-12, "{beyond}");
            }
        }
    }
}
