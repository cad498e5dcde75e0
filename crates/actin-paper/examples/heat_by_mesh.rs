//! Tension and twisting rigidity of rods in a heat bath by the length of their segments, and of monomers.
//!
//! `cargo run --release -p actin-paper --example heat_by_mesh [LAW [SEEDS]]`
//!
//! Tension: filaments clamped at both ends at a mean stretch, mean of the axial force over time. Twisting
//! rigidity `C`: `kT` over the slope of the variance of the turn between cross-sections 30 and 120 nm apart,
//! at least 45 nm from the ends of free filaments of 300 nm. Errors are standard errors over seeds, by the
//! jackknife. The law `Monomers` resolves monomers.

use actin_integrate::{Bath, Drag, PEFRL, advance_in, largest_frequency, stable_step};
use actin_mechanics::rotation;
use actin_paper::measure::{jackknife, steps_in};
use actin_sim::{Assembly, BOLTZMANN_PN_NM_PER_K, Scene};
use rayon::prelude::*;

const ROOM_K: f64 = 298.0;
/// Time step over the stability limit.
const SHARE: f64 = 0.5;
/// Motion before the first sample (ns).
const WARM_UP_NS: f64 = 20.0;
/// Steps between samples of the tension, and samples of the tension for one of the turns.
const APART: u64 = 20;
const TURNS_APART: u64 = 10;
/// Segment lengths (nm).
const SEGMENTS_NM: [f64; 4] = [30.0, 20.0, 10.0, 5.0];
/// Clamped lengths: 22 and 44 monomers (nm), and their mean stretch.
const SPANS_NM: [f64; 2] = [60.2462, 120.4923];
const STRETCHES: [f64; 3] = [-3e-3, 0.0, 3e-3];
/// Length of free filaments, and distances of cross-sections from the ends and from each other (nm).
const FREE_NM: f64 = 300.0;
const MARGIN_NM: f64 = 45.0;
const NEAR_NM: f64 = 30.0;
const FAR_NM: f64 = 120.0;

#[derive(Clone, Copy)]
struct Case<'a> {
    law: &'a str,
    segment_nm: Option<f64>,
    length_nm: f64,
    /// Mean stretch of a clamped filament; `None` for a free one.
    stretch: Option<f64>,
    /// Drag rate (1/ns).
    drag: f64,
    duration_ns: f64,
}

/// Means over one seed.
struct Means {
    /// Tension (pN).
    tension: f64,
    /// First two moments of the turn (rad) for `NEAR_NM` and `FAR_NM`.
    turns: [[f64; 2]; 2],
}

impl Case<'_> {
    fn scene(&self, seed: u64) -> Scene {
        let (law, to) = (self.law, self.length_nm);
        let section = self.segment_nm.map_or_else(
            || format!("Ellipsoids(from_nm: 0.0, to_nm: {to:?})"),
            |nm| {
                format!(
                    "Rod(from_nm: 0.0, to_nm: {to:?}, segments: {})",
                    (to / nm).round()
                )
            },
        );
        let rod = self
            .segment_nm
            .map_or(String::new(), |_| format!("rod: RodModel(law: {law}),"));
        let clamps = self
            .stretch
            .map_or("", |_| "Clamp(end: Start), Clamp(end: End)");
        let drag = self.drag;
        let text = format!(
            "Scene(
                filament: Filament(sections: [{section}], {rod}),
                clamps: [{clamps}],
                task: Dynamics(
                    duration_ns: 1.0,
                    drag: (translational_per_ns: {drag:?}, rotational_per_ns: {drag:?}),
                    thermal: (temperature_k: {ROOM_K:?}, seed: {seed}),
                ),
            )"
        );
        Scene::from_ron(&text).unwrap_or_else(|error| panic!("{error}"))
    }

    #[expect(
        clippy::too_many_lines,
        reason = "one protocol, from the filament to its means"
    )]
    fn run(&self, seed: u64) -> Means {
        let mut assembly = Assembly::build(&self.scene(seed)).expect("a filament");
        let system = &mut assembly.system;
        let frequency = largest_frequency(system).expect("a frequency");
        let step = stable_step(&PEFRL, frequency, SHARE).expect("a stable step");
        let drag = Drag::new(self.drag, self.drag).expect("positive rates");
        let kt = BOLTZMANN_PN_NM_PER_K * ROOM_K;
        let bath = Bath::new(drag, kt, seed).expect("a positive energy");
        let rest = assembly.rest;
        let count = rest.points.len();
        // Both monomers of a clamp move together.
        let along = |i: usize| rest.points.position.get(i).z.clamp(0.0, self.length_nm);
        let places: Vec<f64> = (0..count).map(along).collect();
        for (i, z) in places.iter().enumerate() {
            let state = system.state_mut();
            let mut place = state.points.position.get(i);
            place.z += self.stretch.unwrap_or(0.0) * z;
            state.points.position.set(i, place);
        }
        let warm_up = steps_in(WARM_UP_NS, step);
        advance_in(system, &PEFRL, step, warm_up, &bath, 0);
        let samples = steps_in(self.duration_ns, step) / APART;
        let unturned = &rest.frames.orientation;
        let frames = unturned.len();
        let per_nm = frames as f64 / self.length_nm;
        let [margin, near, far] = [MARGIN_NM, NEAR_NM, FAR_NM].map(|nm| rounded(nm * per_nm));
        let mut means = Means {
            tension: 0.0,
            turns: [[0.0; 2]; 2],
        };
        for sample in 0..samples {
            advance_in(system, &PEFRL, step, APART, &bath, warm_up + sample * APART);
            let force = &system.loads().force;
            // Derivative of the energy with respect to a uniform stretch.
            let virial: f64 = places
                .iter()
                .enumerate()
                .map(|(i, z)| force.get(i).z * z)
                .sum();
            means.tension -= virial / self.length_nm / samples as f64;
            if self.stretch.is_some() || sample % TURNS_APART != 0 {
                continue;
            }
            let turned = &system.state().frames.orientation;
            let turn = |i: usize| turned.get(i) * unturned.get(i).inverse();
            let taken = samples.div_ceil(TURNS_APART) as f64;
            for (apart, moments) in [near, far].into_iter().zip(&mut means.turns) {
                let pairs = frames - apart - 2 * margin;
                for i in margin..margin + pairs {
                    let phi = rotation::log(turn(i).inverse() * turn(i + apart)).z;
                    let weight = (pairs as f64 * taken).recip();
                    moments[0] += weight * phi;
                    moments[1] += weight * phi * phi;
                }
            }
        }
        means
    }

    /// Tension (pN) or twisting rigidity (pN nm^2), with its standard error.
    fn measure(&self, seeds: u64) -> (f64, f64) {
        let all: Vec<Means> = (1..=seeds)
            .into_par_iter()
            .map(|seed| self.run(seed))
            .collect();
        let mean = |chosen: &[&Means], of: &dyn Fn(&Means) -> f64| {
            chosen.iter().map(|means| of(means)).sum::<f64>() / chosen.len() as f64
        };
        if self.stretch.is_some() {
            return jackknife(&all, |chosen| mean(chosen, &|means| means.tension));
        }
        let frames = self.scene(1);
        let frames = Assembly::build(&frames)
            .expect("a filament")
            .rest
            .frames
            .len();
        let per_nm = frames as f64 / self.length_nm;
        let [near, far] = [NEAR_NM, FAR_NM].map(|nm| rounded(nm * per_nm) as f64 / per_nm);
        jackknife(&all, |chosen| {
            let variance = |k: usize| {
                let first = mean(chosen, &|means| means.turns[k][0]);
                mean(chosen, &|means| means.turns[k][1]) - first * first
            };
            BOLTZMANN_PN_NM_PER_K * ROOM_K * (far - near) / (variance(1) - variance(0))
        })
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "some tens"
)]
fn rounded(count: f64) -> usize {
    count.round() as usize
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let law = arguments.next().unwrap_or("HomogenisedAt298K".to_owned());
    let seeds: u64 = arguments.next().map_or(8, |s| s.parse().expect("a count"));
    let meshes: Vec<Option<f64>> = match law.as_str() {
        "Monomers" => vec![None],
        _ => SEGMENTS_NM.map(Some).to_vec(),
    };
    println!("{law}, {seeds} seeds (C: four times as many)");
    for segment_nm in meshes {
        let mesh = segment_nm.map_or("monomers".to_owned(), |nm| format!("{nm} nm"));
        let case = |length_nm, stretch, drag| Case {
            law: &law,
            segment_nm,
            length_nm,
            stretch,
            drag,
            duration_ns: 500.0,
        };
        for span_nm in SPANS_NM {
            let tensions = STRETCHES.map(|stretch| {
                let (value, error) = case(span_nm, Some(stretch), 30.0).measure(seeds);
                format!("{value:.1} ± {error:.1}")
            });
            println!(
                "{mesh}: tension of {span_nm:.0} nm at {STRETCHES:?}: {} pN",
                tensions.join(", ")
            );
        }
        let (value, error) = case(FREE_NM, None, 5.0).measure(4 * seeds);
        println!("{mesh}: C {value:.0} ± {error:.0} pN nm^2");
    }
}
