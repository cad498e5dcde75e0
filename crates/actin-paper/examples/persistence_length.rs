//! Persistence length from thermal motion: of the rod against B/kT and under its laws, and of the
//! ellipsoid filament, with error bars, against the time step and against the temperature.
//!
//! `cargo run --release -p actin-paper --example persistence_length [SEEDS [CASE [FIRST]]]`
//!
//! Free filaments in a heat bath; of the turn of one cross-section against another at distance `s`,
//! `<cos theta> = exp(-s/lp)` and `<phi^2> - <phi>^2 = s kT/C`, where `theta` tilts the axis and `phi` goes
//! about it. `near` takes neighbours; `far` takes the slopes between 1/5 and 3/5 of 110 nm,
//! which the wobble of single monomers does not enter; `further`, between 2/5 and 4/5. Errors are standard errors over seeds, by
//! the jackknife; each seed is another noise and, of monomers, another sampling of anchors, but for
//! the mean filament (`-mean`). Cases in `-water` move without inertia, their monomers with quasi-harmonic
//! interfaces of other thermal motion in each seed. The case `cost` tells what the bath adds to a step.

use actin_integrate::stable_step;
use actin_integrate::{Bath, Composition, Drag, PEFRL, POSITION_VERLET, advance, advance_in};
use actin_mechanics::System;
use actin_paper::measure::{RotationCorrelations, jackknife, steps_in};
use actin_sim::{Assembly, BOLTZMANN_PN_NM_PER_K, Plan, Scene};
use rayon::prelude::*;
use std::ops::Range;
use std::time::Instant;

/// Temperature (K).
const ROOM: f64 = 298.0;
/// Drag rate (1/ns): near critical for the slowest bending of 110 nm, 2.3 rad/ns.
const DRAG: f64 = 5.0;
/// Motion before the first sample (ns), ten times the slowest relaxation.
const WARM_UP_NS: f64 = 5.0;
/// Time between samples (ns).
const APART_NS: f64 = 0.25;
/// Samples of one seed.
const SAMPLES: usize = 400;
/// The same in water, where the slowest bending takes 20 ns.
const SAMPLES_IN_WATER: usize = 2000;
/// Time between samples in water (ns).
const APART_IN_WATER_NS: f64 = 50.0;

/// What is measured, and how.
struct Case {
    name: &'static str,
    sections: &'static str,
    /// Anchors, and more of monomers.
    monomers: &'static str,
    law: &'static str,
    scheme: &'static Composition,
    /// Time step as a share of the stability limit.
    share: f64,
    temperature: f64,
}

/// Length of the filaments, but for those in `-220` (nm).
const LENGTH_NM: f64 = 110.0;
const ROD: &str = "Rod(from_nm: 0.0, to_nm: 110.0, segments: 11)";
const MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 110.0)";
/// Twice as long, so that ends matter less.
const LONG_ROD: &str = "Rod(from_nm: 0.0, to_nm: 220.0, segments: 22)";
const LONG_MONOMERS: &str = "Ellipsoids(from_nm: 0.0, to_nm: 220.0)";

/// Names, sections and steps (ns) of filaments in water.
const IN_WATER: [(&str, &str, f64); 3] = [
    ("rod-water", ROD, 5.0),
    ("monomers-water", MONOMERS, 25.0),
    ("monomers-water", MONOMERS, 5.0),
];

/// `Homogenised` as a scene with a heat bath takes it.
const AT_298_K: &str = "HomogenisedAt298K";

const MEAN: &str = "anchors: Cubature";
const DRAWN: &str = "anchors: Independent, seed: SEED";
/// Interfaces of the published rigidity, 392.0 and 582.4 kT/nm^2 (pN/nm), without the factor 1.4.
const UNSCALED: &str = "anchors: Independent, seed: SEED, \
    lateral_rigidity_pn_per_nm: 1612.7, longitudinal_rigidity_pn_per_nm: 2396.0";

const COLD: &str = "monomers-cold";

fn cases() -> Vec<Case> {
    let case = |name, sections, scheme, share, temperature| Case {
        name,
        sections,
        monomers: DRAWN,
        law: "Constant",
        scheme,
        share,
        temperature,
    };
    let rod_of = |name, law| Case {
        law,
        ..case(name, ROD, &PEFRL, 0.5, ROOM)
    };
    let monomers_of = |name, scheme, share, monomers| Case {
        monomers,
        ..case(name, MONOMERS, scheme, share, ROOM)
    };
    vec![
        rod_of("rod", "Constant"),
        case("rod", ROD, &POSITION_VERLET, 0.8, ROOM),
        case("rod", ROD, &POSITION_VERLET, 0.4, ROOM),
        rod_of("rod-published", "PublishedExtension"),
        rod_of("rod-coupling", "CouplingEnergy"),
        rod_of("rod-fitted", "Fitted"),
        rod_of("rod-athermal", "HomogenisedAthermal"),
        rod_of("rod-homogenised", AT_298_K),
        rod_of("rod-homogenised-220", AT_298_K).of(LONG_ROD),
        case("monomers", MONOMERS, &PEFRL, 0.5, ROOM),
        monomers_of("monomers-mean", &PEFRL, 0.5, MEAN),
        monomers_of("monomers-mean-220", &PEFRL, 0.5, MEAN).of(LONG_MONOMERS),
        case("monomers-fine", MONOMERS, &PEFRL, 0.25, ROOM),
        case("monomers-verlet", MONOMERS, &POSITION_VERLET, 0.4, ROOM),
        case("monomers-verlet", MONOMERS, &POSITION_VERLET, 0.2, ROOM),
        monomers_of("monomers-unscaled", &POSITION_VERLET, 0.4, UNSCALED),
        case(COLD, MONOMERS, &POSITION_VERLET, 0.4, 0.1 * ROOM),
        case(COLD, MONOMERS, &POSITION_VERLET, 0.4, 0.01 * ROOM),
    ]
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let seeds: u64 = arguments.next().map_or(32, |s| s.parse().expect("a count"));
    let wanted = arguments.next();
    let first: u64 = arguments.next().map_or(1, |s| s.parse().expect("a seed"));
    println!("{seeds} seeds of {SAMPLES} samples, {APART_NS} ns apart, drag {DRAG} per ns");
    println!("lengths in um, rigidities kT lp and C in pN nm^2, U/n in kT per degree of freedom");
    let cases = cases().into_iter();
    let is_wanted = |name: &str| wanted.as_ref().is_none_or(|w| w == name);
    let seeds = first..first + seeds;
    if is_wanted("cost") {
        cost("rod, 11 segments", ROD);
        cost("monomers, 40 of 64 bonds an interface", MONOMERS);
    }
    for case in cases.filter(|case| is_wanted(case.name)) {
        let sums = seeds.clone().into_par_iter();
        case.report(&sums.map(|seed| case.measure(seed)).collect::<Vec<_>>());
    }
    for case in IN_WATER.into_iter().filter(|case| is_wanted(case.0)) {
        report_in_water(case, seeds.clone());
    }
}

fn report_in_water((name, sections, step): (&str, &str, f64), seeds: Range<u64>) {
    let sums = seeds.into_par_iter();
    let sums: Vec<Sums> = sums.map(|seed| in_water(sections, step, seed)).collect();
    let found = measured(&sums, BOLTZMANN_PN_NM_PER_K * ROOM);
    println!("{name:18} {ROOM:5.1} K without inertia {found}");
}

/// One seed of a filament in water, in steps of `step` (ns); see [`IN_WATER`].
fn in_water(sections: &str, step: f64, seed: u64) -> Sums {
    let duration_ms = 1e-6 * APART_IN_WATER_NS * SAMPLES_IN_WATER as f64;
    let text = format!(
        "Scene(
            filament: Filament(sections: [{sections}]),
            task: Brownian(
                duration_ms: {duration_ms:?}, temperature_k: {ROOM:?}, seed: {seed}, time_step_ns: {step:?},
                record_every_ns: {APART_IN_WATER_NS:?}, interfaces: QuasiHarmonic(),
            ),
        )"
    );
    let scene = Scene::from_ron(&text).unwrap_or_else(|error| panic!("water:{error}"));
    let assembly = Assembly::build(&scene).expect("a filament");
    let plan = Plan::new(&assembly).expect("a motion that can run");
    let (trajectory, _) = plan.run().expect("a motion");
    // As built it is not yet warm.
    let (_, records) = trajectory.records.split_at(SAMPLES_IN_WATER / 100);
    let mut sums = Sums::new(&assembly, step);
    let dofs = 3.0 * (assembly.rest.points.len() + assembly.rest.frames.len()) as f64;
    for record in records {
        sums.turns.add(&assembly.rest, &record.state, records.len());
        let energy: f64 = record.energies_pn_nm.iter().sum();
        sums.energy += energy / (BOLTZMANN_PN_NM_PER_K * ROOM * dofs * records.len() as f64);
    }
    sums
}

/// Prints what a step takes without drag, with drag, and in the bath; the best of many short runs.
fn cost(name: &str, sections: &'static str) {
    let (steps, runs) = (20, 1000);
    let case = Case {
        sections,
        ..cases().remove(0)
    };
    for scheme in [&POSITION_VERLET, &PEFRL] {
        let mut system = Assembly::build(&case.scene(1)).expect("a filament").system;
        let drag = Drag::new(DRAG, DRAG).expect("positive rates");
        let kt = BOLTZMANN_PN_NM_PER_K * ROOM;
        let bath = Bath::new(drag, kt, 1).expect("a positive energy");
        let h = 1e-3;
        advance_in(&mut system, scheme, h, 1000, &bath, 0);
        let mut best = |run: &dyn Fn(&mut System)| {
            let mut once = || {
                let started = Instant::now();
                run(&mut system);
                started.elapsed().as_secs_f64() / steps as f64 * 1e6
            };
            (0..runs).map(|_| once()).fold(f64::INFINITY, f64::min)
        };
        let heated = best(&|system| advance_in(system, scheme, h, steps, &bath, 0));
        let damped = best(&|system| advance(system, scheme, h, steps, &drag));
        let free = best(&|system| advance(system, scheme, h, steps, &Drag::NONE));
        println!(
            "{name}, {}: {free:.2} us a step, {damped:.2} with drag, {heated:.2} in the bath",
            scheme.name()
        );
    }
}

/// Means over one seed.
struct Sums {
    turns: RotationCorrelations,
    /// Potential energy per degree of freedom (kT).
    energy: f64,
    /// Distance of neighbouring frames along the axis (nm).
    spacing: f64,
    /// Time step (ns).
    step: f64,
}

impl Sums {
    /// None yet.
    fn new(assembly: &Assembly, step: f64) -> Self {
        let turns = RotationCorrelations::new(assembly);
        let [first, second] = [0, 1].map(|i| assembly.frames[turns.frames[i]].s_nm);
        Self {
            turns,
            energy: 0.0,
            spacing: second - first,
            step,
        }
    }
}

impl Sums {
    /// Frames of 110 nm of the filament.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "some tens"
    )]
    fn frames_of_110_nm(&self) -> usize {
        (LENGTH_NM / self.spacing).round() as usize
    }
}

impl Case {
    /// The same of other sections.
    fn of(self, sections: &'static str) -> Self {
        Self { sections, ..self }
    }

    fn scene(&self, seed: u64) -> Scene {
        let (sections, law, temperature) = (self.sections, self.law, self.temperature);
        let monomers = self.monomers.replace("SEED", &seed.to_string());
        let text = format!(
            "Scene(
                filament: Filament(
                    sections: [{sections}],
                    monomers: ({monomers}),
                    rod: RodModel(law: {law}),
                ),
                task: Dynamics(
                    duration_ns: 1.0,
                    drag: (translational_per_ns: {DRAG:?}, rotational_per_ns: {DRAG:?}),
                    thermal: (temperature_k: {temperature:?}, seed: {seed}),
                ),
            )"
        );
        Scene::from_ron(&text).unwrap_or_else(|error| panic!("{}:{error}", self.name))
    }

    fn measure(&self, seed: u64) -> Sums {
        let mut assembly = Assembly::build(&self.scene(seed)).expect("a filament");
        let plan = Plan::new(&assembly).expect("a motion that can run");
        let estimate = plan.estimate().expect("a motion");
        let frequency = estimate.largest_frequency_rad_per_ns;
        let system = &mut assembly.system;
        let h = stable_step(self.scheme, frequency, self.share).expect("a stable step");
        let kt = BOLTZMANN_PN_NM_PER_K * self.temperature;
        let drag = Drag::new(DRAG, DRAG).expect("positive rates");
        let bath = Bath::new(drag, kt, seed).expect("a positive energy");
        let (warm_up, apart) = (steps_in(WARM_UP_NS, h), steps_in(APART_NS, h));
        advance_in(system, self.scheme, h, warm_up, &bath, 0);
        let rest = assembly.rest.clone();
        let dofs = 3.0 * (rest.points.len() + rest.frames.len()) as f64;
        let mut sums = Sums::new(&assembly, h);
        for sample in 0..SAMPLES as u64 {
            let system = &mut assembly.system;
            let first = warm_up + sample * apart;
            advance_in(system, self.scheme, h, apart, &bath, first);
            sums.turns.add(&rest, system.state(), SAMPLES);
            sums.energy += system.potential_energy() / (kt * dofs * SAMPLES as f64);
        }
        sums
    }

    fn report(&self, sums: &[Sums]) {
        println!(
            "{:18} {:5.1} K {:15} ({:.2} of the limit) {}",
            self.name,
            self.temperature,
            self.scheme.name(),
            self.share,
            measured(sums, BOLTZMANN_PN_NM_PER_K * self.temperature)
        );
    }
}

/// Persistence lengths, rigidities and the energy of all seeds at a thermal energy `kt` (pN nm), in words.
fn measured(sums: &[Sums], kt: f64) -> String {
    let spacing = sums[0].spacing;
    let count = sums[0].frames_of_110_nm();
    let (near, far) = ((0, 1), (count / 5, 3 * count / 5));
    let further = (2 * count / 5, 4 * count / 5);
    let of = |&(a, b): &(usize, usize), value: fn(&[&RotationCorrelations], usize) -> f64| {
        jackknife(sums, |chosen| {
            let turns: Vec<&RotationCorrelations> = chosen.iter().map(|sums| &sums.turns).collect();
            (b - a) as f64 * spacing / (value(&turns, b) - value(&turns, a))
        })
    };
    let (bend, bend_error) = of(&near, RotationCorrelations::tilt);
    let (long, long_error) = of(&far, RotationCorrelations::tilt);
    let (turn, turn_error) = of(&far, RotationCorrelations::twist_variance);
    let (turn_further, further_error) = of(&further, RotationCorrelations::twist_variance);
    let (energy, energy_error) = jackknife(sums, |chosen| {
        chosen.iter().map(|s| s.energy).sum::<f64>() / chosen.len() as f64
    });
    format!(
        "h {:.2e} ns: near {:6.2} +- {:.2}, far {:6.2} +- {:.2}; kT lp {:.2e} +- {:.0e}, C {:.2e} +- {:.0e}, \
         further {:.2e} +- {:.0e}; U/n \
         {energy:.4} +- {energy_error:.4}",
        sums[0].step,
        bend / 1000.0,
        bend_error / 1000.0,
        long / 1000.0,
        long_error / 1000.0,
        kt * long,
        kt * long_error,
        kt * turn,
        kt * turn_error,
        kt * turn_further,
        kt * further_error,
    )
}
