//! Stability of the potential's twist under axial force.

use super::{Homogenised, joined};
use actin_mechanics::Vector3;

/// Largest stretch and number of steps in the search for a critical force.
const REACH: (f64, u32) = (0.02, 200);

/// Number of bisections: to 1e-13 of stretch.
const HALVINGS: u32 = 30;

impl Homogenised {
    /// Axial force (pN), and derivative of the torque about d3 with respect to twist at constant
    /// force, shear and bending (pN nm^2). Negative infinity if stretch is unstable.
    pub(crate) fn tension_and_twist_tangent(&self, sigma: Vector3, kappa: Vector3) -> [f64; 2] {
        let strain = joined(sigma, kappa);
        let tangent = self.tangent(&strain);
        let (twist, mixed, stretch) = (tangent[(2, 2)], tangent[(2, 5)], tangent[(5, 5)]);
        let at_force = if stretch > 0.0 {
            twist - mixed * mixed / stretch
        } else {
            f64::NEG_INFINITY
        };
        [self.loads(&strain)[5], at_force]
    }

    /// Stretch without axial force at given shear and bending.
    fn free_stretch(&self, sigma: Vector3, kappa: Vector3) -> f64 {
        let natural = self.natural_stretch(kappa.z);
        let [mut least, mut most] = [natural - REACH.0, natural + REACH.0];
        for _ in 0..2 * HALVINGS {
            let middle = 0.5 * (least + most);
            let strain = joined(Vector3::new(sigma.x, sigma.y, middle), kappa);
            if self.loads(&strain)[5] > 0.0 {
                most = middle;
            } else {
                least = middle;
            }
        }
        0.5 * (least + most)
    }

    /// Smallest force (pN) at which the tangent vanishes within [`REACH`]. `None` without such a force,
    /// or if the tangent is not positive at zero force.
    pub(crate) fn critical_tension(&self, sigma: Vector3, kappa: Vector3) -> Option<f64> {
        let free = self.free_stretch(sigma, kappa);
        let at = |e: f64| {
            let sigma = Vector3::new(sigma.x, sigma.y, free + e);
            self.tension_and_twist_tangent(sigma, kappa)
        };
        let is_stable = |e: f64| at(e)[1] > 0.0;
        if !is_stable(0.0) {
            return None;
        }
        let (reach, steps) = REACH;
        let step = reach / f64::from(steps);
        let both = (1..=steps).flat_map(|n| [-step, step].map(|step| (n, step)));
        let mut found = both.map(|(n, step)| [f64::from(n - 1) * step, f64::from(n) * step]);
        let [mut inner, mut outer] = found.find(|[_, outer]| !is_stable(*outer))?;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (inner + outer);
            if is_stable(middle) {
                inner = middle;
            } else {
                outer = middle;
            }
        }
        Some(at(inner)[0])
    }
}
