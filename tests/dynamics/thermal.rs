//! Equipartition of filaments in a heat bath. Tolerances are 4.5 standard errors at fixed seeds.

use super::filaments::{FILAMENTS, KBT, assemble, mean_and_error};
use super::modes::Modes;
use crate::common::{build, ran};
use actin_integrate::{Bath, Drag, PEFRL, advance_in, largest_frequency, stable_step};

use actin_mechanics::{State, System};
use actin_sim::{Assembly, ForceLaw};
use std::collections::BTreeMap;

const ERRORS: f64 = 4.5;

fn bath(rate: f64, kt: f64, seed: u64) -> Bath {
    Bath::new(Drag::new(rate, rate).unwrap(), kt, seed).unwrap()
}

/// Step with an error of 3e-4 in the temperature of the fastest mode.
fn step(system: &System) -> f64 {
    stable_step(&PEFRL, largest_frequency(system).unwrap(), 0.25).unwrap()
}

fn assert_is_one(what: &str, blocks: &[f64]) {
    let (mean, error) = mean_and_error(blocks);
    println!("{what}: {mean:.4} +- {error:.4}");
    assert!((mean - 1.0).abs() < ERRORS * error, "{what}");
    // The scatter must not hide errors.
    assert!(error < 0.05, "{what}: {error}");
}

/// Twice the kinetic energy per degree of freedom in kT for each kind of point and frame, and for
/// the centre of mass.
fn temperatures(assembly: &Assembly, state: &State) -> BTreeMap<String, f64> {
    let mut sums: BTreeMap<String, (f64, f64)> = BTreeMap::new();
    let mut add = |key: String, energy: f64| {
        let sum = sums.entry(key).or_default();
        *sum = (sum.0 + energy, sum.1 + 3.0 * KBT);
    };
    for (i, info) in assembly.points.iter().enumerate() {
        let v = state.points.velocity.get(i);
        let energy = v.norm_squared() / state.points.inverse_mass()[i];
        add(format!("point of {:?}", info.kind), energy);
    }
    for (i, info) in assembly.frames.iter().enumerate() {
        let l = state.frames.angular_momentum.get(i);
        let energy = l.dot(&state.frames.angular_velocity(i, l));
        add(format!("frame of {:?}", info.kind), energy);
    }
    let mass: f64 = state.points.inverse_mass().iter().map(|m| 1.0 / m).sum();
    let momentum = state.momentum();
    add("whole".to_owned(), momentum.norm_squared() / mass);
    let share = |(key, (sum, whole))| (key, sum / whole);
    sums.into_iter().map(share).collect()
}

#[test]
fn every_kind_of_body_has_the_temperature() {
    for (filament, kinds) in FILAMENTS.into_iter().zip([3, 3, 6, 6]) {
        let mut assembly = assemble(filament, ForceLaw::EnergyGradient);
        let h = step(&assembly.system);
        // Momenta decorrelate in 1/60 ns, some ten steps.
        let bath = bath(60.0, KBT, 3);
        let mut now = 0;
        let mut advance = |assembly: &mut Assembly, steps| {
            advance_in(&mut assembly.system, &PEFRL, h, steps, &bath, now);
            now += steps;
        };
        advance(&mut assembly, 500);
        let mut blocks: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        for _ in 0..40 {
            let mut sums: BTreeMap<String, f64> = BTreeMap::new();
            for _ in 0..40 {
                advance(&mut assembly, 15);
                for (key, value) in temperatures(&assembly, assembly.system.state()) {
                    *sums.entry(key).or_default() += value / 40.0;
                }
            }
            for (key, value) in sums {
                blocks.entry(key).or_default().push(value);
            }
        }
        assert_eq!(blocks.len(), kinds, "{:?}", blocks.keys());
        for (what, blocks) in blocks {
            assert_is_one(&format!("{}, {what}", filament.0), &blocks);
        }
    }
}

/// Rod on a wall with segments of 10 nm in a bath of kT/100, where modes are linear. Samples start
/// after `warm` steps and are `apart` steps apart.
struct Sampled {
    segments: usize,
    h_over_step: f64,
    drag: Drag,
    seed: u64,
    warm: u64,
    apart: u64,
}

impl Sampled {
    /// Potential energies of the slow, middle and fast thirds of the modes and of all, over their
    /// expectation: means of 50 samples, in 40 blocks.
    fn shares(&self) -> [Vec<f64>; 4] {
        let kt = 0.01 * KBT;
        let mut system = build(&format!(
            "Scene(
                filament: Filament(
                    sections: [Rod(from_nm: 0.0, to_nm: {}0.0, segments: {})], rod: RodModel(law: Constant),
                ),
                clamps: [Clamp(end: Start)],
                task: Dynamics(duration_ns: 1.0),
            )",
            self.segments, self.segments
        ))
        .system;
        let rest = system.state().clone();
        let modes = Modes::new(&system);
        let h = self.h_over_step * step(&system);
        let bath = Bath::new(self.drag, kt, self.seed).unwrap();
        let mut now = self.warm;
        advance_in(&mut system, &PEFRL, h, now, &bath, 0);
        let mut shares = [(); 4].map(|()| Vec::new());
        for _ in 0..40 {
            let mut sums = [0.0; 4];
            for _ in 0..50 {
                advance_in(&mut system, &PEFRL, h, self.apart, &bath, now);
                now += self.apart;
                let energies = modes.energies(&rest, system.state());
                let third = energies.len() / 3;
                for (k, energy) in energies.iter().enumerate() {
                    let share = energy / (50.0 * kt);
                    sums[k / third] += share / third as f64;
                    sums[3] += share / energies.len() as f64;
                }
            }
            for (shares, sum) in shares.iter_mut().zip(sums) {
                shares.push(sum);
            }
        }
        shares
    }
}

/// Every mode has kT/2 of potential energy. The second case has a drag beyond the resolution of a
/// step, different for points and frames: `g h` of 3 and 1.
#[test]
fn every_mode_of_a_clamped_rod_has_its_share() {
    for (what, sampled) in [
        // Critical for the slowest mode, 2.7 rad/ns, which then relaxes within 0.4 ns.
        (
            "resolved drag",
            Sampled {
                segments: 4,
                h_over_step: 1.0,
                drag: Drag::new(5.0, 5.0).unwrap(),
                seed: 8,
                warm: 2000,
                apart: 60,
            },
        ),
        // The slowest mode relaxes in 1000/11^2 = 8 ns.
        (
            "strong and unlike drag",
            Sampled {
                segments: 2,
                h_over_step: 2.0,
                drag: Drag::new(1000.0, 350.0).unwrap(),
                seed: 9,
                warm: 50_000,
                apart: 400,
            },
        ),
    ] {
        for (modes, blocks) in ["slow", "middle", "fast", "all"]
            .iter()
            .zip(sampled.shares())
        {
            assert_is_one(&format!("{what}, {modes}"), &blocks);
        }
    }
}

fn end_of_scene(seed: u64, record_every_ns: f64) -> State {
    let text = format!(
        "Scene(
            filament: Filament(
                sections: [
                    Ellipsoids(from_nm: 0.0, to_nm: 30.0),
                    Rod(from_nm: 30.0, to_nm: 60.0),
                ],
                monomers: (anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: RodModel(law: Constant),
            ),
            clamps: [Clamp(end: Start), Clamp(end: End, slides: AlongAxis)],
            task: Dynamics(
                duration_ns: 0.2,
                time_step_ns: 5e-4,
                drag: (translational_per_ns: 1.0, rotational_per_ns: 2.0),
                thermal: (temperature_k: 300.0, seed: {seed}),
                record_every_ns: {record_every_ns:?},
            ),
        )"
    );
    let (_, mut trajectory, _) = ran(&text);
    trajectory.records.pop().unwrap().state
}

#[test]
fn a_scene_with_a_seed_is_one_run() {
    let reference = end_of_scene(1, 0.2);
    assert_eq!(end_of_scene(1, 0.005), reference);
    assert_eq!(end_of_scene(1, 0.0125), reference);
    assert!(end_of_scene(2, 0.2).points.position != reference.points.position);
}
