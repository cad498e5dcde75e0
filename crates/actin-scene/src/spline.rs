//! Cubic spline through points.

use actin_mechanics::Vector3;

/// Condition at both ends of a spline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SplineEnds {
    /// No curvature at the ends.
    Natural,
    /// The outermost two pieces are one cubic; a spline through three points is a parabola.
    NotAKnot,
}

/// Cubic spline, parametrised by chord length.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    points: Vec<Vector3>,
    pub(crate) chords: Vec<f64>,
    /// Second derivatives at the points (1/nm).
    second: Vec<Vector3>,
}

impl Spline {
    /// Creates the spline through points (nm). Neighbours differ.
    pub fn new(points: &[Vector3], ends: SplineEnds) -> Self {
        let chords: Vec<f64> = points.windows(2).map(|p| (p[1] - p[0]).norm()).collect();
        Self {
            points: points.to_vec(),
            second: second_derivatives(points, &chords, ends),
            chords,
        }
    }

    /// Position (nm) and derivative with respect to chord length, at a fraction of chord `k`.
    ///
    /// # Panics
    /// If the index is out of range.
    pub fn at(&self, k: usize, share: f64) -> (Vector3, Vector3) {
        let h = self.chords[k];
        let (a, b) = (1.0 - share, share);
        let (from, to) = (self.points[k], self.points[k + 1]);
        let (m, n) = (self.second[k], self.second[k + 1]);
        let place = from * a + to * b + ((a * a * a - a) * m + (b * b * b - b) * n) * (h * h / 6.0);
        let slope =
            (to - from) / h + ((1.0 - 3.0 * a * a) * m + (3.0 * b * b - 1.0) * n) * (h / 6.0);
        (place, slope)
    }
}

/// Thomas algorithm for `h' m' + 2 (h' + h) m + h m'' = 6 (slope - slope')`.
///
/// The end values are zero, or `m + w (m - m'')` of the next two, with `w` the ratio of chords for one cubic.
fn second_derivatives(points: &[Vector3], chords: &[f64], ends: SplineEnds) -> Vec<Vector3> {
    let n = points.len();
    let slope = |i: usize| (points[i + 1] - points[i]) / chords[i];
    let is_free = ends == SplineEnds::NotAKnot && n > 2;
    let weight = |outer: f64, inner: f64| if n > 3 { outer / inner } else { 0.0 };
    let (mut above, mut right) = (vec![0.0; n], vec![Vector3::zeros(); n]);
    for i in 1..n - 1 {
        let (before, after) = (chords[i - 1], chords[i]);
        let (mut lower, mut middle, mut upper) = (before, 2.0 * (before + after), after);
        if is_free && i == 1 {
            middle += before * (1.0 + weight(before, after));
            upper -= before * weight(before, after);
        }
        if is_free && i == n - 2 {
            middle += after * (1.0 + weight(after, before));
            lower -= after * weight(after, before);
        }
        let pivot = middle - lower * above[i - 1];
        above[i] = upper / pivot;
        right[i] = (6.0 * (slope(i) - slope(i - 1)) - lower * right[i - 1]) / pivot;
    }
    let mut second = vec![Vector3::zeros(); n];
    for i in (1..n - 1).rev() {
        second[i] = right[i] - above[i] * second[i + 1];
    }
    if is_free {
        let [w, v] = [[0, 1], [n - 2, n - 3]].map(|[i, k]| weight(chords[i], chords[k]));
        second[0] = second[1] + (second[1] - second[2]) * w;
        second[n - 1] = second[n - 2] + (second[n - 2] - second[n - 3]) * v;
    }
    second
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A spline without knots next to the ends reproduces a cubic, and through three points a parabola.
    #[test]
    fn polynomials_are_exact() {
        let along = [0.0, 1.0, 2.5, 3.0, 4.5];
        // Nearly straight curves have their arc length as parameter up to the square of the slope.
        let height = |x: f64, cube: f64| 1e-6 * (x * x + cube * x * x * x);
        for (count, cube) in [(3, 0.0), (4, 1.0), (5, 1.0)] {
            let at = |x: f64| Vector3::new(height(x, cube), 0.0, x);
            let points: Vec<Vector3> = along[..count].iter().map(|&x| at(x)).collect();
            let spline = Spline::new(&points, SplineEnds::NotAKnot);
            for k in 0..count - 1 {
                let place = spline.at(k, 0.3).0;
                let error = (place - at(place.z)).norm();
                assert!(error < 1e-13, "{count} {k}: {error:e}");
            }
        }
    }
}
