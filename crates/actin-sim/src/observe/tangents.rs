//! Tangent correlation and persistence length.

use super::{Checked, DerivedLength};
use crate::Assembly;
use crate::shape::Ribbon;
use actin_mechanics::Vector3;

/// Tolerance (nm) above the round-off of sums of lengths.
const SAME_PLACE_NM: f64 = 1e-9;

pub(super) fn columns(filament: usize, over_nm: f64) -> Vec<String> {
    vec![format!("tangent_correlation[{filament}]_over_{over_nm}nm")]
}

/// Persistence length from the mean correlation and its standard error; an unknown mean is NaN.
pub(super) fn persistence_length(over_nm: f64, mean: f64, error: Option<f64>) -> DerivedLength {
    let loss = -mean.ln();
    let length = Some(over_nm / loss).filter(|p| p.is_finite() && *p > 0.0);
    let errors = length.zip(error).map(|(p, e)| p * e / (mean * loss));
    DerivedLength {
        persistence_length_nm: length,
        persistence_length_error_nm: errors,
    }
}

/// Refuses a distance beyond the frames of the filament.
pub(super) fn check(assembly: &Assembly, filament: usize, over_nm: f64) -> Checked {
    let s_nm = Ribbon::from_state(assembly, filament, &assembly.rest).frame_s_nm;
    let most = s_nm[s_nm.len() - 1] - s_nm[0];
    if most > 0.0 && over_nm <= most + SAME_PLACE_NM {
        return Ok(());
    }
    let rule = format!("must be at most {most:?}, from the first cross-section to the last");
    Err(("over_nm", over_nm, rule))
}

/// Mean cosine of the angle between cross-sections at a distance (nm).
///
/// The normal of a cross-section is the third axis of its frame, which shear does not rotate.
/// Cosines are interpolated linearly between frames. All pairs have equal weight. In a heat bath, a
/// filament in space with persistence length `p` has the mean `exp(-distance / p)`.
///
/// # Source
/// Doi and Edwards, The Theory of Polymer Dynamics (1986), section 8.8.
pub(super) fn correlation(ribbon: &Ribbon, over_nm: f64) -> f64 {
    let s_nm = &ribbon.frame_s_nm;
    let normals: Vec<Vector3> = ribbon.frames.iter().map(|q| q * Vector3::z()).collect();
    let (mut sum, mut count, mut upper) = (0.0, 0.0, 0);
    for lower in 0..s_nm.len() {
        let place = s_nm[lower] + over_nm;
        upper = upper.max(lower + 1);
        while upper < s_nm.len() && s_nm[upper] < place - SAME_PLACE_NM {
            upper += 1;
        }
        if upper == s_nm.len() {
            break;
        }
        let before = upper - 1;
        let share = (place - s_nm[before]) / (s_nm[upper] - s_nm[before]);
        let cosine = |k: usize| normals[lower].dot(&normals[k]);
        sum += (1.0 - share) * cosine(before) + share * cosine(upper);
        count += 1.0;
    }
    sum / count
}
