//! What the stiffness at an equilibrium says about it. How eigenvalues are counted is in `certify.rs`.

/// Counts of eigenvalues of the unregularised stiffness.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Certificate {
    /// Number of eigenvalues below `-resolution`.
    pub negative: usize,
    /// Number of neutral modes: eigenvalues that cannot be distinguished from zero.
    pub unresolved: usize,
    /// The resolution (pN/nm), divided by the metric's smallest weight: the larger of eight times
    /// the unit round-off times the largest diagonal entry of `|L| |D| |L^T|`, and of the change
    /// of the stiffness when each coordinate changes by its rounding error. Of no stiffness at all
    /// it is the smallest normal number.
    pub resolution: f64,
    /// Number of negative pivots of the stiffness itself.
    pub negative_pivots: usize,
}

/// What an equilibrium is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// All eigenvalues are positive: a minimum of the energy.
    Stable,
    /// No eigenvalue is negative, but some cannot be told from zero: floppy modes at rest, rigid
    /// motions of something that floats, or a critical point.
    Neutral {
        /// How many.
        modes: usize,
    },
    /// Some eigenvalues are negative: an equilibrium that the slightest push leaves.
    Saddle {
        /// How many.
        negative: usize,
    },
}

impl Certificate {
    /// What the counts mean.
    pub fn stability(&self) -> Stability {
        match (self.negative, self.unresolved) {
            (0, 0) => Stability::Stable,
            (0, modes) => Stability::Neutral { modes },
            (negative, _) => Stability::Saddle { negative },
        }
    }
}
