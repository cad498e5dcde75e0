//! Measured errors of rods with the law `Homogenised` outside the data of the law.

use serde::{Deserialize, Serialize};

/// Largest errors of cantilevers of 62 to 303 nm under transverse tip forces of 1 to 10 pN, in five
/// groups per quantity.
///
/// # Source
/// `cargo xtask load-cases --beyond --write`.
const MEASURED: &str = include_str!("extrapolation.csv");

/// Largest relative error of the tip displacement over cantilevers that extrapolate their law up to
/// `up_to`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredError {
    /// Largest value of the quantity in the group (strain, or rad/nm).
    pub up_to: f64,
    /// Error against the mean of monomers over azimuths of the lattice.
    pub of_mean: f64,
    /// Error against monomers at one azimuth.
    pub of_one_azimuth: f64,
}

impl MeasuredError {
    /// Returns the error of the first group that reaches `value`, or `None` beyond all groups.
    pub(super) fn at(quantity: &str, value: f64) -> Option<Self> {
        let reaches = |up_to: f64| up_to.signum() == value.signum() && up_to.abs() >= value.abs();
        let rows = MEASURED.lines().skip(1).filter_map(|line| {
            let (name, numbers) = line.split_once(',')?;
            let numbers: Vec<f64> = numbers.split(',').filter_map(|n| n.parse().ok()).collect();
            let [up_to, of_mean, of_one_azimuth] = numbers[..] else {
                return None;
            };
            (name == quantity && reaches(up_to)).then_some(Self {
                up_to,
                of_mean,
                of_one_azimuth,
            })
        });
        rows.min_by(|a, b| a.up_to.abs().total_cmp(&b.up_to.abs()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_given_as_far_as_they_were_measured() {
        for (quantity, near, far) in [
            ("shear", 0.0151, 0.025),
            ("curvature", 0.0101, 0.02),
            ("stretch", -0.0021, -0.01),
        ] {
            let [near, far] = [near, far].map(|value| MeasuredError::at(quantity, value).unwrap());
            assert!(near.up_to.abs() < far.up_to.abs());
            for error in [near, far] {
                assert!(0.0 < error.of_mean && error.of_mean <= error.of_one_azimuth);
                assert!(error.of_one_azimuth < 0.2, "{error:?}");
            }
            assert!(near.of_mean <= far.of_mean);
        }
        for (quantity, value) in [("shear", 0.05), ("stretch", 0.01), ("twist", 0.06)] {
            assert_eq!(MeasuredError::at(quantity, value), None);
        }
    }
}
