//! Drag up to 1e6 per ns (momentum, terminal velocity, creep, rest, diffusion, temperature), and long undamped
//! motion.

use super::row::{CaseResult, Outcome, Row, correct, larger};
use super::scenes::{CompletedRun, Parts, free};
use super::steps::MODELS;
use actin_integrate::{
    Bath, Drag, PEFRL, Run, advance, advance_in, largest_frequency, stable_step,
};
use actin_mechanics::{State, System, Vector3, Xorshift, randomise_velocities};

/// Damping rates (1/ns). In water they are about 1e2 across a filament and 1e3 about it.
const RATES: [f64; 7] = [0.0, 1e-3, 1.0, 1e2, 1e4, 1e5, 1e6];
const LOADED: [f64; 6] = [0.0, 1.0, 10.0, 1e2, 1e3, 1e4];

const LONG: [(&str, &str); 3] = [
    ("rod", "Rod(from_nm: 0.0, to_nm: 100.0)"),
    ("monomers", "Ellipsoids(from_nm: 0.0, to_nm: 100.0)"),
    (
        "mixed",
        "Ellipsoids(from_nm: 0.0, to_nm: 50.0), Rod(from_nm: 50.0, to_nm: 100.0)",
    ),
];

/// Thermal energy at 298 K (pN nm).
const KT: f64 = 4.114;

pub(super) fn drag() -> Vec<Row> {
    let mut rows = Vec::new();
    let mut push = |case: String, tried| rows.push(Row::new("drag", case, tried));
    for (model, sections) in MODELS {
        for rate in RATES {
            let tried = free(sections).and_then(|system| flight(system, rate));
            push(format!("{model}, {rate:.0e} per ns"), tried);
        }
    }
    for (model, sections) in LONG {
        for rate in LOADED {
            let case = |what: &str| format!("{model}, {rate:.0e} per ns, {what}");
            push(case("100 nm pulled by 1 pN"), pulled(sections, rate, None));
            if rate > 0.0 && model != "monomers" {
                push(case("the same at 298 K"), pulled(sections, rate, Some(298)));
            }
        }
    }
    for rate in &LOADED[1..] {
        let case = |what: &str| format!("20 nm of rod on a wall, {rate:.0e} per ns, {what}");
        push(case("at rest under 2 pN"), at_rest(*rate));
        push(case("on the way there"), creeping(*rate));
    }
    for (model, sections) in MODELS {
        for rate in &LOADED[3..] {
            let tried = free(sections).and_then(|system| diffusion(system, *rate));
            push(
                format!("{model}, {rate:.0e} per ns, diffusion at 298 K"),
                tried,
            );
        }
    }
    for rate in &LOADED[1..] {
        let tried = free(MODELS[0].1).and_then(|system| temperature(system, *rate));
        push(format!("rod, {rate:.0e} per ns, temperature"), tried);
    }
    rows
}

fn step(system: &System, share: f64) -> f64 {
    let frequency = largest_frequency(system).expect("loads at rest are finite");
    stable_step(&PEFRL, frequency, share).expect("it is positive")
}

fn steps(h: f64, time: f64) -> u64 {
    let run = Run::from_duration(&PEFRL, h, time).expect("steps and times are positive");
    run.steps()
}

fn uniform(rate: f64) -> Drag {
    Drag::new(rate, rate).expect("rates are positive")
}

/// The momentum decays as `exp(-gamma t)`, independently of the step and of internal forces.
fn flight(mut system: System, rate: f64) -> CaseResult {
    let (h, steps) = (step(&system, 0.5), 100);
    let points = &mut system.state_mut().points;
    for i in 0..points.len() {
        points.velocity.set(i, Vector3::new(3.0, -2.0, 1.0));
    }
    let start = system.state().momentum();
    advance(&mut system, &PEFRL, h, steps, &uniform(rate));
    let expected = start * (-rate * h * steps as f64).exp();
    if !system.state().is_finite() {
        return Err(Outcome::Wrong("the state is not finite".into()));
    }
    // Round-off of a hundred exponentials and of forces at rest.
    let error = (system.state().momentum() - expected).norm() / start.norm();
    correct("momentum exp(-gamma t), of what it was", error, 1e-13)
}

fn centre(state: &State) -> (f64, Vector3) {
    let masses = || state.points.inverse_mass().iter().map(|m| 1.0 / m);
    let mass = masses().sum::<f64>();
    let places = state.points.position.iter().zip(masses());
    (mass, places.map(|(x, m)| x * m).sum::<Vector3>() / mass)
}

fn damped(
    sections: &str,
    rest: &str,
    duration: f64,
    rate: f64,
    keys: &str,
) -> Result<CompletedRun, Outcome> {
    let task = format!(
        "Dynamics(duration_ns: {duration:?},
            drag: (translational_per_ns: {rate:?}, rotational_per_ns: {rate:?}), {keys})"
    );
    Parts::new(sections, rest, task).run()
}

/// Compares the displacement of a free filament under an axial end force in the second nanosecond
/// with theory.
///
/// ```text
/// x(t) = F/(M g) (t - (1 - exp(-g t))/g)
/// ```
///
/// In a heat bath, the reference is the same filament without the force and with the same noise.
fn pulled(sections: &str, rate: f64, kelvin: Option<u32>) -> CaseResult {
    let thermal = kelvin.map(|t| format!("thermal: (temperature_k: {t}.0, seed: 3),"));
    let keys = format!("record_every_ns: 1.0, {}", thermal.unwrap_or_default());
    let way = |force: f64| {
        let load = format!("loads: [EndForce(end: End, force_pn: (0.0, 0.0, {force:?}))],");
        let records = damped(sections, &load, 2.0, rate, &keys)?
            .trajectory
            .records;
        let [_, before, after] = &records[..] else {
            return Err(Outcome::Wrong(format!("{} records", records.len())));
        };
        let (mass, there) = centre(&after.state);
        Ok((mass, (there - centre(&before.state).1).z))
    };
    let (mass, with) = way(1.0)?;
    let way = match kelvin {
        Some(_) => with - way(0.0)?.1,
        None => with,
    };
    let gone = |t: f64| match rate {
        0.0 => 0.5 * t * t / mass,
        _ => (t + (-rate * t).exp_m1() / rate) / (mass * rate),
    };
    let expected = gone(2.0) - gone(1.0);
    // The discretisation error is (g h)^2/24 of the initial transient, which decays as exp(-g), for up to 10 per ns.
    // In a heat bath, the bound is round-off of the noise.
    let bound = if kelvin.is_some() { 1e-4 } else { 1e-6 };
    let error = (way / expected - 1.0).abs();
    correct("way of the centre of mass", error, bound)
}

const CANTILEVER: (&str, &str) = (
    "Rod(from_nm: 0.0, to_nm: 20.0, segments: 2)",
    "clamps: [Clamp(end: Start)], loads: [EndForce(end: End, force_pn: (2.0, 0.0, 0.0))],",
);

fn at_rest(rate: f64) -> CaseResult {
    let (sections, rest) = CANTILEVER;
    // 30 relaxation times of the slowest mode: 2/g for g < 22 per ns, g/120 ns^2 otherwise.
    let duration = 60.0 / rate + 0.25 * rate;
    let moved = damped(sections, rest, duration, rate, "record_every_ns: 1e9")?;
    let statics = Parts::new(sections, rest, "Equilibrium()").run()?;
    let [moved, expected] = [moved, statics].map(|ran| ran.tip_displacement());
    // Residual of 1e-7 pN for a load of 2 pN.
    let error = (moved - expected).norm() / expected.norm();
    correct("tip against statics", error, 1e-7)
}

fn creeping(rate: f64) -> CaseResult {
    let (sections, rest) = CANTILEVER;
    let time = if rate > 22.0 { rate / 120.0 } else { 0.15 };
    let tip = |share: f64| {
        let keys = format!("step_safety: {share:?}, record_every_ns: 1e9");
        damped(sections, rest, time, rate, &keys).map(|ran| ran.tip_displacement())
    };
    let (coarse, fine) = (tip(0.5)?, tip(0.5 / 8.0)?);
    let error = (coarse - fine).norm() / fine.norm();
    // h/(2T) with steps of at most 0.003 ns.
    correct("tip against an eighth of the step", error, 0.0015 / time)
}

/// Compares the mean square displacement of the centre of mass with theory.
///
/// ```text
/// <x^2> = 2 kT/(M g) (t - c (1 - exp(-g t))/g)     along each axis
/// c     = g h / sinh(g h)                          1 in continuous time
/// ```
fn diffusion(mut system: System, rate: f64) -> CaseResult {
    let (h, samples) = (step(&system, 0.5), 2000);
    let bath = Bath::new(uniform(rate), KT, 29).expect("it is positive");
    let g_h = rate * h;
    // Successive displacements are then independent within a few per cent.
    let each = steps(h, 10.0 / rate);
    let mut place = centre(system.state()).1;
    let mut square = 0.0;
    for sample in 0..=samples {
        advance_in(&mut system, &PEFRL, h, each, &bath, sample * each);
        let next = centre(system.state()).1;
        // The first displacement includes the transient from rest.
        if sample > 0 {
            square += (next - place).norm_squared() / (3 * samples) as f64;
        }
        place = next;
    }
    let t = each as f64 * h;
    let slower = g_h / g_h.sinh() * (1.0 - (-rate * t).exp()) / rate;
    let expected = 2.0 * KT / (centre(system.state()).0 * rate) * (t - slower);
    // 4.5 standard errors of 6000 squares.
    let bound = 4.5 * (2.0 / (3 * samples) as f64).sqrt();
    correct(
        "mean square of the way",
        (square / expected - 1.0).abs(),
        bound,
    )
}

/// Compares mean kinetic and strain energies at kT/100 with equipartition. Six of 21 coordinates
/// are rigid motions.
fn temperature(mut system: System, rate: f64) -> CaseResult {
    let (h, kt) = (step(&system, 0.5), 0.01 * KT);
    let bath = Bath::new(uniform(rate), kt, 31).expect("it is positive");
    let coordinates = 3.0 * (system.state().points.len() + system.state().frames.len()) as f64;
    // Relaxation time of the slowest mode, 30 rad/ns.
    let memory = (rate / 900.0).max(2.0 / rate);
    let (each, samples) = (steps(h, 0.5 * memory), 1000);
    let mut now = 20 * each;
    advance_in(&mut system, &PEFRL, h, now, &bath, 0);
    let (mut kinetic, mut strain) = (0.0, 0.0);
    for _ in 0..samples {
        advance_in(&mut system, &PEFRL, h, each, &bath, now);
        now += each;
        kinetic += system.state().kinetic_energy() / f64::from(samples);
        strain += system.potential_energy() / f64::from(samples);
    }
    let error = |energy: f64, count: f64| (energy / (0.5 * kt * count) - 1.0).abs();
    let largest = larger(
        error(kinetic, coordinates),
        error(strain, coordinates - 6.0),
    );
    // 4.5 standard errors of 15 modes in 300 independent samples.
    correct("kinetic energy and strain at kT/100", largest, 0.1)
}

/// Small filaments with random velocities, or with the centre of mass at rest.
const UNDAMPED: [(&str, &str, bool); 4] = [
    ("rod of 3 segments", MODELS[0].1, true),
    ("rod of 3 segments, centre at rest", MODELS[0].1, false),
    ("4 monomers", FOUR, true),
    ("4 monomers, centre at rest", FOUR, false),
];
const FOUR: &str = "Ellipsoids(from_nm: 0.0, to_nm: 11.0)";

/// Undamped motion over `count` steps: no trend of the energy, and momenta conserved up to round-off.
pub(super) fn undamped(count: u64) -> Vec<Row> {
    let rows = UNDAMPED
        .into_iter()
        .flat_map(|(name, sections, is_flying)| {
            let outcomes = free(sections).map_or_else(
                |outcome| vec![("", Err(outcome))],
                |system| drift(system, count, is_flying),
            );
            outcomes.into_iter().map(move |(what, tried)| {
                let case = format!("{name}, {:.0e} steps, {what}", count as f64);
                Row::new("undamped", case, tried)
            })
        });
    rows.collect()
}

/// Runs at a quarter of the stability limit. Returns the trend of the energy and the relative
/// changes of momentum and angular momentum.
fn drift(mut system: System, count: u64, is_flying: bool) -> Vec<(&'static str, CaseResult)> {
    set_moving(system.state_mut(), is_flying);
    let h = step(&system, 0.25);
    let start = system.total_energy();
    let before = all_momenta(system.state());
    let (mut means, mut largest) = ([0.0; 10], 0.0_f64);
    for mean in &mut means {
        for _ in 0..100 {
            advance(&mut system, &PEFRL, h, count / 1000, &Drag::NONE);
            let deviation = system.total_energy() / start - 1.0;
            *mean += deviation / 100.0;
            largest = largest.max(deviation.abs());
        }
    }
    let after = all_momenta(system.state());
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let trend = (mean(&means[7..]) - mean(&means[..3])).abs();
    // The trend is compared with the fluctuation of the energy.
    let what = "means of the last and first three tenths";
    let mut all = vec![("trend of the energy", correct(what, trend, 0.1 * largest))];
    let first = if is_flying { 0 } else { 2 };
    for (i, what) in MOMENTA.into_iter().enumerate().skip(first) {
        let change = (after[i] - before[i]).norm() / before[i].norm();
        // Round-off accumulates as a random walk, or linearly if biased.
        let tried = correct("relative change", change, 1e-16 * count as f64);
        all.push((what, tried));
    }
    all
}

fn set_moving(state: &mut State, is_flying: bool) {
    randomise_velocities(state, &mut Xorshift::new(11), 2.0, 0.5);
    if is_flying {
        return;
    }
    let velocity = state.momentum() / centre(state).0;
    for i in 0..state.points.len() {
        state.points.velocity.add(i, -velocity);
    }
}

const MOMENTA: [&str; 3] = [
    "momentum",
    "angular momentum",
    "angular momentum about the centre of mass",
];

fn all_momenta(state: &State) -> [Vector3; 3] {
    let (linear, angular) = (state.momentum(), state.angular_momentum());
    [linear, angular, angular - centre(state).1.cross(&linear)]
}
