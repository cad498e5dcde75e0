//! The loads of a rod with constant rigidities, several elements at a time.
//!
//! # What it does
//! The same as the scalar path of [`EnergyGradient`](crate::EnergyGradient), which stays its
//! reference: the loads of [`ShearElement`](crate::ShearElement) and
//! [`BendingElement`](crate::BendingElement) at force `S sigma` and couple `B kappa`. Rods with any
//! other law take the scalar path. The choice falls when the interaction is built, so that no loop
//! asks for the kind of a material. Energies and second derivatives are not in the loop of a
//! motion and stay scalar.
//!
//! # How
//! One element per lane, as `actin_mechanics::wide` explains. Elements of a rod follow one another
//! in the arrays of the state, so a group of elements, of their first and of their second bodies
//! are each a contiguous piece of these arrays, the latter one body further along.
//!
//! An element acts on two neighbouring bodies. A loop therefore goes over the *bodies*: what an
//! element does to its first body stands in the right lane; what it does to its second is moved up
//! one lane ([`ShiftedUp`](actin_mechanics::wide::ShiftedUp)). There is one body more than there
//! are elements; the element of the last body does not exist and has no effect.
//!
//! - Shear (`kernel.rs`, `add_shear`): with `Q` the matrix of a segment's frame, `y = Q^T l` and
//!   `n = S (y / |lhat| - e3)`, the force `Q n` acts on the first node, its negative on the second,
//!   and the torque `y x n` on the frame.
//! - Bending (`add_bending`): with `theta = log(Qa^T Qb)` from the quaternions and
//!   `m = B theta / Dhat`, the torques are `even + odd` and `odd - even`, where
//!   `odd = theta x m / 2` and `even = m + c theta x (theta x m)`.
//!
//! # What it costs
//! Per segment about 60 operations for shear (22 of them the matrix) and 100 for bending (20 for the
//! relative quaternion, 45 for two polynomials, 35 for the couples); no root, no quotient (rest
//! lengths are stored inverted), no call. What bounds it is the number of these operations, not
//! memory: a thousand segments still lie in the second-level cache.

mod kernel;

use crate::{BendLaw, RodLayout, RodMaterial, StretchLaw, TwistLaw};
use actin_mechanics::{Loads, State, Vector3, wide};
use kernel::AddLoads;

/// A rod's constant rigidities divided by its rest lengths.
#[derive(Clone, Debug)]
pub(crate) struct ConstantRod {
    /// S1, S2, S3 (pN).
    shear: Vector3,
    /// B1, B2, B3 (pN nm^2).
    bend: Vector3,
    /// 1 / rest length of each segment (1/nm).
    inverse_lengths: Vec<f64>,
    /// 1 / rest distance of each bending element (1/nm).
    inverse_distances: Vec<f64>,
}

impl ConstantRod {
    /// What the loop needs; `None` of a material whose rigidities are not constant.
    pub(crate) fn new(layout: &RodLayout, material: &RodMaterial) -> Option<Self> {
        let (BendLaw::Constant([b1, b2]), TwistLaw::Constant(b3), StretchLaw::Constant(s3)) =
            (material.bend(), material.twist(), material.stretch())
        else {
            return None;
        };
        let shear = material.shear();
        let inverse = |lengths: &[f64]| lengths.iter().map(|length| length.recip()).collect();
        (shear.cubic == 0.0).then(|| Self {
            shear: Vector3::new(shear.linear[0], shear.linear[1], *s3),
            bend: Vector3::new(*b1, *b2, *b3),
            inverse_lengths: inverse(layout.segment_lengths()),
            inverse_distances: inverse(layout.voronoi_lengths()),
        })
    }

    /// Adds the loads of all elements.
    pub(crate) fn add_loads(&self, layout: &RodLayout, state: &State, loads: &mut Loads) {
        wide::dispatch(AddLoads {
            rod: self,
            layout,
            state,
            loads,
        });
    }
}

#[cfg(test)]
mod tests;
