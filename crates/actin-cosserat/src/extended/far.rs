//! What a segment beside an end of its rod would do far from it.

use super::law::MeanCurvature;
use super::{EndTwist, SegmentCurvature, SegmentLaw};
use crate::{RodLayout, RodMaterial};
use actin_mechanics::{State, Vector3};

/// Share by which shear counts less or more where an end is too far to be seen.
const UNCHANGED: f64 = 1e-9;
/// Doublings, then halvings of an interval, within which a twist is found.
const DOUBLINGS: u32 = 20;
const HALVINGS: u32 = 50;
/// Twist that a search begins with (rad/nm).
const FIRST_TWIST: f64 = 1e-4;

/// A segment beside an end of its rod, and the same under its loads far from ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FarFromEnds {
    /// Its strain far from ends (body axes).
    pub strain: Vector3,
    /// Its curvature there (rad/nm, body axes).
    pub curvature: Vector3,
    /// The energy per length (pN) that it has beside the end.
    pub energy: f64,
}

impl SegmentCurvature {
    /// Segment `k` of a rod far from ends; none where ends change nothing.
    ///
    /// Shear is as much more or less as its compliance there; twist is that at which the law of the rod has the couple of twist
    /// alone that each bending element around has beside the end. What twist, shear and bending have to do with each other is left
    /// out of both.
    pub fn far_from_ends(
        &self,
        (layout, material, law): (&RodLayout, &RodMaterial, &SegmentLaw),
        k: usize,
        state: &State,
    ) -> Option<FarFromEnds> {
        let across = self.shear_factor(k);
        let ends: Vec<(&EndTwist, f64)> = (self.around(k).iter())
            .filter_map(|around| Some((self.end_twist(around.frames)?, around.share)))
            .collect();
        if (across - 1.0).abs() < UNCHANGED && ends.is_empty() {
            return None;
        }
        let length = layout.segment_lengths()[k];
        let points = layout.points().start + k;
        let x = &state.points.position;
        let q = state.frames.orientation.get(layout.frames().start + k);
        let strain = q.inverse() * (x.get(points + 1) - x.get(points)) / length - Vector3::z();
        let seen = strain.component_mul(&Vector3::new(across, across, 1.0));
        let mean = self.mean(k, state);
        let mut far = FarFromEnds {
            strain: seen.component_mul(&Vector3::new(across, across, 1.0)),
            curvature: mean,
            energy: law.energy(material, seen, MeanCurvature::inside(mean))
                + material.bending_energy_density(mean),
        };
        for (end, share) in ends {
            let beyond = end.twist_beyond(material, state);
            far.curvature.z += share * (end.far_twist(material, beyond) - beyond);
            // Half of the segment, over the length that the element stands for.
            far.energy += 0.5 * end.energy(material, state) / end.rest_distance();
        }
        Some(far)
    }
}

impl EndTwist {
    /// The twist (rad/nm) beyond that at rest at which an element like others has the couple that this one has at `beyond`.
    fn far_twist(&self, material: &RodMaterial, beyond: f64) -> f64 {
        let couple = material.twist_couple(beyond) + self.couple(material, beyond);
        let sign = couple.signum();
        let is_past = |twist: f64| sign * material.twist_couple(sign * twist) >= couple.abs();
        let mut most = beyond.abs().max(FIRST_TWIST);
        for _ in 0..DOUBLINGS {
            if is_past(most) {
                break;
            }
            most *= 2.0;
        }
        let mut least = 0.0;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (least + most);
            if is_past(middle) {
                most = middle;
            } else {
                least = middle;
            }
        }
        sign * most
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::extended::END_TWIST_NM;
    use crate::layout::BOTH;
    use crate::{EndShear, EnergyGradient, Homogenised, StraightRod};
    use actin_mechanics::{Interaction, rotation};

    /// A rod of 80 nm between walls, turned and sheared evenly.
    fn between_walls(segments: usize, twist: f64, shear: f64) -> (State, EnergyGradient) {
        let mut state = State::default();
        let rod = StraightRod {
            walls: BOTH,
            ..StraightRod::uniform(segments, 80.0 / segments as f64)
        };
        let layout = rod.push(&mut state).unwrap();
        let mut turn = 0.0;
        for (frame, distance) in layout.bending_chain().zip(layout.voronoi_lengths()) {
            turn += twist * distance;
            let q = rotation::exp(Vector3::z() * turn);
            state.frames.orientation.set(frame + 1, q);
        }
        for (k, frame) in layout.frames().enumerate() {
            let across = state.frames.orientation.get(frame) * Vector3::x() * shear;
            let edge = (across + Vector3::z()) * layout.segment_lengths()[k];
            let from = layout.points().start + k;
            let next = state.points.position.get(from) + edge;
            state.points.position.set(from + 1, next);
        }
        let material = RodMaterial::homogenised(Homogenised::mean_filament());
        let law = SegmentLaw::of(&material, None).unwrap();
        let curvature = SegmentCurvature::new(&layout, &[], &[]);
        let curvature = curvature.with_ends(&layout, [EndShear::Blocked; 2], [0.0; 2]);
        let rod = EnergyGradient::new(layout, material).with_extension(law, curvature);
        (state, rod)
    }

    /// Segments beside walls and those between them have all the energy of the rod. A plausible bug, the law's energy beside
    /// walls too, misses the lengths that are added and taken there.
    #[test]
    fn segments_have_the_energy_of_their_rod() {
        for segments in [4, 8, 40] {
            let (state, rod) = between_walls(segments, 0.02, 1e-3);
            let (layout, material) = (rod.layout(), rod.material());
            let extended = rod.extended().unwrap();
            let (law, curvature) = (&extended.law, &extended.curvature);
            let of = |k: usize| {
                let far = curvature.far_from_ends((layout, material, law), k, &state);
                let usual = || {
                    let strain = Vector3::new(1e-3, 0.0, 0.0);
                    law.uniform_energy(material, strain, curvature.mean(k, &state))
                };
                layout.segment_lengths()[k] * far.map_or_else(usual, |far| far.energy)
            };
            let sum: f64 = (0..segments).map(of).sum();
            let energy = rod.energy(&state);
            assert!((sum / energy - 1.0).abs() < 1e-12, "{sum} {energy}");
            let strain = Vector3::x() * 1e-3;
            let even = 80.0 * law.uniform_energy(material, strain, Vector3::z() * 0.02);
            assert!((even / energy - 1.0).abs() > 0.5 * END_TWIST_NM / 80.0);
        }
    }

    /// Far from ends an element has the couple that it has beside one, and twists less there; shear is more than beside a
    /// wall.
    #[test]
    fn loads_far_from_ends_are_those_beside_them() {
        for twist in [-0.02, 2e-3, 0.03] {
            let (state, rod) = between_walls(8, twist, 1e-3);
            let extended = rod.extended().unwrap();
            let (material, curvature) = (rod.material(), &extended.curvature);
            for end in curvature.end_twists() {
                let beyond = end.twist_beyond(material, &state);
                let couple = material.twist_couple(beyond) + end.couple(material, beyond);
                let far = material.twist_couple(end.far_twist(material, beyond));
                assert!((far / couple - 1.0).abs() < 1e-9, "{far} {couple}");
            }
            let at =
                |k| curvature.far_from_ends((rod.layout(), material, &extended.law), k, &state);
            let wall = at(0).unwrap();
            let factor = curvature.shear_factor(0);
            assert!((wall.strain.x / (1e-3 * factor * factor) - 1.0).abs() < 1e-12);
            assert!(factor > 1.0 && at(4).unwrap().strain.x < wall.strain.x);
        }
    }
}
