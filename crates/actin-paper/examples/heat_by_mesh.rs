//! Tension and twisting rigidity of rods in a heat bath by the length of their segments, and of monomers.
//!
//! `cargo run --release -p actin-paper --example heat_by_mesh [LAW [SEEDS [water [SEGMENT_NM]]]]`
//!
//! Tension: filaments clamped at both ends at a mean stretch, mean of the axial force over time. Twisting
//! rigidity `C`: `kT` over the slope of the variance of the turn between cross-sections 30 and 120 nm apart,
//! at least 45 nm from the ends of free filaments of 300 nm. Errors are standard errors over seeds, by the
//! jackknife. The law `Monomers` resolves monomers. The law `Cells` is the free energy of the cells, without
//! subtraction of the motion of segments. With `water`, the motion is `Brownian` with its default time step, of
//! segments of 20 nm and less, and clamped filaments have the length of 60 nm as built.

use actin_integrate::{Bath, Drag, PEFRL, advance_in, largest_frequency, stable_step};
use actin_mechanics::{Interaction, Loads, State, Vectors, rotation};
use actin_paper::measure::{RotationCorrelations, jackknife, steps_in};
use actin_sim::{Assembly, BOLTZMANN_PN_NM_PER_K, Plan, Scene};
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

/// Time between samples of the tension and of the turns in water (ns), and number of samples. The first tenth is
/// not used.
const APART_IN_WATER_NS: [f64; 2] = [5.0, 6.0];
const SAMPLES_IN_WATER: u32 = 2000;

const CELLS: &str = "Cells";

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
    is_in_water: bool,
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
        let to = self.length_nm;
        let law = match self.law {
            CELLS => "HomogenisedAt298K",
            law => law,
        };
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
        let task = self.task(seed);
        let clamps = self
            .stretch
            .map_or("", |_| "Clamp(end: Start), Clamp(end: End)");
        let text = format!(
            "Scene(
                filament: Filament(sections: [{section}], {rod}),
                clamps: [{clamps}],
                task: {task},
            )"
        );
        Scene::from_ron(&text).unwrap_or_else(|error| panic!("{error}"))
    }

    fn task(&self, seed: u64) -> String {
        if self.law == CELLS {
            // Without a bath, segments have the law of the cells.
            return "Equilibrium()".to_owned();
        }
        if self.is_in_water {
            let every_ns = APART_IN_WATER_NS[usize::from(self.stretch.is_none())];
            let duration_ms = 1e-6 * every_ns * f64::from(SAMPLES_IN_WATER);
            return format!(
                "Brownian(duration_ms: {duration_ms:?}, record_every_ns: {every_ns:?}, temperature_k: {ROOM_K:?}, seed: {seed})"
            );
        }
        let drag = self.drag;
        format!(
            "Dynamics(
                duration_ns: 1.0,
                drag: (translational_per_ns: {drag:?}, rotational_per_ns: {drag:?}),
                thermal: (temperature_k: {ROOM_K:?}, seed: {seed}),
            )"
        )
    }

    fn run(&self, seed: u64) -> Means {
        let mut assembly = Assembly::build(&self.scene(seed)).expect("a filament");
        let mut sampler = Sampler::new(self, &assembly);
        if self.is_in_water {
            let plan = Plan::new(&assembly).expect("a motion that can run");
            let (trajectory, _) = plan.run().expect("a motion");
            let (_, records) = trajectory.records.split_at(trajectory.records.len() / 10);
            for record in records {
                sampler.add_state(&record.state, assembly.system.interactions());
            }
            return sampler.means();
        }
        let system = &mut assembly.system;
        let frequency = largest_frequency(system).expect("a frequency");
        let step = stable_step(&PEFRL, frequency, SHARE).expect("a stable step");
        let drag = Drag::new(self.drag, self.drag).expect("positive rates");
        let kt = BOLTZMANN_PN_NM_PER_K * ROOM_K;
        let bath = Bath::new(drag, kt, seed).expect("a positive energy");
        for (i, z) in sampler.places.iter().enumerate() {
            let state = system.state_mut();
            let mut place = state.points.position.get(i);
            place.z += self.stretch.unwrap_or(0.0) * z;
            state.points.position.set(i, place);
        }
        let warm_up = steps_in(WARM_UP_NS, step);
        advance_in(system, &PEFRL, step, warm_up, &bath, 0);
        let samples = steps_in(self.duration_ns, step) / APART;
        for sample in 0..samples {
            advance_in(system, &PEFRL, step, APART, &bath, warm_up + sample * APART);
            sampler.add_tension(&system.loads().force);
            if sample % TURNS_APART == 0 {
                sampler.add_turns(system.state());
            }
        }
        sampler.means()
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

/// Sums over samples of one filament.
struct Sampler {
    rest: State,
    length_nm: f64,
    /// Arc lengths of points (nm).
    places: Vec<f64>,
    /// Turns are sampled between these distances from the ends, in frames; `None` for clamped filaments.
    margin: Option<usize>,
    /// Monomers and segments, without cross-sections at ends.
    frames: Vec<usize>,
    /// Distances in `frames`.
    apart: [usize; 2],
    tension: f64,
    tensions: u32,
    moments: [[f64; 2]; 2],
    turns: u32,
}

impl Sampler {
    fn new(case: &Case, assembly: &Assembly) -> Self {
        let (rest, length_nm) = (assembly.rest.clone(), case.length_nm);
        // Both monomers of a clamp move together.
        let along = |i: usize| rest.points.position.get(i).z.clamp(0.0, length_nm);
        let places = (0..rest.points.len()).map(along).collect();
        let frames = RotationCorrelations::new(assembly).frames;
        let per_nm = frames.len() as f64 / length_nm;
        let [margin, near, far] = [MARGIN_NM, NEAR_NM, FAR_NM].map(|nm| rounded(nm * per_nm));
        Self {
            rest,
            length_nm,
            places,
            margin: case.stretch.is_none().then_some(margin),
            frames,
            apart: [near, far],
            tension: 0.0,
            tensions: 0,
            moments: [[0.0; 2]; 2],
            turns: 0,
        }
    }

    fn add_state(&mut self, state: &State, interactions: &[Box<dyn Interaction>]) {
        let mut loads = Loads::zeros(state);
        for interaction in interactions {
            interaction.add_loads(state, &mut loads);
        }
        self.add_tension(&loads.force);
        self.add_turns(state);
    }

    /// Derivative of the energy with respect to a uniform stretch, over the length.
    fn add_tension(&mut self, force: &Vectors) {
        let places = self.places.iter().enumerate();
        let virial: f64 = places.map(|(i, z)| force.get(i).z * z).sum();
        self.tension -= virial / self.length_nm;
        self.tensions += 1;
    }

    fn add_turns(&mut self, state: &State) {
        let Some(margin) = self.margin else {
            return;
        };
        let (turned, unturned) = (&state.frames.orientation, &self.rest.frames.orientation);
        let turn = |k: usize| {
            let i = self.frames[k];
            turned.get(i) * unturned.get(i).inverse()
        };
        for (apart, moments) in self.apart.into_iter().zip(&mut self.moments) {
            let pairs = self.frames.len() - apart - 2 * margin;
            for i in margin..margin + pairs {
                let phi = rotation::log(turn(i).inverse() * turn(i + apart)).z;
                moments[0] += phi / pairs as f64;
                moments[1] += phi * phi / pairs as f64;
            }
        }
        self.turns += 1;
    }

    fn means(self) -> Means {
        let turns = f64::from(self.turns.max(1));
        Means {
            tension: self.tension / f64::from(self.tensions),
            turns: self.moments.map(|moments| moments.map(|sum| sum / turns)),
        }
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
    let is_in_water = arguments.next().is_some_and(|motion| motion == "water");
    let only: Option<f64> = arguments.next().map(|nm| nm.parse().expect("a length"));
    let segments = SEGMENTS_NM[usize::from(is_in_water)..].iter().copied();
    let meshes: Vec<Option<f64>> = match law.as_str() {
        "Monomers" => vec![None],
        _ => segments
            .filter(|nm| only.is_none_or(|only| only.total_cmp(nm).is_eq()))
            .map(Some)
            .collect(),
    };
    println!("{law}, {seeds} seeds (C: four times as many)");
    for segment_nm in meshes {
        let case = |length_nm, stretch, drag| Case {
            law: &law,
            segment_nm,
            length_nm,
            stretch,
            drag,
            duration_ns: 500.0,
            is_in_water,
        };
        report(&case, seeds);
    }
}

/// Prints the tensions and the twisting rigidity of one mesh. `case` has the arguments length (nm), stretch, and
/// drag (1/ns).
fn report<'a>(case: &dyn Fn(f64, Option<f64>, f64) -> Case<'a>, seeds: u64) {
    let free = case(FREE_NM, None, 5.0);
    let mesh = (free.segment_nm).map_or("monomers".to_owned(), |nm| format!("{nm} nm"));
    let (spans, stretches) = if free.is_in_water {
        (&SPANS_NM[..1], &[0.0][..])
    } else {
        (&SPANS_NM[..], &STRETCHES[..])
    };
    for &span_nm in spans {
        let tensions = stretches.iter().map(|&stretch| {
            let (value, error) = case(span_nm, Some(stretch), 30.0).measure(seeds);
            format!("{value:.1} ± {error:.1}")
        });
        let tensions: Vec<String> = tensions.collect();
        println!(
            "{mesh}: tension of {span_nm:.0} nm at {stretches:?}: {} pN",
            tensions.join(", ")
        );
    }
    let (value, error) = free.measure(4 * seeds);
    println!("{mesh}: C {value:.0} ± {error:.0} pN nm^2");
}
