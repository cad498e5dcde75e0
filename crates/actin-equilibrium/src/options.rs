//! Options of Newton's method.

use actin_mechanics::Residual;
use thiserror::Error;

/// Options of [`Newton`](crate::Newton); the defaults suit filaments in nm, pN and rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonOptions {
    /// Tolerance of the residual. Default: 1e-8 pN and 1e-8 pN nm.
    pub tolerance: Residual,
    /// Maximum number of Newton steps. Default: 2000.
    pub iterations: usize,
    /// Maximum rotation of a body per step (rad). Default: 0.5. Not applied to carried steps, in
    /// which each body moves with its predecessor.
    pub largest_rotation: f64,
    /// Maximum relative motion of coupled bodies per step: rotation between two frames (rad), or
    /// relative displacement of two points over their distance. Default: 0.3.
    pub largest_strain: f64,
    /// Maximum displacement of a body per step (nm). Default: no limit.
    pub largest_displacement: f64,
    /// Maximum number of consecutive steps above the lowest energy. A bending step may stretch the
    /// filament, and the following steps relax the stretch. Default: 12; zero requires a decrease
    /// in each step.
    pub patience: usize,
    /// Displacement (nm) equivalent to a rotation of 1 rad in eigenvalues and regularisation.
    /// Default: 1.
    pub turn_length: f64,
    /// Counts the eigenvalues of the stiffness at the end. Default: true.
    pub certify: bool,
    /// Uses carried steps for all open chains of at least 400 bodies. If `false` (default), the
    /// initial state must also have at least one zero-stiffness mode per 16 bodies.
    pub carries_along: bool,
}

impl Default for NewtonOptions {
    fn default() -> Self {
        Self {
            tolerance: Residual {
                force: 1e-8,
                torque: 1e-8,
            },
            iterations: 2000,
            largest_rotation: 0.5,
            largest_strain: 0.3,
            largest_displacement: f64::INFINITY,
            patience: 12,
            turn_length: 1.0,
            certify: true,
            carries_along: false,
        }
    }
}

/// Error of an invalid option.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{name} must be {rule}, but is {value}")]
pub struct OptionsError {
    /// Name of the option.
    pub name: &'static str,
    /// Rule of the option.
    pub rule: &'static str,
    /// Value of the option.
    pub value: f64,
}

impl NewtonOptions {
    pub(crate) fn check(&self) -> Result<(), OptionsError> {
        // The logarithm of a relative rotation is unique below pi.
        let below_half_turn = self.largest_rotation < std::f64::consts::PI;
        positive("tolerance.force", self.tolerance.force)?;
        positive("tolerance.torque", self.tolerance.torque)?;
        positive("largest_strain", self.largest_strain)?;
        positive("largest_displacement", self.largest_displacement)?;
        positive("turn_length", self.turn_length)?;
        rule(
            "largest_rotation",
            "positive and below pi",
            self.largest_rotation,
            self.largest_rotation > 0.0 && below_half_turn,
        )
    }
}

pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), OptionsError> {
    rule(name, "positive", value, value > 0.0)
}

pub(crate) fn rule(
    name: &'static str,
    rule: &'static str,
    value: f64,
    holds: bool,
) -> Result<(), OptionsError> {
    if holds {
        Ok(())
    } else {
        Err(OptionsError { name, rule, value })
    }
}
