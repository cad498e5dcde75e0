//! The constitutive law: from strains to forces, couples, their tangents and energies per length.
//!
//! The rod and whatever is joined to it ask the material only through these six functions. A law for
//! each strain is in `strain_laws.rs`, one potential for all in `homogenised/`; what couples the
//! strain of a segment to the curvature around it is in `extended/`.

use crate::homogenised::STRAIGHT;
use crate::{
    BendLaw, CubicShear, Homogenised, Rigidities, RigidityFactors, RodKey, RodParameterError,
    StrainLaws, StretchLaw, TwistLaw,
};
use actin_mechanics::{Matrix3, Vector3};

/// The material of a rod: how it resists shear, stretch, bending and twist, validated.
///
/// Its laws see a curvature less that at rest ([`with_rest_curvature`](Self::with_rest_curvature)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodMaterial {
    kind: Kind,
    rest_curvature: Vector3,
}

/// What a material is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    /// A law for each strain.
    Laws(StrainLaws),
    /// One potential for all.
    Potential(&'static Homogenised),
}

impl RodMaterial {
    /// The material with constant rigidities.
    ///
    /// # Errors
    /// A rigidity that is not positive and finite.
    pub fn new(rigidities: Rigidities) -> Result<Self, RodParameterError> {
        rigidities.validate()?;
        Ok(Self::straight(Kind::Laws(StrainLaws::constant(rigidities))))
    }

    /// The material that is straight at rest.
    fn straight(kind: Kind) -> Self {
        Self {
            kind,
            rest_curvature: Vector3::zeros(),
        }
    }

    /// The same at rest where a rod has the curvature `kappa` (rad/nm, body axes: two of bending, one of
    /// twist) everywhere: an arc, or with twist a helix.
    ///
    /// ```
    /// use actin_cosserat::{Rigidities, RodMaterial};
    /// use actin_mechanics::Vector3;
    /// let arc = Vector3::x() / 100.0;
    /// let material = RodMaterial::new(Rigidities::table4())?.with_rest_curvature(arc)?;
    /// assert_eq!(material.bending_couple(arc), Vector3::zeros());
    /// // Held straight it bears B1 / 100 nm.
    /// assert_eq!(material.bending_couple(Vector3::zeros()).x, -390.0);
    /// # Ok::<(), actin_cosserat::RodParameterError>(())
    /// ```
    ///
    /// # Errors
    /// A component that is not finite.
    pub fn with_rest_curvature(self, kappa: Vector3) -> Result<Self, RodParameterError> {
        for value in &kappa {
            RodParameterError::unless_finite(RodKey::RestCurvature, *value)?;
        }
        Ok(Self {
            rest_curvature: kappa,
            ..self
        })
    }

    /// Curvature at rest (rad/nm, body axes).
    #[inline]
    pub fn rest_curvature(&self) -> Vector3 {
        self.rest_curvature
    }

    /// Every law of a strain with its rigidities multiplied.
    ///
    /// # Errors
    /// A factor that is not positive and finite; a potential, which has no rigidities of its own, unless all
    /// factors are 1.
    pub fn softened(self, factors: &RigidityFactors) -> Result<Self, RodParameterError> {
        if *factors == RigidityFactors::default() {
            return Ok(self);
        }
        factors.validate()?;
        let laws = self.replaceable(RodKey::Factor)?;
        Ok(self.with_laws(laws.times(factors)))
    }

    /// The material of one potential for all strains, of which there are few in a program:
    /// [`Homogenised::mean_filament`], or a leaked one ([`Box::leak`]).
    ///
    /// Twist, shear and stretch are one law there, so that loads of a segment depend on the mean
    /// curvature around it. Functions of one strain alone take the others as zero, and the length as
    /// natural.
    pub fn homogenised(law: &'static Homogenised) -> Self {
        Self::straight(Kind::Potential(law))
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
    /// What [`TwistLaw::validate`] refuses, and a potential, which has a law of every strain.
    pub fn with_twist(self, twist: TwistLaw) -> Result<Self, RodParameterError> {
        twist.validate()?;
        let laws = self.replaceable(RodKey::Twist)?;
        Ok(self.with_laws(StrainLaws { twist, ..laws }))
    }

    /// The same with another law of bending.
    ///
    /// # Errors
    /// What [`BendLaw::validate`] refuses, and a potential.
    pub fn with_bend(self, bend: BendLaw) -> Result<Self, RodParameterError> {
        bend.validate()?;
        let laws = self.replaceable(RodKey::Bend)?;
        Ok(self.with_laws(StrainLaws { bend, ..laws }))
    }

    /// The same with another law of stretch.
    ///
    /// # Errors
    /// What [`StretchLaw::validate`] refuses, and a potential.
    pub fn with_stretch(self, stretch: StretchLaw) -> Result<Self, RodParameterError> {
        stretch.validate()?;
        let laws = self.replaceable(RodKey::Tension)?;
        Ok(self.with_laws(StrainLaws { stretch, ..laws }))
    }

    /// The same with another law of shear.
    ///
    /// # Errors
    /// What [`CubicShear::validate`] refuses, and a potential.
    pub fn with_shear(self, shear: CubicShear) -> Result<Self, RodParameterError> {
        shear.validate()?;
        let laws = self.replaceable(RodKey::Shear)?;
        Ok(self.with_laws(StrainLaws { shear, ..laws }))
    }

    fn with_laws(self, laws: StrainLaws) -> Self {
        Self {
            kind: Kind::Laws(laws),
            ..self
        }
    }

    /// The laws, of which one is to be replaced.
    fn replaceable(self, key: RodKey) -> Result<StrainLaws, RodParameterError> {
        match self.kind {
            Kind::Laws(laws) => Ok(laws),
            Kind::Potential(_) => Err(RodParameterError {
                key,
                value: f64::NAN,
                rule: "left out: a potential has a law of every strain",
            }),
        }
    }

    /// What it is made of.
    #[inline]
    pub(crate) fn kind(&self) -> &Kind {
        &self.kind
    }

    /// A law for each strain; none where all have one potential.
    pub fn laws(&self) -> Option<&StrainLaws> {
        match &self.kind {
            Kind::Laws(laws) => Some(laws),
            Kind::Potential(_) => None,
        }
    }

    /// Whether laws of single strains are isotropic about the axis.
    pub(crate) fn is_axisymmetric(&self) -> bool {
        let rest = self.rest_curvature;
        let is_straight = rest.x == 0.0 && rest.y == 0.0;
        is_straight && self.laws().is_some_and(StrainLaws::are_axisymmetric)
    }

    /// The potential of all strains, if there is one.
    pub fn potential(&self) -> Option<&'static Homogenised> {
        match self.kind {
            Kind::Laws(_) => None,
            Kind::Potential(law) => Some(law),
        }
    }

    /// Force in body axes (pN) at shear strain `sigma`.
    #[inline]
    pub fn shear_force(&self, sigma: Vector3) -> Vector3 {
        match &self.kind {
            Kind::Laws(laws) => laws.shear_force_beyond(sigma, 0.0),
            Kind::Potential(law) => law.segment_loads(sigma, STRAIGHT).0,
        }
    }

    /// Energy per rest length (pN) at shear strain `sigma`, of which
    /// [`shear_force`](Self::shear_force) is the gradient.
    #[inline]
    pub fn shear_energy_density(&self, sigma: Vector3) -> f64 {
        match &self.kind {
            Kind::Laws(laws) => laws.shear_energy_beyond(sigma, 0.0),
            Kind::Potential(law) => law.segment_energy(sigma, STRAIGHT),
        }
    }

    /// Tangent (pN) at shear strain `sigma`: the derivative of [`shear_force`](Self::shear_force)
    /// with respect to `sigma`, symmetric.
    #[inline]
    pub fn shear_tangent(&self, sigma: Vector3) -> Matrix3 {
        match &self.kind {
            Kind::Laws(laws) => laws.shear_tangent_beyond(sigma, 0.0),
            Kind::Potential(law) => law.segment_jet(sigma, STRAIGHT).by_strain,
        }
    }

    /// Couple in body axes (pN nm) at curvature `kappa` (rad/nm).
    #[inline]
    pub fn bending_couple(&self, kappa: Vector3) -> Vector3 {
        let kappa = kappa - self.rest_curvature;
        match &self.kind {
            Kind::Laws(laws) => laws.bending_couple(kappa),
            Kind::Potential(law) => law.joint_couple(kappa),
        }
    }

    /// Tangent (pN nm^2) at curvature `kappa` (rad/nm): the derivative of
    /// [`bending_couple`](Self::bending_couple) with respect to `kappa`, symmetric.
    #[inline]
    pub fn bending_tangent(&self, kappa: Vector3) -> Matrix3 {
        let kappa = kappa - self.rest_curvature;
        match &self.kind {
            Kind::Laws(laws) => laws.bending_tangent(kappa),
            Kind::Potential(law) => law.joint_tangent(kappa),
        }
    }

    /// Energy per rest length (pN) at curvature `kappa` (rad/nm), of which
    /// [`bending_couple`](Self::bending_couple) is the gradient.
    #[inline]
    pub fn bending_energy_density(&self, kappa: Vector3) -> f64 {
        let kappa = kappa - self.rest_curvature;
        match &self.kind {
            Kind::Laws(laws) => laws.bending_energy_density(kappa),
            Kind::Potential(law) => law.joint_energy(kappa),
        }
    }

    /// Energy per length (pN) of a twist (rad/nm) beyond that at rest alone.
    pub(crate) fn twist_energy_density(&self, twist: f64) -> f64 {
        self.bending_energy_density(self.rest_curvature + Vector3::z() * twist)
    }

    /// Its derivative (pN nm).
    #[inline]
    pub(crate) fn twist_couple(&self, twist: f64) -> f64 {
        match &self.kind {
            Kind::Laws(laws) => laws.bending_couple(Vector3::z() * twist).z,
            Kind::Potential(law) => law.unrolled().twisting(twist),
        }
    }

    /// Its second derivative (pN nm^2).
    pub(crate) fn twist_tangent(&self, twist: f64) -> f64 {
        let kappa = self.rest_curvature + Vector3::z() * twist;
        self.bending_tangent(kappa)[(2, 2)]
    }
}
