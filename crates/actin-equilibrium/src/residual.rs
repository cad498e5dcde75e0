//! How far a state is from equilibrium.

/// The largest loads along freedoms: over free bodies the norm of the force and of the body
/// torque, over groups the norm of the resultant force and of the couple about the pivot, each
/// along the directions in which the group moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Residual {
    /// Largest force (pN).
    pub force: f64,
    /// Largest torque (pN nm).
    pub torque: f64,
}

impl Residual {
    /// Whether both parts are at most those of `limit`.
    pub fn is_within(&self, limit: &Self) -> bool {
        self.force <= limit.force && self.torque <= limit.torque
    }

    /// The larger of both parts relative to those of `unit`.
    pub(crate) fn relative_to(&self, unit: &Self) -> f64 {
        let part = |value: f64, unit: f64| if value == 0.0 { 0.0 } else { value / unit };
        part(self.force, unit.force).max(part(self.torque, unit.torque))
    }

    /// Both parts multiplied by `factor`.
    pub(crate) fn scaled(&self, factor: f64) -> Self {
        Self {
            force: self.force * factor,
            torque: self.torque * factor,
        }
    }

    /// The same, with zero for a part that is not finite.
    pub(crate) fn if_finite(&self) -> Self {
        let part = |value: f64| if value.is_finite() { value } else { 0.0 };
        Self {
            force: part(self.force),
            torque: part(self.torque),
        }
    }

    /// The larger of each part.
    pub(crate) fn max(&self, other: &Self) -> Self {
        Self {
            force: self.force.max(other.force),
            torque: self.torque.max(other.torque),
        }
    }
}
