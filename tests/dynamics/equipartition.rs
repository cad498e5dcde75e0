//! Configurational temperature of monomers in a heat bath at the default step.
//!
//! Configurations are tested by the identity `<B . grad U> = kT <div B>`, valid for every
//! potential, with two fields `B`:
//!
//! - displacement and rotation of each monomer relative to the previous one, from rest: equal
//!   weights of all modes;
//! - `M^-1 grad U`: weights with the squared frequency.

use super::filaments::KBT;
use actin_integrate::{Bath, Drag, PEFRL, Run, SAFETY, advance_in, largest_frequency, stable_step};
use actin_mechanics::{Coordinates, State, Stiffness, System, UnitQuaternion, Vector3};
use actin_sim::{Assembly, Scene};

/// Time between samples (ns): a period of the slowest modes of this short filament.
const APART_NS: f64 = 0.05;
const ERRORS: f64 = 4.5;
/// Drag (per ns).
const RATE: f64 = 5.0;

fn monomers() -> System {
    let text = "Scene(
            filament: Filament(
                sections: [Ellipsoids(from_nm: 0.0, to_nm: 35.6)],
                monomers: (anchors: Independent, seed: 1, lateral_bonds: 16, longitudinal_bonds: 16),
            ),
            task: Dynamics(duration_ns: 1.0),
        )";
    let scene = Scene::from_ron(text).unwrap();
    Assembly::build(&scene).unwrap().system
}

/// Sums of `B . grad U` and of `kT div B` over samples.
#[derive(Clone, Copy, Default)]
struct Sums {
    work: f64,
    divergence: f64,
}

impl Sums {
    fn add(&mut self, work: f64, divergence: f64) {
        self.work += work;
        self.divergence += KBT * divergence;
    }
}

type Blocks = [Vec<Sums>; 2];

struct Thermometer {
    relative: Vec<(Vector3, UnitQuaternion)>,
    stiffness: Stiffness,
}

impl Thermometer {
    fn new(rest: &State) -> Self {
        Self {
            relative: (1..rest.frames.len()).map(|i| relative(rest, i)).collect(),
            stiffness: Stiffness::default(),
        }
    }

    fn read(&mut self, system: &mut System, sums: &mut [Sums; 2]) {
        let loads = system.loads().clone();
        let state = system.state();
        let (mut work, mut divergence) = (0.0, 0.0);
        for (k, (place, orientation)) in self.relative.iter().enumerate() {
            let (moved, turned) = relative(state, k + 1);
            let displacement = state.frames.orientation.get(k) * (moved - place);
            work -= displacement.dot(&loads.force.get(k + 1));
            // The divergence of the axial vector under rotations is the trace.
            let turn = orientation.inverse() * turned;
            let trace = turn.to_rotation_matrix().matrix().trace();
            work -= (turn.imag() * (2.0 * turn.w)).dot(&loads.torque.get(k + 1));
            divergence += 3.0 + trace;
        }
        sums[0].add(work, divergence);
        let (work, divergence) = self.weighted(system, &loads);
        sums[1].add(work, divergence);
    }

    fn weighted(&mut self, system: &System, loads: &actin_mechanics::Loads) -> (f64, f64) {
        let state = system.state();
        let inverse = |body: Coordinates| match body {
            Coordinates::Point(i) => Vector3::repeat(state.points.inverse_mass()[i]),
            Coordinates::Frame(i) => state.frames.inverse_moments(i),
        };
        let square = |load: Vector3, body| load.component_mul(&load).dot(&inverse(body));
        let forces = loads.force.iter().enumerate();
        let torques = loads.torque.iter().enumerate();
        let work = forces
            .map(|(i, f)| square(f, Coordinates::Point(i)))
            .sum::<f64>()
            + torques
                .map(|(i, t)| square(t, Coordinates::Frame(i)))
                .sum::<f64>();
        self.stiffness.clear();
        for interaction in system.interactions() {
            let known = interaction
                .second_order()
                .expect("bonds have second derivatives");
            known.add_stiffness(state, &mut self.stiffness);
        }
        let blocks = self.stiffness.all().filter(|(a, b, _)| a == b);
        let trace = blocks.map(|(a, _, block)| block.diagonal().dot(&inverse(*a)));
        (work, trace.sum())
    }
}

/// Position and orientation of monomer `i` in the axes of the previous one.
fn relative(state: &State, i: usize) -> (Vector3, UnitQuaternion) {
    let (x, q) = (&state.points.position, &state.frames.orientation);
    let back = q.get(i - 1).inverse();
    (back * (x.get(i) - x.get(i - 1)), back * q.get(i))
}

fn steps(h: f64, time: f64) -> u64 {
    Run::from_duration(&PEFRL, h, time).unwrap().steps()
}

fn sample(blocks: usize, samples: usize, seed: u64) -> Blocks {
    let mut system = monomers();
    let frequency = largest_frequency(&system).unwrap();
    let h = stable_step(&PEFRL, frequency, SAFETY).unwrap();
    let drag = Drag::new(RATE, RATE).unwrap();
    let bath = Bath::new(drag, KBT, seed).unwrap();
    let mut thermometer = Thermometer::new(system.state());
    let apart = steps(h, APART_NS);
    // Until correlations with the initial state fall to exp(-10).
    let mut now = steps(h, 10.0 / RATE);
    advance_in(&mut system, &PEFRL, h, now, &bath, 0);
    let mut all: Blocks = Default::default();
    for _ in 0..blocks {
        let mut sums = [Sums::default(); 2];
        for _ in 0..samples {
            advance_in(&mut system, &PEFRL, h, apart, &bath, now);
            now += apart;
            thermometer.read(&mut system, &mut sums);
        }
        for (blocks, sums) in all.iter_mut().zip(sums) {
            blocks.push(sums);
        }
    }
    all
}

fn ratio(blocks: &[Sums]) -> (f64, f64) {
    let n = blocks.len() as f64;
    let divergence: f64 = blocks.iter().map(|b| b.divergence).sum();
    let mean = blocks.iter().map(|b| b.work).sum::<f64>() / divergence;
    let square = |b: &Sums| (b.work - mean * b.divergence).powi(2);
    let scatter: f64 = blocks.iter().map(square).sum();
    (mean, (scatter * n / (n - 1.0)).sqrt() / divergence)
}

const FIELDS: [&str; 2] = ["all motions alike", "weighted by frequency squared"];

/// At the default step the configurational temperature is within 1 % of the bath.
#[test]
fn monomers_have_the_temperature_at_their_default_step() {
    let all = sample(40, 60, 5);
    for (what, blocks) in FIELDS.iter().zip(&all) {
        let (mean, error) = ratio(blocks);
        println!("{what}: {mean:.4} +- {error:.4}");
        assert!((mean - 1.0).abs() < 0.01 + ERRORS * error, "{what}");
        assert!(error < 0.015, "{what}: {error}");
    }
}
