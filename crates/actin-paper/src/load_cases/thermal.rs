//! Free rods in a heat bath: persistence length and twisting rigidity from how cross-sections turn against
//! each other, beside what monomers have.
//!
//! Slopes are taken between 1/5 and 3/5 of the length, as for monomers (`docs/measured/heat.md`).

use super::bound::Group;
use super::filament::{Made, Rod};
use super::row::Row;
use crate::measure::{Sampled, Turns, jackknife, steps_in};
use actin_integrate::{Bath, Drag, PEFRL, advance_in, largest_frequency, stable_step};
use actin_sim::{Assembly, BOLTZMANN_PN_NM_PER_K, Equilibrium, Output, RodLaw, Scene, Task};
use rayon::prelude::*;

/// Temperature (K).
const ROOM: f64 = 298.0;
/// Drag rate (1/ns): near critical for the slowest bending.
const DRAG: f64 = 5.0;
/// Motion before the first sample, and between samples (ns).
const WARM_UP_NS: f64 = 5.0;
const APART_NS: f64 = 0.25;
/// Samples of one replica.
const SAMPLES: u32 = 400;
/// Replicas, which differ in noise.
const REPLICAS: u64 = 192;
const QUICK_REPLICAS: u64 = 8;
/// Time step as a share of the stability limit.
const SHARE: f64 = 0.5;
/// Length (nm).
const LENGTH_NM: f64 = 110.0;

/// Persistence length (um) and twisting rigidity (pN nm^2) of the mean filament and of drawn ones, each
/// with its standard error, measured with the same protocol (`docs/measured/heat.md`).
const MONOMERS: [(&str, [f64; 2], [f64; 2]); 2] = [
    ("persistence length", [11.49, 0.06], [11.17, 0.12]),
    ("C", [7.63e3, 0.03e3], [7.32e3, 0.06e3]),
];

/// Both rows of a law.
pub(super) fn rows(name: &str, law: &RodLaw, quick: bool) -> Vec<Row> {
    let replicas = if quick { QUICK_REPLICAS } else { REPLICAS };
    let all = (0..replicas).into_par_iter().map(|k| replica(law, k));
    let all: Result<Vec<Turns>, String> = all.collect();
    let (measured, note) = match all {
        Ok(turns) => (Some(measure(&turns)), String::new()),
        Err(error) => (None, format!("rod: {error}")),
    };
    let row = |i: usize| {
        let (quantity, mean, drawn) = MONOMERS[i];
        let known = |[mean, error]: [f64; 2]| Sampled {
            mean,
            error,
            deviation: f64::NAN,
            count: 1,
        };
        let rod = measured.map(|m| m[i]);
        let error = |of: f64| rod.map(|(value, _)| value / of - 1.0);
        Row {
            group: Group::Thermal,
            case: "110 nm, 298 K".to_owned(),
            quantity: quantity.to_owned(),
            law: name.to_owned(),
            mean: Some(known(mean)),
            drawn: Some(known(drawn)),
            rod: rod.map(|(value, _)| value),
            fine: None,
            rod_of_drawn: rod.map(|(value, _)| value),
            error_mean: error(mean[0]),
            error_drawn: error(drawn[0]),
            error_fine: None,
            scatter: None,
            bound: Group::Thermal.bound(quantity),
            note: rod.map_or(note.clone(), |(_, error)| {
                format!("standard error of {quantity}: {error:.2}, {replicas} replicas")
            }),
        }
    };
    vec![row(0), row(1)]
}

/// How one free rod turns in the bath.
fn replica(law: &RodLaw, replica: u64) -> Result<Turns, String> {
    // As a scene with a heat bath takes it.
    let law = match law {
        RodLaw::Homogenised => &RodLaw::HomogenisedAt298K,
        law => law,
    };
    let scene = Scene {
        title: "Rod in a heat bath".to_owned(),
        filament: Made::Rod(Rod::coarse(law)).filament(LENGTH_NM),
        further: Vec::new(),
        clamps: Vec::new(),
        loads: Vec::new(),
        linkers: Vec::new(),
        repulsion: None,
        path: Vec::new(),
        observe: Vec::new(),
        burn_in_ns: None,
        output: Output::default(),
        task: Task::Equilibrium(Equilibrium::default()),
    };
    let mut assembly = Assembly::build(&scene).map_err(|e| e.to_string())?;
    let frequency = largest_frequency(&assembly.system).map_err(|e| e.to_string())?;
    let step = stable_step(&PEFRL, frequency, SHARE).map_err(|e| e.to_string())?;
    let drag = Drag::new(DRAG, DRAG).map_err(|e| e.to_string())?;
    let bath = Bath::new(drag, BOLTZMANN_PN_NM_PER_K * ROOM, replica + 1);
    let bath = bath.map_err(|e| e.to_string())?;
    let (warm_up, apart) = (steps_in(WARM_UP_NS, step), steps_in(APART_NS, step));
    let rest = assembly.rest.clone();
    let mut turns = Turns::new(rest.frames.len());
    advance_in(&mut assembly.system, &PEFRL, step, warm_up, &bath, 0);
    for sample in 0..SAMPLES {
        let first = warm_up + u64::from(sample) * apart;
        advance_in(&mut assembly.system, &PEFRL, step, apart, &bath, first);
        turns.add(&rest, assembly.system.state(), SAMPLES as usize);
    }
    Ok(turns)
}

/// Persistence length (um) and twisting rigidity (pN nm^2) with their standard errors.
fn measure(all: &[Turns]) -> [(f64, f64); 2] {
    let count = all[0].cosine.len();
    let (from, to) = (count / 5, 3 * count / 5);
    let distance = (to - from) as f64 * LENGTH_NM / count as f64;
    let slope = |of: &dyn Fn(&Turns, usize) -> f64, logarithm: bool| {
        jackknife(all, |chosen| {
            let at = |k: usize| {
                let mean = chosen.iter().map(|t| of(t, k)).sum::<f64>() / chosen.len() as f64;
                if logarithm { -mean.ln() } else { mean }
            };
            distance / (at(to) - at(from))
        })
    };
    let (length, length_error) = slope(&|t, k| t.cosine[k], true);
    let (turn, turn_error) = slope(&|t, k| t.twist[k], false);
    let kt = BOLTZMANN_PN_NM_PER_K * ROOM;
    [
        (length / 1e3, length_error / 1e3),
        (kt * turn, kt * turn_error),
    ]
}
