//! Orders of convergence, and roots by bisection.

/// Asserts second-order convergence on successively halved meshes, within `slack` of the order.
/// Returns the limit by Richardson extrapolation, relative to `exact`.
pub(crate) fn second_order_limit(what: &str, values: [f64; 3], exact: f64, slack: f64) -> f64 {
    let errors = values.map(|value| value / exact - 1.0);
    let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(|r| r.abs().log2());
    let limit = (4.0 * values[2] - values[1]) / 3.0 / exact - 1.0;
    println!(
        "{what}: errors {:.2e} {:.2e} {:.2e}, orders {:.3} {:.3}, extrapolated {limit:.1e}",
        errors[0], errors[1], errors[2], orders[0], orders[1]
    );
    for order in orders {
        assert!((order - 2.0).abs() < slack, "{what}: orders {orders:?}");
    }
    limit
}

/// Bisection between two positive bounds for the value at which `holds` becomes true, to a relative
/// `precision`.
pub(crate) fn bisect(
    mut holds: impl FnMut(f64) -> bool,
    [mut low, mut high]: [f64; 2],
    precision: f64,
) -> f64 {
    assert!(!holds(low), "it holds at {low}");
    assert!(holds(high), "it does not hold at {high}");
    while high - low > precision * high {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}
