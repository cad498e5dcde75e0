//! Centre lines as functions of arc length, for comparisons between resolutions.

use actin_mechanics::State;
use actin_sim::Assembly;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Position (nm) or direction in the lab frame.
type Triple = [f64; 3];

/// Spacing of the compared points (nm).
const SAMPLING_NM: f64 = 1.0;

/// Points of a centre line by ascending arc length.
#[derive(Clone, Debug, Deserialize, PartialEq, Serialize)]
pub(crate) struct CentreLine {
    s: Vec<f64>,
    places: Vec<Triple>,
    /// Tangents `dr/ds` at nodes of rods; `None` at monomers.
    tangents: Vec<Option<Triple>>,
}

impl CentreLine {
    pub(crate) fn new(assembly: &Assembly, state: &State) -> Self {
        let n = assembly.points.len();
        let s: Vec<f64> = assembly.points.iter().map(|p| p.s_nm).collect();
        let place = |i| assembly.centre_line_nm(state, i).into();
        let places: Vec<Triple> = (0..n).map(place).collect();
        let mut tangents = vec![None; n];
        for section in assembly.sections.iter().filter(|s| !s.is_ellipsoids()) {
            for i in section.points.clone() {
                tangents[i] = Some(tangent(&s, &places, &section.points, i));
            }
        }
        Self {
            s,
            places,
            tangents,
        }
    }

    pub(crate) fn points(&self) -> &[Triple] {
        &self.places
    }

    pub(super) fn arc_lengths(&self) -> &[f64] {
        &self.s
    }

    /// Position (nm) at arc length `s` (nm). Cubic Hermite interpolation between nodes of a rod avoids the error of the
    /// chord; interpolation is linear elsewhere.
    fn at(&self, s: f64) -> Triple {
        let after = self
            .s
            .partition_point(|&x| x < s)
            .clamp(1, self.s.len() - 1);
        let i = after - 1;
        let h = self.s[after] - self.s[i];
        let t = (s - self.s[i]) / h;
        let (a, b) = (self.places[i], self.places[after]);
        match (self.tangents[i], self.tangents[after]) {
            (Some(from), Some(to)) => {
                let (u, v) = (1.0 - t, t);
                let weights = [
                    u * u * (1.0 + 2.0 * t),
                    v * v * (3.0 - 2.0 * t),
                    u * u * t * h,
                    -(v * v * u * h),
                ];
                sum(weights, [a, b, from, to])
            }
            _ => sum([1.0 - t, t], [a, b]),
        }
    }

    /// Largest distance to `other` at equal arc length (nm), and its arc length (nm).
    pub(crate) fn farthest_from(&self, other: &Self) -> (f64, f64) {
        let ends = |line: &Self| (line.s[0], line.s[line.s.len() - 1]);
        let ((a, b), (c, d)) = (ends(self), ends(other));
        let (from, to) = (a.max(c), b.min(d));
        let mut worst = (0.0, from);
        let mut s = from;
        while s <= to {
            let distance = norm(sum([1.0, -1.0], [self.at(s), other.at(s)]));
            if distance > worst.0 {
                worst = (distance, s);
            }
            s += SAMPLING_NM;
        }
        worst
    }
}

/// Slope at node `i` of the parabola through three neighbouring nodes of equal spacing. Two nodes give the chord.
fn tangent(s: &[f64], places: &[Triple], nodes: &Range<usize>, i: usize) -> Triple {
    if nodes.len() < 3 {
        let (first, last) = (nodes.start, nodes.end - 1);
        let h = s[last] - s[first];
        return sum([-1.0 / h, 1.0 / h], [places[first], places[last]]);
    }
    let middle = i.clamp(nodes.start + 1, nodes.end - 2);
    let h = s[middle + 1] - s[middle];
    let x = (s[i] - s[middle]) / h;
    let weights = [(x - 0.5) / h, -2.0 * x / h, (x + 0.5) / h];
    let [before, here, after] = [middle - 1, middle, middle + 1].map(|k| places[k]);
    sum(weights, [before, here, after])
}

fn sum<const N: usize>(weights: [f64; N], triples: [Triple; N]) -> Triple {
    let pairs = || weights.iter().zip(&triples);
    [0, 1, 2].map(|k| pairs().map(|(w, triple)| w * triple[k]).sum())
}

fn norm([x, y, z]: Triple) -> f64 {
    (x * x + y * y + z * z).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parabola(h: f64, nodes: usize) -> CentreLine {
        let s: Vec<f64> = (0..nodes).map(|k| k as f64 * h).collect();
        let place = |&s: &f64| [0.01 * s * s, 0.0, s];
        let places: Vec<Triple> = s.iter().map(place).collect();
        let all = 0..nodes;
        let tangents = all.clone().map(|i| Some(tangent(&s, &places, &all, i)));
        let tangents = tangents.collect();
        CentreLine {
            s,
            places,
            tangents,
        }
    }

    #[test]
    fn meshes_of_one_curve_have_zero_distance() {
        let (apart, _) = parabola(10.0, 7).farthest_from(&parabola(4.0, 16));
        // Round-off at coordinates of 60 nm. Linear interpolation would give 0.02 * 100 / 8 = 0.25 nm.
        assert!(apart < 1e-12, "{apart:e}");
    }

    #[test]
    fn largest_distance_is_located() {
        let mut bulged = parabola(10.0, 7);
        bulged.places[3][1] = 2.0;
        let (apart, s) = parabola(10.0, 7).farthest_from(&bulged);
        assert!((apart - 2.0).abs() < 1e-12, "{apart}");
        // Lines are compared every nanometre, which includes node 3.
        assert!((s - 30.0).abs() < 1e-9, "{s}");
    }
}
