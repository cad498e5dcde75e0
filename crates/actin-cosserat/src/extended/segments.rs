//! Energies, loads and stiffness of segments with coupling to curvature.

use super::curvature::AdjacentElement;
use super::law::{MeanCurvature, SegmentJet};
use super::{EndTwist, SegmentCurvature, SegmentLaw};
use crate::bending::BendingLoads;
use crate::shear::ShearLoads;
use crate::{RodLayout, RodMaterial, ShearElement};
use actin_mechanics::{
    Coordinates, Loads, Matrix3, State, Stiffness, UnitQuaternion, Vector3, rotation,
};

/// Segments of an extended rod, in place of its shear elements.
#[derive(Clone, Debug)]
pub(crate) struct ExtendedSegments {
    pub(crate) law: SegmentLaw,
    pub(crate) curvature: SegmentCurvature,
}

struct Segment<'a> {
    element: ShearElement,
    points: [usize; 2],
    frame: usize,
    q: UnitQuaternion,
    l: Vector3,
    curvature: MeanCurvature,
    around: &'a [AdjacentElement],
    factors: Vector3,
}

impl Segment<'_> {
    fn strain(&self) -> Vector3 {
        let strain = self.element.strain(self.q, self.l);
        strain.component_mul(&self.factors)
    }

    fn couple_on(&self, around: &AdjacentElement, couple: Vector3) -> Vector3 {
        self.element.rest_length * around.share / around.element.rest_distance * couple
    }
}

pub(crate) struct SegmentSurroundings {
    /// Rest length (nm).
    pub(crate) length: f64,
    pub(crate) strain: Vector3,
    pub(crate) curvature: MeanCurvature,
    pub(crate) has_two_sides: bool,
    /// Elements near blocked ends with their weights in the mean.
    ends: Vec<(EndTwist, f64)>,
}

impl SegmentSurroundings {
    /// Twist (rad/nm) relative to rest.
    fn beyond(&self, material: &RodMaterial) -> f64 {
        self.curvature.kappa.z - material.rest_curvature().z
    }

    /// Mean torque (pN nm) of the surrounding bending elements.
    pub(crate) fn bending_couple(&self, material: &RodMaterial) -> Vector3 {
        let mut couple = material.bending_couple(self.curvature.kappa);
        for (end, share) in &self.ends {
            couple.z += share * end.couple(material, self.beyond(material));
        }
        couple
    }

    /// Mean tangent (pN nm^2) of the surrounding bending elements.
    pub(crate) fn bending_tangent(&self, material: &RodMaterial) -> Matrix3 {
        let mut tangent = material.bending_tangent(self.curvature.kappa);
        for (end, share) in &self.ends {
            tangent[(2, 2)] += share * end.tangent(material, self.beyond(material));
        }
        tangent
    }
}

pub(crate) struct SideElement {
    /// 0 before the segment, 1 after it.
    pub(crate) side: usize,
    pub(crate) frames: [usize; 2],
    /// Weight of the torque of the mean curvature on the element's frames, per length of the
    /// segment.
    pub(crate) weight: f64,
}

impl ExtendedSegments {
    /// Returns `true` if neighbouring rods have no other rest curvature.
    pub(crate) fn is_straight(&self) -> bool {
        self.curvature.is_straight()
    }

    pub(crate) fn factors(&self, k: usize) -> Vector3 {
        let across = self.curvature.shear_factor(k);
        Vector3::new(across, across, 1.0)
    }

    pub(crate) fn side_elements(
        &self,
        k: usize,
        layout: &RodLayout,
    ) -> impl Iterator<Item = SideElement> {
        let frame = layout.frames().start + k;
        let length = layout.segment_lengths()[k];
        let around = self.curvature.adjacent_elements(k).iter();
        around.map(move |around| SideElement {
            side: usize::from(around.frames[0] == frame),
            frames: around.frames,
            weight: length * around.share / around.element.rest_distance,
        })
    }

    pub(crate) fn surroundings(
        &self,
        k: usize,
        layout: &RodLayout,
        state: &State,
    ) -> SegmentSurroundings {
        let segment = self.segment(k, layout, state);
        let mut sides = self.side_elements(k, layout).map(|beside| beside.side);
        let first = sides.next();
        SegmentSurroundings {
            length: segment.element.rest_length,
            strain: segment.strain(),
            curvature: segment.curvature,
            has_two_sides: sides.any(|side| Some(side) != first),
            ends: (segment.around.iter())
                .filter_map(|a| Some((*self.curvature.end_twist(a.frames)?, a.share)))
                .collect(),
        }
    }

    #[inline]
    fn segment(&self, k: usize, layout: &RodLayout, state: &State) -> Segment<'_> {
        let (i, frame) = (layout.points().start + k, layout.frames().start + k);
        let x = &state.points.position;
        Segment {
            element: ShearElement::segment(layout.segment_lengths()[k]),
            points: [i, i + 1],
            frame,
            q: state.frames.orientation.get(frame),
            l: x.get(i + 1) - x.get(i),
            curvature: MeanCurvature {
                kappa: self.curvature.mean(k, state),
                covered: self.curvature.covered(k),
            },
            around: self.curvature.adjacent_elements(k),
            factors: self.factors(k),
        }
    }

    pub(crate) fn write_energies(
        &self,
        (layout, material): (&RodLayout, &RodMaterial),
        state: &State,
        energies: &mut [f64],
    ) {
        for (k, energy) in energies.iter_mut().enumerate() {
            let segment = self.segment(k, layout, state);
            let density = self
                .law
                .energy(material, segment.strain(), segment.curvature);
            *energy = segment.element.rest_length * density;
        }
    }

    pub(crate) fn add_loads(
        &self,
        (layout, material): (&RodLayout, &RodMaterial),
        state: &State,
        loads: &mut Loads,
    ) {
        let q = &state.frames.orientation;
        for k in 0..layout.segments() {
            let segment = self.segment(k, layout, state);
            let (n, couple) = self
                .law
                .loads(material, segment.strain(), segment.curvature);
            let n = n.component_mul(&segment.factors);
            let axes = segment.q.to_rotation_matrix().into_inner();
            let shear = ShearLoads::of_force(n, axes, axes.tr_mul(&segment.l));
            loads.force.add(segment.points[0], shear.force);
            loads.force.add(segment.points[1], -shear.force);
            loads.torque.add(segment.frame, shear.torque);
            for around in segment.around {
                let [a, b] = around.frames;
                let theta = rotation::log(q.get(a).inverse() * q.get(b));
                let bending = BendingLoads::of_couple(segment.couple_on(around, couple), theta);
                loads.torque.add(a, bending.first);
                loads.torque.add(b, bending.second);
            }
        }
    }

    pub(crate) fn add_stiffness(
        &self,
        rod: (&RodLayout, &RodMaterial),
        state: &State,
        stiffness: &mut Stiffness,
    ) {
        for (segment, jet) in self.jets(rod, state) {
            push_stiffness(&segment, &jet, state, stiffness);
        }
    }

    /// As `add_stiffness`, with axial rotations coupled to each other and, with directors along the
    /// segments, to stretch.
    pub(crate) fn add_stiffness_without_spin(
        &self,
        rod: (&RodLayout, &RodMaterial),
        state: &State,
        stiffness: &mut Stiffness,
    ) {
        for (segment, jet) in self.jets(rod, state) {
            stiffness.extend_without_spin(true, |own| push_stiffness(&segment, &jet, state, own));
            push_twist_stretch(&segment, &jet, state, stiffness);
        }
    }

    fn jets<'a>(
        &'a self,
        (layout, material): (&'a RodLayout, &'a RodMaterial),
        state: &'a State,
    ) -> impl Iterator<Item = (Segment<'a>, SegmentJet)> {
        (0..layout.segments()).map(move |k| {
            let segment = self.segment(k, layout, state);
            let jet = self.law.jet(material, segment.strain(), segment.curvature);
            let jet = jet.of_scaled(segment.factors);
            (segment, jet)
        })
    }
}

fn push_stiffness(segment: &Segment, jet: &SegmentJet, state: &State, stiffness: &mut Stiffness) {
    let own = (segment.element).stiffness_of(jet.force, jet.by_strain, (segment.q, segment.l));
    own.push(segment.points, segment.frame, stiffness);
    push_curvature(segment, jet, state, stiffness);
}

/// Adds the coupling of axial rotations to stretch.
fn push_twist_stretch(
    segment: &Segment,
    jet: &SegmentJet,
    state: &State,
    stiffness: &mut Stiffness,
) {
    let axis = segment.q * Vector3::z() * jet.mixed[(2, 2)];
    for around in segment.around {
        for (frame, slope) in curvature_slopes(around, state) {
            for (point, sign) in segment.points.into_iter().zip([-1.0, 1.0]) {
                let mut block = Matrix3::zeros();
                block.set_column(2, &(axis * (sign * slope[(2, 2)])));
                stiffness.push(Coordinates::Point(point), frame, block);
            }
        }
    }
}

type Slope = (Coordinates, Matrix3);

/// Derivatives of the strain (1/nm and 1).
fn strain_slopes(segment: &Segment) -> [Slope; 3] {
    let axes = segment.q.to_rotation_matrix().into_inner();
    let per_length = segment.element.rest_length.recip();
    let by_vector = axes.transpose() * per_length;
    let by_turn = axes.tr_mul(&segment.l).cross_matrix() * per_length;
    [
        (Coordinates::Point(segment.points[0]), -by_vector),
        (Coordinates::Point(segment.points[1]), by_vector),
        (Coordinates::Frame(segment.frame), by_turn),
    ]
}

/// Derivatives of one element's part of the mean curvature (1/nm).
fn curvature_slopes(around: &AdjacentElement, state: &State) -> [Slope; 2] {
    let [a, b] = around
        .frames
        .map(|frame| state.frames.orientation.get(frame));
    let slopes = around.element.curvature_slopes(a, b);
    [0, 1].map(|k| {
        let frame = Coordinates::Frame(around.frames[k]);
        (frame, slopes[k] * around.share)
    })
}

fn push_curvature(segment: &Segment, jet: &SegmentJet, state: &State, stiffness: &mut Stiffness) {
    let length = segment.element.rest_length;
    let q = &state.frames.orientation;
    let strain = strain_slopes(segment);
    for (j, around) in segment.around.iter().enumerate() {
        let frames = around.frames;
        let weight = length * around.share / around.element.rest_distance;
        let tangent = jet.by_curvature * (weight * around.share);
        let couple = segment.couple_on(around, jet.couple);
        let orientations = (q.get(frames[0]), q.get(frames[1]));
        let bending = (around.element).stiffness_of(couple, tangent, orientations);
        bending.push(frames, stiffness);
        let slopes = curvature_slopes(around, state);
        push_product(&strain, jet.mixed * length, &slopes, stiffness);
        for other in &segment.around[j + 1..] {
            let others = curvature_slopes(other, state);
            push_product(&slopes, jet.by_curvature * length, &others, stiffness);
        }
    }
}

/// Adds `a^T M b` for all pairs of bodies, and its transpose on the diagonal.
fn push_product(a: &[Slope], m: Matrix3, b: &[Slope], stiffness: &mut Stiffness) {
    for (first, left) in a {
        for (second, right) in b {
            let block = left.tr_mul(&(m * right));
            if first == second {
                stiffness.push(*first, *first, block + block.transpose());
            } else {
                stiffness.push(*first, *second, block);
            }
        }
    }
}
