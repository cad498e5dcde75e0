use actin_mechanics::{Vector3, segments};

pub(super) type Ends = [Vector3; 2];

/// Limit of the distance of two lines.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limit {
    /// Least distance (nm) of lines that start beyond it.
    pub(super) least: f64,
    /// Least fraction of the initial distance of other lines.
    pub(super) kept: f64,
}

const CLOSE: f64 = 1e-3;
/// Maximum number of steps. Longer searches occur for lines that slide along each other.
const STEPS: usize = 10_000;

/// Fraction of the motion after which two lines with uniformly moving ends reach a limit, or
/// `None`. Lines that start at distance zero return `None`.
///
/// The distance of two lines changes at most as fast as their ends approach. Each step advances to
/// the earliest possible contact.
pub(super) fn reaches(limit: Limit, from: [Ends; 2], to: [Ends; 2]) -> Option<f64> {
    let moved = [0, 1].map(|k| [to[k][0] - from[k][0], to[k][1] - from[k][1]]);
    let [a, b] = moved;
    let pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a - b).norm()));
    let approach = pairs.fold(0.0, f64::max);
    let start = segments::nearest_points(from[0], from[1]).squared.sqrt();
    let least = limit.least.min(limit.kept * start);
    let mut gone = (start - least) / approach;
    for _ in 0..STEPS {
        // This form excludes lines at rest and positions that are not numbers.
        let is_on_the_way = gone <= 1.0;
        if !is_on_the_way {
            return None;
        }
        let at = |k: usize| [0, 1].map(|end| from[k][end] + moved[k][end] * gone);
        let gap = segments::nearest_points(at(0), at(1)).squared.sqrt() - least;
        if gap <= CLOSE * least {
            return (start > 0.0).then_some(gone);
        }
        gone += gap / approach;
    }
    Some(gone)
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::Xorshift;

    fn limit(least: f64) -> Limit {
        Limit { least, kept: 0.99 }
    }

    #[test]
    fn finds_what_sampling_finds() {
        let mut noise = Xorshift::new(8);
        let mut random = |size: f64| Vector3::from_fn(|_, _| size * noise.sample());
        let (moments, least) = (2000_u32, 0.2_f64);
        let mut found = [0; 2];
        for _ in 0..400 {
            let from = [[random(1.0), random(1.0)], [random(1.0), random(1.0)]];
            let to = from.map(|ends| ends.map(|x| x + random(0.7)));
            let start = segments::nearest_points(from[0], from[1]).squared.sqrt();
            let kept = least.min(0.99 * start);
            let sampled = (0..=moments).map(|k| {
                let share = f64::from(k) / f64::from(moments);
                let at = |k: usize| [0, 1].map(|e| from[k][e] + (to[k][e] - from[k][e]) * share);
                segments::nearest_points(at(0), at(1)).squared.sqrt()
            });
            let nearest = sampled.fold(f64::INFINITY, f64::min);
            let passes = reaches(limit(least), from, to).is_some();
            found[usize::from(passes)] += 1;
            let between = 4.0 / f64::from(moments);
            assert!(nearest >= kept || passes, "{nearest} is not found");
            assert!(
                !passes || nearest < kept * (1.0 + CLOSE) + between,
                "{nearest} is found"
            );
        }
        assert!(found.iter().all(|&n| n > 40), "{found:?}");
    }

    #[test]
    fn finds_a_crossing_within_one_step() {
        let comes_within = |least, from, to| reaches(limit(least), from, to).is_some();
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let still = [-x, x];
        let above = [z - y, z + y];
        let below = above.map(|end| end - 2.0 * z);
        assert!(comes_within(0.1, [still, above], [still, below]));
        // Past the end, along the line, and at rest.
        let aside = |ends: Ends, by: f64| ends.map(|end| end + by * x);
        assert!(!comes_within(
            0.1,
            [still, aside(above, 1.2)],
            [still, aside(below, 1.2)]
        ));
        assert!(!comes_within(
            0.1,
            [still, above],
            [aside(still, 0.5), above]
        ));
        assert!(!comes_within(0.1, [still, above], [still, above]));
        // Lines within the limit may separate.
        let near = above.map(|end| end - 0.95 * z);
        assert!(!comes_within(0.1, [still, near], [still, above]));
        assert!(comes_within(0.1, [still, near], [still, below]));
    }
}
