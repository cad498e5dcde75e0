//! Errors that were measured where rods under `Homogenised` leave the data of their law.

use serde::{Deserialize, Serialize};

/// Cantilevers of 62 to 303 nm under 1 to 10 pN across the tip, in five groups for each quantity: the furthest value
/// of the group, and the largest errors up to there.
///
/// # Source
/// `cargo xtask load-cases --beyond --write`.
const MEASURED: &str = include_str!("extrapolation.csv");

/// Largest error of the tip's displacement (relative) of cantilevers that leave the data of their law at most so far.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredError {
    /// The furthest value among the cantilevers, at least that of the warning (a strain, or rad/nm).
    pub up_to: f64,
    /// Against the mean of monomers over azimuths of the lattice.
    pub of_mean: f64,
    /// Against monomers at one azimuth.
    pub of_one_azimuth: f64,
}

impl MeasuredError {
    /// The error of the first group that goes as far as `value`; `None` beyond all groups.
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

    /// Errors grow with what is reached; none is given beyond what was measured, in tension, or of twist.
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
