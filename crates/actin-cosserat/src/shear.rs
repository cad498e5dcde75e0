//! Shear element between two points and a frame, used by rods and by the joints to other parts.

use crate::RodMaterial;
use actin_mechanics::{Coordinates, Matrix3, Stiffness, UnitQuaternion, Vector3};
use std::ops::Mul;

/// Vector `l` between two points with a rest length and a rest direction in a frame.
///
/// ```text
/// sigma = Q^T l / |lhat| - d      (axes of the frame)
/// E     = |lhat| W(sigma)         (pN nm)
/// ```
///
/// `W` is the material's energy per length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearElement {
    /// Rest length `|lhat|` (nm).
    pub rest_length: f64,
    /// Unit vector `d` of the rest direction (axes of the frame).
    pub rest_direction: Vector3,
}

/// Loads of a shear element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearLoads {
    /// Force on the first point (pN, lab frame), opposite to the force on the second point.
    pub force: Vector3,
    /// Torque on the frame (pN nm, body frame).
    pub torque: Vector3,
}

/// Second derivatives of the energy with respect to the vector `l` (lab frame) and the rotation
/// `Q exp(phi)` of the frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearStiffness {
    /// `d^2 E / dl dl` (pN/nm), symmetric.
    pub vector: Matrix3,
    /// `d^2 E / dl dphi` (pN), with rows for `l`.
    pub mixed: Matrix3,
    /// `d^2 E / dphi dphi` (pN nm), symmetric.
    pub frame: Matrix3,
}

impl ShearStiffness {
    /// Adds the blocks of an element between two points.
    pub fn push(&self, points: [usize; 2], frame: usize, stiffness: &mut Stiffness) {
        let [first, second] = points.map(Coordinates::Point);
        let frame = Coordinates::Frame(frame);
        stiffness.push(first, first, self.vector);
        stiffness.push(second, second, self.vector);
        stiffness.push(first, second, -self.vector);
        stiffness.push(first, frame, -self.mixed);
        stiffness.push(second, frame, self.mixed);
        stiffness.push(frame, frame, self.frame);
    }
}

impl ShearLoads {
    /// Loads for the force `n` (axes of the frame) and the vector `body` (axes of the frame).
    #[inline]
    pub(crate) fn of_force(n: Vector3, axes: Matrix3, body: Vector3) -> Self {
        Self {
            force: axes * n,
            torque: body.cross(&n),
        }
    }
}

impl Mul<f64> for ShearStiffness {
    type Output = Self;

    fn mul(self, weight: f64) -> Self {
        Self {
            vector: self.vector * weight,
            mixed: self.mixed * weight,
            frame: self.frame * weight,
        }
    }
}

impl ShearElement {
    /// Segment of a rod, with rest direction d3.
    #[inline]
    pub fn segment(rest_length: f64) -> Self {
        Self {
            rest_length,
            rest_direction: Vector3::z(),
        }
    }

    /// Strain `Q^T l / |lhat| - d` of the lab vector `l` in the frame `q`. The third component is
    /// the stretch of a segment.
    ///
    /// ```
    /// use actin_cosserat::ShearElement;
    /// use actin_mechanics::{UnitQuaternion, Vector3};
    /// let segment = ShearElement::segment(10.0);
    /// let sigma = segment.strain(UnitQuaternion::identity(), Vector3::new(1.0, 0.0, 10.5));
    /// assert!((sigma - Vector3::new(0.1, 0.0, 0.05)).norm() < 1e-15);
    /// ```
    #[inline]
    pub fn strain(&self, q: UnitQuaternion, l: Vector3) -> Vector3 {
        q.inverse_transform_vector(&l) / self.rest_length - self.rest_direction
    }

    /// Energy (pN nm).
    #[inline]
    pub fn energy(&self, material: &RodMaterial, q: UnitQuaternion, l: Vector3) -> f64 {
        self.rest_length * material.shear_energy_density(self.strain(q, l))
    }

    /// Force `Q n` on the first point and torque `Q^T l x n` on the frame, with `n = dW/dsigma`.
    #[inline]
    pub fn loads(&self, material: &RodMaterial, q: UnitQuaternion, l: Vector3) -> ShearLoads {
        let axes = q.to_rotation_matrix().into_inner();
        let body = axes.tr_mul(&l);
        let sigma = body * self.rest_length.recip() - self.rest_direction;
        ShearLoads::of_force(material.shear_force(sigma), axes, body)
    }

    /// Second derivatives of the energy, including the geometric stiffness.
    ///
    /// ```text
    /// y = Q^T l,  n = dW/dsigma,  A = (d^2 W/dsigma^2) / |lhat|
    /// K_ll     = Q A Q^T
    /// K_lphi   = Q (A [y]x - [n]x)
    /// K_phiphi = -[y]x A [y]x + (n y^T + y n^T) / 2 - (n . y) I
    /// ```
    ///
    /// ```
    /// use actin_cosserat::{Rigidities, RodMaterial, ShearElement};
    /// use actin_mechanics::{UnitQuaternion, Vector3};
    /// let material = RodMaterial::new(Rigidities::table4())?;
    /// let along_z = (UnitQuaternion::identity(), Vector3::z() * 10.0);
    /// let stiffness = ShearElement::segment(10.0).stiffness(&material, along_z.0, along_z.1);
    /// // At rest: S3 / 10 nm for stretch, S1 times 10 nm for rotation of the frame.
    /// assert!((stiffness.vector[(2, 2)] - 3.4e3).abs() < 1e-9);
    /// assert!((stiffness.frame[(0, 0)] - 1.6e5).abs() < 1e-9);
    /// # Ok::<(), actin_cosserat::RodParameterError>(())
    /// ```
    pub fn stiffness(
        &self,
        material: &RodMaterial,
        q: UnitQuaternion,
        l: Vector3,
    ) -> ShearStiffness {
        let sigma = self.strain(q, l);
        self.stiffness_of(
            material.shear_force(sigma),
            material.shear_tangent(sigma),
            (q, l),
        )
    }

    /// Stiffness for the force `n` (pN) and the tangent (pN), both in body axes.
    pub(crate) fn stiffness_of(
        &self,
        n: Vector3,
        tangent: Matrix3,
        (q, l): (UnitQuaternion, Vector3),
    ) -> ShearStiffness {
        let axes = q.to_rotation_matrix().into_inner();
        let y = axes.tr_mul(&l);
        let a = tangent / self.rest_length;
        let turned = y.cross_matrix();
        let a_turned = a * turned;
        let vector = axes * a * axes.transpose();
        let half = turned.tr_mul(&a_turned) * 0.5 + 0.5 * n * y.transpose();
        ShearStiffness {
            vector: 0.5 * (vector + vector.transpose()),
            mixed: axes * (a_turned - n.cross_matrix()),
            frame: half + half.transpose() - Matrix3::from_diagonal_element(n.dot(&y)),
        }
    }
}
