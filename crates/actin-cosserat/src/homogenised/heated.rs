//! Free energy in a heat bath for a segment length.

use super::mean_filament::numbers;
use super::{Homogenised, Term};
use crate::RodParameterError;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Functions that are added to the free energy of cells at 298 K, from `cargo xtask homogenise mesh`:
/// coefficients of each term, lowest order first, after the order and the inverse power of the segment
/// length.
const ADDED: &str = include_str!("heated_rods.csv");

/// Order in `kT` and inverse power of the segment length (nm). Order 0 is the derivative with respect
/// to temperature (1/K).
const FUNCTIONS: [[i32; 2]; 6] = [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2]];

/// Number of laws per nanometre of segment length.
const PER_NM: f64 = 100.0;

impl Homogenised {
    /// Shortest segment (nm) of [`heated_rod`](Self::heated_rod).
    ///
    /// Monomers are 2.74 nm apart, and the free energy of shorter segments loses its convexity.
    pub const SHORTEST_HEATED_NM: f64 = 5.0;

    /// Temperatures (K) of [`heated_rod`](Self::heated_rod).
    pub const HEATED_RANGE_K: [f64; 2] = [273.0, 323.0];

    /// Free energy of a rod in a heat bath of `temperature_k` with segments of `segment_nm`, rounded to
    /// 0.01 nm.
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
    /// `W` is [`mean_filament_at_298_k`](Self::mean_filament_at_298_k) plus `(T - 298 K) dW/dT`, with the
    /// derivative from cells at 273 and 323 K. `J` is the tangent of its joints, and `M[F]` the matrix
    /// `M` of the potential `F`. Joints have curvature `k`, segments strain `s` and the mean curvature
    /// of their joints. `D`, `D_s` and `X` are those at 298 K, fitted in the terms of `W`, so that each
    /// coefficient is a polynomial in `1/h` and `T`.
    ///
    /// The mean of the first-order formulas with `D[W]` and with `D[U_1]`, where `U_1` is the
    /// first-order result, has `X_sc + X_cs` in place of `2 X_sc`, with
    /// `X_cs = tr(A^-1 d2D_s/de2)`. The two agree if the rod is not staggered, with `D_s = D`.
    ///
    /// Accuracy: `docs/measured/heat.md`, "Segment length".
    ///
    /// ```
    /// use actin_cosserat::Homogenised;
    /// let shear = |nm: f64| Homogenised::heated_rod(nm, 298.0).map(|law| law.tangent(&[0.0; 6].into())[(3, 3)]);
    /// // Fluctuations of shear stiffen a rod, so that shorter segments are softer.
    /// assert!(shear(10.0)? < 0.9 * shear(30.0)?);
    /// assert!(Homogenised::heated_rod(2.5, 298.0).is_err());
    /// # Ok::<(), actin_cosserat::RodParameterError>(())
    /// ```
    ///
    /// # Errors
    /// If `segment_nm` is below [`SHORTEST_HEATED_NM`](Self::SHORTEST_HEATED_NM) or not finite, or
    /// `temperature_k` outside [`HEATED_RANGE_K`](Self::HEATED_RANGE_K).
    pub fn heated_rod(
        segment_nm: f64,
        temperature_k: f64,
    ) -> Result<&'static Self, RodParameterError> {
        // Leaked on purpose: see `sampled_filament`.
        static LAWS: Mutex<BTreeMap<[u64; 2], &'static Homogenised>> = Mutex::new(BTreeMap::new());
        let refused = |key, value, rule| Err(RodParameterError { key, value, rule });
        let rounded = (segment_nm * PER_NM).round() / PER_NM;
        if !(rounded >= Self::SHORTEST_HEATED_NM && rounded.is_finite()) {
            let rule = "finite and at least 5 nm in a heat bath";
            return refused("segments", segment_nm, rule);
        }
        let [lowest, highest] = Self::HEATED_RANGE_K;
        if !(lowest..=highest).contains(&temperature_k) {
            return refused("temperature_k", temperature_k, "from 273 to 323 K");
        }
        let mut laws = LAWS.lock().unwrap_or_else(PoisonError::into_inner);
        let law = laws.entry([rounded, temperature_k].map(f64::to_bits));
        Ok(law.or_insert_with(|| Box::leak(Box::new(heated(rounded, temperature_k)))))
    }
}

fn heated(segment_nm: f64, temperature_k: f64) -> Homogenised {
    let cell = Homogenised::mean_filament_at_298_k();
    let ratio = temperature_k / Homogenised::HEATED_K;
    let coefficients = |term: Term| {
        let mut sum = cell.coefficients(term).to_vec();
        for [order, power] in FUNCTIONS {
            let factor = match order {
                0 => temperature_k - Homogenised::HEATED_K,
                _ => ratio.powi(order) * segment_nm.powi(-power),
            };
            let added = numbers(ADDED, &format!("{order} {power} {term:?}"));
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
    fn coefficients_are_listed_by_function_and_term() {
        let mut lines = ADDED.lines();
        for [order, power] in FUNCTIONS {
            for term in Term::ALL {
                let (name, numbers) = lines.next().unwrap().split_once(',').unwrap();
                assert_eq!(name, format!("{order} {power} {term:?}"));
                assert_eq!(numbers.split(',').count(), term.degree() + 1);
            }
        }
        assert_eq!(lines.next(), None);
    }

    #[test]
    fn short_segments_are_refused() {
        for segment_nm in [4.99, 0.0, -10.0, f64::NAN, f64::INFINITY] {
            let error = Homogenised::heated_rod(segment_nm, 298.0).unwrap_err();
            assert_eq!(error.key, "segments");
        }
        assert!(Homogenised::heated_rod(5.0 - 1e-9, 298.0).is_ok());
    }

    #[test]
    fn other_temperatures_are_refused() {
        for temperature_k in [0.0, 272.9, 323.1, f64::NAN] {
            let error = Homogenised::heated_rod(20.0, temperature_k).unwrap_err();
            assert_eq!(error.key, "temperature_k");
        }
    }

    #[test]
    fn loads_and_tangent_are_derivatives() {
        for (segment_nm, temperature_k) in
            [(5.0, 298.0), (10.0, 310.0), (30.0, 273.0), (100.0, 323.0)]
        {
            assert_derivatives(Homogenised::heated_rod(segment_nm, temperature_k).unwrap());
        }
    }
}
