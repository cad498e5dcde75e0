//! Joints of a rod with a potential: `U(kappa)`, the potential without shear, at the natural length
//! for the twist.
//!
//! Joints use each angle between neighbouring segments, so `U` resists rotations of alternating
//! sign, which cancel in the mean curvature of segments (`segment.rs`).

use super::{Homogenised, PotentialJet, SixVector};
use crate::fast::Law;
use actin_mechanics::wide::Scalar;
use actin_mechanics::{Matrix3, Vector3};

impl Homogenised {
    /// Energy per length (pN) of a joint at curvature `kappa` (rad/nm).
    pub(crate) fn joint_energy(&self, kappa: Vector3) -> f64 {
        self.energy_density(&self.unsheared(kappa))
    }

    /// Torque (pN nm), the gradient of `joint_energy`.
    pub fn joint_couple(&self, kappa: Vector3) -> Vector3 {
        self.unrolled.bending(Scalar, kappa.into()).into()
    }

    /// Derivative of the torque (pN nm^2), symmetric.
    pub fn joint_tangent(&self, kappa: Vector3) -> Matrix3 {
        self.joint_jet(kappa).1
    }

    pub(super) fn joint_jet(&self, kappa: Vector3) -> (Vector3, Matrix3) {
        let PotentialJet { loads, tangent, .. } = self.jet(&self.unsheared(kappa));
        let [_, slope, bend] = self.natural_jet(kappa.z);
        // The length depends on the twist.
        let mut couple: Vector3 = loads.fixed_rows::<3>(0).into();
        couple.z += slope * loads[5];
        let mut of_curvature: Matrix3 = tangent.fixed_view::<3, 3>(0, 0).into();
        let with_length: Vector3 = tangent.fixed_view::<3, 1>(0, 5).into();
        let crossed = slope * with_length * Vector3::z().transpose();
        of_curvature += crossed + crossed.transpose();
        of_curvature[(2, 2)] += slope * slope * tangent[(5, 5)] + bend * loads[5];
        (couple, of_curvature)
    }

    fn unsheared(&self, kappa: Vector3) -> SixVector {
        let natural = self.natural_stretch(kappa.z);
        SixVector::new(kappa.x, kappa.y, kappa.z, 0.0, 0.0, natural)
    }
}
