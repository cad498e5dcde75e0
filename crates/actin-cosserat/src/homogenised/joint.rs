//! Joints of a rod with a potential: `U(kappa)`, the potential without shear, at the natural length
//! for the twist.
//!
//! Joints use each angle between neighbouring segments, so `U` resists rotations of alternating
//! sign, which cancel in the mean curvature of segments (`segment.rs`).

use super::polynomial::{bounded_twist, polynomial};
use super::terms::{CURVATURE, bounded_square, root};
use super::{Homogenised, SixVector, Term};
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

    /// Torque (pN nm) and its derivative: all terms of extension and shear vanish at the natural
    /// length.
    pub(super) fn joint_jet(&self, kappa: Vector3) -> (Vector3, Matrix3) {
        let of_twist = self.twist_jet(kappa.z);
        let scales: Vector3 = self.scales.fixed_rows::<3>(0).into();
        let kappa = kappa.component_mul(&scales);
        let (a, k) = (kappa.xy().norm_squared(), kappa.z);
        let t = bounded_twist(k);
        let by_twist = |term| polynomial(self.coefficients(term), t);
        let mut by_a = [self.coefficients(Term::AnyBend)[0], 0.0];
        let mut by_k = [0.0; 2];
        let mut mixed = 0.0;
        let bent = [
            (Term::Bend, bounded_square(a, CURVATURE)),
            (Term::BendRoot, root(a)),
        ];
        for (term, [value, slope, bend]) in bent {
            let p = by_twist(term);
            by_a = [by_a[0] + p[0] * slope, by_a[1] + p[0] * bend];
            by_k = [by_k[0] + p[1] * value, by_k[1] + p[2] * value];
            mixed += p[1] * slope;
        }
        let gradient = Vector3::new(2.0 * kappa.x, 2.0 * kappa.y, 0.0);
        let mut couple = by_a[0] * gradient;
        couple.z = by_k[0];
        let with_twist = (mixed * gradient) * Vector3::z().transpose();
        let mut tangent = by_a[1] * gradient * gradient.transpose();
        tangent += with_twist + with_twist.transpose();
        tangent += Matrix3::from_diagonal(&Vector3::new(2.0 * by_a[0], 2.0 * by_a[0], by_k[1]));
        couple.component_mul_assign(&scales);
        tangent.component_mul_assign(&(scales * scales.transpose()));
        couple.z += of_twist[1];
        tangent[(2, 2)] += of_twist[2];
        (couple, tangent)
    }

    fn unsheared(&self, kappa: Vector3) -> SixVector {
        let natural = self.natural_stretch(kappa.z);
        SixVector::new(kappa.x, kappa.y, kappa.z, 0.0, 0.0, natural)
    }
}
