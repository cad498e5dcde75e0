//! The Pareto front of cost and error.

/// Which of the points `(cost, error)` no other one dominates: none has less or equal of both and
/// less of one.
pub(crate) fn front(points: &[(f64, f64)]) -> Vec<bool> {
    let dominates =
        |a: &(f64, f64), b: &(f64, f64)| a.0 <= b.0 && a.1 <= b.1 && (a.0 < b.0 || a.1 < b.1);
    let is_free = |point| !points.iter().any(|other| dominates(other, point));
    points.iter().map(is_free).collect()
}

#[cfg(test)]
mod tests {
    use super::front;
    use proptest::prelude::*;

    /// A chain of three, one behind them, and two equals, neither of which dominates the other.
    #[test]
    fn what_is_dominated_is_not_on_the_front() {
        let points = [(1.0, 3.0), (2.0, 2.0), (3.0, 1.0), (3.0, 2.0), (1.0, 3.0)];
        assert_eq!(front(&points), [true, true, true, false, true]);
    }

    proptest! {
        /// No point of the front is dominated, and whatever is off it is dominated by a point on it.
        #[test]
        fn the_front_is_non_dominated(points in prop::collection::vec((0_u8..20, 0_u8..20), 1..40)) {
            let points: Vec<(f64, f64)> =
                points.into_iter().map(|(a, b)| (f64::from(a), f64::from(b))).collect();
            let on = front(&points);
            let below = |a: (f64, f64), b: (f64, f64)| a != b && a.0 <= b.0 && a.1 <= b.1;
            for (i, &point) in points.iter().enumerate() {
                let by_front = (0..points.len()).any(|k| on[k] && below(points[k], point));
                prop_assert_eq!(on[i], !by_front);
            }
        }
    }
}
