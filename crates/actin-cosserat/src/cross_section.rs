//! Cross-section of a rod and inertia of its segments.

use crate::{RodParameterError, constants};
use actin_mechanics::{Axis, Inertia};
use std::f64::consts::PI;

/// Validated circular cross-section with a mass per length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrossSection {
    linear_density: f64,
    area: f64,
}

impl CrossSection {
    /// Creates a section with the given mass per length (pN ns^2/nm^2) and area (nm^2).
    ///
    /// # Errors
    /// If a number is not positive and finite.
    pub fn new(linear_density: f64, area: f64) -> Result<Self, RodParameterError> {
        RodParameterError::unless_positive("linear_density", linear_density)?;
        RodParameterError::unless_positive("area", area)?;
        Ok(Self {
            linear_density,
            area,
        })
    }

    /// Cross-section of actin: `constants::LINEAR_DENSITY` and [`constants::CROSS_SECTION_AREA`].
    pub fn actin() -> Self {
        Self {
            linear_density: constants::LINEAR_DENSITY,
            area: constants::CROSS_SECTION_AREA,
        }
    }

    /// Mass per length (pN ns^2/nm^2).
    pub fn linear_density(&self) -> f64 {
        self.linear_density
    }

    /// Mass of a rod of the given length (nm).
    pub(crate) fn mass(&self, length: f64) -> f64 {
        self.linear_density * length
    }

    /// Inertia of a segment of rest length `length` (nm) about its body axes (pN nm ns^2), axis z
    /// along the rod.
    ///
    /// ```text
    /// J = mu l A / (4 pi) diag(1, 1, 2)
    /// ```
    ///
    /// `mu` is the mass per length and `A` the area. A solid cylinder has an additional transverse
    /// `mu l^3 / 12`.
    ///
    /// # Source
    /// Gazzola et al., R. Soc. Open Sci. 5 (2018) 171628, Section 2.
    ///
    /// ```
    /// use actin_cosserat::CrossSection;
    /// use std::f64::consts::PI;
    /// let section = CrossSection::new(0.5, 4.0 * PI).unwrap();
    /// let moments = section.segment_inertia(10.0).moments();
    /// assert_eq!((moments.x, moments.y, moments.z), (5.0, 5.0, 10.0));
    /// ```
    pub fn segment_inertia(&self, length: f64) -> Inertia {
        let transverse = self.mass(length) * self.area / (4.0 * PI);
        Inertia {
            axis: Axis::Z,
            axial: 2.0 * transverse,
            transverse,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn invalid_sections_are_refused() {
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(
                CrossSection::new(bad, 1.0).unwrap_err().key,
                "linear_density"
            );
            assert_eq!(CrossSection::new(1.0, bad).unwrap_err().key, "area");
        }
    }
}
