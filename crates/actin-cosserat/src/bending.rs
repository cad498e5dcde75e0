//! Bending element between two frames, used by rods and by the joints to other parts.

use crate::RodMaterial;
use actin_mechanics::{Coordinates, Matrix3, Stiffness, UnitQuaternion, Vector3, rotation};
use std::ops::Mul;

/// Two frames at a distance along a rod, parallel at rest.
///
/// ```text
/// theta = log(Qa^T Qb)
/// kappa = theta / Dhat        (rad/nm)
/// E     = Dhat U(kappa)       (pN nm)
/// ```
///
/// `U` is the material's energy per length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BendingElement {
    /// Rest distance `Dhat` of the two frames along the rod (nm).
    pub rest_distance: f64,
}

/// Loads of a bending element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BendingLoads {
    /// Torque on the first frame (pN nm, its body frame).
    pub first: Vector3,
    /// Torque on the second frame (pN nm, its body frame).
    pub second: Vector3,
}

/// Second derivatives of the energy (pN nm) with respect to the rotations `Qa exp(phi_a)` and
/// `Qb exp(phi_b)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BendingStiffness {
    /// `d^2 E / dphi_a dphi_a`, symmetric.
    pub first: Matrix3,
    /// `d^2 E / dphi_a dphi_b`, with rows for the first frame.
    pub mixed: Matrix3,
    /// `d^2 E / dphi_b dphi_b`, symmetric.
    pub second: Matrix3,
}

impl BendingStiffness {
    /// Adds the blocks of an element between two frames.
    pub fn push(&self, frames: [usize; 2], stiffness: &mut Stiffness) {
        let [first, second] = frames.map(Coordinates::Frame);
        stiffness.push(first, first, self.first);
        stiffness.push(first, second, self.mixed);
        stiffness.push(second, second, self.second);
    }

    /// Transforms the blocks to rotations of the bodies `Qa oa^T` and `Qb ob^T`, given the offsets
    /// of the frames.
    #[must_use]
    pub fn in_bodies(&self, [oa, ob]: [UnitQuaternion; 2]) -> Self {
        let [oa, ob] = [oa, ob].map(|o| o.to_rotation_matrix().into_inner());
        Self {
            first: oa * self.first * oa.transpose(),
            mixed: oa * self.mixed * ob.transpose(),
            second: ob * self.second * ob.transpose(),
        }
    }
}

impl BendingLoads {
    /// Loads for the torque `m = dU/dkappa` and the rotation vector `theta` (body axes).
    #[inline]
    pub(crate) fn of_couple(m: Vector3, theta: Vector3) -> Self {
        // J_l^-T m and J_r^-T m differ in the sign of one term; see `actin_mechanics::rotation`.
        let cross = theta.cross(&m);
        let c = rotation::inverse_jacobian_coefficient(theta.norm_squared());
        let even = m + c * theta.cross(&cross);
        BendingLoads {
            first: even + 0.5 * cross,
            second: 0.5 * cross - even,
        }
    }
}

impl Mul<f64> for BendingStiffness {
    type Output = Self;

    fn mul(self, weight: f64) -> Self {
        Self {
            first: self.first * weight,
            mixed: self.mixed * weight,
            second: self.second * weight,
        }
    }
}

impl BendingElement {
    /// Curvature `log(Qa^T Qb) / Dhat` (rad/nm), equal in the axes of both frames. Positive
    /// `kappa_3` is right-handed twist.
    ///
    /// ```
    /// use actin_cosserat::BendingElement;
    /// use actin_mechanics::{Matrix3, UnitQuaternion, Vector3, rotation};
    /// let element = BendingElement { rest_distance: 10.0 };
    /// let twisted = rotation::exp(Vector3::new(0.0, 0.0, 0.2));
    /// let kappa = element.curvature(UnitQuaternion::identity(), twisted);
    /// assert!((kappa - Vector3::new(0.0, 0.0, 0.02)).norm() < 1e-16);
    /// ```
    #[inline]
    pub fn curvature(&self, qa: UnitQuaternion, qb: UnitQuaternion) -> Vector3 {
        rotation::log(qa.inverse() * qb) / self.rest_distance
    }

    /// Derivatives `-J_l(theta)^-1 / Dhat` and `J_r(theta)^-1 / Dhat` of the curvature with respect
    /// to rotations of the two frames (1/nm).
    pub(crate) fn curvature_slopes(self, qa: UnitQuaternion, qb: UnitQuaternion) -> [Matrix3; 2] {
        let theta = rotation::log(qa.inverse() * qb);
        let right = rotation::right_jacobian_inverse(theta) / self.rest_distance;
        // J_l(theta) = J_r(-theta), the transpose of J_r(theta).
        [-right.transpose(), right]
    }

    /// Energy (pN nm).
    #[inline]
    pub fn energy(&self, material: &RodMaterial, qa: UnitQuaternion, qb: UnitQuaternion) -> f64 {
        self.rest_distance * material.bending_energy_density(self.curvature(qa, qb))
    }

    /// Torques `J_l(theta)^-T m` on the first and `-J_r(theta)^-T m` on the second frame, with
    /// `m = dU/dkappa`.
    #[inline]
    pub fn loads(
        &self,
        material: &RodMaterial,
        qa: UnitQuaternion,
        qb: UnitQuaternion,
    ) -> BendingLoads {
        let theta = rotation::log(qa.inverse() * qb);
        BendingLoads::of_couple(
            material.bending_couple(theta * self.rest_distance.recip()),
            theta,
        )
    }

    /// Second derivatives of the energy, including the geometric stiffness.
    ///
    /// ```text
    /// m = dU/dkappa,  C = d^2 U/dkappa^2,  J = J_r(theta)^-1,  D = d(J_r(theta)^-T m) / d theta
    /// K_bb = K = J^T (C / Dhat) J + sym(D J)
    /// K_aa = R K R^T,  K_ab = R ([J^T m]x / 2 - K),  R = Qa^T Qb
    /// ```
    ///
    /// Discontinuous at an angle of pi, like the loads.
    ///
    /// ```
    /// use actin_cosserat::{BendingElement, Rigidities, RodMaterial};
    /// use actin_mechanics::UnitQuaternion;
    /// let element = BendingElement { rest_distance: 10.0 };
    /// let material = RodMaterial::new(Rigidities::table4())?;
    /// let parallel = UnitQuaternion::identity();
    /// // B3 = 1.3e4 over 10 nm
    /// let stiffness = element.stiffness(&material, parallel, parallel);
    /// assert!((stiffness.second[(2, 2)] - 1300.0).abs() < 1e-12);
    /// assert!((stiffness.mixed[(2, 2)] + 1300.0).abs() < 1e-12);
    /// # Ok::<(), actin_cosserat::RodParameterError>(())
    /// ```
    pub fn stiffness(
        &self,
        material: &RodMaterial,
        qa: UnitQuaternion,
        qb: UnitQuaternion,
    ) -> BendingStiffness {
        let kappa = self.curvature(qa, qb);
        self.stiffness_of(
            material.bending_couple(kappa),
            material.bending_tangent(kappa),
            (qa, qb),
        )
    }

    /// Stiffness for the torque `m = dU/dkappa` (pN nm) and the tangent `d^2 U/dkappa^2` (pN nm^2).
    pub(crate) fn stiffness_of(
        self,
        m: Vector3,
        tangent: Matrix3,
        (qa, qb): (UnitQuaternion, UnitQuaternion),
    ) -> BendingStiffness {
        let relative = qa.inverse() * qb;
        let theta = rotation::log(relative);
        let jacobian = rotation::right_jacobian_inverse(theta);
        let tangent = tangent / self.rest_distance;
        let geometric = rotation::right_jacobian_inverse_transpose_slope(theta, m) * jacobian;
        let k = jacobian.tr_mul(&(tangent * jacobian)) + geometric;
        // The mean with the transpose also makes the material part symmetric to the last bit.
        let second = 0.5 * (k + k.transpose());
        let r = relative.to_rotation_matrix().into_inner();
        let first = r * second * r.transpose();
        let couple = jacobian.tr_mul(&m);
        BendingStiffness {
            first: 0.5 * (first + first.transpose()),
            mixed: r * (0.5 * couple.cross_matrix() - second),
            second,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rigidities;

    /// Angle (rad) about (1, 2, -2)/3 and `u A u`, `u M v`, `v B v` of the first, mixed and second
    /// block (pN nm).
    ///
    /// `u` = (1/2, -1/4, 1), `v` = (-3/4, 1, 1/2), rigidities (3.9e4, 2.7e4, 1.3e4) over 10 nm.
    /// Differences of the energy in 60-digit arithmetic.
    #[rustfmt::skip]
    const REFERENCE: [(f64, [f64; 3]); 12] = [
        (0.0, [2_443.75, 1_487.5, 5_218.75]),
        (1e-06, [2_443.749_116_666_524, 1_487.498_595_833_375_7, 5_218.748_516_666_415_5]),
        (0.001, [2_442.866_524_068_834_7, 1_486.095_875_876_161_5, 5_217.266_415_649_227]),
        (0.1, [2_354.043_533_162_648_6, 1_347.574_489_667_28, 5_068.044_996_853_653]),
        (0.5, [1_973.492_390_518_921_4, 804.572_374_169_238_4, 4_431.809_160_899_274_5]),
        (1.0, [1_478.972_497_445_626, 197.126_223_117_930_2, 3_625.793_449_418_838]),
        (1.4, [1_107.535_705_349_862, -190.959_495_024_612_58, 3_044.124_013_067_856_6]),
        (1.6, [944.277_158_784_597_9, -338.338_450_408_629_17, 2_797.107_098_445_703]),
        (2.0, [698.048_745_907_15, -507.093_635_599_651, 2_440.110_349_620_047]),
        (2.5, [644.744_994_591_223_4, -390.179_452_163_898_36, 2_381.069_469_924_475]),
        (3.0, [1_102.945_252_805_440_8, 283.877_228_205_779_5, 3_011.800_848_981_885]),
        (3.125, [1_342.467_647_882_420_1, 576.158_467_981_114_3, 3_324.746_412_306_752]),
    ];

    fn material(bend: Vector3) -> RodMaterial {
        let rigidities = Rigidities::table4();
        RodMaterial::new(Rigidities { bend, ..rigidities }).unwrap()
    }

    #[test]
    fn stiffness_is_accurate_to_round_off_at_every_angle() {
        let material = material(Vector3::new(3.9e4, 2.7e4, 1.3e4));
        let element = BendingElement {
            rest_distance: 10.0,
        };
        let axis = Vector3::new(1.0, 2.0, -2.0) / 3.0;
        let (u, v) = (Vector3::new(0.5, -0.25, 1.0), Vector3::new(-0.75, 1.0, 0.5));
        for (angle, expected) in REFERENCE {
            let qb = rotation::exp(axis * angle);
            let stiffness = element.stiffness(&material, UnitQuaternion::identity(), qb);
            let BendingStiffness {
                first,
                mixed,
                second,
            } = stiffness;
            let actual = [
                u.dot(&(first * u)),
                u.dot(&(mixed * v)),
                v.dot(&(second * v)),
            ];
            for (actual, expected) in actual.iter().zip(expected) {
                // Relative to the largest entry, 3.9e3.
                let error = (actual - expected).abs() / 3.9e3;
                assert!(error < 1e-14, "angle {angle}: {error:e}");
            }
        }
    }

    #[test]
    fn equal_rigidities_have_the_stiffness_of_the_squared_angle() {
        let material = material(Vector3::from_element(10.0));
        let element = BendingElement {
            rest_distance: 10.0,
        };
        let axis = Vector3::new(2.0, -1.0, 2.0) / 3.0;
        let qa = rotation::exp(Vector3::new(-0.3, 0.8, 0.1));
        for exponent in -90..=4 {
            let angle = 10f64.powf(f64::from(exponent) / 10.0);
            let stiffness = element.stiffness(&material, qa, qa * rotation::exp(axis * angle));
            let along = axis * axis.transpose();
            let across = (0.5 * angle) / (0.5 * angle).tan();
            let expected = along + (Matrix3::identity() - along) * across;
            for block in [stiffness.first, stiffness.second] {
                assert!((block - expected).amax() < 5e-15, "angle {angle}: {block}");
            }
        }
    }
}
