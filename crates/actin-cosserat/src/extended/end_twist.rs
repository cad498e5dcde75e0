//! Change of twist near a blocked end.

use super::end_shear::{END_SHEAR_NM, EndShear};
use crate::bending::BendingLoads;
use crate::{BendingElement, End, RodLayout, RodMaterial};
use actin_mechanics::{Loads, Matrix3, State, Stiffness, Vector3, rotation};

/// Additional length for twist at a blocked end (nm).
///
/// A bond along a strand joins second neighbours. The twist of two gaps between monomers rotates
/// this bond. At a wall one bond spans only one gap and resists less. If only bonds along strands
/// resisted twist, the length would be half a rise (1.4 nm).
///
/// # Source
/// Mean filament between walls 25 to 151 nm apart, twisted by 10 to 120 deg per 74 nm in both
/// directions (`cargo xtask load-cases --ends`): torques agree within 5 % for 41 nm or more.
pub(crate) const END_TWIST_NM: f64 = 0.9;

/// Additional twist rigidity at a blocked end (pN nm^3), and twist (rad/nm) above which its torque
/// saturates.
///
/// In the interior, monomers rearrange under small twist; monomers at a wall cannot.
const FIRM: f64 = 22_000.0;
const FIRM_TWIST: f64 = 1.5e-3;

/// Distance over which both corrections decay linearly: two bonds along a strand (nm).
const REACH_NM: f64 = 2.0 * END_SHEAR_NM;

/// Bending element near a blocked end, with additional length for twist.
///
/// ```text
/// E = (l + a) U(k l / (l + a)) + f c^2 (sqrt(1 + (k / c)^2) - 1)
/// ```
///
/// The first term replaces `l U(k)`. `U` is the twist energy per length, `k` the twist relative to
/// rest, `l` the rest distance and `a` the additional length. `f` is the element's share of
/// [`FIRM`] times the factor of the twisting rigidity, `c` is [`FIRM_TWIST`]. The mean curvature of adjacent segments includes all of `k`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EndTwist {
    pub(crate) element: usize,
    frames: [usize; 2],
    /// Rest distance (nm).
    rest_distance: f64,
    /// Additional length (nm).
    added: f64,
}

/// Bending elements near blocked ends. `beyond` (nm) are the distances to the ends of the whole
/// rod.
pub(super) fn end_twists(
    layout: &RodLayout,
    ends: [EndShear; 2],
    beyond: [f64; 2],
) -> Vec<EndTwist> {
    let [at_start, at_end] = ends.map(|end| f64::from(u8::from(end == EndShear::Blocked)));
    let length = layout.length();
    // The first element starts at the wall, or at the middle of the first segment.
    let mut from = match layout.wall(End::Start) {
        Some(_) => 0.0,
        None => 0.5 * layout.end_length(End::Start),
    };
    let elements = layout.bending_chain().zip(layout.voronoi_lengths());
    let all = elements.enumerate().map(|(element, (frame, &own))| {
        let to = from + own;
        let by_start = added(beyond[0] + from, beyond[0] + to);
        let by_end = added(beyond[1] + length - to, beyond[1] + length - from);
        from = to;
        EndTwist {
            element,
            frames: [frame, frame + 1],
            rest_distance: own,
            added: at_start * by_start + at_end * by_end,
        }
    });
    all.filter(|one| one.added > 0.0).collect()
}

/// Additional length between two distances from a blocked end (nm).
fn added(from: f64, to: f64) -> f64 {
    let within = |s: f64| {
        let u = (s / REACH_NM).min(1.0);
        END_TWIST_NM * u * (2.0 - u)
    };
    within(to) - within(from)
}

impl EndTwist {
    pub(crate) fn factor(&self) -> f64 {
        self.rest_distance / (self.rest_distance + self.added)
    }

    /// Energy (pN nm) of the second term with two derivatives, at a twist (rad/nm) relative to
    /// rest.
    fn firm(&self, material: &RodMaterial, beyond: f64) -> [f64; 3] {
        let share = FIRM * material.twist_factor() * self.added / END_TWIST_NM;
        let root = (beyond / FIRM_TWIST).hypot(1.0);
        [
            share * FIRM_TWIST * FIRM_TWIST * (root - 1.0),
            share * beyond / root,
            share / root.powi(3),
        ]
    }

    pub(crate) fn joins(&self, frames: [usize; 2]) -> bool {
        self.frames == frames
    }

    fn turn(&self, state: &State) -> Vector3 {
        let [a, b] = self.frames.map(|frame| state.frames.orientation.get(frame));
        rotation::log(a.inverse() * b)
    }

    /// Twist relative to rest (rad/nm).
    fn beyond(&self, material: &RodMaterial, turn: Vector3) -> f64 {
        turn.z / self.rest_distance - material.rest_curvature().z
    }

    /// Correction to the energy of a regular element (pN nm).
    pub(crate) fn energy(&self, material: &RodMaterial, state: &State) -> f64 {
        let beyond = self.beyond(material, self.turn(state));
        let energy = |twist| material.twist_energy_density(twist);
        let [firm, ..] = self.firm(material, beyond);
        let length = self.rest_distance + self.added;
        length * energy(beyond * self.factor()) - self.rest_distance * energy(beyond) + firm
    }

    /// Correction to the torque of a regular element (pN nm).
    pub(crate) fn couple(&self, material: &RodMaterial, beyond: f64) -> f64 {
        let couple = |twist| material.twist_couple(twist);
        let [_, firm, _] = self.firm(material, beyond);
        couple(beyond * self.factor()) - couple(beyond) + firm / self.rest_distance
    }

    /// Derivative of the torque correction (pN nm^2).
    pub(crate) fn tangent(&self, material: &RodMaterial, beyond: f64) -> f64 {
        let tangent = |twist| material.twist_tangent(twist);
        let [.., firm] = self.firm(material, beyond);
        self.factor() * tangent(beyond * self.factor()) - tangent(beyond)
            + firm / self.rest_distance
    }

    pub(crate) fn add_loads(&self, material: &RodMaterial, state: &State, loads: &mut Loads) {
        let turn = self.turn(state);
        let couple = self.couple(material, self.beyond(material, turn));
        let bending = BendingLoads::of_couple(Vector3::z() * couple, turn);
        let [a, b] = self.frames;
        loads.torque.add(a, bending.first);
        loads.torque.add(b, bending.second);
    }

    pub(crate) fn add_stiffness(
        &self,
        material: &RodMaterial,
        state: &State,
        stiffness: &mut Stiffness,
    ) {
        let beyond = self.beyond(material, self.turn(state));
        let couple = Vector3::z() * self.couple(material, beyond);
        let about = Vector3::z() * self.tangent(material, beyond);
        let element = BendingElement {
            rest_distance: self.rest_distance,
        };
        let [a, b] = self.frames.map(|frame| state.frames.orientation.get(frame));
        element
            .stiffness_of(couple, Matrix3::from_diagonal(&about), (a, b))
            .push(self.frames, stiffness);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::BOTH;
    use crate::{
        EnergyGradient, Homogenised, RigidityFactors, SegmentCurvature, SegmentLaw, StraightRod,
        Walls,
    };
    use actin_mechanics::Interaction;
    use actin_mechanics::testing::loads_of;

    #[test]
    fn blocked_ends_add_their_length() {
        let total = |lengths: &[f64], ends| -> f64 {
            let layout = RodLayout::new(0, 1, lengths.to_vec(), BOTH).unwrap();
            let all = end_twists(&layout, ends, [0.0; 2]);
            all.iter().map(|one| one.added).sum()
        };
        for lengths in [
            vec![10.0; 6],
            vec![0.5; 120],
            vec![1.0, 9.0, 50.0],
            vec![60.0],
        ] {
            let both = total(&lengths, [EndShear::Blocked; 2]);
            assert!((both - 2.0 * END_TWIST_NM).abs() < 1e-12);
            let one = total(&lengths, [EndShear::Even, EndShear::Blocked]);
            assert!((one - END_TWIST_NM).abs() < 1e-12);
            let layout = RodLayout::new(0, 1, lengths.clone(), BOTH).unwrap();
            assert!(end_twists(&layout, [EndShear::Loose; 2], [0.0; 2]).is_empty());
        }
        let behind = RodLayout::new(0, 0, vec![1.0; 20], Walls::default()).unwrap();
        let whole = RodLayout::new(0, 1, vec![1.0; 24], BOTH).unwrap();
        let ends = [EndShear::Blocked, EndShear::Loose];
        let behind = end_twists(&behind, ends, [4.0, 0.0]);
        let whole = end_twists(&whole, ends, [0.0; 2]);
        assert!((behind[0].added - whole[5].added).abs() < 1e-15);
    }

    /// Rod of 80 nm between walls with uniform twist, including the additional lengths, and zero
    /// tension.
    fn twisted_between_walls(segments: usize, twist: f64) -> (State, EnergyGradient) {
        twisted_with(
            RodMaterial::homogenised(Homogenised::mean_filament()),
            segments,
            twist,
        )
    }

    fn twisted_with(material: RodMaterial, segments: usize, twist: f64) -> (State, EnergyGradient) {
        let mut state = State::default();
        let rod = StraightRod {
            walls: BOTH,
            ..StraightRod::uniform(segments, 80.0 / segments as f64)
        };
        let layout = rod.push(&mut state).unwrap();
        let curvature = SegmentCurvature::new(&layout, &[], &[]);
        let curvature = curvature.with_ends(&layout, [EndShear::Blocked; 2], [0.0; 2]);
        let mut turn = 0.0;
        let elements = layout.bending_chain().zip(layout.voronoi_lengths());
        for (frame, distance) in elements {
            let end = curvature.end_twist([frame, frame + 1]);
            turn += twist * distance / end.map_or(1.0, EndTwist::factor);
            let q = rotation::exp(Vector3::z() * turn);
            state.frames.orientation.set(frame + 1, q);
        }
        let form = Homogenised::mean_filament().form();
        let mut z = 0.0;
        for (k, i) in layout.points().skip(1).enumerate() {
            let natural = form.natural_stretch(curvature.mean(k, &state).z);
            z += layout.segment_lengths()[k] * (1.0 + natural);
            state.points.position.set(i, Vector3::z() * z);
        }
        let law = SegmentLaw::from_material(&material, None).unwrap();
        let rod = EnergyGradient::new(layout, material).with_extension(law, curvature);
        (state, rod)
    }

    #[test]
    fn couples_of_twist_alone_are_those_of_the_law() {
        for law in [
            Homogenised::mean_filament(),
            Homogenised::mean_filament_at_298_k(),
        ] {
            let material = RodMaterial::homogenised(law);
            for twist in [-0.04, -1e-3, 0.0, 2e-3, 0.03] {
                let expected = law.joint_couple(Vector3::z() * twist).z;
                let error = material.twist_couple(twist) - expected;
                assert!(
                    error.abs() <= 1e-12 * (1.0 + expected.abs()),
                    "{twist}: {error:e}"
                );
            }
        }
    }

    #[test]
    fn walls_add_length_that_twists() {
        let law = Homogenised::mean_filament();
        let kappa = Vector3::z() * -0.02;
        for segments in [1, 4, 40] {
            let (state, rod) = twisted_between_walls(segments, kappa.z);
            let ends = end_twists(rod.layout(), [EndShear::Blocked; 2], [0.0; 2]);
            let material = RodMaterial::homogenised(law);
            let firm = |end: &EndTwist| end.firm(&material, kappa.z / end.factor())[0];
            let firm: f64 = ends.iter().map(firm).sum();
            let expected = (80.0 + 2.0 * END_TWIST_NM) * law.joint_energy(kappa) + firm;
            assert!((rod.energy(&state) / expected - 1.0).abs() < 1e-12);
            let wall = rod.layout().bending_chain().start;
            let couple = loads_of(&rod, &state).torque.get(wall).z;
            let [_, firm, _] = ends[0].firm(&material, kappa.z / ends[0].factor());
            let expected = law.joint_couple(kappa).z + firm / ends[0].rest_distance;
            assert!((couple / expected - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn equal_factors_multiply_the_energy_of_rods_between_walls() {
        let material = RodMaterial::homogenised(Homogenised::mean_filament());
        let tenth = RigidityFactors {
            shear: 0.1,
            stretch: 0.1,
            bend: 0.1,
            twist: 0.1,
        };
        let softened = material.softened(&tenth).unwrap();
        for twist in [-0.02, 2e-3] {
            let energies = [material, softened].map(|material| {
                let (state, rod) = twisted_with(material, 8, twist);
                rod.energy(&state)
            });
            assert!(
                (energies[1] / energies[0] - 0.1).abs() < 1e-11,
                "{energies:?}"
            );
        }
    }
}
