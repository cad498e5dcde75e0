//! Distance of a state from equilibrium.

/// Largest norms of the loads on free bodies. For bodies that slide together, the resultant along
/// their directions is used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Residual {
    /// Largest force (pN).
    pub force: f64,
    /// Largest torque (pN nm).
    pub torque: f64,
}

impl Residual {
    /// Returns `true` if both parts are at most equal to the parts of `limit`, and `false` if one
    /// is NaN.
    pub fn is_within(&self, limit: &Self) -> bool {
        self.force <= limit.force && self.torque <= limit.torque
    }

    /// Larger of the ratios of both parts to `unit`. A zero part counts as zero.
    pub fn relative_to(&self, unit: &Self) -> f64 {
        let part = |value: f64, unit: f64| if value == 0.0 { 0.0 } else { value / unit };
        part(self.force, unit.force).max(part(self.torque, unit.torque))
    }

    /// Returns both parts multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            force: self.force * factor,
            torque: self.torque * factor,
        }
    }

    /// Returns the componentwise maximum.
    #[must_use]
    pub fn max(&self, other: &Self) -> Self {
        Self {
            force: self.force.max(other.force),
            torque: self.torque.max(other.torque),
        }
    }
}
