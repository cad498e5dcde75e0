use actin_mechanics::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Energy of two points at distance `r` within the contact distance `D`, per length of both axes:
///
/// ```text
/// e (1 - r^2/D^2)^4
/// ```
///
/// Three derivatives are continuous, as required by integrators of order four and Newton's method.
/// For two straight axes at distance `d`, with `q = 1 - d^2/D^2`:
///
/// - Crossing at a right angle: energy `pi e D^2 q^5 / 5`, force `2 pi e d q^4` with its maximum at
///   `d = D/3`, stiffness `2 pi e q^3 (9 d^2/D^2 - 1)` with the maximum `32 pi e / 27` at
///   `d = D/sqrt(3)`.
/// - Parallel: energy per length `256/315 e D q^4.5`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Kernel {
    /// Energy scale `e` (pN/nm).
    strength: f64,
    /// Contact distance `D` (nm).
    pub(super) reach: f64,
}

impl Kernel {
    /// Creates a kernel with the given largest stiffness of perpendicular axes (pN/nm).
    pub(super) fn new(stiffness: f64, reach: f64) -> Self {
        Self {
            strength: 27.0 * stiffness / (32.0 * PI),
            reach,
        }
    }

    /// Distance over `D` at which the force of perpendicular axes is largest.
    pub(super) const YIELD: f64 = 1.0 / 3.0;

    /// Largest stiffness per length of parallel axes, at `d^2 = 3/8 D^2` (pN/nm^2):
    /// `2304/315 (5/8)^2.5 2 e / D`.
    pub(super) fn greatest_parallel(&self) -> f64 {
        2304.0 / 315.0 * 0.625_f64.powf(2.5) * 2.0 * self.strength / self.reach
    }

    /// Depth `1 - r^2/D^2`, positive in contact.
    #[inline]
    pub(super) fn depth(&self, d: Vector3) -> f64 {
        1.0 - d.norm_squared() / (self.reach * self.reach)
    }

    /// Energy per squared length (pN/nm).
    #[inline]
    pub(super) fn energy(&self, depth: f64) -> f64 {
        self.strength * (depth * depth) * (depth * depth)
    }

    /// Repulsive force per squared length over distance (pN/nm^3).
    #[inline]
    pub(super) fn force_over_distance(&self, depth: f64) -> f64 {
        8.0 * self.strength / (self.reach * self.reach) * depth * depth * depth
    }

    /// Second derivative with respect to `d`, per squared length (pN/nm^3).
    #[inline]
    pub(super) fn tangent(&self, depth: f64, d: Vector3) -> Matrix3 {
        let scale = 8.0 * self.strength / (self.reach * self.reach) * depth * depth;
        let outer = d * d.transpose() * (6.0 / (self.reach * self.reach));
        (outer - Matrix3::from_diagonal_element(depth)) * scale
    }

    /// Positive part of the [`tangent`](Self::tangent): along `d` beyond 0.38 of the contact
    /// distance.
    pub(super) fn convex_tangent(&self, depth: f64, d: Vector3) -> Matrix3 {
        let scale = 8.0 * self.strength / (self.reach * self.reach) * depth * depth;
        let squared = d.norm_squared();
        let along = 6.0 * squared / (self.reach * self.reach) - depth;
        let axis = d * d.transpose() / squared.max(f64::MIN_POSITIVE);
        axis * (along.max(0.0) * scale)
    }
}

/// Tangent of a kernel at a depth and a distance vector.
pub(super) type Tangent = fn(&Kernel, f64, Vector3) -> Matrix3;

/// Energy per length of a point of an axis with penetration depth `p`: `k p^4 / (24 R^3)`.
///
/// A piece of length `2 R` whose axis is in the surface of the wall has the stiffness `k`. Three
/// derivatives are continuous.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WallKernel {
    /// Stiffness `k` (pN/nm).
    stiffness: f64,
    /// Radius `R` (nm).
    pub(super) radius: f64,
}

impl WallKernel {
    pub(super) fn new(stiffness: f64, radius: f64) -> Self {
        Self { stiffness, radius }
    }

    /// Energy per length (pN) at a depth (nm).
    #[inline]
    pub(super) fn energy(&self, depth: f64) -> f64 {
        self.stiffness * depth.powi(4) / (24.0 * self.radius.powi(3))
    }

    /// Force per length (pN/nm).
    #[inline]
    pub(super) fn force(&self, depth: f64) -> f64 {
        self.stiffness * depth.powi(3) / (6.0 * self.radius.powi(3))
    }

    /// Stiffness per length (pN/nm^2).
    #[inline]
    pub(super) fn tangent(&self, depth: f64) -> f64 {
        self.stiffness * depth.powi(2) / (2.0 * self.radius.powi(3))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At a distance of 1 nm the tangent is negative in all directions, at 5 nm across the
    /// distance.
    #[test]
    fn the_convex_tangent_is_the_positive_part() {
        let kernel = Kernel::new(1000.0, 7.0);
        for (distance, negative) in [(1.0, 3), (5.0, 2)] {
            let d = Vector3::new(0.6, 0.0, 0.8) * distance;
            let depth = kernel.depth(d);
            let tangent = kernel.tangent(depth, d);
            let convex = kernel.convex_tangent(depth, d);
            let values = tangent.symmetric_eigenvalues();
            assert_eq!(
                values.iter().filter(|value| **value < 0.0).count(),
                negative
            );
            let values = convex.symmetric_eigenvalues();
            let rounding = 1e-14 * tangent.amax();
            assert!(values.iter().all(|value| *value >= -rounding), "{values}");
            let along = d.dot(&(tangent * d)).max(0.0);
            assert!(
                (d.dot(&(convex * d)) - along).abs() < 1e-12 * tangent.amax() * d.norm_squared()
            );
        }
    }
}
