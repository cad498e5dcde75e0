//! Stability of equilibria.

/// Counts of the eigenvalues of the stiffness, without regularisation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Certificate {
    /// Number of eigenvalues below `-resolution`.
    pub negative: usize,
    /// Number of eigenvalues indistinguishable from zero: neutral modes.
    pub unresolved: usize,
    /// Bound of the error of the eigenvalues (pN/nm): `max(8 eps g, c) / m`, with the largest
    /// diagonal entry `g` of `|L| |D| |L^T|`, the change `c` of the stiffness by rounding of the
    /// coordinates and the smallest weight `m` of the metric.
    pub resolution: f64,
    /// Number of negative pivots of the stiffness.
    pub negative_pivots: usize,
}

/// Stability of an equilibrium.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// Minimum of the energy: all eigenvalues are positive.
    Stable,
    /// No negative eigenvalue, but some indistinguishable from zero: zero-stiffness modes at rest,
    /// rigid motions of unconstrained bodies, or a critical point.
    Neutral {
        /// Number of neutral modes.
        modes: usize,
    },
    /// Unstable equilibrium: some eigenvalues are negative.
    Saddle {
        /// Number of negative eigenvalues.
        negative: usize,
    },
}

impl Certificate {
    /// Stability according to the counts.
    pub fn stability(&self) -> Stability {
        match (self.negative, self.unresolved) {
            (0, 0) => Stability::Stable,
            (0, modes) => Stability::Neutral { modes },
            (negative, _) => Stability::Saddle { negative },
        }
    }
}
