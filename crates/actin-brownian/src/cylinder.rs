use std::f64::consts::PI;
use thiserror::Error;

/// Smallest ratio of length to diameter. Below a ratio of 2.2, the friction concentrated at the
/// ends would exceed the total friction.
const LEAST_RATIO: f64 = 3.0;

/// Straight cylinder in a fluid, with its total friction distributed along its length.
///
/// Friction per length for viscosity `eta`, length `L`, radius `a` and `p = L/(2 a)`:
///
/// ```text
/// along the axis:              2 pi eta / (ln p - 0.207 + 0.980/p - 0.133/p^2)
/// across, including the ends:  4 pi eta / (ln p + 0.839 + 0.185/p + 0.233/p^2)
/// rotation about the axis:     4 pi eta a^2
/// tilt of cross-sections:      pi eta a^2
/// ```
///
/// Uniform friction underestimates the rotational friction end over end by a third for `p = 20`.
/// Part of the transverse friction is therefore concentrated at the ends, so that the total of the
/// end-over-end rotation is
///
/// ```text
/// pi eta L^3 / (3 (ln p - 0.662 + 0.917/p - 0.050/p^2))
/// ```
///
/// The fits along and across the axis agree with numerical solutions to 1 % for `p` from 2 to 30,
/// and have the correct limit for large `p`. The friction about the axis is exact for an infinite
/// cylinder; the ends add 2 % at `p = 10` and 8 % at `p = 5`.
///
/// For flexible cylinders the friction is local. Hydrodynamic interaction enters only through the
/// logarithm of the length. The friction of modes of shorter wavelength is therefore too small.
///
/// ```
/// use actin_brownian::Cylinder;
/// // 164 nm of radius 3.5 nm in water at 25 degrees C.
/// let cylinder = Cylinder::new(0.89, 164.0, 3.5)?;
/// assert!((cylinder.across() - 2.80).abs() < 0.01);
/// assert!((cylinder.about() - 137.0).abs() < 0.1);
/// # Ok::<(), actin_brownian::CylinderError>(())
/// ```
///
/// # Source
/// Along, across, end over end: Tirado, Lopez Martinez and Garcia de la Torre, J. Chem. Phys. 81
/// (1984) 2047. About the axis: Lamb, Hydrodynamics, 6th ed. (1932), article 333. Tirado and Garcia
/// de la Torre, J. Chem. Phys. 73 (1980) 1986, give `3.841 pi eta a^2 (1 + 0.677/p - 0.183/p^2)`.
/// Tilt: moment of the harmonic flow `w = omega a^2 cos(phi)/r` along the axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    viscosity: f64,
    length: f64,
    radius: f64,
}

/// Error of the construction of a cylinder.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CylinderError {
    /// A number is not positive and finite.
    #[error("the {0} must be positive and finite, got {1}")]
    Number(&'static str, f64),
    /// The cylinder is too short.
    #[error("a length of {length} nm is less than {LEAST_RATIO} diameters of {diameter} nm")]
    Short {
        /// Length (nm).
        length: f64,
        /// Diameter (nm).
        diameter: f64,
    },
}

impl Cylinder {
    /// Creates a cylinder of `length` and `radius` (nm) in a fluid of `viscosity` (mPa s = pN
    /// ns/nm^2).
    ///
    /// # Errors
    /// If a number is not positive and finite, or the length is below three diameters.
    pub fn new(viscosity: f64, length: f64, radius: f64) -> Result<Self, CylinderError> {
        let numbers = [
            ("viscosity", viscosity),
            ("length", length),
            ("radius", radius),
        ];
        for (name, value) in numbers {
            if !(value.is_finite() && value > 0.0) {
                return Err(CylinderError::Number(name, value));
            }
        }
        let diameter = 2.0 * radius;
        if length < LEAST_RATIO * diameter {
            return Err(CylinderError::Short { length, diameter });
        }
        Ok(Self {
            viscosity,
            length,
            radius,
        })
    }

    /// Friction along the axis, per length (pN ns/nm^2).
    pub fn along(&self) -> f64 {
        let p = self.ratio();
        2.0 * PI * self.viscosity / (p.ln() - 0.207 + 0.980 / p - 0.133 / (p * p))
    }

    /// Friction across the axis, per length (pN ns/nm^2), including the ends.
    pub fn across(&self) -> f64 {
        let p = self.ratio();
        4.0 * PI * self.viscosity / (p.ln() + 0.839 + 0.185 / p + 0.233 / (p * p))
    }

    /// Friction about the axis, per length (pN ns).
    pub fn about(&self) -> f64 {
        4.0 * PI * self.viscosity * self.radius * self.radius
    }

    /// Friction of the tilt of cross-sections, per length (pN ns).
    pub fn tilt(&self) -> f64 {
        0.25 * self.about()
    }

    /// Total friction of the rotation end over end about the middle (pN nm ns).
    pub(crate) fn end_over_end(&self) -> f64 {
        let p = self.ratio();
        let logarithm = p.ln() - 0.662 + 0.917 / p - 0.050 / (p * p);
        PI * self.viscosity * self.length.powi(3) / (3.0 * logarithm)
    }

    /// Friction across the axis at each end (pN ns/nm): `3 Z_r/L^2 - Z_t/4`. `Z_r` is the friction
    /// `end_over_end` without [`tilt`](Self::tilt), and `Z_t` the total
    /// friction across.
    pub fn at_ends(&self) -> f64 {
        let of_whole = self.across() * self.length;
        let turning = self.end_over_end() - self.tilt() * self.length;
        3.0 * turning / (self.length * self.length) - 0.25 * of_whole
    }

    /// Friction across the axis between the ends, per length (pN ns/nm^2).
    pub fn between_ends(&self) -> f64 {
        self.across() - 2.0 * self.at_ends() / self.length
    }

    fn ratio(&self) -> f64 {
        0.5 * self.length / self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_make_up_the_whole() {
        for length in [21.0, 70.0, 160.0, 1000.0, 2e4] {
            let c = Cylinder::new(1.3, length, 3.5).unwrap();
            let across = c.between_ends() * length + 2.0 * c.at_ends();
            assert!((across / (c.across() * length) - 1.0).abs() < 1e-12);
            let (evenly, arm) = (c.between_ends() * length.powi(3) / 12.0, 0.5 * length);
            let turning = evenly + 2.0 * c.at_ends() * arm * arm + c.tilt() * length;
            assert!((turning / c.end_over_end() - 1.0).abs() < 1e-12);
            assert!(
                c.between_ends() > 0.0 && c.at_ends() > 0.0,
                "{length}: {c:?}"
            );
        }
    }

    #[test]
    fn long_cylinders_have_the_friction_of_slender_bodies() {
        let c = Cylinder::new(1.0, 7e8, 3.5).unwrap();
        let logarithm = 1e8_f64.ln();
        assert!((c.across() * (logarithm + 0.839) / (4.0 * PI) - 1.0).abs() < 1e-7);
        assert!((c.along() * (logarithm - 0.207) / (2.0 * PI) - 1.0).abs() < 1e-7);
        let turning = c.end_over_end() / c.length.powi(3);
        assert!((turning * 3.0 * (logarithm - 0.662) / PI - 1.0).abs() < 1e-7);
    }

    #[test]
    fn what_is_no_cylinder_is_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Cylinder::new(bad, 100.0, 3.5).is_err());
            assert!(Cylinder::new(1.0, bad, 3.5).is_err());
            assert!(Cylinder::new(1.0, 100.0, bad).is_err());
        }
        let short = Cylinder::new(1.0, 20.9, 3.5);
        assert!(matches!(short, Err(CylinderError::Short { .. })));
    }
}
