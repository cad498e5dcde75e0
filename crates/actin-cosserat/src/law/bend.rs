//! Laws of bending.

use super::Stiffening;
use crate::RodParameterError;
use actin_mechanics::{Matrix3, Vector3};

/// Law of bending: torques about d1 and d2, and the contribution to twist.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum BendLaw {
    /// Constant rigidities B1, B2 (pN nm^2).
    Constant([f64; 2]),
    /// Isotropic rigidity that rises with deformation.
    Stiffening(Stiffening),
}

impl BendLaw {
    /// Checks all parameters.
    ///
    /// # Errors
    /// If a parameter is out of range.
    pub(crate) fn validate(&self) -> Result<(), RodParameterError> {
        match self {
            Self::Constant([b1, b2]) => {
                RodParameterError::unless_positive("bend_pn_nm2[0]", *b1)?;
                RodParameterError::unless_positive("bend_pn_nm2[1]", *b2)
            }
            Self::Stiffening(law) => law.validate(),
        }
    }

    pub(crate) fn times(self, factor: f64) -> Self {
        match self {
            Self::Constant(rigidities) => Self::Constant(rigidities.map(|b| b * factor)),
            Self::Stiffening(law) => Self::Stiffening(Stiffening {
                rest: law.rest * factor,
                rise: law.rise * factor,
                ..law
            }),
        }
    }

    /// Torque (pN nm) at curvature `kappa` (rad/nm).
    #[inline]
    pub(crate) fn couple(&self, kappa: Vector3) -> Vector3 {
        match self {
            Self::Constant([b1, b2]) => Vector3::new(b1 * kappa.x, b2 * kappa.y, 0.0),
            Self::Stiffening(law) => law.couple(kappa),
        }
    }

    /// Derivative of the torque (pN nm^2), symmetric.
    #[inline]
    pub(crate) fn tangent(&self, kappa: Vector3) -> Matrix3 {
        match self {
            Self::Constant([b1, b2]) => Matrix3::from_diagonal(&Vector3::new(*b1, *b2, 0.0)),
            Self::Stiffening(law) => law.tangent(kappa),
        }
    }

    /// Energy per length (pN).
    #[inline]
    pub(crate) fn energy_density(&self, kappa: Vector3) -> f64 {
        match self {
            Self::Constant([b1, b2]) => 0.5 * (b1 * kappa.x * kappa.x + b2 * kappa.y * kappa.y),
            Self::Stiffening(law) => law.energy_density(kappa),
        }
    }

    /// Largest curvature (rad/nm) of the data, or `None` without data.
    pub fn range(&self) -> Option<f64> {
        match self {
            Self::Constant(_) => None,
            Self::Stiffening(law) => Some(law.range),
        }
    }
}

/// Stiffening without shear, with `p = k1^2 + k2^2` and `s = k3^2 / twist^2`.
impl Stiffening {
    #[inline]
    fn arguments(&self, kappa: Vector3) -> (f64, f64) {
        let p = kappa.x * kappa.x + kappa.y * kappa.y;
        (p, (kappa.z / self.twist).powi(2))
    }

    fn energy_density(&self, kappa: Vector3) -> f64 {
        let (p, s) = self.arguments(kappa);
        self.jet(p, s).value
    }

    fn couple(&self, kappa: Vector3) -> Vector3 {
        let (p, s) = self.arguments(kappa);
        let jet = self.jet(p, s);
        let turn = kappa.z / (self.twist * self.twist);
        2.0 * Vector3::new(jet.p * kappa.x, jet.p * kappa.y, jet.s * turn)
    }

    fn tangent(&self, kappa: Vector3) -> Matrix3 {
        let (p, s) = self.arguments(kappa);
        let jet = self.jet(p, s);
        let scale = (self.twist * self.twist).recip();
        let of_p = 2.0 * Vector3::new(kappa.x, kappa.y, 0.0);
        let of_s = 2.0 * Vector3::z() * (kappa.z * scale);
        let mixed = of_p * of_s.transpose();
        let curved = Vector3::new(jet.p, jet.p, jet.s * scale);
        jet.pp * of_p * of_p.transpose()
            + jet.ps * (mixed + mixed.transpose())
            + jet.ss * of_s * of_s.transpose()
            + 2.0 * Matrix3::from_diagonal(&curved)
    }
}
