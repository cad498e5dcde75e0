//! Hybrid Monte Carlo sampling of the states of a cell.

use super::normal::Normal;
use super::potential::Potential;
use nalgebra::{DMatrix, DVector};
use std::f64::consts::FRAC_PI_2;

/// Assumed amplitude (nm or rad) of zero-stiffness modes.
const WIDEST: f64 = 0.2;
/// Trajectories of the warm-up phases. The metric is updated from the mean Hessian after each.
const ROUNDS: [usize; 4] = [50, 100, 250, 200];
/// Trajectories between two evaluations of the Hessian during warm-up.
const APART: usize = 3;
/// Maximum time step; the period of the modes is 2 pi.
const LONGEST: f64 = 1.0;

pub(super) struct Chain<'a> {
    potential: &'a Potential<'a>,
    normal: Normal,
    pub(super) place: DVector<f64>,
    pub(super) gradient: DVector<f64>,
    energy: f64,
    /// Transformation from coordinates in which the mean Hessian over kT is the identity.
    map: DMatrix<f64>,
    /// Time step, in units in which every mode has frequency 1.
    pub(super) step: f64,
}

impl<'a> Chain<'a> {
    pub(super) fn new(potential: &'a Potential<'a>, place: DVector<f64>, normal: Normal) -> Self {
        let mut gradient = DVector::zeros(potential.size());
        let energy = potential.slopes(&place, &mut gradient);
        Self {
            potential,
            normal,
            place,
            gradient,
            energy,
            map: DMatrix::zeros(0, 0),
            step: 0.3,
        }
    }

    /// Adapts metric and time step to the given acceptance rate. Returns the mean Hessian of the
    /// metric.
    pub(super) fn warm_up(&mut self, acceptance: f64) -> DMatrix<f64> {
        let directions = self.potential.directions();
        let mut mean = self.potential.derivatives(&self.place).hessian;
        for trajectories in ROUNDS {
            self.map = metric(&directions, &mean, self.potential.kt);
            let (mut sum, mut count) = (mean * 0.0, 0.0);
            for k in 0..trajectories {
                let accepted = self.advance();
                let gain = 1.5 / (k as f64 + 10.0).powf(0.7);
                self.step = (self.step * (gain * (accepted - acceptance)).exp()).min(LONGEST);
                if 3 * k >= trajectories && k % APART == 0 {
                    sum += self.potential.derivatives(&self.place).hessian;
                    count += 1.0;
                }
            }
            mean = sum / count;
        }
        self.map = metric(&directions, &mean, self.potential.kt);
        mean
    }

    pub(super) fn mobility(&self, force: &DMatrix<f64>) -> DMatrix<f64> {
        &self.map * self.map.tr_mul(force) / self.potential.kt
    }

    /// Performs one trajectory and returns its acceptance probability.
    ///
    /// Momenta, number of leapfrog steps and time step are independent of the state. The Metropolis
    /// test therefore makes the Boltzmann distribution stationary for any time step.
    pub(super) fn advance(&mut self) -> f64 {
        let kt = self.potential.kt;
        let mut momentum = DVector::from_fn(self.map.ncols(), |_, _| self.normal.next());
        let step = self.step * (0.8 + 0.4 * self.normal.uniform());
        let time = FRAC_PI_2 * (0.5 + self.normal.uniform());
        let steps = count(time / step);
        let (mut place, mut gradient) = (self.place.clone(), self.gradient.clone());
        let before = self.energy / kt + 0.5 * momentum.norm_squared();
        let mut energy = self.energy;
        momentum.gemv_tr(-0.5 * step / kt, &self.map, &gradient, 1.0);
        for k in (0..steps).rev() {
            place.gemv(step, &self.map, &momentum, 1.0);
            energy = self.potential.slopes(&place, &mut gradient);
            let share = if k == 0 { 0.5 } else { 1.0 };
            momentum.gemv_tr(-share * step / kt, &self.map, &gradient, 1.0);
        }
        let after = energy / kt + 0.5 * momentum.norm_squared();
        let gain = before - after;
        let accepted = if gain.is_nan() {
            0.0
        } else {
            gain.exp().min(1.0)
        };
        if self.normal.uniform() < accepted {
            (self.place, self.gradient, self.energy) = (place, gradient, energy);
        }
        accepted
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is positive and small, or the conversion saturates"
)]
fn count(number: f64) -> usize {
    number.ceil() as usize
}

/// Directions along which the Hessian is kT times the identity, with a minimum stiffness.
fn metric(directions: &DMatrix<f64>, hessian: &DMatrix<f64>, kt: f64) -> DMatrix<f64> {
    let reduced = directions.tr_mul(&(hessian * directions));
    let eigen = reduced.symmetric_eigen();
    let mut modes = directions * eigen.eigenvectors;
    let least = kt / (WIDEST * WIDEST);
    for (mut mode, stiffness) in modes.column_iter_mut().zip(&eigen.eigenvalues) {
        mode *= (kt / stiffness.max(least)).sqrt();
    }
    modes
}
