//! Drag from none to 1e6 per ns: momentum, terminal velocity, creep, rest, diffusion and temperature.

use super::row::{Outcome, Row, larger};
use super::scenes::{build, either};
use super::stability::{MODELS, free};
use actin_integrate::{
    Bath, Drag, PEFRL, Run, advance, advance_in, largest_frequency, stable_step,
};

use actin_mechanics::{State, System, Vector3};
use actin_sim::{Assembly, End, Plan, Record, RunError};

/// Steps of each flight.
const STEPS: u64 = 100;

/// Rates of the flights (1/ns).
const RATES: [f64; 7] = [0.0, 1e-3, 1.0, 1e2, 1e4, 1e5, 1e6];

/// Rates of everything else (1/ns); water has some 1e2 across a filament and 1e3 about it.
const LOADED: [f64; 6] = [0.0, 1.0, 10.0, 1e2, 1e3, 1e4];

/// 100 nm of each kind.
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

/// All of them.
pub(super) fn rows() -> Vec<Row> {
    let mut rows = flights();
    for (model, sections) in LONG {
        for rate in LOADED {
            let case = |what: &str| format!("{model}, {rate:.0e} per ns, {what}");
            let outcome = either(pulled(sections, rate, None));
            rows.push(Row::new("drag", case("100 nm pulled by 1 pN"), outcome));
            if rate > 0.0 && model != "monomers" {
                let outcome = either(pulled(sections, rate, Some(298)));
                rows.push(Row::new("drag", case("the same at 298 K"), outcome));
            }
        }
    }
    for rate in &LOADED[1..] {
        let case = |what: &str| format!("20 nm of rod on a wall, {rate:.0e} per ns, {what}");
        let outcome = either(at_rest(*rate));
        rows.push(Row::new("drag", case("at rest under 2 pN"), outcome));
        let outcome = either(creeping(*rate));
        rows.push(Row::new("drag", case("on the way there"), outcome));
    }
    for (model, sections) in MODELS {
        for rate in &LOADED[3..] {
            let case = format!("{model}, {rate:.0e} per ns, diffusion at 298 K");
            let outcome = free(sections).map(|system| diffusion(system, *rate));
            rows.push(Row::new("drag", case, either(outcome)));
        }
    }
    let (_, rod) = MODELS[0];
    for rate in &LOADED[1..] {
        let case = format!("rod, {rate:.0e} per ns, temperature");
        let outcome = free(rod).map(|system| temperature(system, *rate));
        rows.push(Row::new("drag", case, either(outcome)));
    }
    rows
}

/// Free flight of all models under all rates.
fn flights() -> Vec<Row> {
    let mut rows = Vec::new();
    for (model, sections) in MODELS {
        for rate in RATES {
            let outcome = free(sections).map(|system| flight(system, rate));
            let case = format!("{model}, {rate:.0e} per ns");
            rows.push(Row::new("drag", case, either(outcome)));
        }
    }
    rows
}

/// Half the stability limit of PEFRL (ns).
fn default_step(system: &System) -> f64 {
    let frequency = largest_frequency(system).expect("loads at rest are finite");
    stable_step(&PEFRL, frequency, 0.5).expect("it is positive")
}

/// Steps of `h` in a time (ns).
fn steps(h: f64, time: f64) -> u64 {
    let run = Run::over(&PEFRL, h, time).expect("steps and times are positive");
    run.steps()
}

/// Momentum decays as `exp(-gamma t)` whatever the filament does, at any step.
fn flight(mut system: System, rate: f64) -> Outcome {
    let h = default_step(&system);
    let points = &mut system.state_mut().points;
    for i in 0..points.len() {
        points.velocity.set(i, Vector3::new(3.0, -2.0, 1.0));
    }
    let start = system.state().momentum();
    let drag = Drag::new(rate, rate).expect("rates are positive");
    advance(&mut system, &PEFRL, h, STEPS, &drag);
    let expected = start * (-rate * h * STEPS as f64).exp();
    let left = system.state().momentum();
    if !system.state().is_finite() {
        return Outcome::Wrong("the state is not finite".into());
    }
    // Round-off of a hundred exponentials, and of the forces at rest.
    let error = (left - expected).norm() / start.norm();
    Outcome::correct("momentum exp(-gamma t), of what it was", error, 1e-13)
}

/// Mass of all points, and their centre.
fn centre(state: &State) -> (f64, Vector3) {
    let masses = || state.points.inverse_mass().iter().map(|m| 1.0 / m);
    let mass = masses().sum::<f64>();
    let places = state.points.position.iter().zip(masses());
    (mass, places.map(|(x, m)| x * m).sum::<Vector3>() / mass)
}

/// Runs a scene and returns its records.
fn records(text: &str) -> Result<(Assembly, Vec<Record>), Outcome> {
    let assembly = build(text)?;
    let fails = |error: RunError| Outcome::Fails(error.to_string());
    let plan = Plan::new(&assembly).map_err(|problem| fails(problem.into()))?;
    let (trajectory, _) = plan.run().map_err(fails)?;
    Ok((assembly, trajectory.records))
}

/// A scene of these sections; `extra` are keys of the task.
fn scene(sections: &str, rest: &str, duration: f64, rate: f64, extra: &str) -> String {
    format!(
        "Scene(
            filament: Filament(
                sections: [{sections}],
                monomers: Monomers(anchors: Independent, lateral_bonds: 16, longitudinal_bonds: 16),
                rod: RodModel(law: Constant),
            ),
            {rest}
            task: Dynamics(
                duration_ns: {duration:?},
                drag: (translational_per_ns: {rate:?}, rotational_per_ns: {rate:?}),
                {extra}
            ),
        )"
    )
}

/// The way of a free filament along a force on its end, over the second nanosecond, against
/// `F/(M g) (t - (1 - exp(-g t))/g)`. In a bath, by how much it is ahead of the same filament
/// without the force, which meets the same noise: what acts within does not move the centre.
fn pulled(sections: &str, rate: f64, kelvin: Option<u32>) -> Result<Outcome, Outcome> {
    let thermal = kelvin.map(|t| format!("thermal: (temperature_k: {t}.0, seed: 3),"));
    let extra = format!(
        "record_every_ns: 1.0, {}",
        thermal.clone().unwrap_or_default()
    );
    let way = |force: f64| {
        let load = format!("loads: [EndForce(end: End, force_pn: (0.0, 0.0, {force:?}))],");
        let (_, records) = records(&scene(sections, &load, 2.0, rate, &extra))?;
        let [_, before, after] = &records[..] else {
            return Err(Outcome::Wrong(format!("{} records", records.len())));
        };
        let (mass, there) = centre(&after.state);
        Ok((mass, (there - centre(&before.state).1).z))
    };
    let (mass, with) = way(1.0)?;
    let way = match thermal {
        Some(_) => with - way(0.0)?.1,
        None => with,
    };
    let gone = |t: f64| {
        if rate == 0.0 {
            return 0.5 * t * t / mass;
        }
        (t + (-rate * t).exp_m1() / rate) / (mass * rate)
    };
    let expected = gone(2.0) - gone(1.0);
    // The start of the motion, of which the second nanosecond keeps exp(-g): (g h)^2/24 of it at 10
    // per ns and below; in a bath, round-off of what noise moves.
    let bound = if kelvin.is_some() { 1e-4 } else { 1e-6 };
    let what = "way of the centre of mass";
    Ok(Outcome::correct(what, (way / expected - 1.0).abs(), bound))
}

/// Sections and loads of a short cantilever, whose slowest mode has 11 rad/ns.
const CANTILEVER: (&str, &str) = (
    "Rod(from_nm: 0.0, to_nm: 20.0, segments: 2)",
    "clamps: [Clamp(end: Start)], loads: [EndForce(end: End, force_pn: (2.0, 0.0, 0.0))],",
);

/// Displacement of the tip in the last state of a scene (nm).
fn tip(text: &str) -> Result<Vector3, Outcome> {
    let (assembly, records) = records(text)?;
    let last = records.last().ok_or(Outcome::Wrong("no record".into()))?;
    let tip = |state| assembly.tip_nm(state, End::End);
    Ok(tip(&last.state) - tip(&assembly.rest))
}

/// A cantilever that has come to rest under drag is where statics puts it.
fn at_rest(rate: f64) -> Result<Outcome, Outcome> {
    let (sections, rest) = CANTILEVER;
    // 30 times what the slowest mode takes: 2/g below 22 per ns, g/120 ns^2 above.
    let duration = 60.0 / rate + 0.25 * rate;
    let moved = tip(&scene(
        sections,
        rest,
        duration,
        rate,
        "record_every_ns: 1e9",
    ))?;
    let text = scene(sections, rest, duration, rate, "");
    let (before, _) = text.split_once("task:").expect("the scene has a task");
    let expected = tip(&format!("{before} task: Equilibrium())"))?;
    let error = (moved - expected).norm() / expected.norm();
    // Residuals of 1e-7 pN of 2 in statics.
    Ok(Outcome::correct("tip against statics", error, 1e-7))
}

/// When two thirds of the way to rest are done, against steps of an eighth.
fn creeping(rate: f64) -> Result<Outcome, Outcome> {
    let (sections, rest) = CANTILEVER;
    let time = if rate > 22.0 { rate / 120.0 } else { 0.15 };
    let [coarse, fine] = [0.5, 0.5 / 8.0].map(|share| {
        let extra = format!("step_safety: {share:?}, record_every_ns: 1e9");
        tip(&scene(sections, rest, time, rate, &extra))
    });
    let (coarse, fine) = (coarse?, fine?);
    let error = (coarse - fine).norm() / fine.norm();
    // h/2T, with steps of at most 0.003 ns.
    let bound = 0.0015 / time;
    Ok(Outcome::correct(
        "tip against an eighth of the step",
        error,
        bound,
    ))
}

/// Samples of a filament's way.
const SAMPLES: u64 = 2000;

/// The mean square of the way of a filament's centre over some steps, against
/// `2 kT/(M g) (t - c (1 - exp(-g t))/g)` along each axis, with `c = g h/sinh(g h)` where time is
/// continuous 1: diffusion with `kT/(M g)`.
fn diffusion(mut system: System, rate: f64) -> Outcome {
    let h = default_step(&system);
    let drag = Drag::new(rate, rate).expect("rates are positive");
    let bath = Bath::new(drag, KT, 29).expect("it is positive");
    let g_h = rate * h;
    // Ways are then independent to a few percent.
    let each = steps(h, 10.0 / rate);
    let mut place = centre(system.state()).1;
    let mut square = 0.0;
    for sample in 0..=SAMPLES {
        advance_in(&mut system, &PEFRL, h, each, &bath, sample * each);
        let next = centre(system.state()).1;
        // The first is on the way from rest.
        if sample > 0 {
            square += (next - place).norm_squared() / (3 * SAMPLES) as f64;
        }
        place = next;
    }
    let t = each as f64 * h;
    let slower = g_h / g_h.sinh() * (1.0 - (-rate * t).exp()) / rate;
    let mass = centre(system.state()).0;
    let expected = 2.0 * KT / (mass * rate) * (t - slower);
    // 4.5 standard errors of 6000 squares.
    let bound = 4.5 * (2.0 / (3 * SAMPLES) as f64).sqrt();
    Outcome::correct(
        "mean square of the way",
        (square / expected - 1.0).abs(),
        bound,
    )
}

/// Mean energies of a free rod at kT/100, kinetic and of strain, against their shares: `kT/2` for each
/// of 21 coordinates, of which six are rigid motions without strain.
fn temperature(mut system: System, rate: f64) -> Outcome {
    let (h, kt) = (default_step(&system), 0.01 * KT);
    let drag = Drag::new(rate, rate).expect("rates are positive");
    let bath = Bath::new(drag, kt, 31).expect("it is positive");
    let coordinates = 3.0 * (system.state().points.len() + system.state().frames.len()) as f64;
    // The slowest mode, of 30 rad/ns, relaxes in g/900 ns^2 or in 2/g.
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
    // 4.5 standard errors of 15 modes in 300 samples that are independent.
    Outcome::correct("kinetic energy and strain at kT/100", largest, 0.1)
}
