//! Tangent correlation and persistence length.

use super::{Checked, DerivedLength, Observe, RecordTimes, StoredPositions, View};
use crate::Assembly;
use crate::shape::Ribbon;
use actin_mechanics::Vector3;

/// Tolerance (nm) above the round-off of sums of lengths.
const SAME_PLACE_NM: f64 = 1e-9;

/// Mean cosine of the angle between cross-sections at a distance.
///
/// The normal of a cross-section is the third axis of its frame, which shear does not rotate.
/// Cosines are interpolated linearly between frames. All pairs have equal weight. In a heat bath, a
/// filament in space with persistence length `p` has the mean `exp(-distance / p)`.
///
/// # Source
/// Doi and Edwards, The Theory of Polymer Dynamics (1986), section 8.8.
#[derive(Debug)]
pub(super) struct TangentCorrelation {
    pub(super) filament: usize,
    pub(super) over_nm: f64,
    /// `true` if only heat bends the filament, so that a persistence length is defined.
    pub(super) tells_length: bool,
}

impl Observe for TangentCorrelation {
    fn columns(&self) -> Vec<String> {
        let Self {
            filament, over_nm, ..
        } = self;
        vec![format!("tangent_correlation[{filament}]_over_{over_nm}nm")]
    }

    fn observe(&self, view: &View<'_>, _past: &mut StoredPositions, row: &mut Vec<f64>) {
        row.push(correlation(view.ribbon(self.filament), self.over_nm));
    }

    fn derived(&self, mean: f64, error: Option<f64>) -> Option<DerivedLength> {
        if !self.tells_length {
            return None;
        }
        let loss = -mean.ln();
        let length = Some(self.over_nm / loss).filter(|p| p.is_finite() && *p > 0.0);
        let errors = length.zip(error).map(|(p, e)| p * e / (mean * loss));
        Some(DerivedLength {
            persistence_length_nm: length,
            persistence_length_error_nm: errors,
        })
    }

    fn check(&self, assembly: &Assembly, _estimate: Option<&RecordTimes>) -> Checked {
        let s_nm = Ribbon::from_state(assembly, self.filament, &assembly.rest).frame_s_nm;
        let most = s_nm[s_nm.len() - 1] - s_nm[0];
        if most > 0.0 && self.over_nm <= most + SAME_PLACE_NM {
            return Ok(());
        }
        let rule = format!("must be at most {most:?}, from the first cross-section to the last");
        Err(("over_nm", self.over_nm, rule))
    }
}

/// Mean over all frames with another frame at this distance (nm).
fn correlation(ribbon: &Ribbon, over_nm: f64) -> f64 {
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
