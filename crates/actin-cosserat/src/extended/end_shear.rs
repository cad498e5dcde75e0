//! How much less, or more, segments shear near the ends of a rod.

/// What an end of a rod lets its sections do.
///
/// A filament shears as its strands slide along each other, which neighbouring sections share. Sections that
/// cannot slide hold back those beside them, and sections that miss neighbours give way: over
/// [`END_SHEAR_NM`], under the tension and the shear that were measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum EndShear {
    /// A section that is held: [`END_SHEAR_NM`] of shear are missing, and [`END_TWIST_NM`](super::END_TWIST_NM) of twist
    /// added.
    Blocked,
    /// Nothing changes.
    #[default]
    Even,
    /// A free or pinned end, or a neighbour that blocks shear on its own side: as much is added.
    Loose,
}

/// Length over which an end changes shear (nm): two rises of actin, the length of a bond along a strand.
///
/// # Source
/// Guided beams of 19 to 192 nm of the mean filament, over azimuths, under 0.01 pN across: 5.5, 5.6, 5.5, 5.4, 5.1,
/// 4.6 nm under 1, 2, 5, 10, 20, 40 pN of tension (`docs/homogenisation.md`).
pub const END_SHEAR_NM: f64 = 5.477;

impl EndShear {
    /// The part of the compliance of shear that is added right at the end.
    fn sign(self) -> f64 {
        match self {
            Self::Blocked => -1.0,
            Self::Even => 0.0,
            Self::Loose => 1.0,
        }
    }
}

/// By which factors segments count their shear.
///
/// The compliance of shear is `c(s) = (1 + a exp(-s/l)) (1 + b exp(-(L - s)/l))` times that far from ends, with `a` and
/// `b` -1 at blocked ends, 0 at even and 1 at loose ones, `l` [`END_SHEAR_NM`] and `L` the rod's length: `l` are missing, or
/// added, at each end. A segment takes the mean of `c` over its length, so that small shear does not depend on how a rod is
/// divided, and has the energy at `gamma / sqrt(c)`. The ends are those of the rod or, `beyond` (nm) its own, of rods that
/// it is continued by.
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

    /// Compliances in series: between blocked ends twice the length is missing, whatever the segments, beside a loose end
    /// as much is added as is missing at the other; the rest is 1 to the corrections of a finite length.
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

    /// A rod in parts is one rod: what an end does goes on in the next part.
    #[test]
    fn ends_reach_beyond_a_part() {
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
