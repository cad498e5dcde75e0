//! Time steps around the stability limit: where motion begins to grow, and what the energy does
//! below.

use super::row::{Outcome, Row, larger};
use super::scenes::{Parts, either};
use actin_integrate::{Composition, Drag, advance};
use actin_mechanics::System;
use actin_mechanics::{Xorshift, randomise_velocities};
use actin_sim::Integrator;

/// All integrators, with the names that the table has for them.
pub(super) const INTEGRATORS: [(&str, Integrator); 5] = [
    ("PositionVerlet", Integrator::PositionVerlet),
    ("Pefrl", Integrator::Pefrl),
    ("Vefrl", Integrator::Vefrl),
    ("ForestRuth", Integrator::ForestRuth),
    ("Suzuki", Integrator::Suzuki),
];

/// A filament of each kind.
pub(super) const MODELS: [(&str, &str); 3] = [
    ("rod", "Rod(from_nm: 0.0, to_nm: 30.0, segments: 3)"),
    ("monomers", "Ellipsoids(from_nm: 0.0, to_nm: 14.0)"),
    (
        "mixed",
        "Ellipsoids(from_nm: 0.0, to_nm: 9.0), Rod(from_nm: 9.0, to_nm: 29.0, segments: 2)",
    ),
];

/// Steps after which motion that grows at all, a 1e-4th above the limit, has grown by far more
/// than [`GROWN`]: there a mode grows by about `sqrt(2e-4)` in each.
const STEPS: u64 = 2_000;

/// Growth of the kinetic energy that no bounded motion shows. Below the limit, a mode's energy is
/// up to the inverse of the distance to it, relative, times what it began with.
const GROWN: f64 = 1e6;

/// A free filament.
pub(super) fn free(sections: &str) -> Result<System, Outcome> {
    let parts = Parts {
        sections: sections.to_owned(),
        task: "Dynamics(duration_ns: 1.0)".to_owned(),
        ..Parts::default()
    };
    Ok(parts.build()?.system)
}

/// Stability limits of one integrator on one filament (ns).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    /// From the largest frequency.
    pub(super) predicted: f64,
    /// Where motion begins to grow.
    pub(super) measured: f64,
}

/// Limits of small motion about the present state of a system.
pub(super) fn limits(system: &mut System, integrator: Integrator) -> Limits {
    let frequency = actin_integrate::largest_frequency(system).expect("loads at rest are finite");
    let scheme = integrator.composition();
    let predicted = actin_integrate::stable_step(scheme, frequency, 1.0).expect("it is positive");
    let (mut low, mut high) = (0.5 * predicted, 2.0 * predicted);
    if grows(system, integrator, low) {
        high = low;
        low = 0.0;
    }
    // To 1e-4 of the limit.
    for _ in 0..14 {
        let middle = 0.5 * (low + high);
        if grows(system, integrator, middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    Limits {
        predicted,
        measured: 0.5 * (low + high),
    }
}

/// Whether motion of 1e-8 nm/ns and rad/ns grows at step `h` (ns). Leaves the state as it was.
fn grows(system: &mut System, integrator: Integrator, h: f64) -> bool {
    let rest = system.state().clone();
    randomise_velocities(system.state_mut(), &mut Xorshift::new(3), 1e-8, 1e-8);
    let start = system.state().kinetic_energy();
    let mut grown = false;
    for _ in 0..STEPS / 50 {
        advance(system, integrator.composition(), h, 50, &Drag::NONE);
        let kinetic = system.state().kinetic_energy();
        if !(kinetic.is_finite() && kinetic < GROWN * start) {
            grown = true;
            break;
        }
    }
    system.state_mut().clone_from(&rest);
    grown
}

/// Measured against predicted limits of the chosen integrators on all models.
pub(super) fn rows(integrators: &[(&str, Integrator)]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (model, sections) in MODELS {
        for &(name, integrator) in integrators {
            let outcome = free(sections).map(|mut system| {
                let Limits {
                    predicted,
                    measured,
                } = limits(&mut system, integrator);
                let error = (measured / predicted - 1.0).abs();
                // Bisection to 1e-4, frequencies to 1e-4.
                Outcome::correct("measured limit against predicted", error, 5e-4)
            });
            let case = format!("{model}, {name}, to 2 times the limit");
            rows.push(Row::new("time step", case, either(outcome)));
        }
    }
    rows
}

/// Shares of the limit at which the energy is looked at.
pub(super) const SHARES: [f64; 10] = [1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99];

/// Largest deviation of the energy over 1000 steps of small motion at a share of the limit,
/// relative to what it begins with.
pub(super) fn energy_error(system: &mut System, integrator: Integrator, share: f64) -> f64 {
    let frequency = actin_integrate::largest_frequency(system).expect("loads at rest are finite");
    let scheme = integrator.composition();
    let h = actin_integrate::stable_step(scheme, frequency, share).expect("it is positive");
    let rest = system.state().clone();
    randomise_velocities(system.state_mut(), &mut Xorshift::new(3), 1e-3, 1e-3);
    let start = system.total_energy();
    let mut largest: f64 = 0.0;
    for _ in 0..100 {
        advance(system, scheme, h, 10, &Drag::NONE);
        largest = larger(largest, (system.total_energy() - start).abs());
    }
    system.state_mut().clone_from(&rest);
    largest / start
}

/// Rounding of the energy that `energy_error` looks at: places of 30 nm are known to 4e-15 nm, motion
/// of 1e-3 nm/ns at 500 rad/ns reaches 2e-6 nm, and its energy is known to twice the quotient, 4e-9.
/// Five times that, for many bodies.
const ENERGY_ROUNDING: f64 = 2e-8;

/// Twice the share of its energy by which a mode at the share `s` of its limit fluctuates: `s^2/(1 - s^2)`
/// with Verlet's method, exactly, and less than `s^4/(1 - s^2)` in order four.
fn fluctuation(scheme: &Composition, share: f64) -> f64 {
    let order = scheme.order().cast_signed();
    2.0 * share.powi(order) / (1.0 - share * share)
}

/// Fluctuation of the energy from a thousandth of the limit to just below it.
pub(super) fn below(integrators: &[(&str, Integrator)]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (model, sections) in MODELS {
        for &(name, integrator) in integrators {
            let outcome = free(sections).map(|mut system| {
                let of_bound = |share| {
                    let error = energy_error(&mut system, integrator, share);
                    error / (fluctuation(integrator.composition(), share) + ENERGY_ROUNDING)
                };
                let share = SHARES.map(of_bound).into_iter().fold(0.0, larger);
                let what = "energy fluctuation";
                Outcome::Bounded { what, share }
            });
            let case = format!("{model}, {name}, 0.001 to 0.99 of the limit");
            rows.push(Row::new("time step", case, either(outcome)));
        }
    }
    rows
}

/// Steps that a scene asks for, as a multiple of the limit.
pub(super) fn asked_for(integrators: &[(&str, Integrator)]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (model, sections) in MODELS {
        for &(name, integrator) in integrators {
            for (share, allowed) in [(1e-3, false), (1.01, false), (1.01, true), (2.0, true)] {
                let words = if allowed { ", allowed" } else { "" };
                let case = format!("{model}, {name}, {share} of the limit{words}");
                let outcome = either(at_share(sections, name, integrator, (share, allowed)));
                rows.push(Row::new("time step", case, outcome));
            }
        }
    }
    rows
}

/// A cantilever under a force, moving for 4000 steps at a share of the limit.
fn at_share(
    sections: &str,
    name: &str,
    integrator: Integrator,
    (share, allowed): (f64, bool),
) -> Result<Outcome, Outcome> {
    let pulled = Parts::pulled(sections, [0.1, 0.0, 0.0]);
    let task = |step: f64| Parts {
        task: format!(
            "Dynamics(integrator: {name}, duration_ns: {:?}, time_step_ns: {step:?},
             allow_unstable_step: {allowed})",
            4000.0 * step
        ),
        ..pulled.clone()
    };
    let assembly = task(1e-9).build()?;
    let plan = actin_sim::Plan::new(&assembly).map_err(|e| Outcome::Wrong(e.to_string()))?;
    let estimate = plan.estimate().expect("a motion has an estimate");
    let limit = estimate.stability_limit_ns;
    let ran = task(share * limit).run()?;
    if share > 1.0 {
        return Err(Outcome::Wrong(
            "motion above the limit ran to its end".into(),
        ));
    }
    let energy = ran.assembly.system.total_energy();
    // From rest without strain: the energy stays zero, the force's own included.
    let kinetic = ran.assembly.system.state().kinetic_energy();
    let error = energy.abs() / kinetic;
    let bound = fluctuation(integrator.composition(), share).max(1e-8);
    let what = "energy against that of the motion";
    Ok(Outcome::correct(what, error, bound))
}
