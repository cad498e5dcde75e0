//! Segments of a rod at which a defect is looked at: few where it is nearly linear between them. Nothing here about
//! what the defect is.

use nalgebra::SVector;

/// Segments of a long rod that are looked at first.
const FIRST: usize = 5;
/// Most segments that are looked at.
const MOST: usize = 16;
/// A rod of more segments is a long one. Along a shorter one loads change so much that each look needs the one beside it.
const SHORT: usize = 2 * MOST;
/// What may be missed between them: share of the error.
const MISSED: f64 = 0.01;

/// A strain in body axes, then an energy per length: of a stretch, or of one beyond another.
pub(super) type Defect = SVector<f64, 7>;

/// A segment that has been looked at.
pub(super) struct Known {
    index: usize,
    s_nm: f64,
    defect: Defect,
}

/// The segments of a rod in order.
pub(super) struct Segments {
    /// Arc lengths of their middles (nm).
    pub s_nm: Vec<f64>,
    /// What a defect of each makes of the wanted number.
    pub weights: Vec<Defect>,
    /// How much of the number comes from each, about.
    pub shares: Vec<f64>,
}

impl Segments {
    /// What each makes of the number, whose value is given with the share of it that may be missed: its defect is looked at, or is
    /// linear between two known ones.
    ///
    /// Both ends are known, and segments between which about the same shares lie. Then the gap is halved that misses
    /// most, by what a parabola through three known ones differs from the line between two, until all gaps together
    /// miss little. None where a look fails.
    pub(super) fn errors(
        &self,
        (value, missed): (f64, f64),
        mut look: impl FnMut(usize) -> Option<Defect>,
    ) -> Option<Vec<f64>> {
        let mut known = Vec::new();
        let is_short = self.s_nm.len() <= SHORT;
        for i in spread(&self.shares, if is_short { MOST } else { FIRST }) {
            self.add(i, &mut known, &mut look)?;
        }
        loop {
            let errors: Vec<f64> = (0..self.s_nm.len())
                .map(|i| self.error(&known, i))
                .collect();
            let error = errors.iter().sum::<f64>();
            let gaps: Vec<f64> = (1..known.len()).map(|k| self.missed(&known, k)).collect();
            let allowed = (MISSED * error.abs()).max(missed * value.abs());
            if known.len() >= MOST || gaps.iter().sum::<f64>() <= allowed {
                return Some(errors);
            }
            let most = (0..gaps.len()).max_by(|&a, &b| gaps[a].total_cmp(&gaps[b]))?;
            let i = self.middle(known[most].index, known[most + 1].index);
            self.add(i, &mut known, &mut look)?;
        }
    }

    /// Looks at one more.
    fn add(
        &self,
        index: usize,
        known: &mut Vec<Known>,
        look: &mut impl FnMut(usize) -> Option<Defect>,
    ) -> Option<()> {
        let defect = look(index)?;
        let place = known.partition_point(|one| one.index < index);
        let one = Known {
            index,
            s_nm: self.s_nm[index],
            defect,
        };
        known.insert(place, one);
        Some(())
    }

    fn error(&self, known: &[Known], index: usize) -> f64 {
        self.weights[index].dot(&interpolated(known, self.s_nm[index]))
    }

    /// What the line between known segments `k - 1` and `k` may miss.
    fn missed(&self, known: &[Known], k: usize) -> f64 {
        let (a, b) = (&known[k - 1], &known[k]);
        let by = |bend: Defect| -> f64 {
            let inside = a.index + 1..b.index;
            let of = |i: usize| {
                let s_nm = self.s_nm[i];
                let parabola = bend * ((s_nm - a.s_nm) * (s_nm - b.s_nm));
                self.weights[i].dot(&parabola).abs()
            };
            inside.map(of).sum()
        };
        let before = k.checked_sub(2).map(|p| by(bend([&known[p], a, b])));
        let behind = known.get(k + 1).map(|q| by(bend([a, b, q])));
        before.into_iter().chain(behind).fold(0.0, f64::max)
    }

    /// The segment between two others with about the same shares to both sides.
    fn middle(&self, from: usize, to: usize) -> usize {
        let inside = &self.shares[from + 1..to];
        let even = self.shares.iter().sum::<f64>() / self.shares.len() as f64;
        let half = 0.5 * inside.iter().map(|share| share + even).sum::<f64>();
        let mut sum = 0.0;
        let before = inside.iter().take_while(|share| {
            sum += *share + even;
            sum < half
        });
        (from + 1 + before.count()).min(to - 1)
    }
}

/// The second divided difference through three known ones.
fn bend([a, b, c]: [&Known; 3]) -> Defect {
    let slope = |a: &Known, b: &Known| (b.defect - a.defect) / (b.s_nm - a.s_nm);
    (slope(b, c) - slope(a, b)) / (c.s_nm - a.s_nm)
}

/// At most `n` indices, ascending and with both ends, between which about the same sums of `shares` lie.
fn spread(shares: &[f64], n: usize) -> Vec<usize> {
    if shares.len() <= n {
        return (0..shares.len()).collect();
    }
    if shares.iter().sum::<f64>() <= 0.0 {
        return spread(&vec![1.0; shares.len()], n);
    }
    // A part that does not depend on the shares keeps gaps bounded.
    let even = shares.iter().sum::<f64>() / shares.len() as f64;
    let total = shares.iter().map(|share| share + even).sum::<f64>();
    let mut chosen = vec![0];
    let mut sum = 0.0;
    for (i, share) in shares.iter().enumerate() {
        sum += share + even;
        if sum >= total * chosen.len() as f64 / (n - 1) as f64 && i > 0 {
            chosen.push(i);
        }
    }
    let last = shares.len() - 1;
    if *chosen.last().expect("the first") != last {
        chosen.push(last);
    }
    chosen
}

/// Linear between the two known values about a place.
fn interpolated(known: &[Known], s_nm: f64) -> Defect {
    if known.len() == 1 {
        return known[0].defect;
    }
    let after = known
        .partition_point(|one| one.s_nm < s_nm)
        .clamp(1, known.len() - 1);
    let (a, b) = (&known[after - 1], &known[after]);
    let t = ((s_nm - a.s_nm) / (b.s_nm - a.s_nm)).clamp(0.0, 1.0);
    a.defect * (1.0 - t) + b.defect * t
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where all comes from one place, samples crowd there; both ends are among them.
    #[test]
    fn samples_follow_the_shares() {
        assert_eq!(spread(&[1.0; 5], 8), [0, 1, 2, 3, 4]);
        let mut shares = vec![0.0; 100];
        shares[..10].fill(1.0);
        let chosen = spread(&shares, 11);
        assert_eq!((chosen[0], *chosen.last().unwrap()), (0, 99));
        assert!(chosen.len() <= 12, "{chosen:?}");
        let crowded = chosen.iter().filter(|&&i| i < 10).count();
        assert!(crowded >= 5, "{chosen:?}");
    }

    /// A hundred segments of 1 nm with the weight 1 for the first component of a defect.
    fn segments() -> Segments {
        let mut weight = Defect::zeros();
        weight[0] = 1.0;
        Segments {
            s_nm: (0..100).map(|i| f64::from(i) + 0.5).collect(),
            weights: vec![weight; 100],
            shares: vec![1.0; 100],
        }
    }

    /// The sum of errors for a defect of one component, and what was looked at.
    fn looked_at(defect: impl Fn(f64) -> f64) -> (f64, Vec<usize>) {
        let (segments, mut places) = (segments(), Vec::new());
        let errors = segments.errors((0.0, 0.0), |i| {
            places.push(i);
            Some(Defect::ith(0, defect(segments.s_nm[i])))
        });
        (errors.unwrap().iter().sum(), places)
    }

    /// What is linear is known from the first looks; what bends at one place is looked at there, with the most looks
    /// that there are at most, and is known to the share that may be missed.
    #[test]
    fn looks_crowd_where_a_defect_bends() {
        let (sum, places) = looked_at(|s_nm| 2.0 * s_nm);
        assert!((sum - 1e4).abs() < 1e-9, "{sum}");
        assert!(places.len() <= FIRST + 1, "{places:?}");
        let steep = |s_nm: f64| (-s_nm / 10.0).exp();
        let (sum, places) = looked_at(steep);
        let all: f64 = segments().s_nm.into_iter().map(steep).sum();
        assert!((sum - all).abs() < MISSED * all, "{sum} {all}");
        assert!(places.len() <= MOST, "{places:?}");
        let near = places[FIRST..].iter().filter(|&&i| i < 50).count();
        assert!(2 * near > places.len() - FIRST, "{places:?}");
    }
}
