//! The constitutive law: from strains to forces, couples, their tangents and energies per length.
//!
//! The rod and whatever is joined to it ask the material only through these six functions. The
//! laws it is made of are in `law/`; what couples the strain of a segment to the curvature around
//! it is in `extended/`.

use crate::{BendLaw, CubicShear, Rigidities, RodParameterError, StretchLaw, TwistLaw};
use actin_mechanics::{Matrix3, Vector3};

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
    pub fn new(rigidities: Rigidities) -> Result<Self, RodParameterError> {
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
    /// # Ok::<(), actin_cosserat::RodParameterError>(())
    /// ```
    ///
    /// # Errors
    /// What [`TwistLaw::validate`] refuses.
    pub fn with_twist(self, twist: TwistLaw) -> Result<Self, RodParameterError> {
        twist.validate()?;
        Ok(Self { twist, ..self })
    }

    /// The same with another law of bending.
    ///
    /// # Errors
    /// What [`BendLaw::validate`] refuses.
    pub fn with_bend(self, bend: BendLaw) -> Result<Self, RodParameterError> {
        bend.validate()?;
        Ok(Self { bend, ..self })
    }

    /// The same with another law of stretch.
    ///
    /// # Errors
    /// What [`StretchLaw::validate`] refuses.
    pub fn with_stretch(self, stretch: StretchLaw) -> Result<Self, RodParameterError> {
        stretch.validate()?;
        Ok(Self { stretch, ..self })
    }

    /// The same with another law of shear.
    ///
    /// # Errors
    /// What [`CubicShear::validate`] refuses.
    pub fn with_shear(self, shear: CubicShear) -> Result<Self, RodParameterError> {
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
        self.shear_force_beyond(sigma, 0.0)
    }

    /// Energy per rest length (pN) at shear strain `sigma`, of which
    /// [`shear_force`](Self::shear_force) is the gradient.
    #[inline]
    pub fn shear_energy_density(&self, sigma: Vector3) -> f64 {
        self.shear_energy_beyond(sigma, 0.0)
    }

    /// Tangent (pN) at shear strain `sigma`: the derivative of [`shear_force`](Self::shear_force)
    /// with respect to `sigma`, symmetric.
    #[inline]
    pub fn shear_tangent(&self, sigma: Vector3) -> Matrix3 {
        self.shear_tangent_beyond(sigma, 0.0)
    }

    /// The force where a strain of `natural` in length costs nothing.
    #[inline]
    pub(crate) fn shear_force_beyond(&self, sigma: Vector3, natural: f64) -> Vector3 {
        let across = self.shear.force(sigma.xy());
        let (strain, along, _) = self.length_strain(sigma);
        Vector3::new(across.x, across.y, 0.0) + along * self.stretch.force(strain - natural)
    }

    /// Its energy per length (pN).
    #[inline]
    pub(crate) fn shear_energy_beyond(&self, sigma: Vector3, natural: f64) -> f64 {
        let (strain, ..) = self.length_strain(sigma);
        self.shear.energy_density(sigma.xy()) + self.stretch.energy_density(strain - natural)
    }

    /// Its derivative (pN), symmetric.
    #[inline]
    pub(crate) fn shear_tangent_beyond(&self, sigma: Vector3, natural: f64) -> Matrix3 {
        let (strain, along, bend) = self.length_strain(sigma);
        let outer = along * along.transpose();
        let strain = strain - natural;
        let mut tangent = self.stretch.tangent(strain) * outer
            + bend * self.stretch.force(strain) * (Matrix3::identity() - outer);
        let mut corner = tangent.fixed_view_mut::<2, 2>(0, 0);
        corner += self.shear.tangent(sigma.xy());
        tangent
    }

    /// The strain of length, its gradient by `sigma`, and the factor of its second derivative,
    /// which is across the gradient.
    ///
    /// Where shear is linear it is the component along d3. Where shear is cubic it is the change
    /// of the segment's length, `|e3 + sigma| - 1`: tension along d3 pulls a segment across as
    /// soon as it shears, more than a shearing rigidity below the tension holds it back, so that a
    /// rod that does not resist small shear would give way under any tension. Tension along the
    /// segment holds it straight, as a string.
    #[inline]
    pub(crate) fn length_strain(&self, sigma: Vector3) -> (f64, Vector3, f64) {
        if self.shear.cubic == 0.0 {
            return (sigma.z, Vector3::z(), 0.0);
        }
        let segment = Vector3::z() + sigma;
        let length = segment.norm();
        // |segment| - 1, without its cancellation at small strain.
        let strain = (2.0 * sigma.z + sigma.norm_squared()) / (length + 1.0);
        (strain, segment / length, length.recip())
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
