//! Random designs, reproducible from their seed.

use crate::sweep::{Plan, Scale, Span};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

pub(crate) fn points(number: usize, seed: u64, plan: Plan, over: &[Span]) -> Vec<Vec<String>> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let columns: Vec<Vec<String>> = over
        .iter()
        .map(|span| {
            let shares = match plan {
                Plan::Independent => (0..number).map(|_| random.random()).collect(),
                Plan::LatinHypercube => stratified(number, &mut random),
            };
            shares.into_iter().map(|share| span.at(share)).collect()
        })
        .collect();
    (0..number)
        .map(|point| columns.iter().map(|column| column[point].clone()).collect())
        .collect()
}

/// Draws one number in each of `number` equal parts of the unit interval, in random order.
fn stratified(number: usize, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut parts: Vec<usize> = (0..number).collect();
    // Fisher-Yates shuffle.
    for last in (1..number).rev() {
        parts.swap(last, random.random_range(0..=last));
    }
    parts
        .into_iter()
        .map(|part| (part as f64 + random.random::<f64>()) / number as f64)
        .collect()
}

impl Span {
    fn at(&self, share: f64) -> String {
        let number = between((self.from, self.to), self.scale, share);
        if self.whole {
            format!("{:.0}", number.round() + 0.0)
        } else {
            format!("{number:?}")
        }
    }
}

pub(crate) fn between((from, to): (f64, f64), scale: Scale, share: f64) -> f64 {
    if share <= 0.0 {
        return from;
    }
    if share >= 1.0 {
        return to;
    }
    match scale {
        Scale::Linear => from + (to - from) * share,
        Scale::Logarithmic => from * (to / from).powf(share),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn span(scale: Scale, whole: bool) -> Span {
        Span {
            key: "a".into(),
            from: 1.0,
            to: 100.0,
            scale,
            whole,
        }
    }

    fn drawn(number: usize, seed: u64, plan: Plan, over: &[Span]) -> Vec<Vec<f64>> {
        let points = points(number, seed, plan, over);
        let number = |text: &String| text.parse().unwrap();
        points
            .iter()
            .map(|p| p.iter().map(number).collect())
            .collect()
    }

    #[test]
    fn a_latin_hypercube_has_one_point_in_each_part() {
        let over = [span(Scale::Linear, false), span(Scale::Logarithmic, false)];
        let points = drawn(10, 7, Plan::LatinHypercube, &over);
        let part = |k: usize, value: f64| match k {
            0 => (value - 1.0) / 9.9,
            _ => value.log10() * 5.0,
        };
        let orders = [0, 1].map(|k| {
            let parts: Vec<f64> = points.iter().map(|p| part(k, p[k]).floor()).collect();
            let mut sorted = parts.clone();
            sorted.sort_by(f64::total_cmp);
            assert_eq!(sorted, (0..10).map(f64::from).collect::<Vec<_>>());
            parts
        });
        assert_ne!(orders[0], orders[1]);
        assert_eq!(points, drawn(10, 7, Plan::LatinHypercube, &over));
        assert_ne!(points, drawn(10, 8, Plan::LatinHypercube, &over));
    }

    #[test]
    fn independent_points_lie_in_the_span() {
        let points = drawn(500, 1, Plan::Independent, &[span(Scale::Linear, true)]);
        let numbers: Vec<f64> = points.into_iter().map(|p| p[0]).collect();
        assert!(
            numbers
                .iter()
                .all(|n| (1.0..=100.0).contains(n) && n.fract() == 0.0)
        );
        let mean = numbers.iter().sum::<f64>() / 500.0;
        // Five standard errors of the mean of a uniform distribution.
        assert!(
            (mean - 50.5).abs() < 5.0 * 99.0 / 12.0_f64.sqrt() / 500.0_f64.sqrt(),
            "{mean}"
        );
    }
}
