//! Positions, axes and velocities of the cross-sections of a filament, for every resolution.

use crate::shape::axis::{Axis, interpolated};
use crate::shape::from_rest;
use crate::{Assembly, BodyKind};
use actin_mechanics::{State, UnitQuaternion, Vector3, rotation};
use nalgebra::{DMatrix, DVector};

/// Number of monomers on either side that determine a cross-section. The average removes the
/// alternation of strands.
const MONOMERS_BESIDE: usize = 4;

#[derive(Clone, Copy, Debug)]
pub(super) struct CrossSection {
    pub(super) place: Vector3,
    /// Axes (body to lab).
    pub(super) axes: UnitQuaternion,
    /// Velocity of its centre (nm/ns).
    pub(super) velocity: Vector3,
    /// Angular velocity (rad/ns, lab frame).
    pub(super) angular_velocity: Vector3,
}

type Known = (f64, Vector3);

/// Cross-sections of a filament interpolated from its bodies.
#[derive(Debug)]
pub(super) struct Field {
    axis: Axis,
    /// Velocities of nodes and of the axis at monomers, by arc length.
    velocities: Vec<Known>,
    /// Angular velocities of segments and monomers, by arc length.
    angular_velocities: Vec<Known>,
    /// Cross-sections at monomers, by arc length.
    monomers: Vec<(f64, CrossSection)>,
}

impl Field {
    pub(super) fn new(assembly: &Assembly, state: &State) -> Self {
        let monomers = monomers(assembly, state);
        let nodes = (0..assembly.points.len())
            .filter(|&i| assembly.points[i].kind == BodyKind::Node)
            .map(|i| (assembly.points[i].s_nm, state.points.velocity.get(i)));
        let segments = (0..assembly.frames.len())
            .filter(|&i| assembly.frames[i].kind == BodyKind::Segment)
            .map(|i| (assembly.frames[i].s_nm, angular_velocity(state, i)));
        let of_monomers = monomers.iter();
        let velocities = nodes.chain(of_monomers.clone().map(|m| (m.0, m.1.velocity)));
        let turns = segments.chain(of_monomers.map(|m| (m.0, m.1.angular_velocity)));
        Self {
            axis: Axis::new(assembly, state),
            velocities: in_order(velocities.collect()),
            angular_velocities: in_order(turns.collect()),
            monomers,
        }
    }

    /// Cross-section of a rod at an arc length (nm), interpolated between nodes and segments.
    pub(super) fn of_rod(&self, s_nm: f64) -> CrossSection {
        let (place, axes) = self.axis.at(s_nm);
        CrossSection {
            place,
            axes,
            velocity: interpolated(&self.velocities, s_nm),
            angular_velocity: interpolated(&self.angular_velocities, s_nm),
        }
    }

    /// Cross-section of monomers at an arc length (nm): a quadratic fit to the positions of the
    /// nearest monomers on the axis, and linear fits to their rotations and velocities.
    ///
    /// # Panics
    /// If there are no monomers.
    pub(super) fn of_monomers(&self, s_nm: f64) -> CrossSection {
        let after = self.monomers.partition_point(|m| m.0 < s_nm);
        let count = (2 * MONOMERS_BESIDE).min(self.monomers.len());
        let first = after.saturating_sub(MONOMERS_BESIDE);
        let first = first.min(self.monomers.len() - count);
        let near = &self.monomers[first..first + count];
        let reference = near[count / 2].1.axes;
        let fit = |degree, of: &dyn Fn(&CrossSection) -> Vector3| {
            let known: Vec<Known> = near.iter().map(|m| (m.0 - s_nm, of(&m.1))).collect();
            at_zero(&known, degree)
        };
        let turn = fit(1, &|m| rotation::log(reference.inverse() * m.axes));
        CrossSection {
            place: fit(2, &|m| m.place),
            axes: reference * rotation::exp(turn),
            velocity: fit(1, &|m| m.velocity),
            angular_velocity: fit(1, &|m| m.angular_velocity),
        }
    }
}

pub(super) fn angular_velocity(state: &State, i: usize) -> Vector3 {
    let momentum = state.frames.angular_momentum.get(i);
    state.frames.orientation.get(i) * state.frames.angular_velocity(i, momentum)
}

fn monomers(assembly: &Assembly, state: &State) -> Vec<(f64, CrossSection)> {
    let of = |i: usize, frame: usize| {
        let place = assembly.centre_line_nm(state, i);
        let turn = angular_velocity(state, frame);
        let arm = place - state.points.position.get(i);
        let section = CrossSection {
            place,
            axes: from_rest(assembly, state, frame),
            velocity: state.points.velocity.get(i) + turn.cross(&arm),
            angular_velocity: turn,
        };
        (assembly.points[i].s_nm, section)
    };
    let points = assembly.points.iter().enumerate();
    points
        .filter(|(_, point)| point.kind == BodyKind::Monomer)
        .filter_map(|(i, point)| Some(of(i, point.frame?)))
        .collect()
}

fn in_order(mut known: Vec<Known>) -> Vec<Known> {
    known.sort_by(|a, b| a.0.total_cmp(&b.0));
    known
}

/// Value at zero of the least-squares polynomial.
fn at_zero(known: &[Known], degree: usize) -> Vector3 {
    let degree = degree.min(known.len() - 1);
    let scale = known.iter().fold(0.0, |most: f64, k| most.max(k.0.abs()));
    let powers = DMatrix::from_fn(known.len(), degree + 1, |row, power| {
        (0..power).fold(1.0, |product, _| product * known[row].0 / scale)
    });
    // Weights of the constant coefficient, equal for all three components.
    let normal = (powers.transpose() * &powers)
        .cholesky()
        .expect("monomers have distinct arc lengths");
    let mut constant = DVector::zeros(degree + 1);
    constant[0] = 1.0;
    let weights = powers * normal.solve(&constant);
    let weighted = known.iter().zip(weights.iter());
    weighted.map(|((_, value), weight)| value * *weight).sum()
}
