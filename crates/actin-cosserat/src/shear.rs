//! One shear element: what resists a vector that leaves its rest place in a frame.
//!
//! The rod and whatever is joined to it use the same element.

use crate::RodMaterial;
use actin_mechanics::{Coordinates, Matrix3, Stiffness, UnitQuaternion, Vector3};
use std::ops::Mul;

/// A vector `l` between two points that has a rest length and a rest direction in a frame.
///
/// Its strain is `sigma = Q^T l / |lhat| - d`, in axes of the frame `Q`; its energy
/// `E = |lhat| W(sigma)`, with `W` the material's energy per length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearElement {
    /// Rest length `|lhat|` (nm).
    pub rest_length: f64,
    /// Unit vector `d` along which `l` lies at rest, in axes of the frame.
    pub rest_direction: Vector3,
}

/// Loads of a shear element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearLoads {
    /// Force on the first point (pN, lab frame); the second has minus this.
    pub force: Vector3,
    /// Torque on the frame (pN nm, body frame).
    pub torque: Vector3,
}

/// Second derivatives of a shear element's energy with respect to its vector `l` (lab frame) and
/// to a turn `Q exp(phi)` of its frame, at `phi = 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearStiffness {
    /// `d^2 E / dl dl` (pN/nm), symmetric.
    pub vector: Matrix3,
    /// `d^2 E / dl dphi` (pN): rows belong to `l`.
    pub mixed: Matrix3,
    /// `d^2 E / dphi dphi` (pN nm), symmetric.
    pub frame: Matrix3,
}

impl ShearStiffness {
    /// Adds the blocks of an element whose vector leads from the first point to the second.
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
    /// The loads at force `n` in the axes of a frame (columns), where the vector is `body`.
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
    /// A segment of a rod: at rest along body axis d3.
    #[inline]
    pub fn segment(rest_length: f64) -> Self {
        Self {
            rest_length,
            rest_direction: Vector3::z(),
        }
    }

    /// Shear strain of the lab vector `l` in the frame `q`: `Q^T l / |lhat| - d`.
    ///
    /// For a segment the third component is the extension.
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

    /// Loads, minus the gradient of the energy: with `n = dW/dsigma`, the force on the first
    /// point is `Q n` and the torque on the frame `Q^T l x n`.
    #[inline]
    pub fn loads(&self, material: &RodMaterial, q: UnitQuaternion, l: Vector3) -> ShearLoads {
        let axes = q.to_rotation_matrix().into_inner();
        let body = axes.tr_mul(&l);
        let sigma = body * self.rest_length.recip() - self.rest_direction;
        ShearLoads::of_force(material.shear_force(sigma), axes, body)
    }

    /// Second derivatives of the energy, geometric part included.
    ///
    /// With `y = Q^T l`, `n = dW/dsigma` and `A = (d^2 W/dsigma^2) / |lhat|` they are `Q A Q^T`,
    /// `Q (A [y]x - [n]x)` and `-[y]x A [y]x + (n y^T + y n^T) / 2 - (n . y) I`.
    ///
    /// ```
    /// use actin_cosserat::{Rigidities, RodMaterial, ShearElement};
    /// use actin_mechanics::{UnitQuaternion, Vector3};
    /// let material = RodMaterial::new(Rigidities::table4())?;
    /// let along_z = (UnitQuaternion::identity(), Vector3::z() * 10.0);
    /// let stiffness = ShearElement::segment(10.0).stiffness(&material, along_z.0, along_z.1);
    /// // At rest: S3 / 10 nm against stretch, S1 times 10 nm against turning the frame alone.
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

    /// The same for given force `n` (pN) and tangent (pN), both in body axes.
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
