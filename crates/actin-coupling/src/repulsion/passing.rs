use super::distance;
use actin_mechanics::Vector3;

pub(super) type Ends = [Vector3; 2];

/// Fraction of the initial distance below which lines that start within the limit count as
/// crossing.
const STAY: f64 = 0.99;
const CLOSE: f64 = 1e-3;
/// Maximum number of steps. Longer searches occur for lines that slide along each other.
const STEPS: usize = 10_000;

/// Returns `true` if two lines with uniformly moving ends come within `least` (nm). For lines that
/// start within `least`, the limit is `STAY` times the initial distance. Lines that start in
/// contact return `false`.
///
/// The distance of two lines changes at most as fast as their ends approach. Each step advances to
/// the earliest possible contact.
pub(super) fn comes_within(least: f64, from: [Ends; 2], to: [Ends; 2]) -> bool {
    let moved = [0, 1].map(|k| [to[k][0] - from[k][0], to[k][1] - from[k][1]]);
    let [a, b] = moved;
    let pairs = a.iter().flat_map(|a| b.iter().map(move |b| (a - b).norm()));
    let approach = pairs.fold(0.0, f64::max);
    let start = distance::between(from[0], from[1]).squared.sqrt();
    let least = least.min(STAY * start);
    let mut gone = (start - least) / approach;
    for _ in 0..STEPS {
        // This form excludes lines at rest and positions that are not numbers.
        let is_on_the_way = gone <= 1.0;
        if !is_on_the_way {
            return false;
        }
        let at = |k: usize| [0, 1].map(|end| from[k][end] + moved[k][end] * gone);
        let gap = distance::between(at(0), at(1)).squared.sqrt() - least;
        if gap <= CLOSE * least {
            return start > 0.0;
        }
        gone += gap / approach;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use actin_mechanics::Xorshift;

    #[test]
    fn finds_what_sampling_finds() {
        let mut noise = Xorshift::new(8);
        let mut random = |size: f64| Vector3::from_fn(|_, _| size * noise.sample());
        let (moments, least) = (2000_u32, 0.2_f64);
        let mut found = [0; 2];
        for _ in 0..400 {
            let from = [[random(1.0), random(1.0)], [random(1.0), random(1.0)]];
            let to = from.map(|ends| ends.map(|x| x + random(0.7)));
            let start = distance::between(from[0], from[1]).squared.sqrt();
            let kept = least.min(STAY * start);
            let sampled = (0..=moments).map(|k| {
                let share = f64::from(k) / f64::from(moments);
                let at = |k: usize| [0, 1].map(|e| from[k][e] + (to[k][e] - from[k][e]) * share);
                distance::between(at(0), at(1)).squared.sqrt()
            });
            let nearest = sampled.fold(f64::INFINITY, f64::min);
            let passes = comes_within(least, from, to);
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
