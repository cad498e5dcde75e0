//! Long undamped motion: energy without a trend, momenta to round-off.

use super::row::{Outcome, Row};
use super::stability::free;
use actin_integrate::{Drag, PEFRL, advance, largest_frequency, stable_step};
use actin_mechanics::{State, System, Vector3};
use actin_mechanics::{Xorshift, randomise_velocities};

/// Small filaments.
const FILAMENTS: [(&str, &str); 2] = [
    (
        "rod of 3 segments",
        "Rod(from_nm: 0.0, to_nm: 30.0, segments: 3)",
    ),
    ("4 monomers", "Ellipsoids(from_nm: 0.0, to_nm: 11.0)"),
];

/// What became of a run in tenths: means of the relative deviation of the energy, its largest
/// magnitude, and the changes of momentum and angular momentum (about the origin, and about the
/// centre of mass) at the end, each relative to what it begins with.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Drift {
    pub(super) means: [f64; 10],
    pub(super) largest: f64,
    pub(super) momenta: [f64; 3],
}

impl Drift {
    /// From the mean of the first three tenths to that of the last three.
    pub(super) fn trend(&self) -> f64 {
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        mean(&self.means[7..]) - mean(&self.means[..3])
    }

    /// Runs a system for `steps` steps at a quarter of the limit, its energy taken 1000 times.
    pub(super) fn of(system: &mut System, steps: u64) -> Self {
        let frequency = largest_frequency(system).expect("loads at rest are finite");
        let h = stable_step(&PEFRL, frequency, 0.25).expect("it is positive");
        let start = system.total_energy();
        let before = all_momenta(system.state());
        let (mut means, mut largest) = ([0.0; 10], 0.0_f64);
        for mean in &mut means {
            for _ in 0..100 {
                advance(system, &PEFRL, h, steps / 1000, &Drag::NONE);
                let deviation = system.total_energy() / start - 1.0;
                *mean += deviation / 100.0;
                largest = largest.max(deviation.abs());
            }
        }
        let after = all_momenta(system.state());
        let change = |i: usize| (after[i] - before[i]).norm() / before[i].norm();
        Self {
            means,
            largest,
            momenta: [0, 1, 2].map(change),
        }
    }
}

/// Mass and centre of mass of the points.
fn centre(state: &State) -> (f64, Vector3) {
    let masses = state.points.inverse_mass().iter().map(|m| 1.0 / m);
    let places = state.points.position.iter();
    let moment: Vector3 = masses.clone().zip(places).map(|(m, x)| x * m).sum();
    let mass: f64 = masses.sum();
    (mass, moment / mass)
}

/// Momentum; angular momentum about the origin; the same about the centre of mass.
fn all_momenta(state: &State) -> [Vector3; 3] {
    let (linear, angular) = (state.momentum(), state.angular_momentum());
    let about_centre = angular - centre(state).1.cross(&linear);
    [linear, angular, about_centre]
}

/// Takes the motion of the centre of mass away.
fn stop_centre(state: &mut State) {
    let velocity = state.momentum() / centre(state).0;
    for i in 0..state.points.len() {
        state.points.velocity.add(i, -velocity);
    }
}

/// A free filament in motion, on its whole or about its centre of mass only.
fn moving(sections: &str, is_flying: bool) -> Result<System, Outcome> {
    let mut system = free(sections)?;
    randomise_velocities(system.state_mut(), &mut Xorshift::new(11), 2.0, 0.5);
    if !is_flying {
        stop_centre(system.state_mut());
    }
    Ok(system)
}

/// Both filaments for `steps` steps, and once more with the centre of mass at rest.
pub(super) fn rows(steps: u64) -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, sections) in FILAMENTS {
        for (motion, is_flying) in [("", true), (", centre at rest", false)] {
            let run = moving(sections, is_flying).map(|mut system| Drift::of(&mut system, steps));
            for (what, outcome) in outcomes(run, steps, is_flying) {
                let case = format!("{name}{motion}, {:.0e} steps, {what}", steps as f64);
                rows.push(Row::new("undamped", case, outcome));
            }
        }
    }
    rows
}

/// What is right about a run, by what it is; of a centre at rest momentum has no yardstick.
fn outcomes(
    run: Result<Drift, Outcome>,
    steps: u64,
    is_flying: bool,
) -> Vec<(&'static str, Outcome)> {
    let drift = match run {
        Ok(drift) => drift,
        Err(outcome) => return vec![("", outcome)],
    };
    // The energy fluctuation is the yardstick of its trend.
    let (trend, largest) = (drift.trend().abs(), 0.1 * drift.largest);
    let means = "means of the last and first three tenths";
    let mut all = vec![(
        "trend of the energy",
        Outcome::correct(means, trend, largest),
    )];
    // Round-off adds up as a walk, and as a drift where it has a sign.
    let kept = |change| Outcome::correct("relative change", change, 1e-16 * steps as f64);
    let [linear, angular, about_centre] = drift.momenta;
    if is_flying {
        all.push(("momentum", kept(linear)));
        all.push(("angular momentum", kept(angular)));
    }
    all.push((
        "angular momentum about the centre of mass",
        kept(about_centre),
    ));
    all
}
