//! Drag from none to 1e6 per ns.

use super::row::{Outcome, Row};
use super::stability::{MODELS, free};
use actin_integrate::{Drag, PEFRL, advance, largest_frequency, stable_step};
use actin_mechanics::testing::momenta;
use actin_mechanics::{System, Vector3};

/// Steps of each flight.
const STEPS: u64 = 100;

/// Rates (1/ns).
const RATES: [f64; 7] = [0.0, 1e-3, 1.0, 1e2, 1e4, 1e5, 1e6];

/// Free flight of all models under all rates.
pub(crate) fn rows() -> Vec<Row> {
    let mut rows = Vec::new();
    for (model, sections) in MODELS {
        for rate in RATES {
            let outcome = free(sections).map(|system| flight(system, rate));
            let outcome = outcome.unwrap_or_else(|outcome| outcome);
            rows.push(Row::new(
                "drag",
                format!("{model}, {rate:.0e} per ns"),
                outcome,
            ));
        }
    }
    rows
}

/// Momentum decays as `exp(-gamma t)` whatever the filament does, at any step.
fn flight(mut system: System, rate: f64) -> Outcome {
    let frequency = largest_frequency(&system).expect("loads at rest are finite");
    let h = stable_step(&PEFRL, frequency, 0.5).expect("it is positive");
    let points = &mut system.state_mut().points;
    for i in 0..points.len() {
        points.velocity.set(i, Vector3::new(3.0, -2.0, 1.0));
    }
    let start = momenta(system.state()).0;
    let drag = Drag::new(rate, rate).expect("rates are positive");
    advance(&mut system, &PEFRL, h, STEPS, &drag);
    let expected = start * (-rate * h * STEPS as f64).exp();
    let left = momenta(system.state()).0;
    if !system.state().is_finite() {
        return Outcome::Wrong("the state is not finite".into());
    }
    // Round-off of a hundred exponentials, and of the forces at rest.
    let error = (left - expected).norm() / start.norm();
    Outcome::correct("momentum exp(-gamma t), of what it was", error, 1e-13)
}
