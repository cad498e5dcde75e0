//! Time steps near the stability limit: onset of growth, and energy fluctuation below it, with figures.

use super::row::{CaseResult, Expected, Outcome, Row, bounded, correct, larger};
use super::scenes::{Parts, free};
use actin_draw::{Chart, Colour, Mark, Series};
use actin_integrate::{Composition, Drag, advance, largest_frequency, stable_step};
use actin_mechanics::{System, Xorshift, randomise_velocities};
use actin_sim::{Integrator, Plan};
use std::path::Path;

const INTEGRATORS: [Integrator; 5] = [
    Integrator::PositionVerlet,
    Integrator::Pefrl,
    Integrator::Vefrl,
    Integrator::ForestRuth,
    Integrator::Suzuki,
];

pub(super) const MODELS: [(&str, &str); 3] = [
    ("rod", "Rod(from_nm: 0.0, to_nm: 30.0, segments: 3)"),
    ("monomers", "Ellipsoids(from_nm: 0.0, to_nm: 14.0)"),
    (
        "mixed",
        "Ellipsoids(from_nm: 0.0, to_nm: 9.0), Rod(from_nm: 9.0, to_nm: 29.0, segments: 2)",
    ),
];

/// Number of steps after which motion at 1e-4 above the limit exceeds [`GROWN`]: a mode grows by about `sqrt(2e-4)`
/// per step.
const STEPS: u64 = 2_000;
/// Growth of the kinetic energy that indicates instability. Below the limit, the energy of a mode grows at most by
/// the inverse relative distance to the limit.
const GROWN: f64 = 1e6;
const SHARES: [f64; 10] = [1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.25, 0.5, 0.75, 0.9, 0.99];
/// Relative round-off of the energy. Positions of 30 nm have a round-off of 4e-15 nm, and the
/// amplitude of the motion is 2e-6 nm: an error of 4e-9, times five for many bodies.
const ENERGY_ROUNDING: f64 = 2e-8;

fn each(rows: impl Fn(&str, &str, Integrator) -> Vec<Row>) -> Vec<Row> {
    let all = MODELS
        .into_iter()
        .flat_map(|model| INTEGRATORS.map(|i| (model, i)));
    all.flat_map(|((model, sections), integrator)| rows(model, sections, integrator))
        .collect()
}

fn step_at(system: &System, scheme: &Composition, share: f64) -> f64 {
    let frequency = largest_frequency(system).expect("loads at rest are finite");
    stable_step(scheme, frequency, share).expect("it is positive")
}

/// Returns the ratio of the step at which small motion begins to grow to the predicted limit.
fn measured_limit(system: &mut System, integrator: Integrator) -> f64 {
    let predicted = step_at(system, actin_sim::composition(integrator), 1.0);
    let (mut low, mut high) = (0.5, 2.0);
    if grows(system, integrator, low * predicted) {
        (low, high) = (0.0, low);
    }
    for _ in 0..14 {
        let middle = 0.5 * (low + high);
        if grows(system, integrator, middle * predicted) {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

pub(super) fn limit(system: &mut System, integrator: Integrator, bound: f64) -> CaseResult {
    let error = (measured_limit(system, integrator) - 1.0).abs();
    correct("measured limit against predicted", error, bound)
}

/// Returns whether motion of 1e-8 nm/ns and rad/ns grows at step `h` (ns). The state is restored.
fn grows(system: &mut System, integrator: Integrator, h: f64) -> bool {
    let rest = system.state().clone();
    randomise_velocities(system.state_mut(), &mut Xorshift::new(3), 1e-8, 1e-8);
    let start = system.state().kinetic_energy();
    let is_grown = (0..STEPS / 50).any(|_| {
        advance(
            system,
            actin_sim::composition(integrator),
            h,
            50,
            &Drag::NONE,
        );
        let kinetic = system.state().kinetic_energy();
        !(kinetic.is_finite() && kinetic < GROWN * start)
    });
    system.state_mut().clone_from(&rest);
    is_grown
}

pub(super) fn limits() -> Vec<Row> {
    each(|model, sections, integrator| {
        let tried = free(sections).and_then(|mut system| limit(&mut system, integrator, 5e-4));
        let case = format!("{model}, {integrator:?}, to 2 times the limit");
        vec![Row::new("time step", case, tried)]
    })
}

fn energy_error(system: &mut System, integrator: Integrator, share: f64) -> f64 {
    let scheme = actin_sim::composition(integrator);
    let h = step_at(system, scheme, share);
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

/// Returns twice the relative energy fluctuation of a mode at the fraction `s` of its limit.
///
/// ```text
/// s^2/(1 - s^2)                 velocity Verlet, exact
/// less than s^4/(1 - s^2)       order four
/// ```
fn fluctuation(scheme: &Composition, share: f64) -> f64 {
    let order = scheme.order().cast_signed();
    2.0 * share.powi(order) / (1.0 - share * share)
}

pub(super) fn energies() -> Vec<Row> {
    each(|model, sections, integrator| {
        let tried = free(sections).and_then(|mut system| {
            let of_bound = |share| {
                let error = energy_error(&mut system, integrator, share);
                error / (fluctuation(actin_sim::composition(integrator), share) + ENERGY_ROUNDING)
            };
            let share = SHARES.map(of_bound).into_iter().fold(0.0, larger);
            bounded("energy fluctuation", share)
        });
        let case = format!("{model}, {integrator:?}, 0.001 to 0.99 of the limit");
        vec![Row::new("time step", case, tried)]
    })
}

/// Steps of a scene as multiples of the limit. Larger steps are refused or, if allowed, fail.
const ASKED: [(f64, bool, Expected); 4] = [
    (1e-3, false, Expected::Correct),
    (1.01, false, Expected::Refused),
    (1.01, true, Expected::Fails(&[])),
    (2.0, true, Expected::Fails(&[])),
];

pub(super) fn asked() -> Vec<Row> {
    each(|model, sections, integrator| {
        let row = |(share, allowed, expected)| {
            let words = if allowed { ", allowed" } else { "" };
            let case = format!("{model}, {integrator:?}, {share} of the limit{words}");
            let tried = at_share(sections, integrator, share, allowed);
            Row::new("time step", case, tried).expecting(expected)
        };
        ASKED.map(row).to_vec()
    })
}

fn at_share(sections: &str, integrator: Integrator, share: f64, allowed: bool) -> CaseResult {
    let pulled = Parts::pulled(sections, [0.1, 0.0, 0.0]);
    let task = |step: f64| Parts {
        task: format!(
            "Dynamics(integrator: {integrator:?}, duration_ns: {:?}, time_step_ns: {step:?},
             allow_unstable_step: {allowed})",
            4000.0 * step
        ),
        ..pulled.clone()
    };
    let assembly = task(1e-9).build()?;
    let plan = Plan::new(&assembly).map_err(|e| Outcome::Wrong(e.to_string()))?;
    let limit = plan.estimate().expect("a motion").stability_limit_ns;
    let system = task(share * limit).run()?.assembly.system;
    // The motion starts from rest without strain, so that the total energy is zero.
    let error = system.total_energy().abs() / system.state().kinetic_energy();
    let bound = fluctuation(actin_sim::composition(integrator), share).max(1e-8);
    correct("energy against that of the motion", error, bound)
}

const COLOURS: [[u8; 3]; 5] = [
    [30, 70, 180],
    [190, 25, 35],
    [235, 140, 20],
    [40, 150, 70],
    [120, 60, 150],
];

fn series(label: &str, colour: [u8; 3], points: Vec<(f64, f64)>, dots: bool) -> Series {
    Series {
        label: Some(label.to_owned()),
        colour: Colour(colour),
        points,
        mark: if dots { Mark::Dots } else { Mark::Line },
    }
}

pub(super) fn draw(out: &Path) -> Result<(), String> {
    let diagonal = vec![(1.4, 1.4), (3.6, 3.6)];
    let mut limits = vec![series("equal", [160; 3], diagonal, false)];
    for ((model, sections), colour) in MODELS.into_iter().zip(COLOURS) {
        let mut system = free(sections).map_err(|outcome| outcome.words())?;
        let point = |integrator: Integrator| {
            let predicted = actin_sim::composition(integrator).stability_limit();
            (
                predicted,
                predicted * measured_limit(&mut system, integrator),
            )
        };
        limits.push(series(model, colour, INTEGRATORS.map(point).to_vec(), true));
    }
    let chart = Chart {
        title: "Where small motion begins to grow",
        x_label: "limit of the method, omega h",
        y_label: "measured limit, omega h",
        series: limits,
        equal_axes: false,
    };
    chart.draw(&out.join("extremes-limits.svg"))?;
    let (model, sections) = MODELS[2];
    let mut system = free(sections).map_err(|outcome| outcome.words())?;
    let mut energies = Vec::new();
    for (integrator, colour) in INTEGRATORS.into_iter().zip(COLOURS) {
        let point = |share: f64| {
            let error = energy_error(&mut system, integrator, share);
            (share.log10(), error.max(1e-16).log10())
        };
        let points = SHARES.map(point).to_vec();
        energies.push(series(&format!("{integrator:?}"), colour, points, false));
    }
    let chart = Chart {
        title: &format!("Energy of a {model} filament over 1000 steps of small motion"),
        x_label: "log10 of the step over the stability limit",
        y_label: "log10 of the largest relative deviation",
        series: energies,
        equal_axes: false,
    };
    chart.draw(&out.join("extremes-energy.svg"))
}
