//! What a solve may do and when it is done.

use actin_mechanics::Residual;
use thiserror::Error;

/// Settings of [`Newton`](crate::Newton); the defaults suit filaments in nm, pN and rad.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonOptions {
    /// Residual at which a state is an equilibrium; 1e-8 pN and 1e-8 pN nm.
    pub tolerance: Residual,
    /// Most Newton steps; 2000.
    pub iterations: usize,
    /// Largest turn of a body in one step (rad); 0.5. Not of steps in which bodies carry one another along.
    pub largest_rotation: f64,
    /// Largest relative motion of coupled bodies in one step: turn between two frames (rad), or
    /// relative displacement of two points over their distance; 0.3.
    pub largest_strain: f64,
    /// Largest displacement of a body in one step (nm); no limit.
    pub largest_displacement: f64,
    /// Steps for which the energy may stay above where it was, so that bending may first stretch
    /// and then relax; 12. Zero asks for a decrease in each step.
    pub patience: usize,
    /// Length (nm) that a turn of 1 rad counts as in eigenvalues and regularisation; 1.
    pub turn_length: f64,
    /// Whether the eigenvalues of the stiffness are counted at the end; yes.
    pub certify: bool,
    /// Whether bodies carry one another along from any start of many of them, not only from floppy ones; no.
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

/// A setting that makes no sense.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{name} must be {rule}, but is {value}")]
pub struct OptionsError {
    /// Name of the setting.
    pub name: &'static str,
    /// What it must be.
    pub rule: &'static str,
    /// What it is.
    pub value: f64,
}

impl NewtonOptions {
    /// Checks the settings.
    ///
    /// # Errors
    /// If one of them makes no sense.
    pub(crate) fn check(&self) -> Result<(), OptionsError> {
        // Beyond half a turn the logarithm of a relative rotation has another branch.
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

/// An error unless `value` is above zero.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<(), OptionsError> {
    rule(name, "positive", value, value > 0.0)
}

/// An error unless `holds`.
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
