//! Laws of shear, stretch, bending and twist.

use crate::{BendLaw, CubicShear, Rigidities, RigidityFactors, StretchLaw, TwistLaw};
use actin_mechanics::{Matrix3, Vector3};

/// One law per strain of a rod.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrainLaws {
    pub(crate) shear: CubicShear,
    pub(crate) stretch: StretchLaw,
    pub(crate) bend: BendLaw,
    pub(crate) twist: TwistLaw,
}

impl StrainLaws {
    pub(crate) fn are_axisymmetric(&self) -> bool {
        let are_equal = |[x, y]: [f64; 2]| (x - y).abs() <= f64::EPSILON * x;
        let has_one_bend = matches!(self.bend, BendLaw::Constant(bend) if are_equal(bend));
        are_equal(self.shear.linear) && has_one_bend
    }

    pub(crate) fn constant(Rigidities { shear, bend }: Rigidities) -> Self {
        Self {
            shear: CubicShear {
                linear: [shear.x, shear.y],
                cubic: 0.0,
            },
            stretch: StretchLaw::Constant { rigidity: shear.z },
            bend: BendLaw::Constant([bend.x, bend.y]),
            twist: TwistLaw::Constant(bend.z),
        }
    }

    pub(crate) fn times(self, factors: &RigidityFactors) -> Self {
        Self {
            shear: self.shear.times(factors.shear),
            stretch: self.stretch.times(factors.stretch),
            bend: self.bend.times(factors.bend),
            twist: self.twist.times(factors.twist),
        }
    }

    /// Law of bending.
    pub fn bend(&self) -> &BendLaw {
        &self.bend
    }

    /// Law of twist.
    pub fn twist(&self) -> &TwistLaw {
        &self.twist
    }

    /// Law of stretch.
    pub(crate) fn stretch(&self) -> &StretchLaw {
        &self.stretch
    }

    /// Law of shear.
    pub(crate) fn shear(&self) -> &CubicShear {
        &self.shear
    }

    /// Force (pN, body axes) at shear strain `sigma` with the natural extension `natural`.
    #[inline]
    pub(crate) fn shear_force_beyond(&self, sigma: Vector3, natural: f64) -> Vector3 {
        let across = self.shear.force(sigma.xy());
        let (strain, along, _) = self.length_strain(sigma);
        Vector3::new(across.x, across.y, 0.0) + along * self.stretch.force(strain - natural)
    }

    /// Energy per length (pN).
    #[inline]
    pub(crate) fn shear_energy_beyond(&self, sigma: Vector3, natural: f64) -> f64 {
        let (strain, ..) = self.length_strain(sigma);
        self.shear.energy_density(sigma.xy()) + self.stretch.energy_density(strain - natural)
    }

    /// Derivative of the force (pN), symmetric.
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

    /// Strain of length, its gradient, and the factor of its second derivative, transverse to the
    /// gradient.
    ///
    /// With linear shear it is the component along d3. With cubic shear it is the change of length,
    /// `|e3 + sigma| - 1`: tension along d3 would make a rod without linear shear rigidity
    /// unstable, whereas tension along the segment stabilises it like a string.
    #[inline]
    pub(crate) fn length_strain(&self, sigma: Vector3) -> (f64, Vector3, f64) {
        if self.shear.cubic == 0.0 {
            return (sigma.z, Vector3::z(), 0.0);
        }
        let segment = Vector3::z() + sigma;
        let length = segment.norm();
        // |segment| - 1, without cancellation.
        let strain = (2.0 * sigma.z + sigma.norm_squared()) / (length + 1.0);
        (strain, segment / length, length.recip())
    }

    /// Torque (pN nm, body axes) at curvature `kappa` (rad/nm).
    #[inline]
    pub(crate) fn bending_couple(&self, kappa: Vector3) -> Vector3 {
        let mut couple = self.bend.couple(kappa);
        couple.z += self.twist.couple(kappa.z);
        couple
    }

    /// Derivative of the torque (pN nm^2), symmetric.
    #[inline]
    pub(crate) fn bending_tangent(&self, kappa: Vector3) -> Matrix3 {
        let mut tangent = self.bend.tangent(kappa);
        tangent[(2, 2)] += self.twist.tangent(kappa.z);
        tangent
    }

    /// Energy per rest length (pN) at curvature `kappa`.
    #[inline]
    pub(crate) fn bending_energy_density(&self, kappa: Vector3) -> f64 {
        self.bend.energy_density(kappa) + self.twist.energy_density(kappa.z)
    }
}
