//! What the joints of a rod take of the potential: `U(kappa)`, its value where a rod of this curvature is free
//! of shear and as long as the straight rod of this twist without force.
//!
//! Joints see each turn between neighbouring segments, segments the mean of those around them
//! (`segment.rs`). `U` at the joints resists turns that alternate from joint to joint, which no mean sees.

use super::{Homogenised, PotentialJet, SixVector};
use crate::fast::Law;
use actin_mechanics::wide::Scalar;
use actin_mechanics::{Matrix3, Vector3};

impl Homogenised {
    /// Energy per length (pN) of a joint at curvature `kappa` (rad/nm).
    pub fn joint_energy(&self, kappa: Vector3) -> f64 {
        self.energy_density(&self.unsheared(kappa))
    }

    /// Couple (pN nm), the gradient of [`joint_energy`](Self::joint_energy).
    pub fn joint_couple(&self, kappa: Vector3) -> Vector3 {
        self.unrolled.bending(Scalar, kappa.into()).into()
    }

    /// Its derivative (pN nm^2), symmetric.
    pub fn joint_tangent(&self, kappa: Vector3) -> Matrix3 {
        self.joint_jet(kappa).1
    }

    /// Both at once.
    pub(super) fn joint_jet(&self, kappa: Vector3) -> (Vector3, Matrix3) {
        let PotentialJet { loads, tangent, .. } = self.jet(&self.unsheared(kappa));
        let [_, slope, bend] = self.form.natural_jet(kappa.z);
        // The length follows the twist.
        let mut couple: Vector3 = loads.fixed_rows::<3>(0).into();
        couple.z += slope * loads[5];
        let mut of_curvature: Matrix3 = tangent.fixed_view::<3, 3>(0, 0).into();
        let with_length: Vector3 = tangent.fixed_view::<3, 1>(0, 5).into();
        let crossed = slope * with_length * Vector3::z().transpose();
        of_curvature += crossed + crossed.transpose();
        of_curvature[(2, 2)] += slope * slope * tangent[(5, 5)] + bend * loads[5];
        (couple, of_curvature)
    }

    /// No shear, and the natural length of this twist.
    fn unsheared(&self, kappa: Vector3) -> SixVector {
        let natural = self.form.natural_stretch(kappa.z);
        SixVector::new(kappa.x, kappa.y, kappa.z, 0.0, 0.0, natural)
    }
}
