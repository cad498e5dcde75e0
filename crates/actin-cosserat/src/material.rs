//! The constitutive law: from strains to forces, couples, their tangents and energies per length.
//!
//! The rod and whatever is joined to it ask the material only through these six functions. The
//! laws it is made of are in `law/`; what couples the strain of a segment to the curvature around
//! it is in `extended/`.

use crate::{BendLaw, CubicShear, ParameterError, Rigidities, StretchLaw, TwistLaw};
use actin_mechanics::{Matrix3, Vector3};
use nalgebra::Vector2;

/// The material of a rod: how it resists shear, stretch, bending and twist, validated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodMaterial {
    shear: CubicShear,
    stretch: StretchLaw,
    bend: BendLaw,
    twist: TwistLaw,
}

impl RodMaterial {
    /// The material with constant rigidities.
    ///
    /// # Errors
    /// A rigidity that is not positive and finite.
    pub fn new(rigidities: Rigidities) -> Result<Self, ParameterError> {
        rigidities.validate()?;
        let Rigidities { shear, bend } = rigidities;
        Ok(Self {
            shear: CubicShear {
                linear: [shear.x, shear.y],
                cubic: 0.0,
            },
            stretch: StretchLaw::Constant(shear.z),
            bend: BendLaw::Constant([bend.x, bend.y]),
            twist: TwistLaw::Constant(bend.z),
        })
    }

    /// The same with another law of twist.
    ///
    /// ```
    /// use actin_cosserat::{Rigidities, RodMaterial, TanhTwist, TwistLaw};
    /// use actin_mechanics::Vector3;
    /// let published = TwistLaw::Tanh(TanhTwist::published());
    /// let material = RodMaterial::new(Rigidities::table4())?.with_twist(published)?;
    /// // A right-handed turn of 10 degrees over 75.5 nm meets a tenth of the constant 1.3e4.
    /// let couple = material.bending_couple(Vector3::z() * 0.0023).z;
    /// assert!(couple < 0.1 * 1.3e4 * 0.0023);
    /// # Ok::<(), actin_cosserat::ParameterError>(())
    /// ```
    ///
    /// # Errors
    /// What [`TwistLaw::validate`] refuses.
    pub fn with_twist(self, twist: TwistLaw) -> Result<Self, ParameterError> {
        twist.validate()?;
        Ok(Self { twist, ..self })
    }

    /// The same with another law of bending.
    ///
    /// # Errors
    /// What [`BendLaw::validate`] refuses.
    pub fn with_bend(self, bend: BendLaw) -> Result<Self, ParameterError> {
        bend.validate()?;
        Ok(Self { bend, ..self })
    }

    /// The same with another law of stretch.
    ///
    /// # Errors
    /// What [`StretchLaw::validate`] refuses.
    pub fn with_stretch(self, stretch: StretchLaw) -> Result<Self, ParameterError> {
        stretch.validate()?;
        Ok(Self { stretch, ..self })
    }

    /// The same with another law of shear.
    ///
    /// # Errors
    /// What [`CubicShear::validate`] refuses.
    pub fn with_shear(self, shear: CubicShear) -> Result<Self, ParameterError> {
        shear.validate()?;
        Ok(Self { shear, ..self })
    }

    /// The law of bending.
    pub fn bend(&self) -> &BendLaw {
        &self.bend
    }

    /// The law of twist.
    pub fn twist(&self) -> &TwistLaw {
        &self.twist
    }

    /// The law of stretch.
    pub fn stretch(&self) -> &StretchLaw {
        &self.stretch
    }

    /// The law of shear.
    pub fn shear(&self) -> &CubicShear {
        &self.shear
    }

    /// Force in body axes (pN) at shear strain `sigma`.
    #[inline]
    pub fn shear_force(&self, sigma: Vector3) -> Vector3 {
        let across = self.shear.force(sigma.xy());
        let across = Vector3::new(across.x, across.y, 0.0);
        if self.stretches_along_d3() {
            return across + Vector3::z() * self.stretch.force(sigma.z);
        }
        let segment = Vector3::z() + sigma;
        let length = segment.norm();
        across + segment * (self.stretch.force(length - 1.0) / length)
    }

    /// Energy per rest length (pN) at shear strain `sigma`, of which
    /// [`shear_force`](Self::shear_force) is the gradient.
    #[inline]
    pub fn shear_energy_density(&self, sigma: Vector3) -> f64 {
        let strain = if self.stretches_along_d3() {
            sigma.z
        } else {
            (Vector3::z() + sigma).norm() - 1.0
        };
        self.shear.energy_density(sigma.xy()) + self.stretch.energy_density(strain)
    }

    /// Tangent (pN) at shear strain `sigma`: the derivative of [`shear_force`](Self::shear_force)
    /// with respect to `sigma`, symmetric.
    #[inline]
    pub fn shear_tangent(&self, sigma: Vector3) -> Matrix3 {
        let mut tangent = Matrix3::zeros();
        let across = self.shear.tangent(Vector2::new(sigma.x, sigma.y));
        tangent.fixed_view_mut::<2, 2>(0, 0).copy_from(&across);
        if self.stretches_along_d3() {
            tangent[(2, 2)] = self.stretch.tangent(sigma.z);
            return tangent;
        }
        let segment = Vector3::z() + sigma;
        let length = segment.norm();
        let along = segment * segment.transpose() / (length * length);
        let strain = length - 1.0;
        tangent
            + self.stretch.tangent(strain) * along
            + self.stretch.force(strain) / length * (Matrix3::identity() - along)
    }

    /// Whether stretch is the component of the strain along d3, as it is where shear is linear, or
    /// the change of the segment's length, `|e3 + sigma| - 1`.
    ///
    /// Tension along d3 pulls a segment across as soon as it shears, more than a shearing rigidity
    /// below the tension holds it back: a rod whose shear is cubic would give way under any tension.
    /// Tension along the segment holds it straight, as a string.
    #[inline]
    fn stretches_along_d3(&self) -> bool {
        self.shear.cubic == 0.0
    }

    /// Couple in body axes (pN nm) at curvature `kappa` (rad/nm).
    #[inline]
    pub fn bending_couple(&self, kappa: Vector3) -> Vector3 {
        let mut couple = self.bend.couple(kappa);
        couple.z += self.twist.couple(kappa.z);
        couple
    }

    /// Tangent (pN nm^2) at curvature `kappa` (rad/nm): the derivative of
    /// [`bending_couple`](Self::bending_couple) with respect to `kappa`, symmetric.
    #[inline]
    pub fn bending_tangent(&self, kappa: Vector3) -> Matrix3 {
        let mut tangent = self.bend.tangent(kappa);
        tangent[(2, 2)] += self.twist.tangent(kappa.z);
        tangent
    }

    /// Energy per rest length (pN) at curvature `kappa` (rad/nm), of which
    /// [`bending_couple`](Self::bending_couple) is the gradient.
    #[inline]
    pub fn bending_energy_density(&self, kappa: Vector3) -> f64 {
        self.bend.energy_density(kappa) + self.twist.energy_density(kappa.z)
    }
}
