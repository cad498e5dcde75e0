//! Cantilever scenes, and beam theory by integration along the arc.

use crate::common::ran;
pub(crate) use crate::common::{BEND, LENGTH, build, rod_scene};
use crate::theory::bisect;
use actin_mechanics::testing::{assert_is_balanced, assert_is_gradient, assert_is_stiffness};
use actin_mechanics::{Xorshift, perturb};
use actin_sim::{Assembly, Trajectory};

/// Twisting rigidity (pN nm^2), and equal shear and stretch rigidity (pN).
pub(crate) const TWIST: f64 = 1.3e4;
pub(crate) const SHEAR: f64 = 1e6;
/// Mass per length (ag/nm) of the default monomers.
pub(crate) const DENSITY: f64 = 0.0697 / (71.2 / 26.0);

pub(crate) fn cantilever(segments: usize, shear: f64, loads: &str, rest: &str) -> String {
    twisting(segments, (shear, TWIST), loads, rest)
}

pub(crate) fn twisting(segments: usize, rigidities: (f64, f64), loads: &str, rest: &str) -> String {
    let rest = format!("loads: [{loads}], {rest}");
    rod_scene(segments, rigidities, "Clamp(end: Start)", &rest)
}

pub(crate) fn run(text: &str) -> (Assembly, Trajectory) {
    let (assembly, trajectory, _) = ran(text);
    (assembly, trajectory)
}

/// Deflection over length of an inextensible cantilever under a dead force `w` per length across
/// it, `alpha = w L^3 / B`, by shooting with the classical Runge-Kutta method:
/// `theta'' = -alpha (1 - s) cos(theta)`.
pub(crate) fn deflection_under_uniform_force(alpha: f64, steps: usize) -> f64 {
    let shot = |curvature: f64| {
        let derivative = |s: f64, [theta, kappa, _]: [f64; 3]| {
            [kappa, -alpha * (1.0 - s) * theta.cos(), theta.sin()]
        };
        let h = 1.0 / steps as f64;
        let mut y = [0.0, curvature, 0.0];
        let plus = |y: [f64; 3], k: [f64; 3], h: f64| [0, 1, 2].map(|i| y[i] + h * k[i]);
        for i in 0..steps {
            let s = i as f64 * h;
            let a = derivative(s, y);
            let b = derivative(s + 0.5 * h, plus(y, a, 0.5 * h));
            let c = derivative(s + 0.5 * h, plus(y, b, 0.5 * h));
            let d = derivative(s + h, plus(y, c, h));
            y = [0, 1, 2].map(|k| y[k] + h / 6.0 * (a[k] + 2.0 * b[k] + 2.0 * c[k] + d[k]));
        }
        y
    };
    let curvature = bisect(
        |curvature| shot(curvature)[1] > 0.0,
        [0.0, 0.5 * alpha],
        1e-14,
    );
    shot(curvature)[2]
}

/// Checks loads and stiffness of all interactions near the state as built.
pub(crate) fn assert_interactions_are_gradients(assembly: &Assembly) {
    let mut state = assembly.rest.clone();
    perturb(&mut state, &mut Xorshift::new(8), 0.02, 0.05);
    for interaction in assembly.system.interactions() {
        assert_is_gradient(interaction.as_ref(), &state, 1e-4, 1e-6);
        assert_is_stiffness(interaction.as_ref(), &state, 1e-4, 1e-5);
        assert_is_balanced(interaction.as_ref(), &state, 1e-11);
    }
}
