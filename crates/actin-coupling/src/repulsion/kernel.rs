//! How energy goes with distance.

use actin_mechanics::{Matrix3, Vector3};
use std::f64::consts::PI;

/// Energy of two points of axes at a distance `r`, per length of both: `e (1 - r^2/D^2)^4` within the
/// distance of contact `D`.
///
/// Three derivatives are continuous, so that integrators of order four keep their order and Newton's
/// tangent has no jumps. Two straight axes that cross at a right angle at a distance `d`, with
/// `q = 1 - d^2/D^2`, have the energy `pi e D^2 q^5 / 5`, the force `2 pi e d q^4`, greatest at `d = D/3`,
/// and the stiffness `2 pi e q^3 (9 d^2/D^2 - 1)`, which is greatest at `d = D/sqrt(3)`: `32 pi e / 27`. Two that are
/// parallel have, per length, the energy `256/315 e D q^4.5`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Kernel {
    /// `e` (pN/nm).
    strength: f64,
    /// `D` (nm).
    pub(super) reach: f64,
}

impl Kernel {
    /// The kernel that makes two axes crossing at a right angle at most as stiff as this (pN/nm).
    pub(super) fn new(stiffness: f64, reach: f64) -> Self {
        Self {
            strength: 27.0 * stiffness / (32.0 * PI),
            reach,
        }
    }

    /// Share of `D` below which the force of crossing axes falls again.
    pub(super) const YIELD: f64 = 1.0 / 3.0;

    /// The stiffness per length of two parallel axes where it is greatest, `d^2 = 3/8 D^2`:
    /// `2304/315 (5/8)^2.5 2 e / D` (pN/nm^2).
    pub(super) fn greatest_parallel(&self) -> f64 {
        2304.0 / 315.0 * 0.625_f64.powf(2.5) * 2.0 * self.strength / self.reach
    }

    /// `1 - r^2/D^2`; nothing acts where it is not positive.
    #[inline]
    pub(super) fn depth(&self, d: Vector3) -> f64 {
        1.0 - d.norm_squared() / (self.reach * self.reach)
    }

    /// Energy per squared length (pN/nm) at a depth.
    #[inline]
    pub(super) fn energy(&self, depth: f64) -> f64 {
        self.strength * (depth * depth) * (depth * depth)
    }

    /// Force per squared length over distance (pN/nm^3) that drives the ends of `d` apart.
    #[inline]
    pub(super) fn force_over_distance(&self, depth: f64) -> f64 {
        8.0 * self.strength / (self.reach * self.reach) * depth * depth * depth
    }

    /// Second derivative by `d`, per squared length (pN/nm^3).
    #[inline]
    pub(super) fn tangent(&self, depth: f64, d: Vector3) -> Matrix3 {
        let scale = 8.0 * self.strength / (self.reach * self.reach) * depth * depth;
        let outer = d * d.transpose() * (6.0 / (self.reach * self.reach));
        (outer - Matrix3::from_diagonal_element(depth)) * scale
    }
}

/// Energy of a point of an axis whose surface is pressed into a wall by `p`, per length:
/// `k p^4 / (24 R^3)`. A stretch as long as it is thick has the stiffness `k` when its axis comes to
/// lie in the wall's surface. Three derivatives are continuous.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WallKernel {
    /// `k` (pN/nm).
    stiffness: f64,
    /// `R` (nm).
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
