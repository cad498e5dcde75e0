//! Lengths of segments that leave as little of an error as halving all of them would, with fewer segments.

use super::halving::{LEFT_BY_HALVING, Share};
use super::stretch::{RodStretch, joined};

/// How often a stretch is halved at once.
const MOST_HALVINGS: i32 = 2;
/// Most that neighbouring segments differ in length, as a factor.
const STEEPEST: f64 = 4.0;
/// Round-off of such a factor.
const ROUND_OFF: f64 = 1e-6;
/// At most this share of the segments that halving all takes is worth sections of their own.
const WORTH: f64 = 0.8;

/// A stretch with how often its segments are halved; doubled, where that is negative.
#[derive(Clone, Copy)]
struct Graded {
    share: Share,
    halvings: i32,
}

impl Graded {
    /// With segments of twice the length, where these are whole and no longer than may be (nm).
    fn longest(share: Share, longest_nm: f64) -> Self {
        let may = share.stretch.segments.is_multiple_of(2)
            && 2.0 * share.stretch.segment_nm() <= longest_nm * (1.0 + ROUND_OFF);
        Self {
            share,
            halvings: if may { -1 } else { 0 },
        }
    }

    /// Segments per segment now, one length over the other.
    fn factor(&self) -> f64 {
        2f64.powi(self.halvings)
    }

    fn segments(&self) -> f64 {
        self.share.stretch.segments as f64 * self.factor()
    }

    fn segment_nm(&self) -> f64 {
        self.share.stretch.segment_nm() / self.factor()
    }

    /// The size of the error that it has then.
    fn left(&self) -> f64 {
        self.share.error.abs() * LEFT_BY_HALVING.powi(self.halvings)
    }

    fn halved(&self) -> Self {
        Self {
            halvings: self.halvings + 1,
            ..*self
        }
    }

    /// Error that halving takes away, per segment that it adds.
    fn gain(&self) -> f64 {
        (self.left() - self.halved().left()) / self.segments()
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small whole number of segments, even where it is doubled"
    )]
    fn stretch(&self) -> RodStretch {
        RodStretch {
            segments: self.segments().round() as usize,
            ..self.share.stretch
        }
    }
}

/// Stretches with segments between a shortest and a longest length (nm), marked in bulk: all are doubled that may be, then
/// those halved that give most of the error for a segment, until as much is left as halving all would leave.
///
/// Sizes of errors are added, of what is left: errors that cancel now need not do so afterwards. None where it
/// takes about as many segments as halving all.
pub(super) fn graded(
    shares: &[Share],
    [shortest_nm, longest_nm]: [f64; 2],
) -> Option<Vec<RodStretch>> {
    let most_left = LEFT_BY_HALVING * shares.iter().map(|share| share.error).sum::<f64>().abs();
    let longest = shares
        .iter()
        .map(|&share| Graded::longest(share, longest_nm));
    let mut all: Vec<Graded> = longest.collect();
    while left(&all) > most_left {
        let may =
            |one: &&mut Graded| one.halvings < MOST_HALVINGS && one.segment_nm() > shortest_nm;
        let open = all.iter_mut().filter(may);
        let best = open.max_by(|a, b| a.gain().total_cmp(&b.gain()))?;
        *best = best.halved();
    }
    even_out(&mut all);
    let now = shares.iter().map(|share| share.stretch.segments as f64);
    let worth = WORTH * 2.0 * now.sum::<f64>();
    let needed = all.iter().map(Graded::segments).sum::<f64>();
    (needed <= worth).then(|| joined(all.iter().map(Graded::stretch)))
}

fn left(all: &[Graded]) -> f64 {
    all.iter().map(Graded::left).sum()
}

/// Halves what is too long beside its neighbours.
fn even_out(all: &mut [Graded]) {
    while let Some(i) = (0..all.len()).find(|&i| is_too_long(all, i)) {
        all[i] = all[i].halved();
    }
}

/// Whether the segments of a stretch are much longer than those of a neighbour.
fn is_too_long(all: &[Graded], i: usize) -> bool {
    let beside = [i.checked_sub(1), Some(i + 1)];
    let beside = beside.into_iter().flatten().filter_map(|k| all.get(k));
    beside
        .map(Graded::segment_nm)
        .any(|next| all[i].segment_nm() > STEEPEST * next * (1.0 + ROUND_OFF))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stretches of 40 nm with segments of 20 nm.
    fn shares(errors: &[f64]) -> Vec<Share> {
        let share = |(k, &error): (usize, &f64)| Share {
            stretch: RodStretch {
                from_nm: 40.0 * k as f64,
                to_nm: 40.0 * (k + 1) as f64,
                segments: 2,
            },
            error,
        };
        errors.iter().enumerate().map(share).collect()
    }

    const BOUNDS_NM: [f64; 2] = [2.5, 20.0];

    fn segments(all: &[RodStretch]) -> usize {
        all.iter().map(|stretch| stretch.segments).sum()
    }

    /// Where every stretch gives as much, nothing is better than halving all.
    #[test]
    fn even_errors_are_halved_everywhere() {
        assert_eq!(graded(&shares(&[1.0; 6]), BOUNDS_NM), None);
    }

    /// An error of one place: segments of a quarter there leave a sixteenth, and the rest stays.
    #[test]
    fn an_error_of_one_place_is_halved_there() {
        let all = graded(&shares(&[0.01, 0.01, 1.0, 0.01, 0.01]), BOUNDS_NM).unwrap();
        let lengths: Vec<f64> = all.iter().map(RodStretch::segment_nm).collect();
        assert_eq!(lengths, [20.0, 5.0, 20.0]);
        assert_eq!(segments(&all), 16);
        assert_eq!((all[1].from_nm, all[1].to_nm), (80.0, 120.0));
    }

    /// Errors of both signs that cancel leave nothing to refine for; the whole is halved instead.
    #[test]
    fn errors_that_cancel_are_not_relied_on() {
        assert_eq!(graded(&shares(&[1.0, -1.0, 1.0, -0.9]), BOUNDS_NM), None);
    }

    /// Short segments that give nothing are doubled, to no more than four times those beside them; not to more than the
    /// longest.
    #[test]
    fn what_gives_nothing_is_coarsened() {
        let mut short = shares(&[1.0, 1e-9, 1e-9, 1e-9]);
        for share in &mut short {
            share.stretch.segments = 8;
        }
        let all = graded(&short, [0.5, 20.0]).unwrap();
        let lengths: Vec<f64> = all.iter().map(RodStretch::segment_nm).collect();
        assert_eq!(lengths, [1.25, 5.0, 10.0]);
        // Where none may be longer it takes 56 segments, against 64.
        assert_eq!(graded(&short, [0.5, 5.0]), None);
    }
}
