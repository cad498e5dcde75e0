//! How far a state is from equilibrium.

/// The largest loads on what is free to move: over free bodies the norm of the force and of the body
/// torque, over bodies that move together the norm of their resultant along the directions in which they
/// move.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Residual {
    /// Largest force (pN).
    pub force: f64,
    /// Largest torque (pN nm).
    pub torque: f64,
}

impl Residual {
    /// Whether both parts are at most those of `limit`; never if one is NaN.
    pub fn is_within(&self, limit: &Self) -> bool {
        self.force <= limit.force && self.torque <= limit.torque
    }

    /// The larger of both parts relative to those of `unit`; a part of zero counts as zero.
    pub fn relative_to(&self, unit: &Self) -> f64 {
        let part = |value: f64, unit: f64| if value == 0.0 { 0.0 } else { value / unit };
        part(self.force, unit.force).max(part(self.torque, unit.torque))
    }

    /// Both parts multiplied by `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            force: self.force * factor,
            torque: self.torque * factor,
        }
    }

    /// The larger of each part.
    #[must_use]
    pub fn max(&self, other: &Self) -> Self {
        Self {
            force: self.force.max(other.force),
            torque: self.torque.max(other.torque),
        }
    }
}
