//! Friction of a straight cylinder in a viscous fluid, per length of it.

use std::f64::consts::PI;
use thiserror::Error;

/// Least ratio of length to diameter: below 2.2 more friction than there is would act at the ends.
const LEAST_RATIO: f64 = 3.0;

/// A straight cylinder in a fluid: its friction as a whole, shared out along it.
///
/// With the viscosity `eta`, the length `L`, the radius `a` and `p = L/(2 a)`, per length:
///
/// - along the axis `2 pi eta / (ln p - 0.207 + 0.980/p - 0.133/p^2)`,
/// - across it `4 pi eta / (ln p + 0.839 + 0.185/p + 0.233/p^2)`, of which part acts at the ends,
/// - about it `4 pi eta a^2`,
/// - of cross-sections that tilt against the axis `pi eta a^2`.
///
/// Friction shared out evenly turns a cylinder end over end too easily, by a third for `p = 20`: fluid that one half drags
/// along helps the other half when both go the same way only. So friction `e` acts at each end, and the rest evenly,
/// such that the cylinder moves across with the friction above and turns with
/// `pi eta L^3 / (3 (ln p - 0.662 + 0.917/p - 0.050/p^2))`.
///
/// Accuracy: 1 % of numerical solutions for `p` from 2 to 30 along and across (their fit); beyond, the logarithms are
/// exact in the limit. About the axis it is exact for an infinite cylinder; the ends, left out, add 2 % at
/// `p = 10` and 8 % at `p = 5`.
///
/// For a flexible cylinder these are local frictions: fluid that one part sets in motion carries no other along,
/// except in the mean through the logarithm. Modes of shorter wavelength have a little more friction than this.
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
/// Tirado, Lopez Martinez and Garcia de la Torre, J. Chem. Phys. 81 (1984) 2047 (along, across, end over end). About
/// the axis: Lamb, Hydrodynamics, 6th ed. (1932), article 333; Tirado and Garcia de la Torre, J. Chem. Phys. 73
/// (1980) 1986, have `3.841 pi eta a^2 (1 + 0.677/p - 0.183/p^2)`. Tilt: the flow `w = omega a^2 cos(phi)/r` along the axis
/// is harmonic, meets `omega a cos(phi)` on the surface, and its shear stress has this moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    viscosity: f64,
    length: f64,
    radius: f64,
}

/// A cylinder whose friction is not known.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CylinderError {
    /// A number is not positive and finite.
    #[error("the {0} must be positive and finite, got {1}")]
    Number(&'static str, f64),
    /// It is too short.
    #[error("a length of {length} nm is less than {LEAST_RATIO} diameters of {diameter} nm")]
    Short {
        /// Its length (nm).
        length: f64,
        /// Its diameter (nm).
        diameter: f64,
    },
}

impl Cylinder {
    /// A cylinder of `length` and `radius` (nm) in a fluid of `viscosity` (mPa s, which is pN ns/nm^2).
    ///
    /// # Errors
    /// A number that is not positive and finite, a length below three diameters.
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

    /// Length (nm).
    pub fn length(&self) -> f64 {
        self.length
    }

    /// Friction along the axis, per length (pN ns/nm^2).
    pub fn along(&self) -> f64 {
        let p = self.ratio();
        2.0 * PI * self.viscosity / (p.ln() - 0.207 + 0.980 / p - 0.133 / (p * p))
    }

    /// Friction across the axis, per length (pN ns/nm^2), what acts at the ends included.
    pub fn across(&self) -> f64 {
        let p = self.ratio();
        4.0 * PI * self.viscosity / (p.ln() + 0.839 + 0.185 / p + 0.233 / (p * p))
    }

    /// Friction about the axis, per length (pN ns).
    pub fn about(&self) -> f64 {
        4.0 * PI * self.viscosity * self.radius * self.radius
    }

    /// Friction of a cross-section that tilts against the axis, per length (pN ns).
    pub fn tilt(&self) -> f64 {
        0.25 * self.about()
    }

    /// Friction of the cylinder that turns end over end about its middle (pN nm ns).
    pub fn end_over_end(&self) -> f64 {
        let p = self.ratio();
        let logarithm = p.ln() - 0.662 + 0.917 / p - 0.050 / (p * p);
        PI * self.viscosity * self.length.powi(3) / (3.0 * logarithm)
    }

    /// Friction across the axis at each end (pN ns/nm): `3 Z_r/L^2 - Z_t/4` with the friction `Z_r` of
    /// [`end_over_end`](Self::end_over_end), less that of [`tilt`](Self::tilt), and `Z_t` across of the whole cylinder.
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

    /// What is shared out adds up again: across, and end over end about the middle.
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

    /// A long cylinder is twice as hard to move across as along, to within 1/ln p.
    #[test]
    fn long_cylinders_have_the_friction_of_slender_bodies() {
        let c = Cylinder::new(1.0, 7e8, 3.5).unwrap();
        let logarithm = 1e8_f64.ln();
        assert!((c.across() * (logarithm + 0.839) / (4.0 * PI) - 1.0).abs() < 1e-7);
        assert!((c.along() * (logarithm - 0.207) / (2.0 * PI) - 1.0).abs() < 1e-7);
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
