//! Free energy at 298 K for a segment length.

use super::mean_filament::numbers;
use super::{Homogenised, Term};
use crate::{RodKey, RodParameterError};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Coefficients of each term, lowest order first, by inverse power of the segment length (nm), from
/// `cargo xtask homogenise mesh`.
const BY_SEGMENT: &str = include_str!("mean_filament_298_k_by_segment.csv");

/// Highest inverse power of the segment length.
const POWERS: i32 = 2;

/// Number of laws per nanometre of segment length.
const PER_NM: f64 = 100.0;

impl Homogenised {
    /// Shortest segment (nm) of [`heated_rod`](Self::heated_rod).
    ///
    /// Monomers are 2.74 nm apart, and the free energy of shorter segments loses its convexity.
    pub const SHORTEST_HEATED_NM: f64 = 5.0;

    /// Free energy at [`HEATED_K`](Self::HEATED_K) of a rod in a heat bath with segments of
    /// `segment_nm`, rounded to 0.01 nm.
    ///
    /// Cells of length `Lc` = 35.6 nm already contain the fluctuations of shorter wavelength, and
    /// segments of length `h` make them again. To second order in `kT`, the energy without them is
    ///
    /// ```text
    /// U_h = W - kT/2 (D_s/h - D/Lc) + kT^2/8 (X_ss/h^2 - 2 X_sc/(h Lc) + X_cc/Lc^2)
    /// D   = ln det A,    A = d2W/de2
    /// D_s = mean over q in (0, pi) of ln det M(q)
    /// M   = [[J + cos^2(q/2) (A_kk - J), cos(q/2) A_ks], [cos(q/2) A_sk, A_ss]]
    /// X_cc = tr(A^-1 d2D/de2),  X_sc = mean of tr(M^-1 M[D]),  X_ss = mean of tr(M^-1 M[D_s])
    /// ```
    ///
    /// `W` is [`mean_filament_at_298_k`](Self::mean_filament_at_298_k), `J` the tangent of its
    /// joints, and `M[F]` the matrix `M` of the potential `F`. Joints have curvature `k`, segments
    /// strain `s` and the mean curvature of their joints. `D`, `D_s` and `X` are fitted in the terms
    /// of `W`, so that each coefficient is a polynomial in `1/h`.
    ///
    /// The mean of the first-order formulas with `D[W]` and with `D[U_1]`, where `U_1` is the
    /// first-order result, has `X_sc + X_cs` in place of `2 X_sc`, with
    /// `X_cs = tr(A^-1 d2D_s/de2)`. The two agree if the rod is not staggered, with `D_s = D`.
    ///
    /// Accuracy: `docs/measured/heat.md`, "Segment length".
    ///
    /// ```
    /// use actin_cosserat::Homogenised;
    /// let shear = |nm: f64| Homogenised::heated_rod(nm).map(|law| law.tangent(&[0.0; 6].into())[(3, 3)]);
    /// // Fluctuations of shear stiffen a rod, so that shorter segments are softer.
    /// assert!(shear(10.0)? < 0.9 * shear(30.0)?);
    /// assert!(Homogenised::heated_rod(2.5).is_err());
    /// # Ok::<(), actin_cosserat::RodParameterError>(())
    /// ```
    ///
    /// # Errors
    /// If `segment_nm` is below [`SHORTEST_HEATED_NM`](Self::SHORTEST_HEATED_NM) or not finite.
    pub fn heated_rod(segment_nm: f64) -> Result<&'static Self, RodParameterError> {
        // Leaked on purpose: see `sampled_filament`.
        static LAWS: Mutex<BTreeMap<u64, &'static Homogenised>> = Mutex::new(BTreeMap::new());
        let rounded = (segment_nm * PER_NM).round() / PER_NM;
        if !(rounded >= Self::SHORTEST_HEATED_NM && rounded.is_finite()) {
            return Err(RodParameterError {
                key: RodKey::SegmentLength,
                value: segment_nm,
                rule: "finite and at least 5 nm in a heat bath",
            });
        }
        let mut laws = LAWS.lock().unwrap_or_else(PoisonError::into_inner);
        let law = laws.entry(rounded.to_bits());
        Ok(law.or_insert_with(|| Box::leak(Box::new(by_segment(rounded)))))
    }
}

fn by_segment(segment_nm: f64) -> Homogenised {
    let cell = Homogenised::mean_filament_at_298_k();
    let coefficients = |term: Term| {
        let mut sum = cell.coefficients(term).to_vec();
        for power in 0..=POWERS {
            let factor = segment_nm.powi(-power);
            let added = numbers(BY_SEGMENT, &format!("{power} {term:?}"));
            for (value, added) in sum.iter_mut().zip(added) {
                *value += factor * added;
            }
        }
        sum
    };
    Homogenised::new(cell.form().clone(), coefficients)
        .expect("the embedded coefficients are valid")
        .with_range(*cell.range())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::homogenised::tests::assert_derivatives;

    #[test]
    fn coefficients_are_listed_by_power_and_term() {
        let mut lines = BY_SEGMENT.lines();
        for power in 0..=POWERS {
            for term in Term::ALL {
                let (name, numbers) = lines.next().unwrap().split_once(',').unwrap();
                assert_eq!(name, format!("{power} {term:?}"));
                assert_eq!(numbers.split(',').count(), term.degree() + 1);
            }
        }
        assert_eq!(lines.next(), None);
    }

    #[test]
    fn short_segments_are_refused() {
        for segment_nm in [4.99, 0.0, -10.0, f64::NAN, f64::INFINITY] {
            let error = Homogenised::heated_rod(segment_nm).unwrap_err();
            assert_eq!(error.key, RodKey::SegmentLength);
        }
        assert!(Homogenised::heated_rod(5.0 - 1e-9).is_ok());
    }

    #[test]
    fn loads_and_tangent_are_derivatives() {
        for segment_nm in [5.0, 10.0, 30.0, 100.0] {
            assert_derivatives(Homogenised::heated_rod(segment_nm).unwrap());
        }
    }
}
