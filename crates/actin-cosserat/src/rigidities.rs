//! Rigidities of a rod.

use crate::{RodParameterError, constants};
use actin_mechanics::Vector3;
use std::f64::consts::PI;

/// Rigidities of shear strains and curvatures (body axes).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rigidities {
    /// S1, S2 (shear), S3 (stretch) (pN).
    pub shear: Vector3,
    /// B1, B2 (bending), B3 (twist) (pN nm^2).
    pub bend: Vector3,
}

impl Rigidities {
    /// Rigidities of the multi-resolution model.
    ///
    /// # Source
    /// arXiv 2203.01284, Table 4.
    ///
    /// ```
    /// let rigidities = actin_cosserat::Rigidities::table4();
    /// assert_eq!((rigidities.shear.z, rigidities.bend.z), (3.4e4, 1.3e4));
    /// ```
    pub fn table4() -> Self {
        Self {
            shear: constants::TABLE_4_SHEAR.into(),
            bend: constants::TABLE_4_BEND.into(),
        }
    }

    /// Rigidities of the preceding paper, for a cross-section of 38.5 nm^2.
    ///
    /// # Source
    /// arXiv 2203.01284, Table 2, and Appendix B for the area.
    ///
    /// ```
    /// // E A = 2000 x 38.5
    /// assert_eq!(actin_cosserat::Rigidities::preceding_paper().shear.z, 7.7e4);
    /// ```
    pub fn preceding_paper() -> Self {
        Self::isotropic_cylinder(
            constants::PRECEDING_PAPER_YOUNG_MODULUS,
            constants::PRECEDING_PAPER_POISSON_RATIO,
            constants::CROSS_SECTION_AREA,
        )
    }

    /// Rigidities of a cylinder of isotropic material.
    ///
    /// ```text
    /// S1 = S2 = 4 G A / 3,  S3 = E A,  B1 = B2 = E A^2 / 4 pi,  B3 = G A^2 / 2 pi
    /// G = E / (2 (1 + nu))
    /// ```
    ///
    /// `E` is Young's modulus (pN/nm^2), `nu` Poisson's ratio and `A` the area (nm^2).
    ///
    /// # Source
    /// arXiv 2203.01284, Table 2.
    pub(crate) fn isotropic_cylinder(young_modulus: f64, poisson_ratio: f64, area: f64) -> Self {
        let shear_modulus = young_modulus / (2.0 * (1.0 + poisson_ratio));
        let s1 = 4.0 / 3.0 * shear_modulus * area;
        let b1 = young_modulus * area * area / (4.0 * PI);
        Self {
            shear: Vector3::new(s1, s1, young_modulus * area),
            bend: Vector3::new(b1, b1, shear_modulus * area * area / (2.0 * PI)),
        }
    }

    /// Checks all rigidities.
    ///
    /// # Errors
    /// If a rigidity is not positive and finite.
    pub(crate) fn validate(&self) -> Result<(), RodParameterError> {
        for (key, value) in ["shear_pn[0]", "shear_pn[1]", "shear_pn[2]"]
            .into_iter()
            .zip(&self.shear)
        {
            RodParameterError::unless_positive(key, *value)?;
        }
        for (key, value) in ["bend_pn_nm2[0]", "bend_pn_nm2[1]", "bend_pn_nm2[2]"]
            .into_iter()
            .zip(&self.bend)
        {
            RodParameterError::unless_positive(key, *value)?;
        }
        Ok(())
    }
}

/// Factors of the rigidities of a rod, for example due to a bound protein.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct RigidityFactors {
    /// Factor of the shear rigidities.
    pub shear: f64,
    /// Factor of the stretch rigidity.
    pub stretch: f64,
    /// Factor of the bending rigidities.
    pub bend: f64,
    /// Factor of the twist rigidity.
    pub twist: f64,
}

impl Default for RigidityFactors {
    fn default() -> Self {
        Self {
            shear: 1.0,
            stretch: 1.0,
            bend: 1.0,
            twist: 1.0,
        }
    }
}

impl RigidityFactors {
    /// Checks all factors.
    ///
    /// # Errors
    /// If a factor is not positive and finite.
    pub(crate) fn validate(&self) -> Result<(), RodParameterError> {
        let all = [self.shear, self.stretch, self.bend, self.twist];
        all.into_iter()
            .try_for_each(|value| RodParameterError::unless_positive("factor", value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn preceding_paper_by_hand() {
        let r = Rigidities::preceding_paper();
        for (value, expected) in [
            (r.shear.x, 36_666.67),
            (r.shear.y, 36_666.67),
            (r.shear.z, 77_000.0),
            (r.bend.x, 235_907.0),
            (r.bend.y, 235_907.0),
            (r.bend.z, 168_505.0),
        ] {
            assert!((value - expected).abs() < 1e-5 * expected, "{value}");
        }
    }

    #[test]
    fn each_rigidity_is_checked_under_its_own_key() {
        for (k, key) in [
            "shear_pn[0]",
            "shear_pn[1]",
            "shear_pn[2]",
            "bend_pn_nm2[0]",
            "bend_pn_nm2[1]",
            "bend_pn_nm2[2]",
        ]
        .into_iter()
        .enumerate()
        {
            for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
                let mut rigidities = Rigidities::table4();
                match k {
                    0..3 => rigidities.shear[k] = value,
                    _ => rigidities.bend[k - 3] = value,
                }
                let error = rigidities.validate().unwrap_err();
                assert_eq!(error.key, key);
                assert_eq!(error.value.to_bits(), value.to_bits());
            }
        }
        assert_eq!(Rigidities::table4().validate(), Ok(()));
    }
}
