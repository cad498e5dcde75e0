//! Distances of line segments.

use crate::Vector3;

/// Nearest points of two line segments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearestPoints {
    /// Squared distance.
    pub squared: f64,
    /// Relative positions along the segments, from 0 to 1.
    pub shares: [f64; 2],
}

/// Relative position of the point of a line segment nearest to `x`, and the squared distance.
pub fn nearest_to_point([start, end]: [Vector3; 2], x: Vector3) -> (f64, f64) {
    let along = end - start;
    let length2 = along.norm_squared();
    let share = if length2 > 0.0 {
        ((x - start).dot(&along) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (share, (start + along * share - x).norm_squared())
}

/// Nearest points of two line segments: an end of one of them, or the feet of the common
/// perpendicular.
///
/// ```text
/// (b e - c d) / (a c - b^2),   (a e - b d) / (a c - b^2)
/// ```
///
/// These are the relative positions of the feet, with `a = u.u`, `b = u.v`, `c = v.v`, `d = u.w`
/// and `e = v.w` for the direction vectors `u`, `v` and the vector `w` from the second to the first
/// start.
pub fn nearest_points(first: [Vector3; 2], second: [Vector3; 2]) -> NearestPoints {
    let mut nearest = NearestPoints {
        squared: f64::INFINITY,
        shares: [0.0; 2],
    };
    let mut offer = |squared: f64, shares: [f64; 2]| {
        if squared < nearest.squared {
            nearest = NearestPoints { squared, shares };
        }
    };
    for (share, x) in [0.0, 1.0].into_iter().zip(first) {
        let (other, squared) = nearest_to_point(second, x);
        offer(squared, [share, other]);
    }
    for (share, x) in [0.0, 1.0].into_iter().zip(second) {
        let (other, squared) = nearest_to_point(first, x);
        offer(squared, [other, share]);
    }
    let (u, v, w) = (
        first[1] - first[0],
        second[1] - second[0],
        first[0] - second[0],
    );
    let (a, b, c) = (u.norm_squared(), u.dot(&v), v.norm_squared());
    let (d, e) = (u.dot(&w), v.dot(&w));
    let determinant = a * c - b * b;
    let shares = [(b * e - c * d) / determinant, (a * e - b * d) / determinant];
    // For parallel segments these are not finite, and an end is nearest.
    if shares.iter().all(|share| (0.0..=1.0).contains(share)) {
        let apart = w + u * shares[0] - v * shares[1];
        offer(apart.norm_squared(), shares);
    }
    nearest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(first: [Vector3; 2], second: [Vector3; 2]) -> f64 {
        let at = |[a, b]: [Vector3; 2], k: u32| a + (b - a) * (f64::from(k) / 200.0);
        let all = (0..=200).flat_map(|i| (0..=200).map(move |j| (i, j)));
        all.map(|(i, j)| (at(first, i) - at(second, j)).norm_squared())
            .fold(f64::INFINITY, f64::min)
    }

    /// Crossing, parallel, collinear, degenerate and random segments against the smallest of 4e4
    /// distances.
    #[test]
    fn nearest_places_are_the_nearest() {
        let mut noise = crate::Xorshift::new(3);
        let mut random = || Vector3::from_fn(|_, _| noise.sample());
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let mut all = vec![
            [-x, x, z - y, z + y],
            [-x, x, y, y + x],
            [-x, x, 2.0 * x, 3.0 * x],
            [x, x, y, z],
            [-x, x, y - x * 1e-9, y + x],
        ];
        all.extend((0..300).map(|_| [random(), random(), random(), random()]));
        for [a, b, c, d] in all {
            let nearest = nearest_points([a, b], [c, d]);
            let least = sampled([a, b], [c, d]);
            let spacing = ((b - a).norm() + (d - c).norm()) / 400.0;
            assert!(nearest.squared <= least * (1.0 + 1e-14));
            assert!(nearest.squared.sqrt() >= least.sqrt() - spacing);
            let [s, t] = nearest.shares;
            let found = (a + (b - a) * s - c - (d - c) * t).norm_squared();
            assert!((found - nearest.squared).abs() < 1e-14);
        }
    }
}
