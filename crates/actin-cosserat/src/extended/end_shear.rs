//! Change of shear near the ends of a rod.

/// Effect of an end of a rod on shear and twist.
///
/// A filament shears because its strands slide. The sliding of a section extends over
/// `END_SHEAR_NM` into its neighbour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EndShear {
    /// Held section: removes `END_SHEAR_NM` of shear and adds
    /// `END_TWIST_NM` of twist.
    Blocked,
    /// No effect.
    #[default]
    Even,
    /// Free or pinned end, or a neighbour that blocks shear on its side: adds `END_SHEAR_NM` of
    /// shear.
    Loose,
}

/// Length over which an end changes shear (nm): two rises of actin, the length of a bond along a
/// strand.
///
/// # Source
/// Guided beams of the mean filament of 19 to 192 nm under a transverse force of 0.01 pN, averaged
/// over azimuths: 5.5, 5.6, 5.5, 5.4, 5.1, 4.6 nm for tensions of 1, 2, 5, 10, 20, 40 pN
/// (`docs/how-to/rod-laws.md`).
pub(crate) const END_SHEAR_NM: f64 = 5.477;

impl EndShear {
    fn sign(self) -> f64 {
        match self {
            Self::Blocked => -1.0,
            Self::Even => 0.0,
            Self::Loose => 1.0,
        }
    }
}

/// Factors of the shear strain of segments.
///
/// ```text
/// c(s) = (1 + a exp(-s/l)) (1 + b exp(-(L - s)/l))
/// ```
///
/// `c` is the relative shear compliance, `l` is [`END_SHEAR_NM`] and `L` the length. `a` and `b`
/// are -1 at blocked, 0 at even and 1 at loose ends. The factor is `1 / sqrt(c)` with the mean of
/// `c` over the segment, so small shear does not depend on the mesh. `beyond` (nm) are the
/// distances to the ends of the whole rod.
pub(super) fn factors(lengths: &[f64], ends: [EndShear; 2], beyond: [f64; 2]) -> Vec<f64> {
    let [a, b] = ends.map(EndShear::sign);
    let l = END_SHEAR_NM;
    let length = beyond[0] + lengths.iter().sum::<f64>() + beyond[1];
    // Integral of exp(-s/l).
    let faded = |from: f64, to: f64| l * ((-from / l).exp() - (-to / l).exp());
    let mut from = beyond[0];
    let factor = |own: &f64| {
        let to = from + own;
        let of_ends = a * faded(from, to) + b * faded(length - to, length - from);
        let mean = 1.0 + of_ends / own + a * b * (-length / l).exp();
        from = to;
        mean.powf(-0.5)
    };
    lengths.iter().map(factor).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_missing_and_added() {
        use EndShear::{Blocked, Even, Loose};
        let total = |lengths: &[f64], ends| -> f64 {
            let all = lengths.iter().zip(factors(lengths, ends, [0.0; 2]));
            all.map(|(length, factor)| length / (factor * factor)).sum()
        };
        for lengths in [
            vec![10.0; 12],
            vec![0.5; 240],
            vec![1.0, 9.0, 110.0],
            vec![120.0],
        ] {
            let missing = 120.0 - total(&lengths, [Blocked, Blocked]);
            assert!((missing - 2.0 * END_SHEAR_NM).abs() < 1e-6);
            assert!((total(&lengths, [Blocked, Loose]) - 120.0).abs() < 1e-6);
            let one = total(&lengths, [Even, Loose]) - 120.0;
            assert!((one - END_SHEAR_NM).abs() < 1e-6);
            let even = factors(&lengths, [Even; 2], [0.0; 2]);
            assert_eq!(even, vec![1.0; lengths.len()]);
        }
        let short = total(&[3.0, 5.0], [Blocked, Blocked]);
        assert!((total(&[8.0], [Blocked, Blocked]) / short - 1.0).abs() < 1e-12);
        assert!(short > 0.0);
    }

    #[test]
    fn ends_affect_adjacent_parts() {
        use EndShear::{Blocked, Loose};
        let lengths = [2.0, 3.0, 4.0, 6.0];
        let whole = factors(&lengths, [Blocked, Loose], [0.0; 2]);
        let first = factors(&lengths[..2], [Blocked, Loose], [0.0, 10.0]);
        let last = factors(&lengths[2..], [Blocked, Loose], [5.0, 0.0]);
        for (part, whole) in first.iter().chain(&last).zip(&whole) {
            assert!((part / whole - 1.0).abs() < 1e-14);
        }
    }
}
