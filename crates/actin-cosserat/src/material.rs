//! Constitutive law: forces, torques, tangents and energies as functions of strains.

use crate::homogenised::STRAIGHT;
use crate::{
    BendLaw, CubicShear, Homogenised, Rigidities, RigidityFactors, RodParameterError, StrainLaws,
    StretchLaw, TwistLaw,
};
use actin_mechanics::{Matrix3, Vector3};

/// Validated material of a rod: laws of shear, stretch, bending and twist, and a rest curvature.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodMaterial {
    kind: Kind,
    rest_curvature: Vector3,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Laws(StrainLaws),
    Potential(&'static Homogenised),
}

impl RodMaterial {
    /// Creates a material with constant rigidities.
    ///
    /// # Errors
    /// If a rigidity is not positive and finite.
    pub fn new(rigidities: Rigidities) -> Result<Self, RodParameterError> {
        rigidities.validate()?;
        Ok(Self::straight(Kind::Laws(StrainLaws::constant(rigidities))))
    }

    fn straight(kind: Kind) -> Self {
        Self {
            kind,
            rest_curvature: Vector3::zeros(),
        }
    }

    /// Sets the rest curvature, for example of an arc or a helix (rad/nm, body axes: two components
    /// of bending, one of twist).
    ///
    /// ```
    /// use actin_cosserat::{Rigidities, RodMaterial};
    /// use actin_mechanics::Vector3;
    /// let arc = Vector3::x() / 100.0;
    /// let material = RodMaterial::new(Rigidities::table4())?.with_rest_curvature(arc)?;
    /// assert_eq!(material.bending_couple(arc), Vector3::zeros());
    /// // Held straight, it exerts B1 / 100 nm.
    /// assert_eq!(material.bending_couple(Vector3::zeros()).x, -390.0);
    /// # Ok::<(), actin_cosserat::RodParameterError>(())
    /// ```
    ///
    /// # Errors
    /// If a component is not finite.
    pub fn with_rest_curvature(self, kappa: Vector3) -> Result<Self, RodParameterError> {
        for value in &kappa {
            RodParameterError::check_finite("rest_curvature_per_nm", *value)?;
        }
        Ok(Self {
            rest_curvature: kappa,
            ..self
        })
    }

    /// Rest curvature (rad/nm, body axes).
    #[inline]
    pub fn rest_curvature(&self) -> Vector3 {
        self.rest_curvature
    }

    /// Multiplies the rigidities of all laws by the given factors.
    ///
    /// # Errors
    /// If a factor is not positive and finite.
    pub fn softened(self, factors: &RigidityFactors) -> Result<Self, RodParameterError> {
        if *factors == RigidityFactors::default() {
            return Ok(self);
        }
        factors.validate()?;
        Ok(match self.kind {
            Kind::Laws(laws) => self.with_laws(laws.times(factors)),
            Kind::Potential(law) => Self {
                kind: Kind::Potential(law.softened(factors)),
                ..self
            },
        })
    }

    /// Creates the material of a potential, such as [`Homogenised::mean_filament`].
    ///
    /// The loads of a segment depend on the mean curvature around it. Functions of a single strain
    /// assume that the other strains are zero and the length is the rest length.
    pub fn homogenised(law: &'static Homogenised) -> Self {
        Self::straight(Kind::Potential(law))
    }

    /// Replaces the law of twist.
    ///
    /// ```
    /// use actin_cosserat::{Rigidities, RodMaterial, TanhTwist, TwistLaw};
    /// use actin_mechanics::Vector3;
    /// let published = TwistLaw::Tanh(TanhTwist::published());
    /// let material = RodMaterial::new(Rigidities::table4())?.with_twist(published)?;
    /// // A right-handed turn of 10 degrees over 75.5 nm: less than a tenth of the couple with the
    /// // constant rigidity 1.3e4 pN nm^2.
    /// let couple = material.bending_couple(Vector3::z() * 0.0023).z;
    /// assert!(couple < 0.1 * 1.3e4 * 0.0023);
    /// # Ok::<(), actin_cosserat::RodParameterError>(())
    /// ```
    ///
    /// # Errors
    /// If `TwistLaw::validate` fails, or if the material is a potential.
    pub fn with_twist(self, twist: TwistLaw) -> Result<Self, RodParameterError> {
        twist.validate()?;
        let laws = self.replaceable("twist")?;
        Ok(self.with_laws(StrainLaws { twist, ..laws }))
    }

    /// Replaces the law of bending.
    ///
    /// # Errors
    /// If `BendLaw::validate` fails, or if the material is a potential.
    pub fn with_bend(self, bend: BendLaw) -> Result<Self, RodParameterError> {
        bend.validate()?;
        let laws = self.replaceable("bend")?;
        Ok(self.with_laws(StrainLaws { bend, ..laws }))
    }

    /// Replaces the law of stretch.
    ///
    /// # Errors
    /// If `StretchLaw::validate` fails, or if the material is a potential.
    pub fn with_stretch(self, stretch: StretchLaw) -> Result<Self, RodParameterError> {
        stretch.validate()?;
        let laws = self.replaceable("tension")?;
        Ok(self.with_laws(StrainLaws { stretch, ..laws }))
    }

    /// Replaces the law of shear.
    ///
    /// # Errors
    /// If `CubicShear::validate` fails, or if the material is a potential.
    pub fn with_shear(self, shear: CubicShear) -> Result<Self, RodParameterError> {
        shear.validate()?;
        let laws = self.replaceable("shear")?;
        Ok(self.with_laws(StrainLaws { shear, ..laws }))
    }

    fn with_laws(self, laws: StrainLaws) -> Self {
        Self {
            kind: Kind::Laws(laws),
            ..self
        }
    }

    fn replaceable(self, key: &'static str) -> Result<StrainLaws, RodParameterError> {
        match self.kind {
            Kind::Laws(laws) => Ok(laws),
            Kind::Potential(_) => Err(RodParameterError {
                key,
                value: f64::NAN,
                rule: "omitted: a potential has a law of every strain",
            }),
        }
    }

    #[inline]
    pub(crate) fn kind(&self) -> &Kind {
        &self.kind
    }

    /// Laws of the strains, or `None` for a potential.
    pub fn laws(&self) -> Option<&StrainLaws> {
        match &self.kind {
            Kind::Laws(laws) => Some(laws),
            Kind::Potential(_) => None,
        }
    }

    /// Returns `true` for straight rods with constant, axisymmetric rigidities, or with a potential.
    pub(crate) fn is_axisymmetric(&self) -> bool {
        let rest = self.rest_curvature;
        let is_straight = rest.x == 0.0 && rest.y == 0.0;
        is_straight && self.laws().is_none_or(StrainLaws::are_axisymmetric)
    }

    /// Potential of all strains, or `None`.
    pub fn potential(&self) -> Option<&'static Homogenised> {
        match self.kind {
            Kind::Laws(_) => None,
            Kind::Potential(law) => Some(law),
        }
    }

    /// Force (pN, body axes) at shear strain `sigma`.
    #[inline]
    pub fn shear_force(&self, sigma: Vector3) -> Vector3 {
        match &self.kind {
            Kind::Laws(laws) => laws.shear_force_beyond(sigma, 0.0),
            Kind::Potential(law) => law.segment_loads(sigma, STRAIGHT).0,
        }
    }

    /// Energy per rest length (pN) at shear strain `sigma`.
    #[inline]
    pub(crate) fn shear_energy_density(&self, sigma: Vector3) -> f64 {
        match &self.kind {
            Kind::Laws(laws) => laws.shear_energy_beyond(sigma, 0.0),
            Kind::Potential(law) => law.segment_energy(sigma, STRAIGHT),
        }
    }

    /// Derivative of [`shear_force`](Self::shear_force) with respect to `sigma` (pN), symmetric.
    #[inline]
    pub fn shear_tangent(&self, sigma: Vector3) -> Matrix3 {
        match &self.kind {
            Kind::Laws(laws) => laws.shear_tangent_beyond(sigma, 0.0),
            Kind::Potential(law) => law.segment_jet(sigma, STRAIGHT).by_strain,
        }
    }

    /// Torque (pN nm, body axes) at curvature `kappa` (rad/nm).
    #[inline]
    pub fn bending_couple(&self, kappa: Vector3) -> Vector3 {
        let kappa = kappa - self.rest_curvature;
        match &self.kind {
            Kind::Laws(laws) => laws.bending_couple(kappa),
            Kind::Potential(law) => law.joint_couple(kappa),
        }
    }

    /// Derivative of [`bending_couple`](Self::bending_couple) with respect to `kappa` (pN nm^2),
    /// symmetric.
    #[inline]
    pub fn bending_tangent(&self, kappa: Vector3) -> Matrix3 {
        let kappa = kappa - self.rest_curvature;
        match &self.kind {
            Kind::Laws(laws) => laws.bending_tangent(kappa),
            Kind::Potential(law) => law.joint_tangent(kappa),
        }
    }

    /// Energy per rest length (pN) at curvature `kappa` (rad/nm).
    #[inline]
    pub(crate) fn bending_energy_density(&self, kappa: Vector3) -> f64 {
        let kappa = kappa - self.rest_curvature;
        match &self.kind {
            Kind::Laws(laws) => laws.bending_energy_density(kappa),
            Kind::Potential(law) => law.joint_energy(kappa),
        }
    }

    /// Factor of the twisting rigidity of a potential relative to unaltered rods; 1 for other laws.
    pub(crate) fn twist_factor(&self) -> f64 {
        match self.kind {
            Kind::Laws(_) => 1.0,
            Kind::Potential(law) => law.twist_factor(),
        }
    }

    /// Energy per length (pN) at a twist (rad/nm) relative to rest, without bending.
    pub(crate) fn twist_energy_density(&self, twist: f64) -> f64 {
        self.bending_energy_density(self.rest_curvature + Vector3::z() * twist)
    }

    /// Derivative of the twist energy (pN nm).
    #[inline]
    pub(crate) fn twist_couple(&self, twist: f64) -> f64 {
        match &self.kind {
            Kind::Laws(laws) => laws.bending_couple(Vector3::z() * twist).z,
            Kind::Potential(law) => law.unrolled().twisting(twist),
        }
    }

    /// Second derivative of the twist energy (pN nm^2).
    pub(crate) fn twist_tangent(&self, twist: f64) -> f64 {
        let kappa = self.rest_curvature + Vector3::z() * twist;
        self.bending_tangent(kappa)[(2, 2)]
    }
}
