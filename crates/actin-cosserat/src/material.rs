//! The constitutive law: from strains to forces, couples, their tangents and energies per length.
//!
//! The rod and whatever is joined to it ask the material only through these six functions.

use crate::{ParameterError, Rigidities};
use actin_mechanics::{Matrix3, Vector3};

/// The material of a rod: constant rigidities, validated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodMaterial {
    rigidities: Rigidities,
}

impl RodMaterial {
    /// The material with the given rigidities.
    ///
    /// # Errors
    /// A rigidity that is not positive and finite.
    pub fn new(rigidities: Rigidities) -> Result<Self, ParameterError> {
        rigidities.validate()?;
        Ok(Self { rigidities })
    }

    /// The rigidities.
    pub fn rigidities(&self) -> &Rigidities {
        &self.rigidities
    }

    /// Force in body axes (pN) at shear strain `sigma`: `S sigma`.
    #[inline]
    pub fn shear_force(&self, sigma: Vector3) -> Vector3 {
        self.rigidities.shear.component_mul(&sigma)
    }

    /// Energy per rest length (pN) at shear strain `sigma`: `sigma^T S sigma / 2`, of which
    /// [`shear_force`](Self::shear_force) is the gradient.
    #[inline]
    pub fn shear_energy_density(&self, sigma: Vector3) -> f64 {
        0.5 * sigma.dot(&self.shear_force(sigma))
    }

    /// Tangent (pN) at shear strain `sigma`: the derivative of [`shear_force`](Self::shear_force)
    /// with respect to `sigma`, symmetric. For constant rigidities it is `S` at every strain.
    #[inline]
    pub fn shear_tangent(&self, _sigma: Vector3) -> Matrix3 {
        Matrix3::from_diagonal(&self.rigidities.shear)
    }

    /// Couple in body axes (pN nm) at curvature `kappa` (rad/nm): `B kappa`.
    #[inline]
    pub fn bending_couple(&self, kappa: Vector3) -> Vector3 {
        self.rigidities.bend.component_mul(&kappa)
    }

    /// Tangent (pN nm^2) at curvature `kappa` (rad/nm): the derivative of
    /// [`bending_couple`](Self::bending_couple) with respect to `kappa`, symmetric. For constant
    /// rigidities it is `B` at every curvature.
    #[inline]
    pub fn bending_tangent(&self, _kappa: Vector3) -> Matrix3 {
        Matrix3::from_diagonal(&self.rigidities.bend)
    }

    /// Energy per rest length (pN) at curvature `kappa` (rad/nm): `kappa^T B kappa / 2`, of which
    /// [`bending_couple`](Self::bending_couple) is the gradient.
    #[inline]
    pub fn bending_energy_density(&self, kappa: Vector3) -> f64 {
        0.5 * kappa.dot(&self.bending_couple(kappa))
    }
}
