//! Natural cubic splines through values at given nodes.

use crate::{RodKey, RodParameterError};

/// A natural cubic spline: two continuous derivatives, straight beyond its ends.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Spline {
    nodes: Vec<f64>,
    values: Vec<f64>,
    /// Second derivatives at the nodes.
    bends: Vec<f64>,
}

impl Spline {
    /// The spline through one value for each node.
    pub(crate) fn new(nodes: &[f64], values: &[f64]) -> Result<Self, RodParameterError> {
        let error = |value: f64, rule| RodParameterError {
            key: RodKey::Twist,
            value,
            rule,
        };
        if nodes.len() < 3 || nodes.len() != values.len() {
            let count = nodes.len() as f64;
            return Err(error(count, "at least three, as many as there are values"));
        }
        let is_bad = |pair: &&[f64]| !(pair[1] - pair[0]).is_finite() || pair[1] <= pair[0];
        if let Some(pair) = nodes.windows(2).find(is_bad) {
            return Err(error(pair[1], "finite and above the one before it"));
        }
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(RodParameterError {
                key: RodKey::Coefficient,
                value: *value,
                rule: "finite",
            });
        }
        Ok(Self {
            nodes: nodes.to_vec(),
            values: values.to_vec(),
            bends: bends(nodes, values),
        })
    }

    /// First and last node.
    pub(crate) fn range(&self) -> [f64; 2] {
        [self.nodes[0], self.nodes[self.nodes.len() - 1]]
    }

    /// Value, first and second derivative at `x`.
    #[inline]
    pub(crate) fn jet(&self, x: f64) -> [f64; 3] {
        let [first, last] = self.range();
        let inside = x.clamp(first, last);
        let k = self.nodes.partition_point(|node| *node <= inside);
        let k = k.clamp(1, self.nodes.len() - 1) - 1;
        let width = self.nodes[k + 1] - self.nodes[k];
        let (b, a) = (
            (inside - self.nodes[k]) / width,
            (self.nodes[k + 1] - inside) / width,
        );
        let (v, m) = (&self.values[k..k + 2], &self.bends[k..k + 2]);
        let sixth = width * width / 6.0;
        let value = a * v[0] + b * v[1] + sixth * ((a * a * a - a) * m[0] + (b * b * b - b) * m[1]);
        let slope = (v[1] - v[0]) / width
            + width / 6.0 * ((1.0 - 3.0 * a * a) * m[0] + (3.0 * b * b - 1.0) * m[1]);
        // No bend is left at the ends, so that the straight continuation joins smoothly.
        [value + slope * (x - inside), slope, a * m[0] + b * m[1]]
    }
}

/// Second derivatives at the nodes, zero at both ends: a symmetric tridiagonal system, solved by
/// elimination.
fn bends(nodes: &[f64], values: &[f64]) -> Vec<f64> {
    let n = nodes.len();
    let width = |k: usize| nodes[k + 1] - nodes[k];
    let slope = |k: usize| (values[k + 1] - values[k]) / width(k);
    let mut diagonal = vec![1.0; n];
    let mut bends = vec![0.0; n];
    for k in 1..n - 1 {
        diagonal[k] = 2.0 * (width(k - 1) + width(k));
        bends[k] = 6.0 * (slope(k) - slope(k - 1));
        if k > 1 {
            let factor = width(k - 1) / diagonal[k - 1];
            diagonal[k] -= factor * width(k - 1);
            bends[k] -= factor * bends[k - 1];
        }
    }
    for k in (1..n - 1).rev() {
        bends[k] = (bends[k] - width(k) * bends[k + 1]) / diagonal[k];
    }
    bends
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Worked out by hand: values 0, 1, 0 at 0, 1, 2 have the bend -3 in the middle, and the value
    /// 0.6875 and the slope 1.125 at 0.5.
    #[test]
    fn three_nodes_by_hand() {
        let spline = Spline::new(&[0.0, 1.0, 2.0], &[0.0, 1.0, 0.0]).unwrap();
        let [value, slope, bend] = spline.jet(0.5);
        assert!((value - 0.6875).abs() < 1e-15 && (slope - 1.125).abs() < 1e-15);
        assert!((bend + 1.5).abs() < 1e-15);
        assert!((spline.jet(1.0)[2] + 3.0).abs() < 1e-15);
    }

    /// Values, slopes and bends are continuous at nodes and at the ends.
    #[test]
    fn splines_are_smooth() {
        let nodes = [-2.0, -0.5, 0.0, 1.0, 4.0];
        let spline = Spline::new(&nodes, &[1.0, -2.0, 0.5, 0.0, 3.0]).unwrap();
        for node in nodes {
            let (below, above) = (spline.jet(node - 1e-9), spline.jet(node + 1e-9));
            for (a, b) in below.into_iter().zip(above) {
                // Third derivatives are below 40.
                assert!((a - b).abs() < 1e-7, "{node}");
            }
        }
        assert!((spline.jet(6.0)[0] - spline.jet(4.0)[0] - 2.0 * spline.jet(4.0)[1]).abs() < 1e-14);
    }

    #[test]
    fn bad_nodes_are_refused() {
        for nodes in [
            vec![0.0, 1.0],
            vec![0.0, 1.0, 1.0],
            vec![0.0, f64::NAN, 1.0],
        ] {
            let refused = Spline::new(&nodes, &vec![0.0; nodes.len()]).unwrap_err();
            assert_eq!(refused.key, RodKey::Twist);
        }
        let refused = Spline::new(&[0.0, 1.0, 2.0], &[0.0, f64::NAN, 1.0]).unwrap_err();
        assert_eq!(refused.key, RodKey::Coefficient);
    }
}
