//! Filaments with very few and very many bodies, scenes that exceed the memory, and a filament far from the origin.

use super::fields::run_short;
use super::row::{CaseResult, Expected, Outcome, Row, correct, larger};
use super::scenes::{Parts, build};
use actin_integrate::{Drag, PEFRL, advance};
use actin_mechanics::{
    Interaction, Loads, State, Vector3, Xorshift, perturb, randomise_velocities,
};
use actin_sim::Plan;
use actin_sim::coupling::Linker;
use std::time::Instant;

const SMALLEST: [(&str, &str); 3] = [
    ("1 segment", "Rod(from_nm: 0.0, to_nm: 10.0, segments: 1)"),
    ("3 monomers", "Ellipsoids(from_nm: 0.0, to_nm: 2.7)"),
    (
        "2 monomers between 2 segments",
        "Rod(from_nm: 0.0, to_nm: 10.0, segments: 1), Ellipsoids(from_nm: 10.0, to_nm: 15.5),
             Rod(from_nm: 15.5, to_nm: 25.5, segments: 1)",
    ),
];
const TOO_SMALL: [(&str, &str); 2] = [
    ("0 segments", "Rod(from_nm: 0.0, to_nm: 10.0, segments: 0)"),
    ("2 monomers", "Ellipsoids(from_nm: 0.0, to_nm: 1.3)"),
];

pub(super) fn sizes(is_long: bool) -> Vec<Row> {
    let small = |(name, sections): (&str, &str)| {
        let tried = moved(&Parts::free(sections).text(), 1000);
        Row::new("size", name, tried)
    };
    let refused = TOO_SMALL.map(|case| small(case).expecting(Expected::Refused));
    let (bodies, count, expected) = if is_long {
        (1_000_000, 100_000, Expected::Sound)
    } else {
        (1_000, 1_000, Expected::Correct)
    };
    let clock = Instant::now();
    let tried = driven(count);
    let seconds = clock.elapsed().as_secs_f64();
    let case = format!(
        "{:.0e} stages, each of which moves another of as many loads: built in {seconds:.1} s",
        f64::from(count)
    );
    let large = largest(bodies)
        .into_iter()
        .chain([Row::new("size", case, tried)]);
    let large = large.map(|row| row.expecting(expected));
    let smallest = SMALLEST.into_iter().map(small);
    smallest.chain(refused).chain(large).collect()
}

/// Many bodies, in one filament and in a hundredth as many filaments.
fn largest(count: u32) -> Vec<Row> {
    let (filaments, length) = (count / 100, f64::from(count));
    let (rod_nm, monomers_nm) = (10.0 * length, 71.2 / 26.0 * length);
    let rod = format!("Rod(from_nm: 0.0, to_nm: {rod_nm:?}, segments: {count})");
    let monomers = format!("Ellipsoids(from_nm: 0.0, to_nm: {monomers_nm:?})");
    let rods = "Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)";
    let pairs = "Ellipsoids(from_nm: 0.0, to_nm: 10.0), Rod(from_nm: 10.0, to_nm: 50.0)";
    let texts = [
        (count, "segments", Parts::free(&rod).text()),
        (count, "monomers", Parts::free(&monomers).text()),
        (
            filaments,
            "rods of 4 segments",
            side_by_side(filaments, rods),
        ),
        (
            filaments,
            "filaments of monomers and rod",
            side_by_side(filaments, pairs),
        ),
    ];
    let row = |(count, name, text): (u32, &str, String)| {
        let clock = Instant::now();
        let tried = moved(&text, 20);
        let (seconds, memory) = (clock.elapsed().as_secs_f64(), peak_memory_mb());
        let case = format!(
            "{:.0e} {name}: built, estimated and 20 steps in {seconds:.1} s, at most {memory:.0} MB",
            f64::from(count)
        );
        Row::new("size", case, tried)
    };
    texts.map(row).to_vec()
}

fn driven(count: u32) -> CaseResult {
    let load = "EndForce(end: End, force_pn: (0.001, 0.0, 0.0)), ".repeat(count as usize);
    let stage = |i: u32| format!("Stage(set: [LoadFactor(load: {i}, factor: {}.0)]), ", i + 1);
    let stages: String = (0..count).map(stage).collect();
    let assembly = Parts::new(
        "Rod(from_nm: 0.0, to_nm: 40.0, segments: 4)",
        format!("clamps: [Clamp(end: Start)], loads: [{load}], path: [{stages}],"),
        "Equilibrium()",
    )
    .build()?;
    Plan::new(&assembly).map_err(|problem| Outcome::Refused(problem.to_string()))?;
    let mut state = assembly.rest.clone();
    assembly.drive.place(&mut state, f64::from(count));
    let controls = state.controls.values().iter().zip(1_u32..);
    let error = controls.map(|(factor, i)| (factor - f64::from(i)).abs());
    correct("factors", error.fold(0.0, f64::max), 0.0)
}

fn side_by_side(count: u32, sections: &str) -> String {
    let filament = |i: u32| {
        let at = 20 * i;
        format!(
            "Filament(sections: [{sections}], at_nm: ({at}.0, 0.0, 0.0), rod: RodModel(law: Constant)), "
        )
    };
    let filaments: String = (0..count).map(filament).collect();
    format!("Scene(filaments: [{filaments}], task: Dynamics(duration_ns: 1.0))")
}

fn peak_memory_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = line.and_then(|line| line.trim().strip_suffix(" kB")?.parse::<f64>().ok());
    kilobytes.map_or(f64::NAN, |kb| kb / 1024.0)
}

fn moved(text: &str, steps: u64) -> CaseResult {
    let mut assembly = build(text)?;
    let plan = Plan::new(&assembly).map_err(|problem| Outcome::Refused(problem.to_string()))?;
    let step = plan.estimate().expect("a motion").time_step_ns;
    let system = &mut assembly.system;
    randomise_velocities(system.state_mut(), &mut Xorshift::new(2), 1.0, 0.1);
    let before = system.state().momentum();
    advance(system, &PEFRL, step, steps, &Drag::NONE);
    let points = system.state().points.len() as f64;
    let error = (system.state().momentum() - before).norm() / before.norm();
    // Round-off of a sum over all points, relative to the magnitude of the sum of random vectors.
    correct("momentum", error, 1e-13 * points.sqrt().max(10.0))
}

const BEYOND: &str = include_str!("guards.csv");

/// Time limit of a refusal (s), a thousand times longer than usual.
const PATIENCE_S: f64 = 30.0;

pub(super) fn guards() -> Vec<Row> {
    let row = |line: Result<[String; 3], csv::Error>| {
        let [case, sections, task] = line.expect("three columns");
        let text = format!(
            "Scene(filament: Filament(sections: [{sections}], rod: RodModel(law: Constant)), clamps: [Clamp(end: Start)],
                    task: {task})"
        );
        let clock = Instant::now();
        let outcome = match run_short(&text) {
            Err(error) if clock.elapsed().as_secs_f64() < PATIENCE_S => error.into(),
            other => Outcome::Wrong(format!("{other:?} after {:?}", clock.elapsed())),
        };
        Row::new("guard", case, Ok(outcome)).expecting(Expected::Refused)
    };
    let mut table = csv::Reader::from_reader(BEYOND.as_bytes());
    table.deserialize().map(row).collect()
}

const SHIFTS: [f64; 4] = [1e2, 1e4, 1e5, 1e6];

/// Largest stiffness (pN/nm): stretch of a segment of 5 nm.
const STIFFNESS: f64 = 3.4e4 / 5.0;

const LINKED: &str = include_str!("linked.ron");

pub(super) fn origin() -> Vec<Row> {
    let row = |by| Row::new("origin", format!("moved by {by:.0e} nm"), shifted(by));
    SHIFTS.map(row).to_vec()
}

fn shifted(shift: f64) -> CaseResult {
    let mut assembly = build(LINKED)?;
    let shaken = assembly.system.state_mut();
    perturb(shaken, &mut Xorshift::new(7), 0.05, 0.02);
    let here = assembly.system.state().clone();
    let mut there = here.clone();
    let by = Vector3::new(shift, -shift, shift);
    for i in 0..there.points.len() {
        there.points.position.add(i, by);
    }
    let anchors = assembly.linkers.iter();
    for controls in anchors.filter_map(Linker::anchor_controls) {
        for (control, by) in controls.into_iter().zip(by.iter()) {
            there.controls[control] += by;
        }
    }
    let [a, b] = [&here, &there].map(|state| loads(assembly.system.interactions(), state));
    let forces = a.force.iter().zip(b.force.iter());
    let both = forces.chain(a.torque.iter().zip(b.torque.iter()));
    let largest = both.map(|(a, b)| (a - b).norm()).fold(0.0, larger);
    // Each position is rounded to half a unit in the last place; up to 128 bonds attach to a body.
    let rounding = shift * f64::EPSILON * STIFFNESS;
    let what = "loads (pN, pN nm), round-off of places times stiffness";
    correct(what, largest, 10.0 * rounding)
}

pub(super) fn loads(interactions: &[Box<dyn Interaction>], state: &State) -> Loads {
    let mut loads = Loads::zeros(state);
    for interaction in interactions {
        interaction.add_loads(state, &mut loads);
    }
    loads
}
